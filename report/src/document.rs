//! This file is the page around everything: head, policy, style, scripts, data.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::chart::Chart;
use crate::replay::Replay;

const STYLE: [&str; 2] = [
    include_str!("../vendor/uplot/uPlot.min.css"),
    include_str!("../assets/page.css"),
];

/// The scripts in the order in which they run.
const SCRIPTS: [&str; 6] = [
    include_str!("../vendor/uplot/uPlot.iife.min.js"),
    include_str!("../assets/theme.js"),
    include_str!("../assets/save.js"),
    include_str!("../assets/chart.js"),
    include_str!("../assets/chart-svg.js"),
    include_str!("../assets/replay.js"),
];

/// What keeps a list of runs fresh; no other page holds it.
const LIVE: &str = include_str!("../assets/live.js");

/// Seconds after which a list of runs is asked for again where no script runs.
const AGAIN_S: u32 = 20;

/// Most sections whose names are all shown at the top.
const SECTIONS: usize = 12;

/// The mood of a headline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Nothing is wrong.
    Good,
    /// Something was found.
    Found,
    /// Something is open.
    Doubt,
    /// Something is wrong.
    Bad,
}

impl Tone {
    const fn class(self) -> &'static str {
        match self {
            Tone::Good => "verdict tone-good",
            Tone::Found => "verdict tone-found",
            Tone::Doubt => "verdict tone-doubt",
            Tone::Bad => "verdict tone-bad",
        }
    }
}

/// What stands at the top of a page.
pub struct Headline {
    /// Its mood.
    pub tone: Tone,
    /// A word or two above it.
    pub badge: String,
    /// The verdict in one sentence.
    pub sentence: String,
    /// What it means and what to do, a paragraph each.
    pub paragraphs: Vec<Markup>,
    /// Figures beside it: what, how much, and a remark.
    pub cards: Vec<[String; 3]>,
}

/// A part of a page with a heading.
pub struct Section {
    /// Its anchor, of letters and hyphens.
    pub id: String,
    /// Its heading.
    pub heading: String,
    /// Its content.
    pub body: Markup,
}

/// Everything a page says and shows.
pub struct Document {
    /// Title of the browser's window.
    pub title: String,
    /// What kind of page it is.
    pub kind: &'static str,
    /// What it is about.
    pub about: String,
    /// What stands at the top.
    pub headline: Headline,
    /// What follows, in its order.
    pub sections: Vec<Section>,
    /// The charts whose places the sections hold.
    pub charts: Vec<Chart>,
    /// What moves, where something does.
    pub replay: Option<Replay>,
    /// The line at the bottom.
    pub footer: String,
    /// How it is served; nothing for a page that stands by itself.
    pub served: Option<Served>,
}

/// How a page is served.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Served {
    /// As it is.
    Still,
    /// It asks whether something changed, and shows that. It holds an element `now` with the attribute `data-revision`, and one `news`.
    Live,
}

#[derive(Serialize)]
struct Data<'a> {
    charts: &'a [Chart],
    replay: Option<&'a Replay>,
}

impl Document {
    /// The page as HTML.
    pub fn to_html(&self) -> String {
        let style = STYLE.concat();
        let is_live = self.served == Some(Served::Live);
        let live = is_live.then_some(LIVE);
        let script: Vec<&str> = SCRIPTS.into_iter().chain(live).collect();
        let script = script.join("\n");
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(policy(&script, self.served));
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="referrer" content="no-referrer";
                    @if is_live { noscript { meta http-equiv="refresh" content=(AGAIN_S); } }
                    title { (self.title) }
                    link rel="icon" href="data:,";
                    style { (PreEscaped(style)) }
                }
                body {
                    a.skip href="#content" { "Skip to the content" }
                    header.top {
                        div { span.brand { "rigproof" } " " span.what { (self.kind) " · " (self.about) } }
                        button #theme type="button" { "Dark" }
                    }
                    main #content {
                        (self.headline.markup())
                        nav aria-label="Sections" { (self.contents()) }
                        @for section in &self.sections {
                            section #(section.id) aria-labelledby={ (section.id) "-heading" } {
                                h2 #{ (section.id) "-heading" } { (section.heading) }
                                (section.body)
                            }
                        }
                    }
                    footer { (self.footer) }
                    script #data type="application/json" { (PreEscaped(self.data())) }
                    script { (PreEscaped(&script)) }
                }
            }
        };
        // What a rig or a channel is called may hold what steers a terminal that the file is shown on.
        let shown = |letter: char| match letter {
            '\n' | '\t' => letter,
            '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
            _ if letter.is_control() => '\u{fffd}',
            _ => letter,
        };
        page.into_string().chars().map(shown).collect()
    }

    /// The way to every section; of many it is folded up.
    fn contents(&self) -> Markup {
        let links = html! { ul { @for section in &self.sections { li { a href={ "#" (section.id) } { (section.heading) } } } } };
        match self.sections.len() {
            0..=SECTIONS => links,
            many => html! { details { summary { (many) " sections" } (links) } },
        }
    }

    /// The data as JSON that cannot end its element, whatever names stand in it.
    fn data(&self) -> String {
        let data = Data {
            charts: &self.charts,
            replay: self.replay.as_ref(),
        };
        let text = serde_json::to_string(&data).unwrap_or_else(|_| "{\"charts\":[]}".to_owned());
        text.replace('<', "\\u003c")
    }
}

impl Headline {
    fn markup(&self) -> Markup {
        html! {
            div class=(self.tone.class()) {
                span.badge { (self.badge) }
                h1 { (self.sentence) }
                @for paragraph in &self.paragraphs { p { (paragraph) } }
            }
            @if !self.cards.is_empty() {
                dl.cards {
                    @for [what, figure, remark] in &self.cards {
                        div { dt { (what) } dd { (figure) small { (remark) } } }
                    }
                }
            }
        }
    }
}

/// Nothing is loaded, nothing is sent, and no script runs but the page's own; a page that is served may ask its own server.
fn policy(script: &str, served: Option<Served>) -> String {
    let form = if served.is_some() { "'self'" } else { "'none'" };
    let asks = match served {
        Some(Served::Live) => "connect-src 'self'; ",
        _ => "",
    };
    let hash = STANDARD.encode(Sha256::digest(script.as_bytes()));
    format!(
        "default-src 'none'; {asks}style-src 'unsafe-inline'; script-src 'sha256-{hash}'; img-src data:; base-uri 'none'; form-action {form}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_script_or_style_ends_its_element() {
        for text in STYLE.iter().chain(&SCRIPTS).chain(&[LIVE]) {
            let text = text.to_lowercase();
            assert!(
                !text.contains("</script") && !text.contains("</style") && !text.contains("<!--")
            );
        }
    }

    #[test]
    fn only_a_list_of_runs_may_ask_and_only_its_own_server() {
        let page = |served| {
            Document {
                title: "t".to_owned(),
                kind: "k",
                about: "a".to_owned(),
                headline: Headline {
                    tone: Tone::Good,
                    badge: "b".to_owned(),
                    sentence: "s".to_owned(),
                    paragraphs: Vec::new(),
                    cards: Vec::new(),
                },
                sections: Vec::new(),
                charts: Vec::new(),
                replay: None,
                footer: "f".to_owned(),
                served,
            }
            .to_html()
        };
        for served in [None, Some(Served::Still)] {
            let html = page(served);
            assert!(!html.contains("connect-src") && !html.contains("fetch("));
            assert!(!html.contains("http-equiv=\"refresh\""));
        }
        let live = page(Some(Served::Live));
        assert!(live.contains("connect-src 'self'; ") && live.contains("fetch('/state.json')"));
    }

    #[test]
    fn the_vendored_library_is_the_one_that_its_page_states() {
        let stated = include_str!("../vendor/uplot/README.md");
        let script = include_bytes!("../vendor/uplot/uPlot.iife.min.js");
        let style = include_bytes!("../vendor/uplot/uPlot.min.css");
        let licence = include_bytes!("../vendor/uplot/LICENSE");
        let hashed = |bytes: &[u8]| -> String {
            Sha256::digest(bytes)
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect()
        };
        for (name, bytes) in [
            ("uPlot.iife.min.js", &script[..]),
            ("uPlot.min.css", style),
            ("LICENSE", licence),
        ] {
            let line = format!("| `{name}` | {} |", hashed(bytes));
            assert!(stated.contains(&line), "{line}");
        }
        assert!(String::from_utf8_lossy(script).contains("(v1.6.32)"));
        assert!(stated.starts_with("# uPlot 1.6.32"));
    }
}
