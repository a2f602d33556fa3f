//! This file says that PADyC's joints keep to their speeds, that no motor drives them, and what each of its modes lets happen.

use proptest::prelude::*;
use rigproof_model::control::Side;
use rigproof_model::control::path::{Line, Path};
use rigproof_model::displays::{Aim, Device, Display, Now, Padyc, Place, Plant, Rows};
use rigproof_model::linkage::inverse;
use rigproof_model::motion::limited::LimitedRates;
use rigproof_spec::displays::BODY;
use rigproof_spec::geometry::arms;
use rigproof_spec::laws::{clutches_never_drive, dissipation, velocity_limits};
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_tests::cases;
use std::cell::Cell;
use std::rc::Rc;

use super::hands::hand;

/// PADyC with its limits told to the outside.
#[derive(Debug)]
struct Watched {
    inner: Padyc,
    limits: Rc<Cell<[[f64; 2]; 2]>>,
}

impl Device for Watched {
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>) {
        self.inner.decide(aim, now);
    }

    fn rows(&mut self, place: &Place, rates: [f64; 2], step_s: f64) -> Rows {
        let rows = self.inner.rows(place, rates, step_s);
        if let Rows::Limited(LimitedRates { limits_rad_s, .. }) = rows {
            self.limits.set(limits_rad_s);
        }
        rows
    }
}

fn watched(tip_m: [f64; 2]) -> (Display, Rc<Cell<[[f64; 2]; 2]>>) {
    let limits = Rc::new(Cell::new([[0.0; 2]; 2]));
    let device = Watched {
        inner: Padyc::new(),
        limits: Rc::clone(&limits),
    };
    let plant = Padyc::new().at(tip_m).unwrap().plant().clone();
    (Display::new(plant, device), limits)
}

/// Angles of joints A and E, rad.
fn joints_rad(plant: &Plant) -> [f64; 2] {
    let pose = inverse::pose(&arms(BODY), plant.place().tip_m).unwrap();
    [pose.theta_a_rad, pose.theta_e_rad]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), ..ProptestConfig::default() })]

    //= thesis section 2.2.1 test
    #[test]
    fn padycs_joints_keep_to_their_speeds_and_no_clutch_drives_them(hand in hand()) {
        let (mut display, limits) = watched(hand.tip_m);
        let (mut kept, mut passive) = (true, true);
        hand.moves(&mut display, |plant| {
            let resisted = plant.resisted();
            for (i, limits) in limits.get().into_iter().enumerate() {
                // The two coordinates say how fast the joints really turn.
                kept &= velocity_limits(resisted.rates[i], limits).holds();
                passive &= clutches_never_drive(limits).holds();
                passive &= dissipation(resisted.loads[i], resisted.rates[i]).holds();
            }
            kept &= (plant.rates()[0] - resisted.rates[0]).abs() < 1e-9;
        });
        prop_assert!(kept, "a joint is faster than its clutches");
        prop_assert!(passive, "a clutch drives");
    }

    #[test]
    fn position_mode_takes_no_joint_away_from_its_angle(hand in hand(), x in -0.06..0.06_f64, y in 0.31..0.39_f64) {
        let mut display = Padyc::new().at(hand.tip_m).unwrap();
        let pose = inverse::pose(&arms(BODY), [x, y]).unwrap();
        let goal = [pose.theta_a_rad, pose.theta_e_rad];
        let mut last = joints_rad(display.plant());
        for push in &hand.pushes_n {
            for _ in 0..40 {
                display.tick(&Aim::Point([x, y]), *push, SAMPLE_STEP_S, |_| {}).unwrap();
                let now = joints_rad(display.plant());
                for i in 0..2 {
                    // Nearer or as near, to what joint E's own turn changes within a step.
                    let (before, after) = ((last[i] - goal[i]).abs(), (now[i] - goal[i]).abs());
                    prop_assert!(after <= before + 1e-6, "joint {i}: {before} then {after}");
                }
                last = now;
            }
        }
    }

    //= thesis section 2.2.1 test
    #[test]
    fn region_mode_keeps_every_hand_in_its_region(hand in hand()) {
        // The wall is moved so that the tip starts outside.
        let nearest = hand.line.nearest(hand.tip_m);
        let left = [-nearest.tangent.y, nearest.tangent.x];
        let aside = nearest.offset_m.max(0.0) + 0.004;
        let foot = [nearest.foot_m.x + left[0] * aside, nearest.foot_m.y + left[1] * aside];
        let wall = Line::through(foot, [foot[0] + nearest.tangent.x, foot[1] + nearest.tangent.y]).unwrap();
        let aim = Aim::Wall(&wall, Side::Left);
        let mut display = Padyc::new().at(hand.tip_m).unwrap();
        let mut deepest_m = f64::NEG_INFINITY;
        for push in &hand.pushes_n {
            for _ in 0..40 {
                if display.tick(&aim, *push, SAMPLE_STEP_S, |_| {}).is_err() {
                    return Ok(());
                }
                deepest_m = deepest_m.max(wall.nearest(display.plant().place().tip_m).offset_m);
            }
        }
        // The limits are of first order in the motion of a tick.
        prop_assert!(deepest_m < 5e-4, "{deepest_m} m deep");
    }
}
