//! This file puts the four design concepts of §4.2 behind one question: which tip force does each brake give?

use rigproof_spec::geometry::{AngleRanges, Arms, STOPS, angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use super::limits;
use crate::error::ModelError;
use crate::linkage::jacobian::jacobian;

/// One of the four design concepts of §4.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Concept {
    /// The X-Y table of §4.2.1.
    XyTable,
    /// The scaled PTER of §4.2.2.
    ScaledPter,
    /// The five-bar linkage of §4.2.3 with brakes A, E, B.
    ThreeBrake,
    /// The five-bar linkage of §4.2.4 with brakes A, E, B, C.
    FourBrake,
}

impl Concept {
    /// All concepts, in the order of §4.2.
    pub const ALL: [Concept; 4] = [
        Concept::XyTable,
        Concept::ScaledPter,
        Concept::ThreeBrake,
        Concept::FourBrake,
    ];

    /// What the thesis calls it.
    pub const fn name(self) -> &'static str {
        match self {
            Concept::XyTable => "X-Y table",
            Concept::ScaledPter => "scaled PTER",
            Concept::ThreeBrake => "3-brake five-bar linkage",
            Concept::FourBrake => "4-brake five-bar linkage",
        }
    }

    /// The device with the lengths the thesis gives, or the ones assumed where it gives none.
    ///
    /// A scaled PTER has the arms and the stops of the 3-brake linkage; the X-Y table a side of 0.61 m, pulleys of 25 mm
    /// radius and gears without ratio (gap `concept-sizes`).
    pub const fn device(self) -> Device {
        match self {
            Concept::XyTable => Device::XyTable {
                half_side_m: 0.305,
                pulley_m: 0.025,
            },
            Concept::ScaledPter => Device::Linkage {
                arms: arms(Layout::ThreeBrake),
                ranges: STOPS,
                brakes: Brakes::CentralAxis,
            },
            Concept::ThreeBrake => Device::layout(Layout::ThreeBrake),
            Concept::FourBrake => Device::layout(Layout::FourBrake),
        }
    }
}

/// Where the brakes of a five-bar linkage act.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Brakes {
    /// On joints, each on the angle between two neighbouring arms or on a base angle.
    Joints(&'static [Joint]),
    /// On the central axis, as PTER's clutches: on θA, on θB, on their difference (direct coupling: both turn alike) and on
    /// their sum (reverse coupling: they turn oppositely).
    CentralAxis,
}

/// A device with brakes and a tip in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Device {
    /// A square table with crossbars on belts.
    XyTable {
        /// Half the side of the square in which the tip moves, m.
        half_side_m: f64,
        /// Radius of the belts' pulleys, m.
        pulley_m: f64,
    },
    /// A five-bar linkage.
    Linkage {
        /// Its lengths.
        arms: Arms,
        /// Where its angles may lie.
        ranges: AngleRanges,
        /// Where its brakes act.
        brakes: Brakes,
    },
}

impl Device {
    /// The linkage of a layout, with tables 4.1 and 4.2.
    pub const fn layout(layout: Layout) -> Device {
        Device::Linkage {
            arms: arms(layout),
            ranges: angle_ranges(layout),
            brakes: Brakes::Joints(layout.brakes()),
        }
    }

    /// The tip force of each brake at a torque of 1 N·m, x and y, N/(N·m) = 1/m.
    ///
    /// For a linkage these are the rows of the Jacobian (5.33) at the braked joints; for the X-Y table they belong to a brake
    /// on ẏ, one on ẋ, one that couples the two directly and one that couples them inversely.
    ///
    /// # Errors
    /// [`ModelError::OffTable`], or those of [`limits::reach`]: the tip is outside the workspace.
    pub fn tip_forces(&self, tip_m: [f64; 2]) -> Result<Vec<[f64; 2]>, ModelError> {
        match self {
            Device::XyTable {
                half_side_m,
                pulley_m,
            } => {
                let [x_m, y_m] = tip_m;
                if tip_m
                    .iter()
                    .any(|c| !(-half_side_m..=*half_side_m).contains(c))
                {
                    return Err(ModelError::OffTable {
                        x_m,
                        y_m,
                        half_side_m: *half_side_m,
                    });
                }
                let f = 1.0 / pulley_m;
                Ok(vec![[0.0, f], [f, 0.0], [f, -f], [f, f]])
            }
            Device::Linkage {
                arms,
                ranges,
                brakes,
            } => {
                let pose = limits::reach(arms, ranges, tip_m)?;
                let j = jacobian(arms, &pose)?;
                let [a, e, b, c] = [0, 1, 2, 3].map(|row| [j[(row, 0)], j[(row, 1)]]);
                Ok(match brakes {
                    Brakes::Joints(joints) => {
                        let of = |joint: &Joint| match joint {
                            Joint::A => a,
                            Joint::E => e,
                            Joint::B => b,
                            Joint::C => c,
                        };
                        joints.iter().map(of).collect()
                    }
                    Brakes::CentralAxis => {
                        let [a_x, a_y] = a;
                        let [b_x, b_y] = b;
                        vec![a, b, [a_x - b_x, a_y - b_y], [a_x + b_x, a_y + b_y]]
                    }
                })
            }
        }
    }

    /// Corners of a rectangle that the workspace lies in, least and greatest, m.
    pub fn box_m(&self) -> [[f64; 2]; 2] {
        match self {
            Device::XyTable { half_side_m, .. } => {
                [[-half_side_m, -half_side_m], [*half_side_m, *half_side_m]]
            }
            Device::Linkage { arms, .. } => {
                let from_a_m = arms.l_ae_m + arms.l_ed_m;
                let from_b_m = arms.l_bc_m + arms.l_cd_m;
                let reach_m = from_a_m.min(from_b_m);
                let half_m = arms.l_ab_m / 2.0;
                // Both sides must reach the tip.
                [[half_m - from_b_m, -reach_m], [from_a_m - half_m, reach_m]]
            }
        }
    }
}
