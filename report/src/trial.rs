//! This file is the page of a blind trial: how often what was hidden was named, with nothing hidden about it.

use maud::html;

use crate::document::{Document, Headline, Section, Tone};
use crate::table::table;

/// A blind trial in words.
pub struct Trial {
    /// How many recordings.
    pub cases: usize,
    /// How many of them came out exactly.
    pub exact: usize,
    /// Protocol and which plants.
    pub protocol: String,
    /// Head of the table, and a row a stratum.
    pub strata: (Vec<&'static str>, Vec<Vec<String>>),
    /// Claims: what with its bound, what was measured, and whether it holds.
    pub claims: Vec<([String; 2], Option<bool>)>,
    /// What was hidden, and what was named in its place how often.
    pub confusion: Vec<[String; 2]>,
    /// Every seed: number, plant, stratum, what was hidden, what was named, how it was scored.
    pub seeds: Vec<Vec<String>>,
}

/// The page as HTML.
pub fn page(trial: &Trial) -> String {
    let failed = trial
        .claims
        .iter()
        .filter(|(_, holds)| *holds == Some(false))
        .count();
    let headline = Headline {
        tone: if failed == 0 { Tone::Good } else { Tone::Doubt },
        badge: "Blind trial".to_owned(),
        sentence: format!(
            "In {} of {} recordings with concealed causes exactly the cause was named.",
            trial.exact, trial.cases
        ),
        paragraphs: vec![
            html! { "Each recording was made by a plant that the diagnosis cannot see, its answer sealed. Brackets in the tables: 95 % intervals." },
            match failed {
                0 => html! { "Every claim that could be measured holds." },
                some => html! { (some) " of " (trial.claims.len()) " claims do not hold." },
            },
        ],
        cards: Vec::new(),
    };
    let claims: Vec<Vec<String>> = trial
        .claims
        .iter()
        .map(|([what, measured], holds)| {
            let fared = match holds {
                Some(true) => "holds",
                Some(false) => "✘ does not hold",
                None => "no case",
            };
            vec![what.clone(), measured.clone(), fared.to_owned()]
        })
        .collect();
    let confusion: Vec<Vec<String>> = trial.confusion.iter().map(|row| row.to_vec()).collect();
    let (head, strata) = &trial.strata;
    let seeds = [
        "seed", "plant", "kind", "hidden", "verdict", "named", "scored",
    ];
    let section = |id: &str, heading: &str, body| Section {
        id: id.to_owned(),
        heading: heading.to_owned(),
        body,
    };
    Document {
        title: headline.sentence.clone(),
        kind: "Blind trial",
        about: format!("{} recordings", trial.cases),
        headline,
        sections: vec![
            section("claims", "Claims", table("claims-table", "What is claimed, and what came out.", &["claim", "measured", "fared"], &claims)),
            section("strata", "Kinds of recordings", html! { (table("strata-table", "How the kinds fared.", head, strata)) details { summary { "Protocol" } p { (trial.protocol) } } }),
            section("confusion", "What was taken for what", table("confusion-table", "What was hidden, and what was named.", &["hidden", "named"], &confusion)),
            section("seeds", "Every recording", html! { details { summary { "Every seed" } (table("seeds-table", "What became of every seed.", &seeds, &trial.seeds)) } }),
        ],
        charts: Vec::new(),
        replay: None,
        served: None,
        footer: format!("Written by rigproof {}. This page is one file: it loads nothing and sends nothing.", env!("CARGO_PKG_VERSION")),
    }
    .to_html()
}
