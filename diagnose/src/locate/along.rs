//! This file divides one motion into regimes: direction and size of speed, time since a reversal,
//! position, time.

use super::{Cell, Regimes};
use crate::cause::Place;
use crate::rules::REVERSAL_S;
use crate::weak::Windows;
use rigproof_model::effects::Instant;

/// The regimes of a motion. All windows in motion count, including those with unknown direction.
/// `low` is the lowest position and `travel` the range.
pub fn along(
    output: &'static str,
    motion: &[Instant],
    windows: &Windows,
    [low, travel]: [f64; 2],
) -> Regimes {
    Regimes {
        output,
        counted: moving(motion, windows),
        cells: cells(motion, windows, [low, travel.max(1e-300)]),
    }
}

/// Windows whose centre is in motion. At rest a friction takes any value up to its level and shows
/// nothing.
fn moving(motion: &[Instant], windows: &Windows) -> Vec<bool> {
    let centres = windows.centres.iter();
    centres
        .map(|&centre| motion.get(centre).is_some_and(|now| now.sense != 0.0))
        .collect()
}

fn cells(motion: &[Instant], windows: &Windows, [low, travel]: [f64; 2]) -> Vec<Cell> {
    let since = since_reversal_s(motion, windows);
    let mut speeds: Vec<f64> = motion.iter().map(|now| now.speed.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    let quantile = |q: f64| {
        speeds
            .get((q * speeds.len() as f64) as usize)
            .copied()
            .unwrap_or(0.0)
    };
    let top = quantile(0.99);
    let last_s = windows.step_s * motion.len().saturating_sub(1) as f64;
    let last_s = last_s.max(1e-9);
    let cell = |label, rule: &dyn Fn(usize, &Instant) -> bool| Cell {
        label,
        at: Place::Whole,
        member: windows
            .centres
            .iter()
            .enumerate()
            .map(|(row, &centre)| {
                motion
                    .get(centre)
                    .is_some_and(|now| now.sense != 0.0 && rule(row, now))
            })
            .collect(),
    };
    let reversal = |row: usize| since.get(row).is_some_and(|s| *s < REVERSAL_S);
    vec![
        cell("within 0.1 s of a reversal", &|row, _| reversal(row)),
        cell("away from reversals", &|row, _| !reversal(row)),
        cell("slow (below 10 % of top speed)", &|_, now| {
            now.speed.abs() < 0.1 * top
        }),
        cell("medium speed (10 to 60 % of top)", &|_, now| {
            (0.1..0.6).contains(&(now.speed.abs() / top.max(1e-300)))
        }),
        cell("fast (above 60 % of top speed)", &|_, now| {
            now.speed.abs() >= 0.6 * top
        }),
        cell("moving in the positive sense", &|_, now| now.sense > 0.0),
        cell("moving in the negative sense", &|_, now| now.sense < 0.0),
        cell("lower third of the travel", &|_, now| {
            now.position < low + travel / 3.0
        }),
        cell("upper third of the travel", &|_, now| {
            now.position > low + travel / 1.5
        }),
        cell("first third of the recording", &|_, now| {
            now.time_s < last_s / 3.0
        }),
        cell("last third of the recording", &|_, now| {
            now.time_s > last_s / 1.5
        }),
    ]
}

/// Time from each window's centre to the nearest reversal, s.
fn since_reversal_s(motion: &[Instant], windows: &Windows) -> Vec<f64> {
    let mut sense = 0.0;
    let mut reversals: Vec<f64> = Vec::new();
    for now in motion {
        if now.sense.abs() >= 1.0 {
            if sense * now.sense < 0.0 {
                reversals.push(now.time_s);
            }
            sense = now.sense;
        }
    }
    // Reversals and windows are sorted by time, so one pass suffices.
    let mut past = f64::NEG_INFINITY;
    let mut coming = reversals.into_iter().peekable();
    let times = windows.times_s().into_iter();
    times
        .map(|t| {
            while let Some(reversal) = coming.next_if(|r| *r <= t) {
                past = reversal;
            }
            let next = coming.peek().copied().unwrap_or(f64::INFINITY);
            (t - past).abs().min((t - next).abs())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::locate::locate;
    use crate::plant::Run;
    use crate::plants::joint::recorded::exact_bench;
    use crate::problem::Problem;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn energy_near_reversals_is_located_there() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, run.windows_of(0.043));
        let since = since_reversal_s(&run.motion, &problem.windows);
        let before: Vec<f64> = since
            .iter()
            .map(|s| 0.9 * libm::exp(-s / 0.04) + 0.01)
            .collect();
        let after = vec![0.01; before.len()];
        let found = locate(&problem, &before, &after);
        let near = |regime: &str| found.iter().find(|l| l.regime == regime).unwrap();
        let first = near("within 0.1 s of a reversal");
        assert!(near("away from reversals").share < 0.1);
        assert!(
            first.share > 0.9 && first.share > 1.3 * first.share_of_time,
            "{} of {}",
            first.share,
            first.share_of_time
        );
        assert!(first.share_low95 <= first.share && first.share <= first.share_high95);
        assert!((first.share_after - first.share_of_time).abs() < 1e-9);
    }
}
