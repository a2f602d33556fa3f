//! This file chooses mechanisms: forward, backward and swap steps judged on left-out blocks of time.

use crate::candidates::{is_at_edge, mechanisms, modelled_effort, realise, shape_bounds, variants};
use crate::problem::{Problem, Term, add};
use crate::regression::{Blocks, Fit, dot, fit, nested_block_losses, paired};
use crate::run::rms;
use rigproof_model::effects::entry;
use rigproof_spec::effect::Mechanism;

/// What a mechanism must show before it is named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gates {
    /// Paired z over blocks.
    pub z: f64,
    /// Share of the current left-out loss that must go away.
    pub share: f64,
    /// Root-mean-square contribution, as a share of the effort's.
    pub relevance: f64,
}

impl Default for Gates {
    fn default() -> Gates {
        Gates {
            z: 2.5,
            share: 0.02,
            relevance: 0.002,
        }
    }
}

/// One mechanism that was found, with the evidence for it.
#[derive(Clone, Debug)]
pub struct Found {
    /// The term.
    pub term: Term,
    /// Paired z over blocks when it entered.
    pub z: f64,
    /// Share of the left-out loss it removed when it entered.
    pub share: f64,
    /// Whether nothing beyond sensor noise was left with it.
    pub at_floor: bool,
}

/// What stood after one mechanism was named.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The mechanism that entered.
    pub entered: Mechanism,
    /// All mechanisms that stood then.
    pub standing: Vec<Mechanism>,
    /// Root-mean-square residual of the windows, N or N·m.
    pub residual: f64,
}

/// The outcome of the selection.
#[derive(Clone, Debug)]
pub struct Selection {
    /// Terms of the nominal model.
    pub nominal: Vec<Term>,
    /// Mechanisms found, in the order they were named.
    pub found: Vec<Found>,
    /// Mechanisms that pass the gates but explain less than what stays unexplained: not named.
    pub too_small: Vec<Mechanism>,
    /// How the mechanisms were named, one after another.
    pub stages: Vec<Stage>,
    /// The fit of the nominal model alone.
    pub before: Fit,
    /// The fit of everything.
    pub after: Fit,
}

/// The most mechanisms that are named on one recording.
const MOST_FOUND: usize = 8;
/// The most mechanisms that are taken in, those that go again included.
const MOST_STAGES: usize = 14;
/// Rounds in which a change of the drive is linearised again about the fit it gave.
const RELINEARISE: usize = 3;
/// Memoryless mechanisms of one parameter: they are named first, and the others must still be needed beside or
/// instead of them.
const ELEMENTARY: [Mechanism; 3] = [
    Mechanism::DryOffset,
    Mechanism::ConstantBias,
    Mechanism::Viscous,
];
/// Share of the best gain that an elementary mechanism must reach to be named first.
const ELEMENTARY_SHARE: f64 = 0.5;
/// Share of the best gain that a mechanism from the start must reach to be preferred to one that begins later.
const EARLY_SHARE: f64 = 0.8;
/// A simpler mechanism is taken when it explains at least this share of what the best one does.
const SIMPLER_SHARE: f64 = 0.9;
/// z below which two explanations are not told apart.
pub const TIE_Z: f64 = 2.0;

/// Runs the whole search; the noise model is refined twice on the way.
pub fn select(problem: &mut Problem, mut nominal: Vec<Term>, gates: Gates) -> Selection {
    let blocks = Blocks::new(problem);
    let rich = rich_residual(problem, &nominal, &blocks);
    rewhiten(problem, &rich, &mut nominal, &mut []);
    let mut stages = Vec::new();
    let mut found = search(problem, &nominal, Vec::new(), &blocks, gates, &mut stages);
    let residual = fit(problem, &refs(&nominal, &found), &blocks).residual;
    rewhiten(problem, &residual, &mut nominal, &mut found);
    found = search(problem, &nominal, found, &blocks, gates, &mut stages);
    let too_small = prune(problem, &nominal, &mut found, &blocks);
    let before = fit(problem, &nominal.iter().collect::<Vec<_>>(), &blocks);
    let after = fit(problem, &refs(&nominal, &found), &blocks);
    Selection {
        nominal,
        found,
        too_small,
        stages,
        before,
        after,
    }
}

/// Multiple of the unexplained energy (beyond the floor) that a mechanism must explain by itself to be named.
const OWN_TO_UNEXPLAINED: f64 = 1.0;
/// Residual over floor up to which nothing counts as unexplained.
pub const FLOOR_RATIO: f64 = 1.3;

/// Takes out, weakest first, every mechanism that explains less than what stays unexplained: beside an
/// unknown of that size it may only be soaking it up.
///
/// Both are left-out white losses; the part of the loss that sensor noise accounts for is not unexplained.
fn prune(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
) -> Vec<Mechanism> {
    let mut taken_out = Vec::new();
    loop {
        let current = fit(problem, &refs(nominal, found), blocks);
        let ratio = usable_rms(problem, &current.residual) / (FLOOR_RATIO * problem.floor);
        let unexplained = current.left_out() * (1.0 - 1.0 / (ratio * ratio)).max(0.0);
        let weakest = (0..found.len())
            .map(|index| {
                let mut fewer = found.clone();
                fewer.remove(index);
                let without = fit(problem, &refs(nominal, &fewer), blocks);
                (without.left_out() - current.left_out(), index)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match weakest {
            Some((own, index)) if own < OWN_TO_UNEXPLAINED * unexplained => {
                taken_out.push(found.remove(index).term.mechanism);
            }
            _ => return taken_out,
        }
    }
}

fn rewhiten(problem: &mut Problem, residual: &[f64], nominal: &mut [Term], found: &mut [Found]) {
    problem.rewhiten(usable_rms(problem, residual));
    for term in nominal
        .iter_mut()
        .chain(found.iter_mut().map(|f| &mut f.term))
    {
        problem.refresh(term);
    }
}

/// The residual when every mechanism may help at once: a first idea of the noise.
fn rich_residual(problem: &Problem, nominal: &[Term], blocks: &Blocks) -> Vec<f64> {
    let mut terms: Vec<Term> = nominal.to_vec();
    let common: Vec<&Term> = nominal.iter().collect();
    let plain = fit(problem, &common, blocks);
    for mechanism in mechanisms(problem) {
        let tried = variants(problem, mechanism, &common, &plain);
        let step = (tried.len() / 3).max(1);
        terms.extend(
            tried
                .into_iter()
                .skip(step / 2)
                .step_by(step)
                .filter(|t| t.fixed.is_none()),
        );
    }
    fit(problem, &terms.iter().collect::<Vec<_>>(), blocks).residual
}

impl Selection {
    /// Takes mechanisms out again and fits what stays.
    pub fn withdraw(&mut self, problem: &Problem, mechanisms: &[Mechanism]) {
        self.found
            .retain(|f| !mechanisms.contains(&f.term.mechanism));
        let blocks = Blocks::new(problem);
        self.after = fit(problem, &refs(&self.nominal, &self.found), &blocks);
    }
}

/// The nominal terms and the found ones, in the order of the fit's columns.
pub fn refs<'b>(nominal: &'b [Term], found: &'b [Found]) -> Vec<&'b Term> {
    nominal
        .iter()
        .chain(found.iter().map(|f| &f.term))
        .collect()
}

fn search(
    problem: &Problem,
    nominal: &[Term],
    mut found: Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
    stages: &mut Vec<Stage>,
) -> Vec<Found> {
    settle(problem, nominal, &mut found, blocks, gates);
    while found.len() < MOST_FOUND && stages.len() < MOST_STAGES {
        let Some(next) = forward(problem, nominal, &found, blocks, gates) else {
            break;
        };
        let entered = next.term.mechanism;
        found.push(next);
        refine(problem, nominal, &mut found, blocks);
        let residual = fit(problem, &refs(nominal, &found), blocks).residual;
        stages.push(Stage {
            entered,
            standing: found.iter().map(|f| f.term.mechanism).collect(),
            residual: usable_rms(problem, &residual),
        });
        let standing: Vec<Mechanism> = found.iter().map(|f| f.term.mechanism).collect();
        settle(problem, nominal, &mut found, blocks, gates);
        note_swaps(problem, nominal, &found, &standing, blocks, stages);
        if found.iter().all(|f| f.term.mechanism != entered)
            && stages.last().is_some_and(|s| s.entered == entered)
        {
            break;
        }
    }
    found
}

/// A mechanism that came in by replacing others is a stage of its own.
fn note_swaps(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    standing: &[Mechanism],
    blocks: &Blocks,
    stages: &mut Vec<Stage>,
) {
    for new in found
        .iter()
        .map(|f| f.term.mechanism)
        .filter(|m| !standing.contains(m))
    {
        let residual = fit(problem, &refs(nominal, found), blocks).residual;
        stages.push(Stage {
            entered: new,
            standing: found.iter().map(|f| f.term.mechanism).collect(),
            residual: usable_rms(problem, &residual),
        });
    }
}

/// Root mean square over the usable windows.
pub fn usable_rms(problem: &Problem, values: &[f64]) -> f64 {
    let usable: Vec<f64> = values
        .iter()
        .zip(&problem.windows.usable)
        .filter(|(_, u)| **u)
        .map(|(v, _)| *v)
        .collect();
    rms(&usable)
}

/// Swap and backward passes.
fn settle(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
) {
    swap(problem, nominal, found, blocks, gates);
    backward(problem, nominal, found, blocks, gates);
}

/// Mechanisms that are neither nominal nor found.
fn open(problem: &Problem, nominal: &[Term], found: &[Found]) -> Vec<Mechanism> {
    let taken: Vec<Mechanism> = refs(nominal, found).iter().map(|t| t.mechanism).collect();
    mechanisms(problem)
        .into_iter()
        .filter(|m| !taken.contains(m))
        .collect()
}

struct Trial {
    found: Found,
    losses: Vec<f64>,
    parameters: usize,
}

/// The next mechanism: an elementary one, any other, or one that begins during the recording, in this order as
/// long as it explains enough of what the best of them does.
fn forward(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    blocks: &Blocks,
    gates: Gates,
) -> Option<Found> {
    let common = refs(nominal, found);
    let current = fit(problem, &common, blocks);
    let lists: Vec<Vec<Term>> = open(problem, nominal, found)
        .into_iter()
        .map(|m| variants(problem, m, &common, &current))
        .collect();
    let (early, bests) = trials(problem, &common, &current, lists, blocks, gates);
    let effort = modelled_effort(problem, &common, &current);
    let onsets = bests
        .iter()
        .map(|t| with_onsets(problem, t, &effort))
        .collect();
    let (late, _) = trials(problem, &common, &current, onsets, blocks, gates);
    let (elementary, others): (Vec<Trial>, Vec<Trial>) = early
        .into_iter()
        .partition(|t| ELEMENTARY.contains(&t.found.term.mechanism));
    let without = current.left_out();
    let ranked = [
        (simplest(elementary, without), ELEMENTARY_SHARE),
        (simplest(others, without), EARLY_SHARE),
        (simplest(late, without), 1.0),
    ];
    let shares = ranked.iter().flat_map(|(found, _)| found).map(|f| f.share);
    let most = shares.fold(0.0, f64::max);
    // One that leaves nothing but noise is not passed over for one that leaves more.
    let floor_reached = ranked
        .iter()
        .flat_map(|(found, _)| found)
        .any(|f| f.at_floor);
    let mut enough = ranked
        .into_iter()
        .filter_map(|(found, least)| found.filter(|f| f.share >= least * most))
        .filter(|f| f.at_floor || !floor_reached);
    enough.next()
}

/// A term that begins at twelfths of the recording, ends left out.
fn with_onsets(problem: &Problem, term: &Term, effort: &[f64]) -> Vec<Term> {
    (2..=10)
        .map(|k| problem.run.start_s + problem.run.duration_s() * k as f64 / 12.0)
        .filter_map(|t| realise(problem, term.mechanism, &term.shape, Some(t), effort))
        .collect()
}

/// Share of the best gain that a mechanism must reach on its grid to have its shape refined and be judged.
const PROMISING: f64 = 0.3;

/// Judges one mechanism a list of variants: those that pass the gates, and the best variant of every list.
fn trials(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    lists: Vec<Vec<Term>>,
    blocks: &Blocks,
    gates: Gates,
) -> (Vec<Trial>, Vec<Term>) {
    let candidates: Vec<(Vec<Term>, Term, f64)> = lists
        .into_iter()
        .map(|list| linearised(problem, common, list, blocks))
        .filter_map(|list| {
            let (term, loss) = best(problem, common, &list, blocks)?;
            Some((list, term, loss))
        })
        .collect();
    let least = candidates.iter().map(|c| c.2).fold(current.loss, f64::min);
    let bests = candidates.iter().map(|c| c.1.clone()).collect();
    let trials = candidates
        .into_iter()
        .filter(|(_, _, loss)| current.loss - loss >= PROMISING * (current.loss - least))
        .filter_map(|(mut list, mut term, _)| {
            if list.len() > 1 {
                term = refined(problem, common, term, blocks);
                list.push(term.clone());
            }
            judge(problem, common, current, &list, term, blocks, gates)
        })
        .collect();
    (trials, bests)
}

/// Changes of the drive, linearised about what the other terms give beside them.
fn linearised(problem: &Problem, common: &[&Term], list: Vec<Term>, blocks: &Blocks) -> Vec<Term> {
    list.into_iter()
        .map(|t| {
            let effort = effort_beside(problem, common, &t, blocks);
            effort
                .and_then(|e| problem.drive_term(t.mechanism, &t.shape, t.onset_s, &e))
                .unwrap_or(t)
        })
        .collect()
}

/// A mechanism with its variants against the gates.
fn judge(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    tried: &[Term],
    term: Term,
    blocks: &Blocks,
    gates: Gates,
) -> Option<Trial> {
    let losses = nested_block_losses(problem, common, tried, blocks);
    let mut terms = common.to_vec();
    terms.push(&term);
    let fitted = fit(problem, &terms, blocks);
    let own = own_coefficients(&term, &fitted);
    let expected = excitation(&term, own, blocks);
    let (gain, z) = paired(&current.block_loss, &losses, &expected);
    let share = 1.0 - losses.iter().sum::<f64>() / current.left_out().max(1e-300);
    let least = gates.relevance * rms(&problem.windows.average(&problem.run.effort));
    let passes = gain > 0.0
        && z >= gates.z
        && share >= gates.share
        && contribution(problem, &term, own) >= least
        && !drives(&term, own)
        && !is_at_edge(problem, &term);
    let linear = entry(term.mechanism)?.linear;
    passes.then(|| Trial {
        parameters: linear + term.shape.len() + usize::from(term.onset_s.is_some()),
        found: Found {
            at_floor: usable_rms(problem, &fitted.residual) <= FLOOR_RATIO * problem.floor,
            term,
            z,
            share,
        },
        losses,
    })
}

/// The coefficients of the last term of a fit.
pub fn own_coefficients<'f>(term: &Term, fitted: &'f Fit) -> &'f [f64] {
    let count = if term.known.is_some() {
        0
    } else {
        term.free.len()
    };
    let first = fitted.coefficients.len().saturating_sub(count);
    fitted.coefficients.get(first..).unwrap_or_default()
}

/// Root-mean-square effort that a term contributes over the usable windows, N or N·m.
pub fn contribution(problem: &Problem, term: &Term, coefficients: &[f64]) -> f64 {
    let mut sum = vec![0.0; problem.target.raw.len()];
    let columns = coefficients.iter().copied().zip(&term.free);
    for (c, rows) in columns.chain(term.fixed.iter().map(|rows| (1.0, rows))) {
        for (s, x) in sum.iter_mut().zip(&rows.raw) {
            *s += c * x;
        }
    }
    usable_rms(problem, &sum)
}

/// White energy that a term contributes in each block: the gain that can be expected there.
fn excitation(term: &Term, coefficients: &[f64], blocks: &Blocks) -> Vec<f64> {
    let length = term
        .free
        .first()
        .or(term.fixed.as_ref())
        .map_or(0, |rows| rows.white.len());
    let mut sum = vec![0.0; length];
    let columns = coefficients.iter().copied().zip(&term.free);
    for (c, rows) in columns.chain(term.fixed.iter().map(|rows| (1.0, rows))) {
        add(&mut sum, &rows.white, c);
    }
    let blocks = blocks.ranges.iter();
    blocks
        .map(|&(first, end)| sum.get(first..end).map_or(0.0, |part| dot(part, part)))
        .collect()
}

/// The coefficients of one found mechanism in the fit of all of them.
fn coefficients_of<'f>(found: &[Found], index: usize, fitted: &'f Fit) -> &'f [f64] {
    let later: usize = found.iter().skip(index).map(|f| f.term.free.len()).sum();
    let count = found.get(index).map_or(0, |f| f.term.free.len());
    let first = fitted.coefficients.len().saturating_sub(later);
    fitted
        .coefficients
        .get(first..first + count)
        .unwrap_or_default()
}

/// The variant with the least loss over all blocks, and that loss.
fn best(
    problem: &Problem,
    common: &[&Term],
    tried: &[Term],
    blocks: &Blocks,
) -> Option<(Term, f64)> {
    tried
        .iter()
        .map(|term| (term, loss_with(problem, common, term, blocks)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(term, loss)| (term.clone(), loss))
}

/// Loss over all blocks with one more term.
fn loss_with(problem: &Problem, common: &[&Term], term: &Term, blocks: &Blocks) -> f64 {
    let mut terms = common.to_vec();
    terms.push(term);
    fit(problem, &terms, blocks).loss
}

/// The trial with the fewest parameters among those that tie with the best one, or that explain nearly as much
/// where even the best one leaves more than noise.
fn simplest(mut trials: Vec<Trial>, loss_without: f64) -> Option<Found> {
    let total = |trial: &Trial| trial.losses.iter().sum::<f64>();
    trials.sort_by(|a, b| total(a).total_cmp(&total(b)));
    let leader = trials.first()?.losses.clone();
    let at_floor = trials.first()?.found.at_floor;
    let most = loss_without - leader.iter().sum::<f64>();
    let all = vec![1.0; leader.len()];
    trials
        .into_iter()
        .enumerate()
        .filter(|(rank, t)| {
            let nearly = !at_floor && loss_without - total(t) >= SIMPLER_SHARE * most;
            *rank == 0 || nearly || paired(&t.losses, &leader, &all).1 < TIE_Z
        })
        .min_by_key(|(rank, t)| (t.parameters, *rank))
        .map(|(_, t)| t.found)
}

/// Improves the shape (and onset) of each found term by halving steps on the loss over all blocks.
fn refine(problem: &Problem, nominal: &[Term], found: &mut [Found], blocks: &Blocks) {
    for index in 0..found.len() {
        let Some(current) = found.get(index).map(|f| f.term.clone()) else {
            continue;
        };
        if current.shape.is_empty() && current.onset_s.is_none() {
            continue;
        }
        let others: Vec<Term> = found
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != index)
            .map(|(_, f)| f.term.clone())
            .collect();
        let mut common: Vec<&Term> = nominal.iter().collect();
        common.extend(others.iter());
        let better = refined(problem, &common, current, blocks);
        if let Some(slot) = found.get_mut(index) {
            slot.term = better;
        }
    }
}

/// Pattern search over the logarithms of the shape parameters and the onset.
fn refined(problem: &Problem, common: &[&Term], start: Term, blocks: &Blocks) -> Term {
    let score = |term: &Term| loss_with(problem, common, term, blocks);
    let fitted = fit(problem, common, blocks);
    let effort = effort_beside(problem, common, &start, blocks)
        .unwrap_or_else(|| modelled_effort(problem, common, &fitted));
    let bounds = shape_bounds(problem, start.mechanism);
    let mut best = (score(&start), start);
    let mut stride = if best.1.mechanism == Mechanism::Ripple {
        0.004
    } else {
        0.3
    };
    let mut halvings = 0;
    for _ in 0..MOST_ROUNDS {
        let before = best.0;
        for direction in directions(best.1.shape.len(), best.1.onset_s.is_some()) {
            let Some(moved) = moved(problem, &best.1, &direction, stride, &bounds, &effort) else {
                continue;
            };
            let loss = score(&moved);
            if loss < best.0 {
                best = (loss, moved);
            }
        }
        if best.0 > (1.0 - 1e-4) * before {
            stride *= 0.5;
            halvings += 1;
        }
        let limit = if best.1.onset_s.is_some() {
            ONSET_HALVINGS
        } else {
            HALVINGS
        };
        if halvings == limit {
            break;
        }
    }
    best.1
}

/// Bounds on the rounds of a pattern search, and the halvings of its stride that end it.
const MOST_ROUNDS: usize = 30;
const HALVINGS: usize = 6;
/// Halvings that place an onset to about a sample.
const ONSET_HALVINGS: usize = 11;

/// Every direction of the pattern: each parameter alone both ways, and pairs of shape parameters together.
fn directions(shape: usize, onset: bool) -> Vec<Vec<f64>> {
    let size = shape + usize::from(onset);
    let unit = |index: usize, sign: f64| {
        (0..size)
            .map(|k| if k == index { sign } else { 0.0 })
            .collect()
    };
    let mut all: Vec<Vec<f64>> = (0..size)
        .flat_map(|k| [unit(k, 1.0), unit(k, -1.0)])
        .collect();
    if shape == 2 {
        for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mut pair: Vec<f64> = vec![a, b];
            pair.resize(size, 0.0);
            all.push(pair);
        }
    }
    all
}

/// What the other terms give when a change of the drive stands beside them: the point to linearise about.
fn effort_beside(
    problem: &Problem,
    common: &[&Term],
    drive: &Term,
    blocks: &Blocks,
) -> Option<Vec<f64>> {
    drive.fixed.as_ref()?;
    let mut term = drive.clone();
    let mut effort = Vec::new();
    for _ in 0..RELINEARISE {
        let mut terms = common.to_vec();
        terms.push(&term);
        let fitted = fit(problem, &terms, blocks);
        effort = modelled_effort(problem, common, &fitted);
        term = problem.drive_term(term.mechanism, &term.shape, term.onset_s, &effort)?;
    }
    Some(effort)
}

/// Share of the recording at each end in which no onset is placed: one that begins there is no onset.
const ONSET_MARGIN: f64 = 0.08;

/// The term with its shape scaled by `1 + stride` along a direction, and its onset moved by the last component.
/// `None` outside the bounds.
fn moved(
    problem: &Problem,
    term: &Term,
    direction: &[f64],
    stride: f64,
    bounds: &[(f64, f64)],
    effort: &[f64],
) -> Option<Term> {
    let mut shape = term.shape.clone();
    for ((value, along), (low, high)) in shape.iter_mut().zip(direction).zip(bounds) {
        *value *= 1.0 + stride * along;
        if *value < *low || *value > *high {
            return None;
        }
    }
    let length_s = problem.run.duration_s();
    let mut onset_s = term.onset_s;
    if let (Some(onset), Some(along)) = (&mut onset_s, direction.get(term.shape.len())) {
        *onset += 0.15 * stride * along * length_s;
        let share = (*onset - problem.run.start_s) / length_s;
        if !(ONSET_MARGIN..1.0 - ONSET_MARGIN).contains(&share) {
            return None;
        }
    }
    realise(problem, term.mechanism, &shape, onset_s, effort)
}

/// Drops every found mechanism that the others, with their shapes adjusted, make unnecessary.
fn backward(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
) {
    let mut index = 0;
    while index < found.len() {
        let current = fit(problem, &refs(nominal, found), blocks);
        let own = coefficients_of(found, index, &current).to_vec();
        let mut fewer = found.clone();
        let removed = fewer.remove(index);
        refine(problem, nominal, &mut fewer, blocks);
        let without = fit(problem, &refs(nominal, &fewer), blocks);
        let (_, z) = paired(
            &without.block_loss,
            &current.block_loss,
            &excitation(&removed.term, &own, blocks),
        );
        let share = 1.0 - current.left_out() / without.left_out().max(1e-300);
        if z < TIE_Z || share < gates.share || drives(&removed.term, &own) {
            *found = fewer;
        } else {
            if let Some(kept) = found.get_mut(index) {
                (kept.z, kept.share) = (z, share);
            }
            index += 1;
        }
    }
}

/// Whether a dissipative mechanism came out with a sign that gives energy.
fn drives(term: &Term, own: &[f64]) -> bool {
    let passive = entry(term.mechanism).is_some_and(|e| e.passive);
    passive && own.first().is_some_and(|c| *c < 0.0)
}

/// Replaces a found mechanism where another one explains clearly more in its place.
fn swap(problem: &Problem, nominal: &[Term], found: &mut [Found], blocks: &Blocks, gates: Gates) {
    for index in 0..found.len() {
        let others: Vec<Found> = found
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != index)
            .map(|(_, f)| f.clone())
            .collect();
        let common = refs(nominal, &others);
        let without = fit(problem, &common, blocks);
        let current = fit(problem, &refs(nominal, found), blocks);
        let lists = open(problem, nominal, found)
            .into_iter()
            .map(|m| variants(problem, m, &common, &without))
            .collect();
        let (passed, _) = trials(problem, &common, &without, lists, blocks, gates);
        let better: Vec<Trial> = passed
            .into_iter()
            .filter(|t| {
                let all = vec![1.0; t.losses.len()];
                let gained = without.left_out() - t.losses.iter().sum::<f64>();
                let had = without.left_out() - current.left_out();
                (t.found.at_floor || had < SIMPLER_SHARE * gained)
                    && paired(&current.block_loss, &t.losses, &all).1 >= TIE_Z
            })
            .collect();
        if let (Some(better), Some(slot)) =
            (simplest(better, without.left_out()), found.get_mut(index))
        {
            *slot = better;
        }
    }
}
