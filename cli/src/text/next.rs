//! This file says which experiment would tell the explanations of a recording apart.

use rigproof_diagnose::report::{Report, Verdict};

use super::number::{significant, with_unit};
use super::section;

/// What to do next on the rig, and what it would tell.
pub fn experiment(report: &Report) -> Vec<String> {
    let Some(next) = &report.next_experiment else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    if let Some(what) = &next.what {
        lines.push(format!("  {what}"));
        let is_led = next.greatest_force_n > 0.0;
        let force = with_unit(next.greatest_force_n, "N");
        let hand = is_led.then(|| format!(", the hand with at most {force}"));
        let played = if is_led {
            ", which `simulate` plays"
        } else {
            ""
        };
        let file = next.file.iter();
        let file = file.map(|file| format!("; sample by sample in {file}{played}"));
        lines.push(format!(
            "  {} long{}{}",
            with_unit(next.duration_s, "s"),
            hand.unwrap_or_default(),
            file.collect::<String>(),
        ));
        lines.push("  then diagnose a folder that holds this recording and the new one: one explanation has to fit both".to_owned());
        if report.verdict == Verdict::PartlyExplained {
            lines.push("  more than noise is still unexplained: if the true law has another form, the doubt may outlast the experiment".to_owned());
        }
    }
    lines.extend(next.separations.iter().map(|pair| {
        let (one, other) = (&pair.one, &pair.other);
        let sigmas = significant(pair.sigmas, 2);
        match (pair.tellable, &next.what) {
            (true, _) => {
                format!("  tells {one} from {other} by {sigmas} standard deviations of the noise")
            }
            (false, Some(_)) => format!("  does not tell {one} from {other}"),
            (false, None) => format!(
                "  the best of the {} that were simulated does not tell {one} from {other}",
                next.tried
            ),
        }
    }));
    if !next.not_compared.is_empty() {
        let names = next.not_compared.join(", ");
        lines.push(format!("  in no comparison (not computed by the reference rig, or the least likely of many): {names}"));
    }
    section("Next experiment", lines)
}
