//! This file is what a curve of what is left can be drawn over on a plant of one joint.

use super::run::JointRun;
use crate::cause::Place;
use crate::unknown::Variable;
use crate::weak::Windows;
use rigproof_model::effects::Instant;
use rigproof_spec::effect::Quantity;

/// Position, speed, time and effort of every window, and the level of a friction over them.
pub fn variables(run: &JointRun, windows: &Windows) -> Vec<Variable> {
    let motion = run.kind;
    let at = |pick: &dyn Fn(&Instant) -> f64| -> Vec<f64> {
        let centres = windows.centres.iter();
        centres
            .filter_map(|&c| run.motion.get(c))
            .map(pick)
            .collect()
    };
    let sense = at(&|now| now.sense);
    let effort = windows.average(&run.effort);
    let load = effort.iter().zip(&sense).map(|(e, s)| e * s).collect();
    let variable = |name, quantity: Quantity, level, values| Variable {
        name,
        unit: quantity.dimension(motion).to_string(),
        level,
        at: Place::Whole,
        values,
        share: vec![1.0; sense.len()],
        sense: sense.clone(),
    };
    let position = at(&|now| now.position);
    let time = at(&|now| now.time_s);
    vec![
        variable("position", Quantity::Travel, false, position.clone()),
        variable("speed", Quantity::Speed, false, at(&|now| now.speed)),
        variable("time", Quantity::Time, false, time.clone()),
        variable("effort", Quantity::Effort, false, effort),
        variable("position", Quantity::Travel, true, position),
        variable("time", Quantity::Time, true, time),
        variable("load", Quantity::Effort, true, load),
    ]
}
