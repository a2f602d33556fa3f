//! This file sets what the text states beside what was computed here.

/// How a statement of the text fares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It comes out here as well.
    Agrees,
    /// It does not.
    Disagrees,
    /// The text states nothing that could be compared: the figure is lost.
    CannotBeCompared,
}

impl Verdict {
    /// The words of reports.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Disagrees => "disagrees",
            Verdict::CannotBeCompared => "cannot be compared",
        }
    }
}

/// One statement of the text beside ours.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Where the text states it, such as `§3.3.3`.
    pub place: &'static str,
    /// What it states, in a few words.
    pub statement: String,
    /// What it says, with its unit.
    pub stated: String,
    /// What comes out here, with its unit.
    pub ours: String,
    /// How the two compare.
    pub verdict: Verdict,
    /// What decided: the tolerance and where it comes from, or why nothing can be compared.
    pub because: String,
    /// The erratum or gap of `spec/thesis` that accounts for a disagreement.
    pub account: Option<&'static str>,
}

impl Finding {
    /// A number of the text beside ours: they agree when they lie within `tolerance`, which `because` explains.
    pub fn number(
        place: &'static str,
        statement: impl Into<String>,
        (stated, ours, unit): (f64, f64, &str),
        tolerance: f64,
        because: impl Into<String>,
    ) -> Finding {
        let verdict = if (ours - stated).abs() <= tolerance {
            Verdict::Agrees
        } else {
            Verdict::Disagrees
        };
        Finding {
            place,
            statement: statement.into(),
            stated: with_unit(stated, unit),
            ours: with_unit(ours, unit),
            verdict,
            because: format!("within {}: {}", with_unit(tolerance, unit), because.into()),
            account: None,
        }
    }

    /// A statement in words, and whether it holds here.
    pub fn claim(
        place: &'static str,
        statement: impl Into<String>,
        stated: impl Into<String>,
        (ours, holds): (String, bool),
        because: impl Into<String>,
    ) -> Finding {
        Finding {
            place,
            statement: statement.into(),
            stated: stated.into(),
            ours,
            verdict: if holds {
                Verdict::Agrees
            } else {
                Verdict::Disagrees
            },
            because: because.into(),
            account: None,
        }
    }

    /// Something that only the lost figure stated.
    pub fn lost(
        place: &'static str,
        statement: impl Into<String>,
        ours: impl Into<String>,
        because: impl Into<String>,
    ) -> Finding {
        Finding {
            place,
            statement: statement.into(),
            stated: "figure lost".to_owned(),
            ours: ours.into(),
            verdict: Verdict::CannotBeCompared,
            because: because.into(),
            account: None,
        }
    }

    /// The finding with the erratum or gap that accounts for its disagreement.
    #[must_use]
    pub fn accounted(mut self, id: &'static str) -> Finding {
        self.account = Some(id);
        self
    }

    /// Whether it disagrees and no erratum or gap says why.
    pub fn is_unaccounted(&self) -> bool {
        self.verdict == Verdict::Disagrees && self.account.is_none()
    }
}

/// A number with four significant digits and its unit.
pub fn with_unit(value: f64, unit: &str) -> String {
    let digits = digits(value);
    match unit {
        "" | "1" => digits,
        unit => format!("{digits} {unit}"),
    }
}

fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let power = libm::log10(value.abs()).floor();
    if !(-4.0..6.0).contains(&power) {
        return format!("{value:.3e}");
    }
    let decimals = (3.0 - power).clamp(0.0, 7.0) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_agrees_inside_its_tolerance_and_nowhere_else() {
        let verdict = |ours| {
            let values = (1.9, ours, "°");
            Finding::number("§3.3.3", "backlash", values, 0.05, "half a digit").verdict
        };
        assert_eq!(verdict(1.93), Verdict::Agrees);
        assert_eq!(verdict(1.97), Verdict::Disagrees);
        assert_eq!(verdict(f64::NAN), Verdict::Disagrees);
    }

    #[test]
    fn only_a_disagreement_without_an_account_is_unaccounted() {
        let finding = |holds| {
            let ours = ("1.7°".to_owned(), holds);
            Finding::claim("§3.3.3", "width", "1.9°", ours, "by inspection")
        };
        assert!(finding(false).is_unaccounted());
        assert!(!finding(true).is_unaccounted());
        assert!(
            !finding(false)
                .accounted("backlash-example")
                .is_unaccounted()
        );
    }

    #[test]
    fn numbers_have_four_digits_and_no_tail() {
        assert_eq!(with_unit(0.0075, "s"), "0.0075 s");
        assert_eq!(with_unit(6.44481, "N·m"), "6.445 N·m");
        assert_eq!(with_unit(-18.75, "ms"), "-18.75 ms");
        assert_eq!(with_unit(1.234e-7, "1"), "1.234e-7");
        assert_eq!(with_unit(123_456.7, "N"), "123457 N");
    }
}
