//! This file says what a controller with intent cannot do: be another than the one that was hashed, answer by what a run has by chance, reach other processes or a network.

use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rigproof_certify::controller::Failure;
use rigproof_certify::declared::Declared;
use rigproof_certify::digest;
use rigproof_certify::law::Law;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::trial::run;

use crate::bench::{SOUND_A, begin, compiled, compiler, faulty, foreign, limits, trial};

/// Samples of a trial whose last one is the faulty tick: what that one commands is what the trial answers.
const REACHED: u32 = 3;

/// How often a trial of a controller was not repeated.
fn not_repeated(library: &Path) -> u32 {
    let source = foreign(library, limits());
    let scenario = Scenario::drawn(5, 2, &[Rig::FourBrake], 12);
    let ran = run(&scenario, &source, &Declared::default(), false).unwrap();
    assert_eq!(ran.failure, None);
    ran.fared[Law::Repeats as usize].broken as u32
}

#[test]
fn what_a_process_has_by_chance_does_not_repeat() {
    let by = [
        ("number", "currents_a[1] = (getpid() % 99991) * 1e-6"),
        (
            "layout",
            "currents_a[1] = ((size_t)&told >> 12) % 99991 * 1e-6",
        ),
        (
            "stack",
            "currents_a[1] = ((size_t)__builtin_frame_address(0) >> 4) % 99991 * 1e-6",
        ),
        (
            "file",
            "{ struct stat own; stat(\".\", &own); currents_a[1] = own.st_ino % 99991 * 1e-6; }",
        ),
    ];
    for (name, code) in by {
        let told = [
            format!("-DIN_TICK={code}"),
            "-include".into(),
            "sys/stat.h".into(),
            "-w".into(),
        ];
        let told: Vec<&str> = told.iter().map(String::as_str).collect();
        let Some(library) = compiled(&format!("hostile_{name}"), "tests/foreign/faulty.c", &told)
        else {
            return;
        };
        assert_eq!(not_repeated(&library), 1, "{name}");
    }
    let sound = faulty("hostile_sound", &[]).unwrap();
    assert_eq!(not_repeated(&sound), 0);
    // What stays from one trial to the next does not repeat either.
    let stays = faulty(
        "hostile_stays",
        &[("IN_TICK", "currents_a[1] = trials * 1e-2")],
    )
    .unwrap();
    assert_eq!(not_repeated(&stays), 1);
}

#[test]
fn a_library_that_is_swapped_or_taken_away_is_the_one_that_was_hashed() {
    let Some(library) = faulty("hostile_swapped", &[]) else {
        return;
    };
    let bytes = std::fs::read(&library).unwrap();
    let other = faulty("hostile_other", &[("IN_TICK", "currents_a[1] = 0.5")]).unwrap();
    // The other one is told from it.
    assert_ne!(trial(&foreign(&other, limits()), REACHED), Ok(SOUND_A));
    let source = foreign(&library, limits());
    assert_eq!(source.sha256(), digest::of_bytes(&bytes));
    std::fs::remove_file(&library).unwrap();
    std::fs::copy(&other, &library).unwrap();
    assert_eq!(trial(&source, REACHED), Ok(SOUND_A));
    source.end();
    std::fs::remove_file(&library).unwrap();
    assert_eq!(trial(&source, REACHED), Ok(SOUND_A));
}

/// A controller that links by its run path to a library beside it, and one that opens that when it is loaded; `None` without a C compiler.
fn with_code_beside(name: &str) -> Option<[PathBuf; 2]> {
    let compiler = compiler()?;
    let tmp = format!("{}/{name}", env!("CARGO_TARGET_TMPDIR"));
    std::fs::create_dir_all(&tmp).unwrap();
    let source = format!("{tmp}/beside.c");
    std::fs::write(&source, "int beside(void) { return 7; }\n").unwrap();
    let built = Command::new(compiler)
        .args([
            "-shared",
            "-fPIC",
            "-o",
            &format!("{tmp}/libbeside.so"),
            &source,
        ])
        .status();
    assert!(built.unwrap().success());
    let linked = [
        "-DIN_TICK=extern int beside(void); currents_a[1] = beside() * 1e-2",
        "-w",
        &format!("-L{tmp}"),
        "-lbeside",
        &format!("-Wl,-rpath,{tmp}"),
    ];
    let by_path = compiled(
        &format!("hostile_linked_{name}"),
        "tests/foreign/faulty.c",
        &linked,
    )?;
    let opened = format!("-DAT_OPENING=dlopen(\"{tmp}/libbeside.so\", 2)");
    let opened = compiled(
        &format!("hostile_opened_{name}"),
        "tests/foreign/faulty.c",
        &[&opened, "-include", "dlfcn.h", "-w"],
    );
    Some([by_path, opened?])
}

#[test]
fn code_that_its_hash_does_not_name_is_refused() {
    let Some(libraries) = with_code_beside("beside") else {
        return;
    };
    for library in libraries {
        let source = foreign(&library, limits());
        let Err(Failure::Unusable(why)) = begin(&source).map(drop) else {
            panic!("{library:?} was begun");
        };
        assert!(
            why.contains("libbeside.so, which its hash does not name"),
            "{why}"
        );
    }
}

/// What the host says of a controller in a user namespace of somebody who is not root, which maps nobody but him; `None` where this system makes none.
fn in_a_foreign_namespace(library: &Path) -> Option<Output> {
    let is_root = std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0);
    let as_another = "setpriv --reuid=65534 --regid=65534 --clear-groups";
    let before = if is_root { as_another } else { "" };
    let mut words = before.split_whitespace().chain(["unshare", "-Ur"]);
    let mut command = Command::new(words.next()?);
    command.args(words);
    let program = env!("CARGO_BIN_EXE_rigproof-controller-host");
    let answer = command
        .args([program, "try"])
        .arg(library)
        .arg("60")
        .output();
    let answer = answer.ok()?;
    // What the host did not begin it did not answer.
    let said = String::from_utf8_lossy(&answer.stderr);
    (answer.status.success() || said.starts_with("error: ")).then_some(answer)
}

#[test]
fn in_a_foreign_user_namespace_the_system_s_libraries_are_told_from_others() {
    let Some(others) = with_code_beside("foreign") else {
        return;
    };
    // It links to libm.
    let sound = compiled("hostile_damper", "../c/examples/damper.c", &[]).unwrap();
    let Some(answer) = in_a_foreign_namespace(&sound) else {
        println!("passed over: this system makes no user namespace");
        return;
    };
    assert!(answer.status.success(), "{answer:?}");
    for library in others {
        let answer = in_a_foreign_namespace(&library).unwrap();
        let said = String::from_utf8_lossy(&answer.stderr);
        assert!(!answer.status.success(), "{library:?}");
        assert!(
            said.contains("libbeside.so, which its hash does not name"),
            "{said}"
        );
    }
}

/// A controller that tries to reach out in a tick, and says in its currents what it reached.
const REACHES: &str = "{ int memory; char name[64]; \
    if (ptrace(PTRACE_ATTACH, getppid(), 0, 0) == 0) currents_a[1] = 0.5; \
    if (socket(2, 1, 0) >= 0) currents_a[2] = 0.5; \
    if (syscall(SYS_process_vm_readv, getppid(), 0, 0, 0, 0, 0) == 0) currents_a[3] = 0.5; \
    if (syscall(SYS_bpf, 0, 0, 0) >= 0 || errno != EPERM) currents_a[3] = 0.25; }";

fn reaching(name: &str, code: &str) -> Option<PathBuf> {
    let tick = format!("-DIN_TICK={code}");
    let mut told = vec![tick.as_str(), "-w"];
    for header in ["errno.h", "sys/ptrace.h", "sys/socket.h", "sys/syscall.h"] {
        told.extend(["-include", header]);
    }
    compiled(name, "tests/foreign/faulty.c", &told)
}

#[test]
fn other_processes_and_the_network_are_out_of_reach() {
    let Some(library) = reaching("hostile_reaching", REACHES) else {
        return;
    };
    // What it reaches is seen in its currents.
    let open = reaching("hostile_open", "if (getppid() > 1) currents_a[2] = 0.5").unwrap();
    assert_ne!(trial(&foreign(&open, limits()), REACHED), Ok(SOUND_A));
    let source = foreign(&library, limits());
    if source.lacks().iter().any(|lack| lack.contains("seccomp")) {
        println!("passed over: this system has no filter");
        return;
    }
    assert_eq!(trial(&source, REACHED), Ok(SOUND_A));
}

/// The campaign's memory, through /proc: as another user than root it cannot be opened, and as root the certificate says that it can.
#[test]
fn the_campaign_s_memory_is_closed_or_it_is_said_that_it_is_not() {
    let code = "{ char name[64]; FILE *stat; int parent = 0; snprintf(name, 64, \"/proc/%d/stat\", getppid()); stat = fopen(name, \"r\"); \
        if (stat) { fscanf(stat, \"%*d %*s %*s %d\", &parent); fclose(stat); } \
        snprintf(name, 64, \"/proc/%d/mem\", parent); \
        currents_a[1] = open(name, O_RDWR) >= 0 ? 0.5 : 0; }";
    let Some(library) = reaching("hostile_memory", code) else {
        return;
    };
    let source = foreign(&library, limits());
    let [_, opened_a, ..] = trial(&source, REACHED).unwrap();
    let is_root = source.lacks().iter().any(|lack| lack.contains("as root"));
    println!(
        "as root: {is_root}; the campaign's memory was opened: {}",
        opened_a > 0.0
    );
    assert!(opened_a == 0.0 || is_root);
}
