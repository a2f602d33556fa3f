//! This file measures how reliable a diagnosis is: it is repeated on simulated recordings like the
//! real one, whose causes are known.

use crate::Options;
use crate::plants::{Description, Measured, Replica};
use crate::report::{NamedRate, Rate, Report, SelfCalibration};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use statrs::distribution::{Beta, ContinuousCDF};
use std::collections::{BTreeMap, BTreeSet};

/// The simulated recordings of one diagnosis, before noise.
pub struct SelfTest<'a> {
    rig: &'a Description,
    options: Options,
    whole: bool,
    /// With nothing left out of the model, its parameters fitted.
    nothing: Replica,
    /// With the found mechanisms left out, and their names; `None` if nothing was found.
    found: Option<(Replica, BTreeSet<String>)>,
    runs: usize,
}

/// The names found in one simulated recording; `None` if its diagnosis ended in a fault or too
/// little motion.
pub type Named = Option<BTreeSet<String>>;

impl<'a> SelfTest<'a> {
    /// Simulates the recordings of the rig with and without the found mechanisms. With `whole` the
    /// diagnosis held out another recording.
    ///
    /// # Errors
    /// Why it cannot be simulated.
    pub fn new(
        rig: &'a Description,
        recording: &Measured,
        (calibration, report): (&Description, &Report),
        (whole, runs): (bool, usize),
        options: &Options,
    ) -> Result<SelfTest<'a>, String> {
        let names: BTreeSet<String> = names(report);
        let nothing = rig.replica(&rig.without_found(calibration), recording)?;
        let found = match names.is_empty() {
            true => None,
            false => Some((rig.replica(calibration, recording)?, names)),
        };
        Ok(SelfTest {
            rig,
            options: Options {
                refit: false,
                next_experiment: false,
                ..options.clone()
            },
            whole,
            nothing,
            found,
            runs,
        })
    }

    /// The number of recordings to diagnose. Those with nothing left out come first.
    pub fn len(&self) -> usize {
        self.runs * (1 + usize::from(self.found.is_some()))
    }

    /// Whether there are no recordings.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Diagnoses recording `k`. Its noise is seeded by `k`.
    pub fn named(&self, k: usize) -> Named {
        let exact = match &self.found {
            Some((found, _)) if k >= self.runs => found,
            _ => &self.nothing,
        };
        let mut random = Pcg64Mcg::seed_from_u64(k as u64);
        let recording = [exact.recording.sensed(exact.noise, &mut random)];
        let held_out = recording.first().filter(|_| self.whole);
        let diagnosis = self.rig.diagnose(&recording, held_out, &self.options)?;
        let report = diagnosis.report;
        report.floor.is_some().then(|| names(&report))
    }

    /// The summary of all recordings, in the order of their numbers.
    pub fn account(&self, named: &[Named]) -> SelfCalibration {
        let nothing = || named.iter().take(self.runs).flatten();
        let with = || named.iter().skip(self.runs).flatten();
        let hidden = self.found.as_ref().map(|(_, names)| names);
        let rate = |count: usize, of: usize| rate(count, of);
        let diagnosed = with().count();
        let mut false_names = BTreeMap::new();
        let none = BTreeSet::new();
        let extra = with().flat_map(|own| own.difference(hidden.unwrap_or(&none)));
        for name in nothing().flatten().chain(extra) {
            *false_names.entry(name.clone()).or_insert(0) += 1;
        }
        let all = nothing().count() + diagnosed;
        let mut false_names: Vec<NamedRate> = false_names
            .into_iter()
            .map(|(name, count)| NamedRate {
                name,
                rate: rate(count, all),
            })
            .collect();
        false_names.sort_by_key(|own| core::cmp::Reverse(own.rate.count));
        SelfCalibration {
            protocol: self.protocol(all),
            false_alarms: rate(
                nothing().filter(|own| !own.is_empty()).count(),
                nothing().count(),
            ),
            exact: hidden.map(|names| rate(with().filter(|own| *own == names).count(), diagnosed)),
            found_again: hidden
                .into_iter()
                .flatten()
                .map(|name| NamedRate {
                    name: name.clone(),
                    rate: rate(with().filter(|own| own.contains(name)).count(), diagnosed),
                })
                .collect(),
            false_names,
        }
    }

    fn protocol(&self, diagnosed: usize) -> String {
        let how = self.nothing.how;
        let ended = self.len() - diagnosed;
        let without = match ended {
            0 => String::new(),
            1 => "; one of them was not usable and does not count".to_owned(),
            _ => format!("; {ended} of them were not usable and do not count"),
        };
        format!(
            "{how}; fresh noise and counts; {} recordings with nothing left out{}, each named as this one was{without}",
            self.runs,
            if self.found.is_some() {
                format!(" and {} with what was found", self.runs)
            } else {
                String::new()
            }
        )
    }
}

fn names(report: &Report) -> BTreeSet<String> {
    let effects = report.effects.iter();
    effects
        .map(|effect| match effect.joint {
            Some(joint) => format!("{} at {joint}", effect.mechanism),
            None => effect.mechanism.to_owned(),
        })
        .collect()
}

/// A count of `of` with its 95 % interval.
fn rate(count: usize, of: usize) -> Rate {
    // Quantiles of the beta distribution (Clopper and Pearson 1934). For no or all hits one end is
    // 0 or 1.
    let quantile = |share: f64, a: usize, b: usize| {
        Beta::new(a as f64, b as f64).map_or(f64::NAN, |beta| beta.inverse_cdf(share))
    };
    Rate {
        count,
        of,
        low95: match count {
            0 => 0.0,
            _ => quantile(0.025, count, of - count + 1),
        },
        high95: match of - count {
            0 => 1.0,
            rest => quantile(0.975, count + 1, rest),
        },
    }
}

#[cfg(test)]
mod tests;
