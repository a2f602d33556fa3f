//! This file says that the rig's own laws pass: the five of table 6.1, and one of each other kind.
//!
//! `RIGPROOF_CAMPAIGN` is the number of scenarios a controller, in which every sample is set beside the reference; without it a slice runs, of which every
//! 16th is.

use rayon::prelude::*;
use rigproof_certify::built_in::{BuiltIn, Kind};
use rigproof_certify::declared::{EVERY, Solid};
use rigproof_certify::differential::tie::{Tie, Ties};
use rigproof_certify::law::Law;
use rigproof_certify::plan::Subject;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::trial::run;
use rigproof_spec::methods::Method;

pub const BOTH: [Rig; 2] = [Rig::ThreeBrake, Rig::FourBrake];

/// How many samples each law was held against.
type Samples = [u64; Law::ALL.len()];

/// Holds a controller to its laws, and its ties to their budget, and gives how many samples each law was held against.
fn passes(controller: BuiltIn, seed: u64) -> Samples {
    let campaign = std::env::var("RIGPROOF_CAMPAIGN").ok();
    let every = if campaign.is_some() { 1 } else { EVERY };
    let scenarios = campaign.map_or(40, |text| text.parse().unwrap());
    let declared = Subject::beside(controller, every).declared;
    let one = |index: u64| {
        let scenario = Scenario::drawn(seed, index, &BOTH, 2000);
        let ran = run(&scenario, &controller, &declared, false).unwrap();
        let broken: Vec<_> = ran.broken().collect();
        assert!(broken.is_empty(), "{controller:?} in {index}: {broken:?}");
        let mut trials = Ties::default();
        ran.ties.met().for_each(|(tie, _)| trials.add(tie));
        (ran.fared.map(|fared| fared.samples), trials)
    };
    let add = |(one, mut ties): (Samples, Ties), (other, more): (Samples, Ties)| {
        ties.join(&more);
        (std::array::from_fn(|law| one[law] + other[law]), ties)
    };
    let ran = (0..scenarios).into_par_iter().map(one);
    let (samples, ties) = ran.reduce(|| ([0; Law::ALL.len()], Ties::default()), add);
    let told = Law::ALL.iter().zip(samples);
    let told: Vec<String> = told.map(|(law, n)| format!("{} {n}", law.name())).collect();
    let ties: Vec<(Tie, u64)> = ties.met().collect();
    println!(
        "{:?}: {}; trials with ties {ties:?}",
        controller.law,
        told.join(", ")
    );
    let is_within = |(tie, trials): &(Tie, u64)| *trials <= tie.budget().most(scenarios);
    assert!(ties.iter().all(is_within), "{ties:?}");
    samples
}

#[test]
fn the_five_controllers_of_the_thesis_pass_their_laws() {
    for method in Method::ALL {
        let controller = BuiltIn::of(method);
        let samples = passes(controller, 11);
        for law in Law::ALL {
            let is_judged = law.not_looked_at(&controller.declared()).is_none();
            let count = samples[law as usize];
            assert_eq!(
                count > 0,
                is_judged,
                "{method:?}: {law:?} on {count} samples"
            );
        }
    }
}

#[test]
fn the_other_laws_of_the_rig_pass_too_and_so_does_an_obstacle() {
    let kinds = [
        Kind::VelocityRatio {
            gain_nm_s_per_rad: 1.7,
        },
        Kind::Optimal {
            weight_angle: 1.3,
            weight_energy: 0.4,
            horizon_s: 0.02,
        },
        Kind::Impedance {
            stiffness_n_per_m: 310.0,
            damping_across_n_s_per_m: 23.0,
            damping_along_n_s_per_m: 3.1,
        },
    ];
    let of = |law: Kind, obstacle: Option<Solid>| BuiltIn {
        law,
        boundary_m: 0.043,
        obstacle,
    };
    for law in kinds {
        let samples = passes(of(law, None), 12);
        assert!(samples[Law::BrakeCount as usize] > 10_000);
        assert!(samples[Law::Reference as usize] > 1000);
    }
    let wall = of(Kind::Sdof { gap_m: 0.0 }, Some(Solid::Left));
    assert!(passes(wall, 13)[Law::FreeSide as usize] > 10_000);
}
