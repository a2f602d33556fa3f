//! This file states how a five-bar was diagnosed, line by line.

use crate::diagnose::words::{filled_in, together};
use crate::diagnose::write::Stand;
use crate::plant::Run;
use crate::rules::{NAMED, SUSPECTED};
use rigproof_trace::rig::five_bar::FiveBar;

impl Stand<'_, FiveBar> {
    /// The lines on how the naming was done.
    pub(super) fn protocol_lines(&self) -> Vec<String> {
        let windows = &self.problem.windows;
        let rows = || {
            windows
                .usable
                .iter()
                .zip(&windows.combined)
                .filter(|(u, _)| **u)
        };
        let (single, all) = (rows().filter(|(_, c)| c.is_some()).count(), rows().count());
        let whole = (all - single) / windows.outputs;
        let mut lines: Vec<String> = together(&self.train.parts).into_iter().collect();
        lines.extend([
            format!(
                "fitted part: {} samples at {:.1} Hz, {:.3} s; held-out part: {} samples{}",
                self.train.len(),
                1.0 / self.train.step_s,
                self.train.clock().duration_s(),
                self.test.len() - (self.test_from_s / self.test.step_s).round() as usize,
                if self.other_recording {
                    " of another recording"
                } else {
                    " at the end of the recording"
                },
            ),
            "equations: momentum form on θA and θB; arms and masses of tables 4.1 and 5.1, brakes of tables 3.1 to 3.3 along the recorded motion, currents held from sample to sample; brakes start without current in the middle of their backlash"
                .to_owned(),
            format!(
                "windows: bump (1 - x²)⁴, {:.1} ms wide, {} samples apart; of {}, {whole} are usable whole (every braked joint moves and its sense is known) and {single} with the one equation that a joint which is held, or turns back, leaves",
                1e3 * windows.bump.len() as f64 * windows.step_s,
                windows.hop,
                windows.centres.len() / windows.outputs,
            ),
            format!(
                "noise: angles {:.3e} rad, force {:.3e} N (standard deviation of a sample); rows whitened together by the factor of their covariance",
                self.train.theta_noise, self.train.force_noise
            ),
            format!(
                "naming: sets of mechanisms weighed by what they predict of blocks of time that were left out; named from a probability of {NAMED} on, suspected from {SUSPECTED} on, beside effects of {} % of the effort",
                100.0 * self.problem.rules.relevant,
            ),
        ]);
        lines.extend(filled_in(&self.train.recorded));
        lines
    }
}
