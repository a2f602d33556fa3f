//! This file puts the jointed displays of chapter 2 behind the question of §4.3: which local paths do they offer?

use rigproof_spec::displays::BODY;
use rigproof_spec::geometry::{STOPS, arms};
use rigproof_spec::joint::Joint;

use crate::linkage::device::{Brakes, Concept, Device};

/// The displays with a fixed set of local paths, with the arms and stops of the scaled PTER (gap `displays-bodies`).
///
/// Osaka's brakes lock links A and B. PADyC's clutches lock joint A or E where both of a joint's motors stand. Scooter has no fixed
/// paths: its castors point anywhere, and §4.3 has nothing to measure.
pub fn with_local_paths() -> [(&'static str, Device); 3] {
    let jointed = |joints| Device::Linkage {
        arms: arms(BODY),
        ranges: STOPS,
        brakes: Brakes::Joints(joints),
    };
    [
        ("PTER", Concept::ScaledPter.device()),
        ("Osaka's ER display", jointed(&[Joint::A, Joint::B])),
        ("PADyC", jointed(&[Joint::A, Joint::E])),
    ]
}
