//! Figures 3.21 and 3.22: the virtual spring and the virtual wall, in open and in closed loop.

use rigproof_model::brake::{Brake, OneJoint, SPRING_NM_PER_DEG, VirtualSpring, WALL_NM_PER_DEG};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, brake_table};
use rigproof_spec::units::{deg_from_rad, rad_from_deg, rad_s_from_rpm};

use super::bench::{SAMPLE_S, each};
use super::matrix::SCATTER_NM_PER_A;
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The virtual spring.
pub const SPRING: Experiment = Experiment {
    id: "3.21",
    title: "Virtual spring control experiment",
    what: "Each brake, a standard deviation of §3.4.1 stronger than its table, turned at 10 rpm through 80° into a spring of 0.05 N·m/° and out again, in open loop and with the highest feedback gain that induces no vibration.",
    run: spring,
};

/// The virtual wall.
pub const WALL: Experiment = Experiment {
    id: "3.22",
    title: "Virtual wall control experiment",
    what: "As figure 3.21 against a wall of 500 N·m/° whose look-up table ends at 4 N·m; the text does not say where its table ends.",
    run: wall,
};

/// Where the look-up tables end, N·m: every brake reaches it.
const MOST_NM: f64 = 4.0;
/// How far the shaft is turned before the spring and into it, degrees.
const BEFORE_DEG: f64 = 5.0;
const INTO_DEG: f64 = 80.0;

/// One run, one value a sample.
#[derive(Clone, Debug, Default)]
struct Run {
    time_s: Vec<f64>,
    theta_deg: Vec<f64>,
    desired_nm: Vec<f64>,
    torque_nm: Vec<f64>,
    current_a: Vec<f64>,
}

/// A brake that is one standard deviation of the settled torque stronger than its table.
fn stronger(joint: Joint) -> BrakeTable {
    let mut table = brake_table(joint);
    table.torque_gain.k_1 += SCATTER_NM_PER_A;
    table.torque_gain.k_4 += SCATTER_NM_PER_A;
    table
}

/// Turns the brake into the spring and out again at 10 rpm; the controller sees the torque of the sample before.
fn turn(joint: Joint, stiffness_nm_per_deg: f64, feedback_gain: f64) -> Run {
    let start_rad = rad_from_deg(BEFORE_DEG);
    let control = OneJoint {
        table: brake_table(joint),
        spring: VirtualSpring {
            stiffness_nm_per_deg,
            start_rad,
            most_nm: MOST_NM,
        },
        feedback_gain,
    };
    let omega_rad_s = rad_s_from_rpm(10.0);
    let way_rad = rad_from_deg(BEFORE_DEG + INTO_DEG);
    let mut brake = Brake::of(stronger(joint), 0.0);
    let (mut run, mut torque_nm) = (Run::default(), 0.0);
    for sample in 1..=(2.0 * way_rad / omega_rad_s / SAMPLE_S) as u32 {
        let time_s = SAMPLE_S * f64::from(sample);
        let travelled_rad = omega_rad_s * time_s;
        let (theta_rad, speed) = if travelled_rad < way_rad {
            (travelled_rad, omega_rad_s)
        } else {
            (2.0 * way_rad - travelled_rad, -omega_rad_s)
        };
        let current_a = control.current(theta_rad, torque_nm);
        torque_nm = brake.step(current_a, theta_rad, speed, SAMPLE_S);
        run.time_s.push(time_s);
        run.theta_deg.push(deg_from_rad(theta_rad));
        run.desired_nm
            .push(control.spring.desired_torque(theta_rad));
        run.torque_nm.push(torque_nm);
        run.current_a.push(current_a);
    }
    run
}

impl Run {
    /// The samples on the way in, from a compression on: desired and metered torque.
    fn inward(&self, from_deg: f64) -> impl Iterator<Item = (f64, f64)> {
        let half = self.time_s.len() / 2;
        let columns = self
            .theta_deg
            .iter()
            .zip(&self.desired_nm)
            .zip(&self.torque_nm);
        columns
            .take(half)
            .filter(move |((theta, _), _)| **theta > BEFORE_DEG + from_deg)
            .map(|((_, desired), torque)| (*desired, *torque))
    }

    /// Root mean square of metered less desired torque on the way in, N·m.
    fn error_nm(&self, from_deg: f64) -> f64 {
        let (sum, count) = self
            .inward(from_deg)
            .map(|(desired, torque)| (torque - desired) * (torque - desired))
            .fold((0.0, 0.0), |(sum, count), square| {
                (sum + square, count + 1.0)
            });
        libm::sqrt(sum / count)
    }

    /// Time from the wall to 63.2 % of the settled torque, s.
    fn response_s(&self) -> f64 {
        let settled_nm = self
            .inward(40.0)
            .last()
            .map_or(f64::NAN, |(_, torque)| torque);
        let first = |columns: &[f64], level: f64| {
            let index = columns.iter().position(|x| *x > level)?;
            self.time_s.get(index).copied()
        };
        let reached = first(&self.torque_nm, (1.0 - libm::exp(-1.0)) * settled_nm);
        let wall = first(&self.theta_deg, BEFORE_DEG);
        reached
            .zip(wall)
            .map_or(f64::NAN, |(reached, wall)| reached - wall)
    }

    /// Whether the torque swings: turning points larger than 10 mN·m on the way in, away from the ends of the table.
    fn vibrates(&self, from_deg: f64) -> bool {
        let torque: Vec<f64> = self
            .inward(from_deg)
            .map(|(desired, torque)| torque - desired)
            .collect();
        let (mut turns, mut extreme, mut sense) = (0, torque.first().copied().unwrap_or(0.0), 0.0);
        for value in torque {
            let away = value - extreme;
            if away * sense >= 0.0 && away != 0.0 {
                (extreme, sense) = (value, away.signum());
            } else if away.abs() > 0.01 {
                turns += 1;
                (extreme, sense) = (value, away.signum());
            }
        }
        turns > 4
    }

    fn columns(&self, loop_name: &str) -> Vec<Column> {
        vec![
            Column::numbers(format!("current {loop_name}"), "A", &self.current_a),
            Column::numbers(format!("torque {loop_name}"), "N·m", &self.torque_nm),
        ]
    }
}

/// The highest feedback gain, in tenths, that induces no vibration.
fn highest_gain(joint: Joint, stiffness_nm_per_deg: f64) -> f64 {
    let gains = (1..=200).map(|tenths| 0.1 * f64::from(tenths));
    gains
        .take_while(|gain| !turn(joint, stiffness_nm_per_deg, *gain).vibrates(1.0))
        .last()
        .unwrap_or(0.0)
}

/// Both loops of every brake: joint, feedback gain, open, closed.
fn loops(stiffness_nm_per_deg: f64) -> [(Joint, f64, Run, Run); 4] {
    Joint::ALL.map(|joint| {
        let gain = highest_gain(joint, stiffness_nm_per_deg);
        let open = turn(joint, stiffness_nm_per_deg, 0.0);
        let closed = turn(joint, stiffness_nm_per_deg, gain);
        (joint, gain, open, closed)
    })
}

fn outcome(
    title: &str,
    runs: &[(Joint, f64, Run, Run)],
    by_time: bool,
    findings: Vec<Finding>,
) -> Outcome {
    let mut outcome = Outcome {
        findings,
        ..Outcome::default()
    };
    for (joint, gain, open, closed) in runs {
        let name = super::bench::name(*joint);
        let mut signals = vec![
            Column::numbers("position", "deg", &open.theta_deg),
            Column::numbers("desired torque", "N·m", &open.desired_nm),
        ];
        signals.extend(open.columns("open loop"));
        signals.extend(closed.columns("closed loop"));
        outcome
            .tables
            .push(Table::run(name.clone(), &open.time_s, signals));
        let (x, axis) = match by_time {
            true => (&open.time_s, ("time", "s")),
            false => (&open.theta_deg, ("position", "°")),
        };
        // Only the neighbourhood of the wall shows its response.
        let shown = if by_time { 400 } else { x.len() };
        let curve = |name: &str, y: &[f64]| {
            Curve::line(
                name,
                x.get(..shown).unwrap_or(x),
                y.get(..shown).unwrap_or(y),
            )
        };
        outcome.pictures.push(Picture {
            name,
            title: format!("{title}, brake {}", joint.letter()),
            subtitle: format!(
                "a brake one standard deviation stronger than its table; feedback gain {gain:.1}"
            ),
            panels: vec![Panel::new(
                axis,
                ("torque", "N·m"),
                vec![
                    curve("desired", &open.desired_nm),
                    curve("open loop", &open.torque_nm),
                    curve("closed loop", &closed.torque_nm),
                ],
            )],
        });
    }
    outcome
}

fn spring() -> Result<Outcome, Error> {
    let runs = loops(SPRING_NM_PER_DEG);
    // From where the spring asks for more than the off-state torque.
    let errors = runs
        .each_ref()
        .map(|(j, _, open, closed)| (*j, open.error_nm(15.0), closed.error_nm(15.0)));
    let worst = errors.iter().map(|e| e.1).fold(0.0, f64::max);
    let pairs = pairs(&errors, "N·m");
    let findings = vec![
        Finding::claim(
            "§3.6",
            "the error of the open loop is in the acceptable range",
            "acceptable, likely not detectable",
            (
                format!("root mean square, open and closed loop: {pairs}"),
                worst < SCATTER_NM_PER_A,
            ),
            "the text gives no limit: taken as the scatter of the settled torque at 1 A, 0.4 N·m",
        ),
        zero_on_the_way_out(&runs),
        gains(&runs),
    ];
    Ok(outcome(SPRING.title, &runs, false, findings))
}

fn wall() -> Result<Outcome, Error> {
    let runs = loops(WALL_NM_PER_DEG);
    let errors = runs
        .each_ref()
        .map(|(j, _, open, closed)| (*j, open.error_nm(20.0), closed.error_nm(20.0)));
    let times = runs
        .each_ref()
        .map(|(j, _, open, closed)| (*j, 1e3 * open.response_s(), 1e3 * closed.response_s()));
    let reduced = errors.iter().all(|(_, open, closed)| closed < open);
    let same = times
        .iter()
        .all(|(_, open, closed)| (open - closed).abs() <= 1.0);
    let findings = vec![
        Finding::claim(
            "§3.6",
            "feedback reduces the error in the steady region",
            "reduces",
            (format!("open and closed loop: {}", pairs(&errors, "N·m")), reduced),
            "on every brake",
        ),
        Finding::claim(
            "§3.6",
            "feedback has no effect on the response time",
            "no effect",
            (format!("63 % of the step, open and closed loop: {}", pairs(&times, "ms")), same),
            "within one sample of 1 ms; before the inverse gain, feedback asks for more than the wall while the torque lags",
        )
        .accounted("torque-feedback"),
        gains(&runs),
    ];
    Ok(outcome(WALL.title, &runs, true, findings))
}

fn pairs(values: &[(Joint, f64, f64)], unit: &str) -> String {
    each(|joint| {
        let of = values.iter().find(|v| v.0 == joint);
        of.map_or_else(String::new, |(_, open, closed)| {
            format!("{open:.2} and {closed:.2} {unit}")
        })
    })
}

fn zero_on_the_way_out(runs: &[(Joint, f64, Run, Run)]) -> Finding {
    let most = runs
        .iter()
        .flat_map(|(_, _, open, closed)| [open, closed])
        .map(|run| {
            let half = run.time_s.len() / 2;
            // The first sample after the turn still shows the torque of the way in.
            run.current_a
                .iter()
                .skip(half + 3)
                .copied()
                .fold(0.0, f64::max)
        });
    let most = most.fold(0.0, f64::max);
    Finding::claim(
        "§3.6",
        "the current is zero in the direction moving out of the spring",
        "zero",
        (format!("{most} A at most"), most == 0.0),
        "three samples after the turn and later",
    )
}

fn gains(runs: &[(Joint, f64, Run, Run)]) -> Finding {
    let gain = |joint: Joint| {
        runs.iter()
            .find(|run| run.0 == joint)
            .map_or(f64::NAN, |run| run.1)
    };
    Finding::lost(
        "§3.6",
        "the highest feedback gain without detectable vibration",
        each(|joint| format!("{:.1}", gain(joint))),
        "the text gives no gain; here the first that swings the torque by more than 10 mN·m, in tenths, at 1 kHz",
    )
}
