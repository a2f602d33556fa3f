//! This file says what single precision costs a tick: angles, tip, velocity, currents, and how often it decides otherwise.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use rigproof_impl::encoder::{COUNTS_PER_TURN, Encoder};
use rigproof_impl::law::{Law, Situation};
use rigproof_impl::linkage::{Linkage, Shape, linkage};
use rigproof_impl::number::Real;
use rigproof_impl::tick::Sensed;
use rigproof_impl::vector::Vector;
use rigproof_impl::velocity::Velocity;
use rigproof_spec::command::Reason;
use rigproof_spec::geometry::arms;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::budget::assert_within_budget;
use crate::impl_tick::closed_loop::{Trial, law, run, tick, trials};

/// Some units in the last place of a float, relative.
const SINGLE: f64 = 4e-7;

/// What is sensed, in single precision: the counts are the same.
fn single(sample: &Sensed<f64>) -> Sensed<f32> {
    let Vector { x, y } = sample.tip_force_n;
    Sensed {
        number: sample.number,
        counts: sample.counts,
        tip_force_n: Vector::new(x as f32, y as f32),
    }
}

/// Angles, tip and rates of one sample, widened.
struct Seen<R> {
    encoder: Encoder<R>,
    shape: Shape<R>,
    velocities: [Velocity<R>; 2],
    rates_rad_s: [R; 2],
}

impl<R: Real> Seen<R> {
    fn new(trial: &Trial) -> Seen<R> {
        let encoder = Encoder::new(COUNTS_PER_TURN, 0).unwrap();
        Seen {
            encoder,
            shape: Shape::new(&arms(trial.layout)),
            velocities: [Velocity::new(&encoder, SAMPLE_STEP_S); 2],
            rates_rad_s: [R::zero(); 2],
        }
    }

    fn of(&mut self, counts: [i32; 2]) -> [[f64; 2]; 3] {
        let angles_rad = counts.map(|count| self.encoder.angle_rad(count));
        let closed = self.closed(angles_rad);
        let [a, b] = &mut self.velocities;
        self.rates_rad_s = [a.update(counts[0]), b.update(counts[1])];
        let wide = |pair: [R; 2]| pair.map(Real::to_f64);
        let velocity: [R; 2] = closed.tip_velocity(self.rates_rad_s.into()).into();
        [wide(angles_rad), wide(closed.tip_m.into()), wide(velocity)]
    }

    fn closed(&self, angles_rad: [R; 2]) -> Linkage<R> {
        let [ae, bc] = angles_rad.map(|angle_rad| {
            let (sine, cosine) = angle_rad.sine_cosine();
            Vector::new(cosine, sine)
        });
        linkage(&self.shape, ae, bc)
    }
}

/// Whether double precision decides so too when angles, rates and push are nudged by what single precision rounds.
fn turns(
    seen: &Seen<f64>,
    law: &mut dyn Law<f64>,
    sample: &Sensed<f64>,
    reason: Reason,
    draw: &mut Pcg64Mcg,
) -> bool {
    let mut nudged = |value: f64| value * (1.0 + SINGLE * (2.0 * draw.random::<f64>() - 1.0));
    (0..300).any(|_| {
        let angles_rad = sample
            .counts
            .map(|count| nudged(seen.encoder.angle_rad(count)));
        let linkage = seen.closed(angles_rad);
        let Vector { x, y } = sample.tip_force_n;
        let now = Situation {
            linkage,
            rows: linkage.rows(),
            tip_velocity_m_s: linkage.tip_velocity(seen.rates_rad_s.map(&mut nudged).into()),
            tip_force_n: Vector::new(nudged(x), nudged(y)),
        };
        law.command(&now).reason == reason
    })
}

#[derive(Default)]
struct Apart {
    angle_rad: Vec<f64>,
    tip_m: Vec<f64>,
    velocity_m_s: Vec<f64>,
    current_a: Vec<f64>,
    decisions: Vec<f64>,
    ties: Vec<f64>,
}

fn watched(trial: &Trial) -> Apart {
    let mut narrow = tick::<f32>(trial);
    let (mut wide_seen, mut narrow_seen) = (Seen::<f64>::new(trial), Seen::<f32>::new(trial));
    let mut apart = Apart::default();
    let (mut asked, mut otherwise, mut ties) = (0.0, 0.0, 0.0);
    let mut draw = Pcg64Mcg::seed_from_u64(trial.seed);
    run(trial, &mut |sample, command| {
        let [angles, tips, velocities] = {
            let (one, other) = (wide_seen.of(sample.counts), narrow_seen.of(sample.counts));
            [0, 1, 2].map(|i| [0, 1].map(|j| (one[i][j] - other[i][j]).abs()))
        };
        let narrow = narrow(&single(sample));
        if command.reason == Reason::Starting {
            return;
        }
        apart.angle_rad.extend(angles);
        apart.tip_m.extend(tips);
        apart.velocity_m_s.extend(velocities);
        asked += 1.0;
        if narrow.reason == command.reason {
            let pairs = narrow.currents_a.into_iter().zip(command.currents_a);
            apart.current_a.extend(pairs.map(|(a, b)| (a - b).abs()));
        } else if turns(
            &wide_seen,
            &mut *law::<f64>(trial),
            sample,
            narrow.reason,
            &mut draw,
        ) {
            ties += 1.0;
        } else {
            println!("{sample:?} {command:?} {narrow:?}");
            otherwise += 1.0;
        }
    });
    apart.decisions.push(otherwise / asked);
    apart.ties.push(ties / asked);
    apart
}

#[test]
fn single_precision_keeps_every_count_and_nearly_every_decision() {
    let all: Vec<Apart> = trials(13).par_iter().map(watched).collect();
    let of = |which: fn(&Apart) -> &Vec<f64>| -> Vec<f64> {
        let mut values: Vec<f64> = all.iter().flat_map(|apart| which(apart).clone()).collect();
        values.sort_by(f64::total_cmp);
        let at = |rank: f64| values[((values.len() - 1) as f64 * rank) as usize];
        println!(
            "{} values: q75 {:.2e} q99 {:.2e} max {:.2e}",
            values.len(),
            at(0.75),
            at(0.99),
            at(1.0)
        );
        values
    };
    assert_within_budget("tick_f32_angle", of(|apart| &apart.angle_rad));
    assert_within_budget("tick_f32_tip", of(|apart| &apart.tip_m));
    assert_within_budget("tick_f32_velocity", of(|apart| &apart.velocity_m_s));
    assert_within_budget("tick_f32_current", of(|apart| &apart.current_a));
    assert_within_budget("tick_f32_decisions", of(|apart| &apart.decisions));
    assert_within_budget("tick_f32_ties", of(|apart| &apart.ties));
}
