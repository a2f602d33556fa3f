//! This file says what a controller can know from what it was told: pose, tip velocity and push, by the rig's own kinematics.

use rigproof_impl::encoder::Encoder;
use rigproof_impl::guard::RECOVERY_SAMPLES;
use rigproof_impl::law::Situation;
use rigproof_impl::linkage::{Shape, linkage};
use rigproof_impl::number::Real as _;
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_impl::velocity::Velocity;

use super::reference::Told;

/// What was sensed so far.
pub struct Seen {
    shape: Shape<f64>,
    encoders: [Encoder<f64>; 2],
    velocities: [Velocity<f64>; 2],
    /// Good samples since the start or the last fault.
    good: u8,
}

impl Seen {
    /// Nothing yet, on a rig; `None` for encoders that cannot be.
    pub fn new(settings: &Settings) -> Option<Seen> {
        let [of_a, of_b] = settings.counts_per_turn;
        let [zero_a, zero_b] = settings.zero_counts;
        let encoders = [Encoder::new(of_a, zero_a)?, Encoder::new(of_b, zero_b)?];
        Some(Seen {
            shape: Shape::new(&settings.arms),
            velocities: [
                Velocity::new(&encoders[0], settings.sample_s),
                Velocity::new(&encoders[1], settings.sample_s),
            ],
            encoders,
            good: 0,
        })
    }

    /// After a fault nothing is known of the past.
    pub fn forget(&mut self) {
        self.good = 0;
    }

    /// What is known now; `None` until a whole window of good samples has come, and in a pose without a Jacobian.
    pub fn update(&mut self, sensed: &Sensed<f64>) -> Option<(Situation<f64>, Told)> {
        let [encoder_a, encoder_b] = &self.encoders;
        let [count_a, count_b] = sensed.counts;
        let (of_a, of_b) = (encoder_a.travel(count_a), encoder_b.travel(count_b));
        let [velocity_a, velocity_b] = &mut self.velocities;
        if self.good == 0 {
            velocity_a.restart(of_a);
            velocity_b.restart(of_b);
        }
        self.good = self.good.saturating_add(1);
        let rates_rad_s = Vector::new(velocity_a.update(of_a), velocity_b.update(of_b));
        if self.good < RECOVERY_SAMPLES {
            return None;
        }
        let direction = |angle_rad: f64| {
            let (sine, cosine) = angle_rad.sine_cosine();
            Vector::new(cosine, sine)
        };
        let theta_rad = [encoder_a.angle_rad(of_a), encoder_b.angle_rad(of_b)];
        let arms = theta_rad.map(direction);
        let linkage = linkage(&self.shape, arms[0], arms[1]);
        linkage.is_sound(&self.shape).then(|| {
            let situation = Situation {
                linkage,
                rows: linkage.rows(),
                tip_velocity_m_s: linkage.tip_velocity(rates_rad_s),
                tip_force_n: sensed.tip_force_n,
            };
            let told = Told {
                theta_rad,
                rates_rad_s: rates_rad_s.into(),
                force_n: sensed.tip_force_n.into(),
            };
            (situation, told)
        })
    }
}
