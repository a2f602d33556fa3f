//! This file checks that an experiment keeps the arms away from their stops.

use super::play::Played;
use crate::rules::{LEAST_ROOM_DEG, ROOM_EVERY};
use rigproof_model::linkage::forward;
use rigproof_spec::geometry::{Angle, angle_ranges, arms};
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_PER_DEG;

/// Whether every angle stays inside its range with a margin.
pub fn has_room(played: &Played, layout: Layout) -> bool {
    let (arms, ranges) = (arms(layout), angle_ranges(layout));
    let [a, b] = &played.theta_rad;
    let mut angles = a.iter().zip(b).step_by(ROOM_EVERY);
    angles.all(|(a, b)| {
        forward::pose(&arms, *a, *b).is_ok_and(|pose| {
            Angle::ALL.into_iter().all(|angle| {
                let (range, at_deg) = (ranges.of(angle), pose.angle_rad(angle) / RAD_PER_DEG);
                let room_deg = (at_deg - range.least_deg).min(range.greatest_deg - at_deg);
                room_deg >= LEAST_ROOM_DEG
            })
        })
    })
}
