//! This file prints what became of recordings that hide physics in other forms.

use rigproof_blind::Tally;
use serde_json::json;

use super::trial::Tried;
use crate::outcome::{Failure, Outcome, print};
use crate::text::{join, section};

/// Prints outcomes, calibration and coverage; no claim is made of them.
pub fn show(tried: &[Tried], how: &str, details: bool, as_json: bool) -> Result<Outcome, Failure> {
    let mut tally = Tally::default();
    for case in tried {
        if let Some(judgement) = &case.judgement {
            tally.add(case.answer.plant, case.answer.seed, judgement.clone());
        }
    }
    if as_json {
        let cases = tried.iter().map(Tried::json).filter(|_| details);
        let mut result = tally.to_json();
        if let Some(result) = result.as_object_mut() {
            result.insert("plant".to_owned(), json!(how));
            result.insert("cases".to_owned(), json!(cases.collect::<Vec<_>>()));
        }
        print(&result.to_string())?;
    } else {
        let details = tried.iter().filter(|_| details).map(Tried::line);
        let table = tally.to_string().trim_end().to_owned();
        print(&join([
            section("Seeds", details),
            vec![table, how.to_owned()],
        ]))?;
    }
    Ok(Outcome { checks_hold: true })
}
