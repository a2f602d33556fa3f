//! This controller is one in Rust behind `rigproof_controller.h`: rigproof's own tick, proportional control along any path.
//!
//! `cargo build --release -p rigproof-certify-host --example proportional` makes the shared library `libproportional.so`.
#![expect(
    unsafe_code,
    reason = "it exports functions that C's callers know, and is handed pointers"
)]

use std::sync::{Mutex, PoisonError};

use rigproof_certify_host::{
    RIGPROOF_CONTROLLER_VERSION, RigproofControllerCommanded, RigproofControllerSensed,
    RigproofControllerSettings, RigproofControllerTask as TaskKind,
};
use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::Proportional;
use rigproof_impl::path::{AnyPath, Arc, Line, Polyline, Spline};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_spec::geometry::Arms;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, greatest_desired_force_n};

/// Gain of proportional control, N·s/m.
const GAIN_N_S_PER_M: f64 = 500.0;

type Path = AnyPath<f64, 64>;
type Controller = Tick<f64, Proportional<f64, Path>>;

static CONTROLLER: Mutex<Option<Controller>> = Mutex::new(None);

/// The version of the header.
#[unsafe(no_mangle)]
pub extern "C" fn rigproof_controller_version() -> u32 {
    RIGPROOF_CONTROLLER_VERSION
}

/// Begins afresh.
///
/// # Safety
/// `settings` must be null or point to settings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_controller_init(
    settings: *const RigproofControllerSettings,
) -> i32 {
    // SAFETY: null or settings, says the caller.
    let begun = unsafe { settings.as_ref() }.and_then(controller);
    let mut held = CONTROLLER.lock().unwrap_or_else(PoisonError::into_inner);
    *held = begun;
    i32::from(held.is_none())
}

/// One tick.
///
/// # Safety
/// The pointers must be null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_controller_tick(
    sensed: *const RigproofControllerSensed,
    commanded: *mut RigproofControllerCommanded,
) -> i32 {
    let mut held = CONTROLLER.lock().unwrap_or_else(PoisonError::into_inner);
    // SAFETY: null or what they say, says the caller.
    let (sensed, commanded) = unsafe { (sensed.as_ref(), commanded.as_mut()) };
    let (Some(controller), Some(sensed), Some(commanded)) = (held.as_mut(), sensed, commanded)
    else {
        return 1;
    };
    let answer = controller.tick(&Sensed {
        number: sensed.number,
        counts: sensed.counts,
        tip_force_n: sensed.tip_force_n.into(),
    });
    commanded.currents_a = answer.currents_a;
    0
}

/// The trial is over.
#[unsafe(no_mangle)]
pub extern "C" fn rigproof_controller_shutdown() {
    *CONTROLLER.lock().unwrap_or_else(PoisonError::into_inner) = None;
}

/// The controller of these settings, if they are those of one.
fn controller(told: &RigproofControllerSettings) -> Option<Controller> {
    let [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m] = told.arms_m;
    let layout = match told.brakes {
        3 => Layout::ThreeBrake,
        4 => Layout::FourBrake,
        _ => return None,
    };
    let settings = Settings {
        arms: Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        },
        layout,
        counts_per_turn: told.counts_per_turn,
        zero_counts: told.zero_counts,
        sample_s: told.sample_s,
        greatest_rate_rad_s: told.greatest_rate_rad_s,
        greatest_force_n: told.greatest_force_n,
    };
    let greatest_n = greatest_desired_force_n(layout);
    let actuation = Actuation::new(layout, &settings.arms, greatest_n)?;
    let law = Proportional::new(actuation, path(told)?, BLEND_BOUNDARY_M, GAIN_N_S_PER_M)?;
    Tick::new(&settings, law)
}

fn path(told: &RigproofControllerSettings) -> Option<Path> {
    let points_m = told.points_m.get(..told.points as usize)?;
    if told.task == TaskKind::Arc as u32 {
        let sweep_rad = told.to_rad - told.from_rad;
        return Arc::new(told.centre_m, told.radius_m, told.from_rad, sweep_rad).map(AnyPath::Arc);
    }
    match points_m {
        _ if told.task == TaskKind::Spline as u32 => Spline::through(points_m).map(AnyPath::Spline),
        [from_m, to_m] => Line::through(*from_m, *to_m).map(AnyPath::Line),
        _ => Polyline::open(points_m).map(AnyPath::Polyline),
    }
}
