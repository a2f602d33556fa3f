//! This file puts into words how a plant of one joint was diagnosed.

use super::run::PlantKind;
use super::simulate::{Interpolation, Protocol};
use crate::diagnose::words::{filled_in, together};
use crate::diagnose::write::Stand;
use crate::plant::Run;
use crate::rules::{NAMED, NOISE_ORDER, SUSPECTED};
use rigproof_trace::rig::Rig;

impl Stand<'_, Rig> {
    pub(crate) fn protocol_lines(&self, protocol: &Protocol) -> Vec<String> {
        let mut lines: Vec<String> = together(&self.train.parts).into_iter().collect();
        let blocks = match self.train.rows {
            Some(_) => "blocks of rows",
            None => "blocks of time",
        };
        lines.extend([
            self.parts_said(),
            self.windows_said(),
            format!(
                "noise: position {:.3e}, effort {:.3e} (standard deviation of one sample, SI); the windows are whitened with an autoregressive noise model of order {NOISE_ORDER}",
                self.train.position_noise, self.train.effort_noise
            ),
            format!(
                "naming: sets of mechanisms compared by cross-validation over {blocks}; named from a probability of {NAMED} on, suspected from {SUSPECTED} on; effects below {} % of the effort do not count",
                100.0 * self.problem.rules.relevant,
            ),
            self.fit_protocol(protocol),
        ]);
        lines.extend(filled_in(&self.train.recorded));
        lines
    }

    fn parts_said(&self) -> String {
        let (fitted, held_out) = (self.train.len(), self.test.len());
        let of_another = self.other_recording;
        if self.train.is_sweep() {
            let from = if of_another { " of another sweep" } else { "" };
            return format!("fitted part: {fitted} rows; held-out part: {held_out} rows{from}");
        }
        format!(
            "fitted part: {fitted} samples at {:.1} Hz, {:.3} s; held-out part: {held_out} samples{}",
            1.0 / self.train.step_s,
            self.train.clock().duration_s(),
            match of_another {
                true => " of another recording",
                false => " at the end of the recording",
            },
        )
    }

    fn windows_said(&self) -> String {
        let windows = &self.problem.windows;
        let usable = windows.usable.iter().filter(|u| **u).count();
        let all = windows.centres.len();
        match self.train.rows {
            Some(_) => format!("windows: each row alone; {usable} of {all} are used"),
            None => format!(
                "windows: test function (1 - x²)⁴, {:.1} ms wide, one every {} samples; {usable} of {all} are used (there the direction of motion is known)",
                1e3 * self.train.width_s(),
                windows.hop,
            ),
        }
    }

    pub(crate) fn fit_protocol(&self, protocol: &Protocol) -> String {
        let held_out = match (self.other_recording, &self.train.rows) {
            (true, _) => "another recording",
            (false, Some(_)) => "the rows that were dealt last",
            (false, None) => "the end of the recording",
        };
        match self.train.plant {
            PlantKind::Bench if self.train.is_sweep() => format!(
                "effort computed row by row from its command and speed; a memory of the command goes through the rows in their own order and starts empty; held out: {held_out}"
            ),
            PlantKind::Axis => format!(
                "free run: the simulation gets the recorded drive alone; it starts from a parabola through the first {} samples, and its error counts from there; the drive is {} between samples; Runge-Kutta of order 4 that locates each stop, {} step{} a sample; {} warm-up period{}; held out: {held_out}",
                protocol.start_samples,
                match protocol.interpolation {
                    Interpolation::Hold => "held",
                    Interpolation::Linear => "interpolated linearly",
                    Interpolation::Band => "band-limited and periodic",
                },
                protocol.substeps,
                plural(protocol.substeps),
                protocol.warm_up_periods,
                plural(protocol.warm_up_periods),
            ),
            PlantKind::Bench => format!(
                "effort computed along the recorded motion (zero-phase low-pass, central differences); hysteresis and other memories start empty, and every sample counts; held out: {held_out}"
            ),
        }
    }
}

/// The ending of a noun of which there are so many.
fn plural(count: usize) -> &'static str {
    match count {
        1 => "",
        _ => "s",
    }
}
