//! This file says that Osaka's ER display only takes energy, and that its two brakes alternate on a line.

use proptest::prelude::*;
use rigproof_model::control::path::{Line, Path};
use rigproof_model::displays::{Aim, Osaka};
use rigproof_spec::laws::dissipation;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_tests::cases;

use super::hands::hand;

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), ..ProptestConfig::default() })]

    //= thesis section 2.2.1 test
    #[test]
    fn osakas_display_takes_energy_from_every_hand(hand in hand()) {
        let mut display = Osaka::new().at(hand.tip_m).unwrap();
        let mut holds = true;
        hand.moves(&mut display, |plant| {
            let resisted = plant.resisted();
            let both = resisted.loads.into_iter().zip(resisted.rates);
            for (load_nm, rate_rad_s) in both {
                holds &= dissipation(load_nm, rate_rad_s).holds();
            }
        });
        prop_assert!(holds);
    }
}

//= thesis section 2.2.1 test
#[test]
fn two_brakes_alternate_along_a_line_between_their_paths() {
    let line = Line::through([-0.08, 0.29], [0.09, 0.43]).unwrap();
    let mut display = Osaka::new().at([-0.077, 0.2951]).unwrap();
    let (mut taken, mut changes, mut last) = ([0_u32; 2], 0, None);
    for _ in 0..1500 {
        let nearest = line.nearest(display.plant().place().tip_m);
        let push = nearest.tangent * 9.0;
        display
            .tick(&Aim::Path(&line), push.into(), SAMPLE_STEP_S, |_| {})
            .unwrap();
        let loads = display.plant().resisted().loads;
        let leading = [0, 1].into_iter().find(|&i| loads[i].abs() > 0.3);
        if let Some(brake) = leading {
            taken[brake] += 1;
            changes += u32::from(last.is_some_and(|last| last != brake));
            last = Some(brake);
        }
        let [x, _] = display.plant().place().tip_m;
        if x > 0.07 {
            break;
        }
    }
    println!("ticks led by brakes A and B: {taken:?}, changes {changes}");
    assert!(taken.iter().all(|ticks| *ticks > 20), "{taken:?}");
    assert!(changes > 2, "{changes}");
}
