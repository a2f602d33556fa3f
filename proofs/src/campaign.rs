//! This file reads which long campaigns of the property tests were run, by hand: `proofs/campaigns.toml`.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// Property tests that were run once with many more cases than a build runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Campaign {
    /// Test program and test.
    pub tests: String,
    /// Cases of each property.
    pub cases: u64,
    /// How long it took, s.
    pub seconds: u64,
    /// What came out, and what was mended for it.
    pub result: String,
}

#[derive(Deserialize)]
struct File {
    campaign: Vec<Campaign>,
}

/// Every campaign.
///
/// # Errors
/// Why the file cannot be read.
pub fn campaigns(root: &Path) -> Result<Vec<Campaign>, String> {
    let text = fs::read_to_string(root.join("proofs/campaigns.toml"));
    let file = text.map_err(|error| format!("proofs/campaigns.toml: {error}"))?;
    parse(&file).map_err(|error| format!("proofs/campaigns.toml: {error}"))
}

fn parse(text: &str) -> Result<Vec<Campaign>, toml::de::Error> {
    toml::from_str(text).map(|file: File| file.campaign)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_campaign_says_what_was_run_and_what_came_out() {
        let whole = "[[campaign]]\ntests = \"machines guard\"\ncases = 17\nseconds = 3\nresult = \"held\"\n";
        let read = parse(whole).unwrap();
        assert_eq!((read.len(), read[0].cases), (1, 17));
        for key in ["tests", "cases", "seconds", "result"] {
            let without: Vec<&str> = whole
                .lines()
                .filter(|line| !line.starts_with(key))
                .collect();
            assert!(parse(&without.join("\n")).is_err(), "{key}");
        }
    }
}
