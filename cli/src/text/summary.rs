//! This file says a diagnosis in at most 14 lines: what is wrong, where, how big, how sure, and what to do next.

use std::io::IsTerminal;
use std::path::Path;

use rigproof_diagnose::report::{EffectReport, Number, Report, Verdict};
use rigproof_model::effects::entry;
use rigproof_report::number::{interval, percent, probability, told};
use rigproof_report::words::{called_at, named_and_suspected, plain_cause};
use rigproof_spec::effect::Mechanism;

use super::found::regime;

/// The most lines of a summary.
pub const MOST_LINES: usize = 14;
/// The lines that a summary needs beside its names: verdict, place, error, doubt, what tells apart, next step, page.
const FRAME: usize = 7;

/// A verdict in bold and in a colour of its own, for a terminal only.
pub struct Style {
    coloured: bool,
}

impl Style {
    /// Colour where standard output is a terminal and nobody set `NO_COLOR`.
    pub fn of_output() -> Style {
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let coloured = std::io::stdout().is_terminal() && !refused;
        Style { coloured }
    }

    /// The first line of what is printed, marked. It must hold nothing of an input that is not steadied.
    pub fn headed(&self, text: &str, verdict: Verdict) -> String {
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        if !self.coloured {
            return text.to_owned();
        }
        let colour = match verdict {
            Verdict::Consistent | Verdict::Explained => 32,
            Verdict::DataFault | Verdict::NotExcited => 31,
            _ => 33,
        };
        format!("\u{1b}[1;{colour}m{first}\u{1b}[0m\n{rest}")
    }
}

/// The diagnosis in at most [`MOST_LINES`] lines.
pub fn summary(report: &Report, next: &str, page: &Path) -> String {
    let mut lines = vec![verdict(report)];
    lines.extend(place(report).filter(|_| !report.agrees()));
    lines.extend(names(report));
    lines.extend(error(report));
    lines.extend(doubt(report));
    lines.extend(told_apart(report));
    lines.push(line("next", next));
    lines.push(line("page", &page.display().to_string()));
    lines.join("\n")
}

/// Where most of what the model leaves over is: the joint of an arm, or the kind of motion.
fn place(report: &Report) -> Option<String> {
    let worst = report.arm.as_ref().and_then(|arm| arm.worst());
    let said = match (worst, report.located.first()) {
        (Some(worst), _) => format!(
            "{}: {} of the unexplained effort; {} → {} {}",
            worst.joint,
            percent(worst.share),
            rounded(worst.before),
            rounded(worst.after),
            worst.unit
        ),
        (None, Some(place)) => {
            let share = percent(place.share);
            format!("{}: {share} of the unexplained energy", regime(place))
        }
        (None, None) => return None,
    };
    Some(line("where", &said))
}

/// One sentence on what is wrong.
fn verdict(report: &Report) -> String {
    let [named, suspected] = named_and_suspected(report, |_| String::new());
    match report.verdict {
        Verdict::Consistent => {
            "The model agrees with the recording to within sensor noise.".to_owned()
        }
        Verdict::Explained if report.agrees() => {
            format!("Cause found in the recording, and none in the model: {named}.")
        }
        Verdict::Explained => format!("Cause found: the model leaves out {named}."),
        Verdict::PartlyExplained | Verdict::Ambiguous => {
            open(report.verdict == Verdict::Ambiguous, &named, &suspected)
        }
        Verdict::NoneOfLibrary => {
            "Cause not known: more than sensor noise is left, and no known effect explains it well enough to be named."
                .to_owned()
        }
        Verdict::NotExcited => "No conclusion: the recording moves too little.".to_owned(),
        Verdict::DataFault => report.fault.as_ref().map_or_else(
            || "The recording cannot be used.".to_owned(),
            |fault| {
                format!(
                    "The recording cannot be used: channel {}, {} s to {} s: {}.",
                    fault.channel,
                    rounded(fault.from_s),
                    rounded(fault.to_s),
                    fault.reason
                )
            },
        ),
    }
}

/// The sentence where something stays open: another cause, or more than noise.
fn open(looks_the_same: bool, named: &str, suspected: &str) -> String {
    let rest = match looks_the_same {
        true => ", or what looks the same here",
        false => ", and something more",
    };
    match (named, suspected) {
        ("", suspected) => {
            format!("Cause suspected: the model may leave out {suspected}{rest}.")
        }
        (named, "") if looks_the_same => {
            format!("Cause found, with a doubt: the model leaves out {named}{rest}.")
        }
        (named, "") => format!("Cause found in part: the model leaves out {named}{rest}."),
        (named, suspected) => {
            format!("Cause found in part: the model leaves out {named}, perhaps {suspected}{rest}.")
        }
    }
}

/// A line for each name; where they are too many for the page, the last line says how many are left out.
fn names(report: &Report) -> Vec<String> {
    let room = MOST_LINES - FRAME;
    let effects = report.by_status().concat();
    let shown = if effects.len() > room {
        room - 1
    } else {
        effects.len()
    };
    let mut lines: Vec<String> = effects.iter().take(shown).map(|own| name(own)).collect();
    let more = effects.len() - shown;
    if more > 0 {
        lines.push(line("names", &format!("{more} more with --verbose")));
    }
    lines
}

/// Numbers of a name that are all shown; of more, those that are told from 0.
const MOST_NUMBERS: usize = 4;

/// A name, its numbers with their intervals, when it begins, and how probable it is.
fn name(effect: &EffectReport) -> String {
    let all = effect.parameters.iter();
    let (told, open): (Vec<_>, Vec<_>) = all.partition(|(_, number)| {
        let interval = interval(number);
        effect.parameters.len() <= MOST_NUMBERS
            || interval.is_some_and(|[low, high]| low > 0.0 || high < 0.0)
    });
    let told = told.into_iter();
    let mut parts: Vec<String> = told
        .map(|(name, number)| format!("{} {}", name.replace('_', " "), with_interval(number)))
        .collect();
    match (parts.is_empty(), open.len()) {
        (_, 0) => {}
        (true, count) => parts.push(format!("none of its {count} numbers is told from 0 alone")),
        (false, count) => parts.push(format!("{count} numbers not told from 0")),
    }
    if let Some(onset) = effect.onset_s {
        parts.push(format!("from {} s on", rounded(onset)));
    }
    let named = called_at(effect.mechanism, effect.joint);
    format!(
        "  {named}: {}; probability {}",
        parts.join(", "),
        probability(effect.probability)
    )
}

/// The error of the simulation before and after, on data that nothing was fitted to where there are such.
fn error(report: &Report) -> Option<String> {
    let fit = report.fit.as_ref()?;
    let (part, errors) = match fit.held_out {
        Some(errors) => ("held-out data", errors),
        None => ("fitted data", fit.train),
    };
    let outcome = if fit.is_refuted() {
        "; with what is suspected every prediction comes out worse"
    } else if fit.improved || !report.changes_the_model() {
        ""
    } else {
        "; it did not improve: do not use this calibration"
    };
    let text = format!(
        "{} → {} {} on {part}{outcome}",
        rounded(errors.before),
        rounded(errors.after),
        fit.unit
    );
    Some(line("error", &text))
}

/// What was taken as stated, and what is undecided.
fn doubt(report: &Report) -> Option<String> {
    let stated = "this recording does not tell the inertia, which is taken as stated";
    let stated = report.has_inertia_as_stated().then(|| stated.to_owned());
    let said: Vec<String> = stated.into_iter().chain(undecided(report)).collect();
    (!said.is_empty()).then(|| line("doubt", &said.join("; ")))
}

/// What else would explain the recording, or what is still unexplained.
fn undecided(report: &Report) -> Option<String> {
    let rivals: Vec<String> = rivals(report)
        .iter()
        .map(|rival| format!("{} ({rival})", plain_cause(rival)))
        .collect();
    let left = report.floor.as_ref().map(|floor| floor.ratio_after);
    let said = match (rivals.as_slice(), report.verdict) {
        ([], Verdict::PartlyExplained | Verdict::NoneOfLibrary) => {
            let likest = report.likest().map(|own| format!("; {own}"));
            format!(
                "what stays is {} times the sensor noise{}",
                rounded(left?),
                likest.unwrap_or_default()
            )
        }
        ([], _) => return None,
        ([one], _) => format!("this recording cannot rule out {one}"),
        ([one, other], _) => format!("this recording cannot rule out {one}, nor {other}"),
        ([one, rest @ ..], _) => format!(
            "this recording cannot rule out {one}, nor {} more",
            rest.len()
        ),
    };
    Some(said)
}

/// The causes that would explain as much as a name, each once.
fn rivals(report: &Report) -> Vec<&str> {
    let mut rivals: Vec<&str> = Vec::new();
    for rival in report.ambiguous_with.iter().flatten() {
        if !rivals.contains(&rival.as_str()) {
            rivals.push(rival);
        }
    }
    rivals
}

/// The experiment that tells a cause from its rivals; where none was simulated, what would refute
/// the cause and its first rival.
fn told_apart(report: &Report) -> Option<String> {
    if let Some(next) = &report.next_experiment {
        let what = next.what.as_ref()?;
        let file = next.file.iter().map(|file| format!(" ({file})"));
        let file: String = file.collect();
        let text = format!("{what}{file}, and diagnose both recordings together");
        return Some(line("tell", &text));
    }
    let mut pairs = report.effects.iter().zip(&report.ambiguous_with);
    let (effect, rival) = pairs.find_map(|(effect, rivals)| Some((effect, rivals.first()?)))?;
    let name = rival.split(' ').next()?;
    let refuted_by = entry(Mechanism::from_name(name)?)?.refuted_by;
    let own = effect.mechanism;
    (name != own).then(|| {
        let text = format!(
            "{own} is refuted by {}, {name} by {refuted_by}",
            effect.refuted_by
        );
        line("tell", &text)
    })
}

fn line(what: &str, text: &str) -> String {
    format!("  {what:<6} {text}")
}

fn with_interval(number: &Number) -> String {
    let unit = match number.unit.as_str() {
        "" | "1" => String::new(),
        unit => format!(" {unit}"),
    };
    match told(number.value, interval(number), 3, digits) {
        (value, Some([low, high])) => format!("{value}{unit} (95 %: {low} to {high})"),
        (value, None) => format!("{value}{unit}"),
    }
}

/// Three significant digits; powers of ten only where decimals would be long.
pub fn rounded(value: f64) -> String {
    digits(value, 3)
}

/// So many significant digits; powers of ten only where decimals would be long.
fn digits(value: f64, count: usize) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return "not a number".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = size.log10().floor();
    let behind = count.saturating_sub(1);
    if (-5.0..6.0).contains(&exponent) {
        let decimals = (behind as f64 - exponent).max(0.0) as usize;
        return format!("{value:.decimals$}");
    }
    let scaled = value / libm::pow(10.0, exponent);
    format!("{scaled:.behind$}·10^{exponent:.0}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_no_negative_zero() {
        assert_eq!(rounded(0.048_63), "0.0486");
        assert_eq!(rounded(7.4039e-4), "0.000740");
        assert_eq!(rounded(-0.0), "0");
        assert_eq!(rounded(12_345.6), "12346");
        assert_eq!(rounded(9.992e-16), "9.99·10^-16");
        assert_eq!(rounded(f64::NAN), "not a number");
    }

    #[test]
    fn a_suspicion_is_no_cause_that_was_found() {
        assert_eq!(
            open(false, "", "drag"),
            "Cause suspected: the model may leave out drag, and something more."
        );
        assert_eq!(
            open(true, "drag", ""),
            "Cause found, with a doubt: the model leaves out drag, or what looks the same here."
        );
        assert_eq!(
            open(false, "drag", "a spring"),
            "Cause found in part: the model leaves out drag, perhaps a spring, and something more."
        );
    }

    #[test]
    fn a_number_ends_where_its_interval_begins_to_doubt_it() {
        let number = |value, low, high| Number {
            value,
            unit: "N".to_owned(),
            low95: Some(low),
            high95: Some(high),
        };
        assert_eq!(
            with_interval(&number(0.0152, -1.263, 1.294)),
            "0 N (95 %: -1.3 to 1.3)"
        );
        assert_eq!(
            with_interval(&number(21.57, 19.21, 23.94)),
            "21.6 N (95 %: 19.2 to 23.9)"
        );
    }

    #[test]
    fn only_a_terminal_gets_colour() {
        let text = "Cause found.\n  next   x";
        let plain = Style { coloured: false };
        assert_eq!(plain.headed(text, Verdict::Explained), text);
        let marked = Style { coloured: true }.headed(text, Verdict::Explained);
        assert_eq!(marked, "\u{1b}[1;32mCause found.\u{1b}[0m\n  next   x");
    }
}
