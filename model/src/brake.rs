//! The magnetorheological brake of thesis chapter 3: from current and motion to resisting torque.

mod backlash;
mod characteristic;
mod current_gain;
mod fluid;
pub mod identify;
mod one_joint;
mod response;
mod time_constant;
mod torque_gain;

pub use backlash::{Backlash, ENTRY_TRAVEL_DEG};
pub use characteristic::Characteristic;
pub use current_gain::current_gain;
pub use fluid::{bingham_stress, laminae_yield_stress};
pub use one_joint::{OneJoint, SPRING_NM_PER_DEG, VirtualSpring, WALL_NM_PER_DEG};
pub use response::{Brake, BrakeState, Course};
pub use time_constant::{bounded_time_constant, slowed, table_time_constant, time_constant};
pub use torque_gain::{fitted_torque_gain, torque_gain};
