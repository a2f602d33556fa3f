//! The magnetorheological brake of thesis chapter 3: from current and motion to resisting torque.

mod backlash;
mod response;
mod time_constant;
mod torque_gain;

pub use backlash::{Backlash, ENTRY_TRAVEL_DEG};
pub use response::{Brake, Course};
pub use time_constant::{bounded_time_constant, time_constant};
pub use torque_gain::torque_gain;
