//! This file is the brake of a rig description: one of the thesis's, somebody's own table, or one with parts of the other.

use rigproof_spec::effect::Motion;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{
    BrakeTable, Edge, GAIN_BREAK_A, TimeConstantFit, TorqueGainFit, brake_table,
};
use rigproof_spec::units::{Dimension, deg_from_rad, rpm_from_rad_s};

use super::read::{choice, read_value};
use super::table::Table;
use super::write::{string, value};
use super::{ChannelMap, Value};
use crate::error::TraceError;

/// A brake: the thesis's table of a joint, with what was identified on the rig in its place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Brake {
    /// The joint whose table of the thesis holds where nothing else is said.
    pub joint: Option<Joint>,
    /// Backlash width, rad (table 3.1).
    pub backlash_width: Option<Value>,
    /// Torque gain (table 3.2).
    pub torque_gain: Option<Gain>,
    /// Rising time constant (table 3.3).
    pub rising: Option<Surface>,
    /// Falling time constant (table 3.3).
    pub falling: Option<Surface>,
}

/// The coefficients of the torque gain (3.3).
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// k1 … k5: N·m/A, N·m, N·m/A², N·m/A, N·m.
    pub k: [Value; 5],
    /// Coefficient of determination.
    pub r_squared: Option<f64>,
    /// The greatest current that was measured, A.
    pub greatest_current: Value,
}

/// The coefficients of a time constant (3.5) or (3.6).
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Mean above the speed threshold, s.
    pub average: Value,
    /// a1 … a6, s/A and s in turn with log2 of rpm; the average holds at every speed where there are none.
    pub a: Option<[Value; 6]>,
    /// Coefficient of determination.
    pub r_squared: Option<f64>,
    /// The lowest and the highest speed that was measured, rad/s.
    pub speed_range: [Value; 2],
    /// The least current that was stepped to, A.
    pub least_current: Value,
}

const GAIN_KEYS: [&str; 5] = ["k_1", "k_2", "k_3", "k_4", "k_5"];
const SURFACE_KEYS: [&str; 6] = ["a_1", "a_2", "a_3", "a_4", "a_5", "a_6"];

impl Brake {
    /// A brake of the thesis.
    pub fn of_thesis(joint: Joint) -> Brake {
        Brake {
            joint: Some(joint),
            ..Brake::default()
        }
    }

    /// The numbers that the model takes; brake A of the thesis stands in for what the rig does not say, which a
    /// description that was read says itself.
    pub fn table(&self) -> BrakeTable {
        let mut table = brake_table(self.joint.unwrap_or(Joint::A));
        if let Some(width) = &self.backlash_width {
            table.backlash_width_deg = deg_from_rad(width.value);
        }
        if let Some(gain) = &self.torque_gain {
            let [k_1, k_2, k_3, k_4, k_5] = gain.k.map(|k| k.value);
            let r_squared = gain.r_squared.unwrap_or(f64::NAN);
            table.torque_gain = TorqueGainFit {
                k_1,
                k_2,
                k_3,
                k_4,
                k_5,
                r_squared,
            };
            let [least_a, _] = table.current_range_a;
            table.current_range_a = [least_a, gain.greatest_current.value];
        }
        let edges = [(&self.rising, Edge::Rising), (&self.falling, Edge::Falling)];
        for (surface, edge) in edges {
            let Some(surface) = surface else { continue };
            match edge {
                Edge::Rising => table.rising = surface.fit(),
                Edge::Falling => table.falling = surface.fit(),
            }
            table.speed_range_rpm = surface.speed_range.map(|v| rpm_from_rad_s(v.value));
            let [_, greatest_a] = table.current_range_a;
            table.current_range_a = [surface.least_current.value, greatest_a];
        }
        table
    }

    pub(super) fn read(
        root: &Table<'_>,
        motion: Motion,
        current: Option<&ChannelMap>,
    ) -> Result<Option<Brake>, TraceError> {
        let Some(table) = root.table("brake")? else {
            return Ok(None);
        };
        table.only(&[
            "joint",
            "backlash_width",
            "torque_gain",
            "rising",
            "falling",
        ])?;
        if motion != Motion::Rotary || current.is_none() {
            return Err(table.error(
                "a brake belongs to a bench with rotary motion and a `current` channel; change these or leave it out",
            ));
        }
        let joint = match table.has("joint") {
            true => Some(choice(&table, "joint", Joint::ALL, Joint::letter)?),
            false => None,
        };
        let brake = Brake {
            joint,
            backlash_width: read_value(&table, "backlash_width", Dimension::ANGLE)?,
            torque_gain: Gain::read(&table)?,
            rising: Surface::read(&table, "rising")?,
            falling: Surface::read(&table, "falling")?,
        };
        brake.check(&table)?;
        Ok(Some(brake))
    }

    /// Refuses a table that leaves something out or that no brake can have.
    fn check(&self, table: &Table<'_>) -> Result<(), TraceError> {
        let missing = [
            ("backlash_width", self.backlash_width.is_none()),
            ("torque_gain", self.torque_gain.is_none()),
            ("rising", self.rising.is_none()),
            ("falling", self.falling.is_none()),
        ];
        if self.joint.is_none()
            && let Some((key, _)) = missing.iter().find(|(_, missing)| *missing)
        {
            return Err(table.error(format!(
                "the brake has no `{key}` and no `joint` whose table of the thesis could stand in; add one"
            )));
        }
        if let Some(width) = &self.backlash_width
            && width.value < 0.0
        {
            let problem = format!(
                "`backlash_width` is {} rad; it must be 0 or above",
                width.value
            );
            return Err(table.error_at("backlash_width", problem));
        }
        let numbers = self.table();
        if numbers.greatest_nm() <= numbers.torque_gain.k_2 {
            return Err(table.error_at(
                "torque_gain",
                format!(
                    "the torque at the greatest current is {} N·m, not above the off-state torque, {} N·m; correct the coefficients",
                    numbers.greatest_nm(),
                    numbers.torque_gain.k_2
                ),
            ));
        }
        for edge in Edge::ALL {
            let least_s = least_time_constant(&numbers, edge);
            if least_s <= 0.0 {
                return Err(table.error_at(
                    edge.name(),
                    format!(
                        "the {} time constant falls to {least_s} s inside the measured range; it must be above 0: leave out a1 to a6 or measure again",
                        edge.name()
                    ),
                ));
            }
        }
        Ok(())
    }

    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = vec!["\n[brake]".to_owned()];
        lines.extend(
            self.joint
                .map(|joint| format!("joint = {}", string(joint.letter()))),
        );
        let width = self.backlash_width.as_ref();
        lines.extend(width.map(|w| format!("backlash_width = {}", value(w, Dimension::ANGLE))));
        lines.extend(self.torque_gain.iter().flat_map(Gain::lines));
        let surfaces = [("rising", &self.rising), ("falling", &self.falling)];
        for (key, surface) in surfaces {
            lines.extend(surface.iter().flat_map(|surface| surface.lines(key)));
        }
        lines
    }
}

impl Gain {
    fn dimensions() -> [Dimension; 5] {
        let per_ampere = Dimension::TORQUE.per(Dimension::CURRENT);
        let torque = Dimension::TORQUE;
        [
            per_ampere,
            torque,
            per_ampere.per(Dimension::CURRENT),
            per_ampere,
            torque,
        ]
    }

    fn read(brake: &Table<'_>) -> Result<Option<Gain>, TraceError> {
        let Some(table) = brake.table("torque_gain")? else {
            return Ok(None);
        };
        let mut known = GAIN_KEYS.to_vec();
        known.extend(["r_squared", "greatest_current"]);
        table.only(&known)?;
        let greatest = read_value(&table, "greatest_current", Dimension::CURRENT)?;
        let greatest_current = table.need("greatest_current", greatest)?;
        if greatest_current.value < GAIN_BREAK_A {
            return Err(table.error_at(
                "greatest_current",
                format!(
                    "`greatest_current` is {} A; it must reach {GAIN_BREAK_A} A, where the quadratic piece begins",
                    greatest_current.value
                ),
            ));
        }
        Ok(Some(Gain {
            k: read_all(&table, GAIN_KEYS, Gain::dimensions())?,
            r_squared: table.number("r_squared")?,
            greatest_current,
        }))
    }

    fn lines(&self) -> Vec<String> {
        let mut lines = vec!["\n[brake.torque_gain]".to_owned()];
        let named = GAIN_KEYS.iter().zip(&self.k).zip(Gain::dimensions());
        lines.extend(named.map(|((key, k), dimension)| format!("{key} = {}", value(k, dimension))));
        let greatest = value(&self.greatest_current, Dimension::CURRENT);
        lines.push(format!("greatest_current = {greatest}"));
        lines.extend(self.r_squared.map(|r| format!("r_squared = {r:?}")));
        lines
    }
}

impl Surface {
    fn dimensions() -> [Dimension; 6] {
        let (time, per_ampere) = (Dimension::TIME, Dimension::TIME.per(Dimension::CURRENT));
        [per_ampere, time, per_ampere, time, per_ampere, time]
    }

    /// The coefficients as the model takes them.
    pub fn fit(&self) -> TimeConstantFit {
        let flat = [0.0, 0.0, 0.0, 0.0, 0.0, self.average.value];
        let [a_1, a_2, a_3, a_4, a_5, a_6] = self.a.map_or(flat, |a| a.map(|a| a.value));
        TimeConstantFit {
            a_avg_s: self.average.value,
            a_1,
            a_2,
            a_3,
            a_4,
            a_5,
            a_6,
            r_squared: self.r_squared.unwrap_or(f64::NAN),
        }
    }

    fn read(brake: &Table<'_>, key: &str) -> Result<Option<Surface>, TraceError> {
        let Some(table) = brake.table(key)? else {
            return Ok(None);
        };
        let mut known = SURFACE_KEYS.to_vec();
        known.extend([
            "average",
            "r_squared",
            "least_speed",
            "greatest_speed",
            "least_current",
        ]);
        table.only(&known)?;
        let speed = Dimension::ANGLE.per(Dimension::TIME);
        let needed = |key: &str, dimension| table.need(key, read_value(&table, key, dimension)?);
        let speed_range = [
            needed("least_speed", speed)?,
            needed("greatest_speed", speed)?,
        ];
        let [least, greatest] = speed_range.map(|v| v.value);
        if least <= 0.0 || greatest < least {
            return Err(table.error_at(
                "least_speed",
                format!(
                    "the speeds run from {least} to {greatest} rad/s; they must grow from above 0"
                ),
            ));
        }
        Ok(Some(Surface {
            average: needed("average", Dimension::TIME)?,
            a: match SURFACE_KEYS.iter().any(|key| table.has(key)) {
                true => Some(read_all(&table, SURFACE_KEYS, Surface::dimensions())?),
                false => None,
            },
            r_squared: table.number("r_squared")?,
            speed_range,
            least_current: needed("least_current", Dimension::CURRENT)?,
        }))
    }

    fn lines(&self, key: &str) -> Vec<String> {
        let average = value(&self.average, Dimension::TIME);
        let mut lines = vec![format!("\n[brake.{key}]"), format!("average = {average}")];
        let named = SURFACE_KEYS
            .iter()
            .zip(self.a.iter().flatten())
            .zip(Surface::dimensions());
        lines.extend(named.map(|((key, a), dimension)| format!("{key} = {}", value(a, dimension))));
        lines.extend(self.r_squared.map(|r| format!("r_squared = {r:?}")));
        let speed = Dimension::ANGLE.per(Dimension::TIME);
        let [least, greatest] = &self.speed_range;
        lines.push(format!("least_speed = {}", value(least, speed)));
        lines.push(format!("greatest_speed = {}", value(greatest, speed)));
        let current = value(&self.least_current, Dimension::CURRENT);
        lines.push(format!("least_current = {current}"));
        lines
    }
}

fn read_all<const N: usize>(
    table: &Table<'_>,
    keys: [&str; N],
    dimensions: [Dimension; N],
) -> Result<[Value; N], TraceError> {
    let mut values = [Value::known(0.0); N];
    for ((key, dimension), slot) in keys.into_iter().zip(dimensions).zip(&mut values) {
        *slot = table.need(key, read_value(table, key, dimension)?)?;
    }
    Ok(values)
}

/// The least value that a surface takes on a fine grid over its range.
fn least_time_constant(table: &BrakeTable, edge: Edge) -> f64 {
    let fit = table.time_constant(edge);
    let [least_l, greatest_l] = table.speed_range_rpm.map(libm::log2);
    let greatest_l = greatest_l.min(libm::log2(edge.threshold_rpm()));
    let mut least_s = fit.a_avg_s;
    if least_l >= greatest_l {
        return least_s;
    }
    for step in 0..400 {
        let l = least_l + (greatest_l - least_l) * f64::from(step) / 400.0;
        // Linear in the current, so the ends decide.
        for i in table.current_range_a {
            let square = (fit.a_4 + fit.a_5 * i) * l * l;
            least_s = least_s.min(fit.a_1 * i + (fit.a_2 + fit.a_3 * i) * l + square + fit.a_6);
        }
    }
    least_s
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    use crate::rig::Rig;

    const RIG: &str = r#"name = "bench"
plant = "bench"
motion = "rotary"
[channels]
position = { channel = "angle", unit = "deg" }
torque = { channel = "torque", unit = "Nm" }
current = { channel = "current", unit = "A" }
[brake]
backlash_width = { value = 1.3, unit = "deg", low95 = 1.1, high95 = 1.5 }
[brake.torque_gain]
k_1 = { value = 5.17, unit = "N·m/A" }
k_2 = { value = 230, unit = "mN·m" }
k_3 = { value = -2.9, unit = "N·m/A^2" }
k_4 = { value = 9.3, unit = "N·m/A" }
k_5 = { value = -0.6, unit = "N·m" }
greatest_current = { value = 1.4, unit = "A" }
r_squared = 0.987
[brake.rising]
average = { value = 7.3, unit = "ms" }
least_speed = { value = 0.7, unit = "rpm" }
greatest_speed = { value = 41, unit = "rpm" }
least_current = { value = 250, unit = "mA" }
[brake.falling]
average = { value = 5.3, unit = "ms" }
a_1 = { value = 1.7, unit = "ms/A" }
a_2 = { value = -0.3, unit = "ms" }
a_3 = { value = -1.6, unit = "ms/A" }
a_4 = { value = 0.5, unit = "ms" }
a_5 = { value = 0.1, unit = "ms/A" }
a_6 = { value = 5.1, unit = "ms" }
least_speed = { value = 0.7, unit = "rpm" }
greatest_speed = { value = 41, unit = "rpm" }
least_current = { value = 250, unit = "mA" }
"#;

    fn parse(text: &str) -> Result<Rig, String> {
        Rig::parse(text, Path::new("rig.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_brake_of_somebodys_own_is_read_and_written_back() {
        let rig = parse(RIG).unwrap();
        assert_eq!(parse(&rig.to_toml()).unwrap(), rig);
        let table = rig.brake.unwrap().table();
        assert!((table.backlash_width_deg - 1.3).abs() < 1e-12);
        // -2.9*1.96 + 9.3*1.4 - 0.6 = 6.736
        assert!((table.greatest_nm() - 6.736).abs() < 1e-12);
        assert!((table.torque_gain.k_2 - 0.23).abs() < 1e-15);
        assert!((table.falling.a_5 - 1e-4).abs() < 1e-18);
        assert_eq!((table.rising.a_1, table.rising.a_6), (0.0, 0.0073));
        assert!((table.speed_range_rpm[1] - 41.0).abs() < 1e-12);
        assert_eq!(table.current_range_a, [0.25, 1.4]);
    }

    #[test]
    fn a_joint_of_the_thesis_stands_in_for_what_is_left_out() {
        let own = RIG.find("[brake.rising]").unwrap();
        let text = RIG[..own].replace("[brake]", "[brake]\njoint = \"C\"");
        let table = parse(&text).unwrap().brake.unwrap().table();
        assert_eq!(table.rising, brake_table(Joint::C).rising);
        assert!((table.torque_gain.k_1 - 5.17).abs() < 1e-12);
        let message = parse(&RIG[..own]).unwrap_err();
        assert!(
            message.contains("the brake has no `rising` and no `joint`"),
            "{message}"
        );
    }

    #[test]
    fn a_table_that_no_brake_can_have_is_refused() {
        for (text, with, expected) in [
            ("k_1 = {", "k_6 = {", "`k_6` is no key of `torque_gain`"),
            ("N·m/A^2", "N·m/A", "`N·m/A` does not convert to `N·m/A^2`"),
            ("value = 1.3", "value = -1.3", "`backlash_width` is -0.0226"),
            (
                "value = 1.4,",
                "value = 0.1,",
                "`greatest_current` is 0.1 A; it must reach 0.2 A",
            ),
            (
                "value = 9.3",
                "value = 0.3",
                "not above the off-state torque",
            ),
            (
                "value = 5.1,",
                "value = -5.1,",
                "the falling time constant falls to -",
            ),
            (
                "value = 7.3,",
                "value = -7.3,",
                "the rising time constant falls to -",
            ),
            ("value = 41", "value = 0.1", "the speeds run from"),
            ("a_3 =", "# a_3 =", "`a_3` is missing in `falling`"),
        ] {
            let message = parse(&RIG.replacen(text, with, 2)).unwrap_err();
            assert!(message.contains(expected), "{message} lacks {expected}");
        }
    }
}
