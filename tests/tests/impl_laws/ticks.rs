//! This file says that a whole tick of the rig, from counts and force, answers as the reference that is told what the counts say.
//!
//! `RIGPROOF_CAMPAIGN` is the number of ticks; without it a slice runs.

use rayon::prelude::*;
use rigproof_certify::differential::both::{rig_law, sense};
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::tick::Tick;
use rigproof_impl::guard::RECOVERY_SAMPLES;
use rigproof_impl::tick::{Sensed, Settings, Tick as RigTick};
use rigproof_impl::vector::Vector;
use rigproof_model::encoder::Encoder;
use rigproof_model::velocity::AdaptiveWindow;
use rigproof_spec::command::Command;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::budget::assert_within_budget;
use crate::impl_laws::sample::Sampler;
use crate::impl_laws::tally::Answers;

/// Ticks of the slice that every test run takes.
const SLICE: u64 = 40_000;
/// Ticks of one seed.
const CHUNK: u64 = 500;

/// What became of many ticks.
#[derive(Default)]
struct Tally {
    answers: Answers,
    standing: u64,
    acted: u64,
}

/// A tick as it comes from counts: the samples that lead to it, and what the reference makes of them.
fn from_counts(sampler: &mut Sampler) -> (Tick, Vec<Sensed<f64>>, Settings, [f64; 2]) {
    let mut tick = sampler.plain();
    let mut settings = Settings {
        arms: tick.arms,
        ..Settings::thesis(tick.layout)
    };
    settings.zero_counts = [20_011, -31_013];
    let encoders = settings.counts_per_turn.map(Encoder::new);
    let mut travels = [0, 1].map(|joint| encoders[joint].count(tick.base_rad[joint]));
    let mut estimators =
        [0, 1].map(|joint| AdaptiveWindow::new(encoders[joint], SAMPLE_STEP_S, travels[joint]));
    let paces = [0, 1].map(|_| 3.0 * sampler.nudge());
    let mut rates_rad_s = [0.0; 2];
    let samples = (0..u32::from(RECOVERY_SAMPLES) + 1)
        .map(|number| {
            for joint in 0..2 {
                travels[joint] += (paces[joint] * (1.0 + 0.3 * sampler.nudge())).round() as i64;
                rates_rad_s[joint] = estimators[joint].update(travels[joint]);
            }
            let [force_x, force_y] = tick.force_n;
            Sensed {
                number,
                counts: [0, 1].map(|joint| travels[joint] as i32 + settings.zero_counts[joint]),
                tip_force_n: Vector::new(force_x, force_y),
            }
        })
        .collect();
    let base_rad = [0, 1].map(|joint| travels[joint] as f64 * encoders[joint].resolution_rad());
    let force_n = tick.force_n;
    sense(&mut tick, base_rad, rates_rad_s, force_n);
    (tick, samples, settings, rates_rad_s)
}

fn tally(seed: u64) -> Tally {
    let (mut sampler, mut nudger) = (Sampler::new(seed), Nudger::new(!seed));
    let mut tally = Tally::default();
    for number in 0..CHUNK {
        let place = format!("seed {seed}, tick {number}");
        let (tick, samples, settings, rates_rad_s) = from_counts(&mut sampler);
        let Some(mut rig) = rig_law::<f64>(&tick).and_then(|law| RigTick::new(&settings, law))
        else {
            tally.answers.wrong.push(format!("{place}: refused"));
            continue;
        };
        let mut rig_command = Command::none(rigproof_spec::command::Reason::Starting);
        for sensed in &samples {
            rig_command = rig.tick(sensed).into();
        }
        tally.standing += u64::from(rates_rad_s.contains(&0.0));
        tally.acted += u64::from(rig_command.currents_a != [0.0; 4]);
        tally.answers.add(&tick, rig_command, &mut nudger, &place);
    }
    tally
}

fn join(mut one: Tally, other: Tally) -> Tally {
    one.answers.join(other.answers);
    one.standing += other.standing;
    one.acted += other.acted;
    one
}

#[test]
fn a_whole_tick_from_counts_is_answered_as_by_the_reference() {
    let ticks = std::env::var("RIGPROOF_CAMPAIGN").map_or(SLICE, |text| text.parse().unwrap());
    let seeds = 57_000_000..57_000_000 + ticks.div_ceil(CHUNK);
    let all = seeds
        .into_par_iter()
        .map(tally)
        .reduce(Tally::default, join);
    println!(
        "{ticks} ticks from counts: {} acted, {} with a standing link, {}",
        all.acted,
        all.standing,
        all.answers.counts()
    );
    all.answers.assert_none_wrong();
    // One count in the window or none: links that stand are among them.
    assert!(5 * all.acted > ticks && 200 * all.standing > ticks);
    assert_within_budget("rig_tick_current_from_counts", all.answers.rounding_a);
}
