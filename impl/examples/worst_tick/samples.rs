//! This file makes what the ticks are told: hands that rest, crawl, wander and race, and sensors that jump, miss, repeat and say nothing true.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::encoder::COUNTS_PER_TURN;
use rigproof_impl::tick::Sensed;
use rigproof_impl::vector::Vector;

/// Kinds of episode.
const KINDS: u64 = 8;
/// Most counts of a base joint in a tick that are believed (30 rad/s).
const RACE: i32 = 477;

/// The samples of one episode.
pub struct Samples {
    random: Pcg64Mcg,
    kind: u64,
    number: u32,
    counts: [i32; 2],
    speeds: [i32; 2],
    tick: u32,
}

impl Samples {
    /// Those of an episode, by its number.
    pub fn new(episode: u64) -> Samples {
        let mut random = Pcg64Mcg::seed_from_u64(episode.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let per_degree = COUNTS_PER_TURN as i32 / 360;
        let between = |random: &mut Pcg64Mcg, least: i32, greatest: i32| {
            least + (random.next_u64() % (greatest - least) as u64) as i32
        };
        // Where the arms of both layouts can be, or, now and then, anywhere.
        let kind = random.next_u64() % KINDS;
        let [a, b] = if kind == 5 {
            [between(&mut random, 0, 360), between(&mut random, 0, 360)]
        } else {
            [between(&mut random, 95, 150), between(&mut random, 20, 75)]
        };
        let race = if kind == 6 { RACE } else { 23 };
        let speeds = [0, 1].map(|_| between(&mut random, -race, race + 1));
        Samples {
            number: random.next_u64() as u32,
            counts: [a * per_degree, b * per_degree],
            speeds,
            tick: 0,
            kind,
            random,
        }
    }

    /// The next sample.
    pub fn next(&mut self) -> Sensed<f64> {
        self.tick += 1;
        let draw = self.random.next_u64();
        self.number = self.number.wrapping_add(1);
        let rare = draw.is_multiple_of(13);
        match self.kind {
            // At rest.
            0 => {}
            // A count every few ticks.
            1 => self.turn([
                i32::from(self.tick.is_multiple_of(5)),
                -i32::from(self.tick.is_multiple_of(7)),
            ]),
            // A sample repeated or missed.
            2 if rare => {
                self.number = self
                    .number
                    .wrapping_add(draw as u32 >> 8 & 3)
                    .wrapping_sub(1)
            }
            // A counter that jumps.
            3 if rare => self.counts = [draw as i32, (draw >> 32) as i32],
            // Speeds that change.
            4 => self.turn([(draw >> 8) as i32 % 300, (draw >> 40) as i32 % 300]),
            _ => self.turn(self.speeds),
        }
        let bits = [self.random.next_u64(), self.random.next_u64()];
        let force = if self.kind == 7 && rare {
            bits.map(f64::from_bits)
        } else {
            // Up to 31 N, and nothing at all now and then.
            let most_n = if draw >> 60 == 0 { 0.0 } else { 31.0 };
            bits.map(|bits| most_n * ((bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0))
        };
        Sensed {
            number: self.number,
            counts: self.counts,
            tip_force_n: Vector::from(force),
        }
    }

    fn turn(&mut self, by: [i32; 2]) {
        let [a, b] = self.counts;
        let [by_a, by_b] = by;
        self.counts = [a.wrapping_add(by_a), b.wrapping_add(by_b)];
    }
}
