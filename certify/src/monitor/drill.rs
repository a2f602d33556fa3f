//! This file runs the rig in use with its monitor beside it, and changes one thing of the rig on the way.

use rigproof_impl::monitor::constants::Constants;
use rigproof_impl::monitor::{Alarm, Monitor};
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::controller::Source;
use crate::hand::Pushing;
use crate::left_out::{self, Amplifiers, LeftOut};
use crate::scenario::Scenario;
use crate::trial::{is_stretched, sensors::Sensors};
use crate::way::{Way, reversed};

/// Rate of a joint from which its motion says something of what resists, rad/s.
const MOVES_RAD_S: f64 = 0.03;

/// What changes on the way, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Concealed {
    /// The mechanism that comes to those of the scenario.
    pub effect: LeftOut,
    /// The sample from which on the rig is another.
    pub from_tick: u32,
    /// Whether it only acts where current makes torque.
    pub is_driven: bool,
}

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilled {
    /// Samples.
    pub ticks: u32,
    /// The alarm and its sample.
    pub alarm: Option<(Alarm, u32)>,
    /// Samples after the change in which the joint moved and what changed acted.
    pub excited: u32,
    /// How many of them before the alarm, if there was one.
    pub excited_at_alarm: u32,
}

/// Samples of excitation in which a change is to be found: 2 s.
pub const IN_TICKS: u32 = 2000;
/// Samples after which a change that was not excited so long is given up: a minute.
const LONGEST_TICKS: u32 = 60_000;

impl Drilled {
    /// Whether the change was found within [`IN_TICKS`]; `None` where it was not excited so long, or an alarm came before it or because
    /// the tip or the hand left what was covered.
    pub fn is_found(&self, concealed: &Concealed) -> Option<bool> {
        let is_other = self
            .alarm
            .is_some_and(|(alarm, tick)| tick < concealed.from_tick || is_of_coverage(alarm));
        (!is_other && self.excited >= IN_TICKS).then_some(self.alarm.is_some())
    }
}

/// Whether an alarm says that the tip or the hand is where no trial was.
pub fn is_of_coverage(alarm: Alarm) -> bool {
    matches!(
        alarm,
        Alarm::Place | Alarm::Speed | Alarm::Force | Alarm::Cell
    )
}

/// Runs a scenario until an alarm or its end; `None` where it is none, or where what changes is no change of its plant.
pub fn run(
    scenario: &Scenario,
    source: &dyn Source,
    of: &Constants,
    concealed: Option<&Concealed>,
    mut look: impl FnMut(&Monitor),
) -> Option<Drilled> {
    let settings = scenario.settings();
    let ways = [
        Way::new(&scenario.task)?,
        Way::new(&reversed(&scenario.task))?,
    ];
    let mut plant = scenario.begun()?;
    let mut hand = Pushing::new(&scenario.hand, &scenario.task)?;
    let mut sensors = Sensors::new(scenario);
    let mut amplifiers = Amplifiers::new(&scenario.left_out, SAMPLE_STEP_S);
    let mut controller = source.begin(&settings, &scenario.task).ok()?;
    let mut monitor = Monitor::new(&settings, of)?;
    let (mut last_a, mut is_back, mut has_left) = ([0.0; 4], false, false);
    let mut drilled = Drilled {
        ticks: 0,
        alarm: None,
        excited: 0,
        excited_at_alarm: 0,
    };
    for tick in 0..scenario.ticks {
        if let Some(change) = concealed.filter(|own| own.from_tick == tick) {
            plant = changed(scenario, &plant, &change.effect)?;
        }
        let force_n = hand.push(&plant, last_a, is_back);
        let (sensed, _) = sensors.read(tick, &plant, force_n);
        let commanded_a = controller.tick(&sensed).ok()?;
        let watched = monitor.watch(&sensed, commanded_a);
        look(&monitor);
        drilled.ticks = tick + 1;
        if let Some(change) = concealed.filter(|own| own.from_tick <= tick) {
            drilled.excited += u32::from(acts(&plant, change));
        }
        if drilled.alarm.is_none() {
            drilled.alarm = watched.alarm.map(|alarm| (alarm, tick));
            drilled.excited_at_alarm = drilled.excited;
        }
        // Whatever the alarm says, a change is run on for as long as it was to be found in: then all of them count.
        let is_over = concealed.map_or(drilled.alarm.is_some(), |change| {
            drilled.excited >= IN_TICKS || tick > change.from_tick + LONGEST_TICKS
        });
        if is_over {
            break;
        }
        // The hand turns round at either end, for as long as the trial lasts.
        let [there, back] = &ways;
        let is_at_end = if is_back { back } else { there }.has_ended(plant.tip_m());
        is_back ^= is_at_end & has_left;
        has_left |= !is_at_end;
        last_a = drilled.alarm.map_or(watched.currents_a, |_| commanded_a);
        let outcome = plant.step(force_n, amplifiers.given(last_a), SAMPLE_STEP_S);
        if outcome != Outcome::Moved || is_stretched(&plant) {
            break;
        }
    }
    Some(drilled)
}

/// The plant where it is, with one more thing left out.
fn changed(scenario: &Scenario, plant: &Plant, effect: &LeftOut) -> Option<Plant> {
    let mut left_out = scenario.left_out.clone();
    left_out.push(effect.clone());
    let mut parameters: Parameters = scenario.parameters();
    left_out::change(&mut parameters, &left_out)?;
    plant.changed(&parameters, &left_out::asked(&left_out))
}

/// Whether the joint moves, and current makes as much torque there as there is without, where only that has changed.
fn acts(plant: &Plant, change: &Concealed) -> bool {
    let joint = change.effect.joint.unwrap_or(Joint::A) as usize;
    let of = |all: [f64; 4]| all.get(joint).copied().unwrap_or(0.0);
    let off_nm = plant.off_state_nm();
    let is_driven = of(plant.yield_torques_nm()) >= 2.0 * of(off_nm);
    of(plant.joint_rates_rad_s()).abs() >= MOVES_RAD_S && (is_driven || !change.is_driven)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::built_in::BuiltIn;
    use crate::monitor::constants;
    use crate::plan::{Plan, Subject};
    use crate::scenario::Rig;
    use rigproof_spec::methods::Method;

    #[test]
    fn a_payload_of_the_certificate_is_no_friction() {
        let plan = Plan::alone(
            "payload",
            Subject::built_in(BuiltIn::of(Method::ProportionalLow)),
            vec![Rig::FourBrake],
        );
        let of = constants(&plan, Rig::FourBrake).unwrap();
        let source = plan.controller.source().unwrap();
        // Nearly empty and nearly full; without the payload as a number friction at B came to 5.0 and 4.2 standard deviations.
        for index in [114, 22] {
            let scenario = Scenario {
                ticks: 90_000,
                faults: Vec::new(),
                ..plan.scenario(index)
            };
            let mut greatest = 0.0_f64;
            let ran = run(&scenario, source, &of, None, |monitor| {
                let ends = of.low.iter().zip(&of.high);
                for (number, (low, high)) in monitor.estimate().numbers().iter().zip(ends) {
                    greatest = greatest.max(number.beyond_squared(*low, *high));
                }
            });
            assert_eq!(ran.map(|own| own.ticks), Some(90_000));
            assert!(greatest < 9.0, "{index}: {}", greatest.sqrt());
        }
    }
}
