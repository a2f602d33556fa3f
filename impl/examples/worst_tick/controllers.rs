//! This file holds every law on every path, on both layouts.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{
    AnyLaw, Impedance, Obstacle, Optimal, PathLaw, Proportional, Sdof, Side, Uncontrolled,
    VelocityRatio, Virtual, Weights,
};
use rigproof_impl::path::{AnyPath, Arc, Line, Polyline, Spline};
use rigproof_impl::tick::{Settings, Tick};
use rigproof_impl::tip_mass::Bodies;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

/// Pieces that a path has.
const PIECES: usize = 16;

type AnyWay = AnyPath<f64, PIECES>;
/// A controller of any law on any path.
pub type AnyTick = Tick<f64, AnyLaw<f64, AnyWay>>;

/// Every controller and its name.
pub fn controllers() -> Vec<(String, AnyTick)> {
    let mut all = Vec::new();
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for (way, path) in paths() {
            for (law, any) in laws(layout, path) {
                let tick = Tick::new(&Settings::thesis(layout), any).unwrap();
                all.push((format!("{law} | {way}"), tick));
            }
        }
    }
    all
}

fn laws(layout: Layout, path: AnyWay) -> Vec<(&'static str, AnyLaw<f64, AnyWay>)> {
    let with = Actuation::thesis(layout);
    let boundary_m = BLEND_BOUNDARY_M;
    let sdof = PathLaw::Sdof(Sdof::new(with, path, boundary_m, 0.0049).unwrap());
    let bodies = Bodies::new(&arms(layout), &inertia(layout));
    let weights = Weights {
        angle: 1.3,
        energy: 0.7,
        horizon_s: 0.011,
    };
    let elements = Virtual {
        stiffness_n_per_m: 471.0,
        damping_across_n_s_per_m: 23.0,
        damping_along_n_s_per_m: 11.0,
    };
    let proportional = Proportional::new(with, path, boundary_m, 497.0).unwrap();
    let ratio = VelocityRatio::new(with, path, boundary_m, 3.7).unwrap();
    let optimal = Optimal::new(with, path, boundary_m, weights, bodies).unwrap();
    let impedance = Impedance::new(with, path, elements).unwrap();
    vec![
        (
            "uncontrolled",
            AnyLaw::Path(PathLaw::Uncontrolled(Uncontrolled)),
        ),
        ("SDOF with gap", AnyLaw::Path(sdof)),
        (
            "proportional",
            AnyLaw::Path(PathLaw::Proportional(proportional)),
        ),
        (
            "velocity ratio",
            AnyLaw::Path(PathLaw::VelocityRatio(ratio)),
        ),
        ("optimal", AnyLaw::Path(PathLaw::Optimal(optimal))),
        ("impedance", AnyLaw::Path(PathLaw::Impedance(impedance))),
        (
            "obstacle, SDOF inside",
            AnyLaw::Obstacle(Obstacle::new(path, Side::Left, sdof)),
        ),
    ]
}

/// Every kind of path; the last is made to be hard: its pieces turn round each other, so that few can be left out.
fn paths() -> Vec<(&'static str, AnyWay)> {
    let corners = |radius_m: f64, turns: f64| -> Vec<[f64; 2]> {
        (0..=PIECES)
            .map(|k| {
                let share = k as f64 / PIECES as f64;
                let angle = 0.3 + turns * core::f64::consts::TAU * share;
                let reach_m = radius_m * (1.0 - 0.37 * share);
                [
                    0.017 + reach_m * libm::cos(angle),
                    0.391 + reach_m * libm::sin(angle),
                ]
            })
            .collect()
    };
    vec![
        (
            "line",
            AnyPath::Line(Line::through([-0.11, 0.37], [0.12, 0.41]).unwrap()),
        ),
        (
            "arc",
            AnyPath::Arc(Arc::new([0.017, 0.391], 0.071, 0.3, 4.9).unwrap()),
        ),
        (
            "polyline of 16",
            AnyPath::Polyline(Polyline::open(&corners(0.083, 0.8)).unwrap()),
        ),
        (
            "spline of 16",
            AnyPath::Spline(Spline::through(&corners(0.083, 0.8)).unwrap()),
        ),
        (
            "tangled spline of 16",
            AnyPath::Spline(Spline::through(&corners(0.047, 7.3)).unwrap()),
        ),
    ]
}
