//! This file says that the thesis's five controllers pass their laws.

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::law::Law;
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::trial::run;
use rigproof_spec::methods::Method;

const BOTH: [Rig; 2] = [Rig::ThreeBrake, Rig::FourBrake];

#[test]
fn the_five_controllers_of_the_thesis_pass_their_laws() {
    let n: u64 = std::env::var("RIGPROOF_CAMPAIGN").map_or(60, |text| text.parse().unwrap());
    for method in Method::ALL {
        let controller = BuiltIn::of(method);
        let declared = controller.declared();
        let begun = std::time::Instant::now();
        let mut ticks = 0;
        let mut worst = [f64::MAX; 14];
        for index in 0..n {
            let scenario = Scenario::drawn(1, index, &BOTH, 2000);
            let ran = run(&scenario, &controller, &declared, false).unwrap();
            ticks += u64::from(ran.ticks);
            for law in Law::ALL {
                let fared = ran.fared[law as usize];
                worst[law as usize] = worst[law as usize].min(fared.worst);
                if fared.broken > 0 {
                    println!("{method:?} {index} {law:?} {fared:?} {:?}", scenario);
                }
            }
        }
        println!(
            "{method:?}: {ticks} ticks, {:.2} us a tick",
            begun.elapsed().as_secs_f64() * 1e6 / ticks as f64
        );
        println!(
            "{:?}",
            Law::ALL
                .into_iter()
                .zip(worst)
                .map(|(l, w)| format!("{} {w:.2e}", l.name()))
                .collect::<Vec<_>>()
        );
    }
}
