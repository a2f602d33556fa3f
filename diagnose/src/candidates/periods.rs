//! This file finds the trial periods of causes that are periodic over the position.

use crate::cause::{Cause, Scales};
use crate::plant::Run;
use crate::rules::{
    FEWEST_CYCLES, LEAST_OF_A_PERIOD, MOST_A_TURN, MOST_CYCLES, PEAKS, PEAKS_APART, SPACING,
};
use crate::weak::Windows;
use core::f64::consts::TAU;
use rigproof_model::effects::facts::Family;
use rigproof_model::effects::{Instant, facts};
use rigproof_spec::effect::Motion;

/// Trial periods: those of the highest peaks of the residual's spectrum, and parts of a turn.
pub fn all_periods<R: Run + ?Sized>(
    run: &R,
    cause: Cause,
    windows: &Windows,
    residual: &[f64],
) -> Vec<f64> {
    let (motion, travel) = (run.motion(cause.at), run.travel(cause.at));
    let mut all = periods(cause, &points(cause, motion, windows, residual), travel);
    if run.motion_kind() == Motion::Rotary {
        all.extend(of_a_turn(longest_period(travel, cause)));
    }
    all
}

/// Trial pitches of an encoder: none, which is once a turn, and the same periods.
pub fn pitches<R: Run + ?Sized>(
    run: &R,
    cause: Cause,
    windows: &Windows,
    residual: &[f64],
) -> Vec<Vec<f64>> {
    let mut pitches = all_periods(run, cause, windows, residual);
    pitches.retain(|pitch| *pitch != TAU);
    let once_a_turn = (run.motion_kind() == Motion::Rotary).then(Vec::new);
    let pitches = pitches.into_iter().map(|pitch| vec![pitch]);
    once_a_turn.into_iter().chain(pitches).collect()
}

/// The integer fractions of a turn up to a longest one.
pub fn of_a_turn(longest: f64) -> impl Iterator<Item = f64> {
    let parts = (1..=MOST_A_TURN).map(|order| TAU / f64::from(order));
    parts.filter(move |period| *period <= longest)
}

/// The longest period of which a travel shows enough. A part of a period looks like a spring or a
/// constant, unless it scales a torque.
pub fn longest_period(travel: f64, cause: Cause) -> f64 {
    match cause.scales {
        Scales::Nothing => travel,
        Scales::Torque => travel / LEAST_OF_A_PERIOD,
    }
}

/// Whether a cause is periodic over the position.
pub fn is_periodic(cause: Cause) -> bool {
    facts(cause.mechanism).is_some_and(|facts| facts.shapes.is_a_period())
}

/// The part of a residual that a periodic cause may explain: of friction what opposes the motion.
pub fn periodic_part(cause: Cause, now: &Instant, residual: f64) -> f64 {
    match is_friction(cause) {
        true => now.sense * residual,
        false => residual,
    }
}

fn is_friction(cause: Cause) -> bool {
    facts(cause.mechanism).is_some_and(|facts| facts.family == Family::FrictionOfMotion)
}

fn points(
    cause: Cause,
    motion: &[Instant],
    windows: &Windows,
    residual: &[f64],
) -> Vec<(f64, f64)> {
    windows
        .centres
        .iter()
        .zip(residual)
        .zip(&windows.usable)
        .filter(|(_, usable)| **usable)
        .filter_map(|((&centre, &r), _)| {
            motion
                .get(centre)
                .map(|now| (now.position, periodic_part(cause, now, r)))
        })
        .collect()
}

/// The periods of the highest peaks in the spectrum of values over position. Of friction the mean is
/// left out: it is dry friction, which may be unknown.
pub fn periods(cause: Cause, points: &[(f64, f64)], travel: f64) -> Vec<f64> {
    let travel = travel.max(1e-12);
    let mean = match is_friction(cause) {
        true => points.iter().map(|(_, r)| r).sum::<f64>() / points.len().max(1) as f64,
        false => 0.0,
    };
    let points: Vec<(f64, f64)> = points.iter().map(|(q, r)| (*q, r - mean)).collect();
    let count = ((MOST_CYCLES - FEWEST_CYCLES) / SPACING) as usize;
    let mut peaks: Vec<(f64, f64)> = (0..count)
        .map(|k| FEWEST_CYCLES + SPACING * k as f64)
        .map(|cycles| (power(&points, TAU * cycles / travel), cycles))
        .collect();
    peaks.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<f64> = Vec::new();
    for (_, cycles) in peaks {
        if chosen
            .iter()
            .all(|c: &f64| (c - cycles).abs() > PEAKS_APART)
        {
            chosen.push(cycles);
        }
        if chosen.len() == PEAKS {
            break;
        }
    }
    chosen.into_iter().map(|cycles| travel / cycles).collect()
}

fn power(points: &[(f64, f64)], wave_number: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for &(position, r) in points {
        let (sin, cos) = libm::sincos(wave_number * position);
        re += r * cos;
        im += r * sin;
    }
    re * re + im * im
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::joint::recorded::exact_bench;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn the_period_of_a_ripple_is_among_those_tried() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let cause = Cause::of(Mechanism::Ripple);
        let windows = run.windows_of(0.017);
        let period = run.travel() / 23.7;
        let residual: Vec<f64> = windows
            .centres
            .iter()
            .map(|c| 0.4 * libm::sin(TAU * run.motion[*c].position / period + 0.9))
            .collect();
        let best = periods(
            cause,
            &points(cause, &run.motion, &windows, &residual),
            run.travel(),
        )[0];
        assert!((best / period - 1.0).abs() < 0.02, "{best} {period}");
    }
}
