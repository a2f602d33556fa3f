//! This file turns the settings that a program in C gives into a controller, or refuses them.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{PathLaw, Proportional, Sdof, Uncontrolled};
use rigproof_impl::path::{AnyPath, Line, Polyline};
use rigproof_impl::tick::{Settings, Tick};
use rigproof_spec::geometry::Arms;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, greatest_desired_force_n};

use crate::words::RigproofTickLaw;
use crate::{Controller, RIGPROOF_TICK_VERSION, RigproofTickStatus, is_of_this_version, is_usable};

/// Most corners of a path.
pub const RIGPROOF_MOST_CORNERS: usize = 16;

/// What is fixed about a rig, its law and its path. `rigproof_tick_thesis` fills it in.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofTickSettings {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    /// How many brakes: 3 (A, E, B) or 4 (A, E, B, C).
    pub brakes: u32,
    /// The law: a number of `RigproofTickLaw`.
    pub law: u32,
    /// Lengths of AE, ED, BC, CD and AB, m.
    pub arms_m: [f64; 5],
    /// Counts a turn of the encoders on A and B.
    pub counts_per_turn: [u32; 2],
    /// Their counts where the angle is zero.
    pub zero_counts: [i32; 2],
    /// Time from one sample to the next, s.
    pub sample_s: f64,
    /// Greatest rate at which a base joint is believed to turn, rad/s.
    pub greatest_rate_rad_s: f64,
    /// Greatest component of a tip force that is believed, N.
    pub greatest_force_n: f64,
    /// Greatest force asked of a brake at the tip, N.
    pub greatest_desired_force_n: f64,
    /// Boundary of the velocity field, m.
    pub boundary_m: f64,
    /// Gain of proportional control, N·s/m.
    pub gain_n_s_per_m: f64,
    /// Gap of SDOF control, m; 0 for none.
    pub gap_m: f64,
    /// How many corners the path has: 2 for an endless line, more for a chain.
    pub corners: u32,
    /// Whether the chain returns to its first corner: 0 or 1.
    pub closed: u32,
    /// The corners, x and y, m.
    pub corners_m: [[f64; 2]; RIGPROOF_MOST_CORNERS],
}

impl RigproofTickSettings {
    /// The thesis's rig without a law.
    fn thesis(layout: Layout) -> RigproofTickSettings {
        let settings = Settings::thesis(layout);
        let Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        } = settings.arms;
        RigproofTickSettings {
            size: size_of::<RigproofTickSettings>() as u32,
            version: RIGPROOF_TICK_VERSION,
            brakes: layout.brakes().len() as u32,
            law: RigproofTickLaw::Uncontrolled as u32,
            arms_m: [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m],
            counts_per_turn: settings.counts_per_turn,
            zero_counts: settings.zero_counts,
            sample_s: settings.sample_s,
            greatest_rate_rad_s: settings.greatest_rate_rad_s,
            greatest_force_n: settings.greatest_force_n,
            greatest_desired_force_n: greatest_desired_force_n(layout),
            boundary_m: BLEND_BOUNDARY_M,
            gain_n_s_per_m: 0.0,
            gap_m: 0.0,
            corners: 0,
            closed: 0,
            corners_m: [[0.0; 2]; RIGPROOF_MOST_CORNERS],
        }
    }

    /// The controller of these settings, if they are those of one.
    pub(crate) fn controller(&self) -> Option<Controller> {
        let settings = self.tick()?;
        Tick::new(&settings, self.law(settings.layout, &settings.arms)?)
    }

    /// What they say of the rig.
    pub(crate) fn tick(&self) -> Option<Settings> {
        let [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m] = self.arms_m;
        Some(Settings {
            arms: Arms {
                l_ae_m,
                l_ed_m,
                l_bc_m,
                l_cd_m,
                l_ab_m,
            },
            layout: layout(self.brakes)?,
            counts_per_turn: self.counts_per_turn,
            zero_counts: self.zero_counts,
            sample_s: self.sample_s,
            greatest_rate_rad_s: self.greatest_rate_rad_s,
            greatest_force_n: self.greatest_force_n,
        })
    }

    fn path(&self) -> Option<ChosenPath> {
        let corners_m = self.corners_m.get(..self.corners as usize)?;
        match (self.closed, corners_m) {
            (0, [from_m, to_m]) => Some(AnyPath::Line(Line::through(*from_m, *to_m)?)),
            (0, _) => Some(AnyPath::Polyline(Polyline::open(corners_m)?)),
            (1, _) => Some(AnyPath::Polyline(Polyline::closed(corners_m)?)),
            _ => None,
        }
    }

    fn law(&self, layout: Layout, arms: &Arms) -> Option<PathLaw<f64, ChosenPath>> {
        if self.law == RigproofTickLaw::Uncontrolled as u32 {
            return Some(PathLaw::Uncontrolled(Uncontrolled));
        }
        let actuation = Actuation::new(layout, arms, self.greatest_desired_force_n)?;
        let path = self.path()?;
        if self.law == RigproofTickLaw::Proportional as u32 {
            let law = Proportional::new(actuation, path, self.boundary_m, self.gain_n_s_per_m)?;
            Some(PathLaw::Proportional(law))
        } else if self.law == RigproofTickLaw::Sdof as u32 {
            let law = Sdof::new(actuation, path, self.boundary_m, self.gap_m)?;
            Some(PathLaw::Sdof(law))
        } else {
            None
        }
    }
}

/// A path that C can describe.
type ChosenPath = AnyPath<f64, RIGPROOF_MOST_CORNERS>;

/// The layout with so many brakes.
fn layout(brakes: u32) -> Option<Layout> {
    match brakes {
        3 => Some(Layout::ThreeBrake),
        4 => Some(Layout::FourBrake),
        _ => None,
    }
}

/// Fills in the thesis's rig with 3 or 4 brakes; law, gain, gap and path are left to choose. Size and version have to be there already.
///
/// # Safety
/// `settings` must be null or point to `settings->size` bytes that may be read and written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_tick_thesis(
    settings: *mut RigproofTickSettings,
    brakes: u32,
) -> RigproofTickStatus {
    if !is_usable(settings) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(settings) } {
        return RigproofTickStatus::BadVersion;
    }
    let Some(layout) = layout(brakes) else {
        return RigproofTickStatus::BadSettings;
    };
    // SAFETY: not null, aligned, of this very size, and the caller's to write.
    unsafe { settings.write(RigproofTickSettings::thesis(layout)) };
    RigproofTickStatus::Ok
}
