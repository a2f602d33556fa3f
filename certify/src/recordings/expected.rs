//! This file reads what `certify.toml` states of a replay: the path that the rig kept to, and which differences of the commands are meant.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_trace::TraceError;
use rigproof_trace::rig::table::Table;
use serde::Serialize;

use crate::controller::Task;
use crate::way::{MOST_PIECES, Way};

/// Differences that are meant. What is not stated is not bounded, but every statement has to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Expected {
    /// The brakes whose commands may differ, in the order A, E, B, C.
    pub brakes: Option<[bool; 4]>,
    /// By how much a command may differ, A.
    pub most_a: Option<f64>,
    /// In which share of a recording's samples commands may differ.
    pub most_share: Option<f64>,
    /// Whether the same brakes have to act, each with another current.
    pub same_brakes: bool,
}

/// Why a difference is not meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "`words` says what each is")]
pub enum Unmeant {
    NothingExpected,
    AnotherBrake,
    TooMuch,
    OtherBrakesAct,
}

impl Unmeant {
    /// In words.
    pub const fn words(self) -> &'static str {
        match self {
            Unmeant::NothingExpected => "no difference is expected",
            Unmeant::AnotherBrake => "a brake differs that is not expected to",
            Unmeant::TooMuch => "a command differs by more than `most_a`",
            Unmeant::OtherBrakesAct => "other brakes act than before",
        }
    }
}

impl Expected {
    /// Why the difference of two commands, A, that are not the same is not meant; `None` where it is.
    pub fn unmeant(&self, old_a: [f64; 4], new_a: [f64; 4]) -> Option<Unmeant> {
        let pairs = old_a.into_iter().zip(new_a);
        let may_differ = self.brakes.unwrap_or([true; 4]);
        let mut each = pairs.clone().zip(may_differ);
        if each.any(|((old, new), may)| old.to_bits() != new.to_bits() && !may) {
            return Some(Unmeant::AnotherBrake);
        }
        let most_a = self.most_a.unwrap_or(f64::INFINITY);
        // What is no number is more than anything.
        let is_within = |(old, new): (f64, f64)| (new - old).abs() <= most_a;
        if !pairs.clone().all(is_within) {
            return Some(Unmeant::TooMuch);
        }
        let is_other = |(old, new): (f64, f64)| (old == 0.0) != (new == 0.0);
        (self.same_brakes && pairs.into_iter().any(is_other)).then_some(Unmeant::OtherBrakesAct)
    }

    /// Whether commands may differ in so many of so many samples.
    pub fn allows(&self, differing: usize, samples: usize) -> bool {
        let share = self.most_share.unwrap_or(1.0);
        differing as f64 <= share * samples as f64
    }

    /// Reads the table.
    ///
    /// # Errors
    /// A key is unknown or a value is outside its range, or nothing is stated.
    pub fn read(table: &Table<'_>) -> Result<Expected, TraceError> {
        table.only(&["brakes", "most_a", "most_share", "same_brakes"])?;
        let optional = |key: &str, greatest: f64| match table.number(key)? {
            Some(value) if !(0.0..=greatest).contains(&value) => {
                let problem = format!("`{key}` is {value}; give a number from 0 to {greatest}");
                Err(table.error_at(key, problem))
            }
            value => Ok(value),
        };
        let expected = Expected {
            brakes: table
                .text("brakes")?
                .map(|own| brakes(table, own))
                .transpose()?,
            most_a: optional("most_a", GREATEST_CURRENT_A)?,
            most_share: optional("most_share", 1.0)?,
            same_brakes: table.flag("same_brakes")?.unwrap_or(false),
        };
        if expected == Expected::default() {
            let problem =
                "it states nothing: add `brakes`, `most_a`, `most_share` or `same_brakes = true`";
            return Err(table.error(problem));
        }
        Ok(expected)
    }
}

/// Joints by their letters, such as "A E".
fn brakes(table: &Table<'_>, text: &str) -> Result<[bool; 4], TraceError> {
    let mut named = [false; 4];
    for letter in text.split([' ', ',']).filter(|letter| !letter.is_empty()) {
        let place = Joint::ALL
            .into_iter()
            .position(|own| own.letter() == letter);
        match place.and_then(|place| named.get_mut(place)) {
            Some(named) => *named = true,
            None => {
                let problem = format!("`{letter}` is no brake; write letters such as \"A E\"");
                return Err(table.error_at("brakes", problem));
            }
        }
    }
    Ok(named)
}

/// Reads the path that the rig kept to in the recordings.
///
/// # Errors
/// A key is unknown or missing, or no path comes of it.
pub fn path(table: &Table<'_>) -> Result<Task, TraceError> {
    let number = |key: &str| table.need(key, table.number(key)?);
    let task = match table.need("kind", table.text("kind")?)? {
        "arc" => {
            table.only(&[
                "kind",
                "centre_x_m",
                "centre_y_m",
                "radius_m",
                "from_rad",
                "to_rad",
            ])?;
            Task::Arc {
                centre_m: [number("centre_x_m")?, number("centre_y_m")?],
                radius_m: number("radius_m")?,
                from_rad: number("from_rad")?,
                to_rad: number("to_rad")?,
            }
        }
        kind @ ("chain" | "spline") => {
            table.only(&["kind", "point"])?;
            let points = table.tables("point")?;
            let points = points.iter().map(|point| {
                point.only(&["x_m", "y_m"])?;
                let at = |key: &str| point.need(key, point.number(key)?);
                Ok([at("x_m")?, at("y_m")?])
            });
            let points = points.collect::<Result<Vec<_>, TraceError>>()?;
            match kind {
                "chain" => Task::Chain(points),
                _ => Task::Spline(points),
            }
        }
        other => {
            let problem = format!("`{other}` is no kind of path; write chain, spline or arc");
            return Err(table.error_at("kind", problem));
        }
    };
    match Way::new(&task) {
        Some(_) => Ok(task),
        None => Err(table.error(format!(
            "no path comes of it: a chain or a spline has 2 to {} points [[path.point]], each away from the next, an arc a radius",
            MOST_PIECES + 1
        ))),
    }
}
