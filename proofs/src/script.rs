//! This file writes a path as a question in SMT-LIB 2: numbers are IEEE 754 of one width, every operation rounds to nearest, ties to even.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::symbol::{Literal, Relation, Term};
use crate::width::Width;

/// A question, and which unknowns an answer has to give numbers for.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// SMT-LIB 2.
    pub text: String,
    /// Numbers of the unknowns in it, ascending.
    pub inputs: Vec<u32>,
    /// Their width.
    pub width: Width,
}

/// Whether any numbers walk this path.
pub fn script(width: Width, terms: &[Term], path: &[Literal]) -> Script {
    let (sort, bits, of_bits) = match width {
        Width::Double => ("Float64", 64, "(_ to_fp 11 53)"),
        Width::Single => ("Float32", 32, "(_ to_fp 8 24)"),
    };
    let needed = needed(terms, path);
    let mut inputs = Vec::new();
    let mut text = String::from("(set-option :produce-models true)\n(set-logic QF_BVFP)\n");
    for id in needed {
        let _ = match terms[id as usize] {
            Term::Input(input) => {
                inputs.push(input);
                writeln!(
                    text,
                    "(declare-const i{input} (_ BitVec {bits}))\n(define-fun t{id} () {sort} ({of_bits} i{input}))"
                )
            }
            Term::Constant(constant) => {
                let (digits, constant) = (bits / 4, width.bits(f64::from_bits(constant)));
                writeln!(
                    text,
                    "(define-fun t{id} () {sort} ({of_bits} #x{constant:0digits$x}))"
                )
            }
            Term::Neg(a) => writeln!(text, "(define-fun t{id} () {sort} (fp.neg t{a}))"),
            Term::Add(a, b) => {
                writeln!(text, "(define-fun t{id} () {sort} (fp.add RNE t{a} t{b}))")
            }
            Term::Sub(a, b) => {
                writeln!(text, "(define-fun t{id} () {sort} (fp.sub RNE t{a} t{b}))")
            }
            Term::Mul(a, b) => {
                writeln!(text, "(define-fun t{id} () {sort} (fp.mul RNE t{a} t{b}))")
            }
        };
    }
    for literal in path {
        let relation = match literal.relation {
            Relation::Less => "fp.lt",
            Relation::LessOrEqual => "fp.leq",
            Relation::Equal => "fp.eq",
        };
        let comparison = format!("({relation} t{} t{})", literal.left, literal.right);
        let _ = if literal.holds {
            writeln!(text, "(assert {comparison})")
        } else {
            writeln!(text, "(assert (not {comparison}))")
        };
    }
    text.push_str("(check-sat)\n");
    inputs.sort_unstable();
    Script {
        text,
        inputs,
        width,
    }
}

/// The terms that a path speaks of and those they are made of, ascending: a term is made of earlier ones.
fn needed(terms: &[Term], path: &[Literal]) -> BTreeSet<u32> {
    let mut needed = BTreeSet::new();
    let mut waiting: Vec<u32> = path
        .iter()
        .flat_map(|literal| [literal.left, literal.right])
        .collect();
    while let Some(id) = waiting.pop() {
        if needed.insert(id) {
            match terms[id as usize] {
                Term::Input(_) | Term::Constant(_) => {}
                Term::Neg(a) => waiting.push(a),
                Term::Add(a, b) | Term::Sub(a, b) | Term::Mul(a, b) => waiting.extend([a, b]),
            }
        }
    }
    needed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_asked_with_what_it_is_made_of() {
        let terms = [
            Term::Input(0),
            Term::Constant(0x3ff8_0000_0000_0000),
            Term::Input(1),
            Term::Mul(0, 1),
        ];
        let path = [Literal {
            relation: Relation::Less,
            left: 3,
            right: 1,
            holds: false,
        }];
        let script = script(Width::Double, &terms, &path);
        assert_eq!(script.inputs, [0]);
        let expected = [
            "(set-option :produce-models true)",
            "(set-logic QF_BVFP)",
            "(declare-const i0 (_ BitVec 64))",
            "(define-fun t0 () Float64 ((_ to_fp 11 53) i0))",
            "(define-fun t1 () Float64 ((_ to_fp 11 53) #x3ff8000000000000))",
            "(define-fun t3 () Float64 (fp.mul RNE t0 t1))",
            "(assert (not (fp.lt t3 t1)))",
            "(check-sat)",
        ];
        assert_eq!(script.text.lines().collect::<Vec<_>>(), expected);
        let single = super::script(Width::Single, &terms, &path).text;
        assert!(single.contains("(declare-const i0 (_ BitVec 32))"));
        assert!(single.contains("(define-fun t1 () Float32 ((_ to_fp 8 24) #x3fc00000))"));
    }
}
