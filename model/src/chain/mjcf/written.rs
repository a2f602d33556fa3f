//! This file writes other inertial numbers of bodies and other friction and rotors of joints into the text of MJCF, and leaves the rest of it as it is.

use super::super::Inertial;
use super::super::written::{Changes, Edit, Stated};
use super::super::xml::{Read, parsed};
use super::tree::{Body, Part, Tree};
use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;

impl Changes {
    /// The text of MJCF with these changes.
    ///
    /// # Errors
    /// The text is no MJCF of an arm.
    pub fn in_mjcf(&self, text: &str) -> Read<String> {
        let document = parsed(text)?;
        let tree = Tree::of(document.root_element())?;
        let mut edits = Vec::new();
        for body in &tree.bodies {
            if let Some(own) = self.links.get(&body.name) {
                edits.extend(tree.inertial_of(body, own)?);
            }
            for joint in &body.joints {
                let name = joint.node.attribute("name").unwrap_or_default();
                if let Some(own) = self.joints.get(name) {
                    tree.stated_of(joint, own, &mut edits)?;
                }
            }
        }
        Ok(self.edited(text, tree.root, edits))
    }
}

impl<'a, 'i> Tree<'a, 'i> {
    /// The element of a body's inertial numbers, `own` those about its last joint.
    fn inertial_of(&self, body: &Body<'a, 'i>, own: &Inertial) -> Read<Vec<Edit>> {
        let last = body.joints.last().map(|joint| self.anchor(joint));
        let anchor = last.transpose()?.unwrap_or_else(Vector3::zeros);
        let own = own.seen_from(&Matrix3::identity(), &anchor);
        let (centre, i) = (own.centre(), own.central());
        let element = format!(
            "<inertial pos=\"{} {} {}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>",
            centre.x, centre.y, centre.z, own.mass, i.m11, i.m22, i.m33, i.m12, i.m13, i.m23
        );
        // A frame around it would turn it: it stands in the body itself.
        let start = body.node.first_child().map_or(0, |own| own.range().start);
        Ok(match &body.inertial {
            Some(there) if there.node.parent() == Some(body.node) => {
                vec![(there.node.range(), element)]
            }
            Some(there) => vec![(there.node.range(), String::new()), (start..start, element)],
            None => vec![(start..start, element)],
        })
    }

    /// The attributes of a joint that say something else so far.
    fn stated_of(&self, joint: &Part<'a, 'i>, own: &Stated, edits: &mut Vec<Edit>) -> Read<()> {
        let each = [
            ("damping", own.damping),
            ("frictionloss", own.friction),
            ("armature", own.armature),
        ];
        for (what, value) in each {
            if self.stated(joint, what)? != value {
                edits.push(attribute(joint.node, what, value));
            }
        }
        Ok(())
    }
}

fn attribute(node: Node<'_, '_>, what: &str, value: f64) -> Edit {
    match node.attribute_node(what) {
        Some(own) => (own.range_value(), value.to_string()),
        None => {
            let at = node.range().start + 1 + node.tag_name().name().len();
            (at..at, format!(" {what}=\"{value}\""))
        }
    }
}
