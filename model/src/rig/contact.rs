//! This file says which brakes hold and which slip, from one event to the next.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use nalgebra::Vector2;

use crate::motion::friction::{DryBrakes, dry_motion};
use crate::motion::two_coordinate::{TwoCoordinate, solve};

/// Part of a brake's bound by which a torque may exceed it through rounding and still be held.
const ROUNDING: f64 = 1e-11;
/// Sine below which two joints turn in proportion and stop together.
const PARALLEL: f64 = 1e-12;

/// What one joint's brake does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// There is no brake.
    Absent,
    /// It holds its joint.
    Held,
    /// It slips; the sign of the joint's rate.
    Slips(f64),
}

/// What the brakes A, E, B, C do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contacts {
    of: [Contact; 4],
    /// Whether the whole linkage stands; else the brakes that hold are parallel.
    rest: bool,
}

/// The forces and accelerations at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// Accelerations of θA and θB, rad/s².
    pub acceleration: Vector2<f64>,
    /// Torques of the brakes on their joints A, E, B, C, N·m.
    pub torques_nm: [f64; 4],
    /// The part of their strength that the holding brakes need; above 1 they let go.
    pub share: f64,
}

impl Contacts {
    /// Brakes at the start of a run: each holds where its joint stands and slips where it turns.
    pub fn starting(brakes: [bool; 4], joint_rates_rad_s: [f64; 4]) -> Contacts {
        let of = [0, 1, 2, 3].map(|i| match (brakes[i], joint_rates_rad_s[i]) {
            (false, _) => Contact::Absent,
            (true, 0.0) => Contact::Held,
            (true, rate) => Contact::Slips(rate.signum()),
        });
        let rest = joint_rates_rad_s == [0.0; 4];
        Contacts { of, rest }
    }

    /// Brakes in the middle of a run: those that are held, and the others as at the start.
    pub fn resumed(brakes: [bool; 4], held: [bool; 4], joint_rates_rad_s: [f64; 4]) -> Contacts {
        let starting = Contacts::starting(brakes, joint_rates_rad_s);
        let of = [0, 1, 2, 3].map(|i| {
            if brakes[i] && held[i] {
                Contact::Held
            } else {
                starting.of[i]
            }
        });
        Contacts { of, ..starting }
    }

    /// The same contacts, with dry friction at a joint that had none.
    pub fn with_dry(self, place: usize, joint_rate_rad_s: f64) -> Contacts {
        let mut of = self.of;
        if of[place] == Contact::Absent {
            let braked = [0, 1, 2, 3].map(|i| i == place);
            of[place] = Contacts::starting(braked, [joint_rate_rad_s; 4]).of[place];
        }
        Contacts { of, ..self }
    }

    /// Which joints have a brake, or dry friction of their own.
    pub fn exist(&self) -> [bool; 4] {
        self.of.map(|contact| contact != Contact::Absent)
    }

    /// What each brake does.
    pub fn of(&self) -> [Contact; 4] {
        self.of
    }

    /// Which joints are held.
    pub fn held(&self) -> [bool; 4] {
        self.of.map(|contact| contact == Contact::Held)
    }

    /// The rates of the joints: exactly zero where held, never against the sign of a slip by rounding.
    pub fn joint_rates(&self, form: &TwoCoordinate, rates: Vector2<f64>) -> [f64; 4] {
        let omega = form.joints * rates;
        [0, 1, 2, 3].map(|i| match self.of[i] {
            Contact::Held => 0.0,
            Contact::Absent => omega[i],
            Contact::Slips(sign) if omega[i] * sign < 0.0 => 0.0,
            Contact::Slips(_) => omega[i],
        })
    }

    /// Forces and accelerations while the contacts last.
    ///
    /// A slipping brake exerts its yield torque against its joint's rate. Brakes that hold while the linkage moves exert
    /// what keeps their joint's acceleration zero; at rest they balance the load, which is `drive` on θA and θB, N·m.
    pub fn balance(
        &self,
        form: &TwoCoordinate,
        drive: Vector2<f64>,
        yields_nm: [f64; 4],
    ) -> Balance {
        if self.rest {
            let hold = dry_brakes(form, yields_nm).hold(&drive);
            return Balance {
                acceleration: Vector2::zeros(),
                torques_nm: hold.torques_nm,
                share: hold.share,
            };
        }
        let mut torques_nm = [0.0; 4];
        let mut load = drive;
        for i in 0..4 {
            if let Contact::Slips(sign) = self.of[i] {
                torques_nm[i] = -sign * yields_nm[i];
                load += row(form, i) * torques_nm[i];
            }
        }
        let free = solve(&form.mass, &load);
        let Some(first) = self.held().iter().position(|&held| held) else {
            return Balance {
                acceleration: free,
                torques_nm,
                share: 0.0,
            };
        };
        let g = row(form, first);
        let yielding = solve(&form.mass, &g);
        let lambda = -(g.dot(&free) + form.joints_bias[first]) / g.dot(&yielding);
        let length = g.norm();
        let strength: f64 = (0..4)
            .filter(|&j| self.of[j] == Contact::Held)
            .map(|j| yields_nm[j] * row(form, j).norm() / length)
            .sum();
        let part = lambda / strength;
        for j in (0..4).filter(|&j| self.of[j] == Contact::Held) {
            torques_nm[j] = part * yields_nm[j] * row(form, j).dot(&g).signum();
        }
        Balance {
            acceleration: free + yielding * lambda,
            torques_nm,
            share: part.abs(),
        }
    }

    /// The rates without what rounding and integration left of the held joints' rates: the nearest by kinetic energy.
    pub fn project(&self, form: &TwoCoordinate, rates: Vector2<f64>) -> Vector2<f64> {
        if self.rest {
            return Vector2::zeros();
        }
        match self.held().iter().position(|&held| held) {
            Some(first) => without(form, row(form, first), rates),
            None => rates,
        }
    }

    /// What the brakes do next, and the rates to go on with: decided where a joint has come to rest, where a held brake is
    /// asked for more than it has, and where the load changed by a step.
    pub fn decide(
        &self,
        form: &TwoCoordinate,
        rates: Vector2<f64>,
        drive: Vector2<f64>,
        yields_nm: [f64; 4],
    ) -> (Contacts, Vector2<f64>) {
        let omega = form.joints * rates;
        let still: Vec<usize> = (0..4)
            .filter(|&i| match self.of[i] {
                Contact::Absent => false,
                Contact::Held => true,
                Contact::Slips(sign) => sign * omega[i] <= 0.0,
            })
            .collect();
        let Some((&first, others)) = still.split_first() else {
            return (*self, rates);
        };
        let g = row(form, first);
        if self.rest || others.iter().any(|&j| !parallel(&g, &row(form, j))) {
            let next = self.leaving_rest(form, drive, yields_nm);
            return (next, Vector2::zeros());
        }
        let mut next = *self;
        for &j in &still {
            next.of[j] = Contact::Held;
        }
        let balance = next.balance(form, drive, yields_nm);
        if balance.share > 1.0 + ROUNDING {
            for &j in &still {
                next.of[j] = Contact::Slips(-balance.torques_nm[j].signum());
            }
        }
        (next, without(form, g, rates))
    }

    /// What the brakes do when the whole linkage has come to rest.
    fn leaving_rest(
        &self,
        form: &TwoCoordinate,
        drive: Vector2<f64>,
        yields_nm: [f64; 4],
    ) -> Contacts {
        let bounds_nm = yields_nm.map(|yield_nm| yield_nm * (1.0 + ROUNDING));
        self.after(form, &drive, bounds_nm).0
    }

    /// What the brakes do and how θA and θB move, where a drive meets dry friction of these bounds.
    pub fn after(
        &self,
        form: &TwoCoordinate,
        drive: &Vector2<f64>,
        bounds: [f64; 4],
    ) -> (Contacts, Vector2<f64>) {
        let next = dry_motion(&form.mass, drive, &dry_brakes(form, bounds));
        let motion = Vector2::from(next.motion);
        let of = [0, 1, 2, 3].map(|i| match self.of[i] {
            Contact::Absent => Contact::Absent,
            _ if next.held[i] => Contact::Held,
            _ => Contact::Slips(row(form, i).dot(&motion).signum()),
        });
        let rest = motion == Vector2::zeros();
        (Contacts { of, rest }, motion)
    }
}

fn dry_brakes(form: &TwoCoordinate, bounds_nm: [f64; 4]) -> DryBrakes {
    DryBrakes {
        rows: form.joints,
        bounds_nm,
    }
}

fn row(form: &TwoCoordinate, i: usize) -> Vector2<f64> {
    form.joints.row(i).transpose()
}

fn parallel(first: &Vector2<f64>, second: &Vector2<f64>) -> bool {
    first.perp(second).abs() <= PARALLEL * first.norm() * second.norm()
}

/// The rates without their part that turns the joint of `g`.
fn without(form: &TwoCoordinate, g: Vector2<f64>, rates: Vector2<f64>) -> Vector2<f64> {
    let yielding = solve(&form.mass, &g);
    rates - yielding * (g.dot(&rates) / g.dot(&yielding))
}
