//! This file says that what a program in C can get wrong ends in an error code and without current.
#![expect(unsafe_code, reason = "it calls what C calls")]

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use rigproof_impl_c::{
    RIGPROOF_MOST_CORNERS, RigproofTick, RigproofTickCommand, RigproofTickLaw, RigproofTickReason,
    RigproofTickSensed, RigproofTickSettings, RigproofTickStatus as Status, rigproof_tick_create,
    rigproof_tick_step, rigproof_tick_thesis,
};

static SENSED: RigproofTickSensed = RigproofTickSensed {
    number: 17,
    counts: [33_421, 14_327],
    tip_force_n: [1.3, -2.7],
};

fn settings() -> RigproofTickSettings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: the pointer is to memory of this size; the thesis's settings are written to it.
    unsafe {
        assert_eq!(rigproof_tick_thesis(settings.as_mut_ptr(), 4), Status::Ok);
        settings.assume_init()
    }
}

fn sdof() -> RigproofTickSettings {
    let mut settings = settings();
    settings.law = RigproofTickLaw::Sdof as u32;
    settings.corners = 2;
    settings.corners_m[0] = [-0.113, 0.383];
    settings.corners_m[1] = [0.107, 0.412];
    settings
}

/// Memory of a controller that was never one.
fn zeroed() -> Box<RigproofTick> {
    // SAFETY: a controller's memory is numbers only; zero is one.
    unsafe { Box::new(MaybeUninit::zeroed().assume_init()) }
}

fn create(settings: &RigproofTickSettings) -> Status {
    // SAFETY: both point to what they say.
    unsafe { rigproof_tick_create(&mut *zeroed(), settings) }
}

#[test]
fn a_null_pointer_is_refused_everywhere() {
    let (mut tick, sdof) = (zeroed(), sdof());
    let mut command = MaybeUninit::uninit();
    // SAFETY: each pointer is null or points to what it says.
    unsafe {
        assert_eq!(rigproof_tick_thesis(null_mut(), 4), Status::BadPointer);
        assert_eq!(rigproof_tick_create(null_mut(), &sdof), Status::BadPointer);
        assert_eq!(rigproof_tick_create(&mut *tick, null()), Status::BadPointer);
        assert_eq!(rigproof_tick_create(&mut *tick, &sdof), Status::Ok);
        assert_eq!(
            rigproof_tick_step(&mut *tick, &SENSED, null_mut()),
            Status::BadPointer
        );
        for (tick, sensed) in [(null_mut(), &raw const SENSED), (&raw mut *tick, null())] {
            let status = rigproof_tick_step(tick, sensed, command.as_mut_ptr());
            assert_eq!(status, Status::BadPointer);
            let command: RigproofTickCommand = command.assume_init();
            assert_eq!(command.currents_a, [0.0; 4]);
        }
    }
}

#[test]
fn a_controller_that_was_not_created_gives_no_current() {
    let mut tick = zeroed();
    let mut command = MaybeUninit::<RigproofTickCommand>::uninit();
    let mut bad = sdof();
    bad.sample_s = f64::NAN;
    // SAFETY: each pointer points to what it says.
    unsafe {
        let step = rigproof_tick_step(&mut *tick, &SENSED, command.as_mut_ptr());
        assert_eq!(step, Status::NotCreated);
        assert_eq!(command.assume_init().currents_a, [0.0; 4]);
        // One that was made anew from bad settings is none any more.
        assert_eq!(rigproof_tick_create(&mut *tick, &sdof()), Status::Ok);
        assert_eq!(rigproof_tick_create(&mut *tick, &bad), Status::BadSettings);
        let step = rigproof_tick_step(&mut *tick, &SENSED, command.as_mut_ptr());
        assert_eq!(step, Status::NotCreated);
    }
}

#[test]
fn another_version_or_size_is_refused() {
    for change in [
        |settings: &mut RigproofTickSettings| settings.version += 1,
        |settings: &mut RigproofTickSettings| settings.size -= 8,
        |settings: &mut RigproofTickSettings| settings.size = u32::MAX,
    ] {
        let mut settings = sdof();
        change(&mut settings);
        assert_eq!(create(&settings), Status::BadVersion);
    }
}

#[test]
fn settings_of_no_rig_are_refused() {
    assert_eq!(create(&sdof()), Status::Ok);
    assert_eq!(create(&settings()), Status::Ok);
    let changes: [fn(&mut RigproofTickSettings); 16] = [
        |settings| settings.brakes = 5,
        |settings| settings.law = 3,
        |settings| settings.arms_m[3] = -0.305,
        |settings| settings.arms_m[4] = f64::INFINITY,
        |settings| settings.counts_per_turn[1] = 0,
        |settings| settings.sample_s = 0.0,
        |settings| settings.greatest_rate_rad_s = f64::NAN,
        |settings| settings.greatest_force_n = -17.0,
        |settings| settings.greatest_desired_force_n = f64::INFINITY,
        |settings| settings.boundary_m = 0.0,
        |settings| settings.gap_m = 0.31,
        |settings| settings.corners = 1,
        |settings| settings.corners = RIGPROOF_MOST_CORNERS as u32 + 1,
        |settings| settings.closed = 2,
        |settings| settings.corners_m[1] = settings.corners_m[0],
        |settings| settings.corners_m[1][1] = f64::NAN,
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut settings = sdof();
        change(&mut settings);
        assert_eq!(create(&settings), Status::BadSettings, "change {number}");
    }
}

#[test]
fn a_started_controller_says_so() {
    let mut tick = zeroed();
    let mut command = MaybeUninit::<RigproofTickCommand>::uninit();
    // SAFETY: each pointer points to what it says.
    let command = unsafe {
        assert_eq!(rigproof_tick_create(&mut *tick, &sdof()), Status::Ok);
        let step = rigproof_tick_step(&mut *tick, &SENSED, command.as_mut_ptr());
        assert_eq!(step, Status::Ok);
        command.assume_init()
    };
    assert_eq!(command.reason, RigproofTickReason::Starting as u32);
    assert_eq!((command.currents_a, command.chosen), ([0.0; 4], [-1, -1]));
}
