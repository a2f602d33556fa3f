//! This file lists the causes that are candidates on a recording, and the trial shapes of each
//! mechanism.

mod periods;

pub use periods::{is_periodic, longest_period, of_a_turn, periodic_part, periods};

use crate::cause::{Cause, Place};
use crate::filter::ends;
use crate::plant::Run;
use crate::problem::{Bounds, Problem, Term, add};
use crate::regression::Fit;
use crate::rules::{
    BENDS_JOINT, BRISTLE_EXPONENTS, DELAYS, EDGE, EFFORT_LIMIT_SHARES, EFFORT_LIMITS, FASTEST_PEAK,
    FASTEST_RESONANCE, GAPS, GAPS_OF_A_SPRING, LAGS_JOINT, LEAST_BEND, LEAST_BEND_SIGMAS,
    LEAST_GAP, LEAST_GAP_SIGMAS, LEAST_LAG_STEPS, LEAST_LIMITED, LEAST_SHIFT_STEPS_JOINT,
    LIMIT_SHARES, LIMITS, LOAD_EXPONENTS, MEMORY_COUNT, MEMORY_RATES, MEMORY_RATIOS, MOST_BEND,
    MOST_CYCLES, MOST_DELAY_S, MOST_GAP, MOST_LAG_S_JOINT, MOST_SHIFT_S_JOINT, MOST_SHIFT_STEPS,
    PEAK_EXPONENTS_JOINT, PEAK_SPEEDS, PLAYED_SHARES, RESONANCE_DAMPINGS, RESONANCE_STEPS,
    RESONANCES, RISE_TIMES_S, ROUND_LIMIT_SHARES, SHARPNESSES, SHIFTS_JOINT, SLOWEST_PEAK,
    SLOWEST_PEAK_FLOORS, SLOWEST_RESONANCE, STOP_SHARES,
};
use crate::weak::Windows;
use periods::{all_periods, pitches};
use rigproof_model::effects::facts::{Family, Shapes, Usual};
use rigproof_model::effects::{Form, Instant, facts, form, linear};
use rigproof_spec::effect::{Mechanism, Range};

/// The candidates for the search by one cause at a time. Mechanisms that are only compared in sets
/// are left out.
pub fn causes(problem: &Problem) -> Vec<Cause> {
    let mut causes = all_causes(problem);
    causes.retain(|cause| {
        let in_sets = facts(cause.mechanism).is_some_and(|facts| facts.in_sets);
        let is_encoder = cause.at == Place::Whole && cause.mechanism == Mechanism::EncoderScale;
        !in_sets && !is_encoder && !cause.is_composed()
    });
    causes
}

/// Every cause that has a meaning on this plant. Within trials a gain is not identifiable, because
/// each trial has a gain of its own.
pub fn all_causes(problem: &Problem) -> Vec<Cause> {
    let mut causes = problem.run.causes();
    // Within trials a gain is projected out of every row, and with it a gain for each direction.
    let asymmetry = Cause::of(Mechanism::DirectionAsymmetry).of_torque();
    let is_gain = |own: &Cause| own.mechanism == Mechanism::GainError || *own == asymmetry;
    causes.retain(|cause| !problem.is_within_trials() || !is_gain(cause));
    causes
}

/// Whether it is a common friction or a constant without a shape: something that every joint may
/// have.
pub fn is_plain(mechanism: Mechanism) -> bool {
    facts(mechanism).is_some_and(|own| {
        let family = matches!(own.family, Family::FrictionOfMotion | Family::Constant);
        let usual = matches!(own.usual, Usual::Plain | Usual::Frequent);
        family && usual && matches!(own.shapes, Shapes::None)
    })
}

/// One term for each trial shape of a cause, built beside the terms of `fitted`.
pub fn variants(problem: &Problem, cause: Cause, terms: &[&Term], fitted: &Fit) -> Vec<Term> {
    each_shape(problem, cause, terms, fitted, |shape| {
        problem.whole_term(cause, shape)
    })
}

/// The same with white rows alone, for what reads nothing else.
pub fn white_variants(problem: &Problem, cause: Cause, terms: &[&Term], fitted: &Fit) -> Vec<Term> {
    each_shape(problem, cause, terms, fitted, |shape| {
        let kept = problem.kept(cause, shape)?;
        Some(kept.trial(&problem.windows.usable).into_owned())
    })
}

fn each_shape(
    problem: &Problem,
    cause: Cause,
    terms: &[&Term],
    fitted: &Fit,
    of: impl Fn(&[f64]) -> Option<Term>,
) -> Vec<Term> {
    let effort = modelled_effort(problem, terms, fitted);
    shapes(problem, cause, &fitted.residual)
        .iter()
        .filter_map(|shape| of(shape).or_else(|| realise(problem, cause, shape, None, &effort)))
        .collect()
}

/// The term of any cause. `effort` is the effort that the other terms give.
pub fn realise(
    problem: &Problem,
    cause: Cause,
    shape: &[f64],
    onset_s: Option<f64>,
    effort: &[f64],
) -> Option<Term> {
    // A cause that moves the whole plant is expensive to compute, and later rounds of the search
    // ask for the same shapes.
    if problem.run.moves(cause) && onset_s.is_none() {
        return problem.whole_term(cause, shape);
    }
    problem
        .term(cause, shape, onset_s)
        .or_else(|| problem.drive_term(cause, shape, onset_s, effort))
}

/// The effort that the known part and the fitted terms give together, sample by sample.
///
/// Changes of the drive are left out, since they act on this effort. Empty where no cause needs it.
pub fn modelled_effort(problem: &Problem, terms: &[&Term], fitted: &Fit) -> Vec<f64> {
    if !problem.run.is_linearised() {
        return Vec::new();
    }
    let mut effort = problem.known.clone();
    let mut coefficients = fitted.coefficients.iter().copied();
    for column in &problem.nuisances {
        add(
            &mut effort,
            &column.signal,
            coefficients.next().unwrap_or(0.0),
        );
    }
    for term in terms {
        let mut given = term.known.iter().flatten().copied();
        for rows in &term.free {
            let times = if term.known.is_some() {
                given.next()
            } else {
                coefficients.next()
            };
            add(&mut effort, &rows.signal, times.unwrap_or(0.0));
        }
        let fixed = term.fixed.as_ref();
        if let Some(fixed) = fixed.filter(|_| !term.cause.is_of_drive()) {
            add(&mut effort, &fixed.signal, 1.0);
        }
    }
    effort
}

fn shapes(problem: &Problem, cause: Cause, residual: &[f64]) -> Vec<Vec<f64>> {
    problem.run.shapes(cause, &problem.windows, residual)
}

/// Whether a cause is an encoder's error whose columns hold for any size.
fn is_straight_encoder<R: Run + ?Sized>(run: &R, cause: Cause) -> bool {
    form(cause.mechanism).is_some_and(Form::is_of_encoder) && !run.moves(cause)
}

/// The trial shapes of a cause on most plants. `residual` has one value per row.
pub fn standard_shapes<R: Run + ?Sized>(
    run: &R,
    cause: Cause,
    windows: &Windows,
    residual: &[f64],
) -> Vec<Vec<f64>> {
    let (travel, step_s) = (run.travel(cause.at).max(1e-12), run.clock().step_s);
    let one = |values: Vec<f64>| values.into_iter().map(|v| vec![v]).collect();
    match facts(cause.mechanism).map_or(Shapes::None, |facts| facts.shapes) {
        Shapes::Peak => stribeck_shapes(
            run.speed_floor(),
            fastest(run.motion(cause.at)),
            &PEAK_EXPONENTS_JOINT,
        ),
        Shapes::Bristle => one(bends(run, travel)),
        Shapes::BristleCurve => bends(run, travel)
            .into_iter()
            .flat_map(|travel| BRISTLE_EXPONENTS.map(|exponent| vec![travel, exponent]))
            .collect(),
        Shapes::Memory => memories(travel),
        // The trial values of an encoder's cause are steps of a finite difference.
        Shapes::Values(_) if is_straight_encoder(run, cause) => vec![vec![]],
        Shapes::Gap => one(gaps(run, travel)),
        Shapes::OfTravel { low, high, count } => lashes(
            &geometric(low * travel, high * travel, count),
            middle(run.motion(cause.at)),
        ),
        Shapes::Stop => stops(run.motion(cause.at)),
        Shapes::OfLoad { low, high, count } => by_load(&geometric(low, high, count), run),
        Shapes::Resonance => resonances(step_s, &gaps(run, travel)),
        Shapes::EffortLimit => limits(greatest(&run.effort()), EFFORT_LIMIT_SHARES, EFFORT_LIMITS),
        Shapes::EffortRate => one(effort_rates(&run.effort())),
        Shapes::Period => one(all_periods(run, cause, windows, residual)),
        Shapes::Pitch => pitches(run, cause, windows, residual),
        Shapes::Lag => {
            let least_s = LEAST_LAG_STEPS * step_s;
            one(geometric(least_s, MOST_LAG_S_JOINT, LAGS_JOINT))
        }
        Shapes::Shift => one(both_signs(geometric(
            LEAST_SHIFT_STEPS_JOINT * step_s,
            MOST_SHIFT_S_JOINT.max(MOST_SHIFT_STEPS * step_s),
            SHIFTS_JOINT,
        ))),
        Shapes::CurrentPlay { low, high, count } => {
            let full = run.full_current();
            plays(&geometric(low * full, high * full, count), &[], full)
        }
        Shapes::Delay => one(geometric(step_s, MOST_DELAY_S, DELAYS)),
        Shapes::CurrentLimit => run.brake().map_or(Vec::new(), |(_, own)| {
            current_limits(own, run.full_current())
        }),
        Shapes::Edges { low, high, count } => edges(&geometric(low, high, count)),
        Shapes::CommandExponent(exponents) => exponents
            .iter()
            .map(|exponent| vec![*exponent, run.full_current()])
            .collect(),
        // A spring to an anchor needs a plane.
        Shapes::Anchor => vec![vec![]],
        own @ (Shapes::None
        | Shapes::Values(_)
        | Shapes::Geometric { .. }
        | Shapes::Optional { .. }
        | Shapes::BothSigns { .. }) => in_numbers(own),
    }
}

/// The shapes of a play of the current: single plays whose sides meet below a current or stay open,
/// and spread plays with and without the scale of the table, which ends at the greatest current.
pub fn plays(widths: &[f64], closing_a: &[f64], full: f64) -> Vec<Vec<f64>> {
    let of_width = |width: f64, share: f64| {
        let closing = closing_a
            .iter()
            .map(move |below| vec![width, share, *below]);
        let others = [
            vec![width, share],
            vec![width, share, 0.0, 1.0],
            vec![width, share, 0.0, 1.0, full],
        ];
        closing.chain(others)
    };
    let pairs = widths
        .iter()
        .flat_map(|width| PLAYED_SHARES.map(|share| (*width, share)));
    pairs
        .flat_map(|(width, share)| of_width(width, share))
        .collect()
}

/// Both edges of a brake by one factor, the rising one alone, and the falling one alone.
fn edges(times: &[f64]) -> Vec<Vec<f64>> {
    let each = times.iter();
    each.flat_map(|own| [vec![*own], vec![*own, 1.0], vec![1.0, *own]])
        .collect()
}

/// Gaps about zero and about a middle.
fn lashes(widths: &[f64], middle: f64) -> Vec<Vec<f64>> {
    let each = widths.iter();
    each.flat_map(|own| [vec![*own], vec![*own, middle]])
        .collect()
}

/// Positions where a stop may begin, from the middle of the travel to near its ends, with its side.
pub fn stops(motion: &[Instant]) -> Vec<Vec<f64>> {
    let [low, high] = ends(motion.iter().map(|now| now.position));
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let shares = STOP_SHARES.into_iter();
    let each = shares.flat_map(|share| [1.0, -1.0].map(|side| (share, side)));
    each.map(|(share, side)| vec![middle + side * share * half, side])
        .collect()
}

/// The middle of the range of a motion.
fn middle(motion: &[Instant]) -> f64 {
    let [low, high] = ends(motion.iter().map(|now| now.position));
    0.5 * (low + high)
}

/// Trial travels of presliding, from the least that can be observed.
fn bends<R: Run + ?Sized>(run: &R, travel: f64) -> Vec<f64> {
    let least = (LEAST_BEND_SIGMAS * run.position_noise()).max(LEAST_BEND * travel);
    geometric(least, MOST_BEND * travel, BENDS_JOINT)
}

/// Trial rates of a memory of the displacement.
fn memories(travel: f64) -> Vec<Vec<f64>> {
    let [slowest, fastest] = MEMORY_RATES;
    geometric(slowest / travel, fastest / travel, MEMORY_COUNT)
        .into_iter()
        .flat_map(|gamma| MEMORY_RATIOS.map(|ratio| vec![gamma, gamma * ratio]))
        .collect()
}

/// Trial widths of a backlash.
fn gaps<R: Run + ?Sized>(run: &R, travel: f64) -> Vec<f64> {
    let least = (LEAST_GAP_SIGMAS * run.position_noise()).max(LEAST_GAP * travel);
    geometric(least, MOST_GAP * travel, GAPS)
}

/// Trial resonances of a compliance, with damping ratios, and with play some of these widths.
fn resonances(step_s: f64, gaps: &[f64]) -> Vec<Vec<f64>> {
    let [least, most] = FASTEST_RESONANCE;
    let fastest = (RESONANCE_STEPS / step_s).clamp(least, most);
    let resonances = geometric(SLOWEST_RESONANCE, fastest, RESONANCES);
    let held = resonances.iter();
    let held = held.flat_map(|own| RESONANCE_DAMPINGS.map(|damping| vec![*own, damping]));
    let [_, damping] = RESONANCE_DAMPINGS;
    let with_play = resonances.iter().flat_map(|own| {
        let gaps = gaps.iter().step_by(GAPS_OF_A_SPRING);
        gaps.map(|gap| vec![*own, damping, *gap])
    });
    held.chain(with_play).collect()
}

/// Trial limits of a brake's current, A, of which `full` is the greatest; none where hardly any
/// flowed.
pub fn current_limits(given: &[f64], full: f64) -> Vec<Vec<f64>> {
    match greatest(given) {
        most if most < LEAST_LIMITED * full => Vec::new(),
        most => limits(most, LIMIT_SHARES, LIMITS),
    }
}

/// Trial limits of an effort or a current: `count` sharp ones between two shares of the greatest
/// command, and round ones, which a command feels before it reaches them.
fn limits(greatest: f64, [lowest, highest]: [f64; 2], count: usize) -> Vec<Vec<f64>> {
    let sharp = geometric(lowest * greatest, highest * greatest, count);
    let [lowest, highest] = ROUND_LIMIT_SHARES;
    let round = geometric(lowest * greatest, highest * greatest, LIMITS);
    let bent = round
        .into_iter()
        .flat_map(|limit| SHARPNESSES.map(|sharpness| vec![limit, sharpness]));
    let sharp = sharp.into_iter().map(|limit| vec![limit]);
    sharp.chain(bent).collect()
}

/// Friction by the load, and by powers of it that rub as much at the greatest load.
fn by_load<R: Run + ?Sized>(shares: &[f64], run: &R) -> Vec<Vec<f64>> {
    let greatest = greatest(&run.effort());
    let plain = shares.iter().map(|share| vec![*share]);
    let by_power = shares.iter().flat_map(|share| {
        LOAD_EXPONENTS.map(|own| vec![share * libm::pow(greatest, 1.0 - own), own])
    });
    plain.chain(by_power).collect()
}

/// Trial rates of the effort: those that reach the greatest command within a time.
fn effort_rates(effort: &[f64]) -> Vec<f64> {
    let [longest_s, shortest_s] = RISE_TIMES_S;
    let greatest = greatest(effort);
    geometric(greatest / longest_s, greatest / shortest_s, LAGS_JOINT)
}

fn greatest(effort: &[f64]) -> f64 {
    effort.iter().fold(0.0, |most: f64, e| most.max(e.abs()))
}

/// The trial shapes that do not depend on the recording; one empty shape for a mechanism without
/// shape.
pub fn in_numbers(shapes: Shapes) -> Vec<Vec<f64>> {
    let plainer = matches!(shapes, Shapes::Optional { .. }).then(Vec::new);
    let values = match shapes {
        Shapes::Values(values) => values.to_vec(),
        Shapes::Geometric { low, high, count }
        | Shapes::Edges { low, high, count }
        | Shapes::Optional { low, high, count } => geometric(low, high, count),
        Shapes::BothSigns { low, high, count } => both_signs(geometric(low, high, count)),
        _ => return vec![vec![]],
    };
    let values = values.into_iter().map(|value| vec![value]);
    plainer.into_iter().chain(values).collect()
}

pub fn both_signs(sizes: Vec<f64>) -> Vec<f64> {
    sizes.into_iter().flat_map(|size| [size, -size]).collect()
}

/// The bounds of each parameter of a shape: those of the trial shapes, and for a period the whole
/// range of periods. Those of the first are of the trial shapes with as many numbers: with one more
/// the law is another form, and its first number has another range.
pub fn shape_bounds(problem: &Problem, cause: Cause, shape: &[f64]) -> Bounds {
    problem.kept_bounds(cause, shape.len(), || bounds(problem, cause, shape.len()))
}

fn bounds(problem: &Problem, cause: Cause, length: usize) -> Vec<(f64, f64)> {
    if is_periodic(cause) {
        let travel = problem.run.travel(cause.at);
        let travel = travel.max(1e-12);
        return vec![(travel / MOST_CYCLES, longest_period(travel, cause))];
    }
    let tried = shapes(problem, cause, &[]);
    let count = tried.iter().map(Vec::len).max().unwrap_or(0);
    let is_as_long = |own: &&Vec<f64>| own.len() == length;
    let of_form = tried.iter().any(|own| is_as_long(&own));
    let mut bounds: Vec<(f64, f64)> = (0..count)
        .map(|k| {
            let own = tried
                .iter()
                .filter(|own| k > 0 || !of_form || is_as_long(own));
            let values = own.filter_map(|shape| shape.get(k).copied());
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            })
        })
        .collect();
    // A part of something is looked for from nothing to all of it.
    let numbers = cause.mechanism.parameters().iter();
    let linear = linear(cause.mechanism);
    for (own, number) in bounds.iter_mut().zip(numbers.skip(linear)) {
        if number.range == Range::Part {
            *own = (0.0, 1.0);
        }
    }
    if let Some(first) = bounds.first_mut() {
        *first = problem.run.reach(cause).unwrap_or(*first);
    }
    bounds
}

/// Whether the first shape parameter ended at a bound. The recording then does not determine it,
/// and the law substitutes for another one.
pub fn is_at_an_end(problem: &Problem, term: &Term) -> bool {
    let bounds = shape_bounds(problem, term.cause, &term.shape);
    let first = term.numbers().first().zip(bounds.first());
    first.is_some_and(|(value, bounds)| bounds.0 < bounds.1 && is_end(*value, *bounds))
}

/// The places of a term's shape parameters that were searched for.
///
/// A parameter whose range is a point is given. One that ends at a bound, other than the first,
/// stands for the simpler law and does not count, unless it is a sign.
pub fn searched(problem: &Problem, term: &Term) -> impl Iterator<Item = usize> {
    let bounds = shape_bounds(problem, term.cause, &term.shape);
    let own = term.numbers().iter().zip(&bounds[..]);
    let own: Vec<(f64, (f64, f64))> = own.map(|(value, bounds)| (*value, *bounds)).collect();
    let open = own.into_iter().enumerate();
    open.filter(|(k, (value, bounds))| match k {
        0 => bounds.0 < bounds.1,
        _ => is_sign(term.cause, *k) || !is_end(*value, *bounds),
    })
    .map(|(k, _)| k)
}

/// Whether a shape parameter is a sign, which is one or the other and is not refined.
pub fn is_sign(cause: Cause, place: usize) -> bool {
    let number = cause
        .mechanism
        .parameters()
        .get(linear(cause.mechanism) + place);
    number.is_some_and(|number| number.range == Range::Sign)
}

/// Whether a value lies at an end of a range.
pub fn is_end(value: f64, (low, high): (f64, f64)) -> bool {
    let near = (1.0 - EDGE) * value.abs();
    value <= low + near || value >= high - near
}

/// The 99th percentile of the speed.
pub fn fastest(motion: &[Instant]) -> f64 {
    let mut speeds: Vec<f64> = motion.iter().map(|now| now.speed.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    speeds
        .get(speeds.len() * 99 / 100)
        .copied()
        .unwrap_or(1.0)
        .max(1e-12)
}

/// Trial Stribeck speeds and exponents.
pub fn stribeck_shapes(speed_floor: f64, fastest: f64, exponents: &[f64]) -> Vec<Vec<f64>> {
    let slowest = (SLOWEST_PEAK_FLOORS * speed_floor).max(SLOWEST_PEAK * fastest);
    geometric(slowest, FASTEST_PEAK * fastest, PEAK_SPEEDS)
        .into_iter()
        .flat_map(|speed| exponents.iter().map(move |exponent| vec![speed, *exponent]))
        .collect()
}

/// `count` values from `low` to `high` in geometric progression.
pub fn geometric(low: f64, high: f64, count: usize) -> Vec<f64> {
    let ratio = libm::log(high.max(1.01 * low) / low) / (count.max(2) - 1) as f64;
    (0..count)
        .map(|k| low * libm::exp(ratio * k as f64))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_geometric_grid_meets_both_ends_in_equal_ratios() {
        let grid = geometric(0.013, 4.7, 9);
        assert!((grid[0] - 0.013).abs() < 1e-12 && (grid[8] - 4.7).abs() < 1e-9);
        let ratio = grid[1] / grid[0];
        assert!(
            grid.windows(2)
                .all(|w| (w[1] / w[0] / ratio - 1.0).abs() < 1e-9)
        );
    }
}
