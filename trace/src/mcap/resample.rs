//! This file brings samples from their own times to the times of another channel.

use super::pace::{GAP_STEPS, median};

/// How a signal goes on between its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// In a straight line, and not across a gap: for what is measured.
    Line,
    /// At the last value until the next one comes: for commands.
    Held,
}

/// Times in order, each of them once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ordered {
    pub(super) time_s: Vec<f64>,
    /// Places of the samples that count, where not all of them do as they came.
    places: Option<Vec<usize>>,
    /// Samples that came after a later one.
    pub(super) moved: usize,
    /// Samples left out because their time was taken, or is none.
    pub(super) dropped: usize,
}

impl Ordered {
    /// The samples of these times.
    pub(super) fn put(&self, values: Vec<f64>) -> Vec<f64> {
        match &self.places {
            None => values,
            Some(places) => at_places(&values, places),
        }
    }
}

fn at_places(values: &[f64], places: &[usize]) -> Vec<f64> {
    let samples = places.iter().map(|place| values.get(*place).copied());
    samples.map(|value| value.unwrap_or(f64::NAN)).collect()
}

/// Puts times in order; of equal ones the first counts. What is in order stays where it is in memory.
pub(super) fn order(time_s: Vec<f64>) -> Ordered {
    let in_order = time_s.is_sorted_by(|a, b| a < b);
    let ends = [time_s.first(), time_s.last()];
    if in_order && ends.into_iter().flatten().all(|time_s| time_s.is_finite()) {
        return Ordered {
            time_s,
            ..Ordered::default()
        };
    }
    let mut places: Vec<usize> = (0..time_s.len()).collect();
    let at = |place: usize| time_s.get(place).copied().unwrap_or(f64::NAN);
    let moved = time_s
        .windows(2)
        .filter(|pair| matches!(pair, [a, b] if b < a))
        .count();
    places.retain(|place| at(*place).is_finite());
    if moved > 0 {
        places.sort_by(|a, b| at(*a).total_cmp(&at(*b)));
    }
    places.dedup_by(|later, first| at(*later) <= at(*first));
    Ordered {
        time_s: at_places(&time_s, &places),
        dropped: time_s.len() - places.len(),
        places: Some(places),
        moved,
    }
}

/// A clock that was set back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SetBack {
    pub(super) after_s: f64,
    pub(super) by_s: f64,
    /// Messages until it gets there again.
    pub(super) messages: usize,
}

/// More messages in a row than these do not just come late.
const LATE: usize = 8;

/// Where a clock was set back: many messages in a row are older than one before them. A few late ones are none.
pub(super) fn went_back(time_s: &[f64]) -> Option<SetBack> {
    let steps = time_s
        .windows(2)
        .filter_map(|pair| Some(pair.get(1)? - pair.first()?));
    let usual_s = median(steps.filter(|step| *step > 0.0).collect());
    let limit_s = GAP_STEPS * usual_s;
    let (mut latest_s, mut is_stray) = (f64::NEG_INFINITY, false);
    let mut back: Option<SetBack> = None;
    for &t in time_s {
        if t >= latest_s {
            if back.is_some_and(|back| back.messages > LATE) {
                return back;
            }
            // One stamp far ahead of the others sets no clock.
            is_stray = t - latest_s > limit_s && latest_s.is_finite();
            (latest_s, back) = (t, None);
        } else if !is_stray && (latest_s - t > limit_s || back.is_some()) {
            let begun = back.unwrap_or(SetBack {
                after_s: latest_s,
                by_s: latest_s - t,
                messages: 0,
            });
            back = Some(SetBack {
                messages: begun.messages + 1,
                ..begun
            });
        }
    }
    back.filter(|back| back.messages > LATE)
}

/// The values at other times, NaN before the first sample, and, in straight lines, across a gap and after the last.
///
/// A sample at the very time asked for is taken as it is. A gap is a step longer than [`GAP_STEPS`] times the median
/// step; the number of gaps is answered too.
pub(super) fn resample(
    time_s: &[f64],
    values: &[f64],
    wanted_s: &[f64],
    between: Between,
) -> (Vec<f64>, usize) {
    let steps = || {
        time_s
            .windows(2)
            .filter_map(|pair| Some(pair.get(1)? - pair.first()?))
    };
    let limit_s = match between {
        Between::Line => GAP_STEPS * median(steps().collect()),
        Between::Held => f64::INFINITY,
    };
    let gaps = steps().filter(|step_s| *step_s > limit_s).count();
    let mut after = 0;
    let value = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
    let sampled = wanted_s.iter().map(|&wanted_s| {
        while time_s.get(after).is_some_and(|time_s| *time_s <= wanted_s) {
            after += 1;
        }
        let Some(before) = after.checked_sub(1) else {
            return f64::NAN;
        };
        let start_s = time_s.get(before).copied().unwrap_or(f64::NAN);
        match (between, time_s.get(after)) {
            _ if start_s == wanted_s => value(before),
            (Between::Held, _) => value(before),
            (Between::Line, Some(end_s)) if end_s - start_s <= limit_s => {
                let share = (wanted_s - start_s) / (end_s - start_s);
                value(before) + share * (value(after) - value(before))
            }
            _ => f64::NAN,
        }
    });
    (sampled.collect(), gaps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_lines_end_at_gaps_and_held_values_do_not() {
        let time_s = [0.11, 0.21, 0.31, 0.91, 1.01];
        let values = [3.0, 5.0, 4.0, 8.0, 9.5];
        let wanted_s = [0.05, 0.11, 0.135, 0.31, 0.6, 0.96, 1.2];
        let (line, gaps) = resample(&time_s, &values, &wanted_s, Between::Line);
        assert_eq!(gaps, 1);
        assert!(line[0].is_nan() && line[4].is_nan() && line[6].is_nan());
        assert_eq!((line[1], line[3]), (3.0, 4.0));
        assert!((line[2] - 3.5).abs() < 1e-12 && (line[5] - 8.75).abs() < 1e-12);
        let (held, gaps) = resample(&time_s, &values, &wanted_s, Between::Held);
        assert_eq!(gaps, 0);
        assert!(held[0].is_nan());
        assert_eq!(held[1..], [3.0, 3.0, 4.0, 4.0, 8.0, 9.5]);
    }

    #[test]
    fn a_clock_that_was_set_back_is_told_from_late_messages() {
        let even = |k: usize| 2.5 + 1e-3 * k as f64;
        for (by_s, from) in [(0.5, 700), (0.05, 400), (30.0, 980)] {
            let set_back = (0..1000).map(|k| even(k) - if k < from { 0.0 } else { by_s });
            let back = went_back(&set_back.collect::<Vec<_>>()).unwrap();
            assert!((back.by_s - by_s).abs() < 1.5e-3, "{back:?}");
            assert!((back.after_s - even(from - 1)).abs() < 1e-9, "{back:?}");
        }
        let mut late: Vec<f64> = (0..1000).map(even).collect();
        late.swap(30, 32);
        late[500..506].rotate_right(1);
        assert_eq!(went_back(&late), None);
        let mut stray: Vec<f64> = (0..1000).map(even).collect();
        stray[300] += 0.4;
        assert_eq!(went_back(&stray), None);
        assert_eq!(went_back(&[]), None);
    }

    #[test]
    fn samples_out_of_order_are_moved_and_repeated_times_count_once() {
        let ordered = order(vec![0.3, 0.1, f64::NAN, 0.2, 0.3, f64::INFINITY]);
        assert_eq!(ordered.time_s, [0.1, 0.2, 0.3]);
        let values = vec![7.5, 3.25, 8.5, 4.75, 9.5, 1.5];
        assert_eq!(ordered.put(values.clone()), [3.25, 4.75, 7.5]);
        assert_eq!((ordered.moved, ordered.dropped), (1, 3));
        for time_s in [[0.1, 0.2, f64::INFINITY], [f64::NEG_INFINITY, 0.1, 0.2]] {
            let ordered = order(time_s.to_vec());
            assert_eq!((ordered.time_s, ordered.dropped), (vec![0.1, 0.2], 1));
        }
        let untouched = order(vec![0.1, 0.25, 0.3]);
        assert_eq!(untouched.put(values[..3].to_vec()), values[..3]);
        assert_eq!((untouched.moved, untouched.dropped), (0, 0));
    }
}
