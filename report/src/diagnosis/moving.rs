//! This file moves the joint of an axis on the page: as recorded, and as the models compute it.

use rigproof_diagnose::Curves;

use crate::chart::rounded;
use crate::replay::{Replay, Shape, Way};

/// The most frames that are played.
const MOST_FRAMES: usize = 800;

/// The joint of an axis over the held-out part; nothing where the output is no position.
pub fn joint(curves: &Curves) -> Option<Replay> {
    let shape = match (curves.output, curves.unit.as_str()) {
        ("position", "rad") => Shape::Turning,
        ("position", "m") => Shape::Sliding,
        _ => return None,
    };
    let every = curves.time_s.len().div_ceil(MOST_FRAMES).max(1);
    let way = |name: &str, role, positions: &[f64]| Way {
        name: name.to_owned(),
        role,
        frames: positions
            .iter()
            .step_by(every)
            .map(|own| own.is_finite().then(|| vec![rounded(*own, 6)]))
            .collect(),
    };
    let time_s = curves.time_s.iter().step_by(every);
    let start = match shape {
        Shape::Sliding => curves.recorded.first().copied().unwrap_or(0.0),
        _ => 0.0,
    };
    let is_there = curves.time_s.len() > 1 && curves.recorded.iter().any(|own| own.is_finite());
    is_there.then(|| Replay {
        shape,
        time_s: time_s.map(|t| rounded(*t, 6)).collect(),
        a: [start, 0.0],
        b: [start, 0.0],
        ways: vec![
            way("recorded", "recorded", &curves.recorded),
            way("old model", "old", &curves.before),
            way("new model", "new", &curves.after),
        ],
        protocol: "Both models know nothing but the recorded drive.".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves(output: &'static str, unit: &str) -> Curves {
        let time_s: Vec<f64> = (0..2001).map(|k| 7.25 + 0.013 * k as f64).collect();
        Curves {
            output,
            unit: unit.to_owned(),
            recorded: time_s.iter().map(|t| 0.3 * t).collect(),
            before: time_s.iter().map(|t| 0.2 * t).collect(),
            after: time_s.iter().map(|t| 0.31 * t).collect(),
            time_s,
            ..Curves::default()
        }
    }

    #[test]
    fn an_angle_turns_and_a_position_slides() {
        let turning = joint(&curves("position", "rad")).unwrap();
        assert_eq!(turning.shape, Shape::Turning);
        assert!((600..=MOST_FRAMES).contains(&turning.time_s.len()));
        for way in &turning.ways {
            assert_eq!(way.frames.len(), turning.time_s.len());
        }
        assert_eq!(turning.ways[1].frames[0], Some(vec![1.45]));
        assert!(turning.figure().into_string().contains("a hand that turns"));
        let sliding = joint(&curves("position", "m")).unwrap();
        assert_eq!(sliding.shape, Shape::Sliding);
        assert!(
            sliding
                .figure()
                .into_string()
                .contains("a mark that slides")
        );
        assert_eq!(joint(&curves("effort", "N·m")), None);
        assert_eq!(joint(&Curves::default()), None);
    }
}
