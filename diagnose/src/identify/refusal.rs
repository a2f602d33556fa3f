//! This file lists the reasons for which recordings of a brake cannot be used.

/// Why a brake cannot be identified.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum IdentifyError {
    /// The rig is no bench with a brake.
    #[error(
        "{recording}: the rig has no {missing}; a brake is identified on a turning `bench` with `torque` and `current`"
    )]
    Channel {
        /// The recording.
        recording: String,
        /// The missing channel.
        missing: &'static str,
    },
    /// The torque drives the motion.
    #[error(
        "{recording}: the torque drives the shaft in {percent} % of the moving samples; one of the two channels has the wrong sign: set `sign = -1`"
    )]
    Sign {
        /// The recording.
        recording: String,
        /// The share of the moving samples, per cent.
        percent: u32,
    },
    /// Too many samples are missing.
    #[error(
        "{recording}: {complete} samples have position, torque and current, at least {least} are needed; record for longer"
    )]
    Samples {
        /// The recording.
        recording: String,
        /// The number of complete samples.
        complete: usize,
        /// The least number that is needed.
        least: usize,
    },
    /// No recording holds a step or a reversal.
    #[error(
        "no recording holds a step of current at constant speed or a reversal at constant current: {left_out}"
    )]
    Nothing {
        /// What was found and not used.
        left_out: String,
    },
}
