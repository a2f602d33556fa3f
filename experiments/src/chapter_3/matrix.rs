//! This file runs the step tests of §3.4 on the model: every current and speed of the matrix, three steps each.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use rigproof_model::brake::identify::{TRANSIENT, fit_step};
use rigproof_model::brake::time_constant;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::Edge;
use rigproof_spec::units::rad_s_from_rpm;

use super::bench::{Command, Recorded, SAMPLE_S, turn};
use crate::{Column, Error, Table};

/// The currents of the matrix other than zero, A (§3.4).
pub const CURRENTS_A: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];
/// The speeds of the matrix, rpm (§3.4).
pub const SPEEDS_RPM: [f64; 8] = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
/// Standard deviation of a settled torque over its current, N·m/A: "generally increases with increasing current, with a
/// maximum of about .4" (§3.4.1).
pub const SCATTER_NM_PER_A: f64 = 0.4;

/// What one current at one speed gave.
#[derive(Clone, Debug)]
pub struct Cell {
    pub current_a: f64,
    pub speed_rpm: f64,
    /// Settled torques of the three steps, with scatter, N·m.
    pub torques_nm: [f64; 3],
    /// Time constants read off the model's transients by (3.4), s.
    pub rising_s: f64,
    pub falling_s: f64,
}

/// The matrix of one brake; the row without current has no time constants.
pub fn matrix(joint: Joint) -> Result<Vec<Cell>, Error> {
    let letter = joint.letter().bytes().next().unwrap_or_default();
    let mut random = Pcg64Mcg::seed_from_u64(u64::from(letter));
    let mut cells = Vec::new();
    for speed_rpm in SPEEDS_RPM {
        for current_a in [0.0].into_iter().chain(CURRENTS_A) {
            let mut cell = cell(joint, current_a, speed_rpm)?;
            for torque_nm in &mut cell.torques_nm {
                let draw: f64 = StandardNormal.sample(&mut random);
                *torque_nm += SCATTER_NM_PER_A * current_a * draw;
            }
            cells.push(cell);
        }
    }
    Ok(cells)
}

/// One step up and down again, without scatter.
fn cell(joint: Joint, current_a: f64, speed_rpm: f64) -> Result<Cell, Error> {
    let omega_rad_s = rad_s_from_rpm(speed_rpm);
    let slowest_s = time_constant(joint, current_a.max(0.2), omega_rad_s, Edge::Rising);
    // Time to leave the backlash first, and to settle after either step.
    let clear_s = 0.04 / omega_rad_s + 0.3;
    let held_s = 14.0 * slowest_s.max(0.012);
    let run = turn(joint, clear_s + 2.0 * held_s, |time_s| Command {
        current_a: if (clear_s..clear_s + held_s).contains(&time_s) {
            current_a
        } else {
            0.0
        },
        theta_rad: omega_rad_s * time_s,
        omega_rad_s,
    });
    let at = |time_s: f64| ((time_s / SAMPLE_S) as usize).saturating_sub(2);
    let torque = |time_s: f64| run.torque_nm.get(at(time_s)).copied().unwrap_or(f64::NAN);
    let (off, on, last) = (
        torque(clear_s),
        torque(clear_s + held_s),
        torque(clear_s + 2.0 * held_s),
    );
    let (rising_s, falling_s) = if current_a > 0.0 {
        let up = edge(&run, at(clear_s), at(clear_s + held_s), [off, on]);
        let down = edge(&run, at(clear_s + held_s), run.time_s.len(), [on, last]);
        (up?, down?)
    } else {
        (f64::NAN, f64::NAN)
    };
    Ok(Cell {
        current_a,
        speed_rpm,
        torques_nm: [on; 3],
        rising_s,
        falling_s,
    })
}

fn edge(run: &Recorded, first: usize, end: usize, ends_nm: [f64; 2]) -> Result<f64, Error> {
    let (time_s, torque_nm) = (run.time_s.get(first..end), run.torque_nm.get(first..end));
    let fit = time_s
        .zip(torque_nm)
        .and_then(|(t, torque)| fit_step(t, torque, ends_nm, 0.0, TRANSIENT));
    fit.map(|fit| fit.time_constant_s).ok_or_else(|| {
        Error::model(
            "the time constant of a step",
            "its transient holds fewer than three samples",
        )
    })
}

/// The matrix as a table.
pub fn table(name: &str, cells: &[Cell]) -> Table {
    let column = |pick: fn(&Cell) -> f64| -> Vec<f64> { cells.iter().map(pick).collect() };
    Table::new(
        name,
        vec![
            Column::numbers("current", "A", &column(|c| c.current_a)),
            Column::numbers("speed", "rpm", &column(|c| c.speed_rpm)),
            Column::numbers(
                "torque",
                "N·m",
                &column(|c| c.torques_nm.iter().sum::<f64>() / 3.0),
            ),
            Column::numbers("rising", "s", &column(|c| c.rising_s)),
            Column::numbers("falling", "s", &column(|c| c.falling_s)),
        ],
    )
}
