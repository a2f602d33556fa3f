//! This file puts the result of a diagnosis into words.

use crate::effect::Effect;
use crate::plant::Run;
use crate::problem::Problem;
use crate::report::{FitReport, Verdict};
use crate::rules::NAMED;
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
            "{} recordings one after another on a common clock, which end at {ends} s; memories start anew in each",
            parts.len()
        )
    })
}

/// A sentence on missing samples; `None` if only single ones are missing, which are interpolated.
pub(crate) fn filled_in(recorded: &[bool]) -> Option<String> {
    let missing = recorded.iter().filter(|&&r| !r).count();
    let of = recorded.len();
    (missing > 0).then(|| format!("filled in: {missing} of {of} samples of the fitted part, in gaps of two or more; windows that hold one are not used"))
}

pub(crate) fn summary(
    problem: &Problem,
    verdict: Verdict,
    selection: &Selection,
    fit: Option<&FitReport>,
    rivals: &[Vec<String>],
    mended: &[Effect],
) -> String {
    let mut names: [Vec<String>; 2] = Default::default();
    let [certain, suspected] = &mut names;
    for own in &selection.found {
        let list = match own.probability >= NAMED {
            true => &mut *certain,
            false => &mut *suspected,
        };
        list.push(problem.name(own.term.cause));
    }
    certain.extend(mended.iter().map(|own| problem.name(own.cause)));
    let [certain, suspected] = names.map(|names| names.join(", "));
    let left_out = match (certain.as_str(), suspected.as_str()) {
        ("", suspected) => format!("may have left out {suspected}"),
        (certain, "") => format!("left out {certain}"),
        (certain, suspected) => format!("left out {certain}, perhaps {suspected}"),
    };
    let shown = match fit.and_then(|f| f.held_out.map(|h| (h, f))) {
        Some((held, fit)) if !selection.found.is_empty() && fit.improved => {
            format!(
                "; the error on held-out data falls from {} to {} {}",
                rounded(held.before),
                rounded(held.after),
                fit.unit
            )
        }
        Some(_) if !selection.found.is_empty() => {
            "; the error on held-out data did not fall: do not use this calibration".to_owned()
        }
        _ => String::new(),
    };
    let disagrees = fit.and_then(|fit| fit.agreement.as_ref()?.said(&fit.unit));
    let disagrees = disagrees.map_or(String::new(), |said| format!("; but {said}"));
    let or = match rivals.iter().any(|own| !own.is_empty()) {
        true => ", or one of the rivals that are listed",
        false => "",
    };
    match verdict {
        Verdict::Consistent => {
            format!("the nominal model explains the recording to within sensor noise{disagrees}")
        }
        Verdict::Explained => {
            format!("the model {left_out}; with it only sensor noise is left{shown}{disagrees}")
        }
        Verdict::PartlyExplained => {
            format!("the model {left_out}{or}; more than sensor noise is left{shown}")
        }
        Verdict::Ambiguous => {
            format!("the model {left_out}{or}{shown}{disagrees}")
        }
        Verdict::NoneOfLibrary => {
            "the model left out something that no effect of the library explains well enough to be named; `located` says where"
                .to_owned()
        }
        Verdict::NotExcited => "the recording moves too little for a conclusion".to_owned(),
        Verdict::DataFault => "the recording is faulty".to_owned(),
    }
}

/// A number with three significant digits, in powers of ten only where it is very large or small.
pub(crate) fn rounded(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = libm::log10(value.abs()).floor();
    if !(-5.0..6.0).contains(&exponent) {
        return format!("{value:.2e}");
    }
    let decimals = (2.0 - exponent).max(0.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_sentence_have_three_digits() {
        let all = [0.308_11, 7.196e-4, -12_345.6, 9.992e-16, 0.0].map(rounded);
        assert_eq!(all, ["0.308", "0.000720", "-12346", "9.99e-16", "0"]);
    }
}
