//! This file says what the thesis claims of each display on each task, and whether the runs bear it out.

use rigproof_spec::displays::OSAKA_TRACK_M;
use rigproof_spec::layout::Layout;

use super::freedom::freedom;
use super::shown::{DISSIPATIVE, Shown};
use super::tasks::Task;
use super::trials::{Measured, of};
use crate::finding::with_unit;
use crate::{Error, Finding};

/// Share of what the body alone would do that counts as free: more than half in every direction.
const FREE: f64 = 0.5;

/// What the text says of a display on a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Said {
    /// Where.
    pub place: &'static str,
    /// In its words.
    pub words: &'static str,
}

/// What the text says of a display on a task.
pub const fn said(shown: Shown, task: Task) -> Said {
    let (place, words) = match (shown, task) {
        (Shown::Scooter, Task::Free) => (
            "§1.1",
            "steerable devices are incapable of true free motion",
        ),
        (Shown::Scooter, Task::Wall) => (
            "§1.1",
            "steerable devices do a poor job of simulating walls",
        ),
        (Shown::Scooter, Task::Line) => ("§1.1", "steerable devices follow paths nearly perfectly"),
        (Shown::Padyc, Task::Free) => {
            ("§2.2.1", "free mode allows unconstrained motion of the tip")
        }
        (Shown::Padyc, Task::Wall) => ("§2.2.1", "region mode restricts motion to a region"),
        (Shown::Padyc, Task::Line) => {
            ("§2.2.1", "trajectory mode constrains the user along a path")
        }
        (Shown::Osaka, Task::Line) => (
            "§2.2.1",
            "it alternates its brakes inside a track along the wall's edge",
        ),
        (Shown::Osaka, Task::Wall) => ("§2.2.1", "it simulates a wall by locking both actuators"),
        (Shown::Pter | Shown::Reed(_), Task::Wall) => {
            ("§1.1", "dissipative displays excel at walls")
        }
        (Shown::Pter | Shown::Reed(_), Task::Line) => (
            "§1.1",
            "the challenge in dissipative displays lies in path following",
        ),
        (Shown::Osaka | Shown::Pter | Shown::Reed(_), Task::Free) => (
            "§1.1",
            "with nothing actuated a dissipative display moves freely",
        ),
    };
    Said { place, words }
}

/// A statement of the text on a display and a task, beside the runs.
///
/// Free motion is judged by pushes in every direction, a wall by its greatest depth beside the other class, a line by the mean
/// distance beside the other class; what the text says of one display alone is judged by that.
pub fn judged(shown: Shown, task: Task) -> Result<Finding, Error> {
    let Said { place, words } = said(shown, task);
    let statement = format!("{}, {}", shown.name(), task.name());
    let (ours, because) = match task {
        Task::Free => free(shown)?,
        Task::Wall => wall(shown)?,
        Task::Line => line(shown)?,
    };
    let finding = Finding::claim(place, statement, words, ours, because);
    Ok(match finding.is_unaccounted() {
        true => finding.accounted(account(shown)),
        false => finding,
    })
}

/// The gap that a disagreement comes from: the display's figures, which the text does not give.
const fn account(shown: Shown) -> &'static str {
    match shown {
        Shown::Scooter => "scooter-figures",
        Shown::Padyc => "padyc-speeds",
        Shown::Osaka => "osaka-brakes",
        Shown::Pter => "pter-clutches",
        Shown::Reed(_) => "displays-tasks",
    }
}

type Judged = ((String, bool), String);

fn free(shown: Shown) -> Result<Judged, Error> {
    let [least, greatest] = freedom(shown)?;
    let text = format!(
        "it follows a push of 6 N by {:.0} to {:.0} % of what its body alone would, by direction",
        100.0 * least,
        100.0 * greatest
    );
    let holds = match shown {
        Shown::Scooter => least < FREE,
        _ => least > FREE,
    };
    let because = "free is more than half in every direction, from rest, in 0.1 s".to_owned();
    Ok(((text, holds), because))
}

fn wall(shown: Shown) -> Result<Judged, Error> {
    let depth = |shown: Shown| Ok::<f64, Error>(of(shown, Task::Wall)?.median(|m| m.greatest_m));
    let own_m = depth(shown)?;
    let text = format!("greatest depth {}", with_unit(1e3 * own_m, "mm"));
    let scooter_m = depth(Shown::Scooter)?;
    Ok(match shown {
        Shown::Padyc => (
            (text, own_m < 1e-3),
            "a region that the tip leaves by less than 1 mm".to_owned(),
        ),
        Shown::Scooter => {
            let mut worst_m = 0.0_f64;
            for other in DISSIPATIVE {
                worst_m = worst_m.max(depth(other)?);
            }
            let because = format!(
                "deeper than the worst dissipative display, {}",
                with_unit(1e3 * worst_m, "mm")
            );
            ((text, own_m > worst_m), because)
        }
        _ => {
            let because = format!(
                "less deep than the steerable display, {}",
                with_unit(1e3 * scooter_m, "mm")
            );
            ((text, own_m < scooter_m), because)
        }
    })
}

fn line(shown: Shown) -> Result<Judged, Error> {
    let error = |shown: Shown| Ok::<f64, Error>(of(shown, Task::Line)?.median(|m| m.error_m));
    let own = of(shown, Task::Line)?;
    let own_m = own.median(|m| m.error_m);
    let text = format!("mean distance {}", with_unit(1e3 * own_m, "mm"));
    Ok(match shown {
        Shown::Osaka => {
            let greatest = |m: &Measured| m.greatest_m;
            let greatest_m = own.median(greatest);
            let text = format!("{text}, greatest {}", with_unit(1e3 * greatest_m, "mm"));
            let because = format!(
                "the tip stays in the track of {} on either side",
                with_unit(1e3 * OSAKA_TRACK_M, "mm")
            );
            ((text, greatest_m < OSAKA_TRACK_M), because)
        }
        Shown::Scooter | Shown::Padyc => {
            let mut best_m = f64::INFINITY;
            for other in DISSIPATIVE {
                best_m = best_m.min(error(other)?);
            }
            let because = format!(
                "nearer than the best dissipative display, {}",
                with_unit(1e3 * best_m, "mm")
            );
            ((text, own_m < best_m), because)
        }
        Shown::Pter | Shown::Reed(Layout::ThreeBrake | Layout::FourBrake) => {
            let steered_m = error(Shown::Scooter)?;
            let because = format!(
                "farther than the steerable display, {}",
                with_unit(1e3 * steered_m, "mm")
            );
            ((text, own_m > steered_m), because)
        }
    })
}
