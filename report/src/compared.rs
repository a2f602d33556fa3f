//! This file is the page of a thesis run again: its statements beside what comes out here, with the pictures.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

use crate::document::{Document, Headline, Section, Tone};
use crate::table::table;

/// A statement of the text beside what comes out here, all in words.
pub struct Statement {
    /// Where the text states it.
    pub place: String,
    /// What it states.
    pub statement: String,
    /// What it says.
    pub stated: String,
    /// What comes out here.
    pub ours: String,
    /// How the two compare.
    pub verdict: &'static str,
    /// What decided, and the erratum or gap that accounts for a disagreement.
    pub because: String,
}

/// An experiment that was run again.
pub struct Again {
    /// Its number.
    pub id: String,
    /// Its title.
    pub title: String,
    /// What is done.
    pub what: String,
    /// Its statements.
    pub statements: Vec<Statement>,
    /// Its pictures: a name, and SVG.
    pub pictures: Vec<(String, String)>,
    /// The files with the numbers of its pictures.
    pub files: Vec<String>,
}

/// The page as HTML; `verdicts` are the words for agreement, disagreement and what cannot be compared, `unaccounted` the disagreements without an account.
pub fn page(experiments: &[Again], verdicts: [&'static str; 3], unaccounted: usize) -> String {
    let statements = || experiments.iter().flat_map(|own| &own.statements);
    let [agree, disagree, lost] =
        verdicts.map(|verdict| statements().filter(|own| own.verdict == verdict).count());
    let sentence = format!(
        "{agree} of {} statements of the text come out here as well, {disagree} {} not.",
        agree + disagree,
        if disagree == 1 { "does" } else { "do" }
    );
    let headline = Headline {
        tone: if unaccounted == 0 {
            Tone::Good
        } else {
            Tone::Doubt
        },
        badge: "The thesis, run again".to_owned(),
        paragraphs: vec![match unaccounted {
            0 => html! { "For each that does not, an erratum or a gap of the text accounts." },
            1 => html! { "One of those that do not has no account yet." },
            some => html! { (some) " of those that do not have no account yet." },
        }],
        cards: vec![
            [
                "Agree".to_owned(),
                agree.to_string(),
                "within the tolerance that each line states".to_owned(),
            ],
            [
                "Disagree".to_owned(),
                disagree.to_string(),
                format!("{unaccounted} without an account"),
            ],
            [
                "Cannot be compared".to_owned(),
                lost.to_string(),
                "the figure is lost".to_owned(),
            ],
        ],
        sentence,
    };
    let [_, against, _] = verdicts;
    let apart = Section {
        id: "disagree".to_owned(),
        heading: "Where they disagree".to_owned(),
        body: apart(experiments, against),
    };
    let sections = experiments.iter().map(|own| Section {
        id: format!("experiment-{}", own.id.replace('.', "-")),
        heading: format!("{} {}", own.id, own.title),
        body: experiment(own),
    });
    Document {
        title: format!("{} – the thesis, run again", headline.sentence),
        kind: "Reproduction",
        about: format!("{} experiments", experiments.len()),
        headline,
        sections: (disagree > 0)
            .then_some(apart)
            .into_iter()
            .chain(sections)
            .collect(),
        charts: Vec::new(),
        replay: None,
        served: None,
        footer: format!(
            "Written by rigproof {}. This page is one file: it loads nothing and sends nothing.",
            env!("CARGO_PKG_VERSION")
        ),
    }
    .to_html()
}

/// The statements that come out otherwise, all together.
fn apart(experiments: &[Again], verdict: &str) -> Markup {
    let row = |own: &Statement| {
        vec![
            own.place.clone(),
            own.statement.clone(),
            own.stated.clone(),
            own.ours.clone(),
            own.because.clone(),
        ]
    };
    let statements = experiments.iter().flat_map(|own| &own.statements);
    let rows: Vec<Vec<String>> = statements
        .filter(|own| own.verdict == verdict)
        .map(row)
        .collect();
    let caption = "What does not come out, and which erratum or gap accounts for it.";
    let head = ["place", "statement", "text", "here", "because"];
    table("disagree-table", caption, &head, &rows)
}

fn experiment(own: &Again) -> Markup {
    let row = |own: &Statement| {
        [
            &own.place,
            &own.statement,
            &own.stated,
            &own.ours,
            own.verdict,
            &own.because,
        ]
        .map(str::to_owned)
        .to_vec()
    };
    let rows: Vec<Vec<String>> = own.statements.iter().map(row).collect();
    let id = format!("statements-{}", own.id.replace('.', "-"));
    let caption = format!("Statements of the text beside ours, experiment {}.", own.id);
    html! {
        p { (own.what) }
        @if !rows.is_empty() { (table(&id, &caption, &["place", "statement", "text", "here", "verdict", "because"], &rows)) }
        @for (name, svg) in &own.pictures {
            @let source = format!("data:image/svg+xml;base64,{}", STANDARD.encode(svg));
            @let id = format!("{}-{name}", own.id);
            figure {
                img #(id) src=(source) alt={ "Picture " (name) " of experiment " (own.id) };
                div.tools { button type="button" data-save-picture=(id) aria-label={ "Save SVG: " (name) " of experiment " (own.id) } { "Save SVG" } }
            }
        }
        @if !own.files.is_empty() { p.soft { "Its numbers: " @for (k, file) in own.files.iter().enumerate() { @if k > 0 { ", " } code { (file) } } "." } }
    }
}
