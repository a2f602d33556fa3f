//! This file refuses what pulls at an arm beside its joints: constraints that close loops, tendons, and rotors of actuators.

use super::super::xml::{Read, fault};
use super::is_not_zero;
use super::settings::MAIN;
use super::tree::Tree;
use roxmltree::Node;
use std::collections::BTreeSet;

/// The kinds of element that constraints, tendons and actuators name.
const KINDS: [(&str, &[&str]); 4] = [
    ("joint", &["joint", "joint1", "joint2", "jointinparent"]),
    ("body", &["body", "body1", "body2"]),
    ("site", &["site", "site1", "site2"]),
    ("geom", &["geom", "sidesite"]),
];

impl<'a, 'i> Tree<'a, 'i> {
    /// Nothing but joints moves the bodies of the arm.
    pub(super) fn ties(&self, arm: &[usize]) -> Read<()> {
        let own = self.names(arm);
        let named = |node: Node<'a, 'i>| {
            let each = KINDS
                .iter()
                .flat_map(|(kind, keys)| keys.iter().map(move |key| (*kind, *key)));
            let mut each = each.filter_map(|(kind, key)| Some((kind, node.attribute(key)?)));
            each.find(|of| own.contains(of))
        };
        for section in self.root.children() {
            for node in section.children().filter(Node::is_element) {
                let name = node.attribute("name").unwrap_or("without a name");
                let said = match section.tag_name().name() {
                    "equality" if node.attribute("active") != Some("false") => {
                        named(node).map(|tied| constraint(node, name, tied))
                    }
                    "tendon" => node.descendants().find_map(named).map(|(kind, tied)| {
                        format!(
                            "the tendon {name} runs over {kind} `{tied}` of the arm, and tendons \
                             are not read: {OUT}"
                        )
                    }),
                    "actuator" => match named(node) {
                        Some(("joint", tied)) => self.rotor(node, name, tied)?,
                        _ => None,
                    },
                    _ => None,
                };
                if let Some(said) = said {
                    return fault(node, said);
                }
            }
        }
        Ok(())
    }

    /// What an actuator states that belongs to its joint.
    fn rotor(&self, node: Node<'a, 'i>, name: &str, joint: &str) -> Read<Option<String>> {
        for what in ["armature", "damping"] {
            let text = self.settings.attribute(node, MAIN, what)?;
            if text.is_some_and(is_not_zero) {
                return Ok(Some(format!(
                    "the actuator {name} has {what} of its own: write it, times the square of the \
                     gear, at joint `{joint}`"
                )));
            }
        }
        Ok(None)
    }

    /// What of the arm can be named, by kind.
    fn names(&self, arm: &[usize]) -> BTreeSet<(&'static str, &'a str)> {
        let each = arm.iter().map(|own| &self.bodies[*own]).flat_map(|own| {
            let body = [("body", own.node)].into_iter();
            let joints = own.joints.iter().map(|part| ("joint", part.node));
            let sites = own.sites.iter().map(|part| ("site", part.node));
            let geoms = own.geoms.iter().map(|part| ("geom", part.node));
            body.chain(joints).chain(sites).chain(geoms)
        });
        each.filter_map(|(kind, node)| Some((kind, node.attribute("name")?)))
            .collect()
    }
}

const OUT: &str = "take it out, or end the arm before it (`tip`)";

/// Why an arm has no such constraint.
fn constraint(node: Node<'_, '_>, name: &str, (kind, tied): (&str, &str)) -> String {
    let tag = node.tag_name().name();
    let why = match tag {
        "connect" | "weld" => "a loop is no serial arm",
        _ => "a joint that follows has no effort of its own",
    };
    format!("the constraint `{tag}` ({name}) ties {kind} `{tied}` of the arm, and {why}: {OUT}")
}
