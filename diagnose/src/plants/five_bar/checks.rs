//! This file finds channels of a five-bar that are missing, dead, clipped, of the wrong sign or in
//! another unit, before anything is fitted.

use super::run::FiveBarRun;
use crate::align::{
    Fault, Metered, Stated, check_clipped, check_metered, check_missing, check_units,
    longest_freeze,
};
use crate::plant::Run;
use crate::rules::{CURRENTS_A, MOST_TAKEN};
use rigproof_spec::joint::Joint;
use rigproof_trace::rig::five_bar::FiveBarRecording;

/// Checks the channels as recorded.
///
/// # Errors
/// The faulty channel, and the reason.
pub fn check_recorded(recording: &FiveBarRecording) -> Result<(), Fault> {
    check_present(recording)?;
    check_units_of(recording)
}

/// Checks the channels after repair.
///
/// # Errors
/// The faulty channel, and the reason.
pub fn check_mended(recording: &FiveBarRecording, step_s: f64) -> Result<(), Fault> {
    check_dead_forces(recording, step_s)?;
    check_clipped_forces(recording)?;
    check_currents(recording)
}

/// A metered force is noisy where its noise is stated. One that is the same throughout is dead in
/// any case: the hand cannot move the linkage without it.
fn check_dead_forces(recording: &FiveBarRecording, step_s: f64) -> Result<(), Fault> {
    for (channel, force) in ["force_x", "force_y"].into_iter().zip(&recording.force) {
        let is_noisy = force.noise.is_some_and(|noise| noise > 0.0);
        let metered = Metered {
            channel,
            samples: &force.samples,
            positions: &recording.theta.each_ref().map(|own| own.samples.as_slice()),
            least: if is_noisy {
                longest_freeze(step_s)
            } else {
                force.samples.len()
            },
        };
        check_metered(&metered, &recording.time_s, step_s)?;
    }
    Ok(())
}

fn check_clipped_forces(recording: &FiveBarRecording) -> Result<(), Fault> {
    let forces = ["force_x", "force_y"].into_iter().zip(&recording.force);
    for (channel, force) in forces {
        check_clipped(&recording.time_s, &force.samples, force.limit)
            .map_err(|fault| Fault { channel, ..fault })?;
    }
    Ok(())
}

fn check_currents(recording: &FiveBarRecording) -> Result<(), Fault> {
    for signal in recording.currents.iter().flatten() {
        let outside = |x: &f64| !x.is_nan() && !CURRENTS_A.contains(x);
        if let Some(k) = signal.samples.iter().position(outside) {
            let at_s = recording.time_s.get(k).copied().unwrap_or(0.0);
            let value = signal.samples.get(k).copied().unwrap_or(f64::NAN);
            return Err(Fault {
                channel: "current",
                from_s: at_s,
                to_s: at_s,
                reason: format!(
                    "`{}` is {value} A; a brake takes 0 to 1 A: check the unit (mA?) and the sign in the description",
                    signal.channel
                ),
            });
        }
    }
    Ok(())
}

/// Checks that the angles' resolution and the forces' noise fit the stated units.
fn check_units_of(recording: &FiveBarRecording) -> Result<(), Fault> {
    let ends_s = [recording.time_s.first(), recording.time_s.last()];
    let ends_s = ends_s.map(|end| end.copied().unwrap_or(0.0));
    let angles = ["theta_a", "theta_b"].into_iter().zip(&recording.theta);
    let angles = angles.map(|(channel, own)| (channel, own, own.quantum, None));
    let forces = ["force_x", "force_y"].into_iter().zip(&recording.force);
    let forces = forces.map(|(channel, own)| (channel, own, None, own.noise));
    for (channel, own, quantum, noise) in angles.chain(forces) {
        let stated = Stated {
            channel,
            samples: &own.samples,
            quantum,
            noise,
        };
        check_units(&stated, ends_s)?;
    }
    Ok(())
}

fn check_present(recording: &FiveBarRecording) -> Result<(), Fault> {
    let [theta_a, theta_b] = &recording.theta;
    let [force_x, force_y] = &recording.force;
    let named = [
        ("theta_a", theta_a),
        ("theta_b", theta_b),
        ("force_x", force_x),
        ("force_y", force_y),
    ];
    let currents = recording.currents.iter().flatten();
    let all = named
        .into_iter()
        .chain(currents.map(|own| ("current", own)));
    for (channel, signal) in all {
        check_missing(channel, &recording.time_s, &signal.samples)?;
    }
    Ok(())
}

/// A linkage with brakes absorbs energy. A force that takes out energy on average has the wrong
/// sign.
///
/// # Errors
/// The component that gives the most.
pub fn check_sign(run: &FiveBarRun) -> Result<(), Fault> {
    let rates = run.motion_of(Joint::A).iter().zip(run.motion_of(Joint::B));
    let powers: Vec<[f64; 2]> = run
        .forms
        .iter()
        .zip(run.forces())
        .zip(rates)
        .map(|((form, [f_x, f_y]), (a, b))| {
            let [v_x, v_y] = form.tip_velocity_m_s([a.speed, b.speed]);
            [f_x * v_x, f_y * v_y]
        })
        .collect();
    let [by_x, by_y] = powers
        .iter()
        .fold([0.0; 2], |[x, y], [p_x, p_y]| [x + p_x, y + p_y]);
    let size: f64 = powers.iter().map(|[x, y]| (x + y).abs()).sum();
    if by_x + by_y < -MOST_TAKEN * size {
        return Err(Fault {
            channel: if by_x < by_y { "force_x" } else { "force_y" },
            from_s: 0.0,
            to_s: run.clock().duration_s(),
            reason: "the rig drives the hand: energy comes out of it, most of it by this component; a force or an angle has the wrong sign (set `sign = -1`), or force_x and force_y are swapped".to_owned(),
        });
    }
    Ok(())
}
