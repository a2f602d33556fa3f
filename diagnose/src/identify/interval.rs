//! This file gives an estimate its 95 % interval.

use crate::student::half_width;
use rigproof_model::brake::identify::Estimate;
use rigproof_trace::rig::Value;

/// A value with its 95 % interval by Student's t; without an interval if there are no degrees of
/// freedom.
pub fn with_interval(estimate: &Estimate) -> Value {
    let value = Value::known(estimate.value);
    let half = half_width(estimate.standard_error, estimate.freedom);
    match half {
        Some(half) => Value {
            low95: Some(estimate.value - half),
            high95: Some(estimate.value + half),
            ..value
        },
        None => value,
    }
}
