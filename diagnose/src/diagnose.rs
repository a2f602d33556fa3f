//! This file runs the stages in order: align, locate, explain, refit, show.

mod description;
pub(crate) mod ended;
mod fitted;
mod stages;
pub(crate) mod words;
pub(crate) mod write;

use crate::align::{Fault, band_hz};
use crate::evidence::{coefficients_by_term, parameters};
use crate::from_rig;
use crate::problem::{Cause, Problem, Term, is_of_brake};
use crate::report::Report;
use crate::rules::{ANOTHER_UNIT, HOLD_OUT_SHARE, LEAST_TRAVEL_SIGMAS};
use crate::run::Run;
use crate::scatter::{Trials, left_over};
use crate::select::{FLOOR_RATIO, Gates, Selection, is_noise, refs, select};
use crate::unknown::surrogates;
use crate::weak::{FEWEST_WINDOWS, Windows, choose_width};
pub use description::{Description, Measured};
use ended::{faulty, not_excited};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::Trace;
use rigproof_trace::rig::{Recording, Rig};
use write::Stand;

/// What a diagnosis is asked to do.
#[derive(Clone, Debug)]
pub struct Options {
    /// What a mechanism must show before it is named.
    pub gates: Gates,
    /// Share of the recording's end that is held out when no other recording is.
    pub hold_out_share: f64,
    /// Whether the numbers are refitted by free runs (the naming does not need it).
    pub refit: bool,
    /// Whether the experiment is looked for that tells a five-bar's rival explanations apart.
    pub next_experiment: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            gates: Gates::default(),
            hold_out_share: HOLD_OUT_SHARE,
            refit: true,
            next_experiment: true,
        }
    }
}

/// A report, the calibrated model, and the curves that its pictures need.
pub struct Diagnosis {
    /// What was found.
    pub report: Report,
    /// The rig with the physics found and the numbers fitted.
    pub calibration: Description,
    /// Curves for the pictures; empty after a fault.
    pub curves: Curves,
    /// The experiment that would tell rival explanations apart, where there is one.
    pub experiment: Option<Trace>,
}

/// Curves over time: of the held-out part before and after, and the residual of the windows.
#[derive(Clone, Debug, Default)]
pub struct Curves {
    /// Time stamps of the held-out part, s.
    pub time_s: Vec<f64>,
    /// What the output is, in words.
    pub output: &'static str,
    /// Recorded output: position of an axis, effort of a bench, on the five-bar the effort on one of its arms; not a number where it
    /// does not count.
    pub recorded: Vec<f64>,
    /// Output of the nominal model.
    pub before: Vec<f64>,
    /// Output with the named mechanisms.
    pub after: Vec<f64>,
    /// Unit of the output.
    pub unit: String,
    /// Window times of the fitted part, s.
    pub window_time_s: Vec<f64>,
    /// Which windows count in the naming: at rest and across a reversal they do not.
    pub window_counts: Vec<bool>,
    /// Residual effort with the nominal model.
    pub residual_before: Vec<f64>,
    /// Residual effort with the named mechanisms.
    pub residual_after: Vec<f64>,
    /// Predicted standard deviation of the residual.
    pub floor: f64,
    /// Unit of the residual.
    pub residual_unit: String,
    /// The same output on the part that was fitted.
    pub fitted: FittedCurves,
}

/// Recorded output and both models on the part that was fitted; empty where it was not asked for.
#[derive(Clone, Debug, Default)]
pub struct FittedCurves {
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// Recorded output; not a number where it does not count.
    pub recorded: Vec<f64>,
    /// Output of the nominal model.
    pub before: Vec<f64>,
    /// Output with the named mechanisms.
    pub after: Vec<f64>,
}

/// Diagnoses a recording of a rig; `held_out` is another recording of the same rig.
pub fn diagnose(
    rig: &Rig,
    recording: &Recording,
    held_out: Option<&Recording>,
    options: &Options,
) -> Diagnosis {
    let aligned = match from_rig::aligned(rig, recording) {
        Ok(run) => run,
        Err(fault) => return faulty(Description::Joint(rig.clone()), "recording", fault),
    };
    let (train, test) = match held_out {
        Some(recording) => match from_rig::aligned(rig, recording) {
            Ok(run) => (aligned, run),
            Err(fault) => {
                return faulty(Description::Joint(rig.clone()), "held-out recording", fault);
            }
        },
        None => split(&aligned, options.hold_out_share),
    };
    let inertia = from_rig::inertia(rig);
    let width_s = choose_width(
        &train,
        inertia.start(),
        band_hz(&train.effort, train.step_s),
    );
    let windows = Windows::new(&train, width_s);
    let mut problem = Problem::new(&train, windows, inertia);
    let usable = problem.windows.usable.iter().filter(|u| **u).count();
    if usable < FEWEST_WINDOWS || train.travel() < LEAST_TRAVEL_SIGMAS * train.position_noise {
        let (travel, noise) = (train.travel(), train.position_noise);
        return not_excited(Description::Joint(rig.clone()), usable, travel, noise);
    }
    if let Some(fault) = without_brake(rig, &train) {
        return faulty(Description::Joint(rig.clone()), "description", fault);
    }
    let terms = nominal(rig, &problem);
    let mut selection = select(&mut problem, terms, options.gates);
    if let Some(fault) = another_drive(&problem, &selection) {
        return faulty(Description::Joint(rig.clone()), "recording", fault);
    }
    let mut withdrawn = withdraw_surrogates(&problem, &train, &mut selection, rig);
    let trials = scattered(&problem, &train, &selection);
    if let Some(trials) = trials.clone() {
        let windows = problem.windows.clone();
        problem = Problem::new(&train, windows, inertia).within(trials);
        let terms = nominal(rig, &problem);
        selection = select(&mut problem, terms, options.gates);
        withdrawn = withdraw_surrogates(&problem, &train, &mut selection, rig);
    }
    Stand {
        trials: trials.as_ref(),
        rig,
        problem: &problem,
        selection: &selection,
        withdrawn: &withdrawn,
        train: &train,
        test: &test,
        options,
        width_s,
    }
    .report(held_out.is_some())
}

/// Something that only a brake does in the description of a plant without a brake and its current.
fn without_brake(rig: &Rig, run: &Run) -> Option<Fault> {
    let effects = from_rig::nominal(rig);
    let effect = effects
        .iter()
        .find(|n| is_of_brake(n.cause.mechanism) && run.brake().is_none())?;
    Some(Fault {
        channel: "effect",
        from_s: 0.0,
        to_s: 0.0,
        reason: format!(
            "`{}` is something that a brake does; take it out, or describe the brake and its current",
            effect.cause.name()
        ),
    })
}

/// The physics of the nominal model as terms.
fn nominal(rig: &Rig, problem: &Problem) -> Vec<Term> {
    let effects = from_rig::nominal(rig);
    let terms = effects.iter().filter_map(|n| problem.nominal_term(n));
    terms.collect()
}

/// The trials of a brake, where it is their gains that differ and hide what else may be left out.
fn scattered(problem: &Problem, run: &Run, selection: &Selection) -> Option<Trials> {
    let trials = Trials::of(run, &problem.windows)?;
    let terms = refs(&selection.nominal, &selection.found);
    let residual = left_over(problem, run, &terms, &selection.after);
    let least = FLOOR_RATIO * problem.floor;
    let scatter = trials.scatter(&residual, &problem.windows.usable, least);
    scatter.map(|_| trials)
}

/// A gain error of more than the whole gain is a channel with the wrong sign; a gain of another size is no physics.
fn another_drive(problem: &Problem, selection: &Selection) -> Option<Fault> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let terms = refs(&selection.nominal, &selection.found);
    let fraction = terms
        .iter()
        .zip(&coefficients)
        .find(|(term, _)| term.cause.mechanism == Mechanism::GainError)
        .and_then(|(term, own)| parameters(term, own).first().copied())?;
    let gain = 1.0 + fraction;
    let reason = if gain < 0.0 {
        "the plant answers against its drive: the command, the force or the position has the wrong sign (set `sign = -1`), or the two channels are swapped".to_owned()
    } else if !(1.0 / ANOTHER_UNIT..ANOTHER_UNIT).contains(&gain) {
        format!(
            "the plant answers as if its drive were {gain:.3} times what is described: the unit of the position or of the command is another one (degrees for radians make 57.3 or 0.0175, thousandths 1000 or 0.001), or the two channels are swapped; correct the description"
        )
    } else {
        return None;
    };
    Some(Fault {
        channel: "drive",
        from_s: problem.plant.start_s(),
        to_s: problem.plant.start_s() + problem.plant.duration_s(),
        reason,
    })
}

/// Takes out the names that only stand in for another law, where more than noise is left.
fn withdraw_surrogates(
    problem: &Problem,
    run: &Run,
    selection: &mut Selection,
    rig: &Rig,
) -> Vec<Cause> {
    if is_noise(problem, &selection.after) {
        return Vec::new();
    }
    let found: Vec<Mechanism> = selection
        .found
        .iter()
        .map(|f| f.term.cause.mechanism)
        .collect();
    let residual = &selection.after.residual;
    let withdrawn: Vec<Cause> = surrogates(problem, run, residual, &found, rig.motion)
        .into_iter()
        .map(Cause::of)
        .collect();
    selection.withdraw(problem, &withdrawn);
    withdrawn
}

fn split(run: &Run, share: f64) -> (Run, Run) {
    let cut = ((1.0 - share) * run.len() as f64).round() as usize;
    (run.slice(0, cut), run.slice(cut, run.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::recorded::{EFFORT_NOISE, Laws, NOMINAL, QUANTUM, exact_axis, exact_bench, signals};
    use crate::report::Verdict;
    use rigproof_trace::{Channel, Trace};
    use std::path::Path;

    fn rig(plant: &str, rest: &str) -> Rig {
        let effort = if plant == "axis" { "command" } else { "force" };
        let text = format!(
            "name = \"slide\"\nplant = \"{plant}\"\nmotion = \"linear\"\n[channels]\n\
             position = {{ channel = \"x\", unit = \"m\", quantum = {QUANTUM:e} }}\n\
             {effort} = {{ channel = \"f\", unit = \"N\", noise = {EFFORT_NOISE} }}\n{rest}[protocol]\ndrive = \"held\"\n"
        );
        Rig::parse(&text, Path::new("rig.toml")).unwrap()
    }

    const VISCOUS: &str = "[[effect]]\nmechanism = \"viscous\"\n\
        coefficient = { value = 6.1, unit = \"N·s/m\", status = \"unknown\" }\n";

    fn axis() -> Rig {
        let rest = format!(
            "[parameters]\ninertia = {{ value = 1.29, unit = \"kg\", status = \"unknown\" }}\n\
             command_gain = {{ value = 1.0, unit = \"N/N\" }}\n{VISCOUS}\
             [[effect]]\nmechanism = \"spring\"\n\
             stiffness = {{ value = 39.0, unit = \"N/m\", status = \"unknown\" }}\n"
        );
        rig("axis", &rest)
    }

    fn recording(rig: &Rig, exact: &Run) -> Recording {
        let seen = signals(exact, 71);
        let channel = |name: &str, unit: &str, samples| Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples,
        };
        let trace = Trace {
            time_s: seen.time_s,
            channels: vec![
                channel("x", "m", seen.position),
                channel("f", "N", seen.effort),
            ],
        };
        rig.apply(&trace, Path::new("test")).unwrap()
    }

    fn named(diagnosis: &Diagnosis) -> Vec<&str> {
        diagnosis
            .report
            .effects
            .iter()
            .map(|e| e.mechanism)
            .collect()
    }

    const DRY: (Mechanism, &[f64]) = (Mechanism::DryOffset, &[1.73]);

    /// An axis and a bench with their nominal laws and these.
    fn both(left_out: Laws) -> [Diagnosis; 2] {
        let laws = [NOMINAL, left_out].concat();
        let rig_a = axis();
        let exact = exact_axis(&laws, 15_300, true);
        let a = diagnose(
            &rig_a,
            &recording(&rig_a, &exact),
            None,
            &Options::default(),
        );
        let laws = [&[(Mechanism::Viscous, &[7.3][..])][..], left_out].concat();
        let rig_b = rig("bench", VISCOUS);
        let exact = exact_bench(&laws, 15_300);
        let b = diagnose(
            &rig_b,
            &recording(&rig_b, &exact),
            None,
            &Options::default(),
        );
        [a, b]
    }

    #[test]
    fn with_nothing_left_out_the_answer_is_consistent() {
        for diagnosis in both(&[]) {
            let report = &diagnosis.report;
            assert_eq!(
                report.verdict,
                Verdict::Consistent,
                "{} {:?}",
                report.plant,
                report.floor
            );
            assert!(named(&diagnosis).is_empty());
        }
    }

    #[test]
    fn dry_friction_left_out_is_named_measured_and_shown() {
        for diagnosis in both(&[DRY]) {
            assert_eq!(
                named(&diagnosis),
                ["dry_offset"],
                "{}",
                diagnosis.report.summary
            );
            // A bristle much shorter than the travel is dry friction: the only rival there may be.
            let rivals = &diagnosis.report.ambiguous_with[0];
            assert!(rivals.iter().all(|r| *r == "presliding"), "{rivals:?}");
            let level = &diagnosis.report.effects[0].parameters["level"];
            assert!((level.value / 1.73 - 1.0).abs() < 0.02, "{} N", level.value);
            let fit = diagnosis.report.fit.unwrap();
            let held_out = fit.held_out.unwrap();
            assert!(
                fit.improved && held_out.after < 0.1 * held_out.before,
                "{held_out:?}"
            );
        }
    }

    #[test]
    fn a_rest_is_not_excited_and_a_reversed_drive_is_a_fault() {
        let rig = axis();
        let mut still = exact_axis(NOMINAL, 5100, true);
        still.position.fill(0.0137);
        let answer = diagnose(&rig, &recording(&rig, &still), None, &Options::default());
        assert_eq!(answer.report.verdict, Verdict::NotExcited);
        let rig = rig_with_gain_known();
        let mut reversed = exact_axis(NOMINAL, 15_300, true);
        reversed.effort.iter_mut().for_each(|x| *x = -*x);
        let answer = diagnose(&rig, &recording(&rig, &reversed), None, &Options::default());
        assert_eq!(
            answer.report.verdict,
            Verdict::DataFault,
            "{}",
            answer.report.summary
        );
        assert!(answer.report.summary.contains("wrong sign"));
    }

    /// The axis with its inertia known: then the drive's gain can be measured.
    fn rig_with_gain_known() -> Rig {
        let rest = format!(
            "[parameters]\ninertia = {{ value = 1.37, unit = \"kg\" }}\n\
             command_gain = {{ value = 1.0, unit = \"N/N\" }}\n{VISCOUS}\
             [[effect]]\nmechanism = \"spring\"\n\
             stiffness = {{ value = 39.0, unit = \"N/m\", status = \"unknown\" }}\n"
        );
        rig("axis", &rest)
    }
}
