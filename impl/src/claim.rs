//! This file says how a claim about this room's code is written, once, for every engine that can examine it.
//!
//! A claim is a function over a [`Checker`]. A sampler hands it numbers, a symbolic engine hands it terms, Kani hands it anything. It is not
//! built for the rig: the feature `claims` or Kani asks for it.

use crate::number::Scalar;

/// What a claim asks of the engine that examines it.
pub trait Checker {
    /// The numbers the claim is about.
    type Number: Scalar + From<i8>;

    /// Any number: infinite and undefined ones too.
    fn scalar(&mut self) -> Self::Number;

    /// The greatest finite number.
    fn greatest(&self) -> Self::Number;

    /// Any whole number below `count`.
    fn choice(&mut self, count: u8) -> u8;

    /// Goes on only where this holds.
    fn assume(&mut self, condition: bool) -> Held;

    /// What has to hold here; where it does not, the claim is refuted.
    fn check(&mut self, condition: bool) -> Held;

    /// A class of inputs that has to occur, or the claim is empty. Stands outside every branch.
    fn cover(&mut self, class: &'static str, condition: bool);
}

/// `None` ends an examination: what was assumed or checked did not hold.
pub type Held = Option<()>;

/// What a claim is about, and so which engines can settle it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Choices only: enumeration is complete.
    Finite,
    /// Numbers: a solver can settle it, a sampler can only test it.
    Numbers,
    /// Numbers too, but beyond the solver; the statement says why.
    Sampled,
}

/// A claim in the hands of an engine.
#[derive(Clone, Copy)]
pub struct Claim<C> {
    /// The claim.
    pub name: &'static str,
    /// What it says, its source and what it assumes.
    pub statement: &'static str,
    /// What it is about.
    pub domain: Domain,
    /// The claim itself.
    pub body: fn(&mut C) -> Held,
}

/// Claims, each with its statement as documentation, and the Kani harness of each.
#[macro_export]
macro_rules! claims {
    ($($(#[doc = $line:literal])+ $domain:ident fn $name:ident($checker:ident) $body:block)+) => {
        $(
            $(#[doc = $line])+
            #[doc = ""]
            #[doc = "# Errors"]
            #[doc = "`None` where an assumption or the claim does not hold."]
            pub fn $name<C: $crate::claim::Checker>($checker: &mut C) -> $crate::claim::Held {
                $body
                Some(())
            }
        )+

        /// The claims of this file.
        pub fn claims<C: $crate::claim::Checker>() -> impl IntoIterator<Item = $crate::claim::Claim<C>> {
            [$($crate::claim::Claim {
                name: stringify!($name),
                statement: concat!($($line),+),
                domain: $crate::claim::Domain::$domain,
                body: $name::<C>,
            }),+]
        }

        #[cfg(kani)]
        mod harnesses {
            $crate::harnesses!(double f64 $($name)+);
            $crate::harnesses!(single f32 $($name)+);
        }
    };
}

/// The Kani harness of each claim, on numbers of one width.
#[cfg(kani)]
#[macro_export]
macro_rules! harnesses {
    ($width:ident $number:ident $($name:ident)+) => {
        mod $width {
            $(
                #[cfg_attr(not(kani_shim), kani::proof, kani::unwind(5))]
                #[cfg_attr(kani_shim, allow(dead_code))]
                fn $name() {
                    let mut kani = $crate::claim::kani_engine::Kani::<$number>::default();
                    let _ = super::super::$name(&mut kani);
                }
            )+
        }
    };
}

/// Kani as an engine.
#[cfg(kani)]
pub mod kani_engine {
    use core::marker::PhantomData;

    use super::{Checker, Held};
    use crate::number::Scalar;
    #[cfg(kani_shim)]
    use shim as kani;

    /// Any input, all at once, on numbers of one width.
    #[derive(Default)]
    pub struct Kani<S>(PhantomData<S>);

    /// What both widths have.
    pub trait Width: Scalar + From<i8> {
        /// Any number.
        fn any() -> Self;
        /// The greatest finite one.
        const GREATEST: Self;
    }

    impl Width for f64 {
        fn any() -> f64 {
            kani::any()
        }

        const GREATEST: f64 = f64::MAX;
    }

    impl Width for f32 {
        fn any() -> f32 {
            kani::any()
        }

        const GREATEST: f32 = f32::MAX;
    }

    impl<S: Width> Checker for Kani<S> {
        type Number = S;

        fn scalar(&mut self) -> S {
            S::any()
        }

        fn greatest(&self) -> S {
            S::GREATEST
        }

        fn choice(&mut self, count: u8) -> u8 {
            let any = kani::any();
            kani::assume(any < count);
            any
        }

        fn assume(&mut self, condition: bool) -> Held {
            kani::assume(condition);
            Some(())
        }

        fn check(&mut self, condition: bool) -> Held {
            assert!(condition);
            Some(())
        }

        fn cover(&mut self, class: &'static str, condition: bool) {
            let _ = class;
            kani::cover!(condition);
        }
    }

    /// The types of Kani's own functions, so that harnesses can be type-checked where Kani is not.
    #[cfg(kani_shim)]
    mod shim {
        pub(super) fn any<T: Default>() -> T {
            T::default()
        }

        pub(super) fn assume(_: bool) {}

        macro_rules! cover {
            ($condition:expr) => {
                let _: bool = $condition;
            };
        }
        pub(super) use cover;
    }
}
