//! This file is a scenario: rig, task, start, hand, plant and sensors of one trial, all of it written out.

mod draw;
mod faults;
mod tasks;

use rigproof_impl::plant::{Parameters, Plant};
use rigproof_impl::tick::Settings;
use rigproof_spec::layout::Layout;
use serde::{Deserialize, Serialize};

use crate::controller::Task;
use crate::hand::Hand;
use crate::left_out::{self, LeftOut};

pub use draw::Draw;
pub use faults::{Fault, FaultKind};

/// A layout of the rig.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rig {
    /// Brakes at A, E and B.
    ThreeBrake,
    /// Brakes at A, E, B and C.
    FourBrake,
}

impl Rig {
    /// The thesis's layout.
    pub const fn layout(self) -> Layout {
        match self {
            Rig::ThreeBrake => Layout::ThreeBrake,
            Rig::FourBrake => Layout::FourBrake,
        }
    }
}

/// One trial before it is run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The layout.
    pub rig: Rig,
    /// The path.
    pub task: Task,
    /// θA and θB at the start, rad.
    pub theta_rad: [f64; 2],
    /// Their rates at the start, rad/s.
    pub rates_rad_s: [f64; 2],
    /// Who pushes.
    pub hand: Hand,
    /// In what the plant differs from the tables.
    pub plant: PlantChange,
    /// What the plant has beyond the thesis's, from a calibration.
    pub left_out: Vec<LeftOut>,
    /// What the encoders read at angle zero.
    pub zero_counts: [i32; 2],
    /// The number of the first sample.
    pub first_number: u32,
    /// What goes wrong with the sensors, in the order of time.
    pub faults: Vec<Fault>,
    /// Samples of the trial.
    pub ticks: u32,
}

/// Shares by which a plant differs from its tables (decision 0125); 0 is the thesis's rig.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlantChange {
    /// Of the torque of the brakes A, E, B, C, with and without current.
    pub torque: [f64; 4],
    /// Of their time constants.
    pub time_constant: [f64; 4],
    /// Of the width of their backlash.
    pub backlash: [f64; 4],
    /// Of the masses and inertias of the arms AE, ED, BC, CD.
    pub inertia: [f64; 4],
    /// A mass at the tip, kg.
    pub payload_kg: f64,
}

/// Greatest share by which the torque of a brake is drawn to differ (decision 0125).
pub const TORQUE_SHARE: f64 = 0.1;
/// The same of its time constants.
pub const TIME_CONSTANT_SHARE: f64 = 0.2;
/// The same of the width of its backlash.
pub const BACKLASH_SHARE: f64 = 0.3;
/// The same of the masses and inertias of the arms.
pub const INERTIA_SHARE: f64 = 0.1;
/// Greatest mass at the tip that is drawn, kg.
pub const GREATEST_PAYLOAD_KG: f64 = 0.5;

impl Scenario {
    /// What the controller is told of the rig.
    pub fn settings(&self) -> Settings {
        Settings {
            zero_counts: self.zero_counts,
            ..Settings::thesis(self.rig.layout())
        }
    }

    /// The plant at its start; `None` where it is none.
    pub fn begun(&self) -> Option<Plant> {
        let mut parameters = self.parameters();
        left_out::change(&mut parameters, &self.left_out)?;
        Plant::new(
            &parameters,
            self.theta_rad,
            self.rates_rad_s,
            &left_out::asked(&self.left_out),
        )
    }

    /// Whether nothing in the plant stores energy but its masses, and nothing gives any.
    pub fn is_passive(&self) -> bool {
        self.left_out.iter().all(LeftOut::is_passive)
    }

    /// What the plant is made of, but for what a calibration left out.
    pub fn parameters(&self) -> Parameters {
        let mut parameters = Parameters::of(self.rig.layout());
        let change = &self.plant;
        let shares = change
            .torque
            .iter()
            .zip(&change.time_constant)
            .zip(&change.backlash);
        for (brake, ((torque, time_constant), backlash)) in parameters.brakes.iter_mut().zip(shares)
        {
            let Some(table) = brake else { continue };
            left_out::scale_torque(table, 1.0 + torque);
            for fit in [&mut table.rising, &mut table.falling] {
                for a in [
                    &mut fit.a_avg_s,
                    &mut fit.a_1,
                    &mut fit.a_2,
                    &mut fit.a_3,
                    &mut fit.a_4,
                    &mut fit.a_5,
                    &mut fit.a_6,
                ] {
                    *a *= 1.0 + time_constant;
                }
            }
            table.backlash_width_deg *= 1.0 + backlash;
        }
        let inertia = &mut parameters.inertia;
        inertia.payload_kg += change.payload_kg;
        let arms = [
            &mut inertia.ae,
            &mut inertia.ed,
            &mut inertia.bc,
            &mut inertia.cd,
        ];
        for (arm, share) in arms.into_iter().zip(change.inertia) {
            arm.mass_kg *= 1.0 + share;
            arm.inertia_kg_m2 *= 1.0 + share;
        }
        parameters
    }

    /// The scenario of an index: the same for a seed, whatever else is drawn.
    pub fn drawn(seed: u64, index: u64, rigs: &[Rig], ticks: u32) -> Scenario {
        let mut draw = Draw::new(seed, index);
        loop {
            let rig = draw.pick(rigs).unwrap_or(Rig::FourBrake);
            if let Some(scenario) = Scenario::tried(&mut draw, rig, ticks) {
                return scenario;
            }
        }
    }

    /// A scenario, where its path lies in the workspace.
    fn tried(draw: &mut Draw, rig: Rig, ticks: u32) -> Option<Scenario> {
        let task = tasks::task(draw);
        let theta_rad = tasks::start(draw, rig.layout(), &task)?;
        let share =
            |draw: &mut Draw, greatest: f64| [0; 4].map(|_| draw.between(-greatest, greatest));
        let plant = if draw.one_in(4) {
            PlantChange::default()
        } else {
            PlantChange {
                torque: share(draw, TORQUE_SHARE),
                time_constant: share(draw, TIME_CONSTANT_SHARE),
                backlash: share(draw, BACKLASH_SHARE),
                inertia: share(draw, INERTIA_SHARE),
                payload_kg: draw.between(0.0, GREATEST_PAYLOAD_KG),
            }
        };
        let zero = |draw: &mut Draw| draw.whole(-40_000, 40_000);
        Some(Scenario {
            rig,
            task,
            theta_rad,
            rates_rad_s: [0.0; 2],
            hand: Hand::drawn(draw),
            plant,
            left_out: Vec::new(),
            zero_counts: [zero(draw), zero(draw)],
            first_number: if draw.one_in(8) {
                // The counter passes its greatest number within the trial.
                u32::MAX - draw.below(ticks.max(1))
            } else {
                draw.below(1 << 30)
            },
            faults: faults::drawn(draw, ticks),
            ticks,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: [Rig; 2] = [Rig::ThreeBrake, Rig::FourBrake];

    #[test]
    fn a_scenario_is_the_same_for_a_seed_and_reads_back_bit_for_bit() {
        for index in 0..200 {
            let scenario = Scenario::drawn(41, index, &BOTH, 3000);
            assert_eq!(scenario, Scenario::drawn(41, index, &BOTH, 3000));
            let text = serde_json::to_string(&scenario).unwrap();
            assert_eq!(serde_json::from_str::<Scenario>(&text).unwrap(), scenario);
            assert_ne!(scenario, Scenario::drawn(41, index + 1, &BOTH, 3000));
            assert_ne!(scenario, Scenario::drawn(42, index, &BOTH, 3000));
        }
    }

    #[test]
    fn every_kind_of_everything_is_drawn() {
        let all: Vec<Scenario> = (0..400)
            .map(|index| Scenario::drawn(7, index, &BOTH, 10_000))
            .collect();
        let count = |is: &dyn Fn(&Scenario) -> bool| all.iter().filter(|s| is(s)).count();
        assert!(count(&|s| s.rig == Rig::ThreeBrake) > 100);
        assert!(count(&|s| matches!(&s.task, Task::Chain(points) if points.len() == 2)) > 60);
        assert!(count(&|s| matches!(&s.task, Task::Chain(points) if points.len() > 2)) > 30);
        assert!(count(&|s| matches!(s.task, Task::Arc { .. })) > 40);
        assert!(count(&|s| matches!(s.task, Task::Spline(_))) > 20);
        assert!(count(&|s| s.faults.is_empty()) > 60);
        assert!(count(&|s| s.first_number > u32::MAX - 10_001) > 20);
        for kind in FaultKind::EXAMPLES {
            let is = |s: &Scenario| {
                s.faults.iter().any(|fault| {
                    core::mem::discriminant(&fault.kind) == core::mem::discriminant(&kind)
                })
            };
            assert!(count(&is) > 20, "{kind:?}");
        }
    }

    #[test]
    fn a_changed_plant_is_one_that_can_be() {
        for index in 0..100 {
            let scenario = Scenario::drawn(3, index, &BOTH, 1000);
            let plant = scenario.begun();
            assert!(plant.is_some(), "{index}");
        }
    }
}
