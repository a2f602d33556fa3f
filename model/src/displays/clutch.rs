//! This file says how much torque a commanded clutch or brake can resist with: its delay, its response, its two frictions.

use std::collections::VecDeque;

use rigproof_spec::displays::ClutchFigures;

/// A friction clutch or a brake that follows its command late.
#[derive(Clone, Debug, PartialEq)]
pub struct Clutch {
    figures: ClutchFigures,
    /// Commands on their way, the oldest first, each with the time it has still to wait, s.
    waiting: VecDeque<(f64, f64)>,
    /// What arrived last, N·m.
    commanded_nm: f64,
    level_nm: f64,
}

impl Clutch {
    /// A clutch that was never commanded.
    pub const fn new(figures: ClutchFigures) -> Clutch {
        Clutch {
            figures,
            waiting: VecDeque::new(),
            commanded_nm: 0.0,
            level_nm: 0.0,
        }
    }

    /// Asks for a torque, N·m; what is beyond its strength asks for that.
    pub fn command(&mut self, torque_nm: f64) {
        let torque_nm = torque_nm.clamp(0.0, self.figures.static_nm);
        self.waiting.push_back((self.figures.delay_s, torque_nm));
    }

    /// Lets time pass: commands arrive after the delay, the torque follows as a first-order lag.
    pub fn pass(&mut self, step_s: f64) {
        for (wait_s, _) in &mut self.waiting {
            *wait_s -= step_s;
        }
        // Half a step: a sum of steps need not be the delay to the last digit.
        while let Some((wait_s, torque_nm)) = self.waiting.front().copied() {
            if wait_s > 0.5 * step_s {
                break;
            }
            self.commanded_nm = torque_nm;
            self.waiting.pop_front();
        }
        let part = -libm::expm1(-step_s / self.figures.response_s);
        self.level_nm += (self.commanded_nm - self.level_nm) * part;
    }

    /// The torque that it can resist with at a rate of slip, rad/s: static at rest, kinetic from a small rate on, N·m.
    ///
    /// "The friction material has a higher kinetic coefficient of friction than static" (chapter 1).
    pub fn bound_nm(&self, slip_rad_s: f64) -> f64 {
        let part = (slip_rad_s.abs() / self.figures.kinetic_from_rad_s).min(1.0);
        self.level_nm * (1.0 + (self.figures.kinetic_over_static - 1.0) * part)
    }

    /// Whether it has as good as its full static torque.
    pub fn is_locked(&self) -> bool {
        self.level_nm > 0.95 * self.figures.static_nm
    }

    /// Its greatest static torque, N·m.
    pub const fn strength_nm(&self) -> f64 {
        self.figures.static_nm
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::displays::PTER_CLUTCH;

    #[test]
    fn a_clutch_waits_then_rises_and_resists_more_once_it_slips() {
        let mut clutch = Clutch::new(PTER_CLUTCH);
        clutch.command(3.1);
        for _ in 0..195 {
            clutch.pass(1e-4);
        }
        assert_eq!(clutch.bound_nm(0.0), 0.0);
        for _ in 0..505 {
            clutch.pass(1e-4);
        }
        let risen = clutch.bound_nm(0.0) / 3.1;
        assert!((risen - (1.0 - libm::exp(-1.0))).abs() < 0.01, "{risen}");
        let slipping = clutch.bound_nm(-0.31) / clutch.bound_nm(0.0);
        assert!((slipping - PTER_CLUTCH.kinetic_over_static).abs() < 1e-12);
        assert!(!clutch.is_locked());
    }
}
