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
                "windows: bump (1 - x²)⁴, {:.1} ms wide, {} samples apart, {usable} of {} usable (sense of motion known)",
                1e3 * self.train.width_s(),
                windows.hop,
                windows.centres.len()
            ),
            format!(
                "noise: position {:.3e}, effort {:.3e} (standard deviation of a sample, SI); whitened by an autoregression of order {NOISE_ORDER} of the noise model",
                self.train.position_noise, self.train.effort_noise
            ),
            format!(
                "naming: sets of mechanisms weighed by what they predict of blocks of time that were left out; named from a probability of {NAMED} on, suspected from {SUSPECTED} on, beside effects of {} % of the effort",
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
                "free run from the recorded drive only; state from a parabola through the first {} samples, error from there on; drive {} between samples; Runge-Kutta 4 with located stops, {} step(s) a sample; {} warm-up period(s); held out: {held_out}",
                protocol.start_samples,
                match protocol.interpolation {
                    Interpolation::Hold => "held",
                    Interpolation::Linear => "straight",
                    Interpolation::Band => "band-limited and periodic",
                },
                protocol.substeps,
                protocol.warm_up_periods,
            ),
            PlantKind::Bench => format!(
                "effort along the recorded motion (zero-phase low-pass, central difference), memories empty at the start, no sample discarded; held out: {held_out}"
            ),
        }
    }
}
