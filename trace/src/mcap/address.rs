//! This file is the address of a number in a recording: `topic.field[index]` or `topic.field[name=joint_a]`.

use super::flat::{Leaf, Step};

/// A part of an address after the topic.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Field(String),
    Index(usize),
    /// The element at the position where the list of texts `list`, beside this one, holds `text`.
    Named {
        list: String,
        text: String,
    },
}

/// The way from a message to one number in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Way(Vec<Part>);

impl Way {
    /// Reads what follows the topic: fields separated by points, each with brackets; quotes hold a field whose name
    /// has points, brackets or blanks.
    pub(super) fn parse(text: &str) -> Option<Way> {
        let mut parts = Vec::new();
        let mut rest = text;
        loop {
            let (field, after) = match rest.strip_prefix('"') {
                Some(quoted) => quoted.split_once('"')?,
                None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
            };
            if field.is_empty() {
                return None;
            }
            parts.push(Part::Field(field.to_string()));
            rest = after;
            while let Some(inside) = rest.strip_prefix('[') {
                let (inside, after) = inside.split_once(']')?;
                parts.push(bracket(inside)?);
                rest = after;
            }
            match rest.strip_prefix('.') {
                Some(next) => rest = next,
                None => return rest.is_empty().then_some(Way(parts)),
            }
        }
    }

    /// The way to a field of the message itself, whatever its name.
    pub(super) fn field(name: &str) -> Way {
        Way(vec![Part::Field(name.to_string())])
    }

    /// The same way with a field after it.
    pub(super) fn then(&self, field: &str) -> Way {
        let mut parts = self.0.clone();
        parts.push(Part::Field(field.to_string()));
        Way(parts)
    }

    /// The field of the message that it begins with.
    pub(super) fn first(&self) -> Option<&str> {
        match self.0.first() {
            Some(Part::Field(name)) => Some(name),
            _ => None,
        }
    }

    /// Whether it leads to this number.
    pub(super) fn leads_to(&self, leaf: &Leaf) -> bool {
        self.0.len() == leaf.path.len()
            && self
                .0
                .iter()
                .zip(&leaf.path)
                .enumerate()
                .all(|(at, pair)| match pair {
                    (Part::Field(wanted), Step::Field(name)) => wanted == name,
                    (Part::Index(wanted), Step::Index(index)) => wanted == index,
                    (Part::Named { list, text }, Step::Index(_)) => leaf
                        .labels
                        .iter()
                        .any(|(step, l, t)| *step == at && l == list && t == text),
                    _ => false,
                })
    }

    /// How many elements of a list have to be looked into to follow it.
    pub(super) fn elements(&self) -> usize {
        let deepest = self.0.iter().map(|part| match part {
            Part::Index(index) => index.saturating_add(1),
            Part::Named { .. } => NAMED_ELEMENTS,
            Part::Field(_) => 0,
        });
        deepest.max().unwrap_or(0)
    }
}

/// Elements among which a name is looked for.
const NAMED_ELEMENTS: usize = 1024;

fn bracket(inside: &str) -> Option<Part> {
    match inside.split_once('=') {
        Some((list, text)) => Some(Part::Named {
            list: list.trim().to_string(),
            text: text.trim().to_string(),
        }),
        None => inside.trim().parse().ok().map(Part::Index),
    }
}

/// What follows the topic in an address, or `None` when it is of another topic. The slash that many topics begin
/// with may be left out.
pub(super) fn within<'a>(address: &'a str, topic: &str) -> Option<&'a str> {
    let behind = |topic: &str| address.strip_prefix(topic)?.strip_prefix('.');
    behind(topic).or_else(|| behind(topic.strip_prefix('/')?))
}

/// The address of a number, by name where a list of texts gives one.
pub(super) fn print(topic: &str, leaf: &Leaf) -> String {
    let mut text = topic.to_string();
    for (at, step) in leaf.path.iter().enumerate() {
        match step {
            Step::Field(name) if name.contains(['.', '[', ']', ' ']) => {
                text.push_str(&format!(".\"{name}\""));
            }
            Step::Field(name) => text.push_str(&format!(".{name}")),
            Step::Index(index) => {
                let label = leaf.labels.iter().find(|(step, list, name)| {
                    *step == at && list.contains("name") && !name.contains(']')
                });
                text.push_str(&match label {
                    Some((_, list, name)) => format!("[{list}={name}]"),
                    None => format!("[{index}]"),
                });
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leaf() -> Leaf {
        Leaf {
            path: vec![Step::Field("position".into()), Step::Index(2)],
            labels: vec![(1, "name".into(), "elbow".into())],
        }
    }

    #[test]
    fn a_number_is_found_by_its_index_and_by_its_name() {
        for (text, expected) in [
            ("position[2]", true),
            ("position[name=elbow]", true),
            ("\"position\"[2]", true),
            ("position[1]", false),
            ("position[name=wrist]", false),
            ("position", false),
            ("position[2].x", false),
        ] {
            let way = Way::parse(text).unwrap();
            assert_eq!(way.leads_to(&leaf()), expected, "{text}");
        }
        assert_eq!(print("/arm", &leaf()), "/arm.position[name=elbow]");
    }

    #[test]
    fn what_is_no_address_is_none() {
        for text in ["", "a..b", "a[", "a[x]", "a]b[1]", "a[1]b", "\"a"] {
            let way = Way::parse(text);
            assert!(way.is_none_or(|way| !way.leads_to(&leaf())), "{text}");
        }
        assert_eq!(within("/arm.position[2]", "/arm"), Some("position[2]"));
        assert_eq!(within("arm.position[2]", "/arm"), Some("position[2]"));
        assert_eq!(within("/armature.x", "/arm"), None);
    }
}
