//! This file turns what a certificate's trials drew into the numbers of a monitor: the middle of each, and its ends.

use rigproof_impl::monitor::constants::{Constants, NUMBERS, WATCHED};
use rigproof_impl::plant::Parameters;
use rigproof_model::effects::{Drive, Form, OfBrake, form};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::brake_table;

use crate::calibration::{Calibration, Found};
use crate::coverage::{FAR_M, FAST_M_S, FORCES_N, STILL_M_S};
use crate::left_out::{self, Role, role};
use crate::plan::Plan;
use crate::scenario::{
    BACKLASH_SHARE, GREATEST_PAYLOAD_KG, INERTIA_SHARE, Rig, TIME_CONSTANT_SHARE, TORQUE_SHARE,
};

/// Standard deviation of what is anywhere within ±1.
const EVEN: f64 = 0.577_350_269_189_625_8;
/// Smallest half width of an interval, N·m: what a certificate knows exactly, no balance does. A tenth of the least torque of a brake
/// without current (table 3.2).
const LEAST_NM: f64 = 0.021;
/// Speed of a joint at which an interval of viscous friction is taken as one of friction, rad/s: 0.3 m/s, the hasty hand's (decision
/// 0125), at 0.3 m from its axis.
const AT_RAD_S: f64 = 1.0;
/// Time over which the monitor forgets what it learned of the rig, s: five minutes of motion.
const MEMORY_S: f64 = 300.0;
/// Shares of inertial and braking impulses that the model may miss. The mass of a side is one number here and its arms are drawn apart, by
/// 0.058 in the mean square each, of which most is common; the square of what a time constant differs is 0.04.
const MISSED_SHARE: [f64; 2] = [0.02, 0.04];

/// The numbers of one rig of a plan, before its trials have said what they covered; with thresholds that nothing passes.
///
/// # Errors
/// A mechanism of the calibration that the monitor has no number for.
pub fn constants(plan: &Plan, rig: Rig) -> Result<Constants, String> {
    let found = plan.calibration.as_ref();
    let found = found.filter(|own: &&Calibration| own.rig == rig);
    let found: &[Found] = found.map_or(&[], |own| &own.found);
    let mut parameters = Parameters::of(rig.layout());
    let as_found: Vec<_> = found.iter().map(|one| one.as_found.clone()).collect();
    left_out::change(&mut parameters, &as_found).ok_or("its calibration is no plant any more")?;
    parameters.inertia.payload_kg += 0.5 * GREATEST_PAYLOAD_KG;
    let mut all = Ends::new(&parameters);
    let mut resists = [[0.0; 4]; 3];
    for one in found {
        all.take(one, &mut resists)?;
    }
    let [viscous_nm_s, dry_nm, constant_nm] = resists;
    let spread = spread(&parameters, all.numbers());
    let [low, high] = ends(&spread, all.numbers());
    Ok(Constants {
        inertia: parameters.inertia,
        brakes: Joint::ALL.map(|joint| {
            let own = parameters.brakes.get(joint as usize).copied().flatten();
            own.unwrap_or(brake_table(joint))
        }),
        viscous_nm_s,
        dry_nm,
        constant_nm,
        backlash_share: BACKLASH_SHARE + BACKLASH_ROUNDING,
        low,
        high,
        spread,
        memory_s: MEMORY_S,
        missed_share: MISSED_SHARE,
        levels: [f64::MAX; WATCHED],
        surprise: f64::MAX,
        tip_m: [f64::MIN, f64::MAX, f64::MIN, f64::MAX],
        speed_m_s: f64::MAX,
        force_n: f64::MAX,
        far_m: FAR_M,
        speeds_m_s: [STILL_M_S, FAST_M_S],
        forces_n: FORCES_N,
        cells: u64::MAX,
        hold: HOLD,
        longest_fault: rigproof_impl::monitor::LONGEST_FAULT,
    })
}

/// Samples in a row outside of what was covered that raise an alarm: 20 ms, longer than what the noise of a count does to a velocity over
/// eight samples.
pub const HOLD: u32 = 20;
/// How much wider than its share the band about the end of a backlash is: a shaft enters it after 0.02° (decision 0004).
const BACKLASH_ROUNDING: f64 = 0.05;

/// The ends between which each number was drawn.
struct Ends {
    /// Of the torque of the brakes as shares.
    torque: [[f64; 2]; 4],
    /// Of friction beside it, N·m.
    beside_nm: [[f64; 2]; 4],
    /// Of a constant torque, N·m.
    bias_nm: [[f64; 2]; 4],
    off_nm: [f64; 4],
}

impl Ends {
    fn new(parameters: &Parameters) -> Ends {
        let off = |table: &Option<rigproof_spec::tables::BrakeTable>| {
            table.map_or(0.0, |table| table.torque_gain.off_state_nm())
        };
        Ends {
            torque: [[-TORQUE_SHARE, TORQUE_SHARE]; 4],
            beside_nm: [[0.0; 2]; 4],
            bias_nm: [[0.0; 2]; 4],
            off_nm: [0, 1, 2, 3].map(|joint| parameters.brakes.get(joint).map_or(0.0, off)),
        }
    }

    /// Takes a mechanism of the calibration in.
    fn take(
        &mut self,
        found: &Found,
        [viscous, dry, constant]: &mut [[f64; 4]; 3],
    ) -> Result<(), String> {
        let own = &found.as_found;
        let no_number = || {
            let at = own.joint.map_or(String::new(), |joint| {
                format!(" at joint {}", joint.letter())
            });
            format!(
                "the monitor has no number for `{}`{at}",
                own.mechanism.name()
            )
        };
        let first = |all: &[f64]| all.first().copied().unwrap_or(0.0);
        let (value, ends) = (
            first(&own.parameters),
            [first(&found.low), first(&found.high)],
        );
        if role(own.mechanism) == Some(Role::Masses) {
            return Ok(());
        }
        let joint = own.joint.ok_or_else(no_number)? as usize;
        let (of_torque, beside, bias) = (
            self.torque.get_mut(joint).ok_or_else(no_number)?,
            self.beside_nm.get_mut(joint).ok_or_else(no_number)?,
            self.bias_nm.get_mut(joint).ok_or_else(no_number)?,
        );
        let widen = |own: &mut [f64; 2], by: f64| {
            for (own, end) in own.iter_mut().zip(ends) {
                *own += by * (end - value);
            }
        };
        let add = |all: &mut [f64; 4]| {
            if let Some(own) = all.get_mut(joint) {
                *own += value;
            }
        };
        match (own.mechanism, form(own.mechanism)) {
            (Mechanism::Viscous, _) => {
                add(viscous);
                widen(beside, AT_RAD_S);
            }
            (Mechanism::DryOffset, _) => {
                add(dry);
                widen(beside, 1.0);
            }
            (Mechanism::ConstantBias, _) => {
                add(constant);
                widen(bias, 1.0);
            }
            (_, Some(Form::Drive(Drive::Gain))) => {
                for (own, end) in of_torque.iter_mut().zip(ends) {
                    *own = (1.0 + *own) * (1.0 + end) / (1.0 + value) - 1.0;
                }
            }
            (_, Some(Form::Brake(OfBrake::BacklashWidth | OfBrake::TimeConstant))) => {}
            _ => return Err(no_number()),
        }
        Ok(())
    }

    /// The ends of the watched numbers.
    fn numbers(&self) -> ([f64; WATCHED], [f64; WATCHED]) {
        let end = |side: usize| {
            let at = |ends: &[f64; 2]| ends.get(side).copied().unwrap_or(0.0);
            let friction = self.torque.iter().zip(&self.off_nm).zip(&self.beside_nm);
            let least = if side == 0 { -LEAST_NM } else { LEAST_NM };
            let friction = friction.map(|((torque, off_nm), beside)| {
                let own = at(torque) * off_nm + at(beside);
                if own.abs() < LEAST_NM { least } else { own }
            });
            let [bias_a, _, bias_b, _] = &self.bias_nm;
            let bias = [bias_a, bias_b].map(|ends| at(ends) + least);
            let mut all = [0.0; WATCHED];
            let each = self.torque.iter().map(at).chain(friction).chain(bias);
            for (own, value) in all.iter_mut().zip(each) {
                *own = value;
            }
            all
        };
        (end(0), end(1))
    }
}

/// How far each number lies about its middle before anything is seen.
fn spread(
    parameters: &Parameters,
    (low, high): ([f64; WATCHED], [f64; WATCHED]),
) -> [f64; NUMBERS] {
    let half = low.iter().zip(high).map(|(low, high)| 0.5 * (high - low));
    let watched = half.map(|half| EVEN * half);
    let slow = [TIME_CONSTANT_SHARE * EVEN; 4];
    let mut all = [0.0; NUMBERS];
    let each = watched.chain(slow).chain(masses(parameters));
    for (own, value) in all.iter_mut().zip(each) {
        *own = value;
    }
    all
}

/// The ends of all numbers: of those that are not watched as far from the middle as their spread says of an even draw.
fn ends(
    spread: &[f64; NUMBERS],
    (low, high): ([f64; WATCHED], [f64; WATCHED]),
) -> [[f64; NUMBERS]; 2] {
    [(-1.0, low), (1.0, high)].map(|(sign, watched)| {
        let mut all = spread.map(|spread| sign * spread / EVEN);
        for (own, end) in all.iter_mut().zip(watched) {
            *own = end;
        }
        all
    })
}

/// The same of the masses of both sides, and of the payload as a share of its middle.
fn masses(parameters: &Parameters) -> [f64; 3] {
    let own = INERTIA_SHARE * EVEN;
    let payload = 0.5 * GREATEST_PAYLOAD_KG * EVEN / parameters.inertia.payload_kg;
    [own, own, payload]
}
