//! This file puts into words how the recordings were used.

use crate::plant::Run;
use crate::problem::Problem;
use crate::report::{FitReport, Verdict};
use crate::selection::Selection;

/// A sentence on several recordings; `None` for one.
pub(crate) fn together<R: Run>(parts: &[R]) -> Option<String> {
    let mut ends_s = 0.0;
    let ends = parts.iter().map(|part| {
        let clock = part.clock();
        ends_s += clock.samples as f64 * clock.step_s;
        format!("{ends_s:.3}")
    });
    let ends = ends.collect::<Vec<_>>().join(", ");
    (!parts.is_empty()).then(|| {
        format!(
            "{} recordings one after another on one clock, which end at {ends} s; every memory begins anew with each",
            parts.len()
        )
    })
}

/// A sentence on missing samples; `None` if only single ones are missing, which are interpolated.
pub(crate) fn filled_in(recorded: &[bool]) -> Option<String> {
    let missing = recorded.iter().filter(|&&r| !r).count();
    let of = recorded.len();
    (missing > 0).then(|| format!("filled in: {missing} of {of} samples of the fitted part, in gaps of two or more; no window that holds one is used"))
}

pub(crate) fn summary(
    problem: &Problem,
    verdict: Verdict,
    selection: &Selection,
    fit: Option<&FitReport>,
    rivals: &[Vec<String>],
) -> String {
    let names: Vec<String> = selection
        .found
        .iter()
        .map(|f| problem.name(f.term.cause))
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
    let disagrees = fit.and_then(|fit| fit.agreement.as_ref()?.said(&fit.unit));
    let disagrees = disagrees.map_or(String::new(), |said| format!("; but {said}"));
    let or = match rivals.iter().any(|own| !own.is_empty()) {
        true => ", or what is listed as ambiguous with it",
        false => "",
    };
    match verdict {
        Verdict::Consistent => {
            format!("the nominal model explains the recording down to its sensor noise{disagrees}")
        }
        Verdict::Explained => {
            format!(
                "the model left out {named}; with it nothing but sensor noise stays{shown}{disagrees}"
            )
        }
        Verdict::PartlyExplained => {
            format!("the model left out {named}{or}; something beyond sensor noise stays{shown}")
        }
        Verdict::Ambiguous => {
            format!("the model left out {named}{or}{shown}{disagrees}")
        }
        Verdict::NoneOfLibrary => {
            "the model left out something that is not in the library; `located` says where"
                .to_owned()
        }
        Verdict::NotExcited => "the recording moves too little to tell anything".to_owned(),
        Verdict::DataFault => "the recording itself is at fault".to_owned(),
    }
}
