//! This file says what a brake of the certificate resists with, and where that cannot be told from the counts.

use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::rad_from_deg;

use crate::number::most;
use crate::plant::backlash::ENTRY_TRAVEL_DEG;
use crate::plant::brake::{Brake, Characteristic, Turn};

/// By which factor the second brake is slower than the first: the greatest that a scenario draws (decision 0125).
pub const SLOWER: f64 = 1.2;
/// Torque that current makes, as a share of that without, from which the place in the backlash matters: below it the whole torque is
/// known within the share that is certified.
const ACTS_SHARE: f64 = 0.1;

/// What is left of a fall without current that is not followed, N·m: a fifth of the last digit printed in table 3.2.
const SETTLED_NM: f64 = 0.002;

/// One brake as it was found, and the same brake slower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    of: Characteristic,
    own: Brake,
    slower: Brake,
    off_nm: f64,
    width_rad: f64,
    /// Where the shaft is, where it last turned back, and the farthest place since, rad.
    at_rad: f64,
    turned_rad: f64,
    farthest_rad: f64,
    sense: f64,
    /// Whether it has once come through its whole backlash: before, nobody knows where in it the shaft is.
    is_known: bool,
}

/// What a brake resists with over a step, N·m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Torque {
    /// All of it.
    pub yield_nm: f64,
    /// What current makes of it.
    pub driven_nm: f64,
    /// How much more it would be, for each share by which the brake is slower.
    pub slowness_nm: f64,
    /// Whether it may be otherwise, because the width of the backlash is known to a share only.
    pub is_open: bool,
}

impl Braking {
    /// A brake without current, its shaft anywhere in its backlash.
    pub fn new(table: &BrakeTable) -> Braking {
        let own = Brake::new(table, 0.0);
        Braking {
            of: Characteristic::new(table),
            own,
            slower: own,
            off_nm: table.torque_gain.off_state_nm(),
            width_rad: rad_from_deg(table.backlash_width_deg),
            at_rad: 0.0,
            turned_rad: 0.0,
            farthest_rad: 0.0,
            sense: 1.0,
            is_known: false,
        }
    }

    /// Torque without current, N·m.
    pub fn off_nm(&self) -> f64 {
        self.off_nm
    }

    /// Goes on over a step at a current, A: the shaft turns by so much, rad, at a rate, rad/s.
    #[inline]
    pub fn step(
        &mut self,
        current_a: f64,
        by_rad: f64,
        speed_rad_s: f64,
        step_s: f64,
        share: f64,
    ) -> Torque {
        let to_rad = self.at_rad + by_rad;
        let left_nm = most(self.own.yield_nm(), self.slower.yield_nm()) - self.off_nm;
        if current_a == 0.0 && left_nm <= SETTLED_NM {
            self.own.rest(&self.of, [self.at_rad, to_rad]);
            self.slower = self.own;
            self.travel(to_rad);
            self.is_near_boundary(share);
            return Torque {
                yield_nm: self.off_nm,
                ..Torque::default()
            };
        }
        let turn = |step_s: f64| Turn {
            way_rad: [self.at_rad, to_rad],
            around_s: [0.0, step_s],
            speed_rad_s,
            step_s,
        };
        // A brake that is slower by a factor does in a step what this one does in a shorter one.
        let (own, slower) = (turn(step_s), turn(step_s * (1.0 / SLOWER)));
        let yield_nm = self.own.step(&self.of, current_a, &own);
        let slower_nm = self.slower.step(&self.of, current_a, &slower);
        self.travel(to_rad);
        let driven_nm = yield_nm - self.off_nm;
        let acts = driven_nm > ACTS_SHARE * self.off_nm || current_a > 0.0;
        Torque {
            yield_nm,
            driven_nm,
            slowness_nm: (slower_nm - yield_nm) * (1.0 / (SLOWER - 1.0)),
            is_open: self.is_near_boundary(share) && acts,
        }
    }

    /// Keeps where the shaft last turned back.
    fn travel(&mut self, to_rad: f64) {
        let beyond = (to_rad - self.farthest_rad) * self.sense;
        if beyond > 0.0 {
            self.farthest_rad = to_rad;
        } else if beyond < -rad_from_deg(ENTRY_TRAVEL_DEG) {
            self.turned_rad = self.farthest_rad;
            self.farthest_rad = to_rad;
            self.sense = -self.sense;
        }
        self.at_rad = to_rad;
    }

    /// Whether the shaft came so far since it turned back that a backlash of another width would have ended, or not.
    fn is_near_boundary(&mut self, share: f64) -> bool {
        let come_rad = (self.at_rad - self.turned_rad).abs();
        let nearest = self.width_rad * (1.0 - share);
        let farthest = self.width_rad * (1.0 + share);
        self.is_known |= come_rad >= farthest;
        ((nearest < come_rad) | !self.is_known) & (come_rad < farthest)
    }

    /// Samples are missing: the shaft may be anywhere in its backlash.
    pub fn lose(&mut self) {
        (self.turned_rad, self.farthest_rad) = (self.at_rad, self.at_rad);
        self.is_known = false;
    }
}
