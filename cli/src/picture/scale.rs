//! This file is a scale: the range of an axis, its ticks, and a unit that keeps tick labels short.

/// An axis from `low` to `high`, printed in `10^exponent` of its unit.
#[derive(Clone, Debug)]
pub struct Scale {
    pub low: f64,
    pub high: f64,
    exponent: i32,
    label: String,
}

impl Scale {
    /// A scale with room around the values, labelled with what they are.
    pub fn around(low: f64, high: f64, quantity: &str, unit: &str) -> Scale {
        let widest = low.abs().max(high.abs());
        let least = 1e-12 * widest + f64::MIN_POSITIVE.sqrt();
        let room = (0.04 * (high - low)).max(least);
        Scale::exact(low - room, high + room, quantity, unit)
    }

    /// A scale that ends where the values end.
    pub fn exact(low: f64, high: f64, quantity: &str, unit: &str) -> Scale {
        let widest = low.abs().max(high.abs());
        let exponent = match libm::log10(widest).floor() {
            power if power.is_finite() && !(-2.0..4.0).contains(&power) => {
                3 * (power / 3.0).floor() as i32
            }
            _ => 0,
        };
        let unit = match (exponent, unit) {
            (0, "" | "1") => String::new(),
            (0, unit) => format!(" ({unit})"),
            (exponent, "" | "1") => format!(" ({})", power_of_ten(exponent)),
            (exponent, unit) => format!(" ({} {unit})", power_of_ten(exponent)),
        };
        Scale {
            low,
            high,
            exponent,
            label: format!("{quantity}{unit}"),
        }
    }

    /// What the axis shows, with its unit.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Where a value lies, 0 at `low` and 1 at `high`.
    pub fn place(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Round values, about as many as asked for, with their labels.
    pub fn ticks(&self, wanted: f64) -> Vec<(f64, String)> {
        let step = round_step((self.high - self.low) / wanted);
        let unit = libm::pow(10.0, f64::from(self.exponent));
        let decimals = (-libm::log10(step / unit * 1.000_001).floor()).clamp(0.0, 9.0) as usize;
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last.min(first.saturating_add(40)))
            .map(|k| {
                let value = k as f64 * step;
                (
                    value,
                    format!("{:.decimals$}", value / unit).replace('-', "−"),
                )
            })
            .collect()
    }
}

/// The step 1, 2 or 5 times a power of ten that is next to a width.
fn round_step(width: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(width).floor());
    let factor = match width / power {
        x if x < 1.5 => 1.0,
        x if x < 3.5 => 2.0,
        x if x < 7.5 => 5.0,
        _ => 10.0,
    };
    factor * power
}

fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|digit| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    });
    format!("10{}", raised.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_their_labels_short() {
        let labels = |scale: &Scale| -> Vec<String> {
            scale
                .ticks(5.0)
                .into_iter()
                .map(|(_, label)| label)
                .collect()
        };
        let small = Scale::exact(-0.0031, 0.0042, "position", "rad");
        assert_eq!(small.label(), "position (10⁻³ rad)");
        assert_eq!(labels(&small), ["−3", "−2", "−1", "0", "1", "2", "3", "4"]);
        let plain = Scale::exact(12.3, 14.2, "time", "s");
        assert_eq!(plain.label(), "time (s)");
        assert_eq!(labels(&plain), ["12.5", "13.0", "13.5", "14.0"]);
        assert_eq!(power_of_ten(-15), "10⁻¹⁵");
    }

    #[test]
    fn a_scale_of_one_value_still_has_a_width() {
        for value in [0.0, -3.5, 1e9] {
            let scale = Scale::around(value, value, "force", "N");
            assert!(scale.high > scale.low && scale.place(value).is_finite());
            assert!(scale.ticks(4.0).len() < 50);
        }
    }
}
