//! This file says the verdict in one sentence that a mechanic understands, and what it means.

use maud::{Markup, html};
use rigproof_diagnose::report::{BeforeAfter, EffectReport, Report, Verdict};

use crate::document::{Headline, Tone};
use crate::number::{probability, significant, with_unit};
use crate::words::named_and_suspected;

/// The top of the page.
pub fn headline(report: &Report, next: Option<&str>) -> Headline {
    let (tone, badge) = mood(report);
    let mut paragraphs = vec![meaning(report)];
    paragraphs.extend(outcome(report));
    paragraphs.extend(next.map(|next| html! { strong { "Next: " } code { (next) } }));
    Headline {
        tone,
        badge: badge.to_owned(),
        sentence: sentence(report),
        paragraphs,
        cards: cards(report),
    }
}

fn mood(report: &Report) -> (Tone, &'static str) {
    let [named, suspected] = report.by_status();
    match report.verdict {
        Verdict::Consistent => (Tone::Good, "Model and rig agree"),
        Verdict::Explained => (Tone::Found, "Cause found"),
        Verdict::PartlyExplained | Verdict::Ambiguous if named.is_empty() => {
            (Tone::Doubt, "Cause suspected")
        }
        Verdict::Ambiguous if suspected.is_empty() => (Tone::Doubt, "Cause found, with a doubt"),
        Verdict::PartlyExplained | Verdict::Ambiguous => (Tone::Doubt, "Cause found in part"),
        Verdict::NoneOfLibrary => (Tone::Doubt, "Cause not known"),
        Verdict::NotExcited => (Tone::Bad, "No conclusion"),
        Verdict::DataFault => (Tone::Bad, "Recording at fault"),
    }
}

fn sentence(report: &Report) -> String {
    let device = match report.plant {
        "rig" => "linkage",
        "chain" => "arm",
        other => other,
    };
    let [named, suspected] = named_and_suspected(report, how_wrong);
    match report.verdict {
        Verdict::Consistent => format!(
            "Nothing is missing: the model describes this {device} as well as its sensors can tell."
        ),
        Verdict::Explained if report.agrees() => {
            format!("The model describes this {device}, and the recording has {named}.")
        }
        Verdict::Explained => {
            format!("The real {device} has something the model leaves out: {named}.")
        }
        Verdict::PartlyExplained | Verdict::Ambiguous => {
            let rest = match report.verdict {
                Verdict::Ambiguous => "or something that looks the same in this recording",
                _ => "and something more",
            };
            match (named.as_str(), suspected.as_str()) {
                ("", suspected) => format!(
                    "The real {device} may have something the model leaves out: {suspected} – {rest}."
                ),
                (named, "") => format!(
                    "The real {device} has something the model leaves out: {named} – {rest}."
                ),
                (named, suspected) => format!(
                    "The real {device} has something the model leaves out: {named}, perhaps {suspected} – {rest}."
                ),
            }
        }
        Verdict::NoneOfLibrary => format!(
            "The real {device} does something that the model leaves out, and that no effect in the library describes well enough to be named."
        ),
        Verdict::NotExcited => {
            format!("The {device} moved too little in this recording to tell anything.")
        }
        Verdict::DataFault => match &report.fault {
            Some(fault) => format!("The recording cannot be used: {}.", fault.reason),
            None => "The recording cannot be used.".to_owned(),
        },
    }
}

/// How wrong a wrong scale is; nothing for other mechanisms.
fn how_wrong(effect: &EffectReport) -> String {
    let fraction = effect
        .parameters
        .get("fraction")
        .filter(|_| effect.parameters.len() == 1);
    let by = fraction.map_or_else(String::new, |fraction| {
        format!(" ({:+.1} %)", 100.0 * fraction.value)
    });
    by.replace('-', "−")
}

fn meaning(report: &Report) -> Markup {
    match report.verdict {
        Verdict::Consistent => {
            html! { "What simulation and recording still differ by is no more than the noise of the sensors. There is nothing to mend in the model." }
        }
        Verdict::Explained if report.agrees() => {
            html! { "With that mended in the recording, what simulation and recording still differ by is no more than the noise of the sensors. There is nothing to mend in the model." }
        }
        Verdict::Explained => {
            html! { "Once that is added to the model, what simulation and recording still differ by is no more than the noise of the sensors." }
        }
        Verdict::PartlyExplained => {
            html! {
                "With it the model is better, but more than sensor noise is left: something else is at work, and the numbers below may have taken part of it in."
                @if report.ambiguous_with.iter().any(|own| !own.is_empty()) {
                    " Another cause would explain as much: below it is said which."
                }
            }
        }
        Verdict::Ambiguous => {
            html! { "Another cause would explain this recording as well. Below it is said which, and what would tell them apart." }
        }
        Verdict::NoneOfLibrary => {
            html! {
                "More than sensor noise is left, and no known effect explains it well enough"
                @if let Some(likest) = report.likest() { "; " (likest) }
                ". Below it is said where and when: look there on the rig."
            }
        }
        Verdict::NotExcited => {
            html! { "Record again with more motion: several reversals at several speeds, over the whole range." }
        }
        Verdict::DataFault => match &report.fault {
            Some(fault) => html! {
                "Channel " strong { (fault.channel) } ", from " (with_unit(fault.from_s, "s")) " to " (with_unit(fault.to_s, "s"))
                ". Nothing else was concluded: mend the recording or the rig file, or cut the fault away, and diagnose again."
            },
            None => html! { (report.summary) },
        },
    }
}

/// What the names are worth on data that were not used to find them.
fn outcome(report: &Report) -> Option<Markup> {
    let fit = report.fit.as_ref()?;
    let held_out = fit.held_out.filter(|_| report.changes_the_model())?;
    Some(if fit.improved {
        html! {
            "The check, on held-out data that no number was fitted to: the simulation was off by "
            strong { (with_unit(held_out.before, &fit.unit)) } " before and is off by "
            strong { (with_unit(held_out.after, &fit.unit)) } " now" (times(held_out)) "."
        }
    } else {
        html! { "The check failed: on held-out data the simulation did not get better. Do not use this calibration." }
    })
}

fn times(errors: BeforeAfter) -> String {
    let factor = errors.before / errors.after;
    if factor.is_finite() && factor >= 1.5 {
        format!(", {} times less", significant(factor, 2))
    } else {
        String::new()
    }
}

/// The least probability of a name; of suspicions alone the greatest.
fn how_sure(report: &Report) -> Option<(f64, &'static str)> {
    let [named, suspected] = report.by_status();
    let remark = match (named.len(), suspected.len()) {
        (1, _) => "that the name is right",
        (0, 1) => "that the suspicion is right",
        (0, _) => "of the likeliest suspicion",
        _ => "of the least sure name",
    };
    let of_names = named.iter().map(|own| own.probability);
    let others = suspected.iter().map(|own| own.probability);
    let sure = of_names.reduce(f64::min);
    Some((sure.or_else(|| others.reduce(f64::max))?, remark))
}

fn cards(report: &Report) -> Vec<[String; 3]> {
    let mut cards = Vec::new();
    let mut card =
        |what: &str, figure: String, remark: String| cards.push([what.to_owned(), figure, remark]);
    if let Some(fit) = &report.fit {
        let (part, errors) = match fit.held_out {
            Some(errors) => ("on data kept aside", errors),
            None => ("on the fitted data", fit.train),
        };
        let arrow = format!(
            "{} % → {} %",
            significant(errors.nrmse_before, 3),
            significant(errors.nrmse_after, 3)
        );
        card(
            "Error, of how much the output varies",
            arrow,
            part.to_owned(),
        );
    }
    if let Some(floor) = &report.floor {
        let arrow = format!(
            "{} → {}",
            significant(floor.ratio_before, 3),
            significant(floor.ratio_after, 3)
        );
        card(
            "Left over ÷ sensor noise",
            arrow,
            "1 is noise alone".to_owned(),
        );
    }
    if let Some((sure, of)) = how_sure(report) {
        card("How sure", probability(sure), of.to_owned());
    }
    cards
}
