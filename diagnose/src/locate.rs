//! This file says where the unexplained energy is: by sense and size of speed, time since a reversal, position,
//! time.

use crate::problem::Problem;
use crate::report::Located;
use crate::rules::{LOCATE_BLOCKS, LOCATE_REPLICATES, REVERSAL_S};
use crate::run::{PlantKind, Run};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Which rows belong to a regime.
pub struct Cell {
    /// The regime, in words.
    pub label: &'static str,
    /// The joint, where there are several.
    pub joint: Option<&'static str>,
    /// One value a row.
    pub member: Vec<bool>,
}

/// Regimes ranked by how much more than their share of time they hold of `before`'s energy.
///
/// `before` and `after` are residuals, one value a window; every window in motion counts, the ambiguous ones too.
pub fn locate(problem: &Problem, run: &Run, before: &[f64], after: &[f64]) -> Vec<Located> {
    let output = match run.plant {
        PlantKind::Axis => "effort balance",
        PlantKind::Bench => "metered effort",
    };
    let counted = moving(problem, run);
    ranked(
        problem,
        output,
        &counted,
        cells(problem, run),
        before,
        after,
    )
}

/// Cells ranked by their excess of `before`'s energy over the rows that count.
pub fn ranked(
    problem: &Problem,
    output: &'static str,
    counted: &[bool],
    cells: Vec<Cell>,
    before: &[f64],
    after: &[f64],
) -> Vec<Located> {
    let times = problem.windows.times_s();
    let only = |values: &[f64]| -> Vec<f64> {
        let kept = values.iter().zip(counted);
        kept.map(|(v, m)| if *m { *v } else { 0.0 }).collect()
    };
    let (before, after) = (&only(before)[..], &only(after)[..]);
    let count = counted.iter().filter(|m| **m).count().max(1) as f64;
    let mut found: Vec<Located> = cells
        .into_iter()
        .map(|mut cell| {
            let member = cell.member.iter_mut().zip(counted);
            member.for_each(|(member, counts)| *member &= counts);
            cell
        })
        .filter(|cell| cell.member.iter().any(|m| *m))
        .map(|cell| {
            let inside = |values: &[f64]| share(values, &cell.member);
            let (low, high) = interval(before, &cell.member);
            let mut when = times
                .iter()
                .zip(&cell.member)
                .filter(|(_, m)| **m)
                .map(|(t, _)| *t);
            let from_s = when.next().unwrap_or(0.0);
            Located {
                output,
                joint: cell.joint,
                regime: cell.label.to_owned(),
                from_s,
                to_s: when.next_back().unwrap_or(from_s),
                share_of_time: cell.member.iter().filter(|m| **m).count() as f64 / count,
                share: inside(before),
                share_low95: low,
                share_high95: high,
                share_after: inside(after),
            }
        })
        .collect();
    let excess = |l: &Located| l.share / l.share_of_time.max(1e-9);
    found.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    found
}

/// Windows whose centre is in motion: at rest a resistance is anything up to its level and says nothing.
fn moving(problem: &Problem, run: &Run) -> Vec<bool> {
    let centres = problem.windows.centres.iter();
    centres
        .map(|&centre| run.motion.get(centre).is_some_and(|now| now.sense != 0.0))
        .collect()
}

fn share(values: &[f64], member: &[bool]) -> f64 {
    let total: f64 = values.iter().map(|v| v * v).sum();
    let part: f64 = values
        .iter()
        .zip(member)
        .filter(|(_, m)| **m)
        .map(|(v, _)| v * v)
        .sum();
    part / total.max(1e-300)
}

/// 95 % interval of a share, by resampling contiguous blocks of windows.
fn interval(values: &[f64], member: &[bool]) -> (f64, f64) {
    let size = values.len().div_ceil(LOCATE_BLOCKS).max(1);
    let blocks: Vec<(f64, f64)> = values
        .chunks(size)
        .zip(member.chunks(size))
        .map(|(v, m)| {
            let total: f64 = v.iter().map(|x| x * x).sum();
            (share(v, m) * total, total)
        })
        .collect();
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut shares: Vec<f64> = (0..LOCATE_REPLICATES)
        .map(|_| {
            let (mut part, mut total) = (0.0, 0.0);
            for _ in 0..blocks.len() {
                let drawn = (random.next_u64() % blocks.len() as u64) as usize;
                let (p, t) = blocks.get(drawn).copied().unwrap_or_default();
                part += p;
                total += t;
            }
            part / total.max(1e-300)
        })
        .collect();
    shares.sort_by(f64::total_cmp);
    let at = |q: f64| {
        shares
            .get((q * (LOCATE_REPLICATES - 1) as f64).round() as usize)
            .copied()
            .unwrap_or(0.0)
    };
    (at(0.025), at(0.975))
}

fn cells(problem: &Problem, run: &Run) -> Vec<Cell> {
    let since = since_reversal_s(problem, run);
    let mut speeds: Vec<f64> = run.motion.iter().map(|now| now.speed.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    let quantile = |q: f64| {
        speeds
            .get((q * speeds.len() as f64) as usize)
            .copied()
            .unwrap_or(0.0)
    };
    let top = quantile(0.99);
    let low = run.position.iter().copied().fold(f64::INFINITY, f64::min);
    let travel = run.travel().max(1e-300);
    let last_s = run.duration_s().max(1e-9);
    let cell = |label, rule: &dyn Fn(usize, &rigproof_model::effects::Instant) -> bool| Cell {
        label,
        joint: None,
        member: problem
            .windows
            .centres
            .iter()
            .enumerate()
            .map(|(row, &centre)| {
                run.motion
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

/// Time from each window's centre to the nearest change of sense, s.
fn since_reversal_s(problem: &Problem, run: &Run) -> Vec<f64> {
    let mut sense = 0.0;
    let mut reversals: Vec<f64> = Vec::new();
    for now in &run.motion {
        if now.sense.abs() >= 1.0 {
            if sense * now.sense < 0.0 {
                reversals.push(now.time_s);
            }
            sense = now.sense;
        }
    }
    // Both are in the order of time, so that one pass finds the reversals on either side of each window.
    let mut past = f64::NEG_INFINITY;
    let mut coming = reversals.into_iter().peekable();
    let times = problem.windows.times_s().into_iter();
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

    use crate::problem::Inertia;
    use crate::recorded::exact_bench;
    use crate::weak::Windows;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn energy_near_reversals_is_located_there() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, Windows::new(&run, 0.043), Inertia::None);
        let since = since_reversal_s(&problem, &run);
        let before: Vec<f64> = since
            .iter()
            .map(|s| 0.9 * libm::exp(-s / 0.04) + 0.01)
            .collect();
        let after = vec![0.01; before.len()];
        let found = locate(&problem, &run, &before, &after);
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
