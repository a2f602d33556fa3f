//! This file lists the variables over which a free curve of the residual can be drawn.

use super::Variable;
use crate::cause::Place;
use crate::plant::Run;
use crate::weak::Windows;
use rigproof_model::effects::Instant;
use rigproof_spec::effect::Quantity;

/// Position, speed and time at a place in every window, and the friction level over each of them;
/// with one output also effort and load. `share` is the row entry of a unit of effort there.
pub fn variables<R: Run + ?Sized>(
    run: &R,
    windows: &Windows,
    place: Place,
    share: &[f64],
) -> Vec<Variable> {
    let motion = run.motion_kind();
    let at = |pick: &dyn Fn(&Instant) -> f64| -> Vec<f64> {
        let centres = windows.centres.iter();
        centres
            .filter_map(|&c| run.motion(place).get(c))
            .map(pick)
            .collect()
    };
    let sense = at(&|now| now.sense);
    let variable = |name, quantity: Quantity, level, values| Variable {
        name,
        unit: quantity.dimension(motion).to_string(),
        level,
        at: place,
        values,
        share: share.to_vec(),
        sense: sense.clone(),
    };
    let position = at(&|now| now.position);
    let time = at(&|now| now.time_s);
    let mut all = vec![
        variable("position", Quantity::Travel, false, position.clone()),
        variable("speed", Quantity::Speed, false, at(&|now| now.speed)),
        variable("time", Quantity::Time, false, time.clone()),
        variable("position", Quantity::Travel, true, position),
        variable("time", Quantity::Time, true, time),
    ];
    if run.outputs() == 1 {
        let effort = windows.average(&run.effort());
        let load = effort.iter().zip(&sense).map(|(e, s)| e * s).collect();
        all.insert(3, variable("effort", Quantity::Effort, false, effort));
        all.push(variable("load", Quantity::Effort, true, load));
    }
    all
}
