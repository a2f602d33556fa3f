//! This file says that the pages which a newcomer reads stay short.

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, texts};

/// The most words of such a page.
const MOST_WORDS: usize = 900;

/// Whether somebody who has never seen the project is led to a page. Pages that are printed from the code, and those of one room, are longer.
fn is_for_newcomers(path: &str) -> bool {
    const PAGES: [&str; 8] = [
        "README.md",
        "impl/README.md",
        "docs/architecture.md",
        "docs/diagnosis.md",
        "docs/limits.md",
        "docs/recordings.md",
        "docs/results.md",
        "docs/style.md",
    ];
    PAGES.contains(&path) || path.starts_with("docs/guide/src/") && path.ends_with(".md")
}

fn too_long(text: &Text) -> Option<String> {
    let words = text.content.split_whitespace().count();
    let is_too_long = is_for_newcomers(&text.path) && words > MOST_WORDS;
    is_too_long.then(|| {
        format!(
            "{}: {words} words, at most {MOST_WORDS}: say less, or move a part to a page of its own",
            text.path
        )
    })
}

#[test]
fn a_page_for_newcomers_is_short() {
    let all = texts();
    let seen = all.iter().filter(|text| is_for_newcomers(&text.path));
    assert!(seen.count() > 12);
    assert_tidy("long pages", all.iter().filter_map(too_long).collect());
}

#[test]
fn a_long_page_is_noticed() {
    let page = |path: &str, words: usize| Text {
        path: path.to_owned(),
        content: "word ".repeat(words),
    };
    assert!(too_long(&page("docs/limits.md", 901)).is_some());
    assert!(too_long(&page("docs/limits.md", 900)).is_none());
    assert!(too_long(&page("docs/rules.md", 9000)).is_none());
}
