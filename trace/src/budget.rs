//! This file says how much memory the reading of one file may take, and refuses what takes more.

use std::path::Path;
use std::sync::LazyLock;

use crate::error::TraceError;

/// The variable of the environment that sets it, in MiB.
pub const VARIABLE: &str = "RIGPROOF_READ_MIB";
/// What is given where it is not set, MiB: a recording of 64 million numbers with what its reading takes beside them.
pub const USUAL_MIB: u64 = 2048;
/// The least that can be set, MiB: below it small files are refused too.
pub const LEAST_MIB: u64 = 16;
/// How many times what a reader holds of a file it may hold for a moment: the stored bytes, the numbers, those that are chosen, and a list that grows.
pub const COPIES: u64 = 4;

/// The memory that the reading of one file may take, bytes.
pub fn bytes() -> u64 {
    static SET: LazyLock<u64> = LazyLock::new(|| of(std::env::var(VARIABLE).ok().as_deref()));
    *SET
}

fn of(set: Option<&str>) -> u64 {
    let mib = set.and_then(|text| text.trim().parse().ok());
    mib.unwrap_or(USUAL_MIB)
        .clamp(LEAST_MIB, u64::MAX >> 20)
        .saturating_mul(1 << 20)
}

/// The most that a reader may hold of a file, bytes, so that all of it stays within the budget.
pub fn held() -> u64 {
    bytes() / COPIES
}

/// Refuses to hold so many bytes of a file at once.
///
/// # Errors
/// With their copies they are more than the budget.
pub fn check(path: &Path, what: &str, bytes: u64) -> Result<(), TraceError> {
    check_within(path, what, bytes, self::bytes())
}

fn check_within(path: &Path, what: &str, bytes: u64, budget: u64) -> Result<(), TraceError> {
    match bytes.saturating_mul(COPIES) <= budget {
        true => Ok(()),
        false => Err(TraceError::recording(path, beyond(what, bytes, budget))),
    }
}

/// What is said of a file whose reading would take more.
pub fn beyond(what: &str, bytes: u64, budget: u64) -> String {
    let (most, mib) = (budget >> 20, bytes >> 20);
    let wanted = bytes.saturating_mul(COPIES).div_ceil(1 << 20);
    format!(
        "{what} takes {mib} MiB, and to read it {wanted} MiB: more than the {most} MiB that the reading of one file may take; set {VARIABLE} to more where the memory is there, or hand over a part of the file"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_budget_is_what_is_set_and_names_itself_when_it_refuses() {
        assert_eq!(of(None), USUAL_MIB << 20);
        assert_eq!(of(Some("64")), 64 << 20);
        assert_eq!(of(Some("0")), LEAST_MIB << 20);
        assert_eq!(of(Some("much")), USUAL_MIB << 20);
        let file = Path::new("run.h5");
        assert!(check_within(file, "`x`", 16 << 20, 64 << 20).is_ok());
        let refused = check_within(file, "`x`", (16 << 20) + 1, 64 << 20);
        let refused = refused.unwrap_err().to_string();
        assert!(
            refused.contains("`x` takes 16 MiB") && refused.contains("the 64 MiB"),
            "{refused}"
        );
        assert!(refused.contains(VARIABLE), "{refused}");
        assert!(check_within(file, "`x`", u64::MAX, u64::MAX).is_ok());
    }
}
