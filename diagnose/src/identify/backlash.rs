//! This file measures the backlash of a brake: the travel after a reversal before the torque
//! returns (§3.3.3).

use crate::rules::{BEGINNING, BEYOND_BREAK, FREE_SHARE, LEAST_DWELL, LEAST_TRAVEL_DEG, UNSEEN_S};
use rigproof_model::brake::identify::{TRANSIENT, average, fit_step};
use rigproof_spec::tables::GAIN_BREAK_A;
use rigproof_spec::units::rad_from_deg;
use rigproof_trace::rig::Value;

use super::Identified;
use super::interval::with_interval;
use super::plateau::Plateau;
use super::sampled::{Part, Sampled, deviation, mean, median};

/// One reversal at constant current.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversal {
    /// The index of the recording.
    pub recording: usize,
    /// The time of the reversal, s.
    pub time_s: f64,
    /// Current, A.
    pub current_a: f64,
    /// Travel from the reversal to where the torque begins to return, rad; 0 if it never vanished.
    pub width_rad: f64,
    /// Travel within which a backlash could hide, if none was seen, rad.
    pub resolution_rad: f64,
}

/// Finds the reversals of a recording.
pub fn find(sampled: &Sampled, plateaus: &[Plateau], recording: usize, found: &mut Identified) {
    let least_a = BEYOND_BREAK * GAIN_BREAK_A;
    for plateau in plateaus.iter().filter(|p| p.current_a > least_a) {
        let turns = turns(sampled.part(plateau.samples.clone()).position_rad);
        let first = plateau.samples.start;
        for pair in turns.windows(3) {
            let &[before, turn, after] = pair else {
                continue;
            };
            let part = sampled.part(first + turn..first + after);
            let earlier = sampled.part(first + before..first + turn);
            match reversal(&earlier, &part) {
                Some((width_rad, resolution_rad)) => found.reversals.push(Reversal {
                    recording,
                    time_s: part.time_s.first().copied().unwrap_or(0.0),
                    current_a: plateau.current_a,
                    width_rad,
                    resolution_rad,
                }),
                // The recording ends before the torque returns.
                None if first + after + 1 >= plateau.samples.end => {}
                None => found.left_out.push(format!(
                    "{}: the torque after the reversal at {:.3} s does not return within the travel; turn further between reversals",
                    sampled.name,
                    part.time_s.first().copied().unwrap_or(0.0)
                )),
            }
        }
    }
}

/// The samples at which the motion reverses, with both ends of the stretch.
fn turns(position: &[f64]) -> Vec<usize> {
    let least = rad_from_deg(LEAST_TRAVEL_DEG);
    let (mut low, mut high) = (0, 0);
    let (mut turns, mut sense) = (vec![0], 0.0);
    let at = |k: usize| position.get(k).copied().unwrap_or(f64::NAN);
    for (k, x) in position.iter().enumerate() {
        if *x < at(low) {
            low = k;
        }
        if *x > at(high) {
            high = k;
        }
        if sense <= 0.0 && x - at(low) > least {
            if sense < 0.0 {
                turns.push(low);
            }
            (sense, high) = (1.0, k);
        } else if sense >= 0.0 && at(high) - x > least {
            if sense > 0.0 {
                turns.push(high);
            }
            (sense, low) = (-1.0, k);
        }
    }
    turns.push(position.len().saturating_sub(1));
    turns
}

/// Travel from a reversal to where the torque begins to return, and the travel that could hide a
/// backlash if the torque never vanished.
fn reversal(before: &Part<'_>, after: &Part<'_>) -> Option<(f64, f64)> {
    let (&first, &last) = (after.position_rad.first()?, after.position_rad.last()?);
    let sense = (last - first).signum();
    let torque: Vec<f64> = after
        .torque_nm
        .iter()
        .map(|torque| torque * sense)
        .collect();
    // Both halves away from the reversal show the engaged torque.
    let engaged: Vec<f64> = torque.iter().skip(torque.len() / 2).copied().collect();
    let (full_nm, noise_nm) = (median(&engaged), deviation(&engaged));
    let free = |torque: f64| torque.abs() < FREE_SHARE * full_nm;
    let dwell: Vec<usize> = (0..torque.len() / 2)
        .filter(|k| torque.get(*k).is_some_and(|t| free(*t)))
        .collect();
    if full_nm <= 0.0 || mean(before.torque_nm) * sense > 0.0 {
        return None;
    }
    if dwell.len() < LEAST_DWELL {
        let fallen_s = after.time_s.first()? + UNSEEN_S;
        return Some((0.0, (position_at(after, fallen_s)? - first).abs()));
    }
    let low: Vec<f64> = dwell
        .iter()
        .filter_map(|k| torque.get(*k).copied())
        .collect();
    let start = *dwell.get(dwell.len() / 2)?;
    let (time_s, torque_nm) = (after.time_s.get(start..)?, torque.get(start..)?);
    let ends_nm = [median(&low), full_nm];
    let within = |region| fit_step(time_s, torque_nm, ends_nm, noise_nm, region);
    let fit = within(BEGINNING).or_else(|| within(TRANSIENT))?;
    Some(((position_at(after, fit.start_s)? - first).abs(), 0.0))
}

/// The position at a time between two samples.
fn position_at(part: &Part<'_>, time_s: f64) -> Option<f64> {
    let index = part
        .time_s
        .iter()
        .position(|t| *t > time_s)?
        .checked_sub(1)?;
    let (t_0, t_1) = (part.time_s.get(index)?, part.time_s.get(index + 1)?);
    let (x_0, x_1) = (
        part.position_rad.get(index)?,
        part.position_rad.get(index + 1)?,
    );
    Some(x_0 + (x_1 - x_0) * (time_s - t_0) / (t_1 - t_0))
}

/// The backlash width: the mean over the reversals (§3.3.3); `None` of none.
///
/// If most reversals show none, it is 0 and the interval ends at the travel in which one could
/// hide.
pub fn width(reversals: &[Reversal]) -> Option<Value> {
    let widths: Vec<f64> = reversals.iter().map(|r| r.width_rad).collect();
    let seen: Vec<f64> = widths.iter().copied().filter(|w| *w > 0.0).collect();
    if 2 * seen.len() < widths.len() {
        let resolution = reversals
            .iter()
            .map(|r| r.resolution_rad)
            .fold(0.0, f64::max);
        return Some(Value {
            low95: Some(0.0),
            high95: Some(resolution),
            ..Value::known(0.0)
        });
    }
    average(&seen).map(|mean| with_interval(&mean))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_turns_where_it_comes_back_by_more_than_three_degrees() {
        // Up to 17°, back by 2°, up to 23°, down to −4°, up again.
        let corners = [0.0, 17.0, 15.0, 23.0, -4.0, 9.0];
        let mut position = Vec::new();
        for pair in corners.windows(2) {
            position.extend(
                (0..100)
                    .map(|k| rad_from_deg(pair[0] + (pair[1] - pair[0]) * f64::from(k) / 100.0)),
            );
        }
        assert_eq!(turns(&position), [0, 300, 400, 499]);
        let constant = vec![0.3; 50];
        assert_eq!(turns(&constant), [0, 49]);
    }

    #[test]
    fn most_reversals_without_backlash_make_a_brake_without() {
        let reversal = |width_rad: f64| Reversal {
            recording: 0,
            time_s: 1.7,
            current_a: 0.9,
            width_rad,
            resolution_rad: if width_rad == 0.0 { 0.0011 } else { 0.0 },
        };
        let none = width(&[reversal(0.0), reversal(0.0), reversal(0.027)]).unwrap();
        assert_eq!(
            (none.value, none.low95, none.high95),
            (0.0, Some(0.0), Some(0.0011))
        );
        let some = width(&[reversal(0.026), reversal(0.0), reversal(0.028)]).unwrap();
        assert!((some.value - 0.027).abs() < 1e-15);
        // Two values: 12.706 of Student's t with one degree of freedom, times 0.001.
        assert!(
            (some.high95.unwrap() - 0.027 - 0.012_706).abs() < 1e-6,
            "{some:?}"
        );
        assert_eq!(width(&[]), None);
    }
}
