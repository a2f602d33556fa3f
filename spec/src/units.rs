//! This file turns a printed unit into a factor to SI: the only unit conversions of the workspace.

use core::f64::consts::PI;
use core::fmt;

/// The physical kind of a unit: exponents of metre, kilogram, second, ampere and radian.
///
/// The radian is kept apart, so that a rotary quantity cannot be taken for a linear one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension(pub [i8; 5]);

impl Dimension {
    /// A plain number.
    pub const NUMBER: Dimension = Dimension([0; 5]);
    /// Time, s.
    pub const TIME: Dimension = Dimension([0, 0, 1, 0, 0]);
    /// Linear displacement, m.
    pub const LENGTH: Dimension = Dimension([1, 0, 0, 0, 0]);
    /// Rotary displacement, rad.
    pub const ANGLE: Dimension = Dimension([0, 0, 0, 0, 1]);
    /// Force, N.
    pub const FORCE: Dimension = Dimension([1, 1, -2, 0, 0]);
    /// Torque, N·m.
    pub const TORQUE: Dimension = Dimension([2, 1, -2, 0, 0]);
    /// Electric current, A.
    pub const CURRENT: Dimension = Dimension([0, 0, 0, 1, 0]);
    /// Voltage, V.
    pub const VOLTAGE: Dimension = Dimension([2, 1, -3, -1, 0]);

    /// The dimension of a product.
    pub const fn times(self, other: Dimension) -> Dimension {
        self.combine(other, 1)
    }

    /// The dimension of a quotient.
    pub const fn per(self, other: Dimension) -> Dimension {
        self.combine(other, -1)
    }

    /// The dimension of an integer power.
    pub const fn power(self, exponent: i8) -> Dimension {
        Dimension::NUMBER.combine(self, exponent)
    }

    const fn combine(self, other: Dimension, exponent: i8) -> Dimension {
        let [m, kg, s, a, rad] = self.0;
        let [om, okg, os, oa, orad] = other.0;
        Dimension([
            m.saturating_add(om.saturating_mul(exponent)),
            kg.saturating_add(okg.saturating_mul(exponent)),
            s.saturating_add(os.saturating_mul(exponent)),
            a.saturating_add(oa.saturating_mul(exponent)),
            rad.saturating_add(orad.saturating_mul(exponent)),
        ])
    }
}

impl fmt::Display for Dimension {
    /// Prints the SI unit with the field's composite names where there is one, e.g. `N·s/m`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (text, dimension) in SI_NAMES {
            if dimension == self {
                return f.write_str(text);
            }
        }
        let mut separator = "";
        for (exponent, symbol) in self.0.into_iter().zip(["m", "kg", "s", "A", "rad"]) {
            match exponent {
                0 => continue,
                1 => write!(f, "{separator}{symbol}")?,
                _ => write!(f, "{separator}{symbol}^{exponent}")?,
            }
            separator = "·";
        }
        Ok(())
    }
}

/// SI units that have a name a reader expects; looked up when printing.
const SI_NAMES: &[(&str, Dimension)] = &[
    ("1", Dimension::NUMBER),
    ("N", Dimension::FORCE),
    ("N·m", Dimension::TORQUE),
    ("V", Dimension::VOLTAGE),
    ("m/s", Dimension::LENGTH.per(Dimension::TIME)),
    ("rad/s", Dimension::ANGLE.per(Dimension::TIME)),
    ("1/m", Dimension::NUMBER.per(Dimension::LENGTH)),
    ("1/rad", Dimension::NUMBER.per(Dimension::ANGLE)),
    ("N/m", Dimension::FORCE.per(Dimension::LENGTH)),
    ("N/m^3", Dimension::FORCE.per(Dimension::LENGTH.power(3))),
    ("N·m/rad", Dimension::TORQUE.per(Dimension::ANGLE)),
    (
        "N·m/rad^3",
        Dimension::TORQUE.per(Dimension::ANGLE.power(3)),
    ),
    (
        "N·s/m",
        Dimension::FORCE
            .times(Dimension::TIME)
            .per(Dimension::LENGTH),
    ),
    (
        "N·m·s/rad",
        Dimension::TORQUE
            .times(Dimension::TIME)
            .per(Dimension::ANGLE),
    ),
    (
        "kg·m^2/rad",
        Dimension::TORQUE
            .times(Dimension::TIME.power(2))
            .per(Dimension::ANGLE),
    ),
    ("N/s", Dimension::FORCE.per(Dimension::TIME)),
    ("N·m/s", Dimension::TORQUE.per(Dimension::TIME)),
    ("N/V", Dimension::FORCE.per(Dimension::VOLTAGE)),
    ("N·m/V", Dimension::TORQUE.per(Dimension::VOLTAGE)),
    ("N·m/A", Dimension::TORQUE.per(Dimension::CURRENT)),
    ("N/A", Dimension::FORCE.per(Dimension::CURRENT)),
    (
        "N·m/A^2",
        Dimension::TORQUE.per(Dimension::CURRENT.power(2)),
    ),
    ("s/A", Dimension::TIME.per(Dimension::CURRENT)),
    (
        "1/J",
        Dimension::NUMBER.per(Dimension::FORCE.times(Dimension::LENGTH)),
    ),
    ("m/s^2", Dimension::LENGTH.per(Dimension::TIME.power(2))),
];

/// A printed unit: its factor to SI and its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Value in SI = value in this unit × `to_si`.
    pub to_si: f64,
    /// What kind of quantity it measures.
    pub dimension: Dimension,
}

impl Unit {
    /// Reads a unit such as `N·m`, `N*s/m`, `mm`, `deg`, `rpm`, `kg.m^2`, `1/m` or `m/s²`.
    ///
    /// Factors are joined by `·`, `*`, `.` or a space and each factor after a `/` divides. `None` when a
    /// symbol is unknown.
    pub fn parse(text: &str) -> Option<Unit> {
        let mut unit = Unit {
            to_si: 1.0,
            dimension: Dimension::NUMBER,
        };
        let mut divides = false;
        for denominator in text.trim().split('/') {
            for factor in denominator.split(['·', '*', '.', ' ', '⋅']) {
                let factor = factor.trim();
                if factor.is_empty() {
                    if text.trim().is_empty()
                        || text.contains("//")
                        || denominator.trim().is_empty()
                    {
                        return None;
                    }
                    continue;
                }
                let (symbol, exponent) = split_exponent(factor)?;
                let base = symbol_unit(symbol)?;
                let exponent = if divides { -exponent } else { exponent };
                unit.to_si *= integer_power(base.to_si, exponent);
                unit.dimension = unit.dimension.times(base.dimension.power(exponent));
            }
            divides = true;
        }
        Some(unit)
    }
}

fn split_exponent(factor: &str) -> Option<(&str, i8)> {
    if let Some(symbol) = factor.strip_suffix('²') {
        return Some((symbol, 2));
    }
    if let Some(symbol) = factor.strip_suffix('³') {
        return Some((symbol, 3));
    }
    match factor.split_once('^') {
        Some((symbol, exponent)) => exponent
            .parse::<i8>()
            .ok()
            .filter(|e| (-9..=9).contains(e))
            .map(|e| (symbol, e)),
        None => Some((factor, 1)),
    }
}

fn integer_power(base: f64, exponent: i8) -> f64 {
    let mut product = 1.0;
    for _ in 0..exponent.unsigned_abs() {
        product *= base;
    }
    if exponent < 0 { 1.0 / product } else { product }
}

/// Revolutions per minute to radians per second.
pub const RAD_S_PER_RPM: f64 = 2.0 * PI / 60.0;
/// Centimetres to metres.
pub const M_PER_CM: f64 = 0.01;
/// Degrees to radians.
pub const RAD_PER_DEG: f64 = PI / 180.0;

/// Shaft speed in rpm, the unit of the thesis's brake tables, from rad/s.
pub fn rpm_from_rad_s(omega_rad_s: f64) -> f64 {
    omega_rad_s / RAD_S_PER_RPM
}

/// Shaft speed in rad/s from rpm.
pub fn rad_s_from_rpm(omega_rpm: f64) -> f64 {
    omega_rpm * RAD_S_PER_RPM
}

/// Angle in rad from degrees.
pub fn rad_from_deg(angle_deg: f64) -> f64 {
    angle_deg * RAD_PER_DEG
}

/// Angle in degrees from rad.
pub fn deg_from_rad(angle_rad: f64) -> f64 {
    angle_rad / RAD_PER_DEG
}

fn symbol_unit(symbol: &str) -> Option<Unit> {
    if let Some(unit) = plain_symbol(symbol) {
        return Some(unit);
    }
    for (prefix, factor) in [
        ("k", 1e3),
        ("c", 1e-2),
        ("m", 1e-3),
        ("u", 1e-6),
        ("µ", 1e-6),
        ("μ", 1e-6),
        ("n", 1e-9),
    ] {
        if let Some(rest) = symbol.strip_prefix(prefix)
            && PREFIXABLE.contains(&rest)
        {
            let unit = plain_symbol(rest)?;
            return Some(Unit {
                to_si: unit.to_si * factor,
                ..unit
            });
        }
    }
    None
}

/// Symbols that take an SI prefix.
const PREFIXABLE: &[&str] = &["m", "s", "A", "V", "N", "Nm", "rad", "Hz", "g"];

fn plain_symbol(symbol: &str) -> Option<Unit> {
    let (to_si, dimension) = match symbol {
        "1" | "-" | "none" | "count" | "counts" => (1.0, Dimension::NUMBER),
        "%" => (0.01, Dimension::NUMBER),
        "m" => (1.0, Dimension::LENGTH),
        "in" => (0.0254, Dimension::LENGTH),
        "s" | "sec" => (1.0, Dimension::TIME),
        "min" => (60.0, Dimension::TIME),
        "h" => (3600.0, Dimension::TIME),
        "Hz" => (1.0, Dimension::NUMBER.per(Dimension::TIME)),
        "g" => (1e-3, Dimension([0, 1, 0, 0, 0])),
        "kg" => (1.0, Dimension([0, 1, 0, 0, 0])),
        "A" => (1.0, Dimension::CURRENT),
        "V" => (1.0, Dimension::VOLTAGE),
        "N" => (1.0, Dimension::FORCE),
        "lbf" => (4.448_221_615_260_5, Dimension::FORCE),
        "Nm" => (1.0, Dimension::TORQUE),
        "J" => (1.0, Dimension::FORCE.times(Dimension::LENGTH)),
        "rad" => (1.0, Dimension::ANGLE),
        "deg" | "°" => (RAD_PER_DEG, Dimension::ANGLE),
        "rev" => (2.0 * PI, Dimension::ANGLE),
        "rpm" => (RAD_S_PER_RPM, Dimension::ANGLE.per(Dimension::TIME)),
        _ => return None,
    };
    Some(Unit { to_si, dimension })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(text: &str) -> (f64, Dimension) {
        let unit = Unit::parse(text).unwrap_or_else(|| panic!("{text} is not read"));
        (unit.to_si, unit.dimension)
    }

    #[test]
    fn composite_units_multiply_out() {
        assert_eq!(si("N·s/m").1, si("kg/s").1);
        assert_eq!(si("mm"), (1e-3, Dimension::LENGTH));
        let (factor, dimension) = si("mN*m/deg");
        assert!((factor - 1e-3 / RAD_PER_DEG).abs() < 1e-15);
        assert_eq!(dimension, Dimension::TORQUE.per(Dimension::ANGLE));
        assert_eq!(si("m/s²").1, si("m/s^2").1);
        assert_eq!(si("J").1, si("N·m").1);
        assert!((si("rpm").0 - 0.104_719_755_119_659_8).abs() < 1e-16);
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "furlong", "N//m", "m^x", "/", "N/", "m^99"] {
            assert!(Unit::parse(text).is_none(), "{text} was read");
        }
    }
}
