//! This file decides the unit of a column, from the header, the rig file and what the caller says.

use rigproof_spec::units::Unit;

use super::ChannelMap;
use crate::series::Channel;

/// The unit that a column is in: what the caller or the rig file says of the column, else the unit of the rig, if the header
/// does not state another one. What a column's name suggests is a guess, and does not count.
pub(super) fn column_unit(
    map: &ChannelMap,
    rig_unit: Unit,
    rig: &str,
    channel: &Channel,
) -> Result<Unit, String> {
    let (name, unit, header) = (&map.channel, &map.unit, &channel.unit);
    if let Some(said) = &map.column_unit {
        let parsed = Unit::parse(said).filter(|own| own.dimension == rig_unit.dimension);
        return parsed.ok_or_else(|| {
            format!("`{said}`, the unit stated for `{name}`, does not convert to `{unit}`, its unit in the rig `{rig}`; give one of the same kind")
        });
    }
    let counted = COUNTS.contains(&header.to_lowercase().as_str()) && map.scale != 1.0;
    if header.is_empty() || header == unit || counted {
        return Ok(rig_unit);
    }
    let answer = |unit: &str| {
        format!(
            "`--unit {name}={unit}`, or `column_unit = \"{unit}\"` beside that channel in the rig file"
        )
    };
    let said =
        format!("the header says that `{name}` is in `{header}`, the rig `{rig}` says `{unit}`");
    match Unit::parse(header) {
        Some(own) if own.dimension == rig_unit.dimension => {
            if (own.to_si / rig_unit.to_si - 1.0).abs() < 1e-12 {
                return Ok(rig_unit);
            }
            Err(format!(
                "{said}; {}; which is right? For the header {}; for the rig file the same with `{unit}`",
                span(&channel.samples),
                answer(header)
            ))
        }
        Some(_) => Err(format!(
            "{said}, which does not convert; {}; if the rig is right, add {}; if the header is right, correct the rig file or its choice of channel",
            span(&channel.samples),
            answer(unit)
        )),
        None => Err(format!(
            "{said}, and the header's is no known unit; if the rig is right, add {}",
            answer(unit)
        )),
    }
}

/// What headers call the steps of a converter, which a scale turns into a unit.
const COUNTS: [&str; 8] = [
    "count", "counts", "cnt", "tick", "ticks", "raw", "lsb", "pulses",
];

/// Between which values the samples lie, in words.
fn span(samples: &[f64]) -> String {
    let seen = || samples.iter().copied().filter(|x| x.is_finite());
    let least = seen().fold(f64::INFINITY, f64::min);
    let greatest = seen().fold(f64::NEG_INFINITY, f64::max);
    match least <= greatest {
        true => format!("its samples lie between {least} and {greatest}"),
        false => "it has no samples".to_owned(),
    }
}
