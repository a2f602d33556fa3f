//! This file is a table with a caption that can be saved as CSV.

use maud::{Markup, html};

/// A table; its first column names the rows. `id` is its anchor and the name of its file.
pub fn table(id: &str, caption: &str, head: &[&str], rows: &[Vec<String>]) -> Markup {
    let is_number: Vec<bool> = (0..head.len())
        .map(|column| {
            column > 0
                && rows
                    .iter()
                    .all(|row| row.get(column).is_none_or(|cell| starts_as_number(cell)))
        })
        .collect();
    let class = |column: usize| {
        is_number
            .get(column)
            .copied()
            .unwrap_or(false)
            .then_some("number")
    };
    // On a phone a table with sentences is one line a cell, each with its heading.
    let stacks = rows
        .iter()
        .flat_map(|row| row.iter().skip(1))
        .any(|cell| worded(cell) == Some("words"));
    html! {
        div.scroll tabindex="0" role="region" aria-label=(caption) {
            table.grid.stacks[stacks] #(id) {
                caption { (caption) }
                thead { tr { @for (column, name) in head.iter().enumerate() { th scope="col" class=[class(column)] { (name) } } } }
                tbody { @for row in rows { tr {
                    @for (column, cell) in row.iter().enumerate() {
                        @if column == 0 { th scope="row" { (cell) } } @else { td class=[class(column).or(worded(cell))] data-head=[head.get(column).filter(|_| stacks)] { (cell) } }
                    }
                } } }
            }
        }
        div.tools { button type="button" data-save-table=(id) aria-label={ "Save CSV: " (caption) } { "Save CSV" } }
    }
}

/// The class of a cell of words. Of a hash every letter may begin a line; a sentence keeps some width.
fn worded(cell: &str) -> Option<&'static str> {
    match cell {
        cell if cell.len() == 64 && cell.bytes().all(|byte| byte.is_ascii_hexdigit()) => {
            Some("sha")
        }
        cell => (cell.chars().count() > 30).then_some("words"),
    }
}

/// Whether a cell is to stand right: a number, or the dash for none.
fn starts_as_number(cell: &str) -> bool {
    let digits = cell.strip_prefix(['-', '−', '+']).unwrap_or(cell);
    cell == "–" || digits.starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_right_and_names_are_escaped() {
        let rows = [
            vec!["<a>".to_owned(), "−3.5".to_owned(), "x".to_owned()],
            vec!["b".to_owned(), "–".to_owned(), "7".to_owned()],
        ];
        let html = table("t", "What", &["name", "number", "word"], &rows).into_string();
        assert!(html.contains("&lt;a&gt;") && !html.contains("<a>"));
        assert_eq!(html.matches("class=\"number\"").count(), 3);
        let (hash, sentence) = ("0123abcd".repeat(8), "more than a few words that need room");
        let rows = [
            vec!["n".to_owned(), hash],
            vec!["m".to_owned(), sentence.to_owned()],
        ];
        let html = table("t", "What", &["name", "word"], &rows).into_string();
        assert!(
            html.contains("<td class=\"sha\" data-head=\"word\">0123")
                && html.contains("<td class=\"words\" data-head=\"word\">more"),
            "{html}"
        );
        assert!(html.contains("class=\"grid stacks\""), "{html}");
    }
}
