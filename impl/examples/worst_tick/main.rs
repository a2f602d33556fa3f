//! This program runs ticks of every law on every path, random and adversarial, and counts the instructions of each from a trace.
//!
//! `screen` times many episodes and prints, for every law and path, those with the slowest ticks; `run` runs some between two markers, under
//! an instrument that prints the address of every instruction; `count` reads that trace. `docs/compare/worst_tick.py` joins the three.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a program that is counted stops at the first surprise"
)]

mod controllers;
mod samples;
mod screen;
mod trace;

use std::hint::black_box;

use rigproof_impl::command::Command;
use rigproof_impl::tick::Sensed;

use controllers::{AnyTick, controllers};
use samples::Samples;

/// Ticks of one controller in a row, between which it starts anew.
pub const EPISODE: u64 = 50;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [_, "screen", episodes, keep] => {
            screen::screen(episodes.parse().unwrap(), keep.parse().unwrap());
        }
        [_, "run", episodes] => run(&numbers(episodes)),
        [_, "count", episodes, entry, leave] => {
            trace::count(&numbers(episodes), [entry, leave].map(|text| address(text)));
        }
        _ => {
            eprintln!("arguments: screen EPISODES KEEP, run LIST, or count LIST ENTRY LEAVE");
            std::process::exit(2);
        }
    }
}

fn numbers(list: &str) -> Vec<u64> {
    list.split(',').map(|text| text.parse().unwrap()).collect()
}

fn address(hexadecimal: &str) -> u64 {
    u64::from_str_radix(hexadecimal, 16).unwrap()
}

/// Runs episodes; which controller and which samples an episode has depends on its number alone.
fn run(episodes: &[u64]) {
    let controllers = controllers();
    for episode in episodes {
        let (_, mut controller) = controllers[*episode as usize % controllers.len()];
        let mut samples = Samples::new(*episode);
        for _ in 0..EPISODE {
            let sensed = samples.next();
            black_box(entry(&mut controller, black_box(&sensed)));
            leave();
        }
    }
}

/// What is counted.
#[inline(never)]
fn entry(controller: &mut AnyTick, sensed: &Sensed<f64>) -> Command<f64> {
    controller.tick(sensed)
}

/// Where counting ends.
#[inline(never)]
fn leave() {
    black_box(());
}
