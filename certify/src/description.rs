//! This file reads `certify.toml`: the controller, the baseline, the layouts and the limits. What it does not know it refuses.

mod asked;
pub mod schema;

use std::path::Path;

use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method};
use rigproof_spec::settings::{
    BOUNDARY_RANGE_M, DAMPING_RANGE_N_S_PER_M, HORIZON_RANGE_S, PROPORTIONAL_GAIN_RANGE_N_S_PER_M,
    RATIO_GAIN_RANGE_NM_S_PER_RAD, STIFFNESS_RANGE_N_PER_M, WEIGHT_RANGE,
};
use rigproof_trace::TraceError;
use rigproof_trace::rig::table::{Source, Table};
use rigproof_trace::suggest::advice;

use self::asked::{least_met, requirements};
use crate::built_in::{BuiltIn, Kind};
use crate::controller::Task;
use crate::declared::{Choice, Declared, EVERY, Solid};
use crate::metrics::{METRICS, Metric};
use crate::recordings::expected::{Expected, path};
use crate::requirement::Asked;
use crate::scenario::Rig;

/// What a description says.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// What people call the change.
    pub name: String,
    /// What is to be certified; `None` where the caller brings it.
    pub controller: Option<BuiltIn>,
    /// What a controller that the caller brings says of itself.
    pub declares: Declared,
    /// Of so many samples one is set beside the reference; 1 takes them all.
    pub reference_every: u32,
    /// What is on the rig now.
    pub baseline: Option<BuiltIn>,
    /// The layouts.
    pub rigs: Vec<Rig>,
    /// What 95 of 100 trials must not exceed, in the order of the metrics.
    pub limits: [Option<f64>; METRICS],
    /// By how much the mean may be worse than the baseline's.
    pub regressions: [Option<f64>; METRICS],
    /// In how many trials the premise of every law has to be met at least; `None` for what [`crate::plan::least_met`] says.
    pub least_met: Option<u64>,
    /// What the laboratory asks for, in its own words.
    pub requirements: Vec<Asked>,
    /// The path that the rig kept to in recordings that are replayed.
    pub path: Option<Task>,
    /// Which differences of their commands are meant.
    pub expected: Option<Expected>,
}

/// The reference configurations: the rows of table 6.1.
const NAMED: [(&str, Method); 5] = [
    ("uncontrolled", Method::Uncontrolled),
    ("sdof", Method::Sdof),
    ("sdof_with_gap", Method::SdofWithGap),
    ("proportional_low", Method::ProportionalLow),
    ("proportional_high", Method::ProportionalHigh),
];
/// The kinds of laws, and the parameters of each.
const KINDS: [(&str, &[&str]); 6] = [
    ("uncontrolled", &[]),
    ("sdof", &["boundary_m", "gap_m"]),
    ("proportional", &["boundary_m", "gain_n_s_per_m"]),
    ("velocity_ratio", &["boundary_m", "gain_nm_s_per_rad"]),
    (
        "optimal",
        &["boundary_m", "weight_angle", "weight_energy", "horizon_s"],
    ),
    (
        "impedance",
        &[
            "stiffness_n_per_m",
            "damping_across_n_s_per_m",
            "damping_along_n_s_per_m",
        ],
    ),
];

/// Words for layouts.
const LAYOUTS: [&str; 3] = ["both", "three_brake", "four_brake"];

/// Within which a parameter of a law lies.
fn range(parameter: &str) -> [f64; 2] {
    match parameter {
        "boundary_m" => BOUNDARY_RANGE_M,
        "gap_m" => [0.0, BOUNDARY_RANGE_M[1]],
        "gain_n_s_per_m" => PROPORTIONAL_GAIN_RANGE_N_S_PER_M,
        "gain_nm_s_per_rad" => RATIO_GAIN_RANGE_NM_S_PER_RAD,
        "weight_angle" | "weight_energy" => WEIGHT_RANGE,
        "horizon_s" => HORIZON_RANGE_S,
        "stiffness_n_per_m" => STIFFNESS_RANGE_N_PER_M,
        _ => DAMPING_RANGE_N_S_PER_M,
    }
}

impl Description {
    /// Reads a description; `origin` is the file that messages name.
    ///
    /// # Errors
    /// The text is no TOML, a key is unknown or missing, or a number is out of its range; the message gives line and column.
    pub fn parse(text: &str, origin: &Path) -> Result<Description, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&[
            "name",
            "layout",
            "controller",
            "baseline",
            "declares",
            "reference_every",
            "limits",
            "regressions",
            "coverage",
            "requirement",
            "path",
            "expected",
        ])?;
        let rigs = match root.text("layout")? {
            None | Some("both") => vec![Rig::ThreeBrake, Rig::FourBrake],
            Some("three_brake") => vec![Rig::ThreeBrake],
            Some("four_brake") => vec![Rig::FourBrake],
            Some(other) => return Err(unknown(&root, "layout", other, &LAYOUTS)),
        };
        let law = |key: &str| root.table(key)?.map(|table| controller(&table)).transpose();
        let (controller, declares) = (law("controller")?, root.table("declares")?);
        if let (Some(_), Some(declares)) = (&controller, &declares) {
            return Err(declares.error(
                "a law of the rig declares nothing: its kind says it; take `declares` away, or `controller`",
            ));
        }
        if let (Some(worse), None) = (root.table("regressions")?, root.table("baseline")?) {
            return Err(worse.error(
                "nothing stands beside the controller: add a table [baseline], or take [regressions] away",
            ));
        }
        let metrics = |key: &str| match root.table(key)? {
            Some(table) => limits(&table),
            None => Ok([None; METRICS]),
        };
        Ok(Description {
            name: root.text("name")?.unwrap_or("controller").to_owned(),
            controller,
            declares: declares.map_or(Ok(Declared::default()), |table| declared(&table))?,
            reference_every: reference_every(&root)?,
            baseline: law("baseline")?,
            rigs,
            limits: metrics("limits")?,
            regressions: metrics("regressions")?,
            least_met: least_met(&root)?,
            requirements: requirements(&root)?,
            path: root.table("path")?.map(|table| path(&table)).transpose()?,
            expected: root
                .table("expected")?
                .map(|table| Expected::read(&table))
                .transpose()?,
        })
    }
}

fn unknown(table: &Table<'_>, key: &str, word: &str, words: &[&str]) -> TraceError {
    let advice = advice(word, "words", words);
    table.error_at(key, format!("`{word}` is no {key}; {advice}"))
}

fn controller(table: &Table<'_>) -> Result<BuiltIn, TraceError> {
    if let Some(name) = table.text("named")? {
        table.only(&["named", "obstacle"])?;
        let row = NAMED.into_iter().find(|(known, _)| *known == name);
        let Some((_, method)) = row else {
            return Err(unknown(table, "named", name, &NAMED.map(|(name, _)| name)));
        };
        return Ok(BuiltIn {
            obstacle: side(table)?,
            ..BuiltIn::of(method)
        });
    }
    let kind = table.need("kind", table.text("kind")?)?;
    let row = KINDS.into_iter().find(|(known, _)| *known == kind);
    let Some((_, parameters)) = row else {
        return Err(unknown(table, "kind", kind, &KINDS.map(|(name, _)| name)));
    };
    let mut known = vec!["kind", "obstacle"];
    known.extend(parameters);
    table.only(&known)?;
    let boundary_m = match table.has("boundary_m") {
        true => ranged(table, "boundary_m", range("boundary_m"))?,
        false => BLEND_BOUNDARY_M,
    };
    Ok(BuiltIn {
        law: law(table, kind, boundary_m)?,
        boundary_m,
        obstacle: side(table)?,
    })
}

fn law(table: &Table<'_>, kind: &str, boundary_m: f64) -> Result<Kind, TraceError> {
    let number = |key: &str| ranged(table, key, range(key));
    Ok(match kind {
        "sdof" => Kind::Sdof {
            gap_m: ranged(table, "gap_m", [0.0, boundary_m])?,
        },
        "proportional" => Kind::Proportional {
            gain_n_s_per_m: number("gain_n_s_per_m")?,
        },
        "velocity_ratio" => Kind::VelocityRatio {
            gain_nm_s_per_rad: number("gain_nm_s_per_rad")?,
        },
        "optimal" => Kind::Optimal {
            weight_angle: number("weight_angle")?,
            weight_energy: number("weight_energy")?,
            horizon_s: number("horizon_s")?,
        },
        "impedance" => Kind::Impedance {
            stiffness_n_per_m: number("stiffness_n_per_m")?,
            damping_across_n_s_per_m: number("damping_across_n_s_per_m")?,
            damping_along_n_s_per_m: number("damping_along_n_s_per_m")?,
        },
        _ => Kind::Uncontrolled,
    })
}

/// A number that must be there, inside a range.
fn ranged(table: &Table<'_>, key: &str, [least, most]: [f64; 2]) -> Result<f64, TraceError> {
    let value = table.need(key, table.number(key)?)?;
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    Err(table.error_at(
        key,
        format!("`{key}` is {value}; give a number from {least} to {most}"),
    ))
}

fn side(table: &Table<'_>) -> Result<Option<Solid>, TraceError> {
    match table.text("obstacle")? {
        None => Ok(None),
        Some("left") => Ok(Some(Solid::Left)),
        Some("right") => Ok(Some(Solid::Right)),
        Some(other) => Err(unknown(table, "obstacle", other, &["left", "right"])),
    }
}

/// A sample of so many, at the rarest.
const MOST_EVERY: u32 = 1_000_000;

fn reference_every(root: &Table<'_>) -> Result<u32, TraceError> {
    if !root.has("reference_every") {
        return Ok(EVERY);
    }
    let every = ranged(root, "reference_every", [1.0, f64::from(MOST_EVERY)])?;
    if every.fract() != 0.0 {
        let problem =
            format!("`reference_every` is {every}; give a whole number from 1 to {MOST_EVERY}");
        return Err(root.error_at("reference_every", problem));
    }
    Ok(every as u32)
}

fn declared(table: &Table<'_>) -> Result<Declared, TraceError> {
    table.only(&[
        "most_brakes",
        "locks",
        "gap_m",
        "boundary_m",
        "choice",
        "within_force",
        "obstacle",
    ])?;
    let optional = |key: &str, range: [f64; 2]| match table.has(key) {
        true => ranged(table, key, range).map(Some),
        false => Ok(None),
    };
    let choice = match table.text("choice")? {
        None => None,
        Some("influence") => Some(Choice::Influence),
        Some("quarter_turn") => Some(Choice::QuarterTurn),
        Some(other) => {
            return Err(unknown(
                table,
                "choice",
                other,
                &["influence", "quarter_turn"],
            ));
        }
    };
    let most_brakes = match optional("most_brakes", [0.0, 4.0])? {
        Some(most) if most.fract() != 0.0 => {
            let problem = format!("`most_brakes` is {most}; give a whole number from 0 to 4");
            return Err(table.error_at("most_brakes", problem));
        }
        most => most.map(|most| most as u8),
    };
    let boundary_m = optional("boundary_m", range("boundary_m"))?;
    let locks = table.flag("locks")?;
    for (key, needs_it) in [("locks", locks == Some(true)), ("choice", choice.is_some())] {
        if needs_it && boundary_m.is_none() {
            let problem = format!("`{key}` is judged by the velocity field: add `boundary_m`");
            return Err(table.error_at(key, problem));
        }
    }
    Ok(Declared {
        most_brakes,
        locks,
        gap_m: optional("gap_m", range("gap_m"))?,
        boundary_m,
        choice,
        within_force: table.flag("within_force")?.unwrap_or(false),
        solid: side(table)?,
        reference: None,
    })
}

/// More than any metric of a rig comes to.
const GREATEST_LIMIT: f64 = 1e12;

fn limits(table: &Table<'_>) -> Result<[Option<f64>; METRICS], TraceError> {
    let keys = Metric::ALL.map(Metric::key);
    table.only(&keys)?;
    let mut limits = [None; METRICS];
    for (limit, key) in limits.iter_mut().zip(keys) {
        *limit = match table.has(key) {
            true => Some(ranged(table, key, [0.0, GREATEST_LIMIT])?),
            false => None,
        };
    }
    Ok(limits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Description, String> {
        Description::parse(text, Path::new("certify.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_description_is_read() {
        let read = parse(
            "name = \"softer\"\nlayout = \"four_brake\"\n[controller]\nkind = \"proportional\"\ngain_n_s_per_m = 310\n\
             [baseline]\nnamed = \"sdof_with_gap\"\n[regressions]\ntip_force_n = 0.7\n",
        )
        .unwrap();
        let gain_n_s_per_m = 310.0;
        assert_eq!(
            read.controller.unwrap().law,
            Kind::Proportional { gain_n_s_per_m }
        );
        assert_eq!(read.baseline.unwrap().law, Kind::Sdof { gap_m: 0.005 });
        assert_eq!(read.rigs, [Rig::FourBrake]);
        assert_eq!(read.regressions, [None, Some(0.7), None, None, None]);
    }

    #[test]
    fn what_is_unknown_is_refused_with_its_place_and_the_names() {
        for (text, place, words) in [
            (
                "[controler]\n",
                "line 1, column 2",
                "did you mean `controller`",
            ),
            (
                "[controller]\nkind = \"sdof\"\ngain_n_s_per_m = 3\n",
                "line 3",
                "`gap_m`",
            ),
            (
                "[controller]\nkind = \"pid\"\n",
                "line 2, column 8",
                "velocity_ratio",
            ),
            (
                "[controller]\nnamed = \"low\"\n",
                "line 2",
                "proportional_low",
            ),
            (
                "[controller]\nkind = \"sdof\"\ngap_m = 0.3\n",
                "line 3",
                "from 0 to 0.05",
            ),
            (
                "[controller]\nkind = \"sdof\"\n",
                "line 1",
                "`gap_m` is missing",
            ),
            ("[limits]\npath_error_cm = 1\n", "line 2", "path_error_m"),
            ("layout = \"five\"\n", "line 1", "three_brake"),
            ("[declares]\nmost_brakes = 1.5\n", "line 2", "whole number"),
            (
                "[controller]\nnamed = \"sdof\"\n[declares]\nlocks = true\n",
                "line 3",
                "kind says it",
            ),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.starts_with("certify.toml, line"), "{message}");
            assert!(
                message.contains(place) && message.contains(words),
                "{message}"
            );
        }
    }
}
