//! This file prepares a recording of a brake for identification: complete samples only, torque as a
//! resistance.

use crate::rules::{LEAST_SAMPLES, MOST_DRIVING};
use rigproof_spec::effect::Motion;
use rigproof_trace::rig::{Plant, Recording};

use super::IdentifyError;

/// One recording; all columns have equal length.
pub struct Sampled {
    pub name: String,
    pub time_s: Vec<f64>,
    pub position_rad: Vec<f64>,
    pub torque_nm: Vec<f64>,
    pub current_a: Vec<f64>,
}

impl Sampled {
    /// Takes the complete samples.
    pub fn new(name: &str, recording: &Recording) -> Result<Sampled, IdentifyError> {
        let channel = |missing| IdentifyError::Channel {
            recording: name.to_owned(),
            missing,
        };
        if recording.plant != Plant::Bench || recording.motion != Motion::Rotary {
            return Err(channel("turning `bench`"));
        }
        let torque = recording
            .force
            .as_ref()
            .ok_or_else(|| channel("`torque` channel"))?;
        let current = recording
            .drive
            .as_ref()
            .ok_or_else(|| channel("`current` channel"))?;
        let mut sampled = Sampled {
            name: name.to_owned(),
            time_s: Vec::new(),
            position_rad: Vec::new(),
            torque_nm: Vec::new(),
            current_a: Vec::new(),
        };
        let columns = recording.time_s.iter().zip(&recording.position.samples);
        for (((time, position), torque), current) in
            columns.zip(&torque.samples).zip(&current.samples)
        {
            if position.is_finite() && torque.is_finite() && current.is_finite() {
                sampled.time_s.push(*time);
                sampled.position_rad.push(*position);
                sampled.torque_nm.push(*torque);
                sampled.current_a.push(*current);
            }
        }
        if sampled.len() < LEAST_SAMPLES {
            return Err(IdentifyError::Samples {
                recording: name.to_owned(),
                complete: sampled.len(),
                least: LEAST_SAMPLES,
            });
        }
        sampled.check_sign()?;
        Ok(sampled)
    }

    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// The samples of a range, by column.
    pub fn part(&self, range: core::ops::Range<usize>) -> Part<'_> {
        Part {
            time_s: slice(&self.time_s, &range),
            position_rad: slice(&self.position_rad, &range),
            torque_nm: slice(&self.torque_nm, &range),
        }
    }

    /// A resistance has the sign of the motion.
    fn check_sign(&self) -> Result<(), IdentifyError> {
        let reach = 10;
        let (mut moving, mut driving) = (0_u32, 0_u32);
        let pairs = self
            .position_rad
            .iter()
            .zip(self.position_rad.iter().skip(reach));
        let middle = self.torque_nm.iter().skip(reach / 2);
        for ((before, after), torque) in pairs.zip(middle) {
            let travel = after - before;
            if travel != 0.0 && *torque != 0.0 {
                moving += 1;
                driving += u32::from(travel * torque < 0.0);
            }
        }
        if f64::from(driving) > MOST_DRIVING * f64::from(moving) {
            return Err(IdentifyError::Sign {
                recording: self.name.clone(),
                percent: 100 * driving / moving.max(1),
            });
        }
        Ok(())
    }
}

/// Consecutive samples of a recording.
#[derive(Clone, Copy)]
pub struct Part<'a> {
    pub time_s: &'a [f64],
    pub position_rad: &'a [f64],
    pub torque_nm: &'a [f64],
}

impl Part<'_> {
    pub fn duration_s(&self) -> f64 {
        match (self.time_s.first(), self.time_s.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        }
    }

    /// Mean speed, rad/s: the slope of the straight line through the positions.
    pub fn speed_rad_s(&self) -> f64 {
        let (time, position) = (mean(self.time_s), mean(self.position_rad));
        let pairs = self.time_s.iter().zip(self.position_rad);
        let (mut square, mut product) = (0.0, 0.0);
        for (t, x) in pairs {
            square += (t - time) * (t - time);
            product += (t - time) * (x - position);
        }
        product / square
    }
}

fn slice<'a>(column: &'a [f64], range: &core::ops::Range<usize>) -> &'a [f64] {
    column.get(range.clone()).unwrap_or_default()
}

impl Part<'_> {
    /// Greatest distance of a position from the straight line through all of them, rad.
    pub fn distance_from_line_rad(&self) -> f64 {
        let (time, position) = (mean(self.time_s), mean(self.position_rad));
        let speed = self.speed_rad_s();
        let pairs = self.time_s.iter().zip(self.position_rad);
        pairs
            .map(|(t, x)| (x - position - speed * (t - time)).abs())
            .fold(0.0, f64::max)
    }
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation; 0 of fewer than two values.
pub fn deviation(values: &[f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let middle = mean(values);
    let square: f64 = values.iter().map(|x| (x - middle) * (x - middle)).sum();
    libm::sqrt(square / (values.len() - 1) as f64)
}

/// Median; NaN of none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match (sorted.get(middle), sorted.get(middle.wrapping_sub(1))) {
        (Some(upper), Some(lower)) if sorted.len().is_multiple_of(2) => 0.5 * (lower + upper),
        (Some(upper), _) => *upper,
        (None, _) => f64::NAN,
    }
}
