//! This file is the pages of a thesis run again: its statements beside what comes out here, with the pictures, a page a chapter and an index of them.

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

/// Experiments of a chapter, and the file of their page.
pub struct Chapter {
    /// Its name.
    pub name: String,
    /// The file of its page, beside the index.
    pub file: String,
    /// Its experiments.
    pub experiments: Vec<Again>,
}

/// The words for agreement, disagreement and what cannot be compared.
pub type Words = [&'static str; 3];

/// How many statements there are of each verdict.
fn counts<'a>(experiments: impl Iterator<Item = &'a Again>, verdicts: Words) -> [usize; 3] {
    let mut counts = [0; 3];
    for own in experiments.flat_map(|own| &own.statements) {
        let places = counts.iter_mut().zip(verdicts);
        places
            .filter(|(_, verdict)| own.verdict == *verdict)
            .for_each(|(count, _)| *count += 1);
    }
    counts
}

/// The page of one chapter, or of some experiments, as HTML; `unaccounted` are the disagreements without an account. `index` is a file that leads to the other chapters.
pub fn page(
    experiments: &[Again],
    verdicts: Words,
    unaccounted: usize,
    index: Option<&str>,
) -> String {
    let counted = counts(experiments.iter(), verdicts);
    let mut headline = headline(counted, unaccounted);
    headline
        .paragraphs
        .extend(index.map(|file| html! { a href=(file) { "All chapters" } }));
    let [_, against, _] = verdicts;
    let apart = (counted[1] > 0).then(|| apart(experiments.iter(), against));
    let sections = experiments.iter().map(|own| Section {
        id: anchor(&own.id),
        heading: format!("{} {}", own.id, own.title),
        body: experiment(own),
    });
    let sections = apart.into_iter().chain(sections).collect();
    document(headline, experiments.len(), sections)
}

/// The page that leads to the chapters, with what does not come out in any of them.
pub fn index(chapters: &[Chapter], verdicts: Words, unaccounted: usize) -> String {
    let experiments = || chapters.iter().flat_map(|own| &own.experiments);
    let counted = counts(experiments(), verdicts);
    let [_, against, _] = verdicts;
    let list = Section {
        id: "chapters".to_owned(),
        heading: "Chapters".to_owned(),
        body: listed(chapters, verdicts),
    };
    let apart = (counted[1] > 0).then(|| apart(experiments(), against));
    let sections = [list].into_iter().chain(apart).collect();
    document(
        headline(counted, unaccounted),
        experiments().count(),
        sections,
    )
}

/// The chapters with their counts, and each experiment with its page.
fn listed(chapters: &[Chapter], verdicts: Words) -> Markup {
    html! {
        div.scroll { table.grid #chapter-table {
            caption { "How many statements of the text come out here." }
            thead { tr { th scope="col" { "chapter" } @for verdict in verdicts { th.number scope="col" { (verdict) } } } }
            tbody { @for own in chapters { tr {
                th scope="row" { a href=(own.file) { (own.name) } }
                @for count in counts(own.experiments.iter(), verdicts) { td.number { (count) } }
            } } }
        } }
        @for own in chapters {
            h3 { (own.name) }
            ul { @for one in &own.experiments { li { a href={ (own.file) "#" (anchor(&one.id)) } { (one.id) " " (one.title) } } } }
        }
    }
}

fn anchor(id: &str) -> String {
    format!("experiment-{}", id.replace('.', "-"))
}

fn document(headline: Headline, experiments: usize, sections: Vec<Section>) -> String {
    Document {
        title: format!("{} – the thesis, run again", headline.sentence),
        kind: "Reproduction",
        about: format!("{experiments} experiments"),
        headline,
        sections,
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

fn headline([agree, disagree, lost]: [usize; 3], unaccounted: usize) -> Headline {
    let sentence = format!(
        "{agree} of {} statements of the text come out here as well, {disagree} {} not.",
        agree + disagree,
        if disagree == 1 { "does" } else { "do" }
    );
    let card =
        |what: &str, count: usize, remark: String| [what.to_owned(), count.to_string(), remark];
    Headline {
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
            card(
                "Agree",
                agree,
                "within the tolerance that each line states".to_owned(),
            ),
            card(
                "Disagree",
                disagree,
                format!("{unaccounted} without an account"),
            ),
            card("Cannot be compared", lost, "the figure is lost".to_owned()),
        ],
        sentence,
    }
}

/// The statements that come out otherwise, all together.
fn apart<'a>(experiments: impl Iterator<Item = &'a Again>, verdict: &str) -> Section {
    let row = |own: &Statement| {
        vec![
            own.place.clone(),
            own.statement.clone(),
            own.stated.clone(),
            own.ours.clone(),
            own.because.clone(),
        ]
    };
    let statements = experiments.flat_map(|own| &own.statements);
    let rows: Vec<Vec<String>> = statements
        .filter(|own| own.verdict == verdict)
        .map(row)
        .collect();
    let caption = "What does not come out, and which erratum or gap accounts for it.";
    let head = ["place", "statement", "text", "here", "because"];
    Section {
        id: "disagree".to_owned(),
        heading: "Where they disagree".to_owned(),
        body: table("disagree-table", caption, &head, &rows),
    }
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
