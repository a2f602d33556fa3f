//! This file sets the runs of simulated operators beside the people of tables C.1 to C.6, one metric at a time.

use rigproof_model::trial::Metrics;
use rigproof_spec::layout::Layout;
use rigproof_spec::trials::{Averages, LINES, OPERATORS, averages};

use super::boxes::{Five, panel};
use super::trials::{ALL, AS_PRINTED, FIVE, LAYOUTS, Trial, Tried, all};
use crate::finding::with_unit;
use crate::outline;
use crate::{Column, Error, Finding, Outcome, Picture, Table};

/// One of the three metrics of §6.5.2.
pub struct Metric {
    pub name: &'static str,
    pub unit: &'static str,
    /// Whether it is drawn by its logarithm.
    pub logarithmic: bool,
    /// Of a run, in that unit.
    pub of: fn(&Metrics) -> f64,
    /// Of a cell of tables C.1 to C.6, in that unit.
    pub printed: fn(&Averages) -> f64,
}

/// All runs, and one metric of them.
pub struct Compared {
    pub metric: Metric,
    pub trials: &'static [Trial],
}

impl Compared {
    /// Runs the experiment.
    pub fn new(metric: Metric) -> Result<Compared, Error> {
        Ok(Compared {
            metric,
            trials: all()?,
        })
    }

    /// Every run of a controller on a configuration.
    pub fn values(&self, layout: Layout, tried: Tried) -> Vec<f64> {
        let of = self.trials.iter();
        of.filter(|trial| trial.layout == layout && trial.tried == tried)
            .map(|trial| (self.metric.of)(&trial.metrics))
            .collect()
    }

    /// Median, quartiles and whiskers.
    pub fn five(&self, layout: Layout, tried: Tried) -> Five {
        Five::of(&self.values(layout, tried))
    }

    pub fn median(&self, layout: Layout, tried: Tried) -> f64 {
        self.five(layout, tried).median
    }

    /// Mean of the runs of one cell of the tables.
    pub fn cell(&self, layout: Layout, tried: Tried, operator: u8, line: u8) -> f64 {
        let same = |trial: &&Trial| {
            (trial.layout, trial.tried, trial.operator, trial.line)
                == (layout, tried, operator, line)
        };
        let of = self.trials.iter().filter(same);
        mean(of.map(|trial| (self.metric.of)(&trial.metrics)))
    }

    /// The cells of tables C.1 to C.6 of a controller on a configuration.
    pub fn printed(&self, layout: Layout, tried: Tried) -> Vec<f64> {
        let mut cells = Vec::new();
        for (operator, line) in conditions() {
            let cell = averages(operator, layout, tried.method, line);
            cells.extend(cell.map(|cell| (self.metric.printed)(&cell)));
        }
        cells
    }

    /// Mean of those cells.
    pub fn printed_mean(&self, layout: Layout, tried: Tried) -> f64 {
        mean(self.printed(layout, tried).into_iter())
    }

    /// Tables, picture and findings.
    pub fn outcome(&self, title: &str, findings: Vec<Finding>) -> Outcome {
        Outcome {
            tables: vec![self.boxes(), self.averages()],
            pictures: vec![self.picture(title)],
            findings,
        }
    }

    fn boxes(&self) -> Table {
        let rows: Vec<(Layout, Tried)> = LAYOUTS
            .into_iter()
            .flat_map(|layout| ALL.map(|tried| (layout, tried)))
            .collect();
        let layouts: Vec<&str> = rows.iter().map(|(l, _)| outline::name(*l)).collect();
        let words: Vec<&str> = rows.iter().map(|(_, tried)| tried.words).collect();
        let fives: Vec<Five> = rows
            .iter()
            .map(|(l, tried)| self.five(*l, *tried))
            .collect();
        let unit = self.metric.unit;
        let column = |name: &str, pick: fn(&Five) -> f64| {
            let values: Vec<f64> = fives.iter().map(pick).collect();
            Column::numbers(name, unit, &values)
        };
        Table::new(
            "boxes",
            vec![
                Column::words("configuration", &layouts),
                Column::words("controller", &words),
                column("lower whisker", |five| five.whiskers[0]),
                column("lower quartile", |five| five.quartiles[0]),
                column("median", |five| five.median),
                column("upper quartile", |five| five.quartiles[1]),
                column("upper whisker", |five| five.whiskers[1]),
            ],
        )
    }

    /// The tables of appendix C with ours beside.
    fn averages(&self) -> Table {
        let (mut layouts, mut words) = (Vec::new(), Vec::new());
        let (mut operators, mut lines) = (Vec::new(), Vec::new());
        let (mut people, mut ours) = (Vec::new(), Vec::new());
        for layout in LAYOUTS {
            for (operator, line) in conditions() {
                for tried in ALL {
                    layouts.push(outline::name(layout));
                    words.push(tried.words);
                    operators.push(f64::from(operator));
                    lines.push(f64::from(line));
                    let cell = averages(operator, layout, tried.method, line);
                    let person = cell.filter(|_| tried != AS_PRINTED);
                    people.push(person.map_or(f64::NAN, |cell| (self.metric.printed)(&cell)));
                    ours.push(self.cell(layout, tried, operator, line));
                }
            }
        }
        let unit = self.metric.unit;
        Table::new(
            "appendix-c",
            vec![
                Column::words("configuration", &layouts),
                Column::numbers("operator", "", &operators),
                Column::numbers("line", "", &lines),
                Column::words("controller", &words),
                Column::numbers("person", unit, &people),
                Column::numbers("simulated operator", unit, &ours),
            ],
        )
    }

    fn picture(&self, title: &str) -> Picture {
        Picture {
            name: "boxes".to_owned(),
            title: title.to_owned(),
            subtitle: "three simulated operators, nine runs each on both lines; crossbars: outliers; dots: people, means of three (tables C.1 to C.6)"
                .to_owned(),
            panels: LAYOUTS.map(|layout| panel(self, layout)).into(),
        }
    }

    /// How the five controllers rank, people against simulated operators.
    pub fn order(&self, layout: Layout) -> Finding {
        let people = FIVE.map(|tried| (tried.letter, self.printed_mean(layout, tried)));
        let ours = FIVE.map(|tried| (tried.letter, self.median(layout, tried)));
        let mut swapped = Vec::new();
        for (i, (one, ours_one)) in ours.iter().enumerate() {
            for (j, (two, ours_two)) in ours.iter().enumerate().skip(i + 1) {
                let people = people.get(i).zip(people.get(j));
                let people = people.map_or(f64::NAN, |((_, p_1), (_, p_2))| p_1 - p_2);
                if people * (ours_one - ours_two) <= 0.0 {
                    swapped.push(format!("{one}{two}"));
                }
            }
        }
        let ours_text = match swapped.as_slice() {
            [] => ranked(ours),
            swapped => format!(
                "{}; {} of 10 pairs the same, not {}",
                ranked(ours),
                10 - swapped.len(),
                swapped.join(", ")
            ),
        };
        let finding = Finding::claim(
            "tables C.1 to C.6",
            format!(
                "{}: the order of the controllers in {}",
                outline::name(layout),
                self.metric.name
            ),
            ranked(people),
            (ours_text, swapped.is_empty()),
            "means of the tables' cells against medians of the runs, least first",
        );
        by_operators(finding)
    }

    /// One claim on both configurations: `holds` of each, with a text.
    pub fn claim(
        &self,
        (statement, stated): (&str, &str),
        of: impl Fn(Layout) -> (String, bool),
        because: &str,
    ) -> Finding {
        let [(three, three_holds), (four, four_holds)] = LAYOUTS.map(of);
        let text = format!("3-brake {three}; 4-brake {four}");
        let both = (text, three_holds && four_holds);
        Finding::claim("§6.6", statement, stated, both, because)
    }

    /// Medians of two controllers as text, and the ratio of the first to the second.
    pub fn ratio(&self, layout: Layout, one: Tried, other: Tried) -> (String, f64) {
        let (a, b) = (self.median(layout, one), self.median(layout, other));
        let unit = self.metric.unit;
        let text = format!(
            "{} {}, {} {}",
            one.letter,
            with_unit(a, unit),
            other.letter,
            with_unit(b, unit)
        );
        (text, a / b)
    }

    /// The same ratio in tables C.1 to C.6.
    pub fn printed_ratio(&self, layout: Layout, one: Tried, other: Tried) -> f64 {
        self.printed_mean(layout, one) / self.printed_mean(layout, other)
    }

    /// The printed ratios of both configurations, for a reason.
    pub fn printed_ratios(&self, one: Tried, other: Tried) -> String {
        let [three, four] = LAYOUTS.map(|layout| self.printed_ratio(layout, one, other));
        format!(
            "tables C: {}/{} {three:.2} and {four:.2}",
            one.letter, other.letter
        )
    }

    /// "The 4-brake configuration did not offer any measurable performance gains over the 3-brake configuration."
    pub fn no_gain(&self) -> Finding {
        let pairs = FIVE.map(|tried| {
            let [three, four] = LAYOUTS.map(|layout| self.five(layout, tried));
            (tried.letter, three, four)
        });
        // A gain that can be measured: the boxes do not overlap.
        let gains = pairs
            .iter()
            .filter(|(_, three, four)| four.quartiles[1] < three.quartiles[0]);
        let gains: Vec<&str> = gains.map(|(letter, ..)| *letter).collect();
        let medians: Vec<String> = pairs
            .iter()
            .map(|(letter, three, four)| {
                format!(
                    "{letter} {} and {}",
                    with_unit(three.median, ""),
                    with_unit(four.median, "")
                )
            })
            .collect();
        let finding = Finding::claim(
            "§6.6",
            format!(
                "the 4-brake configuration has no measurable gain in {}",
                self.metric.name
            ),
            "no gain",
            (
                format!(
                    "medians, 3- and 4-brake: {} {}",
                    medians.join(", "),
                    self.metric.unit
                ),
                gains.is_empty(),
            ),
            match gains.as_slice() {
                [] => {
                    "no box of the 4-brake configuration lies below that of the 3-brake".to_owned()
                }
                gains => format!(
                    "boxes of the 4-brake configuration that lie below: {}",
                    gains.join(", ")
                ),
            },
        );
        by_operators(finding)
    }
}

/// A disagreement that comes of the simulated operators, who are not the people of §6.5 (gap `operators-and-lines`).
pub fn by_operators(finding: Finding) -> Finding {
    match finding.is_unaccounted() {
        true => finding.accounted("operators-and-lines"),
        false => finding,
    }
}

fn conditions() -> impl Iterator<Item = (u8, u8)> {
    OPERATORS
        .into_iter()
        .flat_map(|operator| LINES.map(|line| (operator, line)))
}

pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value, n + 1.0));
    sum / count
}

fn ranked(mut values: [(&'static str, f64); 5]) -> String {
    values.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    values.map(|(letter, _)| letter).join(" < ")
}
