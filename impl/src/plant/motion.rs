//! This file moves the linkage over one step: halfway on the old rates, the forces there, the rest on the new rates.

use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use super::form::{Bodies, Form, form};
use super::turn::{GREATEST_TURN_RAD, renormalised, turned};
use crate::linkage::{Linkage, Shape, linkage};
use crate::number::Real;
use crate::vector::Vector;

/// Longest step, s.
pub const GREATEST_STEP_S: f64 = 0.01;
/// Greatest force on the tip in each direction, N: beyond it nothing of this rig lies.
pub const GREATEST_FORCE_N: f64 = 1e6;

/// What a step came to. On anything but [`Outcome::Moved`] the state is as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// The rig moved on.
    Moved,
    /// The linkage was driven into a singularity or out of its assembly.
    Singular,
    /// An arm would turn by more than [`GREATEST_TURN_RAD`] in one half of the step.
    TooFast,
    /// Force, currents or step are no numbers of this rig.
    Undefined,
}

/// What stands against a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Checks {
    /// Force or step are no numbers of this rig.
    pub undefined: bool,
    /// An arm would turn too far.
    pub too_fast: bool,
    /// The linkage would not be sound.
    pub singular: bool,
}

impl Checks {
    /// What the step comes to.
    pub fn outcome(self) -> Outcome {
        if self.undefined {
            Outcome::Undefined
        } else if self.too_fast {
            Outcome::TooFast
        } else if self.singular {
            Outcome::Singular
        } else {
            Outcome::Moved
        }
    }
}

/// Where in a step the forces are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// In the middle (Moreau 1988): order 2 with one evaluation a step.
    #[default]
    Midpoint,
    /// At the start, the new rates moving the whole step: order 1, the simplest rule that the text of §5.3 allows.
    SemiImplicitEuler,
}

impl Scheme {
    /// The part of the step before the forces are looked at.
    #[inline(always)]
    pub fn lead<R: Real>(self) -> R {
        match self {
            Scheme::Midpoint => R::of(0.5),
            Scheme::SemiImplicitEuler => R::zero(),
        }
    }
}

/// What the moving parts are, computed once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mechanism<R> {
    /// The arms' lengths.
    pub shape: Shape<R>,
    /// Their masses.
    pub bodies: Bodies<R>,
    /// Where in a step the forces are looked at.
    pub scheme: Scheme,
}

impl<R: Real> Mechanism<R> {
    /// The mechanism of arms and masses.
    pub fn new(arms: &Arms, inertia: &Inertia, scheme: Scheme) -> Mechanism<R> {
        Mechanism {
            shape: Shape::new(arms),
            bodies: Bodies::new(arms, inertia),
            scheme,
        }
    }
}

/// Where the linkage is and how it moves.
///
/// The directions of the base arms are kept beside their angles and turned with them, so that no step computes a sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<R> {
    /// θA and θB, rad.
    pub theta_rad: Vector<R>,
    /// Their rates, rad/s.
    pub rates_rad_s: Vector<R>,
    /// Their last accelerations, rad/s², by which the rates halfway are foreseen.
    pub accelerations_rad_s2: Vector<R>,
    /// Direction of AE.
    pub ae: Vector<R>,
    /// Direction of BC.
    pub bc: Vector<R>,
    /// The linkage there.
    pub linkage: Linkage<R>,
}

/// A step at the moment at which forces are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Midway<R> {
    /// θA and θB, rad.
    pub theta_rad: Vector<R>,
    ae: Vector<R>,
    bc: Vector<R>,
    /// How long after the start of the step, s.
    pub lead_s: R,
    /// The linkage then.
    pub linkage: Linkage<R>,
    /// The rates foreseen for then, rad/s.
    pub rates_rad_s: Vector<R>,
    /// The form of the motion then.
    pub form: Form<R>,
    /// M·v, N·m·s.
    pub momentum_nm_s: Vector<R>,
    /// Tᵀ·F − b, N·m.
    pub load_nm: Vector<R>,
}

impl<R: Real> Motion<R> {
    /// At rest or in motion at two base angles; `None` where the linkage is not sound.
    pub fn new(
        mechanism: &Mechanism<R>,
        theta_rad: Vector<R>,
        rates_rad_s: Vector<R>,
    ) -> Option<Motion<R>> {
        let unit = |angle: R| {
            let (sine, cosine) = angle.sine_cosine();
            Vector::new(cosine, sine)
        };
        let (ae, bc) = (unit(theta_rad.x), unit(theta_rad.y));
        let linkage = linkage(&mechanism.shape, ae, bc);
        let sound = linkage.is_sound(&mechanism.shape) && rates_rad_s.is_finite();
        sound.then_some(Motion {
            theta_rad,
            rates_rad_s,
            accelerations_rad_s2: Vector::zero(),
            ae,
            bc,
            linkage,
        })
    }

    /// The first part of a step under a force on the tip, N.
    #[inline(always)]
    pub fn midway(&self, mechanism: &Mechanism<R>, force_n: Vector<R>, step_s: R) -> Midway<R> {
        let lead_s = step_s * mechanism.scheme.lead();
        let angles = self.rates_rad_s * lead_s;
        let (ae, bc) = (turned(self.ae, angles.x), turned(self.bc, angles.y));
        let linkage = linkage(&mechanism.shape, ae, bc);
        let rates_rad_s = self.rates_rad_s + self.accelerations_rad_s2 * lead_s;
        let form = form(&mechanism.bodies, &linkage, rates_rad_s);
        let load_nm = form.tip_load(&linkage, force_n) - form.bias_nm;
        Midway {
            theta_rad: self.theta_rad + angles,
            ae,
            bc,
            lead_s,
            linkage,
            rates_rad_s,
            form,
            momentum_nm_s: form.mass.times(self.rates_rad_s),
            load_nm,
        }
    }

    /// The second part, at new rates, rad/s.
    #[inline(always)]
    pub fn arrive(
        &self,
        mechanism: &Mechanism<R>,
        midway: &Midway<R>,
        rates_rad_s: Vector<R>,
        step_s: R,
    ) -> Motion<R> {
        let angles = rates_rad_s * (step_s - midway.lead_s);
        let ae = renormalised(turned(midway.ae, angles.x));
        let bc = renormalised(turned(midway.bc, angles.y));
        Motion {
            theta_rad: midway.theta_rad + angles,
            rates_rad_s,
            accelerations_rad_s2: (rates_rad_s - self.rates_rad_s) * (R::of(1.0) / step_s),
            ae,
            bc,
            linkage: linkage(&mechanism.shape, ae, bc),
        }
    }

    /// Whether rates turn both base arms by no more in a time than can be computed.
    #[inline(always)]
    pub fn is_slow(rates_rad_s: Vector<R>, time_s: R) -> bool {
        let greatest = R::of(GREATEST_TURN_RAD);
        (rates_rad_s.x * time_s).is_within(greatest) & (rates_rad_s.y * time_s).is_within(greatest)
    }

    /// One step without brakes or other physics.
    #[inline]
    pub fn step_free(
        &mut self,
        mechanism: &Mechanism<R>,
        force_n: Vector<R>,
        step_s: R,
    ) -> Outcome {
        let (next, checks) = self.after_free(mechanism, force_n, step_s);
        let outcome = checks.outcome();
        if outcome == Outcome::Moved {
            *self = next;
        }
        outcome
    }

    /// Where a step without brakes leads, and whether it may be taken. Without a branch, so that rigs can go side by side.
    #[inline(always)]
    pub fn after_free(
        &self,
        mechanism: &Mechanism<R>,
        force_n: Vector<R>,
        step_s: R,
    ) -> (Motion<R>, Checks) {
        let midway = self.midway(mechanism, force_n, step_s);
        let momentum_nm_s = midway.momentum_nm_s + midway.load_nm * step_s;
        let rates_rad_s = midway.form.mass.solve(momentum_nm_s);
        let next = self.arrive(mechanism, &midway, rates_rad_s, step_s);
        let first = self.checks(mechanism, &midway.linkage, midway.lead_s);
        let second = next.checks(mechanism, &next.linkage, step_s - midway.lead_s);
        let checks = Checks {
            undefined: !is_defined(force_n, step_s),
            // Rates that come out of an unsound linkage say nothing.
            too_fast: first.too_fast | (!first.singular & second.too_fast),
            singular: first.singular | second.singular,
        };
        (next, checks)
    }

    /// Whether the rates here may turn the arms for a time, and whether a linkage may be used.
    #[inline(always)]
    pub fn checks(&self, mechanism: &Mechanism<R>, linkage: &Linkage<R>, time_s: R) -> Checks {
        Checks {
            undefined: false,
            too_fast: !Motion::is_slow(self.rates_rad_s, time_s),
            singular: !linkage.is_sound(&mechanism.shape),
        }
    }
}

/// Whether force and step are numbers of this rig.
#[inline(always)]
pub fn is_defined<R: Real>(force_n: Vector<R>, step_s: R) -> bool {
    let greatest_n = R::of(GREATEST_FORCE_N);
    force_n.x.is_within(greatest_n)
        & force_n.y.is_within(greatest_n)
        & (step_s > R::zero())
        & (step_s <= R::of(GREATEST_STEP_S))
}
