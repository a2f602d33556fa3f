//! This file holds mistakes of a first time: each ends in a message that says what to do, and lost samples in a line of the protocol.

use std::sync::OnceLock;

use crate::desk::Desk;

/// What the program lays out for a newcomer, in folders `axis` and `rig`; made once.
fn laid_out() -> &'static Desk {
    static DESK: OnceLock<Desk> = OnceLock::new();
    DESK.get_or_init(|| {
        let desk = Desk::new();
        desk.prints("new axis", 0);
        desk.prints("new rig --plant rig", 0);
        desk
    })
}

/// A desk with the recording and the description of a plant, the latter with `old` replaced by `new`.
fn desk(plant: &str, old: &str, new: &str) -> Desk {
    let desk = Desk::new();
    let rig = laid_out().read(&format!("{plant}/rig.toml"));
    assert!(rig.contains(old), "{rig}");
    desk.put("rig.toml", &rig.replace(old, new));
    desk.put(
        "run.csv",
        &laid_out().read(&format!("{plant}/recording.csv")),
    );
    desk
}

/// Rewrites the rows of the recording that counts, below its head.
fn rewrite(desk: &Desk, row: impl Fn(&mut Vec<String>)) {
    let text = desk.read("run.csv");
    let (head, rows) = text.split_once('\n').unwrap();
    let rows = rows.lines().take(9000).map(|line| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        row(&mut cells);
        cells.join(",") + "\n"
    });
    desk.put("run.csv", &format!("{head}\n{}", rows.collect::<String>()));
}

fn scale(cell: &mut String, factor: f64) {
    if let Ok(number) = cell.parse::<f64>() {
        *cell = (number * factor).to_string();
    }
}

/// Runs a diagnosis that must end with `code` and say all of `expected`.
fn says(desk: &Desk, line: &str, code: i32, expected: &[&str]) {
    let answer = desk.rigproof(line);
    let said = [answer.stdout, answer.stderr].concat();
    let said = String::from_utf8(said).unwrap();
    assert_eq!(answer.status.code(), Some(code), "{line}: {said}");
    for part in expected {
        assert!(said.contains(part), "{line} says {said}, not {part}");
    }
}

const DIAGNOSE: &str = "diagnose run.csv --rig rig.toml --out found --verbose";

#[test]
fn the_wrong_folder() {
    let desk = desk("axis", "axis", "axis");
    let missing = ["cannot read lab/run.csv", "check the path"];
    says(&desk, "diagnose lab/run.csv --rig rig.toml", 3, &missing);
    std::fs::create_dir(desk.path("empty")).unwrap();
    let empty = ["no recording is in this folder", ".csv, .txt, .mcap"];
    says(&desk, "diagnose empty --rig rig.toml", 3, &empty);
}

#[test]
fn the_wrong_column_name() {
    let desk = desk("axis", "channel = \"position\"", "channel = \"postion\"");
    let expected = [
        "`postion`",
        "correct the rig file",
        "did you mean `position`?",
    ];
    says(&desk, DIAGNOSE, 3, &expected);
}

#[test]
fn degrees_for_radians() {
    let axis = desk("axis", "axis", "axis");
    rewrite(&axis, |cells| scale(&mut cells[1], 1f64.to_degrees()));
    let expected = ["57.", "degrees, described as radians", "correct `unit`"];
    says(&axis, DIAGNOSE, 1, &expected);
    let rig = desk("rig", "rig", "rig");
    rewrite(&rig, |cells| {
        for angle in &mut cells[1..3] {
            scale(angle, 1f64.to_degrees());
        }
    });
    let expected = ["57.", "degrees, described as radians"];
    says(&rig, DIAGNOSE, 1, &expected);
}

#[test]
fn milliseconds_for_seconds() {
    for plant in ["axis", "rig"] {
        let desk = desk(plant, plant, plant);
        rewrite(&desk, |cells| scale(&mut cells[0], 1000.0));
        let expected = ["milliseconds", "unit = \"ms\""];
        says(&desk, DIAGNOSE, 1, &expected);
    }
}

#[test]
fn swapped_channels() {
    let axis = desk("axis", "axis", "axis");
    rewrite(&axis, |cells| cells.swap(1, 2));
    says(&axis, DIAGNOSE, 1, &["the two channels are swapped"]);
    let angles = desk("rig", "rig", "rig");
    rewrite(&angles, |cells| cells.swap(1, 2));
    says(&angles, DIAGNOSE, 1, &["theta_a and theta_b swapped"]);
    let forces = desk("rig", "rig", "rig");
    rewrite(&forces, |cells| cells.swap(3, 4));
    says(
        &forces,
        DIAGNOSE,
        1,
        &["force_x and force_y swapped", "its own column"],
    );
}

#[test]
fn a_missing_layout() {
    let desk = desk("rig", "layout = \"three_brake\"\n", "");
    let expected = [
        "`layout` is missing",
        "`layout = \"three_brake\"` or `layout = \"four_brake\"`",
    ];
    says(&desk, DIAGNOSE, 3, &expected);
}

#[test]
fn milliampere_for_ampere_and_a_negative_current() {
    for (factor, shown) in [(1000.0, "0 to 1 A"), (-1.0, "is -0.")] {
        let desk = desk("rig", "rig", "rig");
        rewrite(&desk, |cells| {
            cells[5..].iter_mut().for_each(|cell| scale(cell, factor))
        });
        says(
            &desk,
            DIAGNOSE,
            1,
            &[
                shown,
                "a brake takes 0 to 1 A",
                "check the unit (mA?) and the sign",
            ],
        );
    }
}

/// No mistake, if the decimal comma came with it: it is read, and how is said.
#[test]
fn semicolons() {
    let desk = desk("axis", "axis", "axis");
    let text = desk.read("run.csv").replace(',', ";").replace('.', ",");
    desk.put("run.csv", &text);
    says(&desk, "inspect run.csv", 0, &["separator ';', decimal ','"]);
    says(
        &desk,
        "inspect run.csv --separator ,",
        3,
        &["one column", "leave --separator away"],
    );
}

#[test]
fn the_wrong_order_of_joints() {
    let desk = desk("rig", "rig", "rig");
    rewrite(&desk, |cells| cells[5..].rotate_left(1));
    let expected = ["taken for those of", "correct the columns of the currents"];
    says(&desk, DIAGNOSE, 1, &expected);
}

#[test]
fn nothing_held_out() {
    let desk = desk("axis", "axis", "axis");
    let none = format!("{DIAGNOSE} --hold-out-share 0");
    says(&desk, &none, 2, &["give a share from 0.05 to 0.8"]);
    let itself = format!("{DIAGNOSE} --hold-out run.csv");
    says(
        &desk,
        &itself,
        3,
        &[
            "one of the recordings that are fitted",
            "leave --hold-out away",
        ],
    );
}

#[test]
fn a_typo_in_a_verb() {
    let desk = Desk::new();
    says(&desk, "diagonse run.csv", 2, &["'diagonse'", "'diagnose'"]);
}

#[test]
fn lost_samples() {
    for plant in ["axis", "rig"] {
        let desk = desk(plant, plant, plant);
        let row = std::cell::Cell::new(0);
        rewrite(&desk, |cells| {
            if [1234, 1235].contains(&row.replace(row.get() + 1)) {
                cells[1].clear();
            }
        });
        let answer = desk.rigproof(DIAGNOSE);
        assert!(answer.status.code() < Some(2), "{answer:?}");
        assert!(desk.read("found/report.json").contains("filled in: 2 of "));
    }
}

#[test]
fn a_word_for_a_plant_or_a_mechanism_that_is_none() {
    let robot = desk("axis", "plant = \"axis\"", "plant = \"robot\"");
    let expected = ["`robot` is no plant", "`axis`, `bench`, `rig`, `chain`"];
    says(&robot, DIAGNOSE, 3, &expected);
    let rig = laid_out().read("axis/rig.toml");
    let described = rig.split("mechanism = ").nth(1).unwrap();
    let described = described.lines().next().unwrap();
    let friction = desk("axis", described, "\"friction\"");
    let expected = ["did you mean `dry_offset` (Coulomb friction)", "`viscous`"];
    says(&friction, DIAGNOSE, 3, &expected);
}

#[test]
fn no_rig_description_yet() {
    let desk = desk("axis", "axis", "axis");
    let begins = [
        "--rig <TOML>",
        "rigproof inspect RECORDING --write-rig rig.toml",
    ];
    says(&desk, "diagnose run.csv", 2, &begins);
}

#[test]
fn the_name_of_an_output_says_what_it_is() {
    let desk = desk("axis", "axis", "axis");
    let neither = ["run.xyz", "end it in `.csv` or `.mcap`"];
    says(&desk, "convert run.csv run.xyz", 2, &neither);
    assert_eq!(desk.names("."), ["rig.toml", "run.csv"]);
}
