//! This file makes seconds of the time stamps of a text file.

use super::columns::column_place;
use super::dialect::{Decimal, is_missing};
use super::logger::TimeBase;
use super::stamp::{DAY_S, Exact, calendar};
use crate::error::{Place, TraceError};

/// Stamps from here on, s, are counted from the first whole second: about eleven days, below which a double keeps them to
/// better than a nanosecond.
const EPOCH_S: f64 = 1e6;
/// Stamps in a unit that nobody states, and the unit that numbers so large since 1970 are in.
const LARGE: [(f64, f64, &str); 3] = [(1e17, 1e-9, "ns"), (1e14, 1e-6, "us"), (1e11, 1e-3, "ms")];

/// How time stamps become seconds, and those that have come.
pub(super) struct Clock {
    base: Option<TimeBase>,
    name: String,
    cell: usize,
    decimal: Decimal,
    to_s: f64,
    unit_is_stated: bool,
    /// What is subtracted, once the first stamp has come.
    origin: Option<Origin>,
    pub(super) time_s: Vec<f64>,
    /// What the last printed digit counts, s.
    pub(super) resolution_s: f64,
    /// The line of the first stamp that is repeated.
    pub(super) repeated: Option<Place>,
    pub(super) remarks: Vec<String>,
}

#[derive(Clone, Copy)]
enum Origin {
    /// Small numbers are taken as they are.
    None,
    /// Numbers are counted from this one.
    Number(Exact),
    /// Dates and times are counted from this one; days that have passed, and whether there is a date.
    Calendar(Exact, f64, bool),
}

impl Clock {
    pub(super) fn counted(base: Option<TimeBase>, decimal: Decimal) -> Clock {
        Clock {
            base,
            name: String::new(),
            cell: 0,
            decimal,
            to_s: 1.0,
            unit_is_stated: false,
            origin: None,
            time_s: Vec::new(),
            resolution_s: f64::INFINITY,
            repeated: None,
            remarks: Vec::new(),
        }
    }

    pub(super) fn of_column(self, name: &str, cell: usize, decimal: Decimal) -> Clock {
        Clock {
            base: self.base.filter(|_| cell == 0),
            name: name.to_owned(),
            cell,
            decimal,
            ..self
        }
    }

    pub(super) fn state_unit(&mut self, to_s: f64) {
        self.to_s = to_s;
        self.unit_is_stated = true;
    }

    /// The time of a line that holds a stamp in this cell, or that is counted; `None` where the stamp is missing.
    pub(super) fn read(
        &mut self,
        cell: Option<&str>,
        line: &dyn Fn() -> Place,
    ) -> Result<Option<f64>, TraceError> {
        let cell = match (self.base, cell) {
            (Some(base), None) => {
                return Ok(Some(base.start_s + base.step_s * self.time_s.len() as f64));
            }
            (_, None) => return Ok(None),
            (_, Some(cell)) if is_missing(cell) => return Ok(None),
            (_, Some(cell)) => cell,
        };
        let Some(stamp) = self.stamp(cell) else {
            return Err(TraceError::NoStamp {
                place: column_place(&line(), self.cell, &self.name),
                text: cell.chars().take(40).collect(),
            });
        };
        let counted = |base: TimeBase| base.start_s + base.step_s * stamp;
        Ok(Some(self.base.map_or(stamp, counted)))
    }

    /// Takes the time of a line.
    pub(super) fn push(
        &mut self,
        time_s: Option<f64>,
        line: &dyn Fn() -> Place,
    ) -> Result<(), TraceError> {
        let place = || column_place(&line(), self.cell, &self.name);
        let Some(time_s) = time_s else {
            return Err(TraceError::TimeMissing { place: place() });
        };
        match self.time_s.last() {
            Some(&previous_s) if time_s < previous_s => {
                return Err(TraceError::TimeOrder {
                    place: place(),
                    time_s,
                    previous_s,
                });
            }
            Some(&previous_s) if time_s == previous_s && self.repeated.is_none() => {
                self.repeated = Some(place());
            }
            _ => {}
        }
        self.time_s.push(time_s);
        Ok(())
    }

    /// The seconds of a stamp.
    fn stamp(&mut self, cell: &str) -> Option<f64> {
        let origin = match self.origin {
            Some(origin) => origin,
            None => self.begin(cell)?,
        };
        self.origin = Some(origin);
        match origin {
            Origin::None => {
                let places = match cell.contains(['e', 'E']) {
                    true => Exact::parse(cell, self.decimal).map_or(0.0, Exact::resolution),
                    false => resolution(cell),
                };
                self.resolution_s = self.resolution_s.min(places * self.to_s);
                let number = self.decimal.number(cell)?;
                let in_s = number * self.to_s;
                in_s.is_finite().then_some(in_s)
            }
            Origin::Number(first) => {
                let exact = Exact::parse(cell, self.decimal)?;
                self.resolution_s = self.resolution_s.min(exact.resolution() * self.to_s);
                Some(exact.minus(first) * self.to_s)
            }
            Origin::Calendar(first, days, has_date) => {
                let (exact, _) = calendar(cell)?;
                self.resolution_s = self.resolution_s.min(exact.resolution());
                let mut s = exact.minus(first) + days * DAY_S;
                // Past midnight a time of day begins again.
                let before_s = self.time_s.last().copied().unwrap_or(s);
                if !has_date && before_s - s > DAY_S / 2.0 {
                    s += DAY_S;
                    self.origin = Some(Origin::Calendar(first, days + 1.0, has_date));
                }
                Some(s)
            }
        }
    }

    /// Looks at the first stamp.
    fn begin(&mut self, cell: &str) -> Option<Origin> {
        let Some(exact) = Exact::parse(cell, self.decimal) else {
            if self.decimal.number(cell).is_some() {
                return Some(Origin::None);
            }
            let (exact, has_date) = calendar(cell)?;
            self.remarks.push(format!(
                "the time stamps are {}, counted from the whole second of the first, `{cell}`",
                if has_date {
                    "dates with a time of day"
                } else {
                    "times of day"
                }
            ));
            return Some(Origin::Calendar(exact.whole(1), 0.0, has_date));
        };
        if !self.unit_is_stated && self.base.is_none() {
            let size = exact.value().abs();
            if let Some((_, to_s, unit)) = LARGE.iter().find(|(least, ..)| size >= *least) {
                self.to_s = *to_s;
                self.remarks.push(format!(
                    "`{}` states no unit; numbers as large as {cell} are taken for {unit} since 1970: a guess, which a unit in the header or `time = {{ channel, unit }}` in the rig file overrules",
                    self.name
                ));
            }
        }
        if exact.value().abs() * self.to_s < EPOCH_S {
            return Some(Origin::None);
        }
        let in_a_second = match self.to_s < 1.0 {
            true => (1.0 / self.to_s).round() as i128,
            false => 1,
        };
        let first = exact.whole(in_a_second);
        self.remarks.push(format!(
            "time is counted from {} s, the whole second of the first stamp",
            (first.value() * self.to_s).round()
        ));
        Some(Origin::Number(first))
    }
}

/// What the last digit of a number without an exponent counts.
fn resolution(cell: &str) -> f64 {
    let places = cell
        .find(['.', ','])
        .map_or(0, |mark| cell.len() - mark - 1);
    1.0 / (0..places).fold(1.0, |power, _| power * 10.0)
}
