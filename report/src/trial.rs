//! This file is the page of a blind trial: how often what was hidden was named, with nothing hidden about it.

use std::collections::BTreeMap;

use maud::{Markup, html};

use crate::document::{Document, Headline, Section, Tone};
use crate::forest::{Forest, Mark};
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
    /// The strata once more, as numbers.
    pub kinds: Vec<Kind>,
    /// Claims: what with its bound, what was measured, and whether it holds.
    pub claims: Vec<([String; 2], Option<bool>)>,
    /// What was hidden, and what was named in its place how often.
    pub confusion: BTreeMap<String, BTreeMap<String, usize>>,
    /// Every seed: number, plant, stratum, what was hidden, what was named, how it was scored.
    pub seeds: Vec<Vec<String>>,
}

/// How recordings of one kind came out.
pub struct Kind {
    /// The kind.
    pub name: String,
    /// How many there are.
    pub cases: usize,
    /// In how many exactly the truth was named.
    pub exact: Share,
    /// In how many it was named or offered.
    pub inside: Share,
    /// In how many something was named that is not there.
    pub false_name: Share,
}

/// A count, and the 95 % interval of its share, from 0 to 1.
#[derive(Clone, Copy)]
pub struct Share {
    /// How many.
    pub count: usize,
    /// The interval.
    pub interval: [f64; 2],
}

/// The page as HTML.
pub fn page(trial: &Trial) -> String {
    let headline = headline(trial);
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
            section("claims", "Claims", claims(trial)),
            section("strata", "Kinds of recordings", html! { (shares(&trial.kinds)) (table("strata-table", "How the kinds fared.", head, strata)) details { summary { "Protocol" } p { (trial.protocol) } } }),
            section("confusion", "What was taken for what", confusion(&trial.confusion)),
            section("seeds", "Every recording", html! { details { summary { "Every seed" } (table("seeds-table", "What became of every seed.", &seeds, &trial.seeds)) } }),
        ],
        charts: Vec::new(),
        replay: None,
        served: None,
        footer: format!("Written by rigproof {}. This page is one file: it loads nothing and sends nothing.", env!("CARGO_PKG_VERSION")),
    }
    .to_html()
}

fn headline(trial: &Trial) -> Headline {
    let failed = trial.claims.iter();
    let failed = failed.filter(|(_, holds)| *holds == Some(false)).count();
    let whole = trial.kinds.iter().find(|kind| kind.name == "all");
    let card = |what: &str, share: Share, remark: &str| {
        let [low, high] = share.interval.map(|end| 100.0 * end);
        [
            what.to_owned(),
            format!("{} of {}", share.count, trial.cases),
            format!("{remark}; 95 %: {low:.0} to {high:.0} % of such recordings"),
        ]
    };
    Headline {
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
                1 => html! { "One of " (trial.claims.len()) " claims does not hold." },
                some => html! { (some) " of " (trial.claims.len()) " claims do not hold." },
            },
        ],
        cards: whole.map_or_else(Vec::new, |whole| {
            vec![
                card("Exactly the truth", whole.exact, "named, and nothing else"),
                card(
                    "The truth named or offered",
                    whole.inside,
                    "with rivals that the recording does not tell from it",
                ),
                card(
                    "A false name",
                    whole.false_name,
                    "something named that is not there",
                ),
            ]
        }),
    }
}

fn claims(trial: &Trial) -> Markup {
    let claims = trial.claims.iter();
    let claims: Vec<Vec<String>> = claims
        .map(|([what, measured], holds)| {
            let fared = match holds {
                Some(true) => "holds",
                Some(false) => "✘ does not hold",
                None => "no case",
            };
            vec![what.clone(), measured.clone(), fared.to_owned()]
        })
        .collect();
    let head = ["claim", "measured", "fared"];
    let caption = "What is claimed, and what came out.";
    table("claims-table", caption, &head, &claims)
}

/// The shares of every kind with their intervals.
fn shares(kinds: &[Kind]) -> Markup {
    let rows = kinds.iter().map(|kind| {
        let mark = |what, role, share: Share| Mark {
            what,
            role,
            value: 100.0 * share.count as f64 / kind.cases as f64,
            interval: share.interval.map(|end| 100.0 * end),
            remark: format!("{} of {}", share.count, kind.cases),
        };
        let marks = vec![
            mark("exact", "new", kind.exact),
            mark("named or offered", "noise", kind.inside),
            mark("a false name", "old", kind.false_name),
        ];
        (format!("{} ({})", kind.name, kind.cases), marks)
    });
    let forest = Forest {
        id: "shares",
        title: "How often",
        scale: "share of the recordings, %",
        remark: "count",
        rows: rows.collect(),
        limits: [0.0, 100.0],
    };
    forest.figure(&html! { "In brackets the number of recordings of a kind; the bars are 95 % intervals (Wilson): where they are long, there were few recordings." })
}

/// What was named for what: a row what was hidden, a column what was named, the right ones in the diagonal.
fn confusion(matrix: &BTreeMap<String, BTreeMap<String, usize>>) -> Markup {
    let mut names: Vec<&String> = matrix.keys().collect();
    for name in matrix.values().flat_map(BTreeMap::keys) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    // A column that nobody is in says nothing.
    names.retain(|name| matrix.values().any(|row| row.contains_key(*name)));
    let plain = |name: &str| name.replace('_', " ");
    html! {
        figure {
            div.scroll tabindex="0" role="region" aria-label="What was hidden, and what was named" { table.heat.matrix #confusion-table {
                caption { "A row is what was hidden, a column what was named for it, where at most one cause was hidden. Blue: right. Orange: something else. Empty: never." }
                thead { tr {
                    th scope="col" { "hidden" }
                    @for name in &names { th scope="col" { span { (plain(name)) } } }
                } }
                tbody { @for (hidden, row) in matrix {
                    @let total: usize = row.values().sum();
                    tr {
                        th scope="row" { (plain(hidden)) }
                        @for name in &names { @match row.get(*name) {
                            Some(count) => td.cell.right[*name == hidden] style={ "--share: " (format!("{:.2}", *count as f64 / total as f64)) } { (count) },
                            None => td {},
                        } }
                    }
                } }
            } }
            div.tools { button type="button" data-save-table="confusion-table" aria-label="Save CSV: what was taken for what" { "Save CSV" } }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_has_its_right_names_in_the_diagonal() {
        let row = |counts: &[(&str, usize)]| -> BTreeMap<String, usize> {
            let counts = counts.iter();
            counts
                .map(|(name, count)| ((*name).to_owned(), *count))
                .collect()
        };
        let matrix = BTreeMap::from([
            ("dry".to_owned(), row(&[("dry", 3), ("none of <b>", 1)])),
            ("lag_x".to_owned(), row(&[("dry", 2)])),
        ]);
        let html = confusion(&matrix).into_string();
        assert!(
            html.contains("<td class=\"cell right\" style=\"--share: 0.75\">3</td>"),
            "{html}"
        );
        assert!(html.contains("<td class=\"cell\" style=\"--share: 0.25\">1</td>"));
        assert!(html.contains("<td class=\"cell\" style=\"--share: 1.00\">2</td>"));
        assert!(html.contains("lag x") && html.contains("none of &lt;b&gt;"));
        // Nothing was named a lag: there are two columns and the rows' names.
        assert_eq!(html.matches("scope=\"col\"").count(), 3);
    }
}
