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
                let tag = node.tag_name().name();
                let name = node.attribute("name").unwrap_or("without a name");
                let at = |tied: (&str, &str)| format!("{} `{}` of the arm", tied.0, tied.1);
                match section.tag_name().name() {
                    "equality" if node.attribute("active") != Some("false") => {
                        let Some(tied) = named(node) else { continue };
                        let what = match tag {
                            "connect" | "weld" => "a loop is no serial arm",
                            _ => "a joint that follows has no effort of its own",
                        };
                        let said = format!(
                            "the constraint `{tag}` ({name}) ties {}: {what}; take it out, or end the arm before it (`tip`)",
                            at(tied)
                        );
                        return fault(node, said);
                    }
                    "tendon" => {
                        let Some(tied) = node.descendants().find_map(named) else {
                            continue;
                        };
                        let said = format!(
                            "the tendon {name} runs over {}: tendons are not read; take it out, or end the arm before it (`tip`)",
                            at(tied)
                        );
                        return fault(node, said);
                    }
                    "actuator" => {
                        let Some(tied) = named(node).filter(|own| own.0 == "joint") else {
                            continue;
                        };
                        for what in ["armature", "damping"] {
                            let text = self.settings.attribute(node, MAIN, what)?;
                            if text.is_some_and(is_not_zero) {
                                let said = format!(
                                    "the actuator {name} has {what} of its own: write it, times the square of the gear, at {}",
                                    at(tied)
                                );
                                return fault(node, said);
                            }
                        }
                    }
                    _ => {}
                }
            }
        }
        Ok(())
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
