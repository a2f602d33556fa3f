//! This file is a number that is not known yet: it records what is computed from it, and forks where it is compared.
//!
//! The rig's own generic code runs on it. A number is an index into the arena of its thread, so that it can be copied. Comparisons that the
//! path so far decides do not fork: each pair of terms keeps which of less, equal, greater and unordered are still possible, and each term
//! the interval that comparisons with constants leave it.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use std::ops::{Add, Mul, Neg, Sub};

use rigproof_impl::number::Scalar;

use crate::fork::Forks;
use crate::interval::Interval;
use crate::order::{ANY, EQUAL, Factors, GREATER, LESS, UNORDERED, of_products, of_sums, reversed};
use crate::width::Width;

/// A term of the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Term {
    /// Any number, by its number in the order of asking.
    Input(u32),
    /// A constant, by its bits as an f64.
    Constant(u64),
    /// The negative of a term.
    Neg(u32),
    /// A rounded sum.
    Add(u32, u32),
    /// A rounded difference.
    Sub(u32, u32),
    /// A rounded product.
    Mul(u32, u32),
}

/// A comparison of two terms as IEEE 754 defines it: with what is no number none holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// left < right
    Less,
    /// left ≤ right
    LessOrEqual,
    /// left = right
    Equal,
}

/// What a path takes for granted: a comparison and its outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Literal {
    /// The comparison.
    pub relation: Relation,
    /// Its left term.
    pub left: u32,
    /// Its right term.
    pub right: u32,
    /// Its outcome.
    pub holds: bool,
}

/// Terms, and the path that is being walked.
#[derive(Default)]
pub struct Arena {
    /// The width of every number.
    pub width: Width,
    terms: Vec<Term>,
    known: HashMap<Term, u32, Fast>,
    inputs: u32,
    /// Branches taken, of comparisons and choices.
    pub forks: Forks,
    /// What the path takes for granted.
    pub path: Vec<Literal>,
    intervals: HashMap<u32, Interval, Fast>,
    orders: HashMap<(u32, u32), u8, Fast>,
    /// Whether the path contradicts itself: no number walks it.
    pub contradicted: bool,
}

impl Arena {
    /// An arena of numbers of one width, without a term.
    pub fn of(width: Width) -> Arena {
        Arena {
            width,
            ..Arena::default()
        }
    }

    /// Every term, those it is made of before it.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// A new unknown.
    pub fn input(&mut self) -> Symbol {
        self.inputs += 1;
        self.term(Term::Input(self.inputs - 1))
    }

    /// Back to the start of a run; the terms stay.
    pub fn restart(&mut self) {
        self.inputs = 0;
        self.path.clear();
        self.intervals.clear();
        self.orders.clear();
        self.contradicted = false;
    }

    fn term(&mut self, term: Term) -> Symbol {
        let terms = &mut self.terms;
        Symbol(*self.known.entry(term).or_insert_with(|| {
            terms.push(term);
            u32::try_from(terms.len() - 1).expect("fewer terms than 2^32")
        }))
    }

    /// The nearest constant of the width.
    fn nearest(&mut self, constant: f64) -> Symbol {
        let bits = self.width.rounded(constant).to_bits();
        self.term(Term::Constant(bits))
    }

    fn constant(&self, term: u32) -> Option<f64> {
        match self.terms[term as usize] {
            Term::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn negative(&mut self, term: u32) -> u32 {
        match (self.terms[term as usize], self.constant(term)) {
            (_, Some(constant)) => self.term(Term::Constant((-constant).to_bits())).0,
            (Term::Neg(inner), _) => inner,
            _ => self.term(Term::Neg(term)).0,
        }
    }

    fn compare(&mut self, relation: Relation, left: u32, right: u32) -> bool {
        // −t ? c is −c ? t with the sides exchanged, exactly.
        match (self.terms[left as usize], self.terms[right as usize]) {
            (Term::Neg(inner), Term::Constant(_)) => {
                let constant = self.negative(right);
                return self.compare(relation, constant, inner);
            }
            (Term::Constant(_), Term::Neg(inner)) => {
                let constant = self.negative(left);
                return self.compare(relation, inner, constant);
            }
            _ => {}
        }
        let swapped = left > right;
        let pair = if swapped {
            (right, left)
        } else {
            (left, right)
        };
        let wanted = match (relation, swapped) {
            (Relation::Equal, _) => EQUAL,
            (Relation::Less, false) => LESS,
            (Relation::Less, true) => GREATER,
            (Relation::LessOrEqual, false) => LESS | EQUAL,
            (Relation::LessOrEqual, true) => GREATER | EQUAL,
        };
        let possible = self.possible(pair);
        self.contradicted |= possible == 0;
        if self.contradicted || possible & !wanted == 0 {
            return true;
        }
        if possible & wanted == 0 {
            return false;
        }
        let holds = self.forks.take(2) == 0;
        let left_over = if holds {
            possible & wanted
        } else {
            possible & !wanted
        };
        self.orders.insert(pair, left_over);
        self.path.push(Literal {
            relation,
            left,
            right,
            holds,
        });
        self.narrow(relation, left, right, holds);
        holds
    }

    /// Which orders of two terms the path leaves.
    fn possible(&self, pair: (u32, u32)) -> u8 {
        let (left, right) = pair;
        let stored = self.orders.get(&pair).copied();
        let stored = stored.unwrap_or(ANY);
        if left == right {
            let undefined = self.interval(left).undefined;
            return stored & if undefined { EQUAL | UNORDERED } else { EQUAL };
        }
        let stored = stored & self.by_parts(left, right);
        let (left, right) = (self.interval(left), self.interval(right));
        let mut possible = 0;
        if left.low < right.high {
            possible |= LESS;
        }
        if left.low <= right.high && right.low <= left.high {
            possible |= EQUAL;
        }
        if left.high > right.low {
            possible |= GREATER;
        }
        if left.undefined || right.undefined {
            possible |= UNORDERED;
        }
        stored & possible
    }

    /// Which orders of two terms the orders of their parts leave.
    fn by_parts(&self, left: u32, right: u32) -> u8 {
        let between = |one: u32, other: u32| {
            if one > other {
                reversed(self.possible((other, one)))
            } else {
                self.possible((one, other))
            }
        };
        match (self.terms[left as usize], self.terms[right as usize]) {
            (Term::Neg(one), Term::Neg(other)) => reversed(between(one, other)),
            (Term::Add(a, b), Term::Add(c, d)) => of_sums([between(a, c), between(b, d)]),
            (Term::Sub(a, b), Term::Sub(c, d)) => of_sums([between(a, c), reversed(between(b, d))]),
            (Term::Mul(a, b), Term::Mul(c, d)) => {
                let factors = |one: u32, other: u32| Factors {
                    orders: between(one, other),
                    intervals: [self.interval(one), self.interval(other)],
                };
                of_products([factors(a, c), factors(b, d)])
            }
            _ => ANY,
        }
    }

    /// What a term can be: what its parts can be, and what comparisons left of it.
    fn interval(&self, term: u32) -> Interval {
        let of_parts = match self.terms[term as usize] {
            Term::Constant(bits) => return Interval::of(f64::from_bits(bits)),
            Term::Input(_) => Interval::default(),
            Term::Neg(a) => self.interval(a).negated(),
            Term::Add(a, b) => self.interval(a).combined(self.interval(b), |a, b| a + b),
            Term::Sub(a, b) => self.interval(a).combined(self.interval(b), |a, b| a - b),
            Term::Mul(a, b) => self.interval(a).combined(self.interval(b), |a, b| a * b),
        };
        let of_parts = of_parts.rounded(self.width);
        let left = self.intervals.get(&term);
        left.map_or(of_parts, |left| left.and(of_parts))
    }

    fn narrow(&mut self, relation: Relation, left: u32, right: u32, holds: bool) {
        if let Some(bound) = self.constant(right) {
            let interval = self.interval(left).compared(relation, bound, holds);
            self.intervals.insert(left, interval);
        } else if let Some(bound) = self.constant(left) {
            let interval = self.interval(right).compared_from(bound, relation, holds);
            self.intervals.insert(right, interval);
        }
    }
}

thread_local! {
    static ARENA: RefCell<Arena> = RefCell::default();
}

/// Runs on this thread's arena.
pub fn with_arena<T>(run: impl FnOnce(&mut Arena) -> T) -> T {
    ARENA.with_borrow_mut(run)
}

/// A number of the arena.
#[derive(Clone, Copy, Debug)]
pub struct Symbol(pub u32);

fn operation(
    exact: fn(f64, f64) -> f64,
    term: fn(u32, u32) -> Term,
    a: Symbol,
    b: Symbol,
) -> Symbol {
    with_arena(|arena| match (arena.constant(a.0), arena.constant(b.0)) {
        (Some(a), Some(b)) => arena.nearest(exact(a, b)),
        _ => arena.term(term(a.0, b.0)),
    })
}

impl Add for Symbol {
    type Output = Symbol;
    fn add(self, other: Symbol) -> Symbol {
        operation(|a, b| a + b, Term::Add, self, other)
    }
}

impl Sub for Symbol {
    type Output = Symbol;
    fn sub(self, other: Symbol) -> Symbol {
        operation(|a, b| a - b, Term::Sub, self, other)
    }
}

impl Mul for Symbol {
    type Output = Symbol;
    fn mul(self, other: Symbol) -> Symbol {
        operation(|a, b| a * b, Term::Mul, self, other)
    }
}

impl Neg for Symbol {
    type Output = Symbol;
    fn neg(self) -> Symbol {
        Symbol(with_arena(|arena| arena.negative(self.0)))
    }
}

impl PartialEq for Symbol {
    fn eq(&self, other: &Symbol) -> bool {
        with_arena(|arena| arena.compare(Relation::Equal, self.0, other.0))
    }
}

impl PartialOrd for Symbol {
    fn partial_cmp(&self, other: &Symbol) -> Option<Ordering> {
        if self < other {
            Some(Ordering::Less)
        } else if self > other {
            Some(Ordering::Greater)
        } else if self == other {
            Some(Ordering::Equal)
        } else {
            None
        }
    }

    fn lt(&self, other: &Symbol) -> bool {
        with_arena(|arena| arena.compare(Relation::Less, self.0, other.0))
    }

    fn le(&self, other: &Symbol) -> bool {
        with_arena(|arena| arena.compare(Relation::LessOrEqual, self.0, other.0))
    }

    fn gt(&self, other: &Symbol) -> bool {
        other.lt(self)
    }

    fn ge(&self, other: &Symbol) -> bool {
        other.le(self)
    }
}

impl From<i8> for Symbol {
    fn from(value: i8) -> Symbol {
        Symbol::of(f64::from(value))
    }
}

impl Scalar for Symbol {
    fn of(constant: f64) -> Symbol {
        with_arena(|arena| arena.nearest(constant))
    }
}

/// A quick hash of small numbers.
#[derive(Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }

    fn write_isize(&mut self, value: isize) {
        self.write_u64(value.unsigned_abs() as u64);
    }

    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}

type Fast = BuildHasherDefault<Mixer>;
