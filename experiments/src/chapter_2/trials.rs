//! This file runs every display on every task and measures each run five ways.

use std::sync::OnceLock;

use rigproof_model::metrics::{average_tip_force, smoothness};
use rigproof_spec::methods::SAMPLE_STEP_S;

use super::shown::{ALL, Ran, Shown};
use super::tasks::{TASKS, Task};
use crate::Error;

/// Runs of each display on each task; each has an aim and a tremor of its own.
const RUNS: u64 = 9;

/// One run, measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Greatest depth in the wall, or distance from the path, m.
    pub greatest_m: f64,
    /// Average force of the hand (6.16b), N.
    pub force_n: f64,
    /// Mean depth in the wall, or distance from the path, m.
    pub error_m: f64,
    /// What the display took, J.
    pub energy_j: f64,
    /// DFT sum of acceleration (6.20), m/s³.
    pub roughness_m_s3: f64,
}

/// A display's runs of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    pub shown: Shown,
    pub task: Task,
    /// The first run, to be drawn.
    pub first: Ran,
    pub runs: Vec<Measured>,
    /// How many came to the end of their path, or through the wall.
    pub arrived: usize,
}

impl Tried {
    /// The median of one measure over the runs.
    pub fn median(&self, of: fn(&Measured) -> f64) -> f64 {
        let mut values: Vec<f64> = self.runs.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

/// Every display on every task; four figures and the comparison show them, and the first that asks has them run.
pub fn all() -> Result<&'static [Tried], Error> {
    static TRIED: OnceLock<Result<Vec<Tried>, Error>> = OnceLock::new();
    let tried = TRIED.get_or_init(run_all).as_ref();
    tried.map(Vec::as_slice).map_err(Clone::clone)
}

/// The runs of a display on a task.
pub fn of(shown: Shown, task: Task) -> Result<&'static Tried, Error> {
    let found = all()?
        .iter()
        .find(|tried| tried.shown == shown && tried.task == task);
    found.ok_or_else(|| Error::model("a display's runs", "they are not among those that were run"))
}

fn run_all() -> Result<Vec<Tried>, Error> {
    let mut all = Vec::new();
    for (shown, task) in ALL
        .into_iter()
        .flat_map(|shown| TASKS.map(|task| (shown, task)))
    {
        all.push(group(shown, task)?);
    }
    Ok(all)
}

fn group(shown: Shown, task: Task) -> Result<Tried, Error> {
    let mut runs = Vec::new();
    for run in 0..RUNS {
        let ran = shown.run(task, 31 + 7919 * run);
        runs.push(ran.map_err(|error| Error::model("a display's run", error))?);
    }
    let measured = runs.iter().map(|ran| measure(task, ran));
    Ok(Tried {
        shown,
        task,
        runs: measured.collect::<Result<_, _>>()?,
        arrived: runs.iter().filter(|ran| ran.arrived).count(),
        first: runs.into_iter().next().unwrap_or_default(),
    })
}

/// The five measures of a run.
pub fn measure(task: Task, ran: &Ran) -> Result<Measured, Error> {
    let refused = |error| Error::model("the measures of a display's run", error);
    let off_m = task.off_m(&ran.tips_m).map_err(refused)?;
    Ok(Measured {
        greatest_m: off_m.iter().copied().fold(0.0, f64::max),
        force_n: average_tip_force(&ran.forces_n, SAMPLE_STEP_S).map_err(refused)?,
        error_m: off_m.iter().sum::<f64>() / off_m.len() as f64,
        energy_j: ran.taken_j,
        roughness_m_s3: smoothness(&ran.tips_m, SAMPLE_STEP_S).map_err(refused)?,
    })
}
