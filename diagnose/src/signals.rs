//! This file transforms signals before they become columns: delays, shifts, weights, differences.

use rigproof_model::effects::{CurrentPlay, PLAYS, first_order_lag_straight};

/// A brake's signed torque with a first-order lag on its magnitude and an unchanged sign.
pub fn lagged_yield(predicted: &[f64], step_s: f64, time_constant_s: f64) -> Vec<f64> {
    let magnitude: Vec<f64> = predicted.iter().map(|p| p.abs()).collect();
    let lagged = first_order_lag_straight(&magnitude, step_s, time_constant_s);
    let signed = lagged.iter().zip(predicted);
    signed
        .map(|(l, p)| if *p == 0.0 { 0.0 } else { l * p.signum() })
        .collect()
}

/// A current of which a share passes through backlash, sample by sample, A.
pub fn through_play(current_a: &[f64], play: CurrentPlay, share: f64) -> Vec<f64> {
    let mut played = [0.0; PLAYS];
    let held = current_a.iter().map(|i| {
        played = play.moved(played, *i);
        i + share * (play.held_a(&played) - i)
    });
    held.collect()
}

/// Numerov's weights 1/12, 10/12, 1/12; the end samples are unchanged.
pub fn numerov(signal: &[f64]) -> Vec<f64> {
    let mut out = signal.to_vec();
    for (value, window) in out.iter_mut().skip(1).zip(signal.windows(3)) {
        if let [a, b, c] = window {
            *value = (a + 10.0 * b + c) / 12.0;
        }
    }
    out
}

/// The discrete second derivative, 0 at both ends.
pub fn second_difference(position: &[f64], step_s: f64) -> Vec<f64> {
    let mut out = vec![0.0; position.len()];
    for (value, window) in out.iter_mut().skip(1).zip(position.windows(3)) {
        if let [a, b, c] = window {
            *value = (a - 2.0 * b + c) / (step_s * step_s);
        }
    }
    out
}

/// The travel between samples without the apparent motion of a joint at rest: what a recorded
/// position pushes that may lie up to `half` away from it.
pub fn known_travel(positions: impl Iterator<Item = f64>, half: f64) -> Vec<f64> {
    let mut known: Option<f64> = None;
    let travels = positions.map(|position| {
        let before = known.unwrap_or(position);
        let after = before.clamp(position - half, position + half);
        known = Some(after);
        after - before
    });
    travels.collect()
}

/// `signal(t + delay)`, with `delay` in samples: linear between samples, held at the ends.
pub fn shifted(signal: &[f64], delay: f64) -> Vec<f64> {
    let last = signal.len().saturating_sub(1) as f64;
    (0..signal.len())
        .map(|k| {
            let at = (k as f64 + delay).clamp(0.0, last);
            let low = at.floor();
            let a = signal.get(low as usize).copied().unwrap_or(0.0);
            let b = signal.get(low as usize + 1).copied().unwrap_or(a);
            a + (at - low) * (b - a)
        })
        .collect()
}

/// The parameters of a law with one of its linear parameters 1 and the others 0, for each in turn.
pub fn unit_parameters(linear: usize, shape: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    (0..linear).map(move |index| {
        let unit = (0..linear).map(|k| if k == index { 1.0 } else { 0.0 });
        unit.chain(shape.iter().copied()).collect()
    })
}
