//! This file says what would settle what is open.

use maud::{Markup, html};
use rigproof_diagnose::report::{NextExperiment, Report, Verdict};

use crate::number::{significant, with_unit};
use crate::words::plain_cause;

/// The next experiment, or what helps in its place, and how it was measured.
pub fn body(report: &Report, made: &Markup) -> Option<Markup> {
    Some(html! {
        p { (advice(report)) }
        @if let Some(next) = &report.next_experiment { (experiment(next, report.verdict)) }
        (made)
    })
}

fn advice(report: &Report) -> &'static str {
    match report.verdict {
        Verdict::Consistent => {
            "Nothing is open. What is too small for this recording to show stands under “How sure this is”; more motion or less noise would show less."
        }
        Verdict::Explained => {
            "Nothing is open in this recording. A second recording with another motion is the best check: the new model has to describe it too."
        }
        Verdict::Ambiguous => "Record something in which the explanations that are left differ.",
        Verdict::PartlyExplained | Verdict::NoneOfLibrary => {
            "Go to the place and the kind of motion marked above, and repeat just that: slower, faster, warm, cold, with a part taken off. What changes it is the cause."
        }
        Verdict::NotExcited => {
            "Record again with more motion: several reversals, slow and fast, over the whole range."
        }
        Verdict::DataFault => "Mend the channel that is named above; then diagnose again.",
    }
}

/// What a hand that leads a five-bar does.
fn hand(next: &NextExperiment) -> String {
    let [force, current] = [(next.greatest_force_n, "N"), (next.greatest_current_a, "A")]
        .map(|(most, unit)| with_unit(most, unit));
    match next.greatest_force_n > 0.0 {
        true => {
            format!("; the hand pushes with at most {force}, the brakes take at most {current}")
        }
        false => String::new(),
    }
}

fn experiment(next: &NextExperiment, verdict: Verdict) -> Markup {
    html! {
        @match &next.what {
            Some(what) => {
                p { strong { "The next experiment: " } (what) "." }
                p { (with_unit(next.duration_s, "s")) " long" (hand(next)) ". Chosen from " (next.tried) " that were simulated. Then diagnose a folder that holds this recording and the new one: what stays has to explain both."
                    @if let Some(file) = &next.file { " Sample by sample it stands in " code { (file) } "." }
                    @if verdict == Verdict::PartlyExplained { " More than noise is left by what is named: if its law has another form on the rig, the doubt may outlast the experiment." } }
            }
            None => p { "Of the " (next.tried) " experiments that were simulated none tells the explanations apart." },
        }
        @if !next.separations.is_empty() {
            div.scroll { table.grid {
                caption { "How far it sets the explanations apart, in standard deviations of the noise." }
                thead { tr { th scope="col" { "one" } th scope="col" { "the other" } th.number scope="col" { "apart by" } th scope="col" { "told apart" } } }
                tbody { @for pair in &next.separations { tr { th scope="row" { (plain_cause(&pair.one)) } td { (plain_cause(&pair.other)) } td.number { (significant(pair.sigmas, 2)) } td { (if pair.tellable { "yes" } else { "no" }) } } } }
            } }
        }
        @if !next.not_compared.is_empty() { p.soft { "In no comparison: " (next.not_compared.join(", ")) "." } }
    }
}
