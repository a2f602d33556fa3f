//! This file reads a five-bar linkage from TOML: its lengths, the ranges of its angles and its braked joints.

use std::path::Path;

use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, Arms, STOPS};
use rigproof_spec::joint::Joint;
use rigproof_spec::units::{Dimension, RAD_PER_DEG, Unit};

use super::table::{Source, Table};
use crate::error::TraceError;
use crate::store;
use crate::suggest::quoted;

/// A linkage as somebody describes it; whether its lengths make a linkage is not checked here.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// What people call it.
    pub name: String,
    /// Its lengths.
    pub arms: Arms,
    /// Where its angles may lie; the stops of the thesis where the file is silent.
    pub ranges: AngleRanges,
    /// The braked joints, if the file names them.
    pub brakes: Option<Vec<Joint>>,
}

impl Linkage {
    /// Reads a linkage from a file.
    ///
    /// # Errors
    /// The system refuses, or those of [`Linkage::parse`].
    pub fn read(path: &Path) -> Result<Linkage, TraceError> {
        Linkage::parse(&store::read_text(path)?, path)
    }

    /// Reads a linkage; `origin` is the file that messages name. Lengths become m, angles degrees.
    ///
    /// `bc` and `cd` may be left out: the arms are then as on the other side.
    ///
    /// # Errors
    /// The text is no TOML, a key is unknown or missing, or a unit is not known or measures something else; the message
    /// gives line and column.
    pub fn parse(text: &str, origin: &Path) -> Result<Linkage, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&["name", "lengths", "angles", "brakes"])?;
        let name = root.need("name", root.text("name")?)?.to_owned();
        let lengths = root.need("lengths", root.table("lengths")?)?;
        lengths.only(&["ae", "ed", "bc", "cd", "ab"])?;
        let need = |key| lengths.need(key, read_length(&lengths, key)?);
        let (l_ae_m, l_ed_m, l_ab_m) = (need("ae")?, need("ed")?, need("ab")?);
        Ok(Linkage {
            name,
            arms: Arms {
                l_ae_m,
                l_ed_m,
                l_bc_m: read_length(&lengths, "bc")?.unwrap_or(l_ae_m),
                l_cd_m: read_length(&lengths, "cd")?.unwrap_or(l_ed_m),
                l_ab_m,
            },
            ranges: read_ranges(&root)?,
            brakes: read_brakes(&root)?,
        })
    }
}

fn read_length(table: &Table<'_>, key: &str) -> Result<Option<f64>, TraceError> {
    let Some(table) = table.table(key)? else {
        return Ok(None);
    };
    table.only(&["value", "unit"])?;
    let to_si = read_unit(&table, Dimension::LENGTH)?;
    let value = table.need("value", table.number("value")?)?;
    Ok(Some(value * to_si))
}

fn read_ranges(root: &Table<'_>) -> Result<AngleRanges, TraceError> {
    let mut ranges = STOPS;
    let Some(table) = root.table("angles")? else {
        return Ok(ranges);
    };
    table.only(&["a", "e", "b", "c", "d"])?;
    for (key, angle) in ["a", "e", "b", "c", "d"].into_iter().zip(Angle::ALL) {
        if let Some(entry) = table.table(key)? {
            entry.only(&["least", "greatest", "unit"])?;
            let to_deg = read_unit(&entry, Dimension::ANGLE)? / RAD_PER_DEG;
            let stop = STOPS.of(angle);
            let end = |key, stop: f64| Ok(entry.number(key)?.map_or(stop, |end| end * to_deg));
            let least_deg = end("least", stop.least_deg)?;
            let greatest_deg = end("greatest", stop.greatest_deg)?;
            set(&mut ranges, angle, AngleRange::new(least_deg, greatest_deg));
        }
    }
    Ok(ranges)
}

/// Changes the range of one angle.
pub fn set(ranges: &mut AngleRanges, angle: Angle, range: AngleRange) {
    *match angle {
        Angle::A => &mut ranges.a,
        Angle::E => &mut ranges.e,
        Angle::B => &mut ranges.b,
        Angle::C => &mut ranges.c,
        Angle::D => &mut ranges.d,
    } = range;
}

fn read_brakes(root: &Table<'_>) -> Result<Option<Vec<Joint>>, TraceError> {
    let Some(text) = root.text("brakes")? else {
        return Ok(None);
    };
    brakes(text)
        .map(Some)
        .map_err(|problem| root.error_at("brakes", problem))
}

/// Braked joints from their letters, such as `A, E, B`, in the house order.
///
/// # Errors
/// A letter is no joint with a brake, or stands twice.
pub fn brakes(text: &str) -> Result<Vec<Joint>, String> {
    let mut joints = Vec::new();
    for letter in text.split(',').map(str::trim) {
        let joint = Joint::from_letter(letter).ok_or_else(|| {
            let letters = quoted(Joint::ALL.map(Joint::letter));
            format!("`{letter}` is no joint that can carry a brake; the joints are {letters}")
        })?;
        if joints.contains(&joint) {
            return Err(format!("`{letter}` stands twice; name each joint once"));
        }
        joints.push(joint);
    }
    joints.sort();
    Ok(joints)
}

fn read_unit(table: &Table<'_>, expected: Dimension) -> Result<f64, TraceError> {
    let text = table.need("unit", table.text("unit")?)?;
    match Unit::parse(text) {
        Some(unit) if unit.dimension == expected => Ok(unit.to_si),
        _ => Err(table.error_at(
            "unit",
            format!("`{text}` does not convert to `{expected}`; give a unit of that kind"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: &str = "name = \"wide\"\nbrakes = \"C, A, E\"\n[lengths]\nae = { value = 263.7, unit = \"mm\" }\n\
        ed = { value = 12.1, unit = \"in\" }\nab = { value = 0.271, unit = \"m\" }\n\
        [angles]\nd = { least = 0.9, unit = \"rad\" }\n";

    #[test]
    fn lengths_and_angles_are_converted_and_the_rest_is_as_in_the_thesis() {
        let read = Linkage::parse(OWN, Path::new("own.toml")).unwrap();
        assert!((read.arms.l_ae_m - 0.2637).abs() < 1e-15);
        assert!((read.arms.l_ed_m - 0.307_34).abs() < 1e-15);
        assert_eq!(read.arms.l_bc_m, read.arms.l_ae_m);
        assert_eq!(read.arms.l_cd_m, read.arms.l_ed_m);
        assert!((read.ranges.d.least_deg - 51.566_201_561_774_09).abs() < 1e-12);
        assert_eq!(read.ranges.d.greatest_deg, STOPS.d.greatest_deg);
        assert_eq!(read.ranges.e, STOPS.e);
        assert_eq!(read.brakes, Some(vec![Joint::A, Joint::E, Joint::C]));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        for (from, to, words) in [
            (
                "name =",
                "nmae =",
                "`nmae` is no key of the file; did you mean `name`?",
            ),
            (
                "\"mm\"",
                "\"N\"",
                "line 4, column 30: `N` does not convert to `m`",
            ),
            (
                "\"C, A, E\"",
                "\"D\"",
                "`D` is no joint that can carry a brake",
            ),
            ("\"C, A, E\"", "\"A, A\"", "`A` stands twice"),
            ("ab = {", "xy = {", "`xy` is no key of `lengths`"),
            ("0.9", "nan", "`least` is NaN; give a finite number"),
        ] {
            let text = OWN.replace(from, to);
            let message = Linkage::parse(&text, Path::new("own.toml"))
                .unwrap_err()
                .to_string();
            assert!(
                message.starts_with("own.toml, line") && message.contains(words),
                "{message}"
            );
        }
        let missing = OWN.replace("ab = { value = 0.271, unit = \"m\" }\n", "");
        let message = Linkage::parse(&missing, Path::new("own.toml"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("`ab` is missing in `lengths`"),
            "{message}"
        );
    }
}
