//! This file spoils a recording in the ways a careful technician would throw it away for.

use crate::draw::Draw;
use rigproof_trace::{Channel, Trace};

/// Spoils the recording in its channel of position or in that of effort and returns the fault's name.
pub fn spoil(position: &str, effort: &str, trace: &mut Trace, draw: &mut Draw) -> &'static str {
    match draw.below(5) {
        0 => {
            stick(channel_mut(trace, position), draw);
            "stuck_position"
        }
        1 => {
            clip(channel_mut(trace, effort), draw);
            "clipped_channel"
        }
        2 => {
            drop_samples(channel_mut(trace, position), draw);
            "dropped_samples"
        }
        3 => {
            jump(&mut trace.time_s, draw);
            "clock_jump"
        }
        _ => {
            if let Some(channel) = channel_mut(trace, effort) {
                channel.samples.iter_mut().for_each(|x| *x = -*x);
            }
            "swapped_sign"
        }
    }
}

/// The channel of a name; a linear bench meters a force where a rotary one meters a torque.
fn channel_mut<'a>(trace: &'a mut Trace, name: &str) -> Option<&'a mut Channel> {
    trace
        .channels
        .iter_mut()
        .find(|channel| channel.name == name || (name == "torque" && channel.name == "force"))
}

/// The encoder repeats one value for 10 to 25 % of the recording while the mechanism moves on.
fn stick(channel: Option<&mut Channel>, draw: &mut Draw) {
    let Some(channel) = channel else { return };
    let count = channel.samples.len();
    let length = (draw.uniform(0.1, 0.25) * count as f64) as usize;
    let mut start = 0;
    // A sensor stuck while the mechanism rests is no fault anybody could see.
    for _ in 0..50 {
        start = (draw.uniform(0.2, 0.7) * count as f64) as usize;
        if spread(channel.samples.iter().skip(start).take(length))
            > 0.2 * spread(channel.samples.iter())
        {
            break;
        }
    }
    let frozen = channel.samples.get(start).copied().unwrap_or(0.0);
    for sample in channel.samples.iter_mut().skip(start).take(length) {
        *sample = frozen;
    }
}

fn spread<'a>(samples: impl Iterator<Item = &'a f64>) -> f64 {
    let (low, high) = samples.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(*x), high.max(*x))
    });
    high - low
}

/// The amplifier's range ends at 30 to 55 % of the peak.
fn clip(channel: Option<&mut Channel>, draw: &mut Draw) {
    let Some(channel) = channel else { return };
    let peak = channel.samples.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let limit = peak * draw.uniform(0.3, 0.55);
    for sample in &mut channel.samples {
        *sample = sample.clamp(-limit, limit);
    }
}

/// A fifth to two fifths of the position cells are empty, in bursts.
fn drop_samples(channel: Option<&mut Channel>, draw: &mut Draw) {
    let Some(channel) = channel else { return };
    let share = draw.uniform(0.2, 0.4);
    let mut samples = channel.samples.iter_mut();
    while samples.len() > 0 {
        let burst = 10 + draw.below(90);
        let kept = (burst as f64 * (1.0 - share) / share) as usize;
        samples.by_ref().take(burst).for_each(|x| *x = f64::NAN);
        samples.by_ref().take(kept).for_each(|_| ());
    }
}

/// The clock jumps once, forward by 0.5 to 2 s or backward by 0.2 to 1 s, while the mechanism moves on.
fn jump(time_s: &mut [f64], draw: &mut Draw) {
    let start = (draw.uniform(0.3, 0.7) * time_s.len() as f64) as usize;
    let shift_s = if draw.chance(0.5) {
        draw.uniform(0.5, 2.0)
    } else {
        -draw.uniform(0.2, 1.0)
    };
    for time in time_s.iter_mut().skip(start) {
        *time += shift_s;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Plant;

    fn recording() -> Trace {
        let time_s: Vec<f64> = (0..4000).map(|k| f64::from(k) * 1e-3).collect();
        let channel = |name: &str, factor: f64| Channel {
            name: name.to_owned(),
            unit: String::new(),
            samples: time_s
                .iter()
                .map(|t| factor * libm::sin(5.1 * t + 0.3))
                .collect(),
        };
        Trace {
            channels: vec![channel("position", 0.7), channel("command", 3.1)],
            time_s,
        }
    }

    #[test]
    fn every_fault_occurs_and_changes_the_recording() {
        let mut seen = std::collections::BTreeSet::new();
        for seed in 0..60 {
            let mut trace = recording();
            let name = spoil(
                "position",
                "command",
                &mut trace,
                &mut Draw::new(Plant::Axis, seed, "fault"),
            );
            assert_ne!(trace, recording(), "{name}");
            let position = &trace.channel("position").unwrap().samples;
            let empty = position.iter().filter(|x| x.is_nan()).count();
            let backward_or_late = trace
                .time_s
                .windows(2)
                .filter(|pair| (pair[1] - pair[0] - 1e-3).abs() > 0.1)
                .count();
            match name {
                "dropped_samples" => assert!((600..2000).contains(&empty), "{empty}"),
                "clock_jump" => assert_eq!(backward_or_late, 1),
                "stuck_position" => {
                    let still = position.windows(2).filter(|p| p[0] == p[1]).count();
                    assert!((390..1010).contains(&still), "{still}");
                }
                _ => {}
            }
            seen.insert(name);
        }
        assert_eq!(seen.len(), 5, "{seen:?}");
    }
}
