//! This file makes the same rig twice, as the reference and as the plant, and draws numbers.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::plant::{Outcome, Parameters, Plant, Scheme};
use rigproof_model::rig::Rig;
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::{ArmInertia, Inertia};
use rigproof_spec::layout::Layout;

/// Both layouts.
pub const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];

/// A point near the middle of a layout's workspace, m.
pub fn middle_m(layout: Layout) -> [f64; 2] {
    match layout {
        Layout::ThreeBrake => [0.013, 0.417],
        Layout::FourBrake => [0.017, 0.389],
    }
}

/// The plant where a rig stands.
pub fn plant_of(rig: &Rig, scheme: Scheme) -> Plant {
    let of = rig.parameters();
    let parameters = Parameters {
        arms: of.arms,
        inertia: of.inertia,
        scheme,
        ..Parameters::of(of.layout)
    };
    let angles = rig.base_angles_rad();
    Plant::new(&parameters, angles, rig.base_rates_rad_s(), &[]).unwrap()
}

/// Advances by a time, s, in steps of a length, s.
pub fn advance(
    plant: &mut Plant,
    force_n: [f64; 2],
    currents_a: [f64; 4],
    time_s: f64,
    step_s: f64,
) {
    for _ in 0..libm::round(time_s / step_s) as u32 {
        assert_eq!(plant.step(force_n, currents_a, step_s), Outcome::Moved);
    }
}

/// The greatest difference between joint angles, rad.
pub fn apart_rad(plant: &Plant, rig: &Rig) -> f64 {
    let pairs = plant
        .joint_angles_rad()
        .into_iter()
        .zip(rig.joint_angles_rad());
    pairs.fold(0.0, |most, (one, other)| {
        f64::max(most, (one - other).abs())
    })
}

/// How many cases a campaign has: `RIGPROOF_CAMPAIGN`, or what a test has time for.
pub fn campaign(usually: usize) -> usize {
    let asked = std::env::var("RIGPROOF_CAMPAIGN");
    asked.map_or(usually, |size| size.parse().unwrap())
}

/// Numbers from a seed.
pub struct Draw(Pcg64Mcg);

impl Draw {
    pub fn new(seed: u64) -> Draw {
        Draw(Pcg64Mcg::seed_from_u64(seed))
    }

    pub fn between(&mut self, least: f64, greatest: f64) -> f64 {
        let part = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        least + (greatest - least) * part
    }

    pub fn one_in(&mut self, many: u64) -> bool {
        self.0.next_u64().is_multiple_of(many)
    }

    /// Arms of a layout, or any.
    pub fn arms(&mut self, kind: usize) -> Arms {
        match kind % 3 {
            0 => rigproof_spec::geometry::arms(Layout::ThreeBrake),
            1 => rigproof_spec::geometry::arms(Layout::FourBrake),
            _ => Arms {
                l_ae_m: self.between(0.07, 1.9),
                l_ed_m: self.between(0.07, 1.9),
                l_bc_m: self.between(0.07, 1.9),
                l_cd_m: self.between(0.07, 1.9),
                l_ab_m: self.between(0.01, 0.9),
            },
        }
    }

    /// Any masses.
    pub fn inertia(&mut self) -> Inertia {
        let mut arm = || ArmInertia {
            mass_kg: self.between(0.3, 4.7),
            inertia_kg_m2: self.between(0.013, 0.071),
            centre_m: self.between(-0.11, 0.31),
        };
        let (ae, ed, bc, cd) = (arm(), arm(), arm(), arm());
        Inertia {
            ae,
            ed,
            bc,
            cd,
            payload_kg: self.between(0.07, 1.3),
        }
    }
}
