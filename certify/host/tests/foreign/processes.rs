//! This file says that no process of a controller outlives what it is for.

use std::process::{Command, Stdio};

use rigproof_certify::controller::Failure;

use crate::bench::{
    SOUND_A, begin, faulty, foreign, is_there, limits, named, running, sensed, trial, wait_for,
};

/// A controller whose every `init` starts a process that stays, in its own way.
fn leaving(name: &str, how: &str, after: &str) -> Option<()> {
    // The first child is waited for where it ends, so that one process is left when `init` answers.
    let code = format!("if (fork() == 0) {{ {how}; for (;;) pause(); }} {after}");
    let library = faulty(name, &[("IN_INIT", &code), ("IN_TICK", "abort()")])?;
    let name = named(&library);
    let source = foreign(&library, limits());
    // It answers, and stays when the trial is over.
    let mut controller = begin(&source).unwrap();
    let processes = wait_for(&name, 3);
    assert_eq!(controller.tick(&sensed(0)), Ok(SOUND_A));
    assert_eq!(controller.end(), Err(Failure::LeftRunning(1)));
    assert!(processes.iter().all(|process| !is_there(*process)));
    assert_eq!(source.between_trials(), []);
    // It fails with the process there.
    let mut controller = begin(&source).unwrap();
    wait_for(&name, 3);
    let failure = (0..3).find_map(|number| controller.tick(&sensed(number)).err());
    let Some(Failure::Ended(text)) = failure else {
        panic!("no end");
    };
    assert!(
        text.contains("SIGABRT") && text.contains("a process that it had started was ended"),
        "{text}"
    );
    assert_eq!(running(&name), [0_u32; 0]);
    Some(())
}

#[test]
fn a_child_that_stays_is_ended() {
    leaving("child", "", "");
}

#[test]
fn a_child_in_a_session_of_its_own_is_ended() {
    leaving("session", "setsid()", "");
}

#[test]
fn a_child_whose_parent_has_ended_is_ended() {
    leaving("orphan", "setsid(); if (fork()) _exit(0)", "wait(NULL)");
}

#[test]
fn a_child_that_holds_the_connection_does_not_hide_the_end() {
    let code = "if (fork() == 0) { for (;;) pause(); } abort()";
    let Some(library) = faulty("holding", &[("IN_TICK", code)]) else {
        return;
    };
    let source = foreign(&library, limits());
    let failure = trial(&source, 3).unwrap_err();
    assert!(failure.to_string().contains("SIGABRT"), "{failure}");
    assert_eq!(running(&named(&library)), [0_u32; 0]);
}

#[test]
fn another_program_that_is_started_is_ended() {
    // Told from those of other runs of this test by the number of this one.
    let time_s = format!("98765.{}", std::process::id());
    let code = format!(
        "if (fork() == 0) {{ setsid(); execl(\"/bin/sleep\", \"sleep\", \"{time_s}\", NULL); }}"
    );
    let Some(library) = faulty("starting", &[("IN_INIT", &code)]) else {
        return;
    };
    let source = foreign(&library, limits());
    let controller = begin(&source).unwrap();
    wait_for(&time_s, 1);
    drop(controller);
    drop(source);
    assert_eq!(running(&time_s), [0_u32; 0]);
}

#[test]
fn a_controller_in_a_group_of_its_own_is_ended() {
    let Some(library) = faulty(
        "grouped",
        &[
            ("IN_INIT", "setpgid(0, 0); setsid()"),
            ("IN_TICK", "for (;;) { }"),
        ],
    ) else {
        return;
    };
    let source = foreign(&library, limits());
    assert_eq!(trial(&source, 3), Err(Failure::Hung { limit_ms: 700 }));
    assert_eq!(running(&named(&library)), [0_u32; 0]);
}

#[test]
fn a_controller_that_kills_its_group_or_its_watch_is_ended() {
    for (name, code, part) in [
        ("group_killed", "kill(0, SIGKILL)", "signal 9 (SIGKILL)"),
        (
            "watch_killed",
            "kill(getppid(), SIGKILL); for (;;) pause()",
            "watches it",
        ),
    ] {
        let Some(library) = faulty(name, &[("IN_TICK", code)]) else {
            return;
        };
        let source = foreign(&library, limits());
        let Err(Failure::Ended(text)) = trial(&source, 3) else {
            panic!("no end");
        };
        assert!(
            text.contains("in tick 3 of the trial") && text.contains(part),
            "{text}"
        );
        wait_for(&named(&library), 0);
        assert_eq!(trial(&source, 2), Ok(SOUND_A));
    }
}

#[test]
fn nothing_is_left_of_a_trial_that_is_let_go() {
    let Some(library) = faulty("let_go", &[]) else {
        return;
    };
    let source = foreign(&library, limits());
    let mut controllers: Vec<_> = (0..3).map(|_| begin(&source).unwrap()).collect();
    for controller in &mut controllers {
        assert_eq!(controller.tick(&sensed(0)), Ok(SOUND_A));
    }
    wait_for(&named(&library), 6);
    drop(controllers);
    drop(source);
    assert_eq!(running(&named(&library)), [0_u32; 0]);
}

/// Kills a program that runs a campaign, where no destructor runs.
fn killed(name: &str, faults: &[(&str, &str)], processes: usize) {
    let Some(library) = faulty(name, faults) else {
        return;
    };
    let name = named(&library);
    let mut campaign = Command::new(env!("CARGO_BIN_EXE_rigproof-controller-host"))
        .arg("try")
        .arg(&library)
        .arg("1000000000")
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // The campaign itself is one of them.
    wait_for(&name, processes + 1);
    campaign.kill().unwrap();
    campaign.wait().unwrap();
    wait_for(&name, 0);
}

#[test]
fn nothing_is_left_of_a_campaign_that_is_killed() {
    killed("killed", &[], 2);
    let stays = "if (fork() == 0) { setsid(); for (;;) pause(); }";
    killed("killed_leaving", &[("IN_INIT", stays)], 3);
    killed("killed_hung", &[("IN_INIT", "for (;;) { }")], 2);
    killed("killed_stopped", &[("IN_INIT", "raise(SIGSTOP)")], 2);
}
