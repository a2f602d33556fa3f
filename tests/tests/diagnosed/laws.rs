//! This file makes the implementation's controllers of the golden cases.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{
    AnyLaw, Impedance, Obstacle, Optimal, PathLaw, Proportional, Sdof, Side, Uncontrolled,
    VelocityRatio, Virtual, Weights,
};
use rigproof_impl::path::Line;
use rigproof_impl::tip_mass::Bodies;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;

use crate::diagnosed::script::Script;

/// The controller of a run of a path case.
pub fn law(script: &Script, run: usize) -> AnyLaw<f64, Line<f64>> {
    let layout = script.layout();
    let (number, word) = (
        |name: &str| script.number(run, name),
        |name: &str| script.word(run, name),
    );
    let along = |[x, y, to_x, to_y]: [&str; 4]| {
        Line::through([number(x), number(y)], [number(to_x), number(to_y)]).unwrap()
    };
    let line = along([
        "line from x, where the tip starts at rest",
        "line from y",
        "line to x",
        "line to y",
    ]);
    let actuation = Actuation::thesis(layout);
    let boundary_m = || number("boundary of the velocity field");
    let sdof =
        |line, gap_m| PathLaw::Sdof(Sdof::new(actuation, line, boundary_m(), gap_m).unwrap());
    AnyLaw::Path(match word("controller") {
        "Uncontrolled" => PathLaw::Uncontrolled(Uncontrolled),
        "Sdof" => sdof(line, number("gap")),
        "Proportional" => PathLaw::Proportional(
            Proportional::new(actuation, line, boundary_m(), number("gain")).unwrap(),
        ),
        "VelocityRatio" => PathLaw::VelocityRatio(
            VelocityRatio::new(actuation, line, boundary_m(), number("gain")).unwrap(),
        ),
        "Optimal" => {
            let weights = Weights {
                angle: number("cost of the angle"),
                energy: number("cost of the energy"),
                horizon_s: number("horizon"),
            };
            let bodies = Bodies::new(&arms(layout), &inertia(layout));
            PathLaw::Optimal(Optimal::new(actuation, line, boundary_m(), weights, bodies).unwrap())
        }
        "Impedance" => {
            let elements = Virtual {
                stiffness_n_per_m: number("stiffness across"),
                damping_across_n_s_per_m: number("damping across"),
                damping_along_n_s_per_m: number("damping along"),
            };
            PathLaw::Impedance(Impedance::new(actuation, line, elements).unwrap())
        }
        "Obstacle" => {
            let wall = along(["wall from x", "wall from y", "wall to x", "wall to y"]);
            assert_eq!(word("controller inside"), "Sdof");
            assert_eq!(word("solid side of the wall"), "left");
            return AnyLaw::Obstacle(Obstacle::new(wall, Side::Left, sdof(wall, 0.0)));
        }
        other => panic!("{other}"),
    })
}
