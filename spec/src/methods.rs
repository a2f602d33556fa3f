//! This file holds tables 6.1 and 6.2, the methods that were tried on people, and the numbers of sections 6.1 and 6.5.

use crate::layout::Layout;

/// Distance from the path inside which the desired velocity turns towards the path's direction, m (§6.1.1: 5 cm).
pub const BLEND_BOUNDARY_M: f64 = 0.05;
/// Time from one sample to the next, s (§6.5.1: 1000 Hz).
pub const SAMPLE_STEP_S: f64 = 0.001;
/// Cut-off of the filters of the metrics, Hz (§6.5.2).
pub const METRIC_CUTOFF_HZ: f64 = 25.0;
/// Component of a unit force below which the force counts as having no influence on a velocity component (6.12).
///
/// The thesis prints a 0 for "no effect", which no measured pose gives; this is far below any angle that an encoder
/// can tell from zero.
pub const NO_INFLUENCE: f64 = 1e-9;
/// Share of the rate that a joint would have if the tip moved straight along its force, at or below which the joint stands (gap
/// `joint-at-rest`).
///
/// One count in the longest window beside the greatest rate that is believed is 2.6·10⁻⁴; rounding in single precision is 10⁻⁶.
pub const STANDING: f64 = 1e-4;
/// Speed below which the tip stands, m/s (gap `tip-at-rest`).
///
/// At this speed a count of an encoder takes half a year. Above it the squares by which the rate of a joint within a hundred metres is judged are
/// normal numbers, in single precision too.
pub const STANDING_TIP_M_S: f64 = 1e-12;

/// Greatest force that a controller asks for at the tip, N (§6.1.2).
pub const fn greatest_desired_force_n(layout: Layout) -> f64 {
    match layout {
        Layout::ThreeBrake => 19.5,
        Layout::FourBrake => 22.0,
    }
}

/// A row of table 6.1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// No control.
    Uncontrolled,
    /// SDOF without gap.
    Sdof,
    /// SDOF with gap.
    SdofWithGap,
    /// Proportional, low gain.
    ProportionalLow,
    /// Proportional, high gain.
    ProportionalHigh,
}

/// The last column of table 6.1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// A dash.
    Nothing,
    /// Distance from the path inside which no brake acts, cm.
    GapCm(f64),
    /// The gain of (6.13), printed as Ns/m.
    GainPrinted(f64),
}

impl Method {
    /// The rows of table 6.1.
    pub const ALL: [Method; 5] = [
        Method::Uncontrolled,
        Method::Sdof,
        Method::SdofWithGap,
        Method::ProportionalLow,
        Method::ProportionalHigh,
    ];

    /// Number of the experiment (table 6.1).
    pub const fn experiment(self) -> u8 {
        match self {
            Method::Uncontrolled => 1,
            Method::Sdof => 2,
            Method::SdofWithGap => 3,
            Method::ProportionalLow => 4,
            Method::ProportionalHigh => 5,
        }
    }

    /// Gap or gain (table 6.1).
    pub const fn setting(self) -> Setting {
        match self {
            Method::Uncontrolled => Setting::Nothing,
            Method::Sdof => Setting::GapCm(0.0),
            Method::SdofWithGap => Setting::GapCm(0.50),
            Method::ProportionalLow => Setting::GainPrinted(5.0),
            Method::ProportionalHigh => Setting::GainPrinted(10_000.0),
        }
    }

    /// The letter of the figures (table 6.2).
    pub const fn abbreviation(self) -> &'static str {
        match self {
            Method::Uncontrolled => "N",
            Method::Sdof => "S",
            Method::SdofWithGap => "G",
            Method::ProportionalLow => "L",
            Method::ProportionalHigh => "H",
        }
    }
}
