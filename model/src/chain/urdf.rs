//! This file reads an arm from a URDF: the way from the root to a tip, links fixed to one another taken as one.

use super::xml::{Read, child, fault, number, numbers, parsed};
use super::{Chain, Inertial, Joint, Kind};
use nalgebra::{Matrix3, Rotation3, Vector3};
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};

/// Free fall along the base's z axis, m/s².
const FREE_FALL: f64 = 9.81;

/// A joint as written.
#[derive(Clone, Copy)]
struct Written<'a, 'i> {
    node: Node<'a, 'i>,
    name: &'a str,
    kind: &'a str,
    parent: &'a str,
    child: &'a str,
}

/// The tree of links as written.
struct Tree<'a, 'i> {
    links: BTreeMap<&'a str, Node<'a, 'i>>,
    /// The joint above each link.
    above: BTreeMap<&'a str, Written<'a, 'i>>,
    joints: Vec<Written<'a, 'i>>,
}

impl Chain {
    /// Reads an arm from the text of a URDF: from its root to the link `tip`, beyond which nothing is attached; without one to its only end.
    ///
    /// # Errors
    /// What the text lacks or cannot mean for a serial arm on a fixed base, with the line.
    pub fn from_urdf(text: &str, tip: Option<&str>) -> Read<Chain> {
        let document = parsed(text)?;
        let root = document.root_element();
        if !root.has_tag_name("robot") {
            return fault(
                root,
                format!(
                    "the outermost element is `{}`; a URDF has `robot`{}",
                    root.tag_name().name(),
                    if root.has_tag_name("mujoco") {
                        ": this is MJCF, say `mjcf` instead of `urdf`"
                    } else {
                        ""
                    }
                ),
            );
        }
        let tree = Tree::of(root)?;
        let tip = tree.tip(root, tip)?;
        let way = tree.way(tip);
        let mut chain = Chain {
            name: root.attribute("name").unwrap_or("arm").to_owned(),
            joints: Vec::new(),
            tip: Vector3::zeros(),
            gravity: Vector3::new(0.0, 0.0, -FREE_FALL),
        };
        // The frame of the last moving joint, in which the present link's frame lies.
        let mut offset = (Matrix3::identity(), Vector3::zeros());
        for own in &way {
            let (rotation, origin) = placed(own.node)?;
            offset = (offset.0 * rotation, offset.1 + offset.0 * origin);
            if own.kind != "fixed" {
                chain.joints.push(tree.joint(own, offset)?);
                offset = (Matrix3::identity(), Vector3::zeros());
            }
            if let Some(last) = chain.joints.last_mut() {
                let more = tree.fixed_to(own.child, offset, &way, tip)?;
                last.inertial = last.inertial.with(&more);
            }
        }
        chain.tip = offset.1;
        if chain.joints.is_empty() {
            return fault(
                root,
                format!("no joint moves between the root and the link `{tip}`"),
            );
        }
        tree.check(&chain)?;
        Ok(chain)
    }
}

impl<'a, 'i> Tree<'a, 'i> {
    fn of(root: Node<'a, 'i>) -> Read<Tree<'a, 'i>> {
        let named = |node: Node<'a, 'i>| match node.attribute("name") {
            Some(name) => Ok(name),
            None => fault(
                node,
                format!("a `{}` without a name", node.tag_name().name()),
            ),
        };
        let mut tree = Tree {
            links: BTreeMap::new(),
            above: BTreeMap::new(),
            joints: Vec::new(),
        };
        for node in root.children().filter(|node| node.has_tag_name("link")) {
            let name = named(node)?;
            if tree.links.insert(name, node).is_some() {
                return fault(node, format!("the link `{name}` stands twice"));
            }
        }
        for node in root.children().filter(|node| node.has_tag_name("joint")) {
            let name = named(node)?;
            let end = |side: &str| {
                let link = child(node, side).and_then(|end| end.attribute("link"));
                match link {
                    Some(link) if tree.links.contains_key(link) => Ok(link),
                    Some(link) => fault(
                        node,
                        format!("joint `{name}` names a {side} `{link}` that is no link"),
                    ),
                    None => fault(node, format!("joint `{name}` has no {side}")),
                }
            };
            let own = Written {
                node,
                name,
                kind: node.attribute("type").unwrap_or(""),
                parent: end("parent")?,
                child: end("child")?,
            };
            if let Some(other) = tree.above.insert(own.child, own) {
                return fault(
                    node,
                    format!(
                        "the link `{}` hangs on two joints, `{}` and `{name}`: a loop is no serial arm",
                        own.child, other.name
                    ),
                );
            }
            tree.joints.push(own);
        }
        Ok(tree)
    }

    fn tip(&self, root: Node<'a, 'i>, asked: Option<&str>) -> Read<&'a str> {
        for link in self.links.keys() {
            let mut seen = BTreeSet::from([*link]);
            let mut at = *link;
            while let Some(own) = self.above.get(at) {
                at = own.parent;
                if !seen.insert(at) {
                    return fault(
                        own.node,
                        format!("the joints around the link `{at}` make a loop: no serial arm"),
                    );
                }
            }
        }
        if let Some(asked) = asked {
            return match self.links.get_key_value(asked) {
                Some((name, _)) => Ok(name),
                None => fault(
                    root,
                    format!(
                        "there is no link `{asked}`; the last are {}",
                        self.ends().join(", ")
                    ),
                ),
            };
        }
        match self.ends()[..] {
            [end] => Ok(end),
            ref ends => fault(
                root,
                format!(
                    "the arm branches: say the `tip`, one of {}, or the link after which it ends",
                    ends.join(", ")
                ),
            ),
        }
    }

    fn ends(&self) -> Vec<&'a str> {
        let parents: BTreeSet<&str> = self.joints.iter().map(|own| own.parent).collect();
        let links = self.links.keys().copied();
        links.filter(|link| !parents.contains(link)).collect()
    }

    fn way(&self, tip: &str) -> Vec<Written<'a, 'i>> {
        let mut way = Vec::new();
        let mut at = tip;
        while let Some(own) = self.above.get(at) {
            way.push(*own);
            at = own.parent;
        }
        way.reverse();
        way
    }

    fn joint(
        &self,
        own: &Written<'a, 'i>,
        (rotation, origin): (Matrix3<f64>, Vector3<f64>),
    ) -> Read<Joint> {
        let kind = match own.kind {
            "revolute" | "continuous" => Kind::Revolute,
            "prismatic" => Kind::Prismatic,
            other => {
                return fault(
                    own.node,
                    format!(
                        "joint `{}` is `{other}`; a serial arm has revolute, continuous, prismatic and fixed ones",
                        own.name
                    ),
                );
            }
        };
        if let Some(mimic) = child(own.node, "mimic") {
            return fault(
                mimic,
                format!(
                    "joint `{}` follows another one (`mimic`): it has no effort of its own; end the arm before it (`tip`)",
                    own.name
                ),
            );
        }
        let axis = match child(own.node, "axis") {
            Some(node) => numbers(node, "xyz", [1.0, 0.0, 0.0])?,
            None => [1.0, 0.0, 0.0],
        };
        let axis = Vector3::from(axis);
        if axis.norm() < 1e-9 {
            return fault(
                own.node,
                format!("the axis of joint `{}` has no direction", own.name),
            );
        }
        let stated = |what: &str| -> Read<f64> {
            child(own.node, "dynamics").map_or(Ok(0.0), |node| number(node, what, Some(0.0)))
        };
        Ok(Joint {
            name: own.name.to_owned(),
            link: own.child.to_owned(),
            kind,
            rotation,
            origin,
            axis: axis.normalize(),
            inertial: Inertial::none(),
            own: match self.links.get(own.child) {
                Some(node) => inertial(*node, own.child)?,
                None => Inertial::none(),
            },
            damping: stated("damping")?,
            friction: stated("friction")?,
            armature: 0.0,
        })
    }

    /// The inertial numbers of a link and of all that is fixed to it off the way, seen from the frame in which it lies so.
    fn fixed_to(
        &self,
        link: &str,
        (rotation, origin): (Matrix3<f64>, Vector3<f64>),
        way: &[Written<'a, 'i>],
        tip: &str,
    ) -> Read<Inertial> {
        let mut sum = match self.links.get(link) {
            Some(node) => inertial(*node, link)?.seen_from(&rotation, &origin),
            None => Inertial::none(),
        };
        if link == tip {
            return Ok(sum);
        }
        for own in self.joints.iter().filter(|own| own.parent == link) {
            if way.iter().any(|step| step.name == own.name) {
                continue;
            }
            if own.kind != "fixed" {
                return fault(
                    own.node,
                    format!(
                        "joint `{}` moves beside the arm: a serial arm has none",
                        own.name
                    ),
                );
            }
            let (turned, moved) = placed(own.node)?;
            let frame = (rotation * turned, origin + rotation * moved);
            sum = sum.with(&self.fixed_to(own.child, frame, way, tip)?);
        }
        Ok(sum)
    }

    /// What moves has a mass, at the latest beyond it.
    fn check(&self, chain: &Chain) -> Read<()> {
        let last = chain.joints.last();
        let Some(joint) = last.filter(|joint| joint.inertial.mass == 0.0) else {
            return Ok(());
        };
        match self.links.get(joint.link.as_str()) {
            Some(node) => fault(
                *node,
                format!(
                    "the link `{}` has no `inertial`, and nothing beyond it has one",
                    joint.link
                ),
            ),
            None => Ok(()),
        }
    }
}

/// Where a joint or an inertial lies.
fn placed(node: Node<'_, '_>) -> Read<(Matrix3<f64>, Vector3<f64>)> {
    let Some(origin) = child(node, "origin") else {
        return Ok((Matrix3::identity(), Vector3::zeros()));
    };
    let [roll, pitch, yaw] = numbers(origin, "rpy", [0.0; 3])?;
    let xyz = numbers(origin, "xyz", [0.0; 3])?;
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    Ok((rotation.into_inner(), Vector3::from(xyz)))
}

fn inertial(link: Node<'_, '_>, name: &str) -> Read<Inertial> {
    let Some(node) = child(link, "inertial") else {
        let is_seen = ["visual", "collision"]
            .iter()
            .any(|part| child(link, part).is_some());
        if is_seen {
            return fault(
                link,
                format!(
                    "the link `{name}` has a body and no `inertial`: write its mass, centre and moments"
                ),
            );
        }
        return Ok(Inertial::none());
    };
    let need = |part: &str| match child(node, part) {
        Some(found) => Ok(found),
        None => fault(node, format!("the inertial of `{name}` has no `{part}`")),
    };
    let mass = number(need("mass")?, "value", None)?;
    let moments = need("inertia")?;
    let of = |what: &str| number(moments, what, None);
    let (xx, yy, zz) = (of("ixx")?, of("iyy")?, of("izz")?);
    let (xy, xz, yz) = (of("ixy")?, of("ixz")?, of("iyz")?);
    let (rotation, centre) = placed(node)?;
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let tensor = rotation * tensor * rotation.transpose();
    let own = Inertial::about_centre(mass, centre, tensor);
    match own.impossible(Inertial::ROUNDING) {
        Some(reason) => fault(node, format!("link `{name}`: {reason}")),
        None => Ok(own),
    }
}
