//! This file is the plant: the five-bar linkage with its brakes, a force on its tip and physics the thesis leaves out, step by step.

pub mod backlash;
pub mod brake;
pub mod current;
pub mod decay;
pub mod effect;
pub mod form;
pub mod friction;
pub mod motion;
mod reading;
mod setup;
mod step;
pub mod turn;

use brake::{Brake, Characteristic};
use current::CurrentPath;
use effect::{Effect, MOST_EFFECTS};
use friction::Contact;
use motion::{Mechanism, Motion};

pub use motion::{Outcome, Scheme};
pub use setup::Parameters;

use crate::vector::Vector;

/// The rig in motion (§5.3) as it is stepped in real time: one evaluation of the forces a step, dry friction solved exactly.
///
/// Joints are in the order A, E, B, C; a joint without a brake has current and torque 0. Between two steps the linkage is always
/// closed and away from its singularities.
///
/// | state | unit |
/// |---|---|
/// | θA, θB, the directions of AE and BC, their rates, their last accelerations | rad, 1, rad/s, rad/s² |
/// | of every brake: yield torque, backlash, origin of a fall, current | N·m, rad, A, A |
/// | which brakes hold and which slip | – |
/// | of every effect: its memory | rad or 1 |
///
/// # Differs from the thesis
///
/// The scheme and the friction are those of decision 0077.
///
/// ```
/// use rigproof_impl::plant::{Outcome, Parameters, Plant};
/// use rigproof_spec::layout::Layout;
/// let parameters = Parameters::of(Layout::ThreeBrake);
/// let mut plant = Plant::new(&parameters, [2.2, 0.9], [0.0; 2], &[]).unwrap();
/// for _ in 0..70 {
///     assert_eq!(plant.step([2.7, -4.1], [0.0, 0.31, 0.0, 0.0], 1e-3), Outcome::Moved);
/// }
/// assert!(plant.tip_velocity_m_s().norm() > 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plant {
    mechanism: Mechanism<f64>,
    characteristics: [Option<Characteristic>; 4],
    /// The greatest current that is taken, A: 0 where there is no brake.
    greatest_a: [f64; 4],
    motion: Motion<f64>,
    brakes: [Brake; 4],
    /// Where the joints were last looked at: their angles, rad, and the directions from arm to arm at E and C.
    looked_rad: [f64; 4],
    elbows: [Vector<f64>; 2],
    /// How long before the end of the last step that was, s.
    since_look_s: f64,
    contact: Contact,
    held: [bool; 4],
    torques_nm: [f64; 4],
    time_s: f64,
    /// None where every brake has the current that it is asked for.
    paths: Option<[CurrentPath; 4]>,
    effects: [Option<Effect>; MOST_EFFECTS],
}
