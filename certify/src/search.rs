//! This file searches for worse cases than were drawn, and for places where no drawn trial met a law's premise: an optimiser without slopes moves a
//! scenario's continuous numbers. It finds, and proves nothing.
//! A law that it meets broken is a finding.

mod moved;
mod premise;

use std::cell::RefCell;
use std::path::Path;

use cobyla::{Func, RhoBeg, StopTols, minimize};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::controller::Source;
use crate::coverage::Cell;
use crate::digest;
use crate::error::Error;
use crate::law::{Fared, Law};
use crate::metrics::{Measured, Metric};
use crate::plan::{FORM, Plan, Subject};
use crate::record::Record;
use crate::scenario::Scenario;
use crate::trial::{Ran, run};

/// From how many of the drawn scenarios, the worst ones, a search for a target begins.
pub const STARTS: usize = 2;
/// How far the numbers are moved at first, as a share of half their range.
const FIRST: f64 = 0.5;
/// Moves below this share end a search.
const LEAST: f64 = 1e-4;

/// What is made as bad as can be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// The least margin of a law.
    Law(Law),
    /// A metric.
    Metric(Metric),
    /// The cells in which a law's premise is met, and no drawn trial met it.
    Premise(Law),
}

/// The worst case that was found for a target, with a scenario that anybody can run again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worst {
    /// [`FORM`].
    pub form: u32,
    /// What.
    pub target: Target,
    /// The drawn scenario in which the search began.
    pub begun_in: u64,
    /// The worst that was drawn: a least margin, or a greatest metric; 0 new cells.
    pub drawn: f64,
    /// The worst that was found.
    pub found: f64,
    /// The cells that were found, of a premise.
    pub cells: Vec<String>,
    /// Trials that the search took, from all its starts.
    pub trials: u32,
    /// The controller.
    pub controller: Subject,
    /// The scenario.
    pub scenario: Scenario,
    /// The SHA-256 of this file with nothing between these quotes.
    pub digest: String,
}

/// A law that a search met broken, whatever it searched for.
#[derive(Clone, Debug, PartialEq)]
pub struct Met {
    /// The law.
    pub law: Law,
    /// What was searched for.
    pub target: Target,
    /// The drawn scenario in which the search began.
    pub begun_in: u64,
    /// The scenario that breaks the law.
    pub scenario: Scenario,
    /// The first sample that broke it.
    pub tick: u32,
    /// The least margin.
    pub margin: f64,
    /// How the controller broke, if it did.
    pub failure: Option<String>,
}

/// What a search found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Searched {
    /// The worst case of every target.
    pub worst: Vec<Worst>,
    /// Of every law that was met broken, the first.
    pub met: Vec<Met>,
}

/// A worst case as the certificate names it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedWorst {
    /// What.
    pub target: Target,
    /// Its unit.
    pub unit: String,
    /// The worst that was drawn.
    pub drawn: f64,
    /// The worst that was found.
    pub found: f64,
    /// Trials that the search took.
    pub trials: u32,
    /// The file, beside the certificate.
    pub file: String,
    /// Its SHA-256.
    pub sha256: String,
}

impl Target {
    /// Every law, every metric and every premise that is searched for.
    pub fn all() -> impl Iterator<Item = Target> {
        let laws = Law::ALL.into_iter().map(Target::Law);
        let premises = premise::LAWS_WITH_PREMISES.into_iter();
        laws.chain(Metric::ALL.into_iter().map(Target::Metric))
            .chain(premises.map(Target::Premise))
    }

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Target::Law(law) => law.name(),
            Target::Metric(metric) => metric.key(),
            Target::Premise(law) => premise::name(law),
        }
    }

    /// Its unit.
    pub const fn unit(self) -> &'static str {
        match self {
            Target::Law(law) => law.unit(),
            Target::Metric(metric) => metric.unit(),
            Target::Premise(_) => "cells",
        }
    }

    /// How good a trial was; more is better. `None` where there was nothing to judge or to measure.
    fn good(self, fared: &[Fared], measured: &Measured) -> Option<f64> {
        let good = match self {
            Target::Law(law) => fared.get(law as usize).filter(|own| own.samples > 0)?.worst,
            Target::Metric(metric) => -measured.get(metric as usize).copied().flatten()?,
            Target::Premise(_) => return None,
        };
        good.is_finite().then_some(good)
    }

    /// What is good as it is written: a margin, or a metric.
    fn written(self, good: f64) -> f64 {
        match self {
            Target::Law(_) => good,
            Target::Metric(_) => -good,
            Target::Premise(_) => 0.0 - good,
        }
    }
}

/// Searches for a worse case of every law and metric whose value the drawn scenarios change; the result depends on the plan alone.
///
/// # Errors
/// [`Error::Scenario`].
pub fn search(plan: &Plan, source: &dyn Source, records: &[&Record]) -> Result<Searched, Error> {
    if plan.search == 0 {
        return Ok(Searched::default());
    }
    let begun: Vec<Begun> = all_begun(plan, records).collect();
    let jobs: Vec<(&Begun, u64)> = begun
        .iter()
        .flat_map(|begun| begun.indices.iter().map(move |index| (begun, *index)))
        .collect();
    let each = plan.search.div_ceil(STARTS as u32);
    let ended: Vec<Moved> = jobs
        .into_par_iter()
        .with_max_len(1)
        .map(|(begun, index)| moved(plan, source, begun, index, each))
        .collect();
    let mut ended = ended.into_iter();
    let mut all = Searched::default();
    for begun in &begun {
        let mut own: Vec<Moved> = ended.by_ref().take(begun.indices.len()).collect();
        let trials = own.iter().map(|moved| moved.trials).sum();
        for met in own.iter_mut().flat_map(|moved| moved.met.drain(..)) {
            if all.met.iter().all(|known| known.law != met.law) {
                all.met.push(met);
            }
        }
        let worst = own
            .into_iter()
            .reduce(|one, other| if other.good < one.good { other } else { one });
        let Some(worst) = worst else { continue };
        let worst = Worst {
            form: FORM,
            target: begun.target,
            begun_in: worst.index,
            drawn: begun.target.written(begun.least),
            found: begun.target.written(worst.good),
            cells: worst.cells.into_iter().map(Cell::name).collect(),
            trials,
            controller: plan.controller.clone(),
            scenario: worst.scenario,
            digest: String::new(),
        };
        all.worst.push(worst.sealed()?);
    }
    Ok(all)
}

/// What is searched for, and the worst of it that was drawn.
pub fn targets(plan: &Plan, records: &[&Record]) -> Vec<(Target, f64)> {
    if plan.search == 0 {
        return Vec::new();
    }
    all_begun(plan, records)
        .map(|begun| (begun.target, begun.target.written(begun.least)))
        .collect()
}

fn all_begun(plan: &Plan, records: &[&Record]) -> impl Iterator<Item = Begun> {
    let is_looked_at = |target: &Target| match target {
        Target::Law(law) | Target::Premise(law) => plan.not_looked_at(*law).is_none(),
        Target::Metric(_) => true,
    };
    Target::all()
        .filter(is_looked_at)
        .filter_map(|target| match target {
            Target::Premise(law) => premise::begun(law, records),
            target => begun(target, records),
        })
}

/// Where a search for a target begins.
struct Begun {
    target: Target,
    /// The scenarios, the worst first.
    indices: Vec<u64>,
    /// How good the worst and the best scenario were.
    least: f64,
    most: f64,
    /// The cells that are to be reached, of a premise.
    goal: Vec<Cell>,
}

/// Nothing where the drawn scenarios show no slope, or where the law is broken already.
fn begun(target: Target, records: &[&Record]) -> Option<Begun> {
    let mut all: Vec<(f64, u64)> = records
        .iter()
        .filter_map(|record| Some((target.good(&record.fared, &record.measured)?, record.index)))
        .collect();
    all.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    let (least, _) = *all.first()?;
    let (most, _) = *all.last()?;
    let is_broken = matches!(target, Target::Law(law) if records.iter().any(|record| {
        record.fared.get(law as usize).is_some_and(|fared| fared.broken > 0)
    }));
    if least == most || is_broken {
        return None;
    }
    Some(Begun {
        target,
        indices: all
            .into_iter()
            .take(STARTS)
            .map(|(_, index)| index)
            .collect(),
        least,
        most,
        goal: Vec::new(),
    })
}

/// What came of one start.
struct Moved {
    index: u64,
    good: f64,
    trials: u32,
    scenario: Scenario,
    /// The cells that it reached, of a premise.
    cells: Vec<Cell>,
    /// The laws that it met broken, each once.
    met: Vec<Met>,
}

/// Moves the numbers of one scenario.
fn moved(plan: &Plan, source: &dyn Source, begun: &Begun, index: u64, trials: u32) -> Moved {
    let start = plan.scenario(index);
    let space = moved::Space::around(&start, plan.calibration.as_ref());
    let best = RefCell::new(Moved {
        index,
        good: begun.most,
        trials: 0,
        scenario: start.clone(),
        cells: Vec::new(),
        met: Vec::new(),
    });
    let target = begun.target;
    let judged = |point: &[f64], (): &mut ()| {
        let scenario = space.at(&start, point);
        let ran = run(&scenario, source, &plan.controller.declared, false);
        let mut best = best.borrow_mut();
        best.trials += 1;
        // What is no scenario, or shows nothing of the target, is as good as the best that was drawn.
        let Some(ran) = ran else { return begun.most };
        for (law, fared) in broken(plan, &ran) {
            if best.met.iter().all(|known| known.law != law) {
                best.met.push(Met {
                    law,
                    target,
                    begun_in: index,
                    scenario: scenario.clone(),
                    tick: fared.first.unwrap_or_default(),
                    margin: fared.worst,
                    failure: ran.failure.as_ref().map(ToString::to_string),
                });
            }
        }
        let cells = match target {
            Target::Premise(law) => premise::reached(law, &begun.goal, &ran.met),
            _ => Vec::new(),
        };
        let good = match target {
            Target::Premise(_) => Some(0.0 - cells.len() as f64),
            target => target.good(&ran.fared, &ran.measured),
        };
        let good = good.unwrap_or(begun.most);
        if good < best.good {
            (best.good, best.scenario, best.cells) = (good, scenario, cells);
        }
        good
    };
    let none: [&dyn Func<()>; 0] = [];
    let tolerances = StopTols {
        xtol_abs: vec![LEAST; space.len()],
        ..StopTols::default()
    };
    // How it ended is no matter: the best trial counts.
    let _ = minimize(
        judged,
        &vec![0.0; space.len()],
        &vec![(-1.0, 1.0); space.len()],
        &none,
        (),
        trials as usize,
        RhoBeg::All(FIRST),
        Some(tolerances),
    );
    best.into_inner()
}

/// The laws that are looked at that a trial breaks, whatever was searched for.
fn broken(plan: &Plan, ran: &Ran) -> impl Iterator<Item = (Law, Fared)> {
    ran.broken()
        .filter(|(law, _)| plan.not_looked_at(*law).is_none())
}

/// What a worst case comes to when it is run again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Again {
    /// The target's margin or metric, where it shows.
    pub value: Option<f64>,
    /// Whether that is what was found.
    pub is_same: bool,
}

impl Worst {
    /// The file's name.
    pub fn file(&self) -> String {
        Worst::file_of(self.target)
    }

    /// The file's name of a target.
    pub fn file_of(target: Target) -> String {
        format!("worst-{}.json", target.name())
    }

    /// With its own SHA-256 computed.
    fn sealed(mut self) -> Result<Worst, Error> {
        self.digest = self.own_digest()?;
        Ok(self)
    }

    fn own_digest(&self) -> Result<String, Error> {
        let blank = Worst {
            digest: String::new(),
            ..self.clone()
        };
        Ok(digest::of_bytes(blank.to_json()?.as_bytes()))
    }

    /// As a file.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// A worst case from its file.
    ///
    /// # Errors
    /// It is not as it was written.
    pub fn parse(text: &str, file: &Path) -> Result<Worst, Error> {
        let advice = "hand over the file as `rigproof certify` wrote it";
        let worst: Worst = serde_json::from_str(text).map_err(|error| {
            Error::unusable(file, format!("it is no worst case: {error}; {advice}"))
        })?;
        if worst.form != FORM || worst.scenario.ticks > crate::finding::MOST_TICKS {
            return Err(Error::unusable(
                file,
                format!("it is of another form than {FORM}, or too long; {advice}"),
            ));
        }
        if worst.to_json()? != text || worst.own_digest()? != worst.digest {
            let problem =
                format!("its SHA-256 is not that of what it says: it was changed; {advice}");
            return Err(Error::unusable(file, problem));
        }
        Ok(worst)
    }

    /// How the certificate names it.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn named(&self) -> Result<NamedWorst, Error> {
        Ok(NamedWorst {
            target: self.target,
            unit: self.target.unit().to_owned(),
            drawn: self.drawn,
            found: self.found,
            trials: self.trials,
            file: self.file(),
            sha256: digest::of_bytes(self.to_json()?.as_bytes()),
        })
    }

    /// What it comes to when it is run again; `None` where nothing is judged or measured any more.
    ///
    /// # Errors
    /// [`Error::Scenario`].
    pub fn replayed(&self, source: &dyn Source) -> Result<Again, Error> {
        let ran = run(&self.scenario, source, &self.controller.declared, false);
        let ran = ran.ok_or(Error::Scenario(self.begun_in))?;
        let value = match self.target {
            Target::Premise(law) => {
                let is_named = |cell: &Cell| self.cells.contains(&cell.name());
                let named: Vec<Cell> = Cell::all().filter(is_named).collect();
                Some(premise::reached(law, &named, &ran.met).len() as f64)
            }
            target => target.good(&ran.fared, &ran.measured),
        };
        let value = value.map(|good| match self.target {
            Target::Premise(_) => good,
            target => target.written(good),
        });
        Ok(Again {
            value,
            is_same: value == Some(self.found),
        })
    }
}
