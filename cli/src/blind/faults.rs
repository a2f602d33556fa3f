//! This file tries recordings whose data are at fault, and the same recordings without the fault.

use rigproof_blind::{Plant, Told, make, open, told, unspoilt};
use serde_json::{Value, json};
use std::collections::BTreeMap;

use super::Stratum;
use super::trial::diagnosed;
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::{join, section};
use crate::threads;

/// At most this share of faults may be taken for physics, and as much called explained in silence.
const MOST_WRONG: f64 = 0.01;
/// At least this share must be said with its place.
const LEAST_RIGHT: f64 = 0.9;
/// At most this share of clean recordings may be called faulty.
const MOST_FALSE: f64 = 0.01;

/// Remarks about a result, which are no faults of its recording.
const OF_THE_RESULT: [&str; 6] = [
    "below_floor",
    "inertia_as_stated",
    "inertia_not_told",
    "negative_delay",
    "forms",
    "likest",
];

/// What became of a seed.
struct Tried {
    plant: Plant,
    seed: u64,
    told: Told,
    reason: String,
    /// What is said of the clean twin: its verdict, and the fault if there is one.
    clean: (String, Option<String>),
}

/// Tries the seeds and prints the shares, and the kinds of fault one by one.
pub fn run(
    cases: &[(Plant, u64)],
    jobs: usize,
    details: bool,
    as_json: bool,
) -> Result<Outcome, Failure> {
    let bar = progress::bar(cases.len(), "recordings");
    let tried = threads::apart(jobs, cases, |&(plant, seed)| {
        let tried = one(plant, seed);
        bar.inc(1);
        tried
    })?;
    drop(bar);
    let shares = shares(&tried);
    let holds = shares.iter().all(|share| share.holds);
    if as_json {
        let cases = tried.iter().map(Tried::json).collect::<Vec<_>>();
        let claims = shares.iter().map(|own| json!({ "claim": own.words, "count": own.count, "of": own.of, "holds": own.holds }));
        let result =
            json!({ "claims": claims.collect::<Vec<_>>(), "kinds": kinds(&tried), "cases": cases });
        print(&result.to_string())?;
    } else {
        let lines = tried
            .iter()
            .filter(|own| details || own.is_miss())
            .map(Tried::line);
        let kinds = kinds(&tried);
        let kinds = kinds.iter().map(|(kind, [n, right, named, silent])| {
            format!("  {kind}: {right} of {n} right, {named} named, {silent} silent")
        });
        let claims = shares.iter().map(|own| {
            let holds = if own.holds { "holds" } else { "does not hold" };
            format!("  {}: {} of {}: {holds}", own.words, own.count, own.of)
        });
        print(&join([
            section(if details { "Seeds" } else { "Misses" }, lines),
            section("Kinds", kinds),
            section("Claims", claims),
        ]))?;
    }
    Ok(Outcome { checks_hold: holds })
}

/// A claim and how it came out.
struct Claimed {
    words: &'static str,
    count: usize,
    of: usize,
    holds: bool,
}

fn shares(tried: &[Tried]) -> [Claimed; 4] {
    let of = tried.len();
    let count = |is: fn(&Tried) -> bool| tried.iter().filter(|own| is(own)).count();
    let least = |words, is: fn(&Tried) -> bool, least: f64| {
        let count = count(is);
        let holds = count as f64 >= least * of as f64;
        Claimed {
            words,
            count,
            of,
            holds,
        }
    };
    let most = |words, is: fn(&Tried) -> bool, most: f64| {
        let count = count(is);
        let holds = count as f64 <= most * of as f64;
        Claimed {
            words,
            count,
            of,
            holds,
        }
    };
    [
        most(
            "a fault is taken for physics, at most 1 %",
            |own| !own.told.names.is_empty(),
            MOST_WRONG,
        ),
        most(
            "consistent or explained without a word of the fault, at most 1 %",
            |own| own.told.is_silent,
            MOST_WRONG,
        ),
        least(
            "the right fault with its place, at least 90 %",
            |own| own.told.is_right,
            LEAST_RIGHT,
        ),
        most(
            "a fault in a clean twin, at most 1 %",
            |own| own.clean.1.is_some(),
            MOST_FALSE,
        ),
    ]
}

/// Cases of each kind, how many are right, how many named physics, and how many were silent.
fn kinds(tried: &[Tried]) -> BTreeMap<String, [usize; 4]> {
    let mut kinds: BTreeMap<String, [usize; 4]> = BTreeMap::new();
    for own in tried {
        let [n, right, named, silent] = kinds.entry(own.told.fault.clone()).or_default();
        *n += 1;
        *right += usize::from(own.told.is_right);
        *named += usize::from(!own.told.names.is_empty());
        *silent += usize::from(own.told.is_silent);
    }
    kinds
}

fn one(plant: Plant, seed: u64) -> Result<Tried, Failure> {
    let case = make(plant, seed, Some(Stratum::DataFault))?;
    let (report, _) = diagnosed(seed, &case, &[], None, false)?;
    let told = told(&open(&case.sealed)?, &report)?;
    let (clean, _) = diagnosed(seed, &unspoilt(plant, seed)?, &[], None, false)?;
    let verdict = |report: &Value| {
        report
            .get("verdict")
            .and_then(Value::as_str)
            .unwrap_or("")
            .to_owned()
    };
    let words = |of: Option<&Value>, key: &str| {
        of.and_then(|own| own.get(key))
            .and_then(Value::as_str)
            .map(str::to_owned)
    };
    let reason = |report: &Value| {
        words(report.get("fault"), "reason").or_else(|| words(Some(report), "summary"))
    };
    let remarks = clean.get("remarks").and_then(Value::as_array);
    let first_mended = remarks.into_iter().flatten().find(|own| {
        let what = words(Some(own), "what");
        what.is_some_and(|what| !OF_THE_RESULT.contains(&what.as_str()))
    });
    let is_fault = verdict(&clean) == "data_fault";
    Ok(Tried {
        plant,
        seed,
        told,
        reason: reason(&report).unwrap_or_default(),
        clean: (
            verdict(&clean),
            is_fault
                .then(|| reason(&clean))
                .flatten()
                .or_else(|| words(first_mended, "words")),
        ),
    })
}

impl Tried {
    fn is_miss(&self) -> bool {
        !self.told.is_right || !self.told.names.is_empty() || self.clean.1.is_some()
    }

    fn line(&self) -> String {
        let Told {
            fault,
            verdict,
            names,
            is_right,
            ..
        } = &self.told;
        let right = if *is_right { "right" } else { "not right" };
        let clean = match &self.clean {
            (verdict, None) => verdict.clone(),
            (verdict, Some(reason)) => format!("{verdict}: {reason}"),
        };
        format!(
            "  {} {} {fault} | {verdict} | named {} | {right} | {} | clean: {clean}",
            self.seed,
            self.plant.name(),
            names.join(", "),
            self.reason
        )
    }

    fn json(&self) -> Value {
        json!({
            "seed": self.seed, "plant": self.plant.name(), "told": self.told,
            "clean": { "verdict": self.clean.0, "fault": self.clean.1 },
        })
    }
}
