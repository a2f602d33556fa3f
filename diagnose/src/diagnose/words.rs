//! This file says in words how a diagnosis was made and what it came to.

use super::write::Stand;
use crate::report::{FitReport, Verdict};
use crate::run::PlantKind;
use crate::select::Selection;
use crate::simulate::{Interpolation, Protocol};
use crate::whiten::NOISE_ORDER;

impl Stand<'_> {
    pub(super) fn protocol_lines(&self, protocol: &Protocol, other_recording: bool) -> Vec<String> {
        let windows = &self.problem.windows;
        let usable = windows.usable.iter().filter(|u| **u).count();
        let mut lines = vec![
            format!(
                "fitted part: {} samples at {:.1} Hz, {:.3} s; held-out part: {} samples{}",
                self.train.len(),
                1.0 / self.train.step_s,
                self.train.duration_s(),
                self.test.len(),
                if other_recording {
                    " of another recording"
                } else {
                    " at the end of the recording"
                },
            ),
            format!(
                "windows: bump (1 - x²)⁴, {:.1} ms wide, {} samples apart, {usable} of {} usable (sense of motion known)",
                1e3 * self.width_s,
                windows.hop,
                windows.centres.len()
            ),
            format!(
                "noise: position {:.3e}, effort {:.3e} (standard deviation of a sample, SI); whitened by an autoregression of order {NOISE_ORDER} of the noise model",
                self.train.position_noise, self.train.effort_noise
            ),
            format!(
                "naming: z ≥ {} over left-out contiguous blocks, ≥ {} % of the loss, ≥ {} % of the effort, ≥ {} times what stays unexplained",
                self.options.gates.z,
                100.0 * self.options.gates.share,
                100.0 * self.options.gates.relevance,
                self.problem.plant.own_to_unexplained()
            ),
            self.fit_protocol(protocol, other_recording),
        ];
        lines.extend(filled_in(&self.train.recorded));
        lines
    }

    pub(super) fn fit_protocol(&self, protocol: &Protocol, other_recording: bool) -> String {
        let held_out = if other_recording {
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

/// What was not recorded, in words; `None` where no more than single samples are missing, which lie between their neighbours.
pub(crate) fn filled_in(recorded: &[bool]) -> Option<String> {
    let missing = recorded.iter().filter(|&&r| !r).count();
    let of = recorded.len();
    (missing > 0).then(|| format!("filled in: {missing} of {of} samples of the fitted part, in gaps of two or more; no window that holds one is used"))
}

pub(crate) fn summary(
    verdict: Verdict,
    selection: &Selection,
    fit: Option<&FitReport>,
    rivals: &[Vec<String>],
) -> String {
    let names: Vec<String> = selection
        .found
        .iter()
        .map(|f| f.term.cause.name())
        .collect();
    let named = names.join(", ");
    let shown = match fit.and_then(|f| f.held_out.map(|h| (h, f))) {
        Some((held, fit)) if !names.is_empty() && fit.improved => {
            format!(
                "; on data it never saw the error falls from {:.4e} to {:.4e} {}",
                held.before, held.after, fit.unit
            )
        }
        Some(_) if !names.is_empty() => {
            "; but the held-out part did not improve: do not use this calibration".to_owned()
        }
        _ => String::new(),
    };
    let or = match rivals.iter().any(|own| !own.is_empty()) {
        true => ", or what is listed as ambiguous with it",
        false => "",
    };
    match verdict {
        Verdict::Consistent => {
            "the nominal model explains the recording down to its sensor noise".to_owned()
        }
        Verdict::Explained => {
            format!("the model left out {named}; with it nothing but sensor noise stays{shown}")
        }
        Verdict::PartlyExplained => {
            format!("the model left out {named}{or}; something beyond sensor noise stays{shown}")
        }
        Verdict::Ambiguous => {
            format!("the model left out {named}{or}{shown}")
        }
        Verdict::NoneOfLibrary => {
            "the model left out something that is not in the library; `located` says where"
                .to_owned()
        }
        Verdict::NotExcited => "the recording moves too little to tell anything".to_owned(),
        Verdict::DataFault => "the recording itself is at fault".to_owned(),
    }
}
