//! This file holds that a compiled controller can be tried, whatever it does.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::Command;

use super::desk::Desk;

pub const ROOM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../certify/c");

/// A library of a source; nothing without a C compiler.
pub fn compiled(source: &Path, library: &Path) -> Option<()> {
    let compiled = Command::new("cc")
        .args(["-O1", "-shared", "-fPIC"])
        .arg(format!("-I{ROOM}/include"))
        .arg("-o")
        .args([library, source])
        .arg("-lm")
        .status();
    let Ok(status) = compiled else {
        println!("no C compiler: {} was not built", source.display());
        return None;
    };
    assert!(status.success());
    Some(())
}

/// A controller whose tick is this code.
fn controller(desk: &Desk, name: &str, tick: &str) -> Option<()> {
    let source = format!(
        "#include <math.h>\n#include <stdlib.h>\n#include \"rigproof_controller.h\"\n\
         static int ticks;\n\
         uint32_t rigproof_controller_version(void) {{ return RIGPROOF_CONTROLLER_VERSION; }}\n\
         int32_t rigproof_controller_init(const RigproofControllerSettings *s) {{ ticks = 0; return s->brakes == 0; }}\n\
         int32_t rigproof_controller_tick(const RigproofControllerSensed *s, RigproofControllerCommanded *c)\n\
         {{ ticks++; for (int i = 0; i < 4; i++) c->currents_a[i] = 0.1 * (s->number > 4); {tick}; return 0; }}\n\
         void rigproof_controller_shutdown(void) {{ }}\n"
    );
    let of_source = format!("{name}.c");
    desk.put(&of_source, &source);
    compiled(&desk.path(&of_source), &desk.path(name))
}

#[test]
fn the_damper_is_tried_and_nothing_of_it_stays() {
    let desk = Desk::new();
    let library = desk.path("damper.so");
    let damper = Path::new(ROOM).join("examples/damper.c");
    if compiled(&damper, &library).is_none() {
        return;
    }
    let text = desk.prints("controller try damper.so", 0);
    assert!(text.starts_with("2000 ticks answered"), "{text}");
    for brakes in [3, 4] {
        let line = format!("controller try damper.so --brakes {brakes} --ticks 817 --json");
        let answer = desk.json(&line, 0);
        let answered = &answer["answered"];
        assert_eq!(answered["ticks"], 817);
        let braking = answered["ticks_braking"].as_u64().unwrap();
        assert!((600..=801).contains(&braking), "{braking}");
        assert_eq!(answered["greatest_current_a"][3], 0.0);
        let median_us = answered["tick_us"]["median"].as_f64().unwrap();
        assert!(median_us > 0.0 && answer["finding"].is_null());
        assert_eq!(answer["after_the_trial"].as_array().unwrap().len(), 0);
    }
    let processes = std::fs::read_dir("/proc").unwrap().flatten();
    for process in processes {
        let words = std::fs::read(process.path().join("cmdline")).unwrap_or_default();
        let words = String::from_utf8_lossy(&words).into_owned();
        assert!(!words.contains(library.to_str().unwrap()), "{words}");
    }
}

#[test]
fn a_finding_is_code_1() {
    let desk = Desk::new();
    for (name, tick, part) in [
        (
            "crash.so",
            "if (ticks == 17) *(volatile int *)0 = 1",
            "in tick 17 of the trial: signal 11 (SIGSEGV)",
        ),
        (
            "nan.so",
            "if (ticks > 9) c->currents_a[2] = NAN",
            "1991 ticks answered what is no number",
        ),
        (
            "outside.so",
            "c->currents_a[5] = 1",
            "wrote outside its buffer: ",
        ),
        ("hung.so", "for (;;) { }", "did not answer within 150 ms"),
    ] {
        if controller(&desk, name, tick).is_none() {
            return;
        }
        let line = format!("controller try {name} --tick-ms 150");
        let text = desk.prints(&line, 1);
        assert!(text.contains(part), "{text}");
        let answer = desk.json(&format!("{line} --json"), 1);
        let finding = answer["finding"].as_str();
        assert!(finding.map_or(name == "nan.so", |finding| finding.contains(part)));
    }
}

#[test]
fn a_library_that_cannot_be_used_is_code_3() {
    let desk = Desk::new();
    desk.put("text.so", "no library");
    for (library, part) in [
        ("text.so", "no shared library"),
        ("nowhere.so", "cannot be read"),
    ] {
        let answer = desk.rigproof(&format!("controller try {library}"));
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3));
        assert!(
            message.starts_with("error: ") && message.contains(part),
            "{message}"
        );
    }
}
