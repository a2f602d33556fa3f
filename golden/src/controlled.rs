//! This file holds the cases of chapter 6: a hand follows a line, led by each controller in turn, on both layouts.

mod hand;
mod steered;

use rigproof_model::ModelError;
use rigproof_model::control::path::Line;
use rigproof_model::control::{Controller, Sensed};
use rigproof_model::operator::{Abilities, Hand, Operator};
use rigproof_model::rig::Rig;
use rigproof_model::trial::{LINES, Segment, run};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;

use self::hand::{Held, Replayed};
use self::steered::{Steered, must_show};
use crate::Error;
use crate::case::{Case, Parameter, Run};
use crate::release::name;
use crate::table::{RUN, Table};

/// Time for which a force is held, and between the rows, s.
const ROWS_S: f64 = 0.02;
/// Ticks of the controller in that time.
const ROWS_TICKS: usize = 20;
/// A run ends here at the latest, s.
const LONGEST_S: f64 = 4.0;
/// Seed of the simulated operator.
const SEED: u64 = 4127;
/// A hand that strays 2 cm, so that gap and wall are left and entered (decision 0060).
const ABILITIES: Abilities = Abilities {
    aim_error_m: 0.02,
    ..Abilities::CAREFUL
};
/// The line that is followed: the second of decision 0047, oblique to both axes.
const SEGMENT: Segment = {
    let [_, oblique] = LINES;
    oblique
};

/// The cases of both layouts.
pub fn cases() -> Vec<Case> {
    [Layout::ThreeBrake, Layout::FourBrake].map(case).into()
}

fn case(layout: Layout) -> Case {
    let case = format!("path_{}", name(layout));
    let [[from_x, from_y], [to_x, to_y]] = [SEGMENT.from_m, SEGMENT.to_m];
    let of = case.clone();
    Case {
        name: case.clone(),
        purpose: "A simulated operator follows a line, led by each controller in turn; its force, once drawn, is the input, so that no hand is needed to repeat a run.".to_owned(),
        citations: vec!["(6.1)", "(6.3)", "(6.8)", "(6.13)", "§2.2.2", "§6.1", "§6.2", "§6.3", "§6.5.1", "§7.3"],
        step_s: SAMPLE_STEP_S,
        rows_s: ROWS_S,
        parameters: vec![
            Parameter::word("layout", name(layout)),
            Parameter::number("line from x, where the tip starts at rest", from_x, "m"),
            Parameter::number("line from y", from_y, "m"),
            Parameter::number("line to x", to_x, "m"),
            Parameter::number("line to y", to_y, "m"),
            Parameter::number("force held for", ROWS_S, "s"),
            Parameter::number("longest duration", LONGEST_S, "s"),
            Parameter::word("hand", format!("the careful operator of decision 0047 with another error of the aim, seed {SEED}")),
            Parameter::number("error of the aim", ABILITIES.aim_error_m, "m"),
        ],
        runs: Steered::ALL.map(|steered| Run {
            what: steered.name().to_owned(),
            parameters: steered.parameters(),
        }).into(),
        must_show: must_show(layout),
        input: Box::new(move |()| input(layout).map_err(|error| Error::model(&of, error))),
        expected: Box::new(move |input| expected(&case, layout, input)),
    }
}

/// The forces that the operator pushes with under each controller; a row holds until the next, the last ends the run.
fn input(layout: Layout) -> Result<Table, ModelError> {
    let mut table = Table::new(&[(RUN, ""), ("time", "s"), ("force_x", "N"), ("force_y", "N")]);
    let line = Line::through(SEGMENT.from_m, SEGMENT.to_m)?;
    let [[from_x, from_y], [to_x, to_y]] = [SEGMENT.from_m, SEGMENT.to_m];
    let past_end =
        |[x, y]: [f64; 2]| (x - to_x) * (to_x - from_x) + (y - to_y) * (to_y - from_y) >= 0.0;
    for (index, steered) in Steered::ALL.into_iter().enumerate() {
        let mut hand = Held::new(Operator::new(line, ABILITIES, SEED)?);
        let seen = seen(layout, steered, &mut hand, LONGEST_S, past_end)?;
        let mut row = |tick: usize, force_n: [f64; 2]| {
            let [x, y] = force_n;
            table.push(index + 1, &[tick as f64 * SAMPLE_STEP_S, x, y]);
        };
        for (place, force_n) in hand.forces_n.iter().enumerate() {
            row(place * ROWS_TICKS, *force_n);
        }
        row(seen.len(), [0.0; 2]);
    }
    Ok(table)
}

fn expected(case: &str, layout: Layout, input: &Table) -> Result<Table, Error> {
    let mut table = Table::new(&[
        (RUN, ""),
        ("time", "s"),
        ("tip_x", "m"),
        ("tip_y", "m"),
        ("angle_a", "rad"),
        ("angle_b", "rad"),
        ("speed_a", "rad/s"),
        ("speed_e", "rad/s"),
        ("speed_b", "rad/s"),
        ("speed_c", "rad/s"),
        ("current_a", "A"),
        ("current_e", "A"),
        ("current_b", "A"),
        ("current_c", "A"),
        ("reason", ""),
    ]);
    for (index, steered) in Steered::ALL.into_iter().enumerate() {
        let number = index + 1;
        let times_s = input.numbers(number, "time")?;
        let (x, y) = (
            input.numbers(number, "force_x")?,
            input.numbers(number, "force_y")?,
        );
        let mut hand = Replayed::new(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect());
        let end_s = times_s.last().copied().unwrap_or_default();
        let seen = seen(layout, steered, &mut hand, end_s, |_| false)
            .map_err(|error| Error::model(case, error))?;
        for (place, (sensed, command)) in seen.iter().step_by(ROWS_TICKS).enumerate() {
            let time_s = (place * ROWS_TICKS) as f64 * SAMPLE_STEP_S;
            let mut row = vec![time_s];
            row.extend(sensed.pose.tip_m);
            row.extend([sensed.pose.theta_a_rad, sensed.pose.theta_b_rad]);
            row.extend(sensed.omega_rad_s);
            row.extend(command.currents_a);
            table.push(number, &row);
            table.extend([word(command.reason)]);
        }
    }
    Ok(table)
}

/// What the controller was told and asked for in every tick of a run.
fn seen(
    layout: Layout,
    steered: Steered,
    hand: &mut dyn Hand,
    longest_s: f64,
    ended: impl Fn([f64; 2]) -> bool,
) -> Result<Vec<(Sensed, Command)>, ModelError> {
    let line = Line::through(SEGMENT.from_m, SEGMENT.to_m)?;
    let mut rig = Rig::new(layout, SEGMENT.from_m)?;
    let mut watched = Watched {
        inner: steered.controller(layout, line)?,
        seen: Vec::new(),
    };
    run(&mut rig, &mut watched, hand, longest_s, ended)?;
    Ok(watched.seen)
}

/// A controller that is watched.
struct Watched {
    inner: Box<dyn Controller>,
    seen: Vec<(Sensed, Command)>,
}

impl Controller for Watched {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let command = self.inner.command(sensed);
        self.seen.push((*sensed, command));
        command
    }
}

/// The word for a reason in the column `reason`.
fn word(reason: Reason) -> String {
    match reason {
        Reason::Chosen(joint) => format!("chosen_{}", joint.letter()),
        Reason::ChosenPair(one, other) => format!("chosen_{}_{}", one.letter(), other.letter()),
        Reason::LockedPushedAway => "locked_pushed_away".to_owned(),
        Reason::LockedMovingBack => "locked_moving_back".to_owned(),
        Reason::InsideGap => "inside_gap".to_owned(),
        Reason::FreeSide => "free_side".to_owned(),
        Reason::NoneHelps => "none_helps".to_owned(),
        Reason::SingularPose => "singular_pose".to_owned(),
        Reason::NothingToDo => "nothing_to_do".to_owned(),
        Reason::UndefinedInput => "undefined_input".to_owned(),
        Reason::Uncontrolled => "uncontrolled".to_owned(),
        Reason::Starting => "starting".to_owned(),
        Reason::StaleSample => "stale_sample".to_owned(),
        Reason::JumpedCounts => "jumped_counts".to_owned(),
        Reason::RefusedCommand => "refused_command".to_owned(),
    }
}
