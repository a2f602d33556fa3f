//! This file is a brake with what is hidden in it, beside the brake that the nominal model knows.

use crate::brake::{Brake, BrakeStep};
use crate::effect::Effect;
use crate::form::Form;
use crate::preisach::Preisach;
use rigproof_spec::joint::Joint;

/// Heat capacity of the fluid, J/K: some ten millilitres of oil and iron.
const FLUID_J_PER_K: f64 = 30.0;
/// Heat capacity of the housing, J/K.
const HOUSING_J_PER_K: f64 = 400.0;
/// Conductance from fluid to housing, W/K.
const FLUID_TO_HOUSING_W_PER_K: f64 = 0.5;
/// Conductance from housing to air, W/K.
const HOUSING_TO_AIR_W_PER_K: f64 = 0.5;
/// Travel of a step that is rounding, rad: the angle of a held C or E is worked out from two others.
const ROUNDING_RAD: f64 = 1e-13;
/// The yield does not fall below this share of the cold one.
const LEAST_SHARE: f64 = 0.3;

/// What a yield is divided by at least, N·m.
const LEAST_YIELD_NM: f64 = 1e-6;

/// A brake, true and nominal, and its hidden effects.
#[derive(Clone, Debug)]
pub struct Braked {
    nominal: Brake,
    /// The brake with what is hidden ahead of its yield; the nominal one where nothing is.
    upstream: Option<Brake>,
    effects: Vec<(usize, Effect)>,
    preisach: Preisach,
    /// Three plays of the current, or the state of its Bouc–Wen law, A.
    plays_a: [f64; 3],
    lagged_nm: f64,
    /// Rate of the lagged torque, N·m/s.
    lagging_nm_s: f64,
    /// The torque of a second-order response, N·m.
    twice_nm: f64,
    fluid_k: f64,
    housing_k: f64,
    /// Travel since the last reversal, signed, rad: infinite before the first one, none before it moved at all.
    travel_rad: Option<f64>,
    angle_rad: f64,
    time_s: f64,
}

impl Braked {
    /// The brake of a joint, settled without current, with the effects that act in it and their numbers.
    pub fn new(joint: Joint, effects: Vec<(usize, Effect)>, angle_rad: f64) -> Braked {
        let hidden = || effects.iter().map(|(_, effect)| *effect);
        let own = |effect: &Effect| matches!(effect.form, Form::Backlash | Form::TimeConstants);
        let width = hidden().find(own);
        let nominal = Brake::new(joint, None, angle_rad);
        let upstream = hidden().any(|effect| is_upstream(effect.form));
        Braked {
            lagged_nm: nominal.yield_nm(),
            upstream: upstream.then(|| Brake::new(joint, width, angle_rad)),
            effects,
            preisach: Preisach::new(),
            plays_a: [0.0; 3],
            lagging_nm_s: 0.0,
            twice_nm: nominal.yield_nm(),
            nominal,
            fluid_k: 0.0,
            housing_k: 0.0,
            travel_rad: None,
            angle_rad,
            time_s: 0.0,
        }
    }

    /// Moves the brake over a step that ends at `time_s`.
    pub fn step(&mut self, time_s: f64, step: &BrakeStep) {
        self.nominal.step(time_s, step);
        self.time_s = time_s;
        self.travel(step.position_rad - self.angle_rad);
        self.angle_rad = step.position_rad;
        let power_w = self.yield_nm() * step.speed_rad_s.abs();
        let current_a = self.magnetic_current_a(time_s, step.current_a);
        let target_nm = match &mut self.upstream {
            Some(brake) => {
                brake.step(time_s, &BrakeStep { current_a, ..*step });
                brake.yield_nm()
            }
            None => self.nominal.yield_nm(),
        };
        let lag_s = self.acting(Form::Lag, time_s);
        self.lagged_nm = lag_s.map_or(target_nm, |lag_s| {
            target_nm + (self.lagged_nm - target_nm) * libm::exp(-step.step_s / lag_s)
        });
        self.lag_twice(time_s, target_nm, step.step_s);
        if self
            .effects
            .iter()
            .any(|(_, effect)| effect.form == Form::Thermal)
        {
            let between_w = FLUID_TO_HOUSING_W_PER_K * (self.fluid_k - self.housing_k);
            self.fluid_k += step.step_s * (power_w - between_w) / FLUID_J_PER_K;
            self.housing_k += step.step_s * (between_w - HOUSING_TO_AIR_W_PER_K * self.housing_k)
                / HOUSING_J_PER_K;
        }
    }

    /// The first number of the effect that has this form and acts.
    fn acting(&self, form: Form, time_s: f64) -> Option<f64> {
        let mut effects = self.effects.iter().map(|(_, effect)| effect);
        let effect = effects.find(|effect| effect.form == form && effect.acts(time_s))?;
        Some(effect.first())
    }

    /// Travels on, or back from a reversal.
    fn travel(&mut self, travel_rad: f64) {
        if travel_rad.abs() < ROUNDING_RAD {
            return;
        }
        self.travel_rad = Some(match self.travel_rad {
            None => f64::INFINITY.copysign(travel_rad),
            Some(since) if travel_rad * since < 0.0 => travel_rad,
            Some(since) => since + travel_rad,
        });
    }

    /// The current that the fluid sees, A.
    fn magnetic_current_a(&mut self, time_s: f64, current_a: f64) -> f64 {
        if let Some(share) = self.acting(Form::Preisach, time_s) {
            self.preisach.take(current_a);
            return current_a + share * (self.preisach.output() - current_a.clamp(0.0, 1.0));
        }
        let acts = |(_, effect): &&(usize, Effect)| effect.acts(time_s);
        for (_, effect) in self.effects.iter().filter(acts) {
            let [share, width_a, ..] = effect.values;
            match effect.form {
                // Prandtl–Ishlinskii: plays of a third, two thirds and the whole of the width.
                Form::Plays => {
                    let mut sum_a = 0.0;
                    for (k, play_a) in self.plays_a.iter_mut().enumerate() {
                        let half_a = 0.5 * width_a * (k + 1) as f64 / 3.0;
                        *play_a = play_a.clamp(current_a - half_a, current_a + half_a);
                        sum_a += *play_a;
                    }
                    return (current_a + share * (sum_a / 3.0 - current_a)).max(0.0);
                }
                // dz/dI = 1 − (z·sgn dI + |z|)/(2·width): half of what goes in comes out again.
                Form::BoucWenCurrent => {
                    let [z, last_a, _] = &mut self.plays_a;
                    let more_a = current_a - *last_a;
                    *last_a = current_a;
                    let slope = 1.0 - (*z * more_a.signum() + z.abs()) / (2.0 * width_a);
                    *z = (*z + more_a * slope).clamp(-width_a, width_a);
                    return (current_a - share * *z).max(0.0);
                }
                _ => {}
            }
        }
        current_a
    }

    /// A second-order response in place of the lagged torque.
    fn lag_twice(&mut self, time_s: f64, target_nm: f64, step_s: f64) {
        let twice = |(_, effect): &&(usize, Effect)| effect.form == Form::LagSecond;
        let Some((_, effect)) = self.effects.iter().find(twice) else {
            return;
        };
        let [time_constant_s, damping, ..] = effect.values;
        if !effect.acts(time_s) {
            self.twice_nm = target_nm;
            return;
        }
        let pull = (target_nm - self.twice_nm) / (time_constant_s * time_constant_s);
        self.lagging_nm_s += step_s * (pull - 2.0 * damping / time_constant_s * self.lagging_nm_s);
        self.twice_nm += step_s * self.lagging_nm_s;
        self.lagged_nm = self.twice_nm;
    }

    /// Yield torque, N·m, at least zero.
    pub fn yield_nm(&self) -> f64 {
        self.raised(|_, _| {})
    }

    /// Yield torque of the brake that the nominal model knows, N·m.
    pub fn nominal_yield_nm(&self) -> f64 {
        self.nominal.yield_nm()
    }

    /// What each effect adds to the nominal yield torque, N·m, by its number. Current, window and lag come first; gain, heat
    /// and reversals multiply what is there.
    pub fn added_nm(&self) -> Vec<(usize, f64)> {
        let mut added = Vec::new();
        let upstream_nm = self.lagged_nm - self.nominal.yield_nm();
        for (number, effect) in &self.effects {
            if matches!(effect.form, Form::Lag | Form::LagSecond) || is_upstream(effect.form) {
                added.push((*number, upstream_nm));
            }
        }
        self.raised(|number, more_nm| added.push((number, more_nm)));
        added
    }

    fn raised(&self, mut tell: impl FnMut(usize, f64)) -> f64 {
        let mut yield_nm = self.lagged_nm;
        for (number, effect) in &self.effects {
            let [a, b, ..] = effect.values;
            let more = match effect.form {
                _ if !effect.acts(self.time_s) => 0.0,
                Form::Gain => a,
                Form::Thermal => (-a * self.fluid_k).max(LEAST_SHARE - 1.0),
                Form::YieldOvershoot => {
                    let fades = |since: f64| a * libm::exp(-since.abs() / b);
                    self.travel_rad.map_or(0.0, fades)
                }
                Form::YieldOvershootLinear => {
                    let fades = |since: f64| a * (1.0 - since.abs() / b).max(0.0);
                    self.travel_rad.map_or(0.0, fades)
                }
                Form::YieldFade => -a * (self.time_s / b).min(1.0),
                Form::OffState => a / yield_nm.max(LEAST_YIELD_NM),
                Form::Saturation => (a / yield_nm.max(LEAST_YIELD_NM)).min(1.0) - 1.0,
                Form::SoftSaturation => {
                    let ratio = yield_nm.max(LEAST_YIELD_NM) / a;
                    libm::tanh(ratio) / ratio - 1.0
                }
                _ => continue,
            };
            tell(*number, more * yield_nm);
            yield_nm *= 1.0 + more;
        }
        yield_nm.max(0.0)
    }
}

/// Whether a form acts ahead of the yield torque, on the window or the current.
const fn is_upstream(form: Form) -> bool {
    matches!(
        form,
        Form::Backlash | Form::Preisach | Form::Plays | Form::BoucWenCurrent | Form::TimeConstants
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(effect: Effect, current_a: impl Fn(f64) -> f64, seconds: f64) -> (Braked, Vec<f64>) {
        let mut braked = Braked::new(Joint::A, vec![(3, effect)], 0.4);
        let mut yields = Vec::new();
        let step_s = 1e-4;
        for k in 1..=(seconds / step_s) as u32 {
            let time_s = f64::from(k) * step_s;
            let step = BrakeStep {
                step_s,
                current_a: current_a(time_s),
                position_rad: 0.4 + 1.3 * time_s,
                speed_rad_s: 1.3,
            };
            braked.step(time_s, &step);
            yields.push(braked.yield_nm());
        }
        (braked, yields)
    }

    #[test]
    fn what_is_added_makes_up_the_difference() {
        for law in [
            Form::Gain.of([-0.17]),
            Form::Lag.of([0.031]),
            Form::Preisach.of([0.23]),
            Form::Thermal.of([0.013]),
            Form::YieldOvershoot.of([0.21, 0.3]),
            Form::Plays.of([0.4, 0.3]),
            Form::BoucWenCurrent.of([0.4, 0.2]),
            Form::LagSecond.of([0.021, 0.7]),
            Form::TimeConstants.of([0.8, 1.3]),
            Form::OffState.of([0.11]),
            Form::Saturation.of([1.1]),
            Form::SoftSaturation.of([4.3]),
            Form::YieldFade.of([0.3, 5.0]),
        ] {
            let current_a = |time_s: f64| if time_s < 1.0 { 0.83 } else { 0.41 };
            let (braked, _) = turned(law, current_a, 1.013);
            let added: f64 = braked.added_nm().iter().map(|(_, more)| more).sum();
            let difference = braked.yield_nm() - braked.nominal_yield_nm();
            assert!((added - difference).abs() < 1e-12, "{law:?}");
            assert!(
                difference.abs() > 1e-4 || law.form == Form::YieldOvershoot,
                "{law:?}"
            );
        }
    }

    #[test]
    fn an_overshoot_needs_a_reversal_and_rounding_is_none() {
        let law = Form::YieldOvershoot.of([0.21, 0.3]);
        for sense in [1.0, -1.0] {
            let mut braked = Braked::new(Joint::C, vec![(0, law)], 0.4);
            let mut go = |position_rad: f64| {
                let step = BrakeStep {
                    step_s: 1e-4,
                    current_a: 0.7,
                    position_rad,
                    speed_rad_s: 0.0,
                };
                braked.step(0.0, &step);
                braked.added_nm()[0].1 / braked.nominal_yield_nm()
            };
            assert_eq!(go(0.4 + sense), 0.0);
            let turned = go(0.4 + 0.85 * sense);
            assert!((turned - 0.21 * libm::exp(-0.5)).abs() < 1e-9);
            // Held: two others' angles put it here and there by rounding.
            assert!((go(0.4 + 0.85 * sense + 2.3e-15) - turned).abs() < 1e-9);
            assert!((go(0.4 + 0.85 * sense - 2.3e-15) - turned).abs() < 1e-9);
            assert!((go(0.4 + 0.7 * sense) - 0.21 * libm::exp(-1.0)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_current_comes_back_on_another_branch() {
        let ramp = |time_s: f64| if time_s < 1.0 { time_s } else { 2.0 - time_s };
        let (_, yields) = turned(Form::Preisach.of([0.23]), ramp, 1.9);
        let (up, down) = (yields[4999], yields[14_999]);
        assert!(down > up + 0.5, "{up} {down}");
    }

    /// The three laws of the current's memory have loops of their own: up and down differ, and so do the laws.
    #[test]
    fn the_laws_of_the_current_differ() {
        let ramp = |time_s: f64| 0.8 - 0.8 * (time_s - 1.0).abs();
        let loops = [
            Form::Preisach.of([0.3]),
            Form::Plays.of([0.7, 0.3]),
            Form::BoucWenCurrent.of([0.7, 0.15]),
        ]
        .map(|effect| {
            let (_, yields) = turned(effect, ramp, 1.95);
            [4999, 9999, 14_999, 18_999].map(|k: usize| yields[k])
        });
        for (k, one) in loops.iter().enumerate() {
            assert!(one[2] > one[0] + 0.2, "{one:?}");
            for other in loops.iter().skip(k + 1) {
                let apart = one.iter().zip(other).map(|(a, b)| (a - b).abs());
                assert!(apart.fold(0.0, f64::max) > 0.1, "{loops:?}");
            }
        }
    }

    #[test]
    fn a_warm_brake_fades_and_comes_back_in_two_steps() {
        let (mut braked, yields) = turned(Form::Thermal.of([0.011]), |_| 0.7, 30.0);
        let (early, late) = (yields[2000], yields[299_999]);
        assert!(late < 0.95 * early, "{early} {late}");
        let warm = (braked.fluid_k, braked.housing_k);
        let rest = BrakeStep {
            step_s: 1e-3,
            current_a: 0.7,
            position_rad: 39.4,
            speed_rad_s: 0.0,
        };
        for _ in 0..60_000 {
            braked.step(31.0, &rest);
        }
        assert!(braked.fluid_k < 0.6 * warm.0 && braked.housing_k > warm.1);
        assert!((braked.fluid_k - braked.housing_k) < 0.4 * (warm.0 - warm.1));
    }
}
