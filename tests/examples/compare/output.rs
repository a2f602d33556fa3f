//! This file says how runs are written down for the programs that compare them.

use std::fs;
use std::path::PathBuf;

use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::{ArmInertia, inertia};
use serde_json::{Value, json};

use crate::case::{Case, TICK_S};
use crate::timing::Cost;

/// The rig at the start of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// θA and θB, rad.
    pub base_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The tip, m.
    pub tip_m: [f64; 2],
}

/// Greatest distance between the tips of two runs, m.
pub fn apart_m(one: &[Sample], other: &[Sample]) -> f64 {
    one.iter().zip(other).fold(0.0, |most: f64, (a, b)| {
        let ([a_x, a_y], [b_x, b_y]) = (a.tip_m, b.tip_m);
        most.max(libm::hypot(a_x - b_x, a_y - b_y))
    })
}

/// One of our engines on one case: what it is, what a step costs, and the file with its run.
pub struct Engine {
    /// What ran.
    pub engine: &'static str,
    /// With which settings.
    pub settings: String,
    /// What a step costs.
    pub cost: Cost,
    /// The file with the run; none where only the cost is of interest.
    pub run: Option<String>,
}

/// One case: all that another engine needs, and our engines.
pub struct Entry(Value);

impl Entry {
    /// The entry of a case, with how far its converged solution is from a finer one, m.
    pub fn new(case: &Case, apart_m: f64, engines: &[Engine]) -> Entry {
        let (arms, inertia) = (arms(case.layout), inertia(case.layout));
        let arm = |length_m: f64, of: ArmInertia| json!({ "length_m": length_m, "mass_kg": of.mass_kg, "inertia_kg_m2": of.inertia_kg_m2, "centre_m": of.centre_m });
        let start = case.start();
        let engines: Vec<Value> = engines.iter().map(engine).collect();
        Entry(json!({
            "name": case.name(),
            "step_s": TICK_S,
            "base_m": arms.l_ab_m,
            "arms": {
                "AE": arm(arms.l_ae_m, inertia.ae),
                "ED": arm(arms.l_ed_m, inertia.ed),
                "BC": arm(arms.l_bc_m, inertia.bc),
                "CD": arm(arms.l_cd_m, inertia.cd),
            },
            "start_rad": [start.theta_a_rad, start.theta_e_rad, start.theta_b_rad, start.theta_c_rad],
            "friction_nm": case.friction_nm(),
            "converged_apart_m": apart_m,
            "engines": engines,
        }))
    }
}

fn engine(engine: &Engine) -> Value {
    json!({
        "engine": engine.engine,
        "settings": engine.settings,
        "median_ns": engine.cost.median_ns,
        "least_ns": engine.cost.least_ns,
        "run": engine.run,
    })
}

/// The folder that is written to.
pub struct Folder(PathBuf);

impl Folder {
    /// The folder, made if it is not there.
    pub fn new(path: PathBuf) -> Folder {
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    /// Writes a run as CSV, a line a tick and one for the end: the force holds from its line on.
    pub fn write_run(&self, name: &str, case: &Case, run: &[Sample]) -> String {
        let file = format!("{name}.csv");
        let mut csv = csv::Writer::from_path(self.0.join(&file)).unwrap();
        csv.write_record([
            "time_s",
            "force_x_n",
            "force_y_n",
            "theta_a_rad",
            "theta_b_rad",
            "rate_a_rad_s",
            "rate_b_rad_s",
            "tip_x_m",
            "tip_y_m",
        ])
        .unwrap();
        for (tick, sample) in run.iter().enumerate() {
            let [force_x, force_y] = case.force_n(tick);
            let ([a, b], [rate_a, rate_b], [x, y]) =
                (sample.base_rad, sample.rates_rad_s, sample.tip_m);
            let time_s = tick as f64 * TICK_S;
            let row = [time_s, force_x, force_y, a, b, rate_a, rate_b, x, y];
            csv.write_record(row.map(|value| format!("{value:e}")))
                .unwrap();
        }
        csv.flush().unwrap();
        file
    }

    /// Writes what the folder holds.
    pub fn write_index(&self, entries: Vec<Entry>) {
        let entries: Vec<Value> = entries.into_iter().map(|Entry(value)| value).collect();
        let text = serde_json::to_string_pretty(&entries).unwrap();
        fs::write(self.0.join("runs.json"), text).unwrap();
    }
}
