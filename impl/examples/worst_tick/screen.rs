//! This file finds the episodes that are worth counting: those with the slowest ticks by the clock.

use std::hint::black_box;
use std::time::Instant;

use crate::controllers::controllers;
use crate::samples::Samples;
use crate::{EPISODE, entry};

/// How often a tick is timed; the least counts.
const TIMES: usize = 5;

/// Times the ticks of the first episodes and prints the numbers of the `keep` slowest of every controller.
pub fn screen(episodes: u64, keep: usize) {
    let controllers = controllers();
    let mut slowest = vec![Vec::new(); controllers.len()];
    for episode in 0..episodes {
        let at = episode as usize % controllers.len();
        let (_, mut controller) = controllers[at];
        let mut samples = Samples::new(episode);
        let mut most_ns = 0;
        for _ in 0..EPISODE {
            let sensed = samples.next();
            let before = controller;
            let mut least_ns = u128::MAX;
            for _ in 0..TIMES {
                controller = before;
                let start = Instant::now();
                black_box(entry(&mut controller, black_box(&sensed)));
                least_ns = least_ns.min(start.elapsed().as_nanos());
            }
            most_ns = most_ns.max(least_ns);
        }
        slowest[at].push((most_ns, episode));
    }
    let mut chosen = Vec::new();
    for mut each in slowest {
        each.sort_unstable_by(|one, other| other.cmp(one));
        chosen.extend(
            each.iter()
                .take(keep)
                .map(|(_, episode)| episode.to_string()),
        );
    }
    println!("{}", chosen.join(","));
}
