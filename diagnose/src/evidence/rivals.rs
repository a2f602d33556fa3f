//! This file says what could stand in the place of what was found: rivals that explain as much, and richer laws of which it is the limit.

use super::without;
use crate::candidates::{causes, modelled_effort, realise, variants};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit, nested_block_losses, paired};
use crate::report::LimitOf;
use crate::rules::{NEAR_RIVAL, RIVAL_SHARE, RIVAL_TIE_Z, TIMES_LEFT};
use crate::select::{
    LEAST_SIGMAS, Selection, TIE_Z, as_two, best_variant, gives_energy, is_noise, refined, refs,
    usable_rms,
};
use rayon::prelude::*;
use rigproof_model::effects::entry;
use rigproof_model::effects::facts::End;
use rigproof_spec::effect::Parameter;

/// What could stand in the place of one found mechanism.
#[derive(Clone, Debug, Default)]
pub struct Rivals {
    /// What explains as much.
    pub instead: Vec<Cause>,
    /// Two that are the same law together: see [`as_two`].
    pub together: Option<[Cause; 2]>,
    /// Richer laws that come to the same here.
    pub limit_of: Vec<Richer>,
}

/// A richer law of which a found mechanism or a rival of it is the limit, and how far from the limit the recording does not tell the two apart.
#[derive(Clone, Debug)]
pub struct Richer {
    /// The richer law.
    pub cause: Cause,
    /// Its limit: what was found, or another rival of it.
    pub limit: Cause,
    /// The parameter that goes to its limit.
    pub parameter: Parameter,
    /// The end of its range that the limit is at.
    pub end: End,
    /// The value farthest from the limit, of those tried, that looks the same; `None` for a linear parameter, which is not told from 0.
    pub bound: Option<f64>,
}

impl Rivals {
    /// What could stand in its place, as a report has it: `presliding at E with constant_bias at E` takes both.
    pub fn names(&self, problem: &Problem) -> Vec<String> {
        let alone = self.instead.iter().map(|cause| problem.name(*cause));
        let together = self
            .together
            .iter()
            .map(|pair| pair.map(|cause| problem.name(cause)).join(" with "));
        alone.chain(together).collect()
    }

    /// The richer laws as a report has them.
    pub fn limits(&self, problem: &Problem) -> Vec<LimitOf> {
        let motion = problem.run.motion_kind();
        let all = self.limit_of.iter();
        all.map(|richer| LimitOf {
            name: problem.name(richer.cause),
            limit: problem.name(richer.limit),
            parameter: richer.parameter.name,
            at_most: richer.bound.filter(|_| richer.end == End::Nothing),
            at_least: richer.bound.filter(|_| richer.end == End::Everything),
            unit: richer.parameter.quantity.dimension(motion).to_string(),
        })
        .collect()
    }
}

/// For each found mechanism, what could stand in its place.
pub fn rivals(problem: &Problem, selection: &Selection) -> Vec<Rivals> {
    let blocks = Blocks::new(problem);
    (0..selection.found.len())
        .map(|index| rivals_of(problem, selection, index, &blocks))
        .collect()
}

fn rivals_of(problem: &Problem, selection: &Selection, index: usize, blocks: &Blocks) -> Rivals {
    let others = without(&selection.found, index);
    let common = refs(&selection.nominal, &others);
    let bare = fit(problem, &common, blocks);
    let taken: Vec<Cause> = refs(&selection.nominal, &selection.found)
        .iter()
        .map(|t| t.cause)
        .collect();
    let place = Place {
        problem,
        selection,
        index,
        blocks,
        gain: bare.left_out() - selection.after.left_out(),
        telling: telling(problem, selection),
        apart: apart(problem, selection),
        bare,
        common,
    };
    let open = causes(problem).into_par_iter();
    let open = open.filter(|cause| !taken.contains(cause));
    let all: Vec<Rival> = open.filter_map(|cause| place.rival(cause)).collect();
    let mut rivals = Rivals {
        together: as_two(problem, selection, index),
        ..Rivals::default()
    };
    for rival in &all {
        match place.richer(rival, &all) {
            Some(richer) => rivals.limit_of.push(richer),
            None => rivals.instead.push(rival.cause),
        }
    }
    rivals
}

/// Something that explains as much as what was found.
struct Rival {
    cause: Cause,
    /// The variants that were tried.
    tried: Vec<Term>,
    /// The left-out loss of each block.
    losses: Vec<f64>,
}

/// The place of one found mechanism among the others.
struct Place<'a> {
    problem: &'a Problem<'a>,
    selection: &'a Selection,
    index: usize,
    blocks: &'a Blocks,
    common: Vec<&'a Term>,
    /// The fit without it.
    bare: Fit,
    /// What it takes away of the left-out loss.
    gain: f64,
    /// See [`telling`].
    telling: f64,
    /// From how much more left-out loss on a law is no limit of a richer one.
    apart: f64,
}

impl Place<'_> {
    /// A cause with its variants, if it explains as much as what was found.
    fn rival(&self, cause: Cause) -> Option<Rival> {
        let Place {
            problem,
            common,
            bare,
            ..
        } = self;
        let mut tried = variants(problem, cause, common, bare);
        let own = self.selection.found.get(self.index);
        if let Some(onset_s) = own.and_then(|f| f.term.onset_s) {
            let effort = modelled_effort(problem, common, bare);
            let late = tried.iter();
            let late: Vec<Term> = late
                .filter_map(|t| realise(problem, cause, &t.shape, Some(onset_s), &effort))
                .collect();
            tried.extend(late);
        }
        if let Some(losses) = self.as_good(&tried) {
            return Some(Rival {
                cause,
                tried,
                losses,
            });
        }
        // A shape between two of the grid may do what neither of them does.
        let (start, loss) = best_variant(problem, common, &tried)?;
        let near = bare.loss - loss >= NEAR_RIVAL * (bare.loss - self.selection.after.loss);
        if !near || start.shape.is_empty() {
            return None;
        }
        tried.push(refined(problem, common, start, self.blocks));
        let losses = self.as_good(&tried)?;
        Some(Rival {
            cause,
            tried,
            losses,
        })
    }

    /// The left-out losses of some variants that explain as much as what was found.
    fn as_good(&self, tried: &[Term]) -> Option<Vec<f64>> {
        let Place {
            problem, common, ..
        } = self;
        let losses = nested_block_losses(problem, common, tried, self.blocks);
        let own = &self.selection.after.block_loss;
        let (_, z) = paired(&losses, own, &vec![1.0; losses.len()]);
        let reached = self.bare.left_out() - losses.iter().sum::<f64>();
        let enough = reached >= problem.rules.least_rival_share * self.gain;
        let as_good = enough && z < TIE_Z
            || (reached >= RIVAL_SHARE * self.gain && reached > 0.0 && z < RIVAL_TIE_Z);
        let is_rival = as_good
            && more_elsewhere(&losses, own) < self.telling
            && best_variant(problem, common, tried)
                .is_none_or(|(best, _)| !gives_energy(problem, common, &best, self.blocks));
        is_rival.then_some(losses)
    }

    /// How a rival is a richer law of which what was found, or another rival, is the limit, where the recording does not tell the two apart: it
    /// leaves no less.
    fn richer(&self, rival: &Rival, all: &[Rival]) -> Option<Richer> {
        let found = self.selection.found.get(self.index)?.term.cause;
        let own = [(found, &self.selection.after.block_loss)];
        let others = all.iter().map(|other| (other.cause, &other.losses));
        own.into_iter()
            .chain(others)
            .find_map(|(limit, losses)| self.beyond(rival, limit, losses))
    }

    fn beyond(&self, rival: &Rival, limit: Cause, losses: &[f64]) -> Option<Richer> {
        let cause = rival.cause;
        let richer = entry(cause.mechanism)?;
        let own = richer.facts.limit;
        let own = own.filter(|own| (own.of, cause.at) == (limit.mechanism, limit.at))?;
        let (place, end) = (own.parameter, own.end);
        if self.apart.is_infinite() || more_elsewhere(losses, &rival.losses) >= self.apart {
            return None;
        }
        let shape = place.checked_sub(richer.linear);
        let alike = rival.tried.iter().filter(|term| {
            let mut terms = self.common.clone();
            terms.push(term);
            let with = fit(self.problem, &terms, self.blocks).block_loss;
            more_elsewhere(&with, losses) < self.apart
        });
        let values = alike.filter_map(|term| term.shape.get(shape?).copied());
        Some(Richer {
            cause,
            limit,
            parameter: *cause.mechanism.parameters().get(place)?,
            end,
            bound: match end {
                End::Nothing => values.reduce(f64::max),
                End::Everything => values.reduce(f64::min),
            },
        })
    }
}

/// From how much more left-out loss on one explanation is another's rival no more; without bound where rivals are not told apart by the floor. Where what was
/// named leaves nothing but noise, noise is the measure: the scatter of a short recording's few blocks would keep what leaves many deviations more.
/// Where it leaves more, since a law seldom has the exact form of what is there, what it leaves is, and no less than what tells two white
/// explanations apart.
fn telling(problem: &Problem, selection: &Selection) -> f64 {
    if problem.rules.by_floor && !is_noise(problem, &selection.after) {
        return ((TIMES_LEFT - 1.0) * selection.after.left_out()).max(LEAST_SIGMAS.powi(2));
    }
    apart(problem, selection)
}

/// Standard deviations of what is left, squared; without bound where rivals are not told apart by the floor.
fn apart(problem: &Problem, selection: &Selection) -> f64 {
    let left = usable_rms(problem, &selection.after.residual) / problem.floor;
    match problem.rules.by_floor {
        true => (left.max(1.0) * LEAST_SIGMAS).powi(2),
        false => f64::INFINITY,
    }
}

/// How much more one leaves than another, the block aside in which it is most: one moment alone, such as the start, tells nothing.
fn more_elsewhere(losses: &[f64], own: &[f64]) -> f64 {
    let more = losses.iter().zip(own).map(|(loss, own)| loss - own);
    more.clone().sum::<f64>() - more.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::{noise_rows, short_run, target};
    use crate::problem::add;
    use crate::select::Found;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    const DRY: (Mechanism, &[f64]) = (Mechanism::DryOffset, &[]);

    fn bristle(travel_rad: &f64) -> (Mechanism, &[f64]) {
        (Mechanism::Presliding, core::slice::from_ref(travel_rad))
    }

    fn at_e(mechanism: Mechanism) -> Cause {
        five_bar::run::at(mechanism, Joint::E)
    }

    /// The place of what was named at E, beside something hidden there of 0.21 N·m and drag that was not found.
    fn in_place<T>(
        [hidden, named]: [(Mechanism, &[f64]); 2],
        drag_nms: f64,
        ask: impl FnOnce(Place<'_>) -> T,
    ) -> T {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let [hidden, named] = [hidden, named]
            .map(|(mechanism, shape)| problem.term(at_e(mechanism), shape, None).unwrap());
        let mut raw = noise_rows(&problem, 29);
        add(&mut raw, &hidden.free[0].raw, 0.21);
        let drag = five_bar::run::at(Mechanism::Viscous, Joint::B);
        let drag = problem.term(drag, &[], None).unwrap();
        add(&mut raw, &drag.free[0].raw, drag_nms);
        problem.target = target(&problem, raw);
        let blocks = Blocks::new(&problem);
        let [before, after] = [vec![], vec![&named]].map(|terms| fit(&problem, &terms, &blocks));
        let found = Found {
            term: named.clone(),
            z: 3.7,
            share: 0.7,
            at_floor: true,
            probability: 1.0,
        };
        let selection = Selection {
            nominal: Vec::new(),
            found: vec![found],
            too_small: Vec::new(),
            stages: Vec::new(),
            before: before.clone(),
            after,
        };
        ask(Place {
            problem: &problem,
            selection: &selection,
            index: 0,
            blocks: &blocks,
            gain: before.left_out() - selection.after.left_out(),
            telling: telling(&problem, &selection),
            apart: apart(&problem, &selection),
            bare: before,
            common: Vec::new(),
        })
    }

    /// What a bristle at E is beside dry friction that was found there, when a bristle of this travel is what is left out, and drag that was not found.
    fn beside_dry_friction(travel_rad: f64, drag_nms: f64) -> Option<Richer> {
        in_place([bristle(&travel_rad), DRY], drag_nms, |place| {
            place.richer(&place.rival(at_e(Mechanism::Presliding)).unwrap(), &[])
        })
    }

    #[test]
    fn a_bristle_that_hardly_bends_is_dry_friction_and_one_that_bends_is_none() {
        let richer = beside_dry_friction(1e-5, 0.0).unwrap();
        assert_eq!(
            (richer.parameter.name, richer.end),
            ("travel", End::Nothing)
        );
        let bound = richer.bound.unwrap();
        assert!((1e-5..0.02).contains(&bound), "{bound} rad");
        assert!(beside_dry_friction(0.05, 0.0).is_none());
        // Beside something else that stays, as well.
        assert!(beside_dry_friction(1e-5, 0.03).is_some());
        assert!(beside_dry_friction(0.05, 0.03).is_none());
    }

    #[test]
    fn beside_what_leaves_more_than_noise_a_rival_leaves_no_more_than_twice_that_but_for_a_block() {
        let dry_is_rival = |drag_nms, told: bool| {
            in_place([bristle(&0.05), bristle(&0.05)], drag_nms, |place| {
                let telling = match told {
                    true => place.telling,
                    false => f64::INFINITY,
                };
                let place = Place { telling, ..place };
                place.rival(at_e(Mechanism::DryOffset)).is_some()
            })
        };
        // Of some 9·10⁵ the bristle leaves 1.8·10⁴ and 1.1·10⁵, dry friction 1.9·10⁵ and 2.6·10⁵.
        let told = [0.02, 0.05].map(|drag_nms| dry_is_rival(drag_nms, true));
        assert_eq!(told, [false, true]);
        // Without it both would do.
        assert!(dry_is_rival(0.02, false));
    }

    #[test]
    fn one_moment_alone_tells_no_two_explanations_apart() {
        let own = [0.7, 1.1, 0.9, 1.3];
        let at_the_start = [700.7, 1.0, 1.4, 1.2];
        let all_along = [70.7, 71.1, 50.9, 61.3];
        assert!((more_elsewhere(&at_the_start, &own) - 0.3).abs() < 1e-9);
        assert!((more_elsewhere(&all_along, &own) - 180.0).abs() < 1e-9);
        // Where another explains more than what was named there is nothing to set aside.
        assert!((more_elsewhere(&[0.6, 1.0, 0.8, 1.2], &own) + 0.4).abs() < 1e-9);
    }
}
