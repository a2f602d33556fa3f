//! This file is how a rig's recordings are written down, where that cannot be seen in them: separator, decimal mark,
//! header lines.

use super::read::choice;
use super::table::Table;
use super::write::string;
use crate::csv::{Decimal, Hints, Separator};
use crate::error::TraceError;

/// Reads `[text]`; what is not said is found out from each recording.
pub(super) fn read(root: &Table<'_>) -> Result<Hints, TraceError> {
    let Some(table) = root.table("text")? else {
        return Ok(Hints::default());
    };
    table.only(&["separator", "decimal", "header_lines"])?;
    let mut hints = Hints::default();
    if table.has("separator") {
        hints.separator = Some(choice(
            &table,
            "separator",
            Separator::ALL,
            Separator::name,
        )?);
    }
    if table.has("decimal") {
        hints.decimal = Some(choice(&table, "decimal", Decimal::ALL, Decimal::name)?);
    }
    if let Some(count) = table.number("header_lines")? {
        if !(0.0..=1e6).contains(&count) || count.fract() != 0.0 {
            let problem =
                format!("`header_lines` is {count}; give a whole number from 0 to 1000000");
            return Err(table.error_at("header_lines", problem));
        }
        hints.header_lines = Some(count as usize);
    }
    Ok(hints)
}

pub(super) fn lines(hints: &Hints) -> Vec<String> {
    let separator = hints.separator.map(|s| ("separator", string(s.name())));
    let decimal = hints.decimal.map(|d| ("decimal", string(d.name())));
    let header_lines = hints.header_lines.map(|n| ("header_lines", n.to_string()));
    let said = [separator, decimal, header_lines].into_iter().flatten();
    let mut lines: Vec<String> = said
        .map(|(key, value)| format!("{key} = {value}"))
        .collect();
    if !lines.is_empty() {
        lines.insert(0, "\n[text]".to_owned());
    }
    lines
}
