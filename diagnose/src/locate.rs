//! This file finds the regimes of motion in which the nominal model fails: where the unexplained
//! energy is.

mod along;

use crate::cause::Place;
use crate::problem::Problem;
use crate::report::Located;
use crate::rules::{LOCATE_BLOCKS, LOCATE_REPLICATES};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A regime and its rows.
pub struct Cell {
    /// A label for people.
    pub label: &'static str,
    pub at: Place,
    /// Whether each row belongs to it.
    pub member: Vec<bool>,
}

pub use along::along;

/// The regimes of a recording.
pub struct Regimes {
    /// The name of the equation whose residual is located.
    pub output: &'static str,
    /// Which rows are counted.
    pub counted: Vec<bool>,
    pub cells: Vec<Cell>,
}

/// Regimes ranked by the share of `before`'s energy in excess of their share of time.
///
/// `before` and `after` are residuals, one value per window.
pub fn locate(problem: &Problem, before: &[f64], after: &[f64]) -> Vec<Located> {
    let Regimes {
        output,
        counted,
        cells,
    } = problem.run.regimes(&problem.windows);
    let counted = counted.as_slice();
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
                joint: problem.run.place_name(cell.at),
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

/// 95 % interval of a share, by block bootstrap over windows.
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
