//! This file says that what a program in C can get wrong ends in an error code and without current.
#![expect(unsafe_code, reason = "it calls what C calls")]

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use rigproof_impl_c::{
    RIGPROOF_MOST_CORNERS, RIGPROOF_TICK_VERSION, RigproofTick, RigproofTickCommand,
    RigproofTickLaw, RigproofTickReason, RigproofTickSensed, RigproofTickSettings,
    RigproofTickStatus as Status, rigproof_tick_create, rigproof_tick_step, rigproof_tick_thesis,
};

static SENSED: RigproofTickSensed = RigproofTickSensed {
    size: size_of::<RigproofTickSensed>() as u32,
    version: RIGPROOF_TICK_VERSION,
    number: 17,
    counts: [33_421, 14_327],
    tip_force_n: [1.3, -2.7],
};

/// Memory of a struct of C whose numbers are all zero but for its size and version.
fn zeroed<T>() -> Box<T> {
    let size = size_of::<T>() as u32;
    // SAFETY: a struct of C is numbers only, of which the first two are its size and version; zero is one.
    unsafe {
        let mut memory = Box::new(MaybeUninit::<T>::zeroed());
        memory
            .as_mut_ptr()
            .cast::<[u32; 2]>()
            .write([size, RIGPROOF_TICK_VERSION]);
        memory.assume_init()
    }
}

fn settings() -> RigproofTickSettings {
    let mut settings = zeroed();
    // SAFETY: the pointer is to settings.
    unsafe { assert_eq!(rigproof_tick_thesis(&mut *settings, 4), Status::Ok) };
    *settings
}

fn sdof() -> RigproofTickSettings {
    let mut settings = settings();
    settings.law = RigproofTickLaw::Sdof as u32;
    settings.corners = 2;
    settings.corners_m[0] = [-0.113, 0.383];
    settings.corners_m[1] = [0.107, 0.412];
    settings
}

fn create(settings: &RigproofTickSettings) -> Status {
    // SAFETY: both point to what they say.
    unsafe { rigproof_tick_create(&mut *zeroed::<RigproofTick>(), settings) }
}

#[test]
fn a_null_pointer_is_refused_everywhere() {
    let (mut tick, sdof) = (zeroed(), sdof());
    let mut command = zeroed::<RigproofTickCommand>();
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
            command.currents_a = [0.7; 4];
            let status = rigproof_tick_step(tick, sensed, &mut *command);
            assert_eq!(status, Status::BadPointer);
            assert_eq!(command.currents_a, [0.0; 4]);
        }
    }
}

#[test]
fn a_controller_that_was_not_created_gives_no_current() {
    let mut tick = zeroed();
    let mut command = zeroed::<RigproofTickCommand>();
    let mut bad = sdof();
    bad.sample_s = f64::NAN;
    // SAFETY: each pointer points to what it says.
    unsafe {
        let step = rigproof_tick_step(&mut *tick, &SENSED, &mut *command);
        assert_eq!(step, Status::NotCreated);
        assert_eq!(command.currents_a, [0.0; 4]);
        // One that was made anew from bad settings is none any more.
        assert_eq!(rigproof_tick_create(&mut *tick, &sdof()), Status::Ok);
        assert_eq!(rigproof_tick_create(&mut *tick, &bad), Status::BadSettings);
        let step = rigproof_tick_step(&mut *tick, &SENSED, &mut *command);
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

/// Another size or version at the beginning of a struct.
fn changed<T>(mut memory: Box<T>, change: [u32; 2]) -> Box<T> {
    let head = (&raw mut *memory).cast::<[u32; 2]>();
    // SAFETY: every struct of C begins with its size and version.
    unsafe {
        let [size, version] = head.read();
        head.write([
            size.wrapping_add(change[0]),
            version.wrapping_add(change[1]),
        ]);
    }
    memory
}

#[test]
fn a_struct_of_another_version_or_size_is_not_written_but_for_the_currents_of_a_command() {
    for change in [[0, 1], [u32::MAX - 7, 0], [8, 0]] {
        let mut settings = changed(zeroed::<RigproofTickSettings>(), change);
        let mut tick = changed(zeroed::<RigproofTick>(), change);
        let mut command = changed(zeroed::<RigproofTickCommand>(), change);
        (command.currents_a, command.reason) = ([0.7, 0.31, 0.0, 0.9], 4);
        let before = (*settings, *command);
        // SAFETY: each pointer points to at least what it says.
        unsafe {
            let refused = [
                rigproof_tick_thesis(&mut *settings, 4),
                rigproof_tick_create(&mut *tick, &sdof()),
                rigproof_tick_step(&mut *tick, &SENSED, &mut *command),
            ];
            assert_eq!(refused, [Status::BadVersion; 3]);
            assert_eq!(*settings, before.0);
            let expected = if change == [0, 1] {
                RigproofTickCommand {
                    currents_a: [0.0; 4],
                    reason: 0,
                    chosen: [0, 0],
                    ..before.1
                }
            } else {
                before.1
            };
            assert_eq!(*command, expected);
            // A sample of another version is not read: no current.
            let sensed = changed(Box::new(SENSED), change);
            let (mut tick, mut command) = (zeroed(), zeroed::<RigproofTickCommand>());
            command.currents_a = [0.7; 4];
            assert_eq!(rigproof_tick_create(&mut *tick, &sdof()), Status::Ok);
            let status = rigproof_tick_step(&mut *tick, &*sensed, &mut *command);
            assert_eq!((status, command.currents_a), (Status::BadVersion, [0.0; 4]));
        }
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
    let mut command = zeroed::<RigproofTickCommand>();
    // SAFETY: each pointer points to what it says.
    unsafe {
        assert_eq!(rigproof_tick_create(&mut *tick, &sdof()), Status::Ok);
        let step = rigproof_tick_step(&mut *tick, &SENSED, &mut *command);
        assert_eq!(step, Status::Ok);
    }
    assert_eq!(command.reason, RigproofTickReason::Starting as u32);
    assert_eq!((command.currents_a, command.chosen), ([0.0; 4], [-1, -1]));
}
