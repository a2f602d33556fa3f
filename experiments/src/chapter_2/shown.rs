//! This file runs each display on each task: the four of chapter 2 by their own control, the two layouts by that of chapter 6.

use rigproof_model::ModelError;
use rigproof_model::control::path::Line;
use rigproof_model::control::{
    Actuation, Controller, GainUnit, Obstacle, Uncontrolled, controller,
};
use rigproof_model::displays::{Aim, Display, Osaka, Padyc, Pter, Scooter, run};
use rigproof_model::operator::{Abilities, Operator};
use rigproof_model::rig::Rig;
use rigproof_model::trial;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::Method;

use super::tasks::{Task, wall};

/// A display that is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    Scooter,
    Padyc,
    Osaka,
    Pter,
    Reed(Layout),
}

/// In the order of figures 2.1 to 2.4, then the thesis's own.
pub const ALL: [Shown; 6] = [
    Shown::Scooter,
    Shown::Padyc,
    Shown::Osaka,
    Shown::Pter,
    Shown::Reed(Layout::ThreeBrake),
    Shown::Reed(Layout::FourBrake),
];

/// The displays whose brakes and clutches only take energy (§1.1).
pub const DISSIPATIVE: [Shown; 4] = [
    Shown::Osaka,
    Shown::Pter,
    Shown::Reed(Layout::ThreeBrake),
    Shown::Reed(Layout::FourBrake),
];

/// What a run leaves behind, whatever ran.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ran {
    pub tips_m: Vec<[f64; 2]>,
    pub forces_n: Vec<[f64; 2]>,
    /// What the display took, J.
    pub taken_j: f64,
    pub arrived: bool,
}

impl Shown {
    /// What the thesis calls it.
    pub const fn name(self) -> &'static str {
        match self {
            Shown::Scooter => "Scooter",
            Shown::Padyc => "PADyC",
            Shown::Osaka => "Osaka's ER display",
            Shown::Pter => "PTER",
            Shown::Reed(Layout::ThreeBrake) => "3-brake",
            Shown::Reed(Layout::FourBrake) => "4-brake",
        }
    }

    /// The display at rest at a point, m; `None` for the layouts, which the rig itself runs.
    pub fn display(self, tip_m: [f64; 2]) -> Result<Option<Display>, ModelError> {
        Ok(Some(match self {
            Shown::Scooter => Scooter::new(0.0).at(tip_m)?,
            Shown::Padyc => Padyc::new().at(tip_m)?,
            Shown::Osaka => Osaka::new().at(tip_m)?,
            Shown::Pter => Pter::new().at(tip_m)?,
            Shown::Reed(_) => return Ok(None),
        }))
    }

    /// One run of a task.
    pub fn run(self, task: Task, seed: u64) -> Result<Ran, ModelError> {
        match (self, self.display(task.start_m())?) {
            (Shown::Reed(layout), _) => of_a_layout(layout, task, seed),
            (_, Some(display)) => of_a_display(display, task, seed),
            (_, None) => Ok(Ran::default()),
        }
    }
}

/// One run of a display by its own control.
pub fn of_a_display(mut display: Display, task: Task, seed: u64) -> Result<Ran, ModelError> {
    let path = task.path()?;
    let (boundary, solid) = wall()?;
    let aim = match task {
        Task::Free => Aim::Free,
        Task::Wall => Aim::Wall(&boundary, solid),
        Task::Line => Aim::Path(&*path),
    };
    let mut hand = Operator::new(task.path()?, Abilities::CAREFUL, seed)?;
    let over = |tip_m| task.is_over(tip_m);
    let ran = run(&mut display, &aim, &mut hand, task.longest_s(), over)?;
    Ok(Ran {
        tips_m: ran.tips_m,
        forces_n: ran.forces_n,
        taken_j: ran.dissipated_j,
        arrived: ran.arrived,
    })
}

/// One run of a layout: nothing, SDOF control on the obstacle's side of the wall (§7.3), SDOF control of the line (§6.2).
fn of_a_layout(layout: Layout, task: Task, seed: u64) -> Result<Ran, ModelError> {
    let mut rig = Rig::new(layout, task.start_m())?;
    let mut hand = Operator::new(task.path()?, Abilities::CAREFUL, seed)?;
    let (boundary, solid) = wall()?;
    let sdof = |path: Line| {
        let actuation = Actuation::thesis(layout);
        controller(Method::Sdof, GainUnit::PerCentimetre, actuation, path)
    };
    let mut control: Box<dyn Controller> = match task {
        Task::Free => Box::new(Uncontrolled),
        Task::Wall => Box::new(Obstacle::new(boundary, solid, sdof(boundary)?)),
        Task::Line => {
            let [from_m, to_m] = [trial::LINES[1].from_m, trial::LINES[1].to_m];
            sdof(Line::through(from_m, to_m)?)?
        }
    };
    let over = |tip_m| task.is_over(tip_m);
    let ran = trial::run(&mut rig, &mut *control, &mut hand, task.longest_s(), over)?;
    Ok(Ran {
        tips_m: ran.tips_m,
        forces_n: ran.forces_n,
        taken_j: rig.dissipated_j(),
        arrived: ran.arrived,
    })
}
