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
        let windows = &self.problem.windows;
        let usable = windows.usable.iter().filter(|u| **u).count();
        let mut lines: Vec<String> = together(&self.train.parts).into_iter().collect();
        lines.extend([
            format!(
                "fitted part: {} samples at {:.1} Hz, {:.3} s; held-out part: {} samples{}",
                self.train.len(),
                1.0 / self.train.step_s,
                self.train.clock().duration_s(),
                self.test.len(),
                if self.other_recording {
                    " of another recording"
                } else {
                    " at the end of the recording"
                },
            ),
            format!(
                "windows: test function (1 - x²)⁴, {:.1} ms wide, one every {} samples; {usable} of {} are used (there the direction of motion is known)",
                1e3 * self.train.width_s(),
                windows.hop,
                windows.centres.len()
            ),
            format!(
                "noise: position {:.3e}, effort {:.3e} (standard deviation of one sample, SI); the windows are whitened with an autoregressive noise model of order {NOISE_ORDER}",
                self.train.position_noise, self.train.effort_noise
            ),
            format!(
                "naming: sets of mechanisms compared by cross-validation over blocks of time; named from a probability of {NAMED} on, suspected from {SUSPECTED} on; effects below {} % of the effort do not count",
                100.0 * self.problem.rules.relevant,
            ),
            self.fit_protocol(protocol),
        ]);
        lines.extend(filled_in(&self.train.recorded));
        lines
    }

    pub(crate) fn fit_protocol(&self, protocol: &Protocol) -> String {
        let held_out = if self.other_recording {
            "another recording"
        } else {
            "the end of the recording"
        };
        match self.train.plant {
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
