//! This file says that Scooter has one degree of freedom, whatever pushes it, and that its castors take no energy.

use core::f64::consts::PI;

use proptest::prelude::*;
use rigproof_model::displays::{Aim, Scooter};
use rigproof_spec::displays::SCOOTER_GRIP_N;
use rigproof_spec::laws::{Castor, dissipation, one_degree, rolls};
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_tests::cases;

use super::hands::hand;

/// Where the castors stand around the handle, m: at the corners of an equal-sided triangle.
fn castors(heading: [f64; 2]) -> [Castor; 3] {
    [0.0, 1.0, 2.0].map(|k| {
        let (sine, cosine) = libm::sincos(0.3 + 2.0 * PI * k / 3.0);
        Castor {
            at_m: [0.17 * cosine, 0.17 * sine],
            heading,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), ..ProptestConfig::default() })]

    //= thesis section 2.2.1 test
    #[test]
    fn scooter_moves_one_way_under_every_hand(hand in hand(), heading in -PI..PI) {
        let mut display = Scooter::new(heading).at(hand.tip_m).unwrap();
        let (mut one, mut passive) = (true, true);
        hand.moves(&mut display, |plant| {
            let resisted = plant.resisted();
            for (load_n, rate_m_s) in resisted.loads.into_iter().zip(resisted.rates) {
                passive &= dissipation(load_n, rate_m_s).holds();
            }
            // 17 N are less than the three castors withstand, so that they never slip.
            one &= resisted.held[..3].iter().all(|held| *held) || plant.rates() == [0.0; 2];
            let [x, y] = plant.tip_velocity_m_s();
            let speed = libm::hypot(x, y);
            if speed > 1e-6 {
                let castors = castors([x / speed, y / speed]);
                one &= one_degree(&castors, 1e-9).holds() && rolls(&castors, [x, y, 0.0], 1e-9).holds();
            }
        });
        prop_assert!(one && passive, "one way {one}, passive {passive}");
    }

    #[test]
    fn castors_steered_about_one_point_leave_its_turn_and_nothing_else(
        centre in prop::array::uniform2(-0.9..0.9_f64), turn in 0.1..2.0_f64, other in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let stands = castors([1.0, 0.0]).map(|castor| castor.at_m);
        let [c_x, c_y] = centre;
        // Each castor rolls at a right angle to its way from the centre.
        let about = stands.map(|[x, y]| {
            let (way_x, way_y) = (x - c_x, y - c_y);
            let far = libm::hypot(way_x, way_y);
            Castor { at_m: [x, y], heading: [-way_y / far, way_x / far] }
        });
        prop_assume!(stands.iter().all(|[x, y]| libm::hypot(x - c_x, y - c_y) > 0.05));
        let twist = [turn * c_y, -turn * c_x, turn];
        prop_assert!(one_degree(&about, 1e-9).holds());
        prop_assert!(rolls(&about, twist, 1e-9).holds());
        // Any motion that is not in proportion to it makes a castor slip.
        let along = other.iter().zip(twist).map(|(a, b)| a * b).sum::<f64>() / twist.iter().map(|b| b * b).sum::<f64>();
        let rest = [0, 1, 2].map(|i| other[i] - along * twist[i]);
        prop_assume!(rest.iter().map(|r| r * r).sum::<f64>() > 1e-2);
        prop_assert!(!rolls(&about, other, 1e-6).holds());
    }
}

//= thesis section 2.2.1 test
#[test]
fn a_push_across_the_castors_moves_nothing_until_they_have_turned() {
    let mut display = Scooter::new(0.0).at([0.013, 0.36]).unwrap();
    let push = [0.0, 7.3];
    let mut far_m = Vec::new();
    for _ in 0..150 {
        display
            .tick(&Aim::Free, push, SAMPLE_STEP_S, |_| {})
            .unwrap();
        let [_, y] = display.plant().place().tip_m;
        far_m.push(y - 0.36);
    }
    // A free mass would have gone F·t²/2m; the castors first have to turn by 90°.
    let free_m = 0.5 * 7.3 / 5.0 * 0.15 * 0.15;
    println!(
        "{} mm after 20 ms, {} mm of {} mm after 150 ms",
        1e3 * far_m[19],
        1e3 * far_m[149],
        1e3 * free_m
    );
    assert!(far_m[19] < 0.1 * 0.5 * 7.3 / 5.0 * 0.02 * 0.02);
    assert!(far_m[149] > 0.0 && far_m[149] < 0.7 * free_m);
    let most_n = 3.0 * SCOOTER_GRIP_N;
    assert!(most_n > 7.3);
}
