//! This file says which numbers of a scenario a search moves, and how far: no further than what is drawn.

use crate::calibration::Calibration;
use crate::controller::Task;
use crate::hand::Hand;
use crate::scenario::Scenario;

/// How far the arms are turned at the start, rad: 3 cm at the end of an arm.
const TURNED_RAD: f64 = 0.1;
/// How far a point of the path is moved, m.
const MOVED_M: f64 = 0.03;
/// How far an arc is turned, rad, and its radius changed, as a share.
const ARC_RAD: f64 = 0.5;
const ARC_SHARE: f64 = 0.3;

/// The numbers that are moved: for each the least and the greatest that it takes, in the order in which [`each`] meets them.
pub struct Space {
    ends: Vec<[f64; 2]>,
}

impl Space {
    /// The numbers around a scenario.
    pub fn around(start: &Scenario, calibration: Option<&Calibration>) -> Space {
        let mut ends = Vec::new();
        let mut copy = start.clone();
        each(&mut copy, &mut |number, range| {
            ends.push(range.ends(*number))
        });
        // What a calibration found moves in its intervals.
        for found in calibration
            .iter()
            .flat_map(|calibration| &calibration.found)
        {
            let own = found.low.iter().zip(&found.high);
            ends.extend(own.map(|(low, high)| [*low, *high]));
        }
        Space { ends }
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The scenario at a point: every number from −1, its least, over 0, what it is in the start, to 1, its greatest.
    pub fn at(&self, start: &Scenario, point: &[f64]) -> Scenario {
        let mut moved = start.clone();
        let mut places = point.iter().zip(&self.ends);
        let mut to = |number: &mut f64| {
            let Some((share, [least, greatest])) = places.next() else {
                return;
            };
            let share = share.clamp(-1.0, 1.0);
            let room = if share < 0.0 {
                *number - least
            } else {
                greatest - *number
            };
            *number = (*number + share * room.max(0.0)).clamp(*least, greatest.max(*least));
        };
        each(&mut moved, &mut |number, _| to(number));
        for one in &mut moved.left_out {
            one.parameters.iter_mut().for_each(&mut to);
        }
        moved
    }
}

/// Between which ends a number is moved.
#[derive(Clone, Copy)]
enum Range {
    /// So far to either side.
    Within(f64),
    /// By such a share of itself.
    Share(f64),
    /// From here to there.
    Between(f64, f64),
}

impl Range {
    fn ends(self, number: f64) -> [f64; 2] {
        let [least, greatest] = match self {
            Range::Within(by) => [number - by, number + by],
            Range::Share(share) => [number * (1.0 - share), number * (1.0 + share)],
            Range::Between(least, greatest) => [least, greatest],
        };
        // What stands outside already is not moved further.
        [least.min(number), greatest.max(number)]
    }
}

/// Meets every number of a scenario that is moved, but for those of a calibration.
fn each(scenario: &mut Scenario, meet: &mut dyn FnMut(&mut f64, Range)) {
    for angle_rad in &mut scenario.theta_rad {
        meet(angle_rad, Range::Within(TURNED_RAD));
    }
    match &mut scenario.task {
        Task::Chain(points) | Task::Spline(points) => {
            for coordinate_m in points.iter_mut().flatten() {
                meet(coordinate_m, Range::Within(MOVED_M));
            }
        }
        Task::Arc {
            centre_m,
            radius_m,
            from_rad,
            to_rad,
        } => {
            for coordinate_m in centre_m {
                meet(coordinate_m, Range::Within(MOVED_M));
            }
            meet(radius_m, Range::Share(ARC_SHARE));
            for angle_rad in [from_rad, to_rad] {
                meet(angle_rad, Range::Within(ARC_RAD));
            }
        }
    }
    match &mut scenario.hand {
        Hand::Operator { strength, .. } => meet(strength, Range::Between(0.6, 1.0)),
        Hand::Adversary { strength, .. } => meet(strength, Range::Between(0.2, 1.0)),
        Hand::Constant(_) => {}
    }
    // As far as scenarios are drawn (decision 0125).
    let plant = &mut scenario.plant;
    let shares = [
        (&mut plant.torque, 0.1),
        (&mut plant.time_constant, 0.2),
        (&mut plant.backlash, 0.3),
        (&mut plant.inertia, 0.1),
    ];
    for (shares, greatest) in shares {
        for share in shares {
            meet(share, Range::Between(-greatest, greatest));
        }
    }
    meet(&mut plant.payload_kg, Range::Between(0.0, 0.5));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Rig;

    #[test]
    fn the_middle_is_the_start_and_the_ends_are_as_far_as_is_drawn() {
        for index in 0..60 {
            let start = Scenario::drawn(3, index, &[Rig::FourBrake], 900);
            let space = Space::around(&start, None);
            let at = |share: f64| space.at(&start, &vec![share; space.len()]);
            assert_eq!(at(0.0), start);
            let (least, greatest) = (at(-1.0), at(1.0));
            let near = |value: f64, end: f64| assert!((value - end).abs() < 1e-12, "{value} {end}");
            least
                .plant
                .torque
                .iter()
                .for_each(|share| near(*share, -0.1));
            near(greatest.plant.payload_kg, 0.5);
            greatest
                .plant
                .inertia
                .iter()
                .for_each(|share| near(*share, 0.1));
            assert_eq!(least.faults, start.faults);
            let turned = greatest.theta_rad[0] - start.theta_rad[0];
            assert!((turned - 0.1).abs() < 1e-12);
            assert_ne!(greatest.task, start.task);
        }
    }
}
