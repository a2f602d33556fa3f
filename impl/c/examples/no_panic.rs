//! This program links only if the compiler has proved that neither a tick nor the monitor can panic: `make no-panic` in `impl/c`.
//!
//! A function marked `no_panic` refers, from where a panic would leave it, to a symbol that is nowhere. An optimised build of one piece
//! deletes that reference where nothing can panic.

use std::hint::black_box;

use no_panic::no_panic;
use rigproof_impl::actuation::Actuation;
use rigproof_impl::command::Command;
use rigproof_impl::law::{
    Impedance, Law, Obstacle, Optimal, Proportional, Sdof, Side, Uncontrolled, VelocityRatio,
    Virtual, Weights,
};
use rigproof_impl::monitor::{Monitor, Watched};
use rigproof_impl::number::Real;
use rigproof_impl::path::{Arc, Line, Path, Polyline, Spline};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::tip_mass::Bodies;
use rigproof_impl::vector::Vector;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::BLEND_BOUNDARY_M;

#[path = "../tests/monitor/rigproof_monitor.rs"]
mod numbers;

const LAYOUT: Layout = Layout::FourBrake;
const CORNERS_M: [[f64; 2]; 4] = [
    [-0.113, 0.383],
    [0.017, 0.391],
    [0.107, 0.412],
    [0.131, 0.447],
];

#[no_panic]
fn tick<R: Real, L: Law<R>>(tick: &mut Tick<R, L>, sensed: &Sensed<R>) -> Command<R> {
    tick.tick(sensed)
}

#[no_panic]
fn watch(monitor: &mut Monitor, sensed: &Sensed<f64>, commanded_a: [f64; 4]) -> Watched {
    monitor.watch(sensed, commanded_a)
}

fn monitors() {
    for (layout, of) in [
        (Layout::ThreeBrake, numbers::THREE_BRAKE),
        (Layout::FourBrake, numbers::FOUR_BRAKE),
    ] {
        let Some(mut monitor) = Monitor::new(&Settings::thesis(layout), &of) else {
            println!("the monitor's numbers are refused");
            return;
        };
        for number in 0..200 {
            let sensed = Sensed {
                number,
                counts: [33_421, 14_327],
                tip_force_n: Vector::new(1.3, -2.7),
            };
            black_box(watch(&mut monitor, black_box(&sensed), [0.0; 4]));
        }
    }
    println!("monitor: no sample can panic");
}

fn run<R: Real, L: Law<R>>(name: &str, law: Option<L>) {
    let law = law.and_then(|law| Tick::new(&Settings::thesis(LAYOUT), law));
    let Some(mut subject) = law else {
        println!("{name}: the settings are refused");
        return;
    };
    for number in 0..20 {
        let sensed = Sensed {
            number,
            counts: [33_421, 14_327],
            tip_force_n: Vector::new(R::of(1.3), R::of(-2.7)),
        };
        black_box(tick(&mut subject, black_box(&sensed)));
    }
    println!("{name}: no tick can panic");
}

fn on<R: Real, P: Path<R> + Copy>(path: Option<P>) {
    let Some(path) = path else {
        println!("the path is refused");
        return;
    };
    let actuation = Actuation::<R>::thesis(LAYOUT);
    let proportional = Proportional::new(actuation, path, BLEND_BOUNDARY_M, 497.0);
    let sdof = Sdof::new(actuation, path, BLEND_BOUNDARY_M, 0.0043);
    let elements = Virtual {
        stiffness_n_per_m: 731.0,
        damping_across_n_s_per_m: 23.0,
        damping_along_n_s_per_m: 3.7,
    };
    let weights = Weights {
        angle: 1.7,
        energy: 0.3,
        horizon_s: 0.011,
    };
    let bodies = Bodies::new(&arms(LAYOUT), &inertia(LAYOUT));
    run("proportional", proportional);
    run("SDOF", sdof);
    run(
        "obstacle",
        sdof.map(|sdof| Obstacle::new(path, Side::Left, sdof)),
    );
    run(
        "velocity ratio",
        VelocityRatio::new(actuation, path, BLEND_BOUNDARY_M, 3.7),
    );
    run("impedance", Impedance::new(actuation, path, elements));
    run(
        "optimal",
        Optimal::new(actuation, path, BLEND_BOUNDARY_M, weights, bodies),
    );
}

fn all<R: Real>() {
    let [from_m, .., to_m] = CORNERS_M;
    on::<R, _>(Line::through(from_m, to_m));
    on::<R, _>(Arc::new([0.0, 0.31], 0.093, 0.37, 2.9));
    on::<R, _>(Polyline::<R, 16>::closed(&CORNERS_M));
    on::<R, _>(Spline::<R, 16>::through(&CORNERS_M));
    run::<R, _>("uncontrolled", Some(Uncontrolled));
}

fn main() {
    println!("f64");
    all::<f64>();
    monitors();
    println!("f32");
    all::<f32>();
}
