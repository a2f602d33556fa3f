//! What makes a recording of an arm the one that is asked for.

use crate::make::make;
use crate::plant::Plant;
use crate::seal::open;
use crate::stratum::Stratum;
use rigproof_trace::rig::chain::ChainRig;
use std::path::Path;

#[test]
fn an_arm_is_described_recorded_and_made_again() {
    let origin = Path::new("case.toml");
    for seed in 40..60 {
        let case = make(Plant::Chain, seed, None).unwrap();
        let rig = ChainRig::parse(&case.rig_toml, origin).unwrap();
        let recording = rig.apply(&case.trace, origin).unwrap();
        let joints = recording.position.len();
        let expected = match seed % 10 {
            7 => 7..=7,
            8 => 5..=5,
            _ => 2..=5,
        };
        assert!(expected.contains(&joints), "{seed}: {joints}");
        assert!(case.trace.len() >= 1200, "{seed}");
        let again = make(Plant::Chain, seed, None).unwrap();
        assert_eq!(again.commitment, case.commitment);
        assert_eq!(
            again.trace.channels[1].samples,
            case.trace.channels[1].samples
        );
        let answer = open(&case.sealed).unwrap();
        assert_eq!(
            answer.stratum == Stratum::Nothing,
            answer.effects.is_empty()
        );
        for effect in &answer.effects {
            assert!(effect.joint.as_ref().unwrap().starts_with("joint"));
            assert!(!case.sealed.contains(&effect.mechanism));
        }
    }
}
