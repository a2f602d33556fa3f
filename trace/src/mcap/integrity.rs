//! This file says how far a file's check sums held and what of it is missing.

/// What became of one kind of check sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Check {
    /// The file carries none.
    #[default]
    Absent,
    /// Every one that is there was recomputed and agrees.
    Verified,
    /// At least one does not agree.
    Failed,
}

impl Check {
    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Check::Absent => "absent",
            Check::Verified => "verified",
            Check::Failed => "failed",
        }
    }

    /// Takes in one more check sum: a failure stays.
    pub(super) fn add(&mut self, holds: bool) {
        *self = match (*self, holds) {
            (Check::Failed, _) | (_, false) => Check::Failed,
            _ => Check::Verified,
        };
    }
}

/// The most lines about what is missing that are kept.
const MOST_LINES: usize = 20;

/// The account of one pass over a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Integrity {
    /// Check sums of the chunks.
    pub chunks: Check,
    /// Check sum of the data section.
    pub data: Check,
    /// Check sum of the summary section.
    pub summary: Check,
    /// Messages that were read.
    pub messages: u64,
    /// Messages that the file says it holds.
    pub announced: Option<u64>,
    /// What is missing or wrong, a line each; empty for a whole file.
    pub missing: Vec<String>,
    unsaid: u64,
}

impl Integrity {
    /// Whether nothing is missing and no check failed.
    pub fn is_whole(&self) -> bool {
        let failed = [self.chunks, self.data, self.summary].contains(&Check::Failed);
        self.missing.is_empty() && !failed
    }

    /// "check sums: chunks verified, data absent, summary verified", and a line for everything that is missing.
    pub fn lines(&self) -> Vec<String> {
        let sums = format!(
            "check sums: chunks {}, data {}, summary {}",
            self.chunks.name(),
            self.data.name(),
            self.summary.name()
        );
        let more = (self.unsaid > 0).then(|| format!("and {} more of this kind", self.unsaid));
        let missing = self.missing.iter().cloned();
        std::iter::once(sums).chain(missing).chain(more).collect()
    }

    pub(super) fn miss(&mut self, line: String) {
        if self.missing.len() < MOST_LINES {
            self.missing.push(line);
        } else {
            self.unsaid += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_stays_a_failure() {
        let mut check = Check::default();
        check.add(true);
        assert_eq!(check, Check::Verified);
        check.add(false);
        check.add(true);
        assert_eq!(check, Check::Failed);
    }

    #[test]
    fn a_thousand_defects_do_not_fill_the_memory() {
        let mut integrity = Integrity::default();
        for k in 0..1003 {
            integrity.miss(format!("defect {k}"));
        }
        let lines = integrity.lines();
        assert_eq!(lines.len(), 22);
        assert_eq!(lines[21], "and 983 more of this kind");
        assert!(!integrity.is_whole());
    }
}
