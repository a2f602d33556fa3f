//! This file is a brake or damper of any kind in a rig description: the effort at which it settles over its command,
//! and how fast it follows.

use rigproof_spec::units::{Dimension, Unit};

use super::Value;
use super::read::read_value;
use super::table::Table;
use super::write::{string, value};
use crate::error::TraceError;

/// The static characteristic of a brake, with its time constants, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Characteristic {
    /// Command and settled effort, at least two, by growing command.
    pub points: Vec<[f64; 2]>,
    /// Time constant of a growing effort, s; nothing follows at once.
    pub rising: Option<Value>,
    /// Time constant of a falling effort, s; the rising one where there is none.
    pub falling: Option<Value>,
}

impl Characteristic {
    /// Reads `[characteristic]`: two lists of numbers with their units, and time constants.
    pub(super) fn read(
        root: &Table<'_>,
        dimensions: [Option<Dimension>; 2],
    ) -> Result<Option<Characteristic>, TraceError> {
        let Some(table) = root.table("characteristic")? else {
            return Ok(None);
        };
        table.only(&["command", "effort", "rising", "falling"])?;
        let [Some(driving), Some(effort)] = dimensions else {
            return Err(table.error(
                "a characteristic belongs to a bench with a `command` or `current` channel; add the channel or leave it out",
            ));
        };
        let commands = read_list(&table, "command", driving)?;
        let efforts = read_list(&table, "effort", effort)?;
        if commands.len() != efforts.len() || commands.len() < 2 {
            let problem = format!(
                "{} commands and {} efforts; give as many of both, at least 2",
                commands.len(),
                efforts.len()
            );
            return Err(table.error_at("effort", problem));
        }
        if let Some([low, high]) = pairs(&commands).find(|[low, high]| low >= high) {
            let problem = format!("{high} {driving} comes after {low}; give commands that grow");
            return Err(table.error_at("command", problem));
        }
        if let Some(least) = efforts.iter().find(|own| **own < 0.0) {
            let problem = format!("an effort of {least} {effort}; a brake resists with 0 or more");
            return Err(table.error_at("effort", problem));
        }
        let time = |key: &str| {
            let own = read_value(&table, key, Dimension::TIME)?;
            match own {
                Some(own) if own.value < 0.0 => {
                    let problem = format!("`{key}` is {} s; it must be 0 or above", own.value);
                    Err(table.error_at(key, problem))
                }
                own => Ok(own),
            }
        };
        let each = commands.into_iter().zip(efforts);
        Ok(Some(Characteristic {
            points: each.map(|(command, effort)| [command, effort]).collect(),
            rising: time("rising")?,
            falling: time("falling")?,
        }))
    }

    pub(super) fn lines(&self, [driving, effort]: [Dimension; 2]) -> Vec<String> {
        let list = |key: &str, place: usize, unit: Dimension| {
            let own = self.points.iter().filter_map(|point| point.get(place));
            let own: Vec<String> = own.map(|number| format!("{number:?}")).collect();
            let unit = string(&unit.to_string());
            format!("{key} = {{ points = [{}], unit = {unit} }}", own.join(", "))
        };
        let mut lines = vec![
            "\n[characteristic]".to_owned(),
            list("command", 0, driving),
            list("effort", 1, effort),
        ];
        let times = [("rising", &self.rising), ("falling", &self.falling)];
        for (key, time) in times {
            let time = time.as_ref();
            lines.extend(time.map(|own| format!("{key} = {}", value(own, Dimension::TIME))));
        }
        lines
    }
}

/// Neighbours in a list.
fn pairs(numbers: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    let next = numbers.iter().skip(1);
    numbers.iter().zip(next).map(|(own, next)| [*own, *next])
}

/// A list of numbers with one unit, in SI.
fn read_list(table: &Table<'_>, key: &str, expected: Dimension) -> Result<Vec<f64>, TraceError> {
    let own = table.need(key, table.table(key)?)?;
    own.only(&["points", "unit"])?;
    let text = own.need("unit", own.text("unit")?)?;
    let fits = |unit: &Unit| unit.dimension == expected;
    let unit = Unit::parse(text).filter(fits).ok_or_else(|| {
        let problem =
            format!("`{text}` does not convert to `{expected}`; give a unit of that kind");
        own.error_at("unit", problem)
    })?;
    let points = own.need("points", own.numbers("points")?)?;
    Ok(points.into_iter().map(|own| own * unit.to_si).collect())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::rig::Rig;

    const RIG: &str = r#"name = "damper"
plant = "bench"
motion = "linear"
[channels]
position = { channel = "x", unit = "mm" }
force = { channel = "f", unit = "N" }
command = { channel = "u", unit = "V" }
[characteristic]
command = { points = [0, 500, 2000], unit = "mV" }
effort = { points = [0.02, 0.06, 0.1], unit = "kN" }
rising = { value = 30, unit = "ms" }
[[effect]]
mechanism = "saturation"
limit = { value = 1.5, unit = "V" }
"#;

    fn parse(text: &str) -> Result<Rig, String> {
        Rig::parse(text, Path::new("rig.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_damper_under_volts_is_read_and_written_back() {
        let rig = parse(RIG).unwrap();
        assert_eq!(parse(&rig.to_toml()).unwrap(), rig);
        let own = rig.characteristic.unwrap();
        assert_eq!(own.points, [[0.0, 20.0], [0.5, 60.0], [2.0, 100.0]]);
        assert_eq!(own.rising.unwrap().value, 0.03);
        assert!(own.falling.is_none());
    }

    #[test]
    fn a_characteristic_that_no_brake_can_have_is_refused() {
        for (text, with, expected) in [
            (
                "[0, 500, 2000]",
                "[0, 500]",
                "2 commands and 3 efforts; give as many",
            ),
            (
                "[0, 500, 2000]",
                "[0, 500, 500]",
                "0.5 V comes after 0.5; give commands that grow",
            ),
            (
                "[0, 500, 2000]",
                "[0, \"a\", 1]",
                "`points` holds something of type string; give numbers",
            ),
            ("\"mV\"", "\"mA\"", "`mA` does not convert to `V`"),
            (
                "0.02",
                "-0.02",
                "an effort of -20 N; a brake resists with 0 or more",
            ),
            ("value = 30", "value = -30", "`rising` is -0.03 s"),
            (
                "rising",
                "raising",
                "`raising` is no key of `characteristic`",
            ),
            (
                "command = { channel",
                "simulated = { channel",
                "`V` does not convert to `N`",
            ),
            (
                "command = { channel = \"u\", unit = \"V\" }",
                "",
                "a characteristic belongs to a bench with a `command`",
            ),
            (
                "[characteristic]",
                "current = { channel = \"i\", unit = \"A\" }\n[characteristic]",
                "`command` and `current` are the same role",
            ),
            (
                "limit = { value = 1.5, unit = \"V\" }",
                "limit = { value = 1.5, unit = \"A\" }",
                "`A` does not convert to `V`",
            ),
        ] {
            let message = parse(&RIG.replacen(text, with, 1)).unwrap_err();
            assert!(message.contains(expected), "{message} lacks {expected}");
        }
        let own = RIG.find("[characteristic]").unwrap();
        let message = parse(&RIG[..own]).unwrap_err();
        assert!(message.contains("`characteristic` is missing"), "{message}");
    }
}
