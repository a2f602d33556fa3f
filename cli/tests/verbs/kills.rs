//! This file kills verbs that write before chosen system calls: what was there or what is to be there stands then, and the next run tidies up.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::desk::Desk;

/// How many kills each verb gets in a usual test; `RIGPROOF_KILLS` says how many all verbs get together.
const EACH: u64 = 5;

/// A verb that writes over something that it wrote before.
struct Writes {
    name: &'static str,
    /// What makes ready, what writes first, and what writes over that.
    ready: &'static [&'static str],
    old: &'static str,
    new: &'static str,
    /// The file or folder that it writes.
    out: &'static str,
    /// The files that a kill may leave away or leave as they are at any time: a campaign's folder is worked in.
    grows: bool,
}

const CASE: &str = "blind make --plant bench --seed 11 --stratum single --out case";

/// A verb that takes long under the killer: it is killed only where the number of kills is set.
const DIAGNOSE: Writes = Writes {
    name: "diagnose",
    ready: &[CASE],
    old: "",
    new: "diagnose case/recording.csv --rig case/rig.toml --out found",
    out: "found",
    grows: false,
};

const ALL: [Writes; 11] = [
    Writes {
        name: "simulate",
        ready: &[CASE],
        old: "",
        new: "simulate case/recording.csv --rig case/rig.toml --out simulated.csv",
        out: "simulated.csv",
        grows: false,
    },
    Writes {
        name: "design",
        ready: &[],
        old: "design --no-sweep --out maps",
        new: "design --ae 26.4cm --ed 30.5cm --ab 20cm --no-sweep --out maps",
        out: "maps",
        grows: false,
    },
    Writes {
        name: "reproduce",
        ready: &[],
        old: "reproduce 3.5 --out figures",
        new: "reproduce 3.3 --out figures",
        out: "figures",
        grows: false,
    },
    Writes {
        name: "convert",
        ready: &[],
        old: "convert one.csv out.mcap",
        new: "convert two.csv out.mcap",
        out: "out.mcap",
        grows: false,
    },
    Writes {
        name: "inspect --write-rig",
        ready: &[],
        old: "",
        new: "inspect one.csv --write-rig rig.toml",
        out: "rig.toml",
        grows: false,
    },
    Writes {
        name: "blind make",
        ready: &[],
        old: "blind make --plant axis --seed 3 --out case",
        new: "blind make --plant axis --seed 4 --out case",
        out: "case",
        grows: false,
    },
    Writes {
        name: "new",
        ready: &[],
        old: "",
        new: "new bench",
        out: "bench",
        grows: false,
    },
    Writes {
        name: "man",
        ready: &[],
        old: "man --out pages",
        new: "man --out pages",
        out: "pages",
        grows: false,
    },
    Writes {
        name: "certify",
        ready: &[],
        old: "",
        new: "certify certify.toml --scenarios 24 --seconds 0.2 --jobs 1 --out campaign",
        out: "campaign",
        grows: true,
    },
    Writes {
        name: "certify merge",
        ready: &["certify certify.toml --scenarios 24 --seconds 0.2 --shard 1/1 --out part"],
        old: "certify merge part --out merged",
        new: "certify merge part --out merged",
        out: "merged",
        grows: true,
    },
    Writes {
        name: "certify sign",
        ready: &["certify certify.toml --scenarios 8 --seconds 0.2 --out part"],
        old: "",
        new: "certify sign part/certificate.json --key lab.pem --sample 8",
        out: "part/certificate.json.sig",
        grows: false,
    },
];

/// The secret key of RFC 8032, 7.1, test 1: signatures are the same in every folder.
const KEY: &str = "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEIJ1hsZ3v/VpguoRK9JLsLMREScVpezJpGXA7rAMcrn9g\n-----END PRIVATE KEY-----\n";

/// The killer, built; `None` without a C compiler or where processes are not traced.
fn killer(desk: &Desk) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/verbs/killer.c");
    let program = desk.path("killer");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let built = Command::new(compiler)
        .arg("-O1")
        .arg("-o")
        .args([&program, &source])
        .status();
    let Ok(built) = built else {
        println!("no C compiler: nothing was killed");
        return None;
    };
    assert!(built.success(), "the killer does not compile");
    let traced = Command::new(&program)
        .args(["0", "/bin/true"])
        .status()
        .unwrap();
    if !traced.success() {
        println!("this system lets no process trace another: nothing was killed");
        return None;
    }
    Some(program)
}

fn desk(writes: &Writes) -> Desk {
    let desk = Desk::new();
    for (name, step) in [("one", 0.25), ("two", 0.5)] {
        let rows =
            (0..60).map(|k| format!("{:.3},{}\n", 1e-3 * f64::from(k), step * f64::from(k % 9)));
        desk.put(
            &format!("{name}.csv"),
            &format!("time (s),x (m)\n{}", rows.collect::<String>()),
        );
    }
    desk.put("lab.pem", KEY);
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
    for line in writes
        .ready
        .iter()
        .chain([&writes.old])
        .filter(|line| !line.is_empty())
    {
        let answer = desk.rigproof(line);
        assert!(
            answer.status.code().is_some_and(|code| code < 2),
            "{line}: {answer:?}"
        );
    }
    desk
}

/// What stands at a place: every file with its bytes, parts left out.
fn stands(place: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut left = vec![place.to_path_buf()];
    while let Some(path) = left.pop() {
        let is_part = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().ends_with(".part"));
        match path.is_dir() {
            _ if is_part => {}
            true => left.extend(
                fs::read_dir(&path)
                    .unwrap()
                    .map(|entry| entry.unwrap().path()),
            ),
            false => {
                if let Ok(bytes) = fs::read(&path) {
                    all.insert(path.strip_prefix(place).unwrap().to_path_buf(), bytes);
                }
            }
        }
    }
    all
}

/// Names of parts below a folder.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if entry.file_name().to_string_lossy().ends_with(".part") {
            found.push(path);
        } else if path.is_dir() {
            found.extend(parts(&path));
        }
    }
    found
}

fn killed(killer: &Path, desk: &Desk, line: &str, at: u64) -> (i32, String) {
    let mut command = Command::new(killer);
    command
        .arg(at.to_string())
        .arg(env!("CARGO_BIN_EXE_rigproof"));
    let answer = command
        .args(line.split_whitespace())
        .current_dir(desk.path(""))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&answer.stderr).into_owned();
    (answer.status.code().unwrap_or(-1), said)
}

/// Kills a verb at so many of its calls, spread over all of them; how many kills there were.
fn kills(writes: &Writes, most: u64) -> u64 {
    let first = desk(writes);
    let Some(killer_here) = killer(&first) else {
        return 0;
    };
    let old = stands(&first.path(writes.out));
    let (code, said) = killed(&killer_here, &first, writes.new, 0);
    assert!((0..=1).contains(&code), "{}: {code} {said}", writes.name);
    let new = stands(&first.path(writes.out));
    let calls = said.lines().find_map(|line| line.strip_prefix("calls: "));
    let calls: u64 = calls.unwrap().parse().unwrap();
    assert!(calls >= 3, "{}: {calls}", writes.name);
    let count = calls.min(most);
    for k in 0..count {
        let at = 1 + k * (calls - 1) / (count - 1).max(1);
        let desk = desk(writes);
        let (code, said) = killed(&killer_here, &desk, writes.new, at);
        // Threads make a call more or less; then it came to its end.
        assert!(
            [99, 0, 1].contains(&code),
            "{} at {at}: {code} {said}",
            writes.name
        );
        let left = stands(&desk.path(writes.out));
        let is_one = match writes.grows {
            false => left == old || left == new,
            true => {
                let verdict = Path::new("certificate.json");
                left.get(verdict)
                    .is_none_or(|own| [new.get(verdict), old.get(verdict)].contains(&Some(own)))
            }
        };
        assert!(
            is_one,
            "{} at {at} of {calls}: {:?}",
            writes.name,
            left.keys()
        );
        if code == 99 {
            let again = desk.rigproof(writes.new);
            let code = again.status.code();
            // What was there before the kill is not made again where a verb refuses to write over it.
            let is_refused = code == Some(3) && left == new;
            assert!(
                is_refused || code.is_some_and(|code| code < 2),
                "{} at {at}: {again:?}",
                writes.name
            );
        }
        assert_eq!(
            stands(&desk.path(writes.out)),
            new,
            "{} at {at} of {calls}",
            writes.name
        );
        let left = parts(&desk.path(""));
        let is_refused = writes.old.is_empty() && !writes.grows;
        assert!(
            left.is_empty() || is_refused,
            "{} at {at}: {left:?}",
            writes.name
        );
    }
    println!("{:<20} {count} kills before {calls} calls", writes.name);
    count
}

#[test]
fn a_kill_leaves_what_was_or_what_is_to_be_and_the_next_run_tidies_up() {
    let asked = std::env::var("RIGPROOF_KILLS").ok();
    let asked: Option<u64> = asked.map(|text| text.parse().unwrap());
    let long = asked.is_some().then_some(&DIAGNOSE);
    let verbs: Vec<&Writes> = ALL.iter().chain(long).collect();
    let each = asked.map_or(EACH, |all| all.div_ceil(verbs.len() as u64));
    let mut all: u64 = 0;
    while all == 0 || asked.is_some_and(|asked| all < asked) {
        let round: u64 = verbs.iter().map(|writes| kills(writes, each)).sum();
        if round == 0 {
            return;
        }
        all += round;
    }
    println!("{all} kills");
}
