//! This file is a fault of a recording, as the report states it.

use serde::Serialize;

/// Why no conclusion can be drawn.
#[derive(Clone, Debug, Serialize)]
pub struct FaultReport {
    /// The channel's role.
    pub channel: &'static str,
    /// Begin, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// The reason.
    pub reason: String,
}
