//! This file makes a failing scenario as short and as plain as it can be while the law is still broken.

use crate::controller::{Source, Task};
use crate::declared::Declared;
use crate::hand::Hand;
use crate::law::Law;
use crate::scenario::{Fault, PlantChange, Scenario};
use crate::trial::{Ran, run};
use crate::way::Way;

/// Samples before the one that breaks the law with which a shortened run is tried, the fewest first.
const BEFORE: [u32; 9] = [9, 12, 20, 40, 80, 160, 320, 640, 1280];
/// Simpler forms that are tried in turn, at most so often.
const ROUNDS: usize = 3;

/// A failing scenario, shrunk.
#[derive(Clone, Debug, PartialEq)]
pub struct Shrunk {
    /// The scenario.
    pub scenario: Scenario,
    /// The sample that breaks the law.
    pub tick: u32,
    /// The least margin.
    pub margin: f64,
    /// How the controller broke, if it did.
    pub failure: Option<String>,
    /// Trials that it took.
    pub trials: u32,
}

/// Makes a scenario that breaks a law shorter and plainer; `None` where it does not break it.
pub fn shrink(
    scenario: &Scenario,
    law: Law,
    source: &dyn Source,
    declared: &Declared,
) -> Option<Shrunk> {
    let mut shrinking = Shrinking {
        law,
        source,
        declared,
        best: scenario.clone(),
        tick: 0,
        margin: 0.0,
        failure: None,
        trials: 0,
    };
    let first = shrinking.breaks(scenario, true)?;
    shrinking.later(&first);
    shrinking.plainer();
    // What is plainer may break it sooner, and from nearer by.
    let again = shrinking.best.clone();
    if let Some(ran) = shrinking.breaks(&again, true) {
        shrinking.later(&ran);
    }
    Some(Shrunk {
        scenario: shrinking.best,
        tick: shrinking.tick,
        margin: shrinking.margin,
        failure: shrinking.failure,
        trials: shrinking.trials,
    })
}

struct Shrinking<'a> {
    law: Law,
    source: &'a dyn Source,
    declared: &'a Declared,
    best: Scenario,
    tick: u32,
    margin: f64,
    failure: Option<String>,
    trials: u32,
}

impl Shrinking<'_> {
    /// Runs a scenario; if it breaks the law, it is the best so far, cut off after the sample that breaks it.
    fn breaks(&mut self, scenario: &Scenario, with_states: bool) -> Option<Ran> {
        self.trials += 1;
        let ran = run(scenario, self.source, self.declared, with_states)?;
        let fared = ran.fared.get(self.law as usize)?;
        let tick = fared.first?;
        let ticks = tick.saturating_add(1);
        self.best = Scenario {
            ticks: ticks.min(scenario.ticks),
            ..scenario.clone()
        };
        (self.tick, self.margin) = (tick, fared.worst);
        self.failure = ran.failure.as_ref().map(ToString::to_string);
        Some(ran)
    }

    /// Begins later, where the rig then was, with the push that there then was; or else with the same hand.
    fn later(&mut self, ran: &Ran) {
        let whole = self.best.clone();
        let broken_at = self.tick;
        for before in BEFORE.into_iter().filter(|before| *before < broken_at) {
            let from = broken_at - before;
            let Some(state) = ran.states.get(from as usize) else {
                continue;
            };
            // What breaks after the last sample has that sample's push.
            let last = ran.states.get(broken_at as usize).unwrap_or(state);
            let told = ran.told.get(from as usize);
            let begun = Scenario {
                theta_rad: state.theta_rad,
                rates_rad_s: state.rates_rad_s,
                first_number: told.map_or(whole.first_number, |(sensed, _)| sensed.number),
                faults: moved(&whole, from),
                ticks: before + before / 2 + 10,
                ..whole.clone()
            };
            for hand in [
                Hand::Constant(state.force_n),
                Hand::Constant(last.force_n),
                whole.hand,
            ] {
                let tried = Scenario {
                    hand,
                    ..begun.clone()
                };
                if self.breaks(&tried, false).is_some() {
                    return;
                }
            }
        }
    }

    /// Leaves out what can be left out.
    fn plainer(&mut self) {
        for _ in 0..ROUNDS {
            let before = self.best.clone();
            for tried in simpler(&before) {
                let changed = changed(&self.best, tried);
                self.breaks(&changed, false);
            }
            if self.best == before || self.best.ticks == before.ticks {
                return;
            }
        }
    }
}

/// Faults seen from a later start.
fn moved(scenario: &Scenario, from: u32) -> Vec<Fault> {
    let left = scenario
        .faults
        .iter()
        .filter(|fault| fault.from_tick >= from);
    left.map(|fault| Fault {
        from_tick: fault.from_tick - from,
        ..*fault
    })
    .collect()
}

/// One simplification.
type Simpler = fn(&mut Scenario);

/// Simplifications that change something.
fn simpler(scenario: &Scenario) -> Vec<Simpler> {
    let all: [Simpler; 10] = [
        |s| s.faults.clear(),
        |s| {
            s.faults.pop();
        },
        |s| {
            if !s.faults.is_empty() {
                s.faults.remove(0);
            }
        },
        |s| s.plant = PlantChange::default(),
        |s| s.left_out.clear(),
        |s| s.zero_counts = [0; 2],
        |s| s.first_number = 0,
        |s| s.rates_rad_s = [0.0; 2],
        straightened,
        |s| {
            if let Hand::Constant(force_n) = &mut s.hand {
                *force_n = force_n.map(|component| 0.5 * component);
            }
        },
    ];
    let changes = |simpler: &Simpler| {
        let mut changed = scenario.clone();
        simpler(&mut changed);
        changed != *scenario
    };
    all.into_iter().filter(changes).collect()
}

/// A simplification of the best so far.
fn changed(best: &Scenario, simpler: Simpler) -> Scenario {
    let mut changed = best.clone();
    // A little more time than it took, in case the law breaks later.
    changed.ticks = best.ticks.saturating_add(best.ticks / 2).saturating_add(10);
    simpler(&mut changed);
    changed
}

/// The path as a line along its direction at its start.
fn straightened(scenario: &mut Scenario) {
    let line = match &scenario.task {
        Task::Chain(points) | Task::Spline(points) => match points.as_slice() {
            [from, to, ..] => vec![*from, *to],
            _ => return,
        },
        Task::Arc { .. } => return,
    };
    let task = Task::Chain(line);
    if Way::new(&task).is_some() {
        scenario.task = task;
    }
}
