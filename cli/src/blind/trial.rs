//! This file makes, diagnoses and scores many recordings with hidden causes.

use std::ops::Range;
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use rigproof_blind::{
    Answer, Case, Error, Forms, Judgement, Plant, Score, Table, again, judge, make_in, open, score,
    under,
};
use rigproof_diagnose::{Description, Diagnosis, Options};
use rigproof_trace::Trace;
use rigproof_trace::csv;
use rigproof_trace::store::{Folder, read_text, write_aside};
use serde_json::{Value, json};

use super::claims::{Claim, Measured, OF_A_JOINT, OF_THE_RIG};
use super::make::{FILES, contents};
use super::seeds::parse_seeds;
use super::{faults, other, page};
use super::{parse_forms, truth};
use crate::folder::{EXPERIMENT, REPORT};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::{join, section};
use crate::threads;

/// What is to be tried.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The seeds, from the first to before the last
    #[arg(long, value_name = "FIRST..END", value_parser = parse_seeds)]
    seeds: Range<u64>,
    /// The plant; both: even seeds on the axis, odd seeds on the bench; rig: the five-bar; chain: a serial arm
    #[arg(long, value_enum, default_value_t = Which::Both)]
    plant: Which,
    /// The forms of what is hidden: usual, or other, which is judged by outcomes and probabilities
    #[arg(long, value_parser = parse_forms, default_value = "usual")]
    forms: Forms,
    /// Recordings that are diagnosed at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    jobs: usize,
    /// Score reports that stand here already, FOLDER/SEED/report.json, instead of diagnosing
    #[arg(long, value_name = "FOLDER")]
    reports: Option<PathBuf>,
    /// Make a second recording of each rig, and say how much of the achievable improvement is reached on it; only with --plant rig
    #[arg(long, conflicts_with = "reports")]
    held_out: bool,
    /// Spoil every recording: the stratum data_fault for each seed, beside the same recording without the fault
    #[arg(long, conflicts_with_all = ["reports", "held_out", "experiments", "misses", "html"])]
    faults: bool,
    /// Where a diagnosis stays ambiguous and asks for an experiment, do it on the same rig and diagnose both recordings together; only with --plant rig
    #[arg(long, conflicts_with_all = ["reports", "held_out"])]
    experiments: bool,
    /// Write every miss as a recording that can be diagnosed again: FOLDER/SEED/ with the files of a case and the report
    #[arg(long, value_name = "FOLDER")]
    misses: Option<PathBuf>,
    /// Also write one page to look at in a browser
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Say what became of every seed
    #[arg(long)]
    details: bool,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Which {
    Axis,
    Bench,
    Both,
    Rig,
    Chain,
}

const AFTER_HELP: &str = "\
Each recording is diagnosed as `rigproof diagnose` does it: the last quarter is held out.
Exit code 1 says that a claim does not hold. --reports scores anybody's diagnosis of the recordings that `blind make` writes.

Example:
  rigproof blind trial --seeds 0..200 --jobs 8 --details
  rigproof blind trial --seeds 0..100 --plant axis --forms other
  rigproof blind trial --seeds 20000..20100 --plant rig --faults";

/// One case, its diagnosis and its score.
pub struct Tried {
    /// What was hidden.
    pub answer: Answer,
    /// What was found.
    pub report: Value,
    /// How well.
    pub score: Score,
    /// How well, where physics is hidden in other forms.
    pub judgement: Option<Judgement>,
    /// What became of it once the experiment was done that the diagnosis asked for.
    pub then: Option<Then>,
}

/// An experiment that a diagnosis asked for, done on the concealed rig.
pub struct Then {
    /// What was asked for.
    pub experiment: Trace,
    /// What was recorded; none where the rig cannot do it.
    pub recording: Option<Trace>,
    /// What was found in both recordings, or in the first one alone.
    pub report: Value,
    /// How well.
    pub score: Score,
}

impl Then {
    /// Whether the truth is named or offered, and nothing else but what physics makes the same.
    pub fn is_told(&self) -> bool {
        self.recording.is_some() && self.score.inside && self.score.open == 0
    }

    /// Its files, by name.
    fn files(&self) -> Result<Vec<(&'static str, Vec<u8>)>, Failure> {
        let csv = |trace| csv::to_bytes(trace).map_err(Failure::Input);
        let [recording, ..] = FILES;
        let mut files = vec![
            (EXPERIMENT, csv(&self.experiment)?),
            (REPORT, self.report.to_string().into_bytes()),
        ];
        if let Some(recorded) = &self.recording {
            files.push((recording, csv(recorded)?));
        }
        Ok(files)
    }
}

/// Tries the seeds and prints table and claims.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if args.held_out && !matches!(args.plant, Which::Rig) {
        let problem = "--held-out makes second recordings of the five-bar: add --plant rig";
        return Err(Failure::Usage(problem.to_owned()));
    }
    if args.experiments && !matches!(args.plant, Which::Rig) {
        let problem = "--experiments does experiments on the five-bar: add --plant rig";
        return Err(Failure::Usage(problem.to_owned()));
    }
    if args.forms == Forms::Other && (args.held_out || args.experiments) {
        let problem = "--held-out and --experiments need a second recording, which only the usual forms have: leave out --forms other";
        return Err(Failure::Usage(problem.to_owned()));
    }
    let cases: Vec<(Plant, u64)> = args
        .seeds
        .clone()
        .map(|s| (plant(args.plant, s), s))
        .collect();
    if args.faults {
        return faults::run(&cases, args.jobs, args.details, args.json);
    }
    let bar = progress::bar(cases.len(), "recordings");
    let tried = threads::apart(args.jobs, &cases, |&(plant, seed)| {
        one(args, plant, seed, &bar)
    })?;
    drop(bar);
    let mut table = Table::default();
    for case in &tried {
        table.add(case.answer.plant, case.answer.seed, case.score.clone());
    }
    if let Some(folder) = &args.misses {
        write_misses(folder, args.forms, &tried)?;
    }
    let judged = tried.iter().any(|case| case.judgement.is_some());
    if args.forms == Forms::Other || judged {
        return other::show(&tried, &how(args), args.details, args.json);
    }
    let claims: Vec<Measured<'_>> = claimed(args.plant)
        .iter()
        .map(|claim| claim.measure(&tried))
        .collect();
    if let Some(file) = &args.html {
        let page = page::html(&table, &how(args), &claims, &tried);
        write_aside(file, page.as_bytes())?;
    }
    if args.json {
        let cases = tried.iter().map(Tried::json);
        let result = json!({
            "plant": how(args),
            "protocol": table.protocol(),
            "rows": table.rows(),
            "confusion": table.confusion(),
            "claims": claims.iter().map(Measured::json).collect::<Vec<_>>(),
            "cases": args.details.then(|| cases.collect::<Vec<_>>()),
        });
        print(&result.to_string())?;
    } else {
        let details = tried.iter().filter(|_| args.details).map(Tried::line);
        print(&join([
            section("Seeds", details),
            vec![table.to_string().trim_end().to_owned(), how(args)],
            section("Hidden: named", table.confusion_lines()),
            section("Claims", claims.iter().map(Measured::line)),
        ]))?;
    }
    Ok(Outcome {
        checks_hold: claims.iter().all(|claim| claim.holds() != Some(false)),
    })
}

fn plant(which: Which, seed: u64) -> Plant {
    match which {
        Which::Axis => Plant::Axis,
        Which::Bench => Plant::Bench,
        Which::Rig => Plant::Rig,
        Which::Chain => Plant::Chain,
        Which::Both if seed.is_multiple_of(2) => Plant::Axis,
        Which::Both => Plant::Bench,
    }
}

const fn claimed(which: Which) -> &'static [Claim] {
    match which {
        Which::Rig => &OF_THE_RIG,
        Which::Axis | Which::Bench | Which::Both | Which::Chain => &OF_A_JOINT,
    }
}

/// The plants of the seeds, and what was held out.
fn how(args: &Args) -> String {
    let plants = assignment(args.plant);
    match args.held_out {
        false => plants.to_owned(),
        true => format!(
            "{plants} Named and fitted on one recording, shown on a second one of the same rig: another hand, other currents."
        ),
    }
}

const fn assignment(which: Which) -> &'static str {
    match which {
        Which::Axis => "Every seed is on the axis.",
        Which::Bench => "Every seed is on the bench.",
        Which::Rig => "Every seed is on the five-bar.",
        Which::Chain => "Every seed is on an arm of its own.",
        Which::Both => "Even seeds are on the axis, odd seeds on the bench.",
    }
}

/// Makes, diagnoses and scores one case.
fn one(args: &Args, plant: Plant, seed: u64, bar: &ProgressBar) -> Result<Tried, Failure> {
    let case = make_in(args.forms, plant, seed, None)?;
    let mut experiment = None;
    let report = match &args.reports {
        Some(folder) => {
            let path = folder.join(seed.to_string()).join(REPORT);
            serde_json::from_str(&read_text(&path)?)
                .map_err(|error| Failure::unusable(&path, error.to_string()))?
        }
        None => {
            let held_out = args.held_out.then(|| again(seed)).transpose()?;
            let (report, next) = diagnosed(seed, &case, &[], held_out.as_ref(), args.experiments)?;
            experiment = next;
            report
        }
    };
    let answer = open(&case.sealed)?;
    let score = score(&answer, &report)?;
    let asked = experiment.filter(|_| args.experiments);
    let then = asked
        .map(|experiment| after(seed, &case, (&report, &score), experiment))
        .transpose()?;
    let judgement = match answer.forms {
        Forms::Usual => None,
        Forms::Other => Some(judge(&answer, &report)?),
    };
    bar.inc(1);
    Ok(Tried {
        answer,
        report,
        score,
        judgement,
        then,
    })
}

/// How both recordings together are diagnosed, once the experiment was done that the first one asks for. What the rig cannot do leaves the first report as it is.
fn after(
    seed: u64,
    case: &Case,
    (report, first): (&Value, &Score),
    experiment: Trace,
) -> Result<Then, Failure> {
    let done = match under(seed, None, &experiment) {
        Err(Error::Experiment(_)) => {
            return Ok(Then {
                experiment,
                recording: None,
                report: report.clone(),
                score: first.clone(),
            });
        }
        done => done?,
    };
    let second = core::slice::from_ref(&done.trace);
    let (report, _) = diagnosed(seed, case, second, None, false)?;
    // What the experiment does not tell either is no ambiguity of the diagnosis.
    Ok(Then {
        score: score(&open(&done.sealed)?, &report)?,
        experiment,
        recording: Some(done.trace),
        report,
    })
}

/// The report of a case as the command makes it, with more recordings of its rig if there are any, and the experiment that it asks for where one
/// is looked for; a recording that cannot be read counts as a data fault.
pub fn diagnosed(
    seed: u64,
    case: &Case,
    more: &[Trace],
    held_out: Option<&Trace>,
    next_experiment: bool,
) -> Result<(Value, Option<Trace>), Failure> {
    let rig = Description::parse(&case.rig_toml, Path::new("rig.toml"))?;
    let applied = |trace: &Trace| rig.apply(trace, Path::new("recording.csv"));
    let held_out = held_out.map(applied).transpose()?;
    let recordings = core::iter::once(&case.trace).chain(more).map(applied);
    let recordings = match recordings.collect::<Result<Vec<_>, _>>() {
        Ok(recordings) => recordings,
        Err(error) => {
            let report =
                json!({ "verdict": "data_fault", "effects": [], "summary": error.to_string() });
            return Ok((report, None));
        }
    };
    let options = Options {
        next_experiment,
        ..Options::default()
    };
    let diagnosis = rig.diagnose(&recordings, held_out.as_ref(), &options);
    let (report, experiment) = match diagnosis {
        Some(Diagnosis {
            report, experiment, ..
        }) => (Some(report), experiment),
        None => (None, None),
    };
    let report = serde_json::to_value(report)
        .map_err(|error| Failure::Input(format!("the report of seed {seed}: {error}")))?;
    Ok((report, experiment))
}

/// Writes the cases that were missed, with their reports, and those that an experiment left open, with that.
fn write_misses(folder: &Path, forms: Forms, tried: &[Tried]) -> Result<(), Failure> {
    let folder = Folder::begin(folder)?;
    for case in tried.iter().filter(|tried| tried.is_miss()) {
        let (plant, seed) = (case.answer.plant, case.answer.seed);
        let made = make_in(forms, plant, seed, None)?;
        for (name, bytes) in FILES.into_iter().zip(contents(&made)?) {
            folder.write(&format!("{seed}/{name}"), &bytes)?;
        }
        folder.write(
            &format!("{seed}/{REPORT}"),
            case.report.to_string().as_bytes(),
        )?;
        let then = case
            .then
            .as_ref()
            .map_or_else(|| Ok(Vec::new()), Then::files)?;
        for (name, bytes) in then {
            folder.write(&format!("{seed}/experiment/{name}"), &bytes)?;
        }
    }
    Ok(folder.finish()?)
}

impl Tried {
    fn is_miss(&self) -> bool {
        self.score.is_miss() || self.then.as_ref().is_some_and(|then| !then.is_told())
    }

    /// The mechanisms that the report names.
    pub fn named(&self) -> Vec<&str> {
        let effects = self.report.get("effects").and_then(Value::as_array);
        let effects = effects.into_iter().flatten();
        effects
            .filter_map(|effect| effect.get("mechanism")?.as_str())
            .collect()
    }

    fn ambiguous(&self) -> Vec<&str> {
        let lists = self.report.get("ambiguous_with").and_then(Value::as_array);
        let lists = lists.into_iter().flatten().filter_map(Value::as_array);
        lists.flatten().filter_map(Value::as_str).collect()
    }

    /// Seed, plant, stratum, what was hidden, the verdict, what was named, and how that was scored.
    pub fn cells(&self) -> Vec<String> {
        let hidden: Vec<String> = truth(&self.answer)
            .iter()
            .map(|line| line.trim().to_owned())
            .collect();
        let flags = match &self.judgement {
            Some(judgement) => vec![judgement.outcome.words()],
            None => self.flags(),
        };
        vec![
            self.answer.seed.to_string(),
            self.answer.plant.name().to_owned(),
            self.answer.stratum.name().to_owned(),
            hidden.join("; "),
            self.score.verdict.clone(),
            self.judgement
                .as_ref()
                .map_or_else(|| list(&self.named()), places),
            flags.join(", "),
        ]
    }

    fn flags(&self) -> Vec<&'static str> {
        let mut flags = vec![match self.score.exact {
            true => "exact",
            false => "not exact",
        }];
        flags.extend((!self.score.inside).then_some("truth outside"));
        flags.extend((!self.score.false_names.is_empty()).then_some("false name"));
        flags.extend(self.score.flagged.then_some("flagged"));
        flags
    }

    /// The same in one line.
    pub fn line(&self) -> String {
        let ambiguous = list(&self.ambiguous());
        match self.cells().as_slice() {
            [seed, plant, stratum, hidden, verdict, named, flags] => format!(
                "  {seed} {plant} {stratum} | {hidden} | {verdict} | named {named} | ambiguous {ambiguous} | {flags}"
            ),
            _ => String::new(),
        }
    }

    /// The case as JSON.
    pub fn json(&self) -> Value {
        json!({
            "seed": self.answer.seed, "plant": self.answer.plant, "answer": self.answer,
            "named": self.named(), "ambiguous": self.ambiguous(), "score": self.score, "judgement": self.judgement, "after_experiment": self.then.as_ref().map(|then| &then.score),
        })
    }
}

/// The names of a judged report, each with its place.
fn places(judgement: &Judgement) -> String {
    let names = judgement.names.iter().map(|(name, ..)| name.as_str());
    list(&names.collect::<Vec<_>>())
}

fn list(names: &[&str]) -> String {
    match names {
        [] => "–".to_owned(),
        names => names.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_experiment_beyond_the_rig_s_reach_leaves_open_what_was_open() {
        let rows = (0..300).map(|k| format!("{},2.5,2.5\n", 1e-3 * f64::from(k)));
        let rows: String = rows.collect();
        let text = format!("time (s),hand_x (m),hand_y (m)\n{rows}");
        let far = csv::parse(text.as_bytes(), Path::new("asked.csv"), None).unwrap();
        let case = rigproof_blind::make(Plant::Rig, 1006, None).unwrap();
        let answer = open(&case.sealed).unwrap();
        let effect = &answer.effects[0];
        let report = json!({
            "verdict": "explained",
            "effects": [{ "mechanism": effect.mechanism, "joint": effect.joint }],
        });
        let first = score(&answer, &report).unwrap();
        assert!(first.inside && first.open == 0);
        let then = after(1006, &case, (&report, &first), far).unwrap();
        assert!(then.recording.is_none() && !then.is_told());
        assert_eq!(then.files().unwrap().len(), 2);
    }
}
