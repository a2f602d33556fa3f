//! This file says in plain words what came of replayed recordings.

use rigproof_certify::recordings::compare::{Compared, First};
use rigproof_certify::recordings::looks::Looks;
use rigproof_spec::joint::Joint;

use super::Args;
use super::recordings::{All, Replayed};
use crate::text::number::significant;
use crate::text::{join, section};

/// In less than which share of its samples an old controller that does not command what was recorded is told of.
const AS_RECORDED: f64 = 0.95;

/// What a person reads.
pub fn words(all: &All, between: &[String], args: &Args) -> String {
    let details = all
        .recordings
        .iter()
        .filter(|own| own.compared.differing > 0);
    let details: Vec<&Replayed> = details.collect();
    let rig = args.rig.as_ref().map(|rig| rig.display().to_string());
    let mut sections = vec![vec![verdict(all, between)], table(all)];
    sections.extend(details.into_iter().map(detail));
    sections.push(section(
        "How the recordings were read",
        all.recordings.iter().flat_map(remarks),
    ));
    sections.push(section(
        "Between trials",
        between.iter().map(|line| format!("  {line}")),
    ));
    sections.push(section(
        "Not looked at",
        [
            "  dissipation, passivity: a recording has no plant".to_owned(),
            "  what the rig would have done under the new commands: it moved as it was commanded then".to_owned(),
            format!(
                "  whether the controllers were told more than {} says: counts, force, time",
                rig.as_deref().unwrap_or("the rig")
            ),
        ],
    ));
    join(sections)
}

/// The first line.
fn verdict(all: &All, between: &[String]) -> String {
    let samples: usize = all.recordings.iter().map(|own| own.compared.samples).sum();
    let count = all.recordings.len();
    let what = match count {
        1 => "the recording".to_owned(),
        _ => format!("all {count} recordings"),
    };
    let failed = all
        .recordings
        .iter()
        .filter(|own| !own.compared.holds())
        .count();
    let differs = all.recordings.iter().any(|own| own.compared.differing > 0);
    if failed > 0 {
        return format!(
            "The new controller does NOT do what is expected in {failed} of {count} recordings."
        );
    }
    if !between.is_empty() {
        return "The replay does NOT hold: a controller failed between trials.".to_owned();
    }
    if all.is_not_seen() {
        return format!(
            "The change that certify.toml expects was NOT seen: both controllers command the same in {what}."
        );
    }
    match differs {
        true => format!(
            "The new controller differs as expected, and in nothing else, in {what}, {samples} samples."
        ),
        false => format!(
            "The new controller commands bit for bit what the old one does in {what}, {samples} samples."
        ),
    }
}

/// A line a recording.
fn table(all: &All) -> Vec<String> {
    let names: Vec<String> = all.recordings.iter().map(name).collect();
    let width = names
        .iter()
        .map(|own| own.chars().count())
        .max()
        .unwrap_or(0)
        .max(9);
    let head = format!(
        "  {:<width$}  {:>8}  {:>6}  {:>8}  {:<22}  {:<16}  result",
        "recording", "samples", "faulty", "differ", "greatest difference", "first at"
    );
    let lines = names.iter().zip(&all.recordings).map(|(name, own)| {
        let compared = &own.compared;
        let first = compared.first.as_ref();
        let first = first.map_or("-".to_owned(), |own| {
            format!(
                "{} s ({})",
                significant(own.time_s, 4),
                own.brakes.join(" ")
            )
        });
        format!(
            "  {name:<width$}  {:>8}  {:>6}  {:>8}  {:<22}  {first:<16}  {}",
            compared.samples,
            own.taken.faults(),
            compared.differing,
            greatest(compared),
            result(compared)
        )
    });
    section("Recordings", [head].into_iter().chain(lines))
}

fn name(own: &Replayed) -> String {
    let name = own.file.file_name().unwrap_or(own.file.as_os_str());
    name.to_string_lossy().into_owned()
}

/// The brake whose command differs most, and by how much.
fn greatest(compared: &Compared) -> String {
    let fields = Joint::ALL.into_iter().zip(&compared.brakes);
    let fields = fields.filter(|(_, field)| field.differing > 0);
    // What is no number is the greatest.
    let size = |a: Option<f64>| a.map_or(f64::INFINITY, f64::abs);
    let most = fields
        .max_by(|(_, one), (_, other)| size(one.greatest_a).total_cmp(&size(other.greatest_a)));
    match most {
        None => "-".to_owned(),
        Some((joint, field)) => {
            let by = field.greatest_a.map_or("no number".to_owned(), |by_a| {
                format!(
                    "{}{} A",
                    if by_a > 0.0 { "+" } else { "" },
                    significant(by_a, 3)
                )
            });
            let at = field
                .greatest_s
                .map_or_else(String::new, |s| format!(" at {} s", significant(s, 4)));
            format!("{}: {by}{at}", joint.letter())
        }
    }
}

fn result(compared: &Compared) -> &'static str {
    match (compared.holds(), compared.differing) {
        (true, 0) => "the same bit for bit",
        (true, _) => "as expected",
        (false, 0) => "a law is broken",
        (false, _) => "NOT as expected",
    }
}

/// What is to be known of a recording in which commands differ.
fn detail(own: &Replayed) -> Vec<String> {
    let compared = &own.compared;
    let mut lines = Vec::new();
    if let Some((unmeant, why)) = &compared.first_unmeant {
        lines.push(format!(
            "  {}, in {} samples, first at {} s (sample {}):",
            why.words(),
            compared.unmeant,
            significant(unmeant.time_s, 5),
            unmeant.sample
        ));
        lines.extend(first(unmeant));
    }
    if compared.is_too_often {
        lines.push(format!(
            "  commands differ in {} % of the samples, more than `most_share` allows",
            significant(
                100.0 * compared.differing as f64 / compared.samples as f64,
                3
            )
        ));
    }
    lines.extend(compared.looks.iter().map(looks));
    lines.extend(compared.broken.iter().map(|broken| {
        let first = broken.first_s.map_or_else(String::new, |s| {
            format!(", first at {} s", significant(s, 5))
        });
        format!(
            "  the law {} is broken in {} samples, by the old controller in {}{first}: {}",
            broken.law.name(),
            broken.new,
            broken.old,
            broken.law.words()
        )
    }));
    let [_, new] = &own.answers;
    lines.extend(new.failure.iter().map(|failure| format!("  {failure}")));
    lines.push(format!(
        "  the commands differ in {} stretches",
        compared.stretches
    ));
    section(&name(own), lines)
}

/// A sample that differs, and what was known in it.
fn first(own: &First) -> Vec<String> {
    let command = |a: Option<[f64; 4]>| {
        a.map_or("no answer".to_owned(), |a| {
            a.map(|a| significant(a, 4)).join(", ") + " A"
        })
    };
    let pair = |pair: [f64; 2]| pair.map(|one| significant(one, 4)).join(", ");
    let state = &own.state;
    let force = state
        .force_n
        .map(|n| n.map_or("no number".to_owned(), |n| significant(n, 3)));
    let mut told = format!(
        "    counts A, B: {}, {}; force: {} N",
        state.counts[0],
        state.counts[1],
        force.join(", ")
    );
    if let (Some(tip_m), Some(speed_m_s)) = (state.tip_m, state.tip_velocity_m_s) {
        told += &format!("; tip: {} m, {} m/s", pair(tip_m), pair(speed_m_s));
    }
    if let Some(offset_m) = state.offset_m {
        told += &format!(
            "; {} mm left of the path",
            significant(1000.0 * offset_m, 3)
        );
    }
    if state.is_faulty {
        told += "; a sensor or the clock failed";
    }
    vec![
        format!(
            "    A, E, B, C: {} before, {} now",
            command(own.old_a),
            command(own.new_a)
        ),
        told,
    ]
}

fn looks(looks: &Looks) -> String {
    match looks {
        Looks::Times(factor) => format!(
            "  it looks like a factor: {} times the old currents",
            significant(*factor, 4)
        ),
        Looks::Later(1) => "  it looks like a delay: the old currents, 1 sample later".to_owned(),
        Looks::Later(by) => {
            format!("  it looks like a delay: the old currents, {by} samples later")
        }
        Looks::Exchanged(one, other) => {
            format!("  it looks like brakes {one} and {other} exchanged")
        }
        Looks::Sign(brake) => format!("  it looks like the sign of brake {brake}"),
    }
}

/// What is to be known of how a recording was read.
fn remarks(own: &Replayed) -> Vec<String> {
    let mut lines: Vec<String> = own.how.lines(&own.file);
    let name = name(own);
    let taken = &own.taken;
    if taken.lost > 0 {
        lines.push(format!(
            "{name}: {} rows have no angle: samples that never came",
            taken.lost
        ));
    }
    if taken.between_counts > 0 {
        lines.push(format!(
            "{name}: {} angles lie between two counts: state the encoder's `quantum` in the rig, or its `offset`",
            taken.between_counts
        ));
    }
    let recorded = own.compared.recorded;
    if (recorded.same as f64) < AS_RECORDED * recorded.samples as f64 {
        lines.push(format!(
            "{name}: the old controller commands what was recorded in {} of {} samples: was it another one, or another path?",
            recorded.same, recorded.samples
        ));
    }
    lines.into_iter().map(|line| format!("  {line}")).collect()
}
