//! This file draws the numbers of a form from what is typical of a joint, so that every plant hides it in a size of its own.

use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::Form;
use std::f64::consts::TAU;

/// What is typical of a joint. Travel is m or rad, effort N or N·m.
#[derive(Clone, Copy, Debug)]
pub struct Typical {
    pub travel: f64,
    pub speed: f64,
    pub effort: f64,
    pub duration_s: f64,
    /// Coulomb and viscous friction that are there; 0 where the description knows of none.
    pub dry: f64,
    pub viscous: f64,
}

impl Typical {
    /// A force at the joint.
    pub fn force(&self, form: Form, draw: &mut Draw) -> Effect {
        let (speed, effort) = (self.speed, self.effort);
        let level = effort * draw.log_uniform(0.06, 0.4);
        let slow = speed * draw.log_uniform(0.05, 0.3);
        match form {
            // A stated number that is wrong may be too large as well.
            Form::Coulomb if draw.chance(0.3) && self.dry > 0.0 => {
                form.of([-self.dry * draw.uniform(0.3, 0.8)])
            }
            Form::Viscous if draw.chance(0.3) && self.viscous > 0.0 => {
                form.of([-self.viscous * draw.uniform(0.3, 0.8)])
            }
            Form::Viscous => form.of([level / speed]),
            Form::Stribeck => form.of([level, slow, 1.0]),
            Form::Rational => form.of([level, slow]),
            Form::Root | Form::Square => form.of([level, speed]),
            Form::Tanh => form.of([level, 0.5 * speed]),
            Form::Power => form.of([level, speed, draw.pick(&[1.3, 1.6])]),
            Form::Asymmetric => self.asymmetric(draw),
            Form::LoadShare => form.of([draw.uniform(0.08, 0.35)]),
            Form::LoadSided => {
                let (strong, weak) = (draw.uniform(0.12, 0.4), draw.uniform(0.0, 0.08));
                let driving = draw.chance(0.5);
                form.of(if driving {
                    [strong, weak]
                } else {
                    [weak, strong]
                })
            }
            Form::LoadSquare => form.of([0.6 * level, effort]),
            Form::Bias => form.of([draw.sign() * level]),
            _ => self.with_memory(form, level, slow, draw),
        }
    }

    /// Of the dry friction, of the damping, or of both.
    fn asymmetric(&self, draw: &mut Draw) -> Effect {
        let share = draw.sign() * draw.uniform(0.2, 0.7);
        let (dry, viscous) = (self.dry * share, self.viscous * share);
        let values = match draw.below(3) {
            0 if dry != 0.0 => [dry, 0.0],
            1 if viscous != 0.0 => [0.0, viscous],
            _ => [dry, viscous],
        };
        Form::Asymmetric.of(values)
    }

    fn with_memory(&self, form: Form, level: f64, slow: f64, draw: &mut Draw) -> Effect {
        let travel = self.travel;
        let yields = travel * draw.log_uniform(0.02, 0.2);
        match form {
            Form::Travelled => form.of([level, slow, 0.2 * yields]),
            Form::DahlPower => form.of([level, yields, draw.pick(&[0.5, 1.5, 2.0])]),
            Form::Bristle => form.of([level, yields, 1e-3]),
            Form::ElastoPlastic => form.of([level, yields, draw.uniform(0.3, 0.8)]),
            Form::MaxwellSlip => form.of([level, 3.0 * yields]),
            Form::BoucWen => {
                let ratio = draw.sign() * draw.uniform(0.2, 0.6);
                form.of([level / yields, 1.0 / yields, ratio / yields])
            }
            Form::Gap => form.of([self.dry * draw.uniform(0.6, 0.95), yields]),
            Form::Overshoot | Form::OvershootLinear => {
                form.of([level, travel * draw.uniform(0.08, 0.3)])
            }
            Form::Settling => {
                let worn = travel * draw.uniform(0.1, 0.3);
                form.of([1.5 * level, draw.uniform(0.15, 0.5), worn])
            }
            Form::FadeByWay => {
                let lost = self.dry * draw.uniform(0.25, 0.7);
                form.of([lost, travel * draw.uniform(5.0, 20.0)])
            }
            _ => self.over_time_or_place(form, level, draw),
        }
    }

    fn over_time_or_place(&self, form: Form, level: f64, draw: &mut Draw) -> Effect {
        let (travel, duration_s) = (self.travel, self.duration_s);
        let period = travel / draw.uniform(1.5, 6.0);
        let stiff = level / (travel * travel * travel);
        match form {
            Form::Drift => form.of([draw.sign() * level / duration_s]),
            Form::Creep => {
                let creeps_s = duration_s * draw.uniform(0.15, 0.4);
                form.of([draw.sign() * level, creeps_s])
            }
            Form::FadeLinear => form.of([self.dry * draw.uniform(0.25, 0.7), duration_s]),
            Form::FadeExponential => {
                let lost = self.dry * draw.uniform(0.25, 0.7);
                form.of([lost, duration_s * draw.uniform(0.15, 0.5)])
            }
            Form::Disturbance => form.of([level, draw.log_uniform(0.25, 3.0)]),
            Form::Ripple => {
                let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
                form.of([level * s, level * c, period])
            }
            Form::TwoOrders => form.of([level, period, draw.uniform(0.3, 0.8)]),
            Form::Toothed => form.of([level, period, draw.uniform(1.0, 4.0)]),
            Form::TwoRipples => form.of([level, period, period / draw.uniform(1.8, 2.9)]),
            Form::Uneven => form.of([level, draw.uniform(0.6, 1.0), 2.0 * period]),
            Form::Anchored => {
                let anchor = draw.sign() * travel * draw.uniform(0.3, 1.2);
                form.of([level / travel, anchor])
            }
            Form::Tether => {
                let beyond = draw.sign() * travel * draw.uniform(0.05, 0.25);
                form.of([4.0 * level / travel, beyond])
            }
            Form::Hardening => form.of([0.6 * level / travel, 2.0 * stiff]),
            Form::Cubic => form.of([2.0 * stiff]),
            _ => form.of([level]),
        }
    }
}

/// A form as a share of the torque of a brake.
pub fn share(form: Form, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.35);
    let slow = draw.log_uniform(0.05, 0.4);
    let period = TAU / draw.uniform(8.0, 50.0);
    let effect = match form {
        Form::Stribeck => form.of([share, slow, 1.0]),
        Form::Rational => form.of([share, slow]),
        Form::MaxwellSlip => form.of([share, draw.log_uniform(0.03, 0.2)]),
        Form::TwoOrders => form.of([share, period, draw.uniform(0.3, 0.8)]),
        Form::Toothed => form.of([share, period, draw.uniform(1.0, 4.0)]),
        _ => form.of([draw.sign() * share]),
    };
    effect.of_drive()
}

/// A form in a brake whose torques reach a greatest one, N·m.
pub fn in_brake(form: Form, greatest_nm: f64, duration_s: f64, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.3);
    match form {
        Form::Lag => form.of([draw.log_uniform(0.012, 0.08)]),
        Form::LagSecond => form.of([draw.log_uniform(0.008, 0.04), draw.uniform(0.5, 1.0)]),
        Form::Gain => form.of([draw.sign() * share]),
        Form::Saturation | Form::SoftSaturation => form.of([greatest_nm * draw.uniform(0.3, 0.85)]),
        Form::Preisach => form.of([draw.uniform(0.12, 0.4)]),
        Form::Plays => form.of([draw.uniform(0.4, 1.0), draw.uniform(0.08, 0.3)]),
        Form::BoucWenCurrent => form.of([draw.uniform(0.4, 0.9), draw.uniform(0.05, 0.2)]),
        Form::Thermal => form.of([draw.log_uniform(0.02, 0.12)]),
        Form::YieldFade => form.of([draw.uniform(0.08, 0.3), duration_s]),
        Form::TimeConstants => form.of([draw.uniform(0.5, 3.0), draw.uniform(0.0, 3.0)]),
        Form::OffState => form.of([draw.uniform(0.04, 0.25)]),
        Form::Backlash => form.of([draw.uniform(0.045, 0.1)]),
        _ => form.of([share, draw.log_uniform(0.05, 0.25)]),
    }
}
