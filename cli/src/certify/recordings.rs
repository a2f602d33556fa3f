//! This file sends a laboratory's recordings through the old and the new controller, and says where their commands differ.

use std::path::{Path, PathBuf};

use rigproof_certify::controller::{Source, Task};
use rigproof_certify::declared::Declared;
use rigproof_certify::description::Description;
use rigproof_certify::plan::Subject;
use rigproof_certify::recordings::compare::Compared;
use rigproof_certify::recordings::expected::Expected;
use rigproof_certify::recordings::taken::Taken;
use rigproof_certify::recordings::{Answered, NOT_LOOKED_AT, answered};
use rigproof_trace::mcap;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, layout_name};
use rigproof_trace::store::read_text;
use serde_json::{Value, json};

use super::Args;
use super::compiled::{Opened, subject};
use super::replayed;
use crate::input::{self, HowRead};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::threads;

/// What recordings are sent through, and what is expected of it.
struct Replay {
    rig: FiveBar,
    task: Task,
    expected: Option<Expected>,
    old: Subject,
    new: Subject,
    compiled_old: Option<Opened>,
    compiled_new: Option<Opened>,
}

/// What came of one recording.
pub struct Replayed {
    /// Its file.
    pub file: PathBuf,
    /// How it was read.
    pub how: HowRead,
    /// What the controllers were told.
    pub taken: Taken,
    /// What the old one and the new one answered.
    pub answers: [Answered; 2],
    /// Both beside each other.
    pub compared: Compared,
}

/// What came of all recordings.
pub struct All {
    /// In the order of their names.
    pub recordings: Vec<Replayed>,
    /// What is meant, if anything is.
    pub expected: Option<Expected>,
}

impl All {
    /// Whether differences are expected and none was seen anywhere.
    pub fn is_not_seen(&self) -> bool {
        let differs = |own: &Replayed| own.compared.differing > 0;
        self.expected.is_some() && !self.recordings.iter().any(differs)
    }

    /// Whether nothing differs but what is meant, and that does.
    pub fn holds(&self) -> bool {
        self.recordings.iter().all(|own| own.compared.holds()) && !self.is_not_seen()
    }
}

/// Replays every recording, and prints a table of them.
pub fn run(args: &Args, recordings: &Path) -> Result<Outcome, Failure> {
    let replay = Replay::of(args)?;
    let files = input::recordings(recordings)?;
    let bar = progress::bar(files.len(), "recordings");
    let done = threads::apart(args.jobs, &files, |file| {
        let one = replay.one(file);
        bar.inc(1);
        one
    })?;
    drop(bar);
    let compiled = [&replay.compiled_old, &replay.compiled_new];
    let between: Vec<String> = compiled
        .into_iter()
        .flatten()
        .flat_map(Opened::ended)
        .collect();
    let all = All {
        recordings: done,
        expected: replay.expected,
    };
    let holds = all.holds() && between.is_empty();
    if args.json {
        print(&json(&all, &between, holds).to_string())?;
    } else {
        print(&replayed::words(&all, &between, args))?;
    }
    Ok(Outcome { checks_hold: holds })
}

impl Replay {
    /// What the command line names.
    fn of(args: &Args) -> Result<Replay, Failure> {
        let (Some(file), Some(rig)) = (&args.description, &args.rig) else {
            let problem = "recordings are replayed with the controllers of a description and a rig: `rigproof certify certify.toml --recordings FOLDER --rig RIG`";
            return Err(Failure::Usage(problem.to_owned()));
        };
        let description = Description::parse(&read_text(file)?, file)?;
        let rig = FiveBar::read(rig)?;
        let lacks = |what: &str| Failure::unusable(file, what.to_owned());
        if !description
            .rigs
            .iter()
            .any(|own| own.layout() == rig.layout)
        {
            let problem = format!(
                "its `layout` is not the rig's, which is {}",
                layout_name(rig.layout)
            );
            return Err(lacks(&problem));
        }
        let task = description.path.clone().ok_or_else(|| {
            lacks("the path that the rig kept to is missing: add a table [path] with `kind` and its points")
        })?;
        let compiled_new = args.compiled.opened()?;
        let compiled_old = match &args.old {
            Some(library) => Some(args.compiled.opened_beside(library)?),
            None => None,
        };
        let every = description.reference_every;
        let of_the_rig = |law| Subject::beside(law, every);
        let new = one_of(
            description.controller.map(of_the_rig),
            compiled_new
                .as_ref()
                .map(|own| own.subject(description.declares)),
            "the new controller: a table [controller], or --controller",
        )?;
        let old = one_of(
            description.baseline.map(of_the_rig),
            compiled_old
                .as_ref()
                .map(|own| own.subject(declared_by(&description))),
            "the old controller: a table [baseline], or --old",
        )?;
        Ok(Replay {
            rig,
            task,
            expected: description.expected,
            old,
            new,
            compiled_old,
            compiled_new,
        })
    }

    /// Sends one recording through both.
    fn one(&self, file: &Path) -> Result<Replayed, Failure> {
        let (recording, how) = read(&self.rig, file)?;
        let taken = Taken::of(self.rig.layout, &recording);
        let taken = taken.map_err(|problem| Failure::unusable(file, problem))?;
        let through = |own: &Subject, compiled: Option<&Opened>| {
            let source: &dyn Source = subject(own, compiled)?;
            Ok::<_, Failure>(answered(&taken, &self.task, source, &own.declared)?)
        };
        let old = through(&self.old, self.compiled_old.as_ref())?;
        let new = through(&self.new, self.compiled_new.as_ref())?;
        let pair = [&old, &new];
        let compared = Compared::of(&taken, &self.task, pair, self.expected.as_ref());
        Ok(Replayed {
            file: file.to_path_buf(),
            how,
            compared,
            answers: [old, new],
            taken,
        })
    }
}

/// What a compiled old controller promises: what the new one does, where that is compiled too; of a law of the rig it may differ.
fn declared_by(description: &Description) -> Declared {
    match description.controller {
        Some(_) => Declared::default(),
        None => description.declares,
    }
}

/// The one of two controllers that is named.
fn one_of(law: Option<Subject>, compiled: Option<Subject>, what: &str) -> Result<Subject, Failure> {
    match (law, compiled) {
        (Some(own), None) | (None, Some(own)) => Ok(own),
        (None, None) => Err(Failure::Input(format!("name {what}"))),
        (Some(_), Some(_)) => Err(Failure::Input(format!("two are named; name one as {what}"))),
    }
}

fn read(rig: &FiveBar, file: &Path) -> Result<(FiveBarRecording, HowRead), Failure> {
    if mcap::is_mcap(file)? {
        let (recording, lines) = rig.read_mcap(file)?;
        return Ok((recording, HowRead::of_messages(&lines)));
    }
    let hints = rigproof_trace::csv::Hints::default();
    let (recording, dialect, remarks) = rig.read_text(file, &hints)?;
    Ok((recording, HowRead::of_text(dialect, &remarks)))
}

/// Everything as JSON.
fn json(all: &All, between: &[String], holds: bool) -> Value {
    let laws = |own: &Answered| -> Vec<Value> {
        let broken = own.broken().map(|(law, fared)| {
            json!({ "law": law, "samples": fared.samples, "broken": fared.broken, "first_sample": fared.first })
        });
        broken.collect()
    };
    let failure = |own: &Answered| own.failure.as_ref().map(ToString::to_string);
    let recordings = all.recordings.iter().map(|own| {
        let [old, new] = &own.answers;
        json!({
            "file": own.file.display().to_string(), "read_as": own.how.json(), "holds": own.compared.holds(),
            "sample_s": own.taken.settings.sample_s, "counts_per_turn": own.taken.settings.counts_per_turn,
            "faulty_samples": own.taken.faults(), "lost_samples": own.taken.lost, "angles_between_counts": own.taken.between_counts,
            "compared": own.compared,
            "old": { "broken": laws(old), "failure": failure(old) }, "new": { "broken": laws(new), "failure": failure(new) },
        })
    });
    json!({
        "holds": holds, "expected": all.expected, "expected_not_seen": all.is_not_seen(),
        "not_looked_at": NOT_LOOKED_AT, "failed_between": between, "recordings": recordings.collect::<Vec<_>>(),
    })
}
