//! This file says that every law but the one without control is taken by its own rig only, in whichever law it is wrapped.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{
    AnyLaw, Impedance, Law, Obstacle, Optimal, PathLaw, Proportional, Sdof, Side, Uncontrolled,
    VelocityRatio, Virtual, Weights,
};
use rigproof_impl::linkage::{Linkage, Shape, linkage};
use rigproof_impl::path::Line;
use rigproof_impl::tick::{Settings, Tick};
use rigproof_impl::tip_mass::Bodies;
use rigproof_impl::vector::Vector;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;

const LAYOUT: Layout = Layout::FourBrake;
const BOUNDARY_M: f64 = 0.023;

fn laws(arms: &Arms) -> Vec<PathLaw<f64, Line<f64>>> {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let of = Actuation::new(LAYOUT, arms, 11.3).unwrap();
    let weights = Weights {
        angle: 1.3,
        energy: 0.7,
        horizon_s: 0.011,
    };
    let elements = Virtual {
        stiffness_n_per_m: 310.0,
        damping_across_n_s_per_m: 17.0,
        damping_along_n_s_per_m: 3.1,
    };
    let bodies = Bodies::new(arms, &inertia(LAYOUT));
    vec![
        PathLaw::Sdof(Sdof::new(of, line, BOUNDARY_M, 0.0).unwrap()),
        PathLaw::Proportional(Proportional::new(of, line, BOUNDARY_M, 497.0).unwrap()),
        PathLaw::VelocityRatio(VelocityRatio::new(of, line, BOUNDARY_M, 7.3).unwrap()),
        PathLaw::Optimal(Optimal::new(of, line, BOUNDARY_M, weights, bodies).unwrap()),
        PathLaw::Impedance(Impedance::new(of, line, elements).unwrap()),
    ]
}

fn is_taken(law: impl Law<f64>) -> bool {
    Tick::<f64, _>::new(&Settings::thesis(LAYOUT), law).is_some()
}

#[test]
fn every_law_of_another_rig_is_refused_however_it_is_wrapped() {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let own = arms(LAYOUT);
    let mut longer = own;
    longer.l_cd_m += 1e-15;
    for (arms, expected) in [(own, true), (longer, false)] {
        for (place, law) in laws(&arms).into_iter().enumerate() {
            assert_eq!(is_taken(law), expected, "{place}");
            assert_eq!(is_taken(AnyLaw::Path(law)), expected, "{place}");
            let obstacle = Obstacle::new(line, Side::Left, law);
            assert_eq!(is_taken(obstacle), expected, "{place}");
            assert_eq!(is_taken(AnyLaw::Obstacle(obstacle)), expected, "{place}");
        }
    }
    assert!(is_taken(PathLaw::<f64, Line<f64>>::Uncontrolled(
        Uncontrolled
    )));
}

#[test]
fn how_near_a_singularity_is_does_not_depend_on_the_length_of_the_outer_arms() {
    for (l_ed_m, l_cd_m) in [(0.11, 0.13), (1.7, 1.9), (0.13, 1.1)] {
        let (l_ae_m, l_bc_m) = (0.31, 0.29);
        let of = Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m: 0.17,
        };
        let shape = Shape::new(&of);
        let unit = |angle: f64| Vector::new(libm::cos(angle), libm::sin(angle));
        let made: Linkage<f64> = linkage(&shape, unit(2.17), unit(0.83));
        let sine = |sine: f64| Linkage {
            ae: Vector::new(l_ae_m, 0.0),
            ed: Vector::new(0.0, -l_ed_m),
            bc: Vector::new(l_bc_m, 0.0),
            cd: Vector::new(0.0, l_cd_m),
            opening_m2: sine * l_ed_m * l_cd_m,
            ..made
        };
        assert!(sine(1.01e-5).is_sound(&shape) && !sine(0.99e-5).is_sound(&shape));
    }
}
