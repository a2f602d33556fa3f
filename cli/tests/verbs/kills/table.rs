//! This file lists the verbs that write, with what each writes over what.

use std::fs;
use std::path::Path;

use crate::desk::Desk;
use crate::identify;

/// A verb that writes, over something that it or another verb wrote before.
pub struct Writes {
    pub name: &'static str,
    /// Files that no verb makes.
    pub put: fn(&Desk),
    /// What makes ready.
    pub ready: &'static [&'static str],
    /// What writes first; nothing where nothing stands before.
    pub old: &'static str,
    /// What writes over that, and is killed.
    pub new: &'static str,
    /// The file or folder that it writes.
    pub out: &'static str,
    pub kind: Kind,
}

/// What a kill may leave.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// All of the old or all of the new.
    Whole,
    /// Each file the old one or the new one: a place that is worked in file by file.
    Files,
    /// A verdict of the old or of the new, or none: a campaign's folder is worked in.
    Campaign,
    /// No key, both halves of one, or a secret key alone, whose public half the next run makes of it. Keys are drawn, so that two runs never write the same.
    Key,
}

use Kind::{Campaign, Files, Key, Whole};

const CASE: &str = "blind make --plant bench --seed 11 --stratum single --out case";

fn nothing(_: &Desk) {}

/// Two recordings that differ.
fn two(desk: &Desk) {
    for (name, step) in [("one", 0.25), ("two", 0.5)] {
        let rows =
            (0..60).map(|k| format!("{:.3},{}\n", 1e-3 * f64::from(k), step * f64::from(k % 9)));
        desk.put(
            &format!("{name}.csv"),
            &format!("time (s),x (m)\n{}", rows.collect::<String>()),
        );
    }
}

/// A campaign's description of a controller that may go.
fn sound(desk: &Desk) {
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"sdof_with_gap\"\n[coverage]\nleast_trials = 1\n",
    );
}

/// A campaign's description and a key. The key is that of RFC 8032, 7.1, test 1: signatures are the same in every folder.
fn campaign(desk: &Desk) {
    desk.put(
        "lab.pem",
        "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEIJ1hsZ3v/VpguoRK9JLsLMREScVpezJpGXA7rAMcrn9g\n-----END PRIVATE KEY-----\n",
    );
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
}

/// Bench recordings at three speeds.
fn bench(desk: &Desk) {
    desk.put(
        "joint.toml",
        &format!("{}[brake]\njoint = \"E\"\n", identify::RIG),
    );
    for rpm in [1.0, 6.0, 20.0] {
        desk.put(&format!("s{rpm}.csv"), &identify::steps(rpm));
    }
}

/// Two golden cases that are not what the model computes.
fn cases(desk: &Desk) {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden/cases");
    for case in ["brake_current_a", "brake_current_b"] {
        fs::create_dir_all(desk.path("cases").join(case)).unwrap();
        for entry in fs::read_dir(kept.join(case)).unwrap().flatten() {
            let mut bytes = fs::read(entry.path()).unwrap();
            bytes.extend(b"# edited\n");
            let name = format!("cases/{case}/{}", entry.file_name().to_str().unwrap());
            fs::write(desk.path(&name), bytes).unwrap();
        }
    }
}

fn keys(desk: &Desk) {
    fs::create_dir(desk.path("keys")).unwrap();
}

/// A report that misses what is hidden, under the seeds that are scored.
fn missed(desk: &Desk) {
    for seed in [3, 4, 5, 6] {
        fs::create_dir_all(desk.path(&format!("reports/{seed}"))).unwrap();
        let report = format!("reports/{seed}/report.json");
        desk.put(&report, r#"{"verdict":"consistent","effects":[]}"#);
    }
}

/// A row of the table, in the order in which its parts happen.
const fn writes(
    name: &'static str,
    put: fn(&Desk),
    ready: &'static [&'static str],
    [old, new, out]: [&'static str; 3],
    kind: Kind,
) -> Writes {
    Writes {
        name,
        put,
        ready,
        old,
        new,
        out,
        kind,
    }
}

pub const SIMULATE: Writes = writes(
    "simulate",
    nothing,
    &[CASE],
    [
        "",
        "simulate case/recording.csv --rig case/rig.toml --out simulated.csv",
        "simulated.csv",
    ],
    Whole,
);
pub const DIAGNOSE: Writes = writes(
    "diagnose",
    nothing,
    &[CASE],
    [
        "",
        "diagnose case/recording.csv --rig case/rig.toml --out found",
        "found",
    ],
    Whole,
);
pub const DEMO: Writes = writes(
    "demo",
    nothing,
    &[],
    [
        "blind make --plant axis --seed 3 --out shown",
        "demo --out shown",
        "shown",
    ],
    Whole,
);
pub const DESIGN: Writes = writes(
    "design",
    nothing,
    &[],
    [
        "design --no-sweep --out maps",
        "design --ae 26.4cm --ed 30.5cm --ab 20cm --no-sweep --out maps",
        "maps",
    ],
    Whole,
);
pub const REPRODUCE: Writes = writes(
    "reproduce",
    nothing,
    &[],
    [
        "reproduce 3.5 --out figures",
        "reproduce 3.3 --out figures",
        "figures",
    ],
    Whole,
);
pub const CONVERT: Writes = writes(
    "convert",
    two,
    &[],
    [
        "convert one.csv out.mcap",
        "convert two.csv out.mcap",
        "out.mcap",
    ],
    Whole,
);
pub const INSPECT: Writes = writes(
    "inspect --write-rig",
    two,
    &[],
    ["", "inspect one.csv --write-rig rig.toml", "rig.toml"],
    Whole,
);
pub const IDENTIFY: Writes = writes(
    "identify",
    bench,
    &[],
    [
        "identify brake s1.csv s6.csv --rig joint.toml --out own.toml",
        "identify brake s6.csv s20.csv --rig joint.toml --out own.toml",
        "own.toml",
    ],
    Whole,
);
pub const MAKE: Writes = writes(
    "blind make",
    nothing,
    &[],
    [
        "blind make --plant axis --seed 3 --out case",
        "blind make --plant axis --seed 4 --out case",
        "case",
    ],
    Whole,
);
pub const TRIAL: Writes = writes(
    "blind trial",
    missed,
    &[],
    [
        "blind trial --plant axis --seeds 3..5 --reports reports --misses missed",
        "blind trial --plant axis --seeds 4..7 --reports reports --misses missed",
        "missed",
    ],
    Whole,
);
pub const TRIAL_PAGE: Writes = writes(
    "blind trial --html",
    missed,
    &[],
    [
        "blind trial --plant axis --seeds 3..5 --reports reports --html page.html",
        "blind trial --plant axis --seeds 4..7 --reports reports --html page.html",
        "page.html",
    ],
    Whole,
);
pub const NEW: Writes = writes("new", nothing, &[], ["", "new bench", "bench"], Whole);
pub const MAN: Writes = writes(
    "man",
    nothing,
    &[],
    ["man --out pages", "man --out pages", "pages"],
    Whole,
);
pub const EXPORT: Writes = writes(
    "golden export",
    nothing,
    &[],
    [
        "golden export runs brake_step_a",
        "golden export runs brake_step_b brake_current_a",
        "runs",
    ],
    Whole,
);
pub const REGENERATE: Writes = writes(
    "golden regenerate",
    cases,
    &[],
    [
        "",
        "golden regenerate brake_current_a brake_current_b --cases cases",
        "cases",
    ],
    Files,
);
pub const CERTIFY: Writes = writes(
    "certify",
    campaign,
    &[],
    [
        "",
        "certify certify.toml --scenarios 24 --seconds 0.2 --jobs 1 --out campaign",
        "campaign",
    ],
    Campaign,
);
pub const MERGE: Writes = writes(
    "certify merge",
    campaign,
    &["certify certify.toml --scenarios 24 --seconds 0.2 --shard 1/1 --out part"],
    [
        "certify merge part --out merged",
        "certify merge part --out merged",
        "merged",
    ],
    Campaign,
);
pub const SIGN: Writes = writes(
    "certify sign",
    campaign,
    &["certify certify.toml --scenarios 8 --seconds 0.2 --out part"],
    [
        "",
        "certify sign part/certificate.json --key lab.pem --sample 8",
        "part/certificate.json.sig",
    ],
    Whole,
);
pub const MONITOR: Writes = writes(
    "certify monitor",
    sound,
    &[
        "certify certify.toml --scenarios 16 --seconds 1 --out first",
        "certify certify.toml --scenarios 20 --seconds 1 --out second",
    ],
    [
        "certify monitor first/certificate.json --out monitor",
        "certify monitor second/certificate.json --out monitor",
        "monitor",
    ],
    Whole,
);
pub const MAKE_KEY: Writes = writes(
    "certify key",
    keys,
    &[],
    ["", "certify key keys/own.pem", "keys"],
    Key,
);
