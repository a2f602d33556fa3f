//! This file is the ledger: what was claimed, by which engine it was examined, and what came out.

use std::fmt::Write;

use serde::Serialize;

use crate::campaign::Campaign;

/// What came out; no other word stands in the ledger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Word {
    /// It holds for every input the claim speaks of, on the numbers the rig computes with.
    #[serde(rename = "PROVED")]
    Proved,
    /// An input for which it does not hold was found.
    #[serde(rename = "REFUTED")]
    Refuted,
    /// The engine came to no end.
    #[serde(rename = "UNDECIDED")]
    Undecided,
    /// It held on every input that was tried.
    #[serde(rename = "TESTED")]
    Tested,
    /// The engine is not there.
    #[serde(rename = "NOT RUN")]
    NotRun,
}

impl Word {
    /// As it is written.
    pub const fn text(self) -> &'static str {
        match self {
            Word::Proved => "PROVED",
            Word::Refuted => "REFUTED",
            Word::Undecided => "UNDECIDED",
            Word::Tested => "TESTED",
            Word::NotRun => "NOT RUN",
        }
    }
}

/// What one engine found about one claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The engine.
    pub engine: &'static str,
    /// What came out.
    pub word: Word,
    /// How: paths, cases, draws, or the reason.
    pub how: String,
    /// How long it took, s.
    pub seconds: f64,
}

/// One claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// Its name.
    pub claim: &'static str,
    /// What it says.
    pub statement: String,
    /// What each engine found.
    pub verdicts: Vec<Verdict>,
    /// Classes of inputs it has to meet, and how often they were met.
    pub classes: Vec<(&'static str, u64)>,
}

/// One planted mutant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mutant {
    /// Its name.
    pub mutant: &'static str,
    /// The file it changes.
    pub file: String,
    /// The claim that refutes it.
    pub claim: Option<&'static str>,
    /// The engine that refutes it.
    pub engine: Option<&'static str>,
}

/// The whole ledger.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ledger {
    /// Fingerprint of the code it is about.
    pub code: String,
    /// Which engines were there, and how to get those that were not.
    pub engines: Vec<(&'static str, String)>,
    /// Every claim.
    pub claims: Vec<Entry>,
    /// Claims that are false, which the solver has to refute.
    pub false_claims: Vec<Entry>,
    /// Long campaigns of the property tests.
    pub campaigns: Vec<Campaign>,
    /// Every planted mutant.
    pub mutants: Vec<Mutant>,
}

/// What has to be believed.
const TRUSTED: &str = "\
What has to be believed: the Rust compiler keeps IEEE 754 for `+`, `-`, `*` and comparisons of f64 and f32, without contraction; the symbolic number \
(`symbol.rs`, `interval.rs`, `order.rs`) records what the code computes and rules out only branches that contradict a comparison already made, or the order that rounding keeps \
of products whose factors are ordered, which decides most checks without a question to the solver; that f32 results are f64 results rounded once more (`width.rs`); magnitude and bound of a number, which f64 computes by `abs`, are what the symbolic number computes by comparisons; the script \
(`script.rs`) says the same in SMT-LIB 2; bitwuzla is right when it says UNSAT. What it finds satisfiable is replayed on f64 or f32 before it counts \
as refuted. That a computed sum of two products below zero means an exact one below zero rests on rounding to nearest keeping order.";

impl Ledger {
    /// Everything that makes `prove` fail.
    pub fn failures(&self) -> Vec<String> {
        let mut failures = Vec::new();
        for entry in &self.claims {
            let refuted = entry
                .verdicts
                .iter()
                .filter(|verdict| verdict.word == Word::Refuted);
            failures.extend(
                refuted.map(|by| format!("{}: refuted by {}: {}", entry.claim, by.engine, by.how)),
            );
            let undecided = entry
                .verdicts
                .iter()
                .filter(|verdict| verdict.word == Word::Undecided);
            failures.extend(
                undecided
                    .map(|by| format!("{}: undecided by {}: {}", entry.claim, by.engine, by.how)),
            );
            if entry.classes.is_empty() {
                failures.push(format!("{}: no class was met", entry.claim));
            }
            let dead = entry.classes.iter().filter(|(_, hits)| *hits == 0);
            failures
                .extend(dead.map(|(class, _)| format!("{}: `{class}` was never met", entry.claim)));
        }
        for entry in &self.false_claims {
            let believed = entry
                .verdicts
                .iter()
                .filter(|verdict| verdict.word != Word::Refuted && verdict.word != Word::NotRun);
            failures.extend(believed.map(|by| {
                format!(
                    "{} is false and not refuted by {}: {}",
                    entry.claim, by.engine, by.how
                )
            }));
        }
        let survivors = self.mutants.iter().filter(|mutant| mutant.engine.is_none());
        failures.extend(survivors.map(|mutant| format!("mutant {}: not refuted", mutant.mutant)));
        failures
    }

    /// As a page.
    pub fn markdown(&self) -> String {
        let mut page = String::from(
            "# Ledger of claims\n\nWritten by `cargo run --release -p rigproof-proofs -- prove`; not by hand. PROVED: for every input the \
             claim speaks of. TESTED: on\nevery input that was tried. NOT RUN: the engine was not there. Each claim stands once, in the file \
             beside the code it is about.\n\n",
        );
        let _ = writeln!(page, "Code: `{}`\n\n## Engines\n", self.code);
        for (engine, state) in &self.engines {
            let _ = writeln!(page, "- {engine}: {state}");
        }
        let _ = writeln!(page, "\n{TRUSTED}\n\n## Claims\n");
        for entry in &self.claims {
            let _ = writeln!(page, "### `{}`\n\n{}\n", entry.claim, entry.statement);
            for verdict in &entry.verdicts {
                let _ = writeln!(
                    page,
                    "- {}: **{}**, {}",
                    verdict.engine,
                    verdict.word.text(),
                    verdict.how
                );
            }
            let classes: Vec<String> = entry
                .classes
                .iter()
                .map(|(class, hits)| format!("{class} {hits}"))
                .collect();
            let _ = writeln!(page, "- met: {}\n", classes.join("; "));
        }
        page += &self.false_claims_markdown();
        page += &self.campaigns_markdown();
        let _ = writeln!(
            page,
            "## Planted mutants\n\n| mutant | file | refuted by | engine |\n|---|---|---|---|"
        );
        for mutant in &self.mutants {
            let claim = mutant
                .claim
                .map_or("nothing".to_owned(), |claim| format!("`{claim}`"));
            let engine = mutant.engine.unwrap_or("–");
            let _ = writeln!(
                page,
                "| `{}` | `{}` | {claim} | {engine} |",
                mutant.mutant, mutant.file
            );
        }
        page
    }

    fn false_claims_markdown(&self) -> String {
        let mut page = String::new();
        let _ = writeln!(
            page,
            "## Claims that are false\n\nWhat an engine that can say no has to refute.\n"
        );
        for entry in &self.false_claims {
            let _ = writeln!(page, "- `{}`: {}", entry.claim, entry.statement);
            for verdict in &entry.verdicts {
                let (engine, word) = (verdict.engine, verdict.word.text());
                let _ = writeln!(page, "  - {engine}: **{word}**, {}", verdict.how);
            }
        }
        page.push('\n');
        page
    }

    fn campaigns_markdown(&self) -> String {
        let mut page = String::new();
        let _ = writeln!(
            page,
            "## Long campaigns\n\nProperty tests that were run once with `PROPTEST_CASES` at the number of cases (`proofs/campaigns.toml`).\n\n\
             | tests | cases of each | time | result |\n|---|---|---|---|"
        );
        for campaign in &self.campaigns {
            let Campaign {
                tests,
                cases,
                seconds,
                result,
            } = campaign;
            let _ = writeln!(page, "| {tests} | {cases} | {seconds} s | {result} |");
        }
        page.push('\n');
        page
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ledger(word: Word, hits: u64, engine: Option<&'static str>) -> Ledger {
        Ledger {
            code: "c0de".to_owned(),
            engines: vec![("smt", "bitwuzla".to_owned())],
            claims: vec![Entry {
                claim: "a_claim",
                statement: "It holds.".to_owned(),
                verdicts: vec![Verdict {
                    engine: "smt",
                    word,
                    how: "7 paths".to_owned(),
                    seconds: 0.3,
                }],
                classes: vec![("any", hits)],
            }],
            false_claims: Vec::new(),
            campaigns: vec![Campaign {
                tests: "machines guard".to_owned(),
                cases: 4703,
                seconds: 3,
                result: "held".to_owned(),
            }],
            mutants: vec![Mutant {
                mutant: "half_flip",
                file: "select.rs".to_owned(),
                claim: engine.map(|_| "a_claim"),
                engine,
            }],
        }
    }

    #[test]
    fn a_ledger_fails_for_each_reason() {
        let failures = |word, hits, engine| ledger(word, hits, engine).failures().len();
        assert_eq!(failures(Word::Proved, 3, Some("smt")), 0);
        assert_eq!(failures(Word::Refuted, 3, Some("smt")), 1);
        assert_eq!(failures(Word::Proved, 0, Some("smt")), 1);
        assert_eq!(failures(Word::Proved, 3, None), 1);
        let mut empty = ledger(Word::Proved, 3, Some("smt"));
        empty.claims[0].classes.clear();
        assert_eq!(empty.failures().len(), 1);
        for (word, expected) in [(Word::Refuted, 0), (Word::Proved, 1), (Word::Undecided, 1)] {
            let mut with_false = ledger(Word::Proved, 3, Some("smt"));
            with_false.false_claims = ledger(word, 0, None).claims;
            assert_eq!(with_false.failures().len(), expected);
        }
    }

    #[test]
    fn the_page_holds_every_word_and_name() {
        let page = ledger(Word::Undecided, 3, None).markdown();
        for text in [
            "`a_claim`",
            "**UNDECIDED**",
            "`half_flip`",
            "any 3",
            "c0de",
            "nothing",
            "| machines guard | 4703 | 3 s | held |",
        ] {
            assert!(page.contains(text), "{text}");
        }
    }
}
