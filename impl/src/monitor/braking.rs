//! This file says what a brake of the certificate resists with, and where that cannot be told from the counts.

use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::rad_from_deg;

use crate::number::{least, most};
use crate::plant::backlash::ENTRY_TRAVEL_DEG;
use crate::plant::brake::{Brake, Characteristic, Turn};

/// By which factor the second brake is slower than the first: the greatest that a scenario draws (decision 0125).
pub const SLOWER: f64 = 1.2;
/// Torque that current makes, as a share of that without, from which the place in the backlash matters: below it the whole torque is
/// known within the share that is certified.
const ACTS_SHARE: f64 = 0.1;

/// What is left of a fall without current that is not followed, N·m: a fifth of the last digit printed in table 3.2.
const SETTLED_NM: f64 = 0.002;

/// How far an angle may be off by rounding, rad.
const ROUNDING_RAD: f64 = 1e-12;

/// One brake as it was found, and the same brake slower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    of: Characteristic,
    own: Brake,
    slower: Brake,
    off_nm: f64,
    width_rad: f64,
    /// Where the shaft is, and between which places it was since it was last lost, rad.
    at_rad: f64,
    been_rad: [f64; 2],
    /// Lower ends of the narrowest and the widest backlash that is certified, each pushed along by the shaft, rad. What turns back within
    /// a backlash leaves it where its end is, not a width from where it turned.
    ends_rad: [f64; 2],
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
            been_rad: [0.0; 2],
            ends_rad: [0.0; 2],
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
            self.travel(to_rad, share);
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
        let is_near = self.travel(to_rad, share);
        let driven_nm = yield_nm - self.off_nm;
        let acts = driven_nm > ACTS_SHARE * self.off_nm || current_a > 0.0;
        Torque {
            yield_nm,
            driven_nm,
            slowness_nm: (slower_nm - yield_nm) * (1.0 / (SLOWER - 1.0)),
            is_open: is_near && acts,
        }
    }

    /// Pushes the ends of the backlash along. Returns whether a backlash of another width would be left where this one is not: the
    /// narrowest is, as every one is that the widest has pushed, and the widest is not. Before the shaft has come through the widest
    /// nobody knows.
    fn travel(&mut self, to_rad: f64, share: f64) -> bool {
        self.at_rad = to_rad;
        let [low, high] = self.been_rad;
        let (low, high) = (least(low, to_rad), most(high, to_rad));
        self.been_rad = [low, high];
        let pushes = |end: &mut f64, share: f64, entry_rad: f64| {
            let width_rad = self.width_rad * share;
            *end = most(to_rad - width_rad, least(*end, to_rad));
            let come_rad = to_rad - *end;
            (come_rad <= entry_rad) | (width_rad - come_rad <= entry_rad)
        };
        let [narrow, wide] = &mut self.ends_rad;
        // Between an end and the entry after it a shaft may be either, so that only the narrowest counts as left there.
        let by_narrow = pushes(narrow, 1.0 - share, rad_from_deg(ENTRY_TRAVEL_DEG));
        let by_wide = pushes(wide, 1.0 + share, ROUNDING_RAD);
        let is_known = high - low >= self.width_rad * (1.0 + share);
        !is_known | (by_narrow & !by_wide)
    }

    /// Samples are missing: the shaft may be anywhere in its backlash.
    pub fn lose(&mut self) {
        self.been_rad = [self.at_rad; 2];
    }
}

#[cfg(test)]
mod tests {
    use rigproof_spec::tables::brake_table;

    use super::*;
    use crate::plant::backlash::Backlash;
    use rigproof_spec::joint::Joint;

    /// A shaft that turns back anywhere, within its backlash too: three sines whose periods have no common multiple.
    fn shaft_rad(sample: u32) -> f64 {
        let time = f64::from(sample) * 0.01;
        0.02 * libm::sin(time) + 0.012 * libm::sin(2.71 * time) + 0.008 * libm::sin(7.3 * time)
    }

    #[test]
    fn what_is_told_of_a_backlash_holds_for_every_width() {
        let table = brake_table(Joint::E);
        let mut braking = Braking::new(&table);
        let mut widths =
            [0.7, 0.85, 1.0, 1.3].map(|share| Backlash::new(share * table.backlash_width_deg, 0.0));
        let (mut open, mut inside, mut outside) = (0, 0, 0);
        for sample in 1..200_000 {
            let (from_rad, to_rad) = (shaft_rad(sample - 1), shaft_rad(sample));
            for backlash in &mut widths {
                backlash.turn(from_rad, to_rad);
            }
            if braking.travel(to_rad, 0.35) {
                open += 1;
                continue;
            }
            let told = widths.map(|backlash| backlash.is_inside());
            assert_eq!(told, [told[0]; 4], "sample {sample}");
            *(if told[0] { &mut inside } else { &mut outside }) += 1;
        }
        // Much can be told, of either kind.
        assert!(
            open > 10_000 && inside > 10_000 && outside > 10_000,
            "{open} {inside} {outside}"
        );
    }
}
