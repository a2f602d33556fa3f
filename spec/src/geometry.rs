//! This file holds the lengths and the angle ranges that the thesis prints about its linkage: tables 4.1 and 4.2, §4.5.
//!
//! The same tables stand a second time as CSV under `thesis/tables/`; a test compares the two.

use crate::layout::Layout;

/// The arm lengths of a five-bar linkage, m (thesis figure 4.5).
///
/// Base joints A and B lie at (−`L_AB`/2, 0) and (`L_AB`/2, 0). Arm AE carries arm ED, arm BC carries arm CD, and ED and
/// CD meet in the tip D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arms {
    /// `L_AE`, from base joint A to joint E, m.
    pub l_ae_m: f64,
    /// `L_ED`, from joint E to the tip, m.
    pub l_ed_m: f64,
    /// `L_BC`, from base joint B to joint C, m.
    pub l_bc_m: f64,
    /// `L_CD`, from joint C to the tip, m.
    pub l_cd_m: f64,
    /// `L_AB`, between the base joints, m; zero where they share an axis.
    pub l_ab_m: f64,
}

/// The arm lengths of a layout (table 4.1).
pub const fn arms(layout: Layout) -> Arms {
    match layout {
        Layout::ThreeBrake => Arms {
            l_ae_m: 0.305,
            l_ed_m: 0.305,
            l_bc_m: 0.305,
            l_cd_m: 0.305,
            l_ab_m: 0.0,
        },
        Layout::FourBrake => Arms {
            l_ae_m: 0.264,
            l_ed_m: 0.305,
            l_bc_m: 0.264,
            l_cd_m: 0.305,
            l_ab_m: 0.267,
        },
    }
}

/// An angle of the linkage: those of the four joints that can carry a brake, and the one at the tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Angle {
    /// θA, from the x axis to arm AE.
    A,
    /// θE, from arm AE to arm ED.
    E,
    /// θB, from the x axis to arm BC.
    B,
    /// θC, from arm BC to arm CD.
    C,
    /// θD, from arm ED to arm CD.
    D,
}

impl Angle {
    /// All angles, those of the brakes in the house order.
    pub const ALL: [Angle; 5] = [Angle::A, Angle::E, Angle::B, Angle::C, Angle::D];

    /// The letter the thesis prints below θ.
    pub const fn letter(self) -> &'static str {
        match self {
            Angle::A => "A",
            Angle::E => "E",
            Angle::B => "B",
            Angle::C => "C",
            Angle::D => "D",
        }
    }
}

/// Where an angle may lie, both ends included, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleRange {
    /// The least angle, degrees.
    pub least_deg: f64,
    /// The greatest angle, degrees.
    pub greatest_deg: f64,
}

impl AngleRange {
    /// A range from its ends, degrees.
    pub const fn new(least_deg: f64, greatest_deg: f64) -> AngleRange {
        AngleRange {
            least_deg,
            greatest_deg,
        }
    }
}

/// Where the five angles of a linkage may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleRanges {
    /// Of θA.
    pub a: AngleRange,
    /// Of θE.
    pub e: AngleRange,
    /// Of θB.
    pub b: AngleRange,
    /// Of θC.
    pub c: AngleRange,
    /// Of θD.
    pub d: AngleRange,
}

impl AngleRanges {
    /// The range of one angle.
    pub const fn of(&self, angle: Angle) -> AngleRange {
        match angle {
            Angle::A => self.a,
            Angle::E => self.e,
            Angle::B => self.b,
            Angle::C => self.c,
            Angle::D => self.d,
        }
    }
}

/// The range that each angle takes on a layout, degrees (table 4.2).
pub const fn angle_ranges(layout: Layout) -> AngleRanges {
    match layout {
        Layout::ThreeBrake => AngleRanges {
            a: AngleRange::new(10.0, 180.0),
            e: AngleRange::new(190.0, 350.0),
            b: AngleRange::new(0.0, 170.0),
            c: AngleRange::new(10.0, 170.0),
            d: AngleRange::new(10.0, 170.0),
        },
        Layout::FourBrake => AngleRanges {
            a: AngleRange::new(37.0, 180.0),
            e: AngleRange::new(210.0, 350.0),
            b: AngleRange::new(0.0, 143.0),
            c: AngleRange::new(10.0, 150.0),
            d: AngleRange::new(51.0, 170.0),
        },
    }
}

/// The stops that the hardware has on both layouts, degrees (§4.5): rings and plates on θC, θD and θE, and a bumper on
/// one side each of θA and θB, which leaves their other side open.
pub const STOPS: AngleRanges = AngleRanges {
    a: AngleRange::new(f64::NEG_INFINITY, 180.0),
    e: AngleRange::new(190.0, 350.0),
    b: AngleRange::new(0.0, f64::INFINITY),
    c: AngleRange::new(10.0, 170.0),
    d: AngleRange::new(10.0, 170.0),
};
