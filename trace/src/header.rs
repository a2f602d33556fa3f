//! This file reads the name and the unit out of a column header.

use rigproof_spec::units::Unit;

/// The name and the unit of a header cell: `name (unit)`, `name [unit]` or `name / unit`.
///
/// A bracket that holds digits is an index (`x[1]`) and stays in the name. The unit is empty when the header does not
/// say; what the name suggests is [`guessed_unit`].
pub fn name_and_unit(header: &str) -> (&str, &str) {
    let header = header.trim();
    bracketed(header, '(', ')')
        .or_else(|| bracketed(header, '[', ']').filter(|(_, unit)| !is_digits(unit)))
        .or_else(|| divided(header))
        .unwrap_or((header, ""))
}

/// `name / unit`, as DIN 1313 writes it.
fn divided(header: &str) -> Option<(&str, &str)> {
    let (name, unit) = header.rsplit_once(" / ")?;
    let (name, unit) = (name.trim_end(), unit.trim_start());
    let is_unit = !name.is_empty() && !is_digits(unit) && Unit::parse(unit).is_some();
    is_unit.then_some((name, unit))
}

/// The unit that a name ends in after an underscore (`m` of `qm_m`), or nothing. It is a guess: `theta_A` is rarely a current.
pub fn guessed_unit(name: &str) -> &str {
    suffixed(name).map_or("", |(_, unit)| unit)
}

/// The header that reads back as this name and unit, or `None` when there is none.
pub fn header(name: &str, unit: &str) -> Option<String> {
    let header = if unit.is_empty() && name_and_unit(name) == (name, "") {
        name.to_string()
    } else {
        format!("{name} ({unit})")
    };
    let one_line = !header.contains(['\n', '\r', '\0']);
    let reads_back = !name.is_empty() && name_and_unit(&header) == (name, unit);
    (one_line && reads_back && !header.starts_with(['#', '\u{feff}'])).then_some(header)
}

/// The name without a unit after its last underscore, in lower case: `t` of `t_s`, `time` of `Time`.
pub(crate) fn stem(name: &str) -> String {
    suffixed(name)
        .and_then(|(name, unit)| name.strip_suffix(unit)?.strip_suffix('_'))
        .unwrap_or(name)
        .to_lowercase()
}

fn bracketed(header: &str, open: char, close: char) -> Option<(&str, &str)> {
    let (name, unit) = header.strip_suffix(close)?.rsplit_once(open)?;
    let name = name.trim_end();
    (!name.is_empty()).then_some((name, unit.trim()))
}

fn suffixed(header: &str) -> Option<(&str, &str)> {
    let (stem, unit) = header.rsplit_once('_')?;
    let is_unit = !stem.is_empty() && !is_digits(unit) && Unit::parse(unit).is_some();
    is_unit.then_some((header, unit))
}

fn is_digits(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_forms_that_laboratories_write_are_read() {
        for (text, expected) in [
            ("torque (N·m)", ("torque", "N·m")),
            (" speed [deg/s] ", ("speed", "deg/s")),
            ("qm_m", ("qm_m", "")),
            ("qm_m (mm)", ("qm_m", "mm")),
            ("dist_mm_raw", ("dist_mm_raw", "")),
            ("t / s", ("t", "s")),
            ("torque / N·m", ("torque", "N·m")),
            ("left / right", ("left / right", "")),
            ("forc1[1]", ("forc1[1]", "")),
            ("forc1[1] (N)", ("forc1[1]", "N")),
            ("qm_m ()", ("qm_m", "")),
            ("(N)", ("(N)", "")),
        ] {
            assert_eq!(name_and_unit(text), expected, "{text}");
        }
    }

    #[test]
    fn a_name_that_ends_in_a_unit_suggests_it() {
        for (name, expected) in [
            ("qm_m", "m"),
            ("torque_Nm", "Nm"),
            ("theta_A", "A"),
            ("theta_E", ""),
            ("dist_mm_raw", ""),
            ("run_2", ""),
            ("_m", ""),
        ] {
            assert_eq!(guessed_unit(name), expected, "{name}");
        }
    }

    #[test]
    fn a_stem_is_the_name_before_its_unit() {
        for (name, expected) in [
            ("t_s", "t"),
            ("Time", "time"),
            ("time_ms", "time"),
            ("t_N", "t"),
        ] {
            assert_eq!(stem(name), expected);
        }
    }

    #[test]
    fn a_name_that_cannot_be_read_back_has_no_header() {
        assert_eq!(header("qm_m", "").as_deref(), Some("qm_m"));
        assert_eq!(header("q (m)", "").as_deref(), Some("q (m) ()"));
        assert_eq!(header("forc", "N").as_deref(), Some("forc (N)"));
        for (name, unit) in [("", "N"), ("a\nb", "m"), (" a", ""), ("a", "m)(")] {
            assert_eq!(header(name, unit), None, "{name:?} {unit:?}");
        }
    }
}
