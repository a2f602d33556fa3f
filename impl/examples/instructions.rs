//! This program runs the closed loop, its controller or its plant for so many ticks, to be counted by an instrument.
//!
//! What a tick costs is the difference of two runs, one of them longer: start and inputs cost the same in both. `bits` prints one number of
//! all that the closed loop commanded and reached, so that builds for different processors can be compared. `timed` times the monitor.
#![allow(
    clippy::unwrap_used,
    reason = "a program that is counted stops at the first surprise"
)]

#[path = "../benches/rig/mod.rs"]
mod rig;

#[path = "../c/tests/monitor/rigproof_monitor.rs"]
#[allow(dead_code, reason = "one of its two layouts is counted")]
mod numbers;

use std::hint::black_box;

use rigproof_impl::command::Command;
use rigproof_impl::monitor::Monitor;
use rigproof_impl::monitor::constants::{Constants, WATCHED};
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Parameters, Scheme};
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;

use rig::{ClosedLoop, hand, record};

/// Held on the tip while the linkage without brakes is stepped, N: it turns round before the tip is anywhere.
const PUSH_N: [f64; 2] = [0.013, 0.011];

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, what, ticks] = arguments.as_slice() else {
        eprintln!("arguments: loop|controller|plant|linkage|monitor|timed|bits ticks");
        std::process::exit(2);
    };
    let ticks: usize = ticks.parse().unwrap();
    let (mut start, places, record) = (ClosedLoop::new(), hand(), record());
    let Parameters { arms, inertia, .. } = Parameters::of(Layout::FourBrake);
    let mechanism = Mechanism::new(&arms, &inertia, Scheme::Midpoint);
    let theta_rad = start.plant.base_angles_rad().into();
    let mut bits = 0_u64;
    // Certified numbers that watch everything and raise nothing, so that every sample costs what it costs.
    let of = Constants {
        levels: [f64::MAX; WATCHED],
        surprise: f64::MAX,
        hold: u32::MAX,
        ..numbers::FOUR_BRAKE
    };
    let mut monitor = Monitor::new(&Settings::thesis(Layout::FourBrake), &of).unwrap();
    if what == "timed" {
        let mut times_ns: Vec<f64> = (0..300)
            .map(|_| timed_ns(monitor, &record[..ticks]))
            .collect();
        times_ns.sort_by(f64::total_cmp);
        println!(
            "{:.0} ns a sample in the median of 300 passes, least {:.0}",
            times_ns[150], times_ns[0]
        );
        return;
    }
    let mut motion = Motion::new(&mechanism, theta_rad, [0.0; 2].into()).unwrap();
    for tick in 0..ticks {
        let (sensed, command) = black_box(&record[tick]);
        match what.as_str() {
            "loop" => {
                black_box(start.step(black_box(places[tick])));
            }
            "bits" => {
                let (_, command) = start.step(places[tick]);
                let reached = start.plant.base_angles_rad();
                for value in command.currents_a.into_iter().chain(reached) {
                    bits =
                        (bits.rotate_left(9) ^ value.to_bits()).wrapping_mul(0x9E37_79B9_7F4A_7C15);
                }
            }
            "controller" => {
                black_box(start.controller.tick(sensed));
            }
            "monitor" => {
                black_box(monitor.watch(sensed, command.currents_a));
            }
            "plant" => {
                let force_n = sensed.tip_force_n.into();
                black_box(start.plant.step(force_n, command.currents_a, SAMPLE_STEP_S));
            }
            "linkage" => {
                black_box(motion.step_free(&mechanism, PUSH_N.into(), SAMPLE_STEP_S));
            }
            _ => return,
        }
    }
    if what == "bits" {
        println!("{bits:016x}");
    }
    black_box((start, motion, monitor));
}

/// Time of a sample in one pass over a record, ns.
fn timed_ns(mut monitor: Monitor, record: &[(Sensed<f64>, Command<f64>)]) -> f64 {
    let begun = std::time::Instant::now();
    for (sensed, command) in record {
        black_box(monitor.watch(black_box(sensed), command.currents_a));
    }
    begun.elapsed().as_nanos() as f64 / record.len() as f64
}
