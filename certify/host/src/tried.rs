//! This file tries a compiled controller: one trial on a rig whose tip is led to and fro, and how long the ticks take.

use std::time::Instant;

use rigproof_certify::controller::{Failure, Source, Task};
use rigproof_certify::foreign::Foreign;
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

/// What came of a try.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// Time of a tick there and back, µs: within it are half of them, nine tenths and 999 of 1000.
    pub within_us: [f64; 3],
    /// Ticks with a current that is not zero.
    pub braking: u64,
    /// Ticks with a current that is no number.
    pub undefined: u64,
    /// Greatest current of A, E, B and C, A; of those that are numbers.
    pub greatest_a: [f64; 4],
}

/// Counts of A and B from which the tip is led, and how far A and B turn, to and fro, in so many samples.
const FROM: [i32; 2] = [33_421, 14_327];
const TURN: i32 = 400;

/// Runs a controller for so many ticks, at least one, on the thesis's rig of a layout, along a line.
///
/// # Errors
/// [`Failure`]: the first.
pub fn try_out(source: &Foreign, layout: Layout, ticks: u32) -> Result<Tried, Failure> {
    let line = Task::Chain(vec![[-0.113, 0.383], [0.107, 0.412]]);
    let mut controller = source.begin(&Settings::thesis(layout), &line)?;
    let mut times_us = Vec::new();
    let mut tried = Tried {
        within_us: [0.0; 3],
        braking: 0,
        undefined: 0,
        greatest_a: [0.0; 4],
    };
    for number in 0..ticks.max(1) {
        let phase = (number % (2 * TURN as u32)) as i32;
        let turned = TURN - (phase - TURN).abs();
        let sensed = Sensed {
            number,
            counts: FROM.map(|count| count + 2 * turned),
            tip_force_n: Vector::new(1.3, -2.7),
        };
        let begun = Instant::now();
        let currents_a = controller.tick(&sensed)?;
        times_us.push(begun.elapsed().as_secs_f64() * 1e6);
        tried.braking += u64::from(currents_a.iter().any(|a| *a != 0.0 && !a.is_nan()));
        tried.undefined += u64::from(currents_a.iter().any(|a| a.is_nan()));
        for (greatest_a, current_a) in tried.greatest_a.iter_mut().zip(currents_a) {
            *greatest_a = greatest_a.max(current_a);
        }
    }
    controller.end()?;
    times_us.sort_by(f64::total_cmp);
    tried.within_us = [0.5, 0.9, 0.999].map(|part| {
        let place = (part * times_us.len() as f64) as usize;
        times_us.get(place).copied().unwrap_or_default()
    });
    Ok(tried)
}
