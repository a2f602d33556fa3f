//! This file says which finding each fault of a controller is.

use rigproof_certify::controller::Failure;
use rigproof_certify::foreign::Limits;

use crate::bench::{
    SOUND_A, begin, faulty, foreign, is_there, limits, named, running, trial, wait_for,
};

/// Faults in the third tick of a trial, and the next trial.
fn in_tick(name: &str, code: &str) -> Option<Failure> {
    in_tick_limited(name, code, limits())
}

fn in_tick_limited(name: &str, code: &str, limits: Limits) -> Option<Failure> {
    let library = faulty(name, &[("IN_TICK", code)])?;
    let source = foreign(&library, limits);
    let name = named(&library);
    // Two ticks are fine, and two processes are there: the one that works and its watch.
    assert_eq!(trial(&source, 2), Ok(SOUND_A));
    let processes = wait_for(&name, 2);
    let failure = trial(&source, 3).unwrap_err();
    assert_eq!(running(&name), [0_u32; 0]);
    assert!(processes.iter().all(|process| !is_there(*process)));
    assert_eq!(trial(&source, 2), Ok(SOUND_A), "after {failure}");
    wait_for(&name, 2);
    drop(source);
    assert_eq!(running(&name), [0_u32; 0]);
    Some(failure)
}

/// Faults before the first tick, twice: the second begin finds the same.
fn before_ticks(name: &str, faults: &[(&str, &str)]) -> Option<Failure> {
    let library = faulty(name, faults)?;
    let limits = Limits {
        start_ms: 1000,
        ..limits()
    };
    let source = foreign(&library, limits);
    let failure = begin(&source).err().unwrap();
    assert_eq!(begin(&source).err().as_ref(), Some(&failure));
    assert_eq!(running(&named(&library)), [0_u32; 0]);
    Some(failure)
}

/// What is said of a process that ended.
#[track_caller]
fn ended(failure: Option<Failure>, parts: &[&str]) {
    let Some(failure) = failure else { return };
    let Failure::Ended(text) = &failure else {
        panic!("{failure:?}");
    };
    for part in parts {
        assert!(text.contains(part), "{text}");
    }
}

#[track_caller]
fn unusable(failure: Option<Failure>, parts: &[&str]) {
    let Some(failure) = failure else { return };
    let Failure::Unusable(text) = &failure else {
        panic!("{failure:?}");
    };
    for part in parts {
        assert!(text.contains(part), "{text}");
    }
}

#[track_caller]
fn hung(failure: Option<Failure>, limit_ms: u64) {
    assert!(failure.is_none_or(|failure| failure == Failure::Hung { limit_ms }));
}

#[test]
fn a_null_pointer_in_tick_is_an_end() {
    let failure = in_tick(
        "null_in_tick",
        "fprintf(stderr, \"gain table missing\\n\"); *(volatile int *)0 = 1",
    );
    ended(
        failure,
        &[
            "in tick 3 of the trial",
            "SIGSEGV",
            "null pointer",
            "printed: gain table missing",
        ],
    );
}

#[test]
fn a_null_pointer_in_init_is_an_end() {
    let failure = before_ticks("null_in_init", &[("IN_INIT", "*(volatile int *)0 = 1")]);
    ended(failure, &["in init", "SIGSEGV"]);
}

#[test]
fn a_tick_for_ever_is_hung() {
    hung(in_tick("hung_in_tick", "for (;;) { }"), 700);
}

#[test]
fn a_tick_that_stops_itself_is_hung() {
    hung(in_tick("stopped", "raise(SIGSTOP)"), 700);
}

#[test]
fn an_init_for_ever_is_hung() {
    hung(
        before_ticks("hung_in_init", &[("IN_INIT", "for (;;) { sleep(1); }")]),
        1000,
    );
}

#[test]
fn a_constructor_for_ever_is_hung() {
    hung(
        before_ticks("hung_at_opening", &[("AT_OPENING", "for (;;) { }")]),
        1000,
    );
}

#[test]
fn allocating_without_bound_ends_at_the_limit() {
    let code = "for (;;) { char *more = malloc(1 << 20); memset(more, 7, 1 << 20); }";
    let limits = Limits {
        memory_bytes: 192 << 20,
        tick_ms: Some(20_000),
        ..limits()
    };
    let failure = in_tick_limited("allocating", code, limits);
    ended(failure, &["SIGSEGV", "beyond the limit of 192 MB"]);
}

#[test]
fn a_controller_that_allocates_and_asks_again_is_hung() {
    let code = "for (;;) { char *more = malloc(1 << 20); if (more) memset(more, 7, 1 << 20); }";
    hung(in_tick("asking_again", code), 700);
}

#[test]
fn closing_every_descriptor_is_an_end() {
    let failure = in_tick("closing", "for (int d = 0; d < 4096; d++) close(d)");
    ended(failure, &["in tick 3", "closed the connection"]);
}

#[test]
fn closing_every_descriptor_and_going_on_is_an_end() {
    let code = "for (int d = 0; d < 4096; d++) close(d); for (;;) { sleep(1); }";
    ended(
        in_tick("closing_for_ever", code),
        &["closed the connection"],
    );
}

#[test]
fn exit_in_a_tick_is_an_end() {
    let failure = in_tick("exiting", "puts(\"all done\"); exit(0)");
    ended(
        failure,
        &["it called exit with code 0", "printed: all done"],
    );
}

#[test]
fn abort_is_an_end() {
    ended(in_tick("aborting", "abort()"), &["SIGABRT", "abort"]);
}

#[test]
fn a_division_by_zero_is_an_end() {
    let failure = in_tick("dividing", "volatile int zero = 0; ticks = 7 / zero");
    ended(failure, &["SIGFPE", "divided an integer by zero"]);
}

#[test]
fn a_file_without_end_is_an_end() {
    let code = "int f = open(\"big\", O_CREAT | O_WRONLY, 0600); static char much[1 << 20]; while (write(f, much, sizeof much) > 0) { }";
    let limits = Limits {
        memory_bytes: 192 << 20,
        tick_ms: Some(20_000),
        ..limits()
    };
    let failure = in_tick_limited("writing_much", code, limits);
    ended(failure, &["SIGXFSZ", "larger than the limit of 192 MB"]);
}

#[test]
fn garbage_in_the_connection_is_garbage() {
    let code = "for (int d = 3; d < 64; d++) if (write(d, \"0123456789abcdef\", 16)) { }";
    let Some(failure) = in_tick("garbage", code) else {
        return;
    };
    let Failure::Garbage(text) = &failure else {
        panic!("{failure:?}");
    };
    assert!(
        text.contains("30 31 32 33") && text.contains("tick 3"),
        "{text}"
    );
}

#[test]
fn prints_are_no_fault_however_many() {
    let code = "for (int i = 0; i < 100000; i++) { printf(\"RPcu garbage %d \\xff\\n\", i); fprintf(stderr, \"%040d\\n\", i); }";
    let Some(library) = faulty("printing", &[("IN_TICK", code)]) else {
        return;
    };
    let limits = Limits {
        tick_ms: Some(20_000),
        ..limits()
    };
    let source = foreign(&library, limits);
    for _ in 0..2 {
        assert_eq!(trial(&source, 5), Ok(SOUND_A));
    }
}

#[test]
fn a_write_just_after_the_commanded_is_found() {
    let failure = in_tick("after", "currents_a[4] = 0.5");
    let expected =
        Failure::WroteOutside("8 bytes after `commanded`, the nearest 1 after its last".to_owned());
    assert!(failure.is_none_or(|failure| failure == expected));
}

#[test]
fn a_write_just_before_the_commanded_is_found() {
    let failure = in_tick("before", "((char *)commanded)[-3] ^= 0x55");
    let expected = Failure::WroteOutside(
        "1 bytes before `commanded`, the nearest 3 before its first".to_owned(),
    );
    assert!(failure.is_none_or(|failure| failure == expected));
}

#[test]
fn a_write_into_what_is_sensed_is_found() {
    let failure = in_tick(
        "into_sensed",
        "((RigproofControllerSensed *)sensed)->counts[1]++",
    );
    let expected = Failure::WroteOutside("into `sensed`, which may only be read".to_owned());
    assert!(failure.is_none_or(|failure| failure == expected));
}

#[test]
fn a_write_into_or_beside_the_settings_is_found() {
    let into = [(
        "IN_INIT",
        "((RigproofControllerSettings *)settings)->sample_s *= 2",
    )];
    let beside = [("IN_INIT", "((double *)(settings + 1))[1] = 0.3")];
    let expected = [
        "into the settings, which may only be read",
        "8 bytes after `the settings`, the nearest 9 after its last",
    ];
    for ((name, faults), expected) in [("into_settings", into), ("beside_settings", beside)]
        .iter()
        .zip(expected)
    {
        let failure = before_ticks(name, faults);
        let expected = Failure::WroteOutside(expected.to_owned());
        assert!(failure.is_none_or(|failure| failure == expected));
    }
}

#[test]
fn a_status_is_said_as_it_was() {
    let failure = in_tick("status", "return -71");
    assert!(failure.is_none_or(|failure| failure == Failure::Status(-71)));
    let refusing = "printf(\"no gain for this rig\\n\"); return 12";
    let failure = before_ticks("refusing", &[("IN_INIT", refusing)]);
    let text = "init answered with status 12; it last printed: no gain for this rig";
    assert!(failure.is_none_or(|failure| failure == Failure::Refused(text.to_owned())));
}

#[test]
fn a_current_that_is_no_number_is_handed_on() {
    for (name, code) in [
        ("nan", "currents_a[2] = NAN"),
        // What a tick does not write is no number.
        ("unwritten", "memset(currents_a, 0xff, 32)"),
    ] {
        let Some(library) = faulty(name, &[("IN_TICK", code)]) else {
            return;
        };
        let source = foreign(&library, limits());
        let [_, _, of_b, _] = trial(&source, 3).unwrap();
        assert!(of_b.is_nan());
        assert_eq!(trial(&source, 4), Ok(SOUND_A));
    }
}

#[test]
fn another_version_cannot_be_used() {
    let failure = before_ticks("version", &[("VERSION", "7")]);
    unusable(
        failure,
        &[
            "version 7",
            "this is version 1",
            "compile it with the header",
        ],
    );
}

#[test]
fn a_library_without_tick_cannot_be_used() {
    let failure = before_ticks("without_tick", &[("WITHOUT_TICK", "1")]);
    unusable(failure, &["does not export `rigproof_controller_tick`"]);
}

#[test]
fn a_library_that_calls_what_is_not_there_cannot_be_used() {
    let failure = before_ticks("undefined", &[("IN_TICK", "defined_nowhere()")]);
    unusable(failure, &["defined_nowhere", "with all that it calls"]);
}

#[test]
fn what_is_no_library_cannot_be_used() {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_library.so");
    for content in ["", "a text\n", "\u{7f}ELF and no more"] {
        std::fs::write(&file, content).unwrap();
        let source = foreign(&file, limits());
        let failure = begin(&source).err();
        assert_eq!(source.check().err(), failure);
        unusable(
            failure,
            &["no shared library that can be opened", "no_library.so"],
        );
    }
    assert_eq!(running(&named(&file)), [0_u32; 0]);
}
