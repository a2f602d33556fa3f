//! This file opens the pages that the program writes in a real browser and uses them.
//!
//! It needs a folder with the packages of `report/browser/package-lock.json`, named by `RIGPROOF_BROWSER`, and Chromium (`RIGPROOF_CHROMIUM`, else `/usr/bin/chromium`);
//! `.ci/run` sets both up. Without the first it passes over itself with a printed line; with it everything is required, but for Firefox, in which the pages are
//! opened once more where there is one.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::desk::Desk;
use crate::serve::Served;

/// The folder with the browser's client; nothing where the tests are not asked for.
fn tools() -> Option<PathBuf> {
    let folder = std::env::var_os("RIGPROOF_BROWSER").map(PathBuf::from);
    if folder.is_none() {
        println!("passed over: RIGPROOF_BROWSER names no folder with the browser's client");
    }
    folder
}

/// Runs `check.mjs` on pages; it looks for its packages beside itself. `drop` is a recording, and where it is to come while a list of runs is looked at.
fn holds(tools: &Path, pages: &[String], drop: Option<[PathBuf; 2]>) {
    let chromium =
        std::env::var_os("RIGPROOF_CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
    let drop = drop.map(|[from, to]| format!("{}\n{}", from.display(), to.display()));
    runs(tools, "check.mjs", Path::new(&chromium), pages, drop);
}

/// Runs `smoke.mjs` on pages in Firefox; where there is none, and none is named by `RIGPROOF_FIREFOX`, a line says so.
fn holds_in_another_engine(tools: &Path, pages: &[String]) {
    let named = std::env::var_os("RIGPROOF_FIREFOX").map(PathBuf::from);
    let firefox = named
        .clone()
        .unwrap_or_else(|| "/usr/bin/firefox-esr".into());
    if named.is_none() && !firefox.exists() {
        println!("passed over: there is no Firefox at /usr/bin/firefox-esr");
        return;
    }
    runs(tools, "smoke.mjs", &firefox, pages, None);
}

fn runs(tools: &Path, script: &str, browser: &Path, pages: &[String], drop: Option<String>) {
    let check = tools.join(script);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../report/browser");
    std::fs::copy(source.join(script), &check).unwrap();
    let mut command = Command::new("node");
    command.arg(&check).arg(browser).args(pages);
    if let Some(drop) = drop {
        command.env("RIGPROOF_DROP", drop);
    }
    let answer = command.output().unwrap();
    let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(
        answer.status.success(),
        "{}{}",
        words(&answer.stdout),
        words(&answer.stderr)
    );
    println!("{}", words(&answer.stdout));
}

/// What would run if a name that comes out of a file were not escaped.
const HOSTILE: &str =
    "</script><img src=x onerror=window.hacked=1><script>window.hacked=1</script>";

#[test]
fn pages_hold_in_a_browser() {
    let Some(tools) = tools() else { return };
    let desk = Desk::new();
    desk.prints("demo", 0);
    desk.prints("blind make --plant rig --seed 9 --out case", 0);
    desk.prints(
        "diagnose case/recording.csv --rig case/rig.toml --out found",
        0,
    );
    // The same recording with names that attack, and one that cannot be used.
    let rig = desk.read("rigproof-demo/rig.toml");
    let named = rig.replacen("blind axis 48", HOSTILE, 1);
    assert_ne!(named, rig);
    desk.put("hostile.toml", &named);
    let recording = desk.read("rigproof-demo/recording.csv");
    desk.put("<img src=x onerror=window.hacked=1>.csv", &recording);
    let line = [
        "diagnose",
        "<img src=x onerror=window.hacked=1>.csv",
        "--rig",
        "hostile.toml",
        "--out",
        "hostile",
    ];
    assert_eq!(desk.runs(&line).status.code(), Some(0));
    desk.prints(
        "blind make --plant axis --seed 5 --stratum nothing --out nothing",
        0,
    );
    desk.rigproof("diagnose nothing/recording.csv --rig nothing/rig.toml --out agreed");
    desk.rigproof("diff rigproof-demo hostile --html compared.html");
    let short: Vec<&str> = recording.lines().take(40).collect();
    desk.put("short.csv", &short.join("\n"));
    assert_eq!(
        desk.rigproof("diagnose short.csv --rig hostile.toml --out short")
            .status
            .code(),
        Some(1)
    );
    desk.rigproof("blind trial --seeds 4..8 --html trial.html");
    desk.rigproof("reproduce 3.3 4.7 --html thesis.html");
    desk.put(
        "certify.toml",
        "name = \"<b>soft</b>\"\n[controller]\nkind = \"proportional\"\ngain_n_s_per_m = 400\n[baseline]\nnamed = \"proportional_low\"\n",
    );
    desk.rigproof("certify certify.toml --scenarios 4 --seconds 0.3 --out certified");
    let pages = [
        "rigproof-demo/report.html",
        "found/report.html",
        "hostile/report.html",
        "short/report.html",
        "agreed/report.html",
        "compared.html",
        "trial.html",
        "thesis.html",
        "thesis-chapter-4.html",
        "certified/certificate.html",
    ];
    let pages = pages.map(|page| desk.path(page).display().to_string());
    holds(&tools, &pages, None);
    holds_in_another_engine(&tools, &pages);
    served(&tools, &desk);
}

/// What `serve` shows of the same runs, while a recording comes.
fn served(tools: &Path, desk: &Desk) {
    std::fs::create_dir(desk.path("runs")).unwrap();
    for (from, to) in [
        ("rigproof-demo", "demo"),
        ("found", "found"),
        ("hostile", "<b>hostile"),
        ("certified", "certified"),
    ] {
        std::fs::rename(desk.path(from), desk.path(&format!("runs/{to}"))).unwrap();
    }
    let served = Served::begin(desk, &["runs", "--rig", "runs/demo/rig.toml"]);
    let pages = [
        "",
        "compare?one=demo&other=%3Cb%3Ehostile",
        "compare?one=found&other=certified",
    ];
    let pages = pages.map(|page| format!("http://{}/{page}", served.address));
    let drop = ["runs/demo/recording.csv", "runs/today.csv"].map(|file| desk.path(file));
    holds(tools, &pages, Some(drop));
}
