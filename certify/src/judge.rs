//! This file holds every sample of a controller to the laws, by what was sensed and by what it commanded.

mod behaviour;
mod reference;
mod seen;

use rigproof_impl::plant::Plant;
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{
    Margin, braked_joints, current_limit, dissipation, power_balance, undefined_input,
};
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::controller::Task;
use crate::coverage::{Cell, Covered};
use crate::declared::Declared;
use crate::differential::tie::Ties;
use crate::law::{Fared, LAWS, Law};
use crate::way::Way;
use behaviour::Behaviour;
use reference::Reference;
pub(crate) use seen::Seen;

/// Samples of a fault over which the last command may still hold (decision 0124).
pub const MOST_HELD: u32 = 2;
/// Energy that the plant's step of 1 ms may make or lose beside what the brakes take, J (decision 0124).
pub const ENERGY_SLACK_J: f64 = 1e-3;

/// What judges one trial.
pub struct Judge {
    layout: Layout,
    behaviour: Behaviour,
    reference: Option<Reference>,
    seen: Seen,
    /// How every law fared, in the order of [`Law::ALL`].
    pub fared: [Fared; LAWS],
    /// Where their premises were met.
    pub covered: Covered,
    /// The last command before a fault, A.
    held_a: [f64; 4],
    /// Samples since the fault began.
    faulty: u32,
    /// Whether it has let go on a fault and not acted since: when it comes back is its own affair.
    has_let_go: bool,
    work_j: f64,
    start_j: Option<f64>,
}

impl Judge {
    /// A judge of a controller that promises so much, on a rig, at a task; the rig's energy at the start, J, or `None` where the plant has
    /// springs or drives of its own, so that its energy is not told by its motion.
    pub fn new(
        settings: &Settings,
        declared: &Declared,
        task: &Task,
        start_j: Option<f64>,
    ) -> Option<Judge> {
        let (layout, way) = (settings.layout, Way::new(task)?);
        let reference = declared.reference.as_ref();
        Some(Judge {
            reference: reference.and_then(|claim| Reference::new(claim, layout, task)),
            layout: settings.layout,
            behaviour: Behaviour::new(settings.layout, declared, way),
            seen: Seen::new(settings)?,
            fared: [Fared::default(); LAWS],
            covered: Covered::default(),
            held_a: [0.0; 4],
            faulty: 0,
            has_let_go: false,
            work_j: 0.0,
            start_j,
        })
    }

    /// The samples that were ties beside the reference.
    pub fn ties(&self) -> Ties {
        let own = self.reference.as_ref().map(|reference| reference.ties);
        own.unwrap_or_default()
    }

    /// How a law fared.
    fn of(&mut self, law: Law) -> &mut Fared {
        #[expect(
            clippy::indexing_slicing,
            reason = "a law's number is below their count"
        )]
        &mut self.fared[law as usize]
    }

    /// Counts a sample of a law whose premise is met.
    pub fn add(&mut self, law: Law, tick: u32, margin: Margin) {
        self.add_if(law, tick, margin, true);
    }

    /// Counts a sample of a law, and where it lies if the law's premise is met in it.
    fn add_if(&mut self, law: Law, tick: u32, margin: Margin, is_met: bool) {
        self.of(law).add(tick, margin);
        self.covered.judged(law, margin, is_met);
    }

    /// The next sample lies in this cell.
    pub fn at(&mut self, cell: Cell) {
        self.covered.next(cell);
    }

    /// Judges the currents, A, of a sample that is faulty or not.
    pub fn command(
        &mut self,
        tick: u32,
        sensed: &Sensed<f64>,
        is_faulty: bool,
        currents_a: [f64; 4],
    ) {
        let command = named(self.layout, currents_a);
        let limit = |margin: Margin, current_a: f64| margin.and(current_limit(current_a));
        let within = currents_a.into_iter().fold(Margin(f64::MAX), limit);
        self.add(Law::CurrentLimit, tick, within);
        let layout = self.layout;
        let has_bare = layout.brakes().len() < Joint::ALL.len();
        let of_joints = braked_joints(layout, &command);
        self.add_if(Law::BrakedJoints, tick, of_joints, has_bare);
        if let Some((margin, is_met)) = self.behaviour.count(&command) {
            self.add_if(Law::BrakeCount, tick, margin, is_met);
        }
        if is_faulty {
            self.faulty += 1;
            let is_held = currents_a.map(f64::to_bits) == self.held_a.map(f64::to_bits);
            let margin = if is_held && self.faulty <= MOST_HELD {
                Margin(0.0)
            } else {
                // Whatever such a sample says counts as undefined.
                undefined_input(&[f64::NAN], &command)
            };
            self.add(Law::Safe, tick, margin);
            self.seen.forget();
            self.has_let_go = true;
            return;
        }
        self.has_let_go &= currents_a == [0.0; 4];
        (self.faulty, self.held_a) = (0, currents_a);
        if let Some((situation, told)) = self.seen.update(sensed) {
            if !self.has_let_go
                && let Some(reference) = &mut self.reference
                && let Some(margin) = reference.margin(tick, &told, currents_a)
            {
                self.add(Law::Reference, tick, margin);
            }
            let (fared, covered) = (&mut self.fared, &mut self.covered);
            let judged = |law: Law, margin: Margin, is_met: bool| {
                #[expect(
                    clippy::indexing_slicing,
                    reason = "a law's number is below their count"
                )]
                fared[law as usize].add(tick, margin);
                covered.judged(law, margin, is_met);
            };
            self.behaviour.judge(&situation, &command, judged);
        }
    }

    /// Judges a step of the plant under a force, N, from where the tip was, m.
    pub fn step(&mut self, tick: u32, plant: &Plant, force_n: [f64; 2], from_m: Vector<f64>) {
        let brakes = plant.brake_torques_nm().into_iter();
        let each = brakes.zip(plant.joint_rates_rad_s());
        let none = (Margin(f64::MAX), false);
        let (taken, is_turning) =
            each.fold(none, |(margin, is_turning), (torque_nm, rate_rad_s)| {
                let turns = torque_nm * rate_rad_s != 0.0;
                let margin = margin.and(dissipation(torque_nm, rate_rad_s));
                (margin, is_turning || turns)
            });
        self.add_if(Law::Dissipation, tick, taken, is_turning);
        let Some(start_j) = self.start_j else { return };
        self.work_j += Vector::from(force_n).dot(plant.tip_m() - from_m);
        let stored_j = plant.kinetic_energy_j() - start_j;
        // What is missing was braked away; what is too much came from nowhere.
        let braked_j = (self.work_j - stored_j).max(0.0);
        let margin = power_balance(self.work_j, stored_j, braked_j, ENERGY_SLACK_J);
        self.add(Law::Passivity, tick, margin);
    }
}

/// Currents with a reason that can be seen in them: a lock where every brake has its greatest current.
fn named(layout: Layout, currents_a: [f64; 4]) -> Command {
    let brakes = layout.brakes();
    let each = Joint::ALL.into_iter().zip(currents_a);
    let full = each
        .filter(|(joint, _)| brakes.contains(joint))
        .all(|(_, current_a)| current_a >= GREATEST_CURRENT_A);
    let reason = if full {
        Reason::LockedPushedAway
    } else {
        Reason::NothingToDo
    };
    Command { currents_a, reason }
}
