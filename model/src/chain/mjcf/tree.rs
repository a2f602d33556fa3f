//! This file is the tree of bodies of an MJCF file as written: places, joints, and what lies in each.

use super::super::xml::{Read, fault};
use super::place::Place;
use super::settings::{MAIN, Settings};
use super::{DEEPEST, WRITES_IT_OUT};
use nalgebra::Vector3;
use roxmltree::Node;
use std::collections::BTreeSet;

/// An element in a body.
pub(super) struct Part<'a, 'i> {
    pub node: Node<'a, 'i>,
    /// The class of what names none.
    pub class: &'a str,
    /// The frame around it, in that of the body.
    pub frame: Place,
}

/// A body.
pub(super) struct Body<'a, 'i> {
    pub node: Node<'a, 'i>,
    /// Its name, or its number where it has none.
    pub name: String,
    /// The body around it; none of the world.
    pub parent: Option<usize>,
    /// Its frame in that of its parent.
    pub place: Place,
    pub joints: Vec<Part<'a, 'i>>,
    pub geoms: Vec<Part<'a, 'i>>,
    pub sites: Vec<Part<'a, 'i>>,
    pub inertial: Option<Part<'a, 'i>>,
    /// An element that may hold more than is read here.
    pub unread: Option<Node<'a, 'i>>,
}

/// A file as written: the world is body 0.
pub(super) struct Tree<'a, 'i> {
    pub root: Node<'a, 'i>,
    pub settings: Settings<'a, 'i>,
    pub bodies: Vec<Body<'a, 'i>>,
}

impl<'a, 'i> Tree<'a, 'i> {
    pub(super) fn of(root: Node<'a, 'i>) -> Read<Tree<'a, 'i>> {
        if !root.has_tag_name("mujoco") {
            let tag = root.tag_name().name();
            let said = format!("the outermost element is `{tag}`; MJCF has `mujoco`");
            let instead = match root.has_tag_name("robot") {
                true => ": this is a URDF, say `urdf` instead of `mjcf`",
                false => "",
            };
            return fault(root, said + instead);
        }
        if let Some(node) = root.descendants().find(|own| own.has_tag_name("include")) {
            let said =
                format!("`include` is not read: the arm must stand in one file; {WRITES_IT_OUT}");
            return fault(node, said);
        }
        let mut tree = Tree {
            root,
            settings: Settings::of(root)?,
            bodies: Vec::new(),
        };
        tree.body(root, None, Place::none());
        for world in root.children().filter(|own| own.has_tag_name("worldbody")) {
            tree.inside(world, (0, MAIN, Place::none()), 0)?;
        }
        tree.check_names()?;
        Ok(tree)
    }

    fn body(&mut self, node: Node<'a, 'i>, parent: Option<usize>, place: Place) -> usize {
        let number = self.bodies.len();
        let name = node.attribute("name").filter(|_| parent.is_some());
        self.bodies.push(Body {
            node,
            name: name.map_or_else(|| format!("number {number}"), str::to_owned),
            parent,
            place,
            joints: Vec::new(),
            geoms: Vec::new(),
            sites: Vec::new(),
            inertial: None,
            unread: None,
        });
        number
    }

    /// Takes up what lies in an element: its body, the class of what names none, and its frame in that body.
    fn inside(
        &mut self,
        node: Node<'a, 'i>,
        (body, class, frame): (usize, &'a str, Place),
        depth: usize,
    ) -> Read<()> {
        if depth > DEEPEST {
            return fault(
                node,
                format!("more than {DEEPEST} bodies lie in one another"),
            );
        }
        let class = node.attribute("childclass").unwrap_or(class);
        for node in node.children().filter(Node::is_element) {
            let part = Part { node, class, frame };
            let Some(own) = self.bodies.get_mut(body) else {
                continue;
            };
            match node.tag_name().name() {
                "body" => {
                    let place = frame.then(&Place::of(node, &self.settings)?);
                    let inner = self.body(node, Some(body), place);
                    self.inside(node, (inner, class, Place::none()), depth + 1)?;
                }
                "frame" => {
                    let place = frame.then(&Place::of(node, &self.settings)?);
                    self.inside(node, (body, class, place), depth + 1)?;
                }
                "joint" | "freejoint" => own.joints.push(part),
                "geom" => own.geoms.push(part),
                "site" => own.sites.push(part),
                "inertial" if own.inertial.is_some() => {
                    return fault(node, format!("body `{}` has two `inertial`", own.name));
                }
                "inertial" => own.inertial = Some(part),
                "camera" | "light" => {}
                _ => own.unread = Some(node),
            }
        }
        Ok(())
    }

    fn check_names(&self) -> Read<()> {
        let mut seen = BTreeSet::new();
        let joints = self.bodies.iter().flat_map(|own| &own.joints);
        let joints = joints.map(|own| ("joint", own.node));
        let bodies = self.bodies.iter().skip(1).map(|own| ("body", own.node));
        for (what, node) in bodies.chain(joints) {
            let name = node.attribute("name");
            if name.is_some_and(|name| !seen.insert((what, name))) {
                let said = format!("the {what} `{}` stands twice", name.unwrap_or_default());
                return fault(node, said);
            }
        }
        Ok(())
    }

    /// The body in which the arm ends, and where its tip lies in it.
    pub(super) fn tip(&self, asked: Option<&str>) -> Read<(usize, Place)> {
        let ends = || {
            let ends = self.ends().into_iter();
            ends.map(|own| self.bodies[own].name.clone())
                .collect::<Vec<_>>()
        };
        let Some(asked) = asked else {
            return match self.ends()[..] {
                [end] => Ok((end, Place::none())),
                [] => fault(
                    self.root,
                    "no body moves on a fixed base: free bodies are no serial arm".to_owned(),
                ),
                _ => {
                    let ends = ends().join(", ");
                    let said = format!(
                        "the arm branches: say the `tip`, one of {ends}, or the body after which it ends"
                    );
                    fault(self.root, said)
                }
            };
        };
        let mut each = self.bodies.iter().enumerate().skip(1);
        if let Some((own, _)) = each.find(|(_, own)| own.name == asked) {
            return Ok((own, Place::none()));
        }
        for (body, own) in self.bodies.iter().enumerate() {
            let mut sites = own.sites.iter();
            let site = sites.find(|own| own.node.attribute("name") == Some(asked));
            if let Some(site) = site {
                if site.node.has_attribute("fromto") {
                    let said = format!("the site `{asked}` has `fromto`: give it a `pos`");
                    return fault(site.node, said);
                }
                let pos = self
                    .settings
                    .numbers(site.node, site.class, "pos", [0.0; 3])?;
                return Ok((body, site.frame.then(&Place::at(Vector3::from(pos)))));
            }
        }
        let ends = ends().join(", ");
        let said = format!("there is no body or site `{asked}`; the last bodies are {ends}");
        fault(self.root, said)
    }

    /// The last bodies that move, not freely; instead of one the only body that ends what is fixed to it.
    fn ends(&self) -> Vec<usize> {
        let is_free = |own: &Part<'_, '_>| {
            own.node.has_tag_name("freejoint") || own.node.attribute("type") == Some("free")
        };
        let bodies = || (1..self.bodies.len()).filter(|own| !self.joints_to(*own).any(is_free));
        let moving = || bodies().filter(|own| !self.bodies[*own].joints.is_empty());
        let beyond: BTreeSet<usize> = moving().filter_map(|own| self.bodies[own].parent).collect();
        let beyond: BTreeSet<usize> = beyond.into_iter().flat_map(|own| self.way(own)).collect();
        let last = moving().filter(|own| !beyond.contains(own));
        let parents: BTreeSet<usize> = bodies().filter_map(|own| self.bodies[own].parent).collect();
        let tail = |body: usize| {
            let on = bodies().filter(move |own| self.way(*own).contains(&body));
            let ends: Vec<usize> = on.filter(|own| !parents.contains(own)).collect();
            if let [end] = ends[..] { end } else { body }
        };
        last.map(tail).collect()
    }

    /// The joints from the world to a body.
    fn joints_to(&self, body: usize) -> impl Iterator<Item = &Part<'a, 'i>> {
        self.way(body)
            .into_iter()
            .flat_map(|own| &self.bodies[own].joints)
    }

    /// The bodies from below the world to one.
    pub(super) fn way(&self, end: usize) -> Vec<usize> {
        let up = |own: &usize| self.bodies[*own].parent;
        let mut way: Vec<usize> = core::iter::successors(Some(end), up)
            .filter(|own| *own > 0)
            .collect();
        way.reverse();
        way
    }
}
