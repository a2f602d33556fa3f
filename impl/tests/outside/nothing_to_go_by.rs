//! This file says that every law leaves the brakes alone where it has nothing to go by: a path that lies nowhere, costs of nothing, no mass.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::command::Command;
use rigproof_impl::law::{
    Impedance, Law, Obstacle, Optimal, Proportional, Sdof, Side, Situation, VelocityRatio, Virtual,
    Weights,
};
use rigproof_impl::linkage::{Shape, linkage};
use rigproof_impl::path::{Line, Nearest, Path};
use rigproof_impl::tip_mass::{Bodies, TipMass};
use rigproof_impl::vector::Vector;
use rigproof_spec::command::Reason;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::{ArmInertia, Inertia, inertia};
use rigproof_spec::layout::Layout;

const LAYOUT: Layout = Layout::FourBrake;
const BOUNDARY_M: f64 = 0.023;
const WEIGHTS: Weights<f64> = Weights {
    angle: 1.3,
    energy: 0.7,
    horizon_s: 0.011,
};

/// A path that answers so wherever it is asked.
#[derive(Clone, Copy)]
struct Told(Nearest<f64>);

impl Path<f64> for Told {
    fn nearest(&self, _: Vector<f64>) -> Nearest<f64> {
        self.0
    }
}

fn told([x, y]: [f64; 2], offset_m: f64) -> Told {
    Told(Nearest {
        tangent: Vector::new(x, y),
        offset_m,
    })
}

/// The tip in the middle of the workspace, moving and pushed.
fn now() -> Situation<f64> {
    let unit = |angle_rad| Vector::new(libm::cos(angle_rad), libm::sin(angle_rad));
    let linkage = linkage(&Shape::new(&arms(LAYOUT)), unit(2.17), unit(0.83));
    Situation {
        linkage,
        rows: linkage.rows(),
        tip_velocity_m_s: Vector::new(0.11, -0.07),
        tip_force_n: Vector::new(1.9, 2.3),
    }
}

fn optimal<P: Path<f64>>(path: P, weights: Weights<f64>, inertia: &Inertia) -> Optimal<f64, P> {
    let bodies = Bodies::new(&arms(LAYOUT), inertia);
    Optimal::new(Actuation::thesis(LAYOUT), path, BOUNDARY_M, weights, bodies).unwrap()
}

/// What each law on a path asks for.
fn asked(path: Told) -> [Command<f64>; 6] {
    let actuation = Actuation::thesis(LAYOUT);
    let elements = Virtual {
        stiffness_n_per_m: 310.0,
        damping_across_n_s_per_m: 17.0,
        damping_along_n_s_per_m: 3.1,
    };
    let impedance = Impedance::new(actuation, path, elements).unwrap();
    let now = now();
    [
        Sdof::new(actuation, path, BOUNDARY_M, 0.001)
            .unwrap()
            .command(&now),
        Proportional::new(actuation, path, BOUNDARY_M, 530.0)
            .unwrap()
            .command(&now),
        VelocityRatio::new(actuation, path, BOUNDARY_M, 1.7)
            .unwrap()
            .command(&now),
        optimal(path, WEIGHTS, &inertia(LAYOUT)).command(&now),
        { impedance }.command(&now),
        Obstacle::new(path, Side::Left, impedance).command(&now),
    ]
}

#[test]
fn a_path_that_lies_nowhere_lets_every_brake_go() {
    let known = told([0.8, 0.6], 0.013);
    for command in asked(known) {
        assert!(command.reason != Reason::UndefinedInput, "{command:?}");
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for path in [
            told([bad, 0.6], 0.013),
            told([0.8, bad], 0.013),
            told([0.8, 0.6], bad),
            told([bad, bad], bad),
        ] {
            assert_eq!(asked(path), [Command::none(Reason::UndefinedInput); 6]);
        }
    }
}

#[test]
fn a_law_to_which_nothing_costs_anything_brakes_nothing() {
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let free = Weights {
        angle: 0.0,
        energy: 0.0,
        ..WEIGHTS
    };
    let command = optimal(line, free, &inertia(LAYOUT)).command(&now());
    assert_eq!(command, Command::none(Reason::NoneHelps));
}

#[test]
fn a_rig_without_mass_is_let_go() {
    let none = ArmInertia {
        mass_kg: 0.0,
        inertia_kg_m2: 0.0,
        centre_m: 0.0,
    };
    let massless = Inertia {
        ae: none,
        ed: none,
        bc: none,
        cd: none,
        payload_kg: 0.0,
    };
    let line = Line::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let command = optimal(line, WEIGHTS, &massless).command(&now());
    assert_eq!(command, Command::none(Reason::SingularPose));
    let (xx, yy) = (1.69, 0.49);
    for (xy, definite) in [
        (0.9099, true),
        (0.91, false),
        (-0.9101, false),
        (f64::NAN, false),
    ] {
        assert_eq!(TipMass { xx, xy, yy }.is_definite(), definite, "{xy}");
    }
}
