//! This file says what the sensors tell of the plant, faults and all.

use rigproof_impl::plant::Plant;
use rigproof_impl::tick::Sensed;
use rigproof_impl::vector::Vector;
use rigproof_spec::joint::Joint;

use crate::left_out::LeftOut;
use crate::scenario::{Fault, FaultKind, Scenario};

/// Encoders on A and B, a force sensor, and the numbering of samples.
pub struct Sensors<'a> {
    faults: core::iter::Peekable<core::slice::Iter<'a, Fault>>,
    left_out: &'a [LeftOut],
    per_rad: [f64; 2],
    zero_counts: [i32; 2],
    number: u32,
    last: Option<Sensed<f64>>,
}

impl<'a> Sensors<'a> {
    /// Before the first sample.
    pub fn new(scenario: &'a Scenario) -> Sensors<'a> {
        let settings = scenario.settings();
        Sensors {
            faults: scenario.faults.iter().peekable(),
            left_out: &scenario.left_out,
            per_rad: settings
                .counts_per_turn
                .map(|counts| f64::from(counts) / core::f64::consts::TAU),
            zero_counts: scenario.zero_counts,
            number: scenario.first_number,
            last: None,
        }
    }

    /// What is told in a tick, and what is wrong with it.
    pub fn read(
        &mut self,
        tick: u32,
        plant: &Plant,
        force_n: [f64; 2],
    ) -> (Sensed<f64>, Option<FaultKind>) {
        let fault = self.fault(tick);
        if fault == Some(FaultKind::Stale)
            && let Some(last) = self.last
        {
            return (last, fault);
        }
        if let Some(FaultKind::Missed(count)) = fault {
            self.number = self.number.wrapping_add(count);
        }
        let mut counts = [0; 2];
        let shown = self.shown(plant.base_angles_rad());
        let angles = shown.into_iter().zip(self.per_rad);
        let zeros = self.zero_counts.into_iter();
        for (count, ((angle_rad, per_rad), zero)) in counts.iter_mut().zip(angles.zip(zeros)) {
            *count = (libm::floor(angle_rad * per_rad) as i32).wrapping_add(zero);
        }
        if let Some(FaultKind::Jumped([by_a, by_b])) = fault {
            let [a, b] = counts;
            counts = [a.wrapping_add(by_a), b.wrapping_add(by_b)];
        }
        let shown_n = |force_n: Vector<f64>, one: &LeftOut| one.shown_n(force_n);
        let force_n = self.left_out.iter().rev().fold(force_n.into(), shown_n);
        let force_n = fault.map_or(force_n, |fault| fault.force_n(force_n));
        let sensed = Sensed {
            number: self.number,
            counts,
            tip_force_n: force_n,
        };
        self.number = self.number.wrapping_add(1);
        self.last = Some(sensed);
        (sensed, fault)
    }

    /// What the encoders show of angles, rad; what a calibration names first is what the recording shows last.
    fn shown(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let of = |joint: Joint, angle_rad: f64| {
            let shown_rad = |angle_rad: f64, one: &LeftOut| one.shown_rad(joint, angle_rad);
            self.left_out.iter().rev().fold(angle_rad, shown_rad)
        };
        [of(Joint::A, a), of(Joint::B, b)]
    }

    /// What is wrong in a tick.
    fn fault(&mut self, tick: u32) -> Option<FaultKind> {
        while let Some(fault) = self
            .faults
            .next_if(|fault| tick >= fault.from_tick.saturating_add(fault.ticks))
        {
            let _ = fault;
        }
        let next = self.faults.peek()?;
        (tick >= next.from_tick).then_some(next.kind)
    }
}
