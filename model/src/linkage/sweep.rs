//! This file compares arm lengths with each other: the sweep of §4.3 and the score that ranks it.

use rigproof_spec::geometry::{AngleRanges, Arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use super::device::{Brakes, Device};
use super::workspace::{Figures, boundary, map};
use crate::error::ModelError;

/// A set of arm lengths and what its workspace is like; lengths are in units of `L_ED` = `L_CD`, areas in its square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// `L_AE` = `L_BC` over `L_ED`.
    pub l_ae: f64,
    /// `L_AB` over `L_ED`.
    pub l_ab: f64,
    /// The workspace; `None` if there is none.
    pub figures: Option<Figures>,
}

/// Side of the cells of a sweep, in units of `L_ED`.
pub const STEP: f64 = 0.02;

/// The pairs (`L_AE`, `L_AB`) of §4.3, from 0.1 to 2.0 and from 0 to 2.0, in increments of 0.1 (gap `sweep-criterion`).
pub fn pairs() -> impl Iterator<Item = [f64; 2]> {
    (1..=20).flat_map(|ae| (0..=20).map(move |ab| [f64::from(ae) / 10.0, f64::from(ab) / 10.0]))
}

/// Traverses the workspace of one pair, with `L_ED` = 1: three brakes where the base joints share an axis, else four. The
/// share of the rectangle is that of the traced boundary, which a grid's cells do not blur.
///
/// # Errors
/// Those of [`map`].
pub fn candidate([l_ae, l_ab]: [f64; 2], ranges: &AngleRanges) -> Result<Candidate, ModelError> {
    let arms = Arms {
        l_ae_m: l_ae,
        l_ed_m: 1.0,
        l_bc_m: l_ae,
        l_cd_m: 1.0,
        l_ab_m: l_ab,
    };
    let brakes: &'static [Joint] = match l_ab {
        0.0 => Layout::ThreeBrake.brakes(),
        _ => Layout::FourBrake.brakes(),
    };
    let device = Device::Linkage {
        arms,
        ranges: *ranges,
        brakes: Brakes::Joints(brakes),
    };
    let figures = map(&device, STEP)?.figures();
    let traced = boundary(&device, 2.0 * STEP)?;
    let figures = figures.map(|figures| Figures {
        fill: if traced.loops.is_empty() {
            figures.fill
        } else {
            traced.fill()
        },
        ..figures
    });
    Ok(Candidate {
        l_ae,
        l_ab,
        figures,
    })
}

impl Candidate {
    /// The score that a sweep is ranked by, 0 without a workspace.
    ///
    /// ```text
    /// score = well-spaced area / (L_AE + L_ED)² · share of the rectangle that the workspace fills
    /// ```
    ///
    /// The thesis selects 'by inspection' (gap `sweep-criterion`).
    pub fn score(&self) -> f64 {
        let reach = self.l_ae + 1.0;
        self.figures.map_or(0.0, |figures| {
            figures.well_spaced_m2 / (reach * reach) * figures.fill
        })
    }
}
