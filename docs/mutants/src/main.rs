//! This program builds every mutant of a list of cargo-mutants into one copy of the sources; `crate::switch` says which one is on.
//!
//! `switch <mutants.json> <skip file> <folder>`: the list of `cargo mutants --list --json`, numbers of mutants that do not compile, the copy.

use std::collections::{BTreeMap, BTreeSet};
use std::{env, fs};

use proc_macro2::{LineColumn, TokenStream};
use quote::{ToTokens, quote};
use serde_json::Value;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Expr, Signature, parse_quote};

/// Where a mutant begins, and its kind.
type Place = (usize, usize, String);

/// The mutants of one file that wait for their place: number and replacement.
#[derive(Default)]
struct Waiting(BTreeMap<Place, Vec<(u32, String)>>);

impl Waiting {
    fn take(&mut self, at: LineColumn, genre: &str) -> Vec<(u32, TokenStream)> {
        let place = (at.line, at.column + 1, genre.to_owned());
        let found = self.0.remove(&place).unwrap_or_default();
        found
            .into_iter()
            .map(|(number, text)| (number, text.parse().expect("a replacement is Rust")))
            .collect()
    }

    fn body(&mut self, signature: &mut Signature, block: &mut Block) {
        let Some(first) = block.stmts.first() else {
            return;
        };
        let mutants = self.take(first.span().start(), "FnValue");
        let before = self.0.len();
        self.visit_block_mut(block);
        if !mutants.is_empty() || self.0.len() < before {
            signature.constness = None;
        }
        for (number, value) in mutants.into_iter().rev() {
            let switched = parse_quote!(if crate::switch::on() == #number { return #value; });
            block.stmts.insert(0, switched);
        }
    }
}

impl VisitMut for Waiting {
    fn visit_item_fn_mut(&mut self, item: &mut syn::ItemFn) {
        self.body(&mut item.sig, &mut item.block);
    }

    fn visit_impl_item_fn_mut(&mut self, item: &mut syn::ImplItemFn) {
        self.body(&mut item.sig, &mut item.block);
    }

    fn visit_trait_item_fn_mut(&mut self, item: &mut syn::TraitItemFn) {
        if let Some(block) = &mut item.default {
            self.body(&mut item.sig, block);
        }
    }

    fn visit_arm_mut(&mut self, arm: &mut syn::Arm) {
        let deleted = self.take(arm.span().start(), "MatchArm");
        let guards = match &arm.guard {
            Some((_, guard)) => self.take(guard.span().start(), "MatchArmGuard"),
            None => Vec::new(),
        };
        visit_mut::visit_arm_mut(self, arm);
        if let Some((_, guard)) = &mut arm.guard {
            **guard = switched(guard.to_token_stream(), guards);
        }
        if !deleted.is_empty() {
            let deleted = deleted
                .into_iter()
                .map(|(number, _)| (number, quote!(false)))
                .collect();
            match &mut arm.guard {
                Some((_, guard)) => **guard = switched(guard.to_token_stream(), deleted),
                None => {
                    let guard = switched(quote!(true), deleted);
                    arm.guard = Some((Default::default(), Box::new(guard)));
                }
            }
        }
    }

    fn visit_expr_struct_mut(&mut self, expr: &mut syn::ExprStruct) {
        let mut deleted = Vec::new();
        for field in &expr.fields {
            deleted.push(self.take(field.span().start(), "StructField"));
        }
        visit_mut::visit_expr_struct_mut(self, expr);
        let rest = &expr.rest;
        for (field, deleted) in expr.fields.iter_mut().zip(deleted) {
            let name = &field.member;
            let deleted: Vec<_> = deleted
                .into_iter()
                .map(|(number, _)| (number, quote!((#rest).#name)))
                .collect();
            if !deleted.is_empty() {
                field.colon_token = Some(Default::default());
                field.expr = switched(field.expr.to_token_stream(), deleted);
            }
        }
    }

    fn visit_expr_mut(&mut self, expr: &mut Expr) {
        let mutants = match expr {
            Expr::Binary(binary) => self.take(binary.op.span().start(), "BinaryOperator"),
            Expr::Unary(unary) => self.take(unary.op.span().start(), "UnaryOperator"),
            _ => Vec::new(),
        };
        visit_mut::visit_expr_mut(self, expr);
        if mutants.is_empty() {
            return;
        }
        match expr {
            Expr::Binary(binary) => {
                let (left, right, op) = (&binary.left, &binary.right, &binary.op);
                let text = op.to_token_stream().to_string();
                if holds_let(left) || holds_let(right) {
                    // `||` beside a `let` does not compile.
                    eprintln!("beside a let: {:?}", mutants[0].0);
                    return;
                }
                *expr = match text.as_str() {
                    "&&" | "||" => lazy(left, right, &text, &mutants),
                    "==" | "!=" | "<" | "<=" | ">" | ">=" => {
                        let with = |op: &TokenStream| quote!(*left #op *right);
                        let inner = chosen(with(&op.to_token_stream()), &mutants, with);
                        parse_quote!(match (&(#left), &(#right)) { (left, right) => #inner })
                    }
                    text if text.ends_with('=') => {
                        let with = |op: &TokenStream| quote!({ #left #op switch_right; });
                        let inner = chosen(with(&op.to_token_stream()), &mutants, with);
                        parse_quote!(match (#right,) { (switch_right,) => #inner })
                    }
                    _ => {
                        let with = |op: &TokenStream| quote!(left #op right);
                        let inner = chosen(with(&op.to_token_stream()), &mutants, with);
                        parse_quote!(match (#left, #right) { (left, right) => #inner })
                    }
                };
            }
            Expr::Unary(unary) => {
                let (op, operand) = (&unary.op, &unary.expr);
                let inner = chosen(quote!(#op operand), &mutants, |_| quote!(operand));
                *expr = parse_quote!(match (#operand,) { (operand,) => #inner });
            }
            _ => unreachable!(),
        }
    }
}

/// `usual` unless one of the mutants is on.
fn switched(usual: TokenStream, mutants: Vec<(u32, TokenStream)>) -> Expr {
    chosen(usual, &mutants, |text| text.clone())
}

fn chosen(
    usual: TokenStream,
    mutants: &[(u32, TokenStream)],
    with: impl Fn(&TokenStream) -> TokenStream,
) -> Expr {
    let numbers = mutants.iter().map(|(number, _)| number);
    let values = mutants.iter().map(|(_, text)| with(text));
    parse_quote!((match crate::switch::on() { #(#numbers => #values,)* _ => #usual }))
}

/// `&&` and `||`, whose right side waits; what holds a `let` stays.
fn lazy(left: &Expr, right: &Expr, op: &str, mutants: &[(u32, TokenStream)]) -> Expr {
    let [(number, other)] = mutants else {
        panic!("{op} has one mutant")
    };
    assert!(matches!(other.to_string().as_str(), "&&" | "||"));
    let stops = if op == "&&" { quote!(==) } else { quote!(!=) };
    parse_quote!(match #left { switch_left => if switch_left #stops (crate::switch::on() == #number) { switch_left } else { #right } })
}

fn holds_let(side: &Expr) -> bool {
    match side {
        Expr::Let(_) => true,
        Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        _ => false,
    }
}

fn main() {
    let arguments: Vec<String> = env::args().collect();
    let list: Value = serde_json::from_str(&fs::read_to_string(&arguments[1]).unwrap()).unwrap();
    let skip = fs::read_to_string(&arguments[2]).unwrap_or_default();
    let skip: BTreeSet<u32> = skip
        .split_whitespace()
        .map(|n| n.parse().unwrap())
        .collect();
    let mut files: BTreeMap<&str, Waiting> = BTreeMap::new();
    for (index, mutant) in list.as_array().unwrap().iter().enumerate() {
        let number = index as u32 + 1;
        let start = &mutant["span"]["start"];
        let at = |key: &str| start[key].as_u64().unwrap() as usize;
        let text = |key: &str| mutant[key].as_str().unwrap();
        let place = (at("line"), at("column"), text("genre").to_owned());
        let waiting = files.entry(text("file")).or_default();
        if !skip.contains(&number) {
            let replacement = text("replacement").to_owned();
            waiting
                .0
                .entry(place)
                .or_default()
                .push((number, replacement));
        }
    }
    for (name, mut waiting) in files {
        let path = format!("{}/{name}", arguments[3]);
        let mut file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        waiting.visit_file_mut(&mut file);
        for (place, mutants) in waiting.0 {
            eprintln!("not placed: {name} {place:?} {mutants:?}");
        }
        fs::write(&path, file.to_token_stream().to_string()).unwrap();
    }
}
