//! This file says how runs are written down for the programs that compare them.

use std::fs;
use std::path::PathBuf;

use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::{ArmInertia, inertia};
use serde_json::{Value, json};

use crate::case::Case;
use crate::engine::Sample;
use crate::timing::Cost;

/// One of our engines on one case: what it is, what a step costs, and the file with its run.
pub struct Ours {
    /// What ran.
    pub engine: &'static str,
    /// With which settings.
    pub settings: &'static str,
    /// Steps a tick.
    pub steps: u32,
    /// What a step costs.
    pub cost: Cost,
    /// The file with its run.
    pub run: String,
}

/// One case: all that another engine needs, and our engines.
pub struct Entry(Value);

impl Entry {
    /// The entry of a case, with how far its converged solution is from a finer one, m.
    pub fn new(case: &Case, apart_m: f64, engines: &[Ours]) -> Entry {
        let (arms, inertia) = (arms(case.layout), inertia(case.layout));
        let arm = |length_m: f64, of: ArmInertia| json!({ "length_m": length_m, "mass_kg": of.mass_kg, "inertia_kg_m2": of.inertia_kg_m2, "centre_m": of.centre_m });
        let start = case.start();
        let engines: Vec<Value> = engines.iter().map(engine).collect();
        Entry(json!({
            "name": case.name(),
            "step_s": case.tick_s(),
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

fn engine(engine: &Ours) -> Value {
    json!({
        "engine": engine.engine,
        "settings": engine.settings,
        "steps_a_tick": engine.steps,
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
        let file = format!("{}-{name}.csv", case.name());
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
        let forces_n = case.forces_n();
        for (tick, sample) in run.iter().enumerate() {
            // After the last tick no force acts.
            let [force_x, force_y] = forces_n.get(tick).copied().unwrap_or_default();
            let ([a, b], [rate_a, rate_b], [x, y]) =
                (sample.base_rad, sample.rates_rad_s, sample.tip_m);
            let time_s = tick as f64 * case.tick_s();
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
