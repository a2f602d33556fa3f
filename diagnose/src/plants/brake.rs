//! This file computes how a brake's yield torque along a recorded motion changes when its brake law
//! differs from the nominal one.

use crate::problem::less;
use crate::signals::{shifted, through_play};
use rigproof_model::brake::{Brake, Characteristic, slowed};
use rigproof_model::effects::{CurrentPlay, Instant, OfBrake, bent_command, limited, slower};
use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::RAD_PER_DEG;

/// What a nominal brake computes from its current.
#[derive(Clone, Copy)]
#[expect(
    clippy::large_enum_variant,
    reason = "it lives for the length of a call"
)]
pub enum BrakeLaw<'a> {
    /// The thesis's equations, with the numbers of a table.
    Thesis(BrakeTable),
    /// A static characteristic. The current is then whatever its command is.
    Characteristic(&'a Characteristic),
}

/// A brake along a recorded motion under its recorded current.
#[derive(Clone, Copy)]
pub struct Braked<'a> {
    pub law: BrakeLaw<'a>,
    /// The motion of its joint.
    pub motion: &'a [Instant],
    /// The current of each sample, A.
    pub current: &'a [f64],
    /// Whether the current holds its value until the next sample. Otherwise it is interpolated
    /// linearly.
    pub held: bool,
    /// Sample interval, s.
    pub step_s: f64,
    /// Of a static sweep, where each sample stood in it. Everything has settled at each of them.
    pub rows: Option<&'a [usize]>,
}

impl Braked<'_> {
    /// The yield torque of each sample, N·m.
    pub fn yields(&self) -> Vec<f64> {
        match self.law {
            BrakeLaw::Thesis(table) => {
                let start = self.motion.first().map_or(0.0, |now| now.position);
                self.yields_of(Brake::of(table, start))
            }
            BrakeLaw::Characteristic(own) => self.follows(own),
        }
    }

    /// The yield torque of each sample for a given initial state of the brake, N·m.
    pub fn yields_of(&self, mut brake: Brake) -> Vec<f64> {
        let mut own = vec![brake.yield_torque()];
        for (acting, now) in self.acting().zip(self.motion.iter().skip(1)) {
            brake.step(acting, now.position, now.speed, self.step_s);
            own.push(brake.yield_torque());
        }
        own
    }

    /// The effort of each sample by a characteristic, settled at the first.
    fn follows(&self, law: &Characteristic) -> Vec<f64> {
        let Some(first) = self.current.first() else {
            return Vec::new();
        };
        let mut effort = law.settled(*first);
        let next = self.acting().map(|acting| {
            effort = law.next(effort, acting, self.step_s);
            effort
        });
        [law.settled(*first)].into_iter().chain(next).collect()
    }

    /// The current that acts between each sample and the next, A.
    fn acting(&self) -> impl Iterator<Item = f64> {
        let currents = self.current.iter().zip(self.current.iter().skip(1));
        currents.map(|(before, current)| match (self.rows, self.held) {
            (Some(_), _) => *current,
            (None, true) => *before,
            (None, false) => 0.5 * (before + current),
        })
    }

    /// What a current becomes by its past: that of a static sweep goes row by row.
    fn in_order(&self, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
        let Some(rows) = self.rows else {
            return of(self.current);
        };
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by_key(|sample| rows.get(*sample));
        let at = |sample: &usize| self.current.get(*sample).copied().unwrap_or(0.0);
        let changed = of(&order.iter().map(at).collect::<Vec<f64>>());
        let mut own = self.current.to_vec();
        for (sample, changed) in order.into_iter().zip(changed) {
            if let Some(own) = own.get_mut(sample) {
                *own = changed;
            }
        }
        own
    }

    /// The change that a mechanism makes to the yield torque `own`, N·m.
    ///
    /// For a mechanism with a linear coefficient it is the change per unit of that coefficient.
    pub fn change(&self, own: &[f64], kind: OfBrake, shape: &[f64]) -> Option<Vec<f64>> {
        let value = *shape.first()?;
        let given = |current: &[f64]| less(&Braked { current, ..*self }.yields(), own);
        let built = |law: BrakeLaw| less(&Braked { law, ..*self }.yields(), own);
        let each = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let current = self.current.iter();
            given(&current.map(|i| of(*i)).collect::<Vec<_>>())
        };
        Some(match kind {
            OfBrake::DeadTime => given(&shifted(self.current, -value / self.step_s)),
            OfBrake::Saturation => each(&|current| limited(current, shape)),
            OfBrake::CurrentGain => each(&|current| value * current),
            OfBrake::CommandExponent => each(&|command| bent_command(command, shape)),
            OfBrake::TimeConstant => match self.law {
                BrakeLaw::Thesis(table) => built(BrakeLaw::Thesis(slowed(table, slower(shape)))),
                BrakeLaw::Characteristic(law) => {
                    built(BrakeLaw::Characteristic(&law.slowed(slower(shape))))
                }
            },
            OfBrake::BacklashWidth => match self.law {
                BrakeLaw::Thesis(table) => built(BrakeLaw::Thesis(BrakeTable {
                    backlash_width_deg: value / RAD_PER_DEG,
                    ..table
                })),
                BrakeLaw::Characteristic(_) => return None,
            },
            OfBrake::CurrentHysteresis => {
                let number = |place: usize| shape.get(place).copied().unwrap_or(0.0);
                let play = CurrentPlay {
                    half_width_a: value,
                    closing_a: number(2),
                    spread: number(3),
                    top_a: number(4),
                };
                given(&self.in_order(|current| through_play(current, play, number(1))))
            }
            OfBrake::ThermalFade => self.faded(own, value),
        })
    }

    /// The yield torque lost per unit of fade. The heat decays with the time constant `time_s`.
    fn faded(&self, own: &[f64], time_s: f64) -> Vec<f64> {
        let mut heat_j = 0.0;
        let pairs = own.iter().zip(self.motion);
        let fade = pairs.map(|(torque, now)| {
            let lost = torque * heat_j;
            heat_j += self.step_s * (torque * now.speed.abs() - heat_j / time_s);
            -lost
        });
        fade.collect()
    }
}
