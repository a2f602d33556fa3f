//! This file reads elements and numbers of XML, and says in which line one is wrong.

use roxmltree::{Document, Node};
use thiserror::Error;

/// Why the text of a model describes no arm.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {reason}")]
pub struct FormatError {
    /// The line of the text.
    pub line: u32,
    /// What is wrong there.
    pub reason: String,
}

pub(super) type Read<T> = Result<T, FormatError>;

/// Whether the text of a model is MJCF, by its outermost element; what is neither is taken for a URDF.
pub fn is_mjcf(text: &str) -> bool {
    Document::parse(text).is_ok_and(|own| own.root_element().has_tag_name("mujoco"))
}

pub(super) fn parsed(text: &str) -> Read<Document<'_>> {
    Document::parse(text).map_err(|error| FormatError {
        line: error.pos().row,
        reason: format!("this is no XML: {error}"),
    })
}

pub(super) fn fault<T>(at: Node<'_, '_>, reason: String) -> Read<T> {
    let line = at.document().text_pos_at(at.range().start).row;
    Err(FormatError { line, reason })
}

pub(super) fn child<'a, 'i>(of: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    of.children().find(|node| node.has_tag_name(name))
}

pub(super) fn number(node: Node<'_, '_>, what: &str, otherwise: Option<f64>) -> Read<f64> {
    match (node.attribute(what), otherwise) {
        (Some(text), _) => Ok(values::<1>(node, what, text)?[0]),
        (None, Some(value)) => Ok(value),
        (None, None) => fault(node, format!("`{what}` is missing")),
    }
}

pub(super) fn numbers<const N: usize>(
    node: Node<'_, '_>,
    what: &str,
    otherwise: [f64; N],
) -> Read<[f64; N]> {
    let text = node.attribute(what);
    text.map_or(Ok(otherwise), |text| values(node, what, text))
}

/// The numbers of an attribute; `node` is the element that a message names.
pub(super) fn values<const N: usize>(node: Node<'_, '_>, what: &str, text: &str) -> Read<[f64; N]> {
    let each = text.split_whitespace().map(str::parse::<f64>);
    let each: Vec<f64> = each
        .filter_map(Result::ok)
        .filter(|own| own.is_finite())
        .collect();
    let is_whole = each.len() == text.split_whitespace().count();
    match <[f64; N]>::try_from(each) {
        Ok(own) if is_whole => Ok(own),
        _ if N == 1 => fault(node, format!("`{what}=\"{text}\"` is no number")),
        _ => fault(node, format!("`{what}=\"{text}\"` is not {N} numbers")),
    }
}
