//! This file puts an onset into the middle of the times that explain the recording alike: where a joint rests or turns back nobody sees when something begins.

use super::Found;
use super::refine::ONSET_MARGIN;
use super::weigh::loss_with;
use crate::candidates::realise;
use crate::problem::{Problem, Term};

/// What an onset may leave more and explain the recording alike: 95 % of χ² with one degree of freedom.
const ALIKE: f64 = 3.84;

/// The first step away from an onset, s.
const FIRST_STEP_S: f64 = 0.005;

/// Halvings between a time that explains the recording alike and one that does not.
const HALVINGS: usize = 6;

/// Puts every onset into the middle of the times around it that are alike.
pub(super) fn centre(problem: &Problem, nominal: &[Term], found: &mut [Found]) {
    for index in 0..found.len() {
        let others = found.iter().enumerate().filter(|(k, _)| *k != index);
        let common: Vec<&Term> = nominal.iter().chain(others.map(|(_, f)| &f.term)).collect();
        let centred = found
            .get(index)
            .and_then(|own| centred(problem, &common, &own.term));
        if let (Some(term), Some(slot)) = (centred, found.get_mut(index)) {
            slot.term = term;
        }
    }
}

fn centred(problem: &Problem, common: &[&Term], term: &Term) -> Option<Term> {
    let onset_s = term.onset_s?;
    let limit = loss_with(problem, common, term) + ALIKE;
    let at = |onset_s| realise(problem, term.cause, &term.shape, Some(onset_s), &[]);
    let alike = |term: &Term| loss_with(problem, common, term) <= limit;
    let margin_s = ONSET_MARGIN * problem.plant.duration_s();
    let first_s = problem.plant.start_s() + margin_s;
    let last_s = problem.plant.start_s() + problem.plant.duration_s() - margin_s;
    let is_alike =
        |time_s: f64| (first_s..last_s).contains(&time_s) && at(time_s).is_some_and(|t| alike(&t));
    let [down, up] = [-1.0, 1.0].map(|sign| reach(|by| is_alike(onset_s + sign * by)));
    at(onset_s + 0.5 * (up - down)).filter(alike)
}

/// How far one may go while it is alike, s.
fn reach(is_alike: impl Fn(f64) -> bool) -> f64 {
    let (mut inside, mut outside) = (0.0, FIRST_STEP_S);
    while is_alike(outside) {
        (inside, outside) = (outside, 2.0 * outside);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if is_alike(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::five_bar;
    use crate::five_bar::recorded::{noise_rows, short_run, target};
    use crate::problem::{Cause, add};
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn an_onset_that_nobody_sees_is_in_the_middle_of_where_it_may_be() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let times_s = problem.windows.times_s();
        for (usable, time_s) in problem.windows.usable.iter_mut().zip(times_s) {
            *usable &= !(1.1..1.9).contains(&time_s);
        }
        problem.whitener = five_bar::noise::whitener(&run, &problem.windows, 0.0);
        let cause = Cause {
            mechanism: Mechanism::DryOffset,
            joint: Some(Joint::A),
        };
        let at = |onset_s| problem.term(cause, &[], Some(onset_s)).unwrap();
        let mut raw = noise_rows(&problem, 37);
        add(&mut raw, &at(1.27).free[0].raw, 0.31);
        problem.target = target(&problem, raw);
        let early = problem.term(cause, &[], Some(1.21)).unwrap();
        let centred = centred(&problem, &[], &early).unwrap();
        let onset_s = centred.onset_s.unwrap();
        assert!((onset_s - 1.5).abs() < 0.06, "{onset_s} s");
    }

    #[test]
    fn the_reach_is_found_however_far_it_is() {
        for far in [0.0007, 0.031, 1.7] {
            let found = reach(|by| by <= far);
            assert!(found <= far && found > 0.98 * far - 1e-4, "{far}: {found}");
        }
    }
}
