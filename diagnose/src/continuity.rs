//! This file repairs positions that are not continuous: it unwraps counters, and leaves out and
//! counts a few bad samples. What cannot be repaired is a fault.

mod clock;
mod jumps;
mod repeats;
mod steps;
mod straight;

use crate::align::{Fault, check_frozen};
use crate::effect::Effect;
use crate::rules::MOST_MISSING;

pub use clock::{roughness, settle};

/// What was repaired in a channel, or is only noted.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Remark {
    /// The role of the channel.
    pub channel: &'static str,
    /// What was wrong or is odd: `wrapped`, `dropouts`, `repeated`, `held`, `filled_in`, `jumped`, `jitter`.
    pub what: &'static str,
    /// The first time, s.
    pub from_s: f64,
    /// The last time, s.
    pub to_s: f64,
    /// The number of samples or events.
    pub count: usize,
    /// A sentence on what was found and what was done.
    pub words: String,
    /// The cause that it is by itself, where it matters beside the noise of the sensors.
    #[serde(skip)]
    pub cause: Option<Effect>,
}

/// A recorded position under repair.
#[derive(Clone, Debug)]
pub struct Position {
    /// Its role.
    pub channel: &'static str,
    /// Its samples, m or rad; NaN where none was recorded.
    pub samples: Vec<f64>,
    /// Its stated resolution, m or rad.
    pub stated_quantum: Option<f64>,
    /// Its resolution, stated or estimated, m or rad.
    pub quantum: f64,
    /// Standard deviation of its noise besides the resolution, m or rad.
    pub noise: f64,
    /// Whether it is an angle, which repeats after a turn.
    pub is_angle: bool,
    /// The largest single jump that counts as a slip, m or rad. It is told, and the diagnosis weighs
    /// slips itself.
    pub slip: f64,
}

/// The time stamps of a recording, and its sample interval.
#[derive(Clone, Copy, Debug)]
pub struct Stamps<'a> {
    /// Time stamps, s, increasing.
    pub time_s: &'a [f64],
    /// The sample interval, s.
    pub step_s: f64,
}

impl Stamps<'_> {
    pub(crate) fn at(&self, k: usize) -> f64 {
        self.time_s.get(k).copied().unwrap_or(0.0)
    }

    /// Number of intervals between two samples.
    fn places(&self, k: usize, next: usize) -> f64 {
        ((self.at(next) - self.at(k)) / self.step_s)
            .round()
            .max(1.0)
    }
}

/// Repairs the positions of a recording. `others` are its other channels, from which samples that
/// every channel repeats are removed too.
///
/// # Errors
/// What cannot be repaired: its channel, its time and the reason.
pub fn mend(
    stamps: Stamps<'_>,
    positions: &mut [Position],
    others: &mut [&mut Vec<f64>],
) -> Result<Vec<Remark>, Fault> {
    let mut mended = Vec::new();
    for own in positions.iter_mut() {
        repeats::check_refreshed(stamps, own)?;
        mended.extend(jumps::unwrap(stamps, own));
        let channel = own.channel;
        check_frozen(stamps.time_s, &own.samples, stamps.step_s)
            .map_err(|fault| Fault { channel, ..fault })?;
    }
    mended.extend(repeats::leave_out_rows(stamps, positions, others)?);
    for own in positions.iter_mut() {
        mended.extend(repeats::leave_out_held(stamps, own)?);
        mended.extend(straight::leave_out(stamps, own)?);
        mended.extend(jumps::leave_out_dropouts(stamps, own)?);
        mended.extend(jumps::check(stamps, own)?);
        bridge(own);
    }
    Ok(mended)
}

/// Single samples that are left out are interpolated by a cubic through their neighbours.
fn bridge(own: &mut Position) {
    let p = &own.samples;
    let at = |k: usize| p.get(k).copied().unwrap_or(f64::NAN);
    let lone = (2..p.len().saturating_sub(2)).filter(|&k| at(k).is_nan());
    let filled: Vec<(usize, f64)> = lone
        .map(|k| {
            (
                k,
                (4.0 * (at(k - 1) + at(k + 1)) - at(k - 2) - at(k + 2)) / 6.0,
            )
        })
        .filter(|(_, x)| x.is_finite())
        .collect();
    for (k, x) in filled {
        if let Some(slot) = own.samples.get_mut(k) {
            *slot = x;
        }
    }
}

/// Leaves out samples if they are few; otherwise a fault. `of` is the number that could have been
/// seen.
fn few(
    stamps: Stamps<'_>,
    (channel, what): (&'static str, &'static str),
    bad: &[usize],
    of: usize,
    (found, cure): (String, &str),
) -> Result<Option<Remark>, Fault> {
    let (Some(first), Some(last)) = (bad.first(), bad.last()) else {
        return Ok(None);
    };
    let (from_s, to_s) = (stamps.at(*first), stamps.at(*last));
    if bad.len() as f64 > MOST_MISSING * of as f64 {
        return Err(Fault {
            channel,
            from_s,
            to_s,
            reason: format!("{found}: {cure}"),
        });
    }
    Ok(Some(Remark {
        channel,
        what,
        from_s,
        to_s,
        count: bad.len(),
        words: format!("{channel}, {from_s:.3} to {to_s:.3} s: {found}; they are left out"),
        cause: None,
    }))
}
