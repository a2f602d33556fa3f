//! This file finds the even grid of time stamps by least squares over all of them, because single
//! steps are rounded.

/// Fewest stamps that make a grid.
const LEAST_STAMPS: usize = 16;
/// Greatest distance from the grid, in steps, of a stamp that is on it.
const ON_GRID: f64 = 1e-6;
/// Greatest distance of a rounded stamp from the grid, in units of its last digit: half a unit, and
/// the error of the fit.
const ROUNDED: f64 = 0.75;
/// Greatest difference between the longest and the shortest burst, as a share of the usual one.
const BURSTS_DIFFER: f64 = 0.25;
/// Greatest share of stamps that may be left out because they are repeated.
const FEW: f64 = 0.02;
/// Iterations of the fit while samples are counted across gaps.
const ROUNDS: usize = 4;

/// An even grid through time stamps.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Its first time, s.
    pub start_s: f64,
    /// The mean step over the whole record, s.
    pub step_s: f64,
    /// The index of each stamp on the grid, from 0.
    pub places: Vec<f64>,
    /// Root mean square distance of the stamps from the grid, s.
    pub jitter_s: f64,
    /// Greatest distance of a stamp from the grid, s.
    pub worst_s: f64,
}

/// How to treat time stamps.
#[derive(Clone, Debug, PartialEq)]
pub enum Settled {
    /// As they are: they say as well as possible when the samples were taken.
    AsTheyAre,
    /// They are rounded, or shared by bursts of samples. These are the times on the grid, and the
    /// remark.
    Even(Vec<f64>, String),
    /// A few are repeated. These are the indices of the samples that count, and the remark.
    Once(Vec<usize>, String),
    /// Stamps are repeated without a pattern.
    Refused,
}

impl Grid {
    /// The grid through stamps that never decrease, each at its nearest index. `None` if no grid
    /// keeps their order.
    pub fn of(time_s: &[f64]) -> Option<Grid> {
        if time_s.len() < LEAST_STAMPS {
            return None;
        }
        let in_turn = Grid::through(time_s, (0..time_s.len()).map(|k| k as f64).collect());
        if in_turn.worst_s < 0.5 * in_turn.step_s {
            return Some(in_turn);
        }
        Grid::across_gaps(time_s)
    }

    /// The grid where samples are missing. They are counted by the usual step first, then by the
    /// fit.
    fn across_gaps(time_s: &[f64]) -> Option<Grid> {
        let steps = || {
            time_s
                .windows(2)
                .filter_map(|pair| Some(pair.get(1)? - pair.first()?))
        };
        let mut sorted: Vec<f64> = steps().filter(|step| *step > 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        let usual_s = *sorted.get(sorted.len() / 2)?;
        let counted = steps().scan(0.0, |place, step| {
            *place += (step / usual_s).round().max(1.0);
            Some(*place)
        });
        let mut grid = Grid::through(time_s, core::iter::once(0.0).chain(counted).collect());
        for _ in 0..ROUNDS {
            let place = |stamp: &f64| ((stamp - grid.start_s) / grid.step_s).round();
            let places: Vec<f64> = time_s.iter().map(place).collect();
            if places == grid.places {
                break;
            }
            if !places.is_sorted_by(|a, b| a < b) {
                return None;
            }
            grid = Grid::through(time_s, places);
        }
        (grid.worst_s < 0.5 * grid.step_s).then_some(grid)
    }

    /// The least-squares line of stamps over their indices.
    fn through(time_s: &[f64], places: Vec<f64>) -> Grid {
        let count = time_s.len().max(1) as f64;
        let origin_s = time_s.first().copied().unwrap_or(0.0);
        let mean_place = places.iter().sum::<f64>() / count;
        let mean_s = time_s.iter().map(|t| t - origin_s).sum::<f64>() / count;
        let pairs = || {
            time_s
                .iter()
                .zip(&places)
                .map(|(t, place)| (t - origin_s, *place))
        };
        let (mut with, mut own) = (0.0, 0.0);
        for (t, place) in pairs() {
            with += (place - mean_place) * (t - mean_s);
            own += (place - mean_place) * (place - mean_place);
        }
        let step_s = with / own;
        let offset_s = mean_s - step_s * mean_place;
        let off = || pairs().map(move |(t, place)| t - offset_s - step_s * place);
        Grid {
            start_s: origin_s + offset_s,
            step_s,
            jitter_s: (off().map(|off| off * off).sum::<f64>() / count).sqrt(),
            worst_s: off().map(f64::abs).fold(0.0, f64::max),
            places,
        }
    }

    /// The line through the first stamp of each burst. A line through all stamps would be too flat
    /// for few bursts.
    fn by_bursts(time_s: &[f64]) -> Option<Grid> {
        let pairs = time_s.windows(2).enumerate();
        let edges = pairs.filter(|(_, pair)| pair.first() != pair.get(1));
        let (places, stamps): (Vec<f64>, Vec<f64>) = edges
            .filter_map(|(k, pair)| Some(((k + 1) as f64, *pair.get(1)?)))
            .unzip();
        (places.len() > 2).then_some(())?;
        let line = Grid::through(&stamps, places);
        let off = |(k, t): (usize, &f64)| t - line.start_s - line.step_s * k as f64;
        let off: Vec<f64> = time_s.iter().enumerate().map(off).collect();
        let least = off.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = off.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let middle = least / 2.0 + greatest / 2.0;
        let squares = off.iter().map(|off| (off - middle) * (off - middle));
        Some(Grid {
            start_s: line.start_s + middle,
            step_s: line.step_s,
            jitter_s: (squares.sum::<f64>() / time_s.len() as f64).sqrt(),
            worst_s: greatest - middle,
            places: (0..time_s.len()).map(|k| k as f64).collect(),
        })
    }

    fn times(&self) -> Vec<f64> {
        let time = |place: &f64| self.start_s + self.step_s * place;
        self.places.iter().map(time).collect()
    }

    /// Whether every stamp lies within its own tolerance.
    fn fits(&self, time_s: &[f64], tolerance: impl Fn(f64) -> f64) -> bool {
        let pairs = time_s.iter().zip(&self.places);
        let mut off = pairs.map(|(t, place)| (t - self.start_s - self.step_s * place, *t));
        off.all(|(off, t)| off.abs() <= tolerance(t))
    }

    fn rate(&self) -> String {
        format!("{:.2} Hz", 1.0 / self.step_s)
    }
}

/// How to treat stamps that never decrease, whose last printed digit is worth `resolution_s`.
pub fn settle(time_s: &[f64], resolution_s: f64) -> Settled {
    match settle_on_grid(time_s, resolution_s) {
        // A step that is nothing beside the stamps, or that rounding makes nothing, tells no time.
        Settled::Even(times, _) if !times.is_sorted_by(|a, b| a < b) => Settled::Refused,
        settled => settled,
    }
}

fn settle_on_grid(time_s: &[f64], resolution_s: f64) -> Settled {
    let repeated = time_s
        .windows(2)
        .filter(|pair| pair.first() == pair.get(1))
        .count();
    if time_s.len() < LEAST_STAMPS {
        return if repeated > 0 {
            Settled::Refused
        } else {
            Settled::AsTheyAre
        };
    }
    let in_turn = || Grid::through(time_s, (0..time_s.len()).map(|k| k as f64).collect());
    let by_bursts = Grid::by_bursts(time_s).filter(|_| repeated > 0);
    let in_turn = by_bursts.unwrap_or_else(in_turn);
    if repeated == 0 && in_turn.worst_s < ON_GRID * in_turn.step_s {
        return Settled::AsTheyAre;
    }
    // Stamps with one interval, apart from gaps, were not rounded from another interval.
    if repeated == 0 && is_even_but_for_gaps(time_s) {
        return Settled::AsTheyAre;
    }
    let candidates = || core::iter::once(in_turn.clone()).chain(Grid::across_gaps(time_s));
    // A stamp in single precision has 24 bits.
    let single = |t: f64| {
        let nearest = t as f32;
        f64::from((nearest.next_up() - nearest).abs())
    };
    let is_single = time_s
        .iter()
        .all(|t| (t - f64::from(*t as f32)).abs() <= 0.51 * resolution_s);
    for grid in candidates().filter(|grid| grid.worst_s >= ON_GRID * grid.step_s) {
        if resolution_s.is_finite() && grid.fits(time_s, |_| ROUNDED * resolution_s) {
            let remark = format!(
                "time stamps are rounded to {resolution_s} s: all of them fit an even grid of {} and are put on it",
                grid.rate()
            );
            return Settled::Even(grid.times(), remark);
        }
        if is_single && grid.fits(time_s, |t| ROUNDED * single(t)) {
            let remark = format!(
                "time stamps have the digits of single precision only: all of them fit an even grid of {} and are put on it",
                grid.rate()
            );
            return Settled::Even(grid.times(), remark);
        }
    }
    match repeated {
        0 => Settled::AsTheyAre,
        _ => settle_repeated(time_s, repeated, &in_turn),
    }
}

/// Whether nearly all intervals between stamps are equal to rounding. That interval is then the
/// step, however long the gaps are.
pub fn is_even_but_for_gaps(time_s: &[f64]) -> bool {
    let mut between: Vec<f64> = time_s
        .windows(2)
        .filter_map(|pair| Some(pair.get(1)? - pair.first()?))
        .collect();
    between.sort_by(f64::total_cmp);
    let usual = between.get(between.len() / 2).copied().unwrap_or(0.0);
    let same = between
        .iter()
        .filter(|d| (*d - usual).abs() <= SAME * usual);
    same.count() as f64 >= NEARLY_ALL * between.len() as f64
}

/// Share of intervals that counts as nearly all.
const NEARLY_ALL: f64 = 0.9;

/// Relative difference of two equal intervals, from rounding.
const SAME: f64 = 1e-6;

/// How to treat stamps of which some are repeated.
fn settle_repeated(time_s: &[f64], repeated: usize, in_turn: &Grid) -> Settled {
    let bursts: Vec<&[f64]> = time_s.chunk_by(|a, b| a == b).collect();
    let starts = bursts.iter().filter_map(|burst| burst.first());
    let starts: Vec<f64> = starts.copied().collect();
    let mut between: Vec<f64> = starts
        .windows(2)
        .filter_map(|pair| Some(pair.get(1)? - pair.first()?))
        .collect();
    between.sort_by(f64::total_cmp);
    let usual_s = between.get(between.len() / 2).copied().unwrap_or(0.0);
    // The first and the last burst may be incomplete.
    let inner = bursts
        .get(1..bursts.len().saturating_sub(1))
        .unwrap_or_default();
    let mut lengths: Vec<f64> = inner.iter().map(|burst| burst.len() as f64).collect();
    lengths.sort_by(f64::total_cmp);
    let usual = lengths.get(lengths.len() / 2).copied().unwrap_or(0.0);
    let differ = lengths
        .last()
        .zip(lengths.first())
        .map_or(0.0, |(most, least)| most - least);
    let regular = lengths.len() > 2 && differ <= (BURSTS_DIFFER * usual).max(1.0);
    if regular && usual > 1.0 && in_turn.worst_s <= usual_s {
        let remark = format!(
            "about {usual} samples share a time stamp: they came in bursts and are put on an even grid of {}, which fits all stamps within {:.6} s",
            in_turn.rate(),
            in_turn.worst_s
        );
        return Settled::Even(in_turn.times(), remark);
    }
    if repeated as f64 > FEW * time_s.len() as f64 {
        return Settled::Refused;
    }
    let mut places: Vec<usize> = (0..time_s.len()).collect();
    places.dedup_by_key(|place| time_s.get(*place).copied().map(f64::to_bits));
    let remark = format!("{repeated} time stamps are repeated; the first sample of each counts");
    Settled::Once(places, remark)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples at an even rate, without the missing ones.
    fn even(rate_hz: f64, count: usize, missing: &[usize]) -> Vec<f64> {
        let kept = (0..count).filter(|k| !missing.contains(k));
        kept.map(|k| 0.37 + k as f64 / rate_hz).collect()
    }

    fn grid_places(rate_hz: f64, last_s: f64) -> f64 {
        ((last_s - 0.37) * rate_hz).round()
    }

    fn rounded(time_s: &[f64], digits: i32) -> Vec<f64> {
        let text = |t: &f64| format!("{t:.*}", usize::try_from(digits).unwrap());
        time_s.iter().map(|t| text(t).parse().unwrap()).collect()
    }

    #[test]
    fn rounded_stamps_are_put_on_the_grid_that_they_were_rounded_from() {
        for (rate_hz, digits, missing) in [
            (800.0, 3, &[][..]),
            (900.0, 6, &[]),
            (1024.0, 3, &[]),
            (300.0, 3, &[41, 42, 807]),
            (1500.0, 3, &[]),
            (3005.0, 3, &[]),
        ] {
            let exact = even(rate_hz, 4000, missing);
            let stamps = rounded(&exact, digits);
            let resolution_s = 1.0 / f64::from(10_i32.pow(digits as u32));
            let Settled::Even(times, remark) = settle(&stamps, resolution_s) else {
                panic!(
                    "{rate_hz} Hz, {digits} digits: {:?}",
                    Grid::of(&stamps).map(|g| g.worst_s)
                );
            };
            let worst = times
                .iter()
                .zip(&exact)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            assert!(worst < 0.05 * resolution_s, "{rate_hz} Hz: {worst}");
            let places = grid_places(rate_hz, exact[exact.len() - 1]);
            let mean_hz = places / (times[times.len() - 1] - times[0]);
            assert!((mean_hz / rate_hz - 1.0).abs() < 2e-5, "{mean_hz}");
            assert!(remark.contains("rounded to"), "{remark}");
        }
    }

    #[test]
    fn stamps_that_stand_still_are_no_time() {
        for stamp in [-0.006, 0.0, 1.7e9] {
            assert_eq!(settle(&[stamp; 40], 1e-3), Settled::Refused);
        }
    }

    #[test]
    fn single_precision_and_bursts_are_made_even() {
        let exact = even(1000.0, 60_000, &[]);
        let single: Vec<f64> = exact.iter().map(|t| f64::from(*t as f32)).collect();
        let seconds: Vec<f64> = (30..4000).map(|k| f64::from(k / 100)).collect();
        for (stamps, resolution_s, step_s, said) in [
            (single, 1e-17, 1e-3, "single precision"),
            (
                even(1000.0, 4000, &[])
                    .iter()
                    .map(|t| (t * 125.0).floor() / 125.0)
                    .collect(),
                1e-17,
                1e-3,
                "share a time stamp",
            ),
            (seconds, 1.0, 1e-2, "rounded to 1 s"),
        ] {
            let Settled::Even(times, remark) = settle(&stamps, resolution_s) else {
                panic!("{said}");
            };
            let mean_s = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
            assert!((mean_s / step_s - 1.0).abs() < 2e-3, "{mean_s}");
            assert!(remark.contains(said), "{remark}");
        }
    }

    #[test]
    fn true_jitter_and_even_stamps_stay_as_they_are() {
        let jitter = |k: usize| 2e-5 * libm::sin(1.7 * (k * k) as f64);
        let stamps: Vec<f64> = (0..3000).map(|k| 1e-3 * k as f64 + jitter(k)).collect();
        assert_eq!(settle(&stamps, 1e-9), Settled::AsTheyAre);
        let grid = Grid::of(&stamps).unwrap();
        assert!((grid.step_s - 1e-3).abs() < 1e-9 && (grid.jitter_s - 1.4e-5).abs() < 1e-6);
        assert_eq!(settle(&even(1000.0, 900, &[]), 1e-5), Settled::AsTheyAre);
        assert_eq!(
            settle(&even(1000.0, 900, &[7, 8, 30]), 1e-5),
            Settled::AsTheyAre
        );
    }

    #[test]
    fn the_rate_is_the_mean_over_the_record_and_gaps_are_counted() {
        for (rate_hz, missing) in [
            (900.0, &[][..]),
            (3005.0, &[5, 6, 7, 1000]),
            (1024.0, &[200]),
        ] {
            let grid = Grid::of(&rounded(&even(rate_hz, 3000, missing), 6)).unwrap();
            assert!((grid.step_s * rate_hz - 1.0).abs() < 1e-6, "{rate_hz}");
            assert_eq!(grid.places.last(), Some(&2999.0));
        }
    }

    #[test]
    fn a_few_repeated_stamps_count_once_and_many_are_refused() {
        let mut stamps = even(1000.0, 900, &[]);
        stamps[300] = stamps[299];
        stamps.insert(601, stamps[600]);
        stamps.insert(602, stamps[600]);
        let Settled::Once(places, remark) = settle(&stamps, 1e-9) else {
            panic!("{:?}", settle(&stamps, 1e-9));
        };
        assert_eq!(
            (places.len(), remark.starts_with("3 time stamps")),
            (899, true)
        );
        let irregular: Vec<f64> = (0..900)
            .map(|k: i32| f64::from(k - k % (2 + k / 100 % 7)))
            .collect();
        let mut irregular: Vec<f64> = irregular;
        irregular.sort_by(f64::total_cmp);
        assert_eq!(settle(&irregular, 1e-9), Settled::Refused);
    }
}
