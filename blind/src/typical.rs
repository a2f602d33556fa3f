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
                Effect::new(form, [-self.dry * draw.uniform(0.3, 0.8)])
            }
            Form::Viscous if draw.chance(0.3) && self.viscous > 0.0 => {
                Effect::new(form, [-self.viscous * draw.uniform(0.3, 0.8)])
            }
            Form::Viscous => Effect::new(form, [level / speed]),
            Form::Stribeck => Effect::new(form, [level, slow, 1.0]),
            Form::Rational => Effect::new(form, [level, slow]),
            Form::Root | Form::Square => Effect::new(form, [level, speed]),
            Form::Tanh => Effect::new(form, [level, 0.5 * speed]),
            Form::Power => Effect::new(form, [level, speed, draw.pick(&[1.3, 1.6])]),
            Form::Asymmetric => self.asymmetric(draw),
            Form::LoadShare => Effect::new(form, [draw.uniform(0.08, 0.35)]),
            Form::LoadSided => {
                let (strong, weak) = (draw.uniform(0.12, 0.4), draw.uniform(0.0, 0.08));
                let driving = draw.chance(0.5);
                Effect::new(
                    form,
                    if driving {
                        [strong, weak]
                    } else {
                        [weak, strong]
                    },
                )
            }
            Form::LoadSquare => Effect::new(form, [0.6 * level, effort]),
            Form::Bias => Effect::new(form, [draw.sign() * level]),
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
        Effect::new(Form::Asymmetric, values)
    }

    fn with_memory(&self, form: Form, level: f64, slow: f64, draw: &mut Draw) -> Effect {
        let travel = self.travel;
        let yields = travel * draw.log_uniform(0.02, 0.2);
        match form {
            Form::Travelled => Effect::new(form, [level, slow, 0.2 * yields]),
            Form::DahlPower => Effect::new(form, [level, yields, draw.pick(&[0.5, 1.5, 2.0])]),
            Form::Bristle => Effect::new(form, [level, yields, 1e-3]),
            Form::ElastoPlastic => Effect::new(form, [level, yields, draw.uniform(0.3, 0.8)]),
            Form::MaxwellSlip => Effect::new(form, [level, 3.0 * yields]),
            Form::BoucWen => {
                let ratio = draw.sign() * draw.uniform(0.2, 0.6);
                Effect::new(form, [level / yields, 1.0 / yields, ratio / yields])
            }
            Form::Gap => Effect::new(form, [self.dry * draw.uniform(0.6, 0.95), yields]),
            Form::Overshoot | Form::OvershootLinear => {
                Effect::new(form, [level, travel * draw.uniform(0.08, 0.3)])
            }
            Form::Settling => {
                let worn = travel * draw.uniform(0.1, 0.3);
                Effect::new(form, [1.5 * level, draw.uniform(0.15, 0.5), worn])
            }
            Form::FadeByWay => {
                let lost = self.dry * draw.uniform(0.25, 0.7);
                Effect::new(form, [lost, travel * draw.uniform(5.0, 20.0)])
            }
            _ => self.over_time_or_place(form, level, draw),
        }
    }

    fn over_time_or_place(&self, form: Form, level: f64, draw: &mut Draw) -> Effect {
        let (travel, duration_s) = (self.travel, self.duration_s);
        let period = travel / draw.uniform(1.5, 6.0);
        let stiff = level / (travel * travel * travel);
        match form {
            Form::Drift => Effect::new(form, [draw.sign() * level / duration_s]),
            Form::Creep => {
                let creeps_s = duration_s * draw.uniform(0.15, 0.4);
                Effect::new(form, [draw.sign() * level, creeps_s])
            }
            Form::FadeLinear => Effect::new(form, [self.dry * draw.uniform(0.25, 0.7), duration_s]),
            Form::FadeExponential => {
                let lost = self.dry * draw.uniform(0.25, 0.7);
                Effect::new(form, [lost, duration_s * draw.uniform(0.15, 0.5)])
            }
            Form::Disturbance => Effect::new(form, [level, draw.log_uniform(0.25, 3.0)]),
            Form::Ripple => {
                let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
                Effect::new(form, [level * s, level * c, period])
            }
            Form::TwoOrders => Effect::new(form, [level, period, draw.uniform(0.3, 0.8)]),
            Form::Toothed => Effect::new(form, [level, period, draw.uniform(1.0, 4.0)]),
            Form::TwoRipples => Effect::new(form, [level, period, period / draw.uniform(1.8, 2.9)]),
            Form::Uneven => Effect::new(form, [level, draw.uniform(0.6, 1.0), 2.0 * period]),
            Form::Anchored => {
                let anchor = draw.sign() * travel * draw.uniform(0.3, 1.2);
                Effect::new(form, [level / travel, anchor])
            }
            Form::Hardening => Effect::new(form, [0.6 * level / travel, 2.0 * stiff]),
            Form::Cubic => Effect::new(form, [2.0 * stiff]),
            _ => Effect::new(form, [level]),
        }
    }
}

/// A form as a share of the torque of a brake.
pub fn share(form: Form, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.35);
    let slow = draw.log_uniform(0.05, 0.4);
    let period = TAU / draw.uniform(8.0, 50.0);
    let effect = match form {
        Form::Stribeck => Effect::new(form, [share, slow, 1.0]),
        Form::Rational => Effect::new(form, [share, slow]),
        Form::MaxwellSlip => Effect::new(form, [share, draw.log_uniform(0.03, 0.2)]),
        Form::TwoOrders => Effect::new(form, [share, period, draw.uniform(0.3, 0.8)]),
        Form::Toothed => Effect::new(form, [share, period, draw.uniform(1.0, 4.0)]),
        _ => Effect::new(form, [draw.sign() * share]),
    };
    effect.of_drive()
}

/// A form in a brake whose torques reach a greatest one, N·m.
pub fn in_brake(form: Form, greatest_nm: f64, duration_s: f64, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.3);
    match form {
        Form::Lag => Effect::new(form, [draw.log_uniform(0.012, 0.08)]),
        Form::LagSecond => Effect::new(
            form,
            [draw.log_uniform(0.008, 0.04), draw.uniform(0.5, 1.0)],
        ),
        Form::Gain => Effect::new(form, [draw.sign() * share]),
        Form::Saturation | Form::SoftSaturation => {
            Effect::new(form, [greatest_nm * draw.uniform(0.3, 0.85)])
        }
        Form::Preisach => Effect::new(form, [draw.uniform(0.12, 0.4)]),
        Form::Plays => Effect::new(form, [draw.uniform(0.4, 1.0), draw.uniform(0.08, 0.3)]),
        Form::BoucWenCurrent => {
            Effect::new(form, [draw.uniform(0.4, 0.9), draw.uniform(0.05, 0.2)])
        }
        Form::Thermal => Effect::new(form, [draw.log_uniform(0.02, 0.12)]),
        Form::YieldFade => Effect::new(form, [draw.uniform(0.08, 0.3), duration_s]),
        Form::TimeConstants => Effect::new(form, [draw.uniform(0.5, 3.0), draw.uniform(0.0, 3.0)]),
        Form::OffState => Effect::new(form, [draw.uniform(0.04, 0.25)]),
        Form::Backlash => Effect::new(form, [draw.uniform(0.045, 0.1)]),
        _ => Effect::new(form, [share, draw.log_uniform(0.05, 0.25)]),
    }
}
