//! Figures B.1 to B.9: the tip let go under a spring, free and with each brake locked in turn.

use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use crate::Experiment;
use crate::chapter_5::release::figure;

/// The nine figures.
pub const EXPERIMENTS: &[Experiment] = &[
    Experiment {
        id: "B.1",
        title: "3-brake configuration, free motion",
        what: "The tip is let go from rest under 9 N towards a cylinder, every brake off; force, cylinder and start are chosen, the data are lost.",
        run: || figure(Layout::ThreeBrake, &[None]),
    },
    Experiment {
        id: "B.2",
        title: "3-brake configuration with brake A locked",
        what: "As figure B.1 with brake A at 1 A.",
        run: || figure(Layout::ThreeBrake, &[Some(Joint::A)]),
    },
    Experiment {
        id: "B.3",
        title: "3-brake configuration with brake E locked",
        what: "As figure B.1 with brake E at 1 A, in the middle of its backlash.",
        run: || figure(Layout::ThreeBrake, &[Some(Joint::E)]),
    },
    Experiment {
        id: "B.4",
        title: "3-brake configuration with brake B locked",
        what: "As figure B.1 with brake B at 1 A, in the middle of its backlash.",
        run: || figure(Layout::ThreeBrake, &[Some(Joint::B)]),
    },
    Experiment {
        id: "B.5",
        title: "4-brake configuration, free motion",
        what: "As figure B.1 on the 4-brake configuration.",
        run: || figure(Layout::FourBrake, &[None]),
    },
    Experiment {
        id: "B.6",
        title: "4-brake configuration with brake A locked",
        what: "As figure B.5 with brake A at 1 A.",
        run: || figure(Layout::FourBrake, &[Some(Joint::A)]),
    },
    Experiment {
        id: "B.7",
        title: "4-brake configuration with brake E locked",
        what: "As figure B.5 with brake E at 1 A, in the middle of its backlash.",
        run: || figure(Layout::FourBrake, &[Some(Joint::E)]),
    },
    Experiment {
        id: "B.8",
        title: "4-brake configuration with brake B locked",
        what: "As figure B.5 with brake B at 1 A, in the middle of its backlash.",
        run: || figure(Layout::FourBrake, &[Some(Joint::B)]),
    },
    Experiment {
        id: "B.9",
        title: "4-brake configuration with brake C locked",
        what: "As figure B.5 with brake C at 1 A, in the middle of its backlash.",
        run: || figure(Layout::FourBrake, &[Some(Joint::C)]),
    },
];
