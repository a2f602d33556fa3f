//! This file spoils what a channel is: clipped, turned, dead, in another unit, or taken for another one.

use super::{Mark, Recording, mark};
use crate::draw::Draw;

/// The amplifier's range ends at 30 to 55 % of the peak.
pub fn clip(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let effort = own.effort()?;
    let peak = effort.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let limit = peak * draw.uniform(0.3, 0.55);
    effort.iter_mut().for_each(|x| *x = x.clamp(-limit, limit));
    own.on_effort()
}

/// The effort has the other sign.
pub fn turn(own: &mut Recording<'_>, _: &mut Draw) -> Option<Mark> {
    own.effort()?.iter_mut().for_each(|x| *x = -*x);
    own.on_effort()
}

/// The effort reads one value throughout, mostly zero.
pub fn silence(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let effort = own.effort()?;
    let level = if draw.chance(0.7) {
        0.0
    } else {
        *effort.first()?
    };
    effort.iter_mut().for_each(|x| *x = level);
    own.on_effort()
}

/// The effort is in thousandths of its unit.
pub fn thousandfold(own: &mut Recording<'_>, _: &mut Draw) -> Option<Mark> {
    let names = own.names.others.map(|[_, effort]| effort).into_iter();
    for name in names.chain([own.names.effort]) {
        own.samples(name)?.iter_mut().for_each(|x| *x *= 1000.0);
    }
    every_effort(own)
}

/// The position is in degrees, and is said to be in radians.
pub fn degrees(own: &mut Recording<'_>, _: &mut Draw) -> Option<Mark> {
    let names = own.names.others.map(|[position, _]| position).into_iter();
    for name in names.chain([own.names.position]) {
        own.samples(name)?
            .iter_mut()
            .for_each(|x| *x = x.to_degrees());
    }
    every_effort(own)
}

/// A wrong unit may be that of either side; where there are two channels of a kind both are named.
fn every_effort(own: &Recording<'_>) -> Option<Mark> {
    let [position, effort] = own.names.roles;
    let [other_position, other_effort] = own.names.others.unwrap_or([position, effort]);
    let roles = [
        position,
        effort,
        other_position,
        other_effort,
        "drive",
        "inertia",
    ];
    Some(mark(&roles, (0, own.count() - 1)))
}

/// Two channels are taken for each other.
pub fn exchange(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let Recording { trace, names } = own;
    let [one, two] = match names.others {
        Some([position, _]) if draw.chance(0.5) => [names.position, position],
        Some([_, effort]) => [names.effort, effort],
        None => [names.position, names.effort],
    };
    let at = |name: &str| {
        let mut channels = trace.channels.iter();
        channels.position(|own| own.name == name || (name == "torque" && own.name == "force"))
    };
    let (one, two) = (at(one)?, at(two)?);
    let first = trace.channels.get(one)?.samples.clone();
    let second = core::mem::replace(&mut trace.channels.get_mut(two)?.samples, first);
    trace.channels.get_mut(one)?.samples = second;
    every_effort(own)
}
