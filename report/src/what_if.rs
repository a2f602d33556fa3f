//! This file answers what would be left over if a named effect were not in the model, and how alike the effects act: the browser works it out as somebody switches.

use maud::{Markup, html};
use rigproof_diagnose::Curves;
use serde::Serialize;

use crate::chart::rounded;
use crate::words::{capital, plain_cause};

/// Two effects whose contributions correlate by so much are hardly told apart.
const ALIKE: f64 = 0.8;

/// What is needed to say what is left over with some of the named effects switched off.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WhatIf {
    /// The effects, in plain words.
    #[serde(skip)]
    pub names: Vec<String>,
    /// The curve of the chart that changes.
    pub curve: usize,
    /// What noise alone leaves, in the residual's unit.
    pub floor: f64,
    /// How many windows count in each stretch of the chart.
    pub counts: Vec<usize>,
    /// For each stretch the means of the products of residual and contributions, two by two: the rows of the lower triangle one after another.
    pub products: Vec<Vec<f64>>,
}

impl WhatIf {
    /// Of stretches of `size` windows; nothing where nothing is named.
    pub fn of(curves: &Curves, size: usize, curve: usize) -> Option<WhatIf> {
        if curves.contributed.is_empty() {
            return None;
        }
        let efforts = curves.contributed.iter().map(|own| own.effort.as_slice());
        let rows: Vec<&[f64]> = [curves.residual_after.as_slice()]
            .into_iter()
            .chain(efforts)
            .collect();
        let at = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        let counts = |k: &usize| {
            let is_counted = curves.window_counts.get(*k).copied().unwrap_or(false);
            is_counted && rows.iter().all(|row| at(row, *k).is_finite())
        };
        let windows: Vec<usize> = (0..curves.window_time_s.len()).collect();
        let stretches = windows.chunks(size.max(1)).map(|stretch| {
            let counted: Vec<usize> = stretch.iter().copied().filter(counts).collect();
            let mean = |one: &[f64], other: &[f64]| {
                let sum: f64 = counted.iter().map(|k| at(one, *k) * at(other, *k)).sum();
                rounded(sum / counted.len().max(1) as f64, 7)
            };
            let mut products = Vec::new();
            for (i, one) in rows.iter().copied().enumerate() {
                products.extend(
                    rows.iter()
                        .take(i + 1)
                        .copied()
                        .map(|other| mean(one, other)),
                );
            }
            (counted.len(), products)
        });
        let (counts, products) = stretches.unzip();
        let names = curves.contributed.iter().map(|own| plain_cause(&own.name));
        Some(WhatIf {
            names: names.collect(),
            curve,
            floor: curves.floor,
            counts,
            products,
        })
    }

    /// A switch for each effect of the chart `id`, and what is left over as they stand.
    pub fn switches(&self, id: &str) -> Markup {
        html! {
            fieldset.switches {
                legend { "In the new model" }
                @for name in &self.names { label { input type="checkbox" checked autocomplete="off" data-what-if=(id); " " (capital(name)) } }
            }
            p role="status" #{ "what-if-" (id) } {}
        }
    }

    /// How alike two effects act in the recording, from −1 to 1.
    fn alike(&self, one: usize, other: usize) -> f64 {
        let sum = |i: usize, j: usize| -> f64 {
            let (high, low) = (i.max(j) + 1, i.min(j) + 1);
            let place = high * (high + 1) / 2 + low;
            let pairs = self.products.iter().zip(&self.counts);
            pairs
                .map(|(own, count)| own.get(place).copied().unwrap_or(0.0) * *count as f64)
                .sum()
        };
        let size = (sum(one, one) * sum(other, other)).sqrt();
        if size > 0.0 {
            sum(one, other) / size
        } else {
            0.0
        }
    }

    /// How alike the named effects act, as a picture, folded up where all are told apart; nothing where fewer than two are named.
    pub fn correlations(&self) -> Option<Markup> {
        let count = self.names.len();
        let pairs = (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
        let most = pairs
            .map(|(i, j)| self.alike(i, j).abs())
            .fold(0.0, f64::max);
        (count > 1).then(|| {
            html! {
                details open[most >= ALIKE] { summary { "How alike the named effects act" } figure {
                    div.scroll { table.heat #correlations {
                        caption { strong { "How alike they act." } " Correlation of what two named effects do in this recording: near 1 or −1 it hardly tells them apart, and their numbers are uncertain together." }
                        thead { tr { td {} @for name in &self.names { th scope="col" { (name) } } } }
                        tbody { @for (i, name) in self.names.iter().enumerate() { tr {
                            th scope="row" { (name) }
                            @for j in 0..count { @let own = self.alike(i, j); td.cell style={ "--share: " (format!("{:.2}", if i == j { 0.0 } else { own.abs() })) } { @if i == j { "–" } @else { (signed(own)) } } }
                        } } }
                    } }
                    div.tools { button type="button" data-save-table="correlations" aria-label="Save CSV: how alike they act" { "Save CSV" } }
                } }
            }
        })
    }
}

/// With two decimals and a minus that is one; what rounds to nothing has no sign.
fn signed(value: f64) -> String {
    let text = format!("{:.2}", (100.0 * value).round() / 100.0 + 0.0);
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_diagnose::Contributed;

    fn curves() -> Curves {
        let part = |name: &str, effort: [f64; 5]| Contributed {
            name: name.to_owned(),
            effort: effort.to_vec(),
        };
        Curves {
            window_time_s: vec![0.5, 1.5, 2.5, 3.5, 4.5],
            window_counts: vec![true, true, false, true, true],
            residual_after: vec![0.1, -0.3, f64::NAN, 0.2, 0.4],
            contributed: vec![
                part("viscous", [1.5, -2.5, 9.0, 0.5, 3.5]),
                part("dry_offset", [2.0, -2.0, 9.0, 2.0, 2.0]),
            ],
            floor: 0.05,
            ..Curves::default()
        }
    }

    #[test]
    fn what_is_left_without_an_effect_comes_out_of_the_products() {
        let own = WhatIf::of(&curves(), 3, 1).unwrap();
        assert_eq!(own.counts, [2, 2]);
        // The residual and the first effect, of the second stretch: 0.2, 0.4 and 0.5, 3.5.
        let [residual, mixed, effect] = [0, 1, 2].map(|k| own.products[1][k]);
        let directly = (0.7_f64.powi(2) + 3.9_f64.powi(2)) / 2.0;
        assert!((residual + 2.0 * mixed + effect - directly).abs() < 1e-5);
        assert!(WhatIf::of(&Curves::default(), 3, 1).is_none());
    }

    #[test]
    fn effects_that_act_alike_are_said_to() {
        let own = WhatIf::of(&curves(), 3, 1).unwrap();
        // By hand: 3 + 5 + 1 + 7 over the root of (2.25 + 6.25 + 0.25 + 12.25) · 16.
        assert!((own.alike(0, 1) - 16.0 / (21.0_f64 * 16.0).sqrt()).abs() < 1e-5);
        assert!((own.alike(1, 1) - 1.0).abs() < 1e-6);
        assert_eq!(signed(-0.001), "0.00");
        assert!(own.correlations().unwrap().into_string().contains("0.87"));
    }
}
