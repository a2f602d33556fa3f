//! This file says what a channel looks like: range, quantum, noise, missing samples, and a line of text as its picture.

use rigproof_trace::Channel;
use rigproof_trace::mcap::ChannelSummary;
use rigproof_trace::suggest::short;
use serde_json::{Value, json};

use super::noise;
use super::sparkline;
use crate::text::number::{significant, stated};

/// How far off its grid a value may lie, in steps of the grid: printed digits are rounded.
const OFF_GRID: f64 = 0.02;
/// Fewer different values do not make a grid.
const LEAST_VALUES: usize = 4;
/// More steps than this cannot be told from no grid: rounding of the printed digits adds up.
const MOST_STEPS: f64 = 1e7;

/// A channel as it is shown.
pub struct SignalView {
    pub name: String,
    /// As printed, or as the name suggests; empty when neither says anything.
    pub unit: String,
    /// Whether only the name suggests the unit.
    pub unit_is_guessed: bool,
    /// Samples, missing ones among them.
    count: u64,
    /// Samples that are missing or not finite.
    missing: u64,
    /// Least and greatest sample, or nothing where all are missing.
    range: Option<(f64, f64)>,
    /// The smallest step between two values that occur, and whether all lie on its grid.
    pub quantum: Option<(f64, bool)>,
    /// About the standard deviation of the noise of a sample, where there are samples enough to tell.
    pub noise: Option<f64>,
    /// What its picture shows.
    outline: Vec<f64>,
}

impl SignalView {
    /// Of a channel that is at hand.
    pub fn of(channel: Channel) -> SignalView {
        let values = sorted(channel.samples.clone());
        let missing = channel.samples.len() - values.len();
        SignalView {
            count: channel.samples.len() as u64,
            missing: missing as u64,
            range: values.first().copied().zip(values.last().copied()),
            quantum: quantum(&values),
            noise: noise::of(&channel.samples),
            unit: channel.likely_unit().to_owned(),
            unit_is_guessed: channel.unit != channel.likely_unit(),
            name: channel.name,
            outline: channel.samples,
        }
    }

    /// A channel of a sweep, whose rows do not follow each other in time: their scatter is no noise.
    pub fn of_sweep(channel: Channel) -> SignalView {
        SignalView {
            noise: None,
            ..SignalView::of(channel)
        }
    }

    /// From the least to the greatest sample; nothing where all are missing.
    pub fn span(&self) -> Option<f64> {
        self.range.map(|(least, greatest)| greatest - least)
    }

    /// Its samples, where they are at hand.
    pub fn samples(&self) -> &[f64] {
        &self.outline
    }

    /// Of a channel that was summed up while its file went by: the grid is made by the least step between neighbours,
    /// and the values that were kept are looked at.
    pub fn of_summary(channel: ChannelSummary) -> SignalView {
        let middle = |(least, greatest): &(f64, f64)| least / 2.0 + greatest / 2.0;
        let range = (channel.minimum, channel.maximum);
        let mut kept = channel.runs.concat();
        kept.extend([channel.minimum, channel.maximum]);
        let kept = sorted(kept);
        // A step in the last bits only is none; the least one between the values kept is then.
        let step = channel.quantum.filter(|step| *step > same(&kept));
        SignalView {
            count: channel.count + channel.not_finite,
            missing: channel.not_finite,
            range: Some(range).filter(|_| channel.count > 0),
            quantum: step
                .map(|step| (step, is_grid(&kept, step)))
                .or_else(|| quantum(&kept)),
            noise: noise::of_runs(channel.runs.iter().copied()),
            outline: channel.outline.iter().map(middle).collect(),
            unit_is_guessed: channel.unit_is_guessed,
            name: channel.address,
            unit: channel.unit,
        }
    }

    /// The greatest magnitude.
    pub fn size(&self) -> Option<f64> {
        let (least, greatest) = self.range?;
        Some(least.abs().max(greatest.abs())).filter(|size| *size > 0.0)
    }

    pub fn json(&self, ascii: bool) -> Value {
        json!({
            "name": self.name, "unit": self.unit, "unit_is_guessed": self.unit_is_guessed, "samples": self.count, "missing": self.missing,
            "minimum": self.range.map(|(least, _)| least),
            "maximum": self.range.map(|(_, greatest)| greatest),
            "quantum": self.quantum.map(|(step, _)| step),
            "on_grid": self.quantum.map(|(_, on_grid)| on_grid),
            "noise": self.noise,
            "sparkline": sparkline::draw(&self.outline, self.range, ascii),
        })
    }

    fn cells(&self, ascii: bool) -> [String; 5] {
        let guess = match self.unit_is_guessed {
            true => format!("{} (a guess from the name)", self.unit),
            false => self.unit.clone(),
        };
        let unit = self.unit.as_str();
        let range = match (self.range, self.quantum) {
            (None, _) => "no sample".to_owned(),
            (Some((value, _)), None) => stated(value, &guess),
            (Some((least, greatest)), _) => {
                // As many digits as tell the ends apart, and two more where four do not.
                let differ =
                    |digits: &usize| significant(least, *digits) != significant(greatest, *digits);
                let digits = match (4..15).find(differ) {
                    Some(4) => 4,
                    Some(digits) => digits + 2,
                    None => 17,
                };
                let [least, greatest] = [least, greatest].map(|end| significant(end, digits));
                format!("{least} to {greatest} {guess}")
                    .trim_end()
                    .to_owned()
            }
        };
        let quantum = match (self.quantum, self.noise) {
            (None, _) if self.range.is_none() => String::new(),
            (None, _) if self.count == 1 => "one sample".to_owned(),
            (None, _) => "never moves".to_owned(),
            (Some((step, true)), _) => format!("quantum {}", stated(step, unit)),
            (Some(_), Some(noise)) => format!("noise up to {}", stated(noise, unit)),
            (Some((step, false)), None) => format!("least step {}", stated(step, unit)),
        };
        let missing = match self.missing {
            0 => String::new(),
            count => format!("{count} missing"),
        };
        let picture = sparkline::draw(&self.outline, self.range, ascii);
        [
            short(&self.name).into_owned(),
            picture,
            range,
            quantum,
            missing,
        ]
    }
}

/// The channels in a table, and how many that never move are left out because there are too many of them.
pub fn lines(signals: &[&SignalView], ascii: bool, most_still: usize) -> Vec<String> {
    let mut still = 0;
    let shown = signals.iter().filter(|signal| {
        still += usize::from(signal.quantum.is_none());
        signal.quantum.is_some() || still <= most_still
    });
    let rows: Vec<[String; 5]> = shown.map(|signal| signal.cells(ascii)).collect();
    let mut widths = [0; 5];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = cell.chars().count().max(*width);
        }
    }
    let line = |row: &[String; 5]| {
        let cells = row.iter().zip(widths);
        let cells = cells.map(|(cell, width)| format!("  {cell:<width$}"));
        cells.collect::<String>().trim_end().to_owned()
    };
    let left_out = still.saturating_sub(most_still);
    let more = (left_out > 0)
        .then(|| format!("  and {left_out} more that never move, which --json names"));
    rows.iter().map(line).chain(more).collect()
}

/// The values that are some, from the least to the greatest.
fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.retain(|x| x.is_finite());
    values.sort_by(f64::total_cmp);
    values
}

/// What differs by less, in the last bits only, is one value.
fn same(sorted: &[f64]) -> f64 {
    let ends = [sorted.first(), sorted.last()].into_iter().flatten();
    1e-13 * ends.fold(0.0, |most, end| end.abs().max(most))
}

/// The smallest step between sorted values, and whether all lie on the grid that it makes.
fn quantum(sorted: &[f64]) -> Option<(f64, bool)> {
    let same = same(sorted);
    let steps = sorted.windows(2).filter_map(|pair| match pair {
        [a, b] => Some(b - a),
        _ => None,
    });
    let step = steps
        .filter(|step| *step > same)
        .min_by(f64::total_cmp)
        .filter(|step| step.is_finite())?;
    Some((step, is_grid(sorted, step)))
}

/// Whether sorted values, several of which differ, lie on a grid of this step.
fn is_grid(sorted: &[f64], step: f64) -> bool {
    let Some(least) = sorted.first() else {
        return false;
    };
    let on_grid = |value: &f64| {
        let steps = (value - least) / step;
        steps < MOST_STEPS && (steps - steps.round()).abs() < OFF_GRID * steps.clamp(1.0, 10.0)
    };
    let mut values = sorted.to_vec();
    values.dedup_by(|b, a| *b - *a < step / 2.0);
    values.len() >= LEAST_VALUES && sorted.iter().all(on_grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(samples: Vec<f64>) -> SignalView {
        SignalView::of(Channel {
            name: "x".into(),
            unit: "mm".into(),
            samples,
        })
    }

    #[test]
    fn an_encoder_lies_on_a_grid_and_noise_does_not() {
        let encoder = (0..90)
            .map(|k| 0.25 + 0.05 * f64::from((k * k) % 37))
            .collect();
        let (step, on_grid) = view(encoder).quantum.unwrap();
        assert!((step - 0.05).abs() < 1e-12 && on_grid, "{step}");
        let noise = (1..90).map(|k| libm::sin(1.7 * f64::from(k * k))).collect();
        assert!(!view(noise).quantum.unwrap().1);
        assert!(view(vec![2.5; 40]).quantum.is_none());
    }

    #[test]
    fn a_range_has_as_many_digits_as_tell_its_ends_apart() {
        let late = view(vec![1.490e9, 1.490e9 + 7.0]);
        assert_eq!(late.cells(true)[2], "1.4900000000e9 to 1.4900000070e9 mm");
        assert_eq!(view(vec![-2.5, 7.25]).cells(true)[2], "-2.500 to 7.250 mm");
    }

    #[test]
    fn missing_samples_are_counted_and_left_out() {
        let seen = view(vec![1.5, f64::NAN, -2.5, f64::NAN]);
        assert_eq!((seen.missing, seen.range), (2, Some((-2.5, 1.5))));
        let unseen = view(vec![f64::NAN; 3]);
        assert_eq!(unseen.cells(true)[1..3], ["   ", "no sample"]);
    }
}
