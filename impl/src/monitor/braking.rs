//! This file says what a brake of the certificate resists with, and where that cannot be told from the counts.

use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::rad_from_deg;

use crate::number::{Scalar, least, most};
use crate::plant::backlash::ENTRY_TRAVEL_DEG;
use crate::plant::brake::{Brake, Characteristic, Turn};

/// Torque that current makes, as a share of that without, from which the place in the backlash matters: below it the whole torque is
/// known within the share that is certified.
const ACTS_SHARE: f64 = 0.1;

/// Distance from where a torque goes below which its course says no time constant, N·m.
const LEAST_COURSE_NM: f64 = 1e-9;

/// What is left of a fall without current that is not followed, N·m: a fifth of the last digit printed in table 3.2.
const SETTLED_NM: f64 = 0.002;

/// How far an angle may be off by rounding, rad.
const ROUNDING_RAD: f64 = 1e-12;

/// One brake as it was found, and how its torque would differ if it were slower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    of: Characteristic,
    own: Brake,
    slower: Slower,
    off_nm: f64,
    /// Widths of the narrowest and the widest backlash that is certified, and way from an end that counts as being there, rad.
    widths_rad: [f64; 2],
    entries_rad: [f64; 2],
    /// Where the shaft is, and between which places it was since it was last lost, rad.
    at_rad: f64,
    been_rad: [f64; 2],
    /// Lower ends of both backlashes, each pushed along by the shaft, rad. What turns back within a backlash leaves it where its end is, not
    /// a width from where it turned.
    ends_rad: [f64; 2],
}

/// How much more torque a brake would have for each share by which its time constant a were longer: s = ∂y/∂(ln a) of its course
/// a·dy/dt = T − y, so that a·ds/dt = y − T − s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Slower {
    by_nm: f64,
    /// Shares of a distance from the target that are left after the last step, and in its mean.
    left: f64,
    mean: f64,
}

impl Slower {
    /// Goes on by a step, of the distances from the target before it, in its mean and after it, N·m; returns the mean of s, N·m.
    #[inline(always)]
    fn step(&mut self, [before_nm, mean_nm, after_nm]: [f64; 3]) -> f64 {
        if before_nm.magnitude() > LEAST_COURSE_NM {
            let inverse = 1.0 / before_nm;
            self.left = most(0.0, least(1.0, after_nm * inverse));
            self.mean = most(self.left, least(1.0, mean_nm * inverse));
        }
        let Slower { by_nm, left, mean } = *self;
        // With the exponent e = h/a, what is left is exp(−e) and the mean (1 − exp(−e))/e.
        let exponent = if mean > 0.0 { (1.0 - left) / mean } else { 0.0 };
        self.by_nm = left * (by_nm + before_nm * exponent);
        by_nm * mean + before_nm * (mean - left)
    }
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
    /// A brake without current, its shaft anywhere in its backlash, whose width is known to a share.
    pub fn new(table: &BrakeTable, share: f64) -> Braking {
        let own = Brake::new(table, 0.0);
        let width_rad = rad_from_deg(table.backlash_width_deg);
        Braking {
            of: Characteristic::new(table),
            own,
            slower: Slower::default(),
            off_nm: table.torque_gain.off_state_nm(),
            widths_rad: [1.0 - share, 1.0 + share].map(|own| own * width_rad),
            // Between an end and the entry after it a shaft may be either, so that only the narrowest counts as left there.
            entries_rad: [rad_from_deg(ENTRY_TRAVEL_DEG), ROUNDING_RAD],
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
    pub fn step(&mut self, current_a: f64, by_rad: f64, speed_rad_s: f64, step_s: f64) -> Torque {
        let to_rad = self.at_rad + by_rad;
        let before_nm = self.own.yield_nm();
        let left_nm = most(before_nm - self.off_nm, self.slower.by_nm.magnitude());
        if current_a == 0.0 && left_nm <= SETTLED_NM {
            self.own.rest(&self.of, [self.at_rad, to_rad]);
            self.slower = Slower::default();
            self.travel(to_rad);
            return Torque {
                yield_nm: self.off_nm,
                ..Torque::default()
            };
        }
        let turn = Turn {
            way_rad: [self.at_rad, to_rad],
            around_s: [0.0, step_s],
            speed_rad_s,
            step_s,
        };
        let yield_nm = self.own.step(&self.of, current_a, &turn);
        let inside = self.own.backlash().is_inside();
        let target_nm = self.of.target_nm(inside, current_a);
        let course = [before_nm, yield_nm, self.own.yield_nm()].map(|own| own - target_nm);
        let slowness_nm = self.slower.step(course);
        let is_near = self.travel(to_rad);
        let driven_nm = yield_nm - self.off_nm;
        let acts = driven_nm > ACTS_SHARE * self.off_nm || current_a > 0.0;
        Torque {
            yield_nm,
            driven_nm,
            slowness_nm,
            is_open: is_near && acts,
        }
    }

    /// Pushes the ends of the backlash along. Returns whether a backlash of another width would be left where this one is not: the
    /// narrowest is, as every one is that the widest has pushed, and the widest is not. Before the shaft has come through the widest
    /// nobody knows.
    fn travel(&mut self, to_rad: f64) -> bool {
        self.at_rad = to_rad;
        let [low, high] = self.been_rad;
        let (low, high) = (least(low, to_rad), most(high, to_rad));
        self.been_rad = [low, high];
        let pushes = |end: &mut f64, width_rad: f64, entry_rad: f64| {
            *end = most(to_rad - width_rad, least(*end, to_rad));
            let come_rad = to_rad - *end;
            (come_rad <= entry_rad) | (width_rad - come_rad <= entry_rad)
        };
        let [narrow, wide] = &mut self.ends_rad;
        let ([narrowest_rad, widest_rad], [entry_rad, left_rad]) =
            (self.widths_rad, self.entries_rad);
        let by_narrow = pushes(narrow, narrowest_rad, entry_rad);
        let by_wide = pushes(wide, widest_rad, left_rad);
        let is_known = high - low >= widest_rad;
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
    fn the_slowness_is_the_difference_to_a_slower_brake() {
        let table = brake_table(Joint::E);
        let of = Characteristic::new(&table);
        let (mut braking, slower_by) = (Braking::new(&table, 0.35), 1e-4);
        let mut slower = Brake::new(&table, 0.0);
        let (mut worst, mut greatest, mut at_rad) = (0.0_f64, 0.0_f64, 0.0);
        for sample in 0..6000_u32 {
            // Steps up and down between currents, the shaft turning one way.
            let current_a = [0.0, 0.31, 0.83, 0.12][sample as usize / 70 % 4];
            let (from_rad, step_s) = (at_rad, 1e-3);
            at_rad += 7e-4;
            let torque = braking.step(current_a, 7e-4, 0.7, step_s);
            let of_slower = step_s / (1.0 + slower_by);
            let turn = Turn {
                way_rad: [from_rad, at_rad],
                around_s: [0.0, of_slower],
                speed_rad_s: 0.7,
                step_s: of_slower,
            };
            let yield_nm = slower.step(&of, current_a, &turn);
            let expected_nm = (yield_nm - torque.yield_nm) / slower_by;
            // The moment of a crossing is scaled with the step of the slower one; a fall that is over is not followed to its end.
            if sample > 200 && torque.driven_nm > 0.0 {
                worst = worst.max((torque.slowness_nm - expected_nm).abs());
                greatest = greatest.max(expected_nm.abs());
            }
        }
        assert!(
            greatest > 1.0 && worst < 0.01 * greatest,
            "{worst} of {greatest}"
        );
    }

    #[test]
    fn what_is_told_of_a_backlash_holds_for_every_width() {
        let table = brake_table(Joint::E);
        let mut braking = Braking::new(&table, 0.35);
        let mut widths =
            [0.7, 0.85, 1.0, 1.3].map(|share| Backlash::new(share * table.backlash_width_deg, 0.0));
        let (mut open, mut inside, mut outside) = (0, 0, 0);
        for sample in 1..200_000 {
            let (from_rad, to_rad) = (shaft_rad(sample - 1), shaft_rad(sample));
            for backlash in &mut widths {
                backlash.turn(from_rad, to_rad);
            }
            if braking.travel(to_rad) {
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
