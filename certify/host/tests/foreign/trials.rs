//! This file says what one trial of a compiled controller has to do with another: nothing.

use std::path::PathBuf;

use rigproof_certify::controller::{Failure, Source, Task};
use rigproof_certify::foreign::{Foreign, Host, Limits, MOST_POINTS};
use rigproof_impl::tick::Settings;
use rigproof_spec::layout::Layout;

use crate::bench::{
    SOUND_A, begin, faulty, foreign, limits, line, named, running, sensed, trial, wait_for,
};

#[test]
fn a_process_is_begun_anew_for_the_next_trial() {
    let Some(library) = faulty("anew", &[("IN_TICK", "currents_a[1] = trials")]) else {
        return;
    };
    let source = foreign(&library, limits());
    for trials in 1..4 {
        assert_eq!(trial(&source, 3), Ok([0.25, f64::from(trials), 0.0, 0.0]));
        wait_for(&named(&library), 2);
    }
    let one = Limits {
        one_trial_a_process: true,
        ..limits()
    };
    let source = foreign(&library, one);
    for _ in 0..3 {
        assert_eq!(trial(&source, 3), Ok([0.25, 1.0, 0.0, 0.0]));
    }
}

#[test]
fn trials_at_once_have_processes_of_their_own() {
    let Some(library) = faulty("at_once", &[("IN_TICK", "currents_a[1] = trials")]) else {
        return;
    };
    let source = foreign(&library, limits());
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..20 {
                    let currents_a = trial(&source, 17).unwrap();
                    assert_eq!(currents_a, SOUND_A);
                }
            });
        }
    });
    // A process for every thread, and its watch.
    assert_eq!(running(&named(&library)).len(), 8);
    source.end();
    assert_eq!(running(&named(&library)), [0_u32; 0]);
    assert_eq!(source.between_trials(), []);
}

#[test]
fn an_init_that_fails_after_another_trial_is_no_fault_of_the_trial() {
    let Some(library) = faulty("second_init", &[("IN_INIT", "if (trials > 1) return 5")]) else {
        return;
    };
    let source = foreign(&library, limits());
    for _ in 0..3 {
        assert_eq!(trial(&source, 2), Ok(SOUND_A));
    }
    let between = source.between_trials();
    assert_eq!(between.len(), 1);
    assert_eq!(between[0].times, 2);
    assert!(
        between[0].what.contains("after another trial") && between[0].what.contains("status 5")
    );
}

#[test]
fn an_init_that_fails_after_its_own_trial_is_a_fault_of_the_trial() {
    let Some(library) = faulty("own_init", &[("IN_INIT", "if (trials > 1) return 5")]) else {
        return;
    };
    let source = foreign(&library, limits());
    assert_eq!(trial(&source, 2), Ok(SOUND_A));
    let again = source.begin_again(&Settings::thesis(Layout::FourBrake), &line());
    let refused = Failure::Refused("init answered with status 5".to_owned());
    assert_eq!(again.err(), Some(refused));
    assert_eq!(source.between_trials(), []);
}

#[test]
fn a_fault_in_shutdown_is_a_fault_of_the_trial() {
    let Some(library) = faulty(
        "shutdown_null",
        &[("IN_SHUTDOWN", "*(volatile int *)0 = 1")],
    ) else {
        return;
    };
    let source = foreign(&library, limits());
    for _ in 0..2 {
        let failure = trial(&source, 2).unwrap_err().to_string();
        assert!(failure.contains("in shutdown: signal 11"), "{failure}");
    }
    let library = faulty("shutdown_hung", &[("IN_SHUTDOWN", "for (;;) { }")]).unwrap();
    let limits = Limits {
        start_ms: 300,
        ..limits()
    };
    let source = foreign(&library, limits);
    assert_eq!(trial(&source, 2), Err(Failure::Hung { limit_ms: 300 }));
    assert_eq!(source.between_trials(), []);
}

#[test]
fn a_finding_shows_nothing_that_an_earlier_trial_printed() {
    // Without an end of line it stays in the C library's buffer.
    let faults = [
        ("IN_INIT", "if (trials == 1) printf(\"of the first\")"),
        (
            "IN_TICK",
            "if (trials == 2) { printf(\"of the second\\n\"); abort(); }",
        ),
    ];
    let Some(library) = faulty("printed_before", &faults) else {
        return;
    };
    let source = foreign(&library, limits());
    assert_eq!(trial(&source, 3), Ok(SOUND_A));
    let failure = trial(&source, 3).unwrap_err().to_string();
    assert!(
        failure.ends_with("it last printed: of the second"),
        "{failure}"
    );
}

#[test]
fn a_controller_that_failed_is_not_asked_again() {
    let Some(library) = faulty("failed", &[("IN_TICK", "return 9")]) else {
        return;
    };
    let source = foreign(&library, limits());
    let mut controller = begin(&source).unwrap();
    let answers: Vec<_> = (0..4)
        .map(|number| controller.tick(&sensed(number)))
        .collect();
    assert_eq!(answers[2], Err(Failure::Status(9)));
    assert!(matches!(&answers[3], Err(Failure::Ended(_))));
}

#[test]
fn a_controller_sees_neither_the_environment_nor_the_descriptors_of_the_campaign() {
    let code = "if (getenv(\"PATH\") || getenv(\"CARGO_MANIFEST_DIR\")) return 1; \
                for (int d = 4; d < 256; d++) if (fcntl(d, F_GETFD) != -1) return d; \
                if (read(0, told.points_m, 1) != 0) return 2; \
                if (access(\"Cargo.toml\", F_OK) == 0) return 3; \
                FILE *file = fopen(\"here\", \"w\"); if (!file) return 255";
    let Some(library) = faulty("alone", &[("IN_INIT", code)]) else {
        return;
    };
    assert_eq!(trial(&foreign(&library, limits()), 2), Ok(SOUND_A));
}

#[test]
fn every_setting_arrives() {
    let code = "if (told.size != sizeof told || told.version != RIGPROOF_CONTROLLER_VERSION) return 1; \
                if (told.brakes != 3 || told.task != RIGPROOF_CONTROLLER_TASK_ARC || told.points != 0) return 2; \
                if (told.arms_m[0] != 0.305 || told.arms_m[4] != 0.0) return 3; \
                if (told.counts_per_turn[1] != 43210 || told.zero_counts[0] != -17) return 4; \
                if (told.sample_s != 0.0013 || told.greatest_rate_rad_s != 29.7) return 5; \
                if (told.greatest_force_n != 187.3 || told.greatest_current_a != 1.0) return 6; \
                if (told.centre_m[1] != 0.379 || told.radius_m != 0.083) return 7; \
                if (told.from_rad != 0.7 || told.to_rad != -2.3) return 8";
    let Some(library) = faulty("settings", &[("IN_INIT", code)]) else {
        return;
    };
    let settings = Settings {
        counts_per_turn: [98_765, 43_210],
        zero_counts: [-17, 2_345],
        sample_s: 0.0013,
        greatest_rate_rad_s: 29.7,
        greatest_force_n: 187.3,
        ..Settings::thesis(Layout::ThreeBrake)
    };
    let arc = Task::Arc {
        centre_m: [0.011, 0.379],
        radius_m: 0.083,
        from_rad: 0.7,
        to_rad: -2.3,
    };
    let source = foreign(&library, limits());
    assert!(source.begin(&settings, &arc).is_ok());
}

#[test]
fn every_point_arrives_and_more_are_refused() {
    let code = "if (told.task != RIGPROOF_CONTROLLER_TASK_SPLINE || told.points != 64) return 1; \
                for (int i = 0; i < 64; i++) if (told.points_m[i][0] != i / 128.0 || told.points_m[i][1] != 0.3) return 2";
    let Some(library) = faulty("points", &[("IN_INIT", code)]) else {
        return;
    };
    let source = foreign(&library, limits());
    let of = |count: u32| Task::Spline((0..count).map(|k| [f64::from(k) / 128.0, 0.3]).collect());
    let settings = Settings::thesis(Layout::FourBrake);
    assert!(source.begin(&settings, &of(MOST_POINTS as u32)).is_ok());
    let Err(Failure::Refused(text)) = source.begin(&settings, &of(65)) else {
        panic!("65 points are taken");
    };
    assert!(
        text.contains("65 points") && text.contains("64 at most"),
        "{text}"
    );
}

#[test]
fn a_host_that_is_none_is_no_fault_of_the_controller() {
    let Some(library) = faulty("hostless", &[]) else {
        return;
    };
    for (program, part) in [
        ("/bin/false", "ended before it could"),
        ("/bin/nothing-of-this-name", "cannot be started"),
    ] {
        let host = Host {
            program: PathBuf::from(program),
            words: Vec::new(),
        };
        let source = Foreign::new(&library, host, limits()).unwrap();
        let Err(Failure::Unusable(text)) = source.check() else {
            panic!("{program} is taken");
        };
        assert!(text.contains(part), "{text}");
    }
    let nowhere = Foreign::new(
        &library.with_extension("nowhere"),
        Host {
            program: PathBuf::new(),
            words: Vec::new(),
        },
        limits(),
    );
    assert!(matches!(nowhere, Err(Failure::Unusable(text)) if text.contains("cannot be read")));
}
