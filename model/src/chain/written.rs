//! This file writes other inertial numbers of links and other friction of joints into the text of a URDF, and leaves the rest of it as it is.

use super::Inertial;
use super::xml::{Read, child, parsed};
use roxmltree::Node;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

/// What a joint states beside its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated {
    /// Coulomb friction, N·m or N.
    pub friction: f64,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub damping: f64,
    /// Inertia of a rotor, kg·m² or kg: MJCF alone has a place for it.
    pub armature: f64,
}

/// What is to be written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Links and their numbers in the frame of the link.
    pub links: BTreeMap<String, Inertial>,
    /// Joints and what they state.
    pub joints: BTreeMap<String, Stated>,
    /// Lines of a comment at the head.
    pub said: Vec<String>,
}

impl Changes {
    /// The text of a URDF with these changes.
    ///
    /// # Errors
    /// The text is no XML.
    pub fn in_urdf(&self, text: &str) -> Read<String> {
        let document = parsed(text)?;
        let root = document.root_element();
        let mut edits: Vec<Edit> = Vec::new();
        for node in root.children().filter(|node| node.is_element()) {
            let name = node.attribute("name").unwrap_or_default();
            if let Some(own) = self.links.get(name).filter(|_| node.has_tag_name("link")) {
                edits.push(put(text, node, "inertial", &inertial(own)));
            }
            if let Some(own) = self.joints.get(name).filter(|_| node.has_tag_name("joint")) {
                edits.push(put(text, node, "dynamics", &friction(own)));
            }
        }
        Ok(self.edited(text, root, edits))
    }

    /// The text with the edits, and the lines at its head.
    pub(super) fn edited(&self, text: &str, root: Node<'_, '_>, mut edits: Vec<Edit>) -> String {
        if !self.said.is_empty() {
            // No comment holds two dashes.
            let lines = self.said.join("\n     ").replace("--", "- -");
            let start = root.range().start;
            edits.push((start..start, format!("<!-- {lines} -->\n")));
        }
        edits.sort_by_key(|(range, _)| range.start);
        let mut out = text.to_owned();
        for (range, with) in edits.into_iter().rev() {
            out.replace_range(range, &with);
        }
        out
    }
}

/// Where the text changes, and what stands there then.
pub(super) type Edit = (Range<usize>, String);

/// Where an element stands in another one, or may stand, and what is to stand there.
fn put(text: &str, node: Node<'_, '_>, name: &str, with: &str) -> Edit {
    if let Some(there) = child(node, name) {
        return (there.range(), with.to_owned());
    }
    let range = node.range();
    let own = text.get(range.clone()).unwrap_or_default();
    match own.strip_suffix("/>") {
        Some(open) => {
            let at = range.start + open.len();
            let tag = node.tag_name().name();
            (at..range.end, format!(">\n    {with}\n  </{tag}>"))
        }
        None => {
            let at = range.start + own.rfind("</").unwrap_or(own.len());
            (at..at, format!("  {with}\n  "))
        }
    }
}

fn inertial(own: &Inertial) -> String {
    let (centre, i) = (own.centre(), own.central());
    let mut text = format!(
        "<inertial>\n      <origin xyz=\"{} {} {}\" rpy=\"0 0 0\"/>\n      <mass value=\"{}\"/>\n",
        centre.x, centre.y, centre.z, own.mass
    );
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n    </inertial>",
        i.m11, i.m12, i.m13, i.m22, i.m23, i.m33
    );
    text
}

fn friction(own: &Stated) -> String {
    let Stated {
        friction, damping, ..
    } = own;
    format!("<dynamics damping=\"{damping}\" friction=\"{friction}\"/>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::Chain;

    const ARM: &str = include_str!("../../../rigs/arm.urdf");

    fn stated(friction: f64, damping: f64) -> Stated {
        Stated {
            friction,
            damping,
            armature: 0.0,
        }
    }

    #[test]
    fn what_is_written_is_read_again_and_the_rest_stays() {
        let arm = Chain::from_urdf(ARM, Some("fore")).unwrap();
        let mut own = arm.joints[1].inertial;
        own.mass *= 1.3;
        let changes = Changes {
            links: BTreeMap::from([("fore".to_owned(), own), ("base".to_owned(), own)]),
            joints: BTreeMap::from([
                ("elbow".to_owned(), stated(0.21, 0.034)),
                ("shoulder".to_owned(), stated(0.3, 0.0)),
            ]),
            said: vec!["made by a test -- of rounding".to_owned()],
        };
        let text = changes.in_urdf(ARM).unwrap();
        let again = Chain::from_urdf(&text, Some("fore")).unwrap();
        for (a, b) in again.joints[1].inertial.numbers().iter().zip(own.numbers()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let friction = again.joints.iter().map(|own| [own.friction, own.damping]);
        assert_eq!(friction.collect::<Vec<_>>(), [[0.3, 0.0], [0.21, 0.034]]);
        assert_eq!(again.joints[0].inertial, arm.joints[0].inertial);
        assert!(text.contains("<limit lower=\"-2.6\" upper=\"2.6\" effort=\"6\" velocity=\"6\"/>"));
        assert_eq!(Changes::default().in_urdf(ARM).unwrap(), ARM);
    }
}
