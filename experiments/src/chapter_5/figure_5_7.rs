//! Figures 5.7 and 5.8: the tip let go under a spring, free and with brake A locked.

use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use super::release::figure;
use crate::Experiment;

/// 3-brake.
pub const THREE_BRAKE: Experiment = Experiment {
    id: "5.7",
    title: "Comparison of model to data for 3-brake configuration",
    what: "The tip is let go from rest under 9 N towards a cylinder, free and with brake A at 1 A, on the rig and by the thesis's own rules; force, cylinder and start are chosen, the data are lost.",
    run: || figure(Layout::ThreeBrake, &[None, Some(Joint::A)]),
};

/// 4-brake.
pub const FOUR_BRAKE: Experiment = Experiment {
    id: "5.8",
    title: "Comparison of model to data for 4-brake configuration",
    what: "As figure 5.7 on the 4-brake configuration.",
    run: || figure(Layout::FourBrake, &[None, Some(Joint::A)]),
};
