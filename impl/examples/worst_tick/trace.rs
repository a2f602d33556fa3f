//! This file reads a trace of instructions, a line `I  address,size` each, and counts those between two markers.

use std::io::{BufRead, stdin};

use crate::EPISODE;
use crate::controllers::controllers;

/// The ticks of one law on one path.
#[derive(Clone, Copy, Default)]
struct Cost {
    ticks: u64,
    instructions: u64,
    greatest: u64,
    /// Episode and tick of the greatest.
    place: [u64; 2],
}

/// Counts the instructions from one address to another, tick by tick, and prints what each controller needs; ends with an error if the
/// markers were not met once a tick.
pub fn count(episodes: &[u64], [entry, leave]: [u64; 2]) {
    let names: Vec<String> = controllers().into_iter().map(|(name, _)| name).collect();
    let mut costs = vec![Cost::default(); names.len()];
    let mut lines = stdin().lock();
    let (mut line, mut now, mut tick) = (Vec::new(), None, 0);
    while lines.read_until(b'\n', &mut line).unwrap() > 0 {
        if let Some(at) = instruction(&line) {
            if at == entry {
                now = Some(0);
            }
            if at == leave
                && let Some(instructions) = now.take()
            {
                let episode = episodes[(tick / EPISODE) as usize];
                let cost = &mut costs[episode as usize % names.len()];
                cost.ticks += 1;
                cost.instructions += instructions;
                if instructions > cost.greatest {
                    cost.greatest = instructions;
                    cost.place = [episode, tick % EPISODE];
                }
                tick += 1;
            }
            now = now.map(|instructions| instructions + 1);
        }
        line.clear();
    }
    let ran = episodes.len() as u64 * EPISODE;
    assert!(tick == ran, "{tick} of {ran} ticks were seen");
    println!("law | path | ticks | mean | greatest | episode | tick");
    let half = names.len() / 2;
    for (name, pair) in names.iter().zip(costs.iter().zip(&costs[half..])) {
        let (three, four) = pair;
        let greatest = if three.greatest > four.greatest {
            three
        } else {
            four
        };
        let ticks = three.ticks + four.ticks;
        let mean = (three.instructions + four.instructions)
            .checked_div(ticks)
            .unwrap_or(0);
        let [episode, place] = greatest.place;
        println!(
            "{name} | {ticks} | {mean} | {} | {episode} | {place}",
            greatest.greatest
        );
    }
}

/// The address of a line that is an instruction.
fn instruction(line: &[u8]) -> Option<u64> {
    let [b'I', b' ', b' ', rest @ ..] = line else {
        return None;
    };
    let digits = rest.iter().take_while(|byte| **byte != b',');
    digits
        .map(|byte| char::from(*byte).to_digit(16).map(u64::from))
        .try_fold(0, |sum, digit| Some(16 * sum + digit?))
}
