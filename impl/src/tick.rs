//! This file is one tick of the controller: from what is sensed to four brake currents and why.

use rigproof_spec::command::Reason;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_spec::settings::{LONGEST_ARM_M, SHORTEST_ARM_M};

use crate::command::Command;
use crate::encoder::{COUNTS_PER_TURN, Encoder};
use crate::guard::{Guard, Verdict, release};
use crate::law::{Law, Situation};
use crate::linkage::{Shape, linkage};
use crate::number::Real;
use crate::vector::Vector;
use crate::velocity::Velocity;

/// What a tick is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed<R> {
    /// Number of the sample: one more than that of the sample before, then 0 after the greatest.
    pub number: u32,
    /// Counts of the encoders on A and B.
    pub counts: [i32; 2],
    /// Force of the operator on the tip, N.
    pub tip_force_n: Vector<R>,
}

/// What is fixed about a rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Arm lengths.
    pub arms: Arms,
    /// Which joints carry a brake.
    pub layout: Layout,
    /// Counts a turn of the encoders on A and B.
    pub counts_per_turn: [u32; 2],
    /// Their counts where the angle is zero.
    pub zero_counts: [i32; 2],
    /// Time from one sample to the next, s.
    pub sample_s: f64,
    /// Greatest rate at which a base joint is believed to turn, rad/s.
    pub greatest_rate_rad_s: f64,
    /// Greatest component of a tip force that is believed, N.
    pub greatest_force_n: f64,
}

/// Rate of a base joint beyond which a count is not believed: a hand at 3 m/s, 0.1 m from a joint's axis (decision 0074), rad/s.
pub const GREATEST_RATE_RAD_S: f64 = 30.0;
/// Tip force beyond which a sensor is not believed: ten times what the thesis asks of a brake (decision 0074), N.
pub const GREATEST_FORCE_N: f64 = 200.0;

/// Time from one sample to the next that is taken, s.
pub const SAMPLE_RANGE_S: [f64; 2] = [1e-6, 1.0];
/// Greatest rates that are taken, rad/s.
pub const GREATEST_RATE_RANGE_RAD_S: [f64; 2] = [1e-3, 1e4];
/// Greatest forces that are taken, N.
pub const GREATEST_FORCE_RANGE_N: [f64; 2] = [1e-3, 1e6];

impl Settings {
    /// The thesis's rig (tables 4.1 and 4.2, §4.6, §6.5.1).
    pub const fn thesis(layout: Layout) -> Settings {
        Settings {
            arms: arms(layout),
            layout,
            counts_per_turn: [COUNTS_PER_TURN; 2],
            zero_counts: [0; 2],
            sample_s: SAMPLE_STEP_S,
            greatest_rate_rad_s: GREATEST_RATE_RAD_S,
            greatest_force_n: GREATEST_FORCE_N,
        }
    }

    /// Whether every number is one of a rig that can be.
    pub(crate) fn are_sound(&self) -> bool {
        let Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        } = self.arms;
        let inside = |value: f64, [least, greatest]: [f64; 2]| (least..=greatest).contains(&value);
        [l_ae_m, l_ed_m, l_bc_m, l_cd_m]
            .into_iter()
            .all(|length_m| inside(length_m, [SHORTEST_ARM_M, LONGEST_ARM_M]))
            && inside(l_ab_m, [0.0, LONGEST_ARM_M])
            && inside(self.sample_s, SAMPLE_RANGE_S)
            && inside(self.greatest_rate_rad_s, GREATEST_RATE_RANGE_RAD_S)
            && inside(self.greatest_force_n, GREATEST_FORCE_RANGE_N)
    }

    /// What watches the samples of this rig.
    pub(crate) fn guard<R: Real>(&self) -> Guard<R> {
        let step = |counts_per_turn: u32| {
            let turns = self.greatest_rate_rad_s * self.sample_s / core::f64::consts::TAU;
            // A travel of a turn is the most there is; a float beyond u32 becomes the greatest u32.
            libm::ceil(turns * f64::from(counts_per_turn)) as u32
        };
        Guard::new(self.counts_per_turn.map(step), R::of(self.greatest_force_n))
    }
}

/// A controller at work: guard, kinematics and a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick<R, L> {
    shape: Shape<R>,
    braked: [bool; 4],
    encoders: [Encoder<R>; 2],
    velocities: [Velocity<R>; 2],
    guard: Guard<R>,
    law: L,
    last: Command<R>,
}

impl<R: Real, L: Law<R>> Tick<R, L> {
    /// A controller that has seen nothing; `None` for settings that no rig has, and for a law of other arms or brakes.
    ///
    /// Taken are arms from [`SHORTEST_ARM_M`] to [`LONGEST_ARM_M`] (`L_AB` from 0), 1 to 2²⁴ counts a turn, and what lies inside
    /// [`SAMPLE_RANGE_S`], [`GREATEST_RATE_RANGE_RAD_S`] and [`GREATEST_FORCE_RANGE_N`].
    pub fn new(settings: &Settings, law: L) -> Option<Tick<R, L>> {
        if !settings.are_sound() {
            return None;
        }
        let [of_a, of_b] = settings.counts_per_turn;
        let [zero_a, zero_b] = settings.zero_counts;
        let encoders = [Encoder::new(of_a, zero_a)?, Encoder::new(of_b, zero_b)?];
        let shape = Shape::new(&settings.arms);
        let braked = Joint::ALL.map(|joint| settings.layout.brakes().contains(&joint));
        if law.actuation().is_some_and(|of| !of.is_of(&shape, braked)) {
            return None;
        }
        Some(Tick {
            shape,
            braked,
            velocities: encoders.map(|encoder| Velocity::new(&encoder, settings.sample_s)),
            encoders,
            guard: settings.guard(),
            law,
            last: Command::none(Reason::Starting),
        })
    }

    /// The currents of one tick, and why; the work is bounded whatever is told.
    pub fn tick(&mut self, sensed: &Sensed<R>) -> Command<R> {
        let travels = pair(self.encoders, sensed.counts, |encoder, count| {
            encoder.travel(count)
        });
        let [encoder_a, encoder_b] = &self.encoders;
        let [of_a, of_b] = travels;
        let reached = encoder_a.reaches(of_a) & encoder_b.reaches(of_b);
        let force_n = sensed.tip_force_n;
        match self
            .guard
            .judge(sensed.number, travels, reached, force_n.into())
        {
            Verdict::Repeated => {}
            Verdict::Good => {
                let rates_rad_s = self.rates(travels);
                let asked = self.ask(travels, rates_rad_s, force_n);
                self.last = release(asked, self.braked);
            }
            Verdict::Early => {
                self.rates(travels);
                self.last = Command::none(Reason::Starting);
            }
            Verdict::Fault(reason) => {
                for (velocity, travel) in self.velocities.iter_mut().zip(travels) {
                    velocity.restart(travel);
                }
                self.last = Command::none(reason);
            }
        }
        self.last
    }

    /// The rates of A and B, rad/s.
    // A function of its own, so that a compiler sees the two joints side by side and nothing else.
    #[inline(never)]
    fn rates(&mut self, [of_a, of_b]: [i32; 2]) -> Vector<R> {
        let [a, b] = &mut self.velocities;
        Vector::new(a.update(of_a), b.update(of_b))
    }

    /// What the law wants.
    fn ask(
        &mut self,
        travels: [i32; 2],
        rates_rad_s: Vector<R>,
        tip_force_n: Vector<R>,
    ) -> Command<R> {
        let [ae, bc] = pair(self.encoders, travels, |encoder, travel| {
            let (sine, cosine) = encoder.angle_rad(travel).sine_cosine();
            Vector::new(cosine, sine)
        });
        let linkage = linkage(&self.shape, ae, bc);
        if !linkage.is_sound(&self.shape) {
            return Command::none(Reason::SingularPose);
        }
        self.law.command(&Situation {
            linkage,
            rows: linkage.rows(),
            tip_velocity_m_s: linkage.tip_velocity(rates_rad_s),
            tip_force_n,
        })
    }
}

/// What comes of each base joint's encoder and something of that joint's.
fn pair<R: Real, T, U>(
    [encoder_a, encoder_b]: [Encoder<R>; 2],
    [of_a, of_b]: [T; 2],
    of: impl Fn(&Encoder<R>, T) -> U,
) -> [U; 2] {
    [of(&encoder_a, of_a), of(&encoder_b, of_b)]
}
