//! This file makes the page of a diagnosis from what the command line has at hand.

use rigproof_diagnose::plant::{Frame, RESTART_S};
use rigproof_diagnose::{Description, Diagnosis, Measured};
use rigproof_report::chart::rounded;
use rigproof_report::diagnosis::{Diagnosed, page};
use rigproof_report::replay::{Replay, Shape, Way};

/// What a page shows beside the diagnosis.
#[derive(Default)]
pub struct Beside {
    /// The linkage that moves, of a five-bar.
    pub replay: Option<Replay>,
    /// What to do now.
    pub next: Option<String>,
}

/// The page as HTML.
pub fn diagnosis(rig_name: &str, diagnosis: &Diagnosis, beside: Beside) -> String {
    page(Diagnosed {
        rig: rig_name,
        report: &diagnosis.report,
        curves: &diagnosis.curves,
        replay: beside.replay,
        next: beside.next.as_deref(),
    })
}

/// The replay of a recording; nothing where the plant has none, and where nothing was fitted.
pub fn replay(
    rig: &Description,
    diagnosis: &Diagnosis,
    shown: Option<&Measured>,
) -> Option<Replay> {
    diagnosis.report.fit.as_ref()?;
    let own = rig.replay(&diagnosis.calibration, shown?)?;
    let way = |name: &str, role, frames: Vec<Frame>| Way {
        name: name.to_owned(),
        role,
        frames: frames
            .into_iter()
            .map(|frame| Some(frame?.map(|x| rounded(x, 5)).to_vec()))
            .collect(),
    };
    Some(Replay {
        shape: Shape::Linkage,
        time_s: own.time_s.iter().map(|t| rounded(*t, 6)).collect(),
        a: own.point_a_m,
        b: own.point_b_m,
        ways: vec![
            way("recorded", "recorded", own.recorded),
            way("old model", "old", own.before),
            way("new model", "new", own.after),
        ],
        protocol: format!(
            "Every {RESTART_S} s both models are let go from the recorded state and then know nothing but the recorded forces and currents: nothing holds them where the hand did. The old model has the numbers of the rig file, the new one those of the calibration."
        ),
    })
}
