//! This file draws the shape of what no mechanism of the library explains.

use crate::problem::{Problem, Rows};
use crate::regression::{Blocks, left_out_loss};
use crate::report::Unknown;
use rigproof_spec::effect::{Mechanism, Motion, Quantity};
use rigproof_spec::units::Dimension;

/// Knots of the curve.
const KNOTS: usize = 20;
/// Share of the remaining loss that a curve must take away on left-out blocks to be drawn.
const LEAST_SHARE: f64 = 0.02;

/// Screens position, speed, time and effort for the curve that takes away most of the residual, or `None` when no
/// curve over one of them helps.
pub fn unknown(problem: &Problem, residual: &[f64], motion: Motion) -> Option<Unknown> {
    let blocks = Blocks::new(problem);
    let plain = left_out(problem, residual, &[], &blocks);
    variables(problem, motion)
        .into_iter()
        .filter_map(|(name, unit, values)| {
            let curve = hats(problem, &values);
            let share = 1.0 - left_out(problem, residual, &curve, &blocks) / plain.max(1e-300);
            (share > LEAST_SHARE).then_some((name, unit, values, share))
        })
        .max_by(|a, b| a.3.total_cmp(&b.3))
        .map(|(name, unit, values, share)| describe(problem, residual, name, unit, &values, share))
}

/// Share of the remaining loss that a free curve must take away before the named laws over the same variable count
/// as surrogates of another law.
const SURROGATE_SHARE: f64 = 0.3;

/// The found mechanisms that only stand in for another law over their own variable: with them in place, a free
/// curve over that variable still takes most of the remaining loss away.
pub fn surrogates(
    problem: &Problem,
    residual: &[f64],
    found: &[Mechanism],
    motion: Motion,
) -> Vec<Mechanism> {
    let blocks = Blocks::new(problem);
    let plain = left_out(problem, residual, &[], &blocks);
    let mut surrogates = Vec::new();
    for (name, _, values) in variables(problem, motion) {
        let over: Vec<Mechanism> = found
            .iter()
            .copied()
            .filter(|m| variable_of(*m) == Some(name))
            .collect();
        if over.is_empty() {
            continue;
        }
        let share =
            1.0 - left_out(problem, residual, &hats(problem, &values), &blocks) / plain.max(1e-300);
        if share > SURROGATE_SHARE {
            surrogates.extend(over);
        }
    }
    surrogates
}

/// The variable that a memoryless law is a function of.
fn variable_of(mechanism: Mechanism) -> Option<&'static str> {
    match mechanism {
        Mechanism::DryOffset
        | Mechanism::Viscous
        | Mechanism::Stribeck
        | Mechanism::DirectionAsymmetry => Some("speed"),
        Mechanism::Spring | Mechanism::NonlinearSpring | Mechanism::Ripple => Some("position"),
        Mechanism::BiasDrift => Some("time"),
        Mechanism::GainError => Some("effort"),
        _ => None,
    }
}

fn variables(problem: &Problem, motion: Motion) -> Vec<(&'static str, String, Vec<f64>)> {
    let at = |pick: &dyn Fn(&rigproof_model::effects::Instant) -> f64| -> Vec<f64> {
        let centres = problem.windows.centres.iter();
        centres
            .filter_map(|&c| problem.run.motion.get(c))
            .map(pick)
            .collect()
    };
    let effort = problem.windows.average(&problem.run.effort);
    vec![
        (
            "position",
            Quantity::Travel.dimension(motion).to_string(),
            at(&|now| now.position),
        ),
        (
            "speed",
            Quantity::Speed.dimension(motion).to_string(),
            at(&|now| now.speed),
        ),
        ("time", Dimension::TIME.to_string(), at(&|now| now.time_s)),
        (
            "effort",
            Quantity::Effort.dimension(motion).to_string(),
            effort,
        ),
    ]
}

/// Left-out loss of the residual with a set of columns.
fn left_out(problem: &Problem, residual: &[f64], columns: &[Rows], blocks: &Blocks) -> f64 {
    let white = problem.whitener.whiten(residual);
    left_out_loss(&white, columns, blocks)
}

/// Piecewise linear hats over equal shares of the windows.
fn hats(problem: &Problem, values: &[f64]) -> Vec<Rows> {
    let knots = knots(values);
    (0..knots.len())
        .map(|k| problem.rows_of(values.iter().map(|&v| hat(&knots, k, v)).collect()))
        .collect()
}

fn knots(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let mut knots: Vec<f64> = (0..KNOTS)
        .filter_map(|k| sorted.get(k * last / (KNOTS - 1)).copied())
        .collect();
    knots.dedup();
    knots
}

fn hat(knots: &[f64], k: usize, value: f64) -> f64 {
    let at = |i: Option<usize>| i.and_then(|i| knots.get(i)).copied();
    let (Some(here), before, after) = (at(Some(k)), at(k.checked_sub(1)), at(Some(k + 1))) else {
        return 0.0;
    };
    match (before, after) {
        (Some(b), _) if value < here => ((value - b) / (here - b)).max(0.0),
        (_, Some(a)) if value > here => ((a - value) / (a - here)).max(0.0),
        _ => 1.0,
    }
}

fn describe(
    problem: &Problem,
    residual: &[f64],
    variable: &'static str,
    variable_unit: String,
    values: &[f64],
    share: f64,
) -> Unknown {
    let knots = knots(values);
    let rising = means(
        &knots,
        values,
        residual,
        &problem.windows.usable,
        Some(true),
    );
    let falling = means(
        &knots,
        values,
        residual,
        &problem.windows.usable,
        Some(false),
    );
    let all = means(&knots, values, residual, &problem.windows.usable, None);
    let size = spread(&all);
    let gap: Vec<f64> = rising.iter().zip(&falling).map(|(r, f)| r - f).collect();
    let memory = spread(&gap) > size;
    let parity = parity(&all);
    Unknown {
        variable,
        variable_unit,
        share,
        shape: knots.into_iter().zip(all).collect(),
        memory,
        parity,
        suggestion: suggestion(variable, memory, parity).to_owned(),
    }
}

/// Mean residual near each knot, over all windows or those in which the variable rises or falls.
fn means(
    knots: &[f64],
    values: &[f64],
    residual: &[f64],
    usable: &[bool],
    rising: Option<bool>,
) -> Vec<f64> {
    (0..knots.len())
        .map(|k| {
            let (mut sum, mut weight) = (0.0, 1e-12);
            let steps = values
                .windows(2)
                .zip(residual.iter().skip(1))
                .zip(usable.iter().skip(1));
            for ((pair, r), _) in steps.filter(|(_, u)| **u) {
                if let [before, now] = pair
                    && rising.is_none_or(|up| up == (now > before))
                {
                    let w = hat(knots, k, *now);
                    sum += w * r;
                    weight += w;
                }
            }
            sum / weight
        })
        .collect()
}

fn spread(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len().max(1) as f64)
        .sqrt()
}

/// Odd or even about the middle of the curve.
fn parity(shape: &[f64]) -> &'static str {
    let mean = shape.iter().sum::<f64>() / shape.len().max(1) as f64;
    let (mut odd, mut even) = (0.0, 0.0);
    for (a, b) in shape.iter().zip(shape.iter().rev()) {
        odd += (a - b) * (a - b);
        even += (a + b - 2.0 * mean) * (a + b - 2.0 * mean);
    }
    match odd.total_cmp(&even) {
        _ if odd > 3.0 * even => "odd",
        _ if even > 3.0 * odd => "even",
        _ => "neither",
    }
}

fn suggestion(variable: &str, memory: bool, parity: &str) -> &'static str {
    match (variable, memory, parity) {
        ("speed", false, "odd") => {
            "a friction law that is not a straight line over speed (drag that grows faster, or fades)"
        }
        ("speed", false, _) => "a resistance that depends on the direction of motion",
        ("speed", true, _) => {
            "a friction that remembers the motion (breakaway, settling, lubricant film)"
        }
        ("position", false, _) => {
            "a force along the travel (a guide, a cable, a spring that stiffens)"
        }
        ("position", true, _) => {
            "a force along the travel with memory (backlash, cable or belt hysteresis)"
        }
        ("time", _, _) => {
            "a slow change during the recording (temperature, settling, wear); time and dissipated energy cannot be told apart here"
        }
        (_, true, _) => "a drive or sensor with memory",
        _ => {
            "a drive that is not a straight line (saturation, dead zone), or friction that grows with load"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::problem::Inertia;
    use crate::recorded::exact_bench;
    use crate::weak::Windows;

    #[test]
    fn a_curve_over_the_position_is_found_and_drawn() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, Windows::new(&run, 0.043), Inertia::None);
        let centres = &problem.windows.centres;
        let residual: Vec<f64> = centres
            .iter()
            .map(|c| 0.9 * (run.motion[*c].position / 0.5).powi(3))
            .collect();
        let unknown = unknown(&problem, &residual, Motion::Linear).unwrap();
        assert_eq!(
            (unknown.variable, unknown.parity, unknown.memory),
            ("position", "odd", false)
        );
        assert!(unknown.share > 0.9, "{}", unknown.share);
        let found = [Mechanism::Viscous, Mechanism::Spring];
        assert_eq!(
            surrogates(&problem, &residual, &found, Motion::Linear),
            [Mechanism::Spring]
        );
    }

    #[test]
    fn hats_add_up_to_one_between_the_end_knots() {
        let knots = [-1.3, -0.2, 0.7, 2.9];
        for value in [-1.1, -0.2, 0.31, 2.3] {
            let sum: f64 = (0..4).map(|k| hat(&knots, k, value)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{value}: {sum}");
        }
        assert_eq!(hat(&knots, 1, 0.7), 0.0);
    }
}
