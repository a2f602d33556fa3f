//! This file reads where sources cite an equation or a section, and the name of what obeys or witnesses it there.

use serde_json::{Value, json};

use super::equation::SECTION;
use super::repository::Source;

/// What stands under a citation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Code that obeys the equation.
    Code,
    /// A test that witnesses it.
    Test,
    /// A proof that does.
    Proof,
}

/// One line `//= thesis (5.36)`, or one of a section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Citation {
    /// The number of the equation, or that of the section after its sign.
    pub equation: String,
    /// What stands under it.
    pub kind: Kind,
    /// The file below the root.
    file: String,
    /// Its line, from one.
    line: usize,
    /// The function, or other item, that it stands on or in; `None` if there is none.
    item: Option<String>,
}

impl Citation {
    /// File, line and name.
    pub fn line_of_text(&self) -> String {
        let item = self.item.as_deref().unwrap_or("(no item)");
        format!("  {}:{}  {item}", self.file, self.line)
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        json!({ "file": self.file, "line": self.line, "item": self.item })
    }
}

/// The citations of a source, by line.
pub fn of(source: &Source) -> Vec<Citation> {
    let lines: Vec<&str> = source.text.lines().collect();
    let cited = lines.iter().enumerate().filter_map(|(index, line)| {
        let (equation, kind) = cited(line.trim())?;
        let kind = match kind.trim() {
            "" => Kind::Code,
            "test" => Kind::Test,
            "proof" => Kind::Proof,
            _ => return None,
        };
        Some(Citation {
            equation,
            kind,
            file: source.path.clone(),
            line: index + 1,
            item: item(&lines, index),
        })
    });
    cited.collect()
}

/// What a line cites, and the word after it.
fn cited(line: &str) -> Option<(String, &str)> {
    let rest = line.strip_prefix("//= thesis ")?;
    if let Some(section) = rest.strip_prefix("section ") {
        let (number, kind) = section.split_once(' ').unwrap_or((section, ""));
        return Some((format!("{SECTION}{number}"), kind));
    }
    let (equation, kind) = rest.strip_prefix('(')?.split_once(')')?;
    Some((equation.to_owned(), kind))
}

/// The item that the code under a citation begins, else the function that it stands in.
fn item(lines: &[&str], cited: usize) -> Option<String> {
    let below = lines.iter().skip(cited + 1);
    let code = below.map(|line| line.trim()).find(|line| {
        let skipped = line.is_empty() || line.starts_with("//") || line.starts_with("#[");
        !skipped
    });
    if let Some(name) = code.and_then(|line| named(line, &ITEMS)) {
        return Some(name);
    }
    let indent = |line: &str| line.len() - line.trim_start().len();
    let here = lines.get(cited).map_or(0, |line| indent(line));
    let above = lines.iter().take(cited).rev();
    let mut around = above.filter(|line| indent(line) < here);
    around.find_map(|line| named(line.trim(), &["fn"]))
}

/// What a line can begin.
const ITEMS: [&str; 6] = ["fn", "struct", "enum", "trait", "const", "static"];

/// The name after one of the words, if the line begins such an item.
fn named(line: &str, words: &[&str]) -> Option<String> {
    let mut parts = line.split_whitespace();
    let mut is_const = false;
    loop {
        let word = parts.next()?;
        let visibility = word == "pub" || word.starts_with("pub(") || word == "async";
        if words.contains(&word) && word != "const" {
            break;
        }
        // `const fn` is a function, `const NAME` a constant.
        if word == "const" && !is_const {
            is_const = true;
            continue;
        }
        if is_const && words.contains(&"const") {
            return Some(identifier(word));
        }
        if !visibility {
            return None;
        }
    }
    parts.next().map(identifier)
}

fn identifier(word: &str) -> String {
    let part = |c: &char| c.is_alphanumeric() || *c == '_';
    word.chars().take_while(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_citation_names_what_it_stands_on_or_in() {
        // The rules for citations hold for this file too, so its example is written with another sign.
        let source = "\
@ (5.36)
@ (5.37)
/// Words.
#[must_use]
pub const fn jacobian<const N: usize>(l: f64) -> f64 {
    let x = 1.0;
    if x > l {
        @ (5.1)
        return x;
    }
    l
}

@ (3.3)
pub(crate) const TABLE: [f64; 2] = [0.3, 0.7];

    #[test]
    @ (5.36) test
    fn it_is_so() {}
    @ (5.36) guess
    @ section 2.2.1 test
    fn it_is_told() {}
";
        let found = of(&Source {
            path: "model/src/a.rs".to_owned(),
            text: source.replace('@', "//= thesis"),
        });
        let names: Vec<(&str, Kind, usize, &str)> = found
            .iter()
            .map(|c| {
                (
                    c.equation.as_str(),
                    c.kind,
                    c.line,
                    c.item.as_deref().unwrap(),
                )
            })
            .collect();
        assert_eq!(
            names,
            [
                ("5.36", Kind::Code, 1, "jacobian"),
                ("5.37", Kind::Code, 2, "jacobian"),
                ("5.1", Kind::Code, 8, "jacobian"),
                ("3.3", Kind::Code, 14, "TABLE"),
                ("5.36", Kind::Test, 18, "it_is_so"),
                ("§2.2.1", Kind::Test, 21, "it_is_told"),
            ]
        );
    }
}
