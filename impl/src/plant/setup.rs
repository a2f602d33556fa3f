//! This file says what a plant is made of and puts it together.

use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{ArmInertia, Inertia, inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::{BrakeTable, GREATEST_CURRENT_A, brake_table};

use super::Plant;
use super::brake::{Brake, Characteristic};
use super::effect::{Asked, Effect, Law, MOST_EFFECTS};
use super::friction::Contact;
use super::motion::{Mechanism, Motion, Scheme};
use crate::linkage::Linkage;
use crate::vector::Vector;

/// What a plant is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// The arm lengths.
    pub arms: Arms,
    /// Masses, inertias, centres of mass and payload.
    pub inertia: Inertia,
    /// The brakes of A, E, B, C.
    pub brakes: [Option<BrakeTable>; 4],
    /// Where in a step the forces are looked at.
    pub scheme: Scheme,
}

impl Parameters {
    /// The thesis's rig in one of its layouts: tables 3.1 to 3.3, 4.1 and 5.1.
    pub fn of(layout: Layout) -> Parameters {
        let table = |joint: Joint| layout.brakes().contains(&joint).then(|| brake_table(joint));
        Parameters {
            arms: arms(layout),
            inertia: inertia(layout),
            brakes: Joint::ALL.map(table),
            scheme: Scheme::Midpoint,
        }
    }

    /// Whether these are lengths and masses of a linkage, and brakes that resist.
    fn is_sound(&self) -> bool {
        let Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        } = self.arms;
        let lengths = [l_ae_m, l_ed_m, l_bc_m, l_cd_m];
        let Inertia {
            ae,
            ed,
            bc,
            cd,
            payload_kg,
        } = self.inertia;
        let mass = |arm: ArmInertia| {
            let ArmInertia {
                mass_kg,
                inertia_kg_m2,
                centre_m,
            } = arm;
            mass_kg >= 0.0
                && inertia_kg_m2 > 0.0
                && centre_m.is_finite()
                && mass_kg.is_finite()
                && inertia_kg_m2.is_finite()
        };
        let resists = |table: &BrakeTable| {
            let off_nm = table.torque_gain.off_state_nm();
            let positive = |[least, greatest]: [f64; 2]| {
                least > 0.0 && least <= greatest && greatest.is_finite()
            };
            off_nm >= 0.0
                && off_nm <= table.greatest_nm()
                && table.greatest_nm().is_finite()
                && (0.0..=360.0).contains(&table.backlash_width_deg)
                && positive(table.current_range_a)
                && positive(table.speed_range_rpm)
        };
        lengths
            .into_iter()
            .all(|length| length > 0.0 && length.is_finite())
            && l_ab_m >= 0.0
            && l_ab_m.is_finite()
            && [ae, ed, bc, cd].into_iter().all(mass)
            && payload_kg >= 0.0
            && payload_kg.is_finite()
            && self.brakes.iter().flatten().all(resists)
    }
}

impl Plant {
    /// A plant at θA and θB, rad, turning at rates, rad/s, its brakes without current in the middle of their backlash.
    ///
    /// `None` where the parameters are not those of a linkage, where the linkage cannot be at these angles, and where an effect is
    /// not one of the library's resistance laws or a change of the current of a brake that is there; at most
    /// [`MOST_EFFECTS`] resistance laws.
    pub fn new(
        parameters: &Parameters,
        theta_rad: [f64; 2],
        rates_rad_s: [f64; 2],
        effects: &[Asked<'_>],
    ) -> Option<Plant> {
        if !parameters.is_sound() {
            return None;
        }
        let Parameters {
            arms,
            inertia,
            brakes: tables,
            scheme,
        } = parameters;
        let mechanism = Mechanism::new(arms, inertia, *scheme);
        let motion = Motion::new(&mechanism, theta_rad.into(), rates_rad_s.into())?;
        let elbows = elbows(&motion.linkage);
        let [e, c] = elbows.map(|elbow| libm::atan2(elbow.y, elbow.x));
        // θE is counted from 0 to a whole turn (table 4.2), θC as it is.
        let [theta_a, theta_b] = theta_rad;
        let angles = [theta_a, e + core::f64::consts::TAU, theta_b, c];
        let [a, e, b, c] = angles;
        let [table_a, table_e, table_b, table_c] = tables;
        let brake = |table: &Option<BrakeTable>, joint: Joint, angle_rad: f64| {
            Brake::new(&table.unwrap_or(brake_table(joint)), angle_rad)
        };
        let mut plant = Plant {
            mechanism,
            characteristics: tables.map(|table| Some(Characteristic::new(&table?))),
            greatest_a: tables.map(|table| {
                if table.is_some() {
                    GREATEST_CURRENT_A
                } else {
                    0.0
                }
            }),
            motion,
            brakes: [
                brake(table_a, Joint::A, a),
                brake(table_e, Joint::E, e),
                brake(table_b, Joint::B, b),
                brake(table_c, Joint::C, c),
            ],
            looked_rad: angles,
            elbows,
            since_look_s: 0.0,
            contact: Contact::Rest,
            held: [false; 4],
            torques_nm: [0.0; 4],
            time_s: 0.0,
            paths: None,
            effects: [None; MOST_EFFECTS],
        };
        for effect in effects {
            plant.add(effect)?;
        }
        Some(plant)
    }

    /// This plant where it is, as if it had been made of other parameters and effects from now on: motion, torques and places in the
    /// backlashes stay; effects begin anew. `None` as of [`Plant::new`].
    pub fn changed(&self, parameters: &Parameters, effects: &[Asked<'_>]) -> Option<Plant> {
        let (theta_rad, rates_rad_s) = (self.motion.theta_rad, self.motion.rates_rad_s);
        let other = Plant::new(parameters, theta_rad.into(), rates_rad_s.into(), effects)?;
        Some(Plant {
            mechanism: other.mechanism,
            characteristics: other.characteristics,
            greatest_a: other.greatest_a,
            paths: other.paths,
            effects: other.effects,
            ..*self
        })
    }

    fn add(&mut self, asked: &Asked<'_>) -> Option<()> {
        let Asked {
            joint,
            mechanism,
            parameters,
        } = *asked;
        if let Some(law) = Law::new(mechanism, parameters) {
            let free = self.effects.iter_mut().find(|place| place.is_none())?;
            *free = Some(Effect {
                joint,
                law,
                memory: law.starts_with(),
            });
        } else {
            let index = joint as usize;
            self.characteristics.get(index)?.as_ref()?;
            let paths = self.paths.get_or_insert_default();
            let path = paths.get_mut(index)?;
            *path = path.with(mechanism, parameters)?;
        }
        Some(())
    }
}

/// The directions of ED seen from AE and of CD seen from BC, m².
#[inline]
pub(super) fn elbows(linkage: &Linkage<f64>) -> [Vector<f64>; 2] {
    let seen = |from: Vector<f64>, arm: Vector<f64>| Vector::new(from.dot(arm), from.cross(arm));
    [seen(linkage.ae, linkage.ed), seen(linkage.bc, linkage.cd)]
}
