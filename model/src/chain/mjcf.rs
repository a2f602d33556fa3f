//! This file reads an arm from MJCF: the way from the world to a tip, with the inertias that the file states itself.

mod place;
mod settings;
mod ties;
mod tree;
mod written;

use super::dynamics::turned;
use super::xml::{Read, fault, is_mjcf, number, numbers, parsed};
use super::{Chain, Inertial, Joint, Kind};
use nalgebra::{Matrix3, Vector3};
use place::Place;
use tree::{Part, Tree};

/// The line that makes MuJoCo write out what its compiler infers.
const WRITES_IT_OUT: &str = "MuJoCo writes it out: python -c \"import mujoco; s = mujoco.MjSpec.from_file('arm.xml'); s.compiler.saveinertial = True; s.compile(); s.to_file('explicit.xml')\"";
/// How many elements may lie in one another.
const DEEPEST: usize = 256;

impl Chain {
    /// Reads an arm from the text of a model, by its outermost element of MJCF, else of a URDF.
    ///
    /// # Errors
    /// As those of the format.
    pub fn from_model(text: &str, tip: Option<&str>) -> Read<Chain> {
        match is_mjcf(text) {
            true => Chain::from_mjcf(text, tip),
            false => Chain::from_urdf(text, tip),
        }
    }

    /// Reads an arm from the text of MJCF: from the world to the body `tip`, beyond which nothing is attached, or to the body of the site `tip`; without one
    /// to its only end.
    ///
    /// Actuators are not read: an effort is that of a joint. What MuJoCo's compiler would infer is refused.
    ///
    /// # Errors
    /// What the text lacks, leaves to the compiler, or cannot mean for a serial arm on a fixed base, with the line.
    pub fn from_mjcf(text: &str, tip: Option<&str>) -> Read<Chain> {
        let document = parsed(text)?;
        let tree = Tree::of(document.root_element())?;
        let (end, at) = tree.tip(tip)?;
        // At a body the arm is cut, at a site of it is not.
        let cut = (tip == Some(tree.bodies[end].name.as_str())).then_some(end);
        let way = tree.way(end);
        let mut chain = Chain {
            name: tree.root.attribute("model").unwrap_or("arm").to_owned(),
            joints: Vec::new(),
            tip: Vector3::zeros(),
            gravity: tree.settings.gravity,
        };
        let mut arm = Vec::new();
        // Where the present body lies in the frame of the last moving joint.
        let mut offset = Place::none();
        for &body in &way {
            offset = offset.then(&tree.bodies[body].place);
            for (k, part) in tree.bodies[body].joints.iter().enumerate() {
                let is_last = k + 1 == tree.bodies[body].joints.len();
                let (joint, anchor) = tree.joint(part, &offset, is_last.then_some(body))?;
                chain.joints.push(joint);
                offset = Place::at(-anchor);
            }
            if let Some(last) = chain.joints.last_mut() {
                let more = tree.fixed_to(body, &offset, &way, cut, &mut arm)?;
                last.inertial = last.inertial.with(&more);
            }
        }
        chain.tip = offset.then(&at).origin;
        let Some(last) = chain.joints.last() else {
            let said = format!(
                "no joint moves between the world and `{}`",
                tree.bodies[end].name
            );
            return fault(tree.bodies[end].node, said);
        };
        if last.inertial.mass == 0.0 {
            let said = format!(
                "body `{}` has no `inertial`, and nothing beyond it has one",
                last.link
            );
            return fault(tree.bodies[end].node, said);
        }
        tree.ties(&arm)?;
        Ok(chain)
    }
}

impl<'a, 'i> Tree<'a, 'i> {
    /// A joint, and its anchor in the frame of its body. `body` is the one that it moves; without one a further joint comes between.
    fn joint(
        &self,
        part: &Part<'a, 'i>,
        offset: &Place,
        body: Option<usize>,
    ) -> Read<(Joint, Vector3<f64>)> {
        let node = part.node;
        let Some(name) = node.attribute("name") else {
            return fault(
                node,
                "a joint of the arm has no name: give it one".to_owned(),
            );
        };
        let kind = self.kind(part, name)?;
        let anchor = self.anchor(part)?;
        let axis = self
            .settings
            .numbers(node, part.class, "axis", [0.0, 0.0, 1.0])?;
        let axis = part.frame.turn * Vector3::from(axis);
        let Some(axis) = axis.try_normalize(1e-9) else {
            return fault(node, format!("the axis of joint `{name}` has no direction"));
        };
        let [reference] = self.settings.numbers(node, part.class, "ref", [0.0])?;
        let place = offset.then(&Place::at(anchor));
        let (rotation, origin) = match kind {
            Kind::Revolute => {
                let back = turned(&axis, -self.settings.rad(reference));
                (place.turn * back, place.origin)
            }
            Kind::Prismatic => (place.turn, place.origin - place.turn * axis * reference),
        };
        let own = body.map_or_else(|| Ok(Inertial::none()), |body| self.inertial(body))?;
        let joint = Joint {
            name: name.to_owned(),
            link: body.map_or_else(String::new, |own| self.bodies[own].name.clone()),
            kind,
            rotation,
            origin,
            axis,
            inertial: Inertial::none(),
            own: own.seen_from(&Matrix3::identity(), &-anchor),
            damping: self.stated(part, "damping")?,
            friction: self.stated(part, "frictionloss")?,
            armature: self.stated(part, "armature")?,
        };
        Ok((joint, anchor))
    }

    /// The anchor of a joint in the frame of its body, m.
    fn anchor(&self, part: &Part<'a, 'i>) -> Read<Vector3<f64>> {
        let pos = self
            .settings
            .numbers(part.node, part.class, "pos", [0.0; 3])?;
        Ok(part.frame.origin + part.frame.turn * Vector3::from(pos))
    }

    /// Whether a joint turns or slides, without a spring.
    fn kind(&self, part: &Part<'a, 'i>, name: &str) -> Read<Kind> {
        let text = |what: &str| self.settings.attribute(part.node, part.class, what);
        for what in ["stiffness", "springdamper"] {
            if text(what)?.is_some_and(is_not_zero) {
                let said = format!(
                    "joint `{name}` has a spring (`{what}`), which is not read: take it out"
                );
                return fault(part.node, said);
            }
        }
        match (part.node.tag_name().name(), text("type")?) {
            ("joint", None | Some("hinge")) => Ok(Kind::Revolute),
            ("joint", Some("slide")) => Ok(Kind::Prismatic),
            (tag, other) => {
                let other = other.unwrap_or(tag);
                let said =
                    format!("joint `{name}` is `{other}`; a serial arm has hinge and slide joints");
                fault(part.node, said)
            }
        }
    }

    /// Friction or a rotor that a joint states; 0 where it says nothing.
    fn stated(&self, part: &Part<'a, 'i>, what: &str) -> Read<f64> {
        let text = self.settings.attribute(part.node, part.class, what)?;
        let text = text.unwrap_or("0");
        let mut words = text.split_whitespace();
        let first = words.next().and_then(|own| own.parse::<f64>().ok());
        match first.filter(|own| own.is_finite() && *own >= 0.0) {
            // Further numbers are powers of the speed.
            Some(own) if !words.any(is_not_zero) => Ok(own),
            _ => {
                let said = format!("`{what}=\"{text}\"` is not one number of 0 or more");
                fault(part.node, said)
            }
        }
    }

    /// The inertial numbers of a body and of all that is fixed to it off the way, seen from the frame in which it lies so; `arm` gathers the bodies.
    fn fixed_to(
        &self,
        body: usize,
        at: &Place,
        way: &[usize],
        cut: Option<usize>,
        arm: &mut Vec<usize>,
    ) -> Read<Inertial> {
        arm.push(body);
        let mut sum = self.inertial(body)?.seen_from(&at.turn, &at.origin);
        if Some(body) == cut {
            return Ok(sum);
        }
        let inner = self.bodies.iter().enumerate();
        for (next, own) in
            inner.filter(|(next, own)| own.parent == Some(body) && !way.contains(next))
        {
            if let Some(joint) = own.joints.first() {
                let said = format!(
                    "joint `{}` moves beside the arm: a serial arm has none; end it before (`tip`), or take the joint out",
                    joint.node.attribute("name").unwrap_or("without a name")
                );
                return fault(joint.node, said);
            }
            sum = sum.with(&self.fixed_to(next, &at.then(&own.place), way, cut, arm)?);
        }
        Ok(sum)
    }

    /// The inertial numbers of a body alone, about its own frame.
    fn inertial(&self, body: usize) -> Read<Inertial> {
        let own = &self.bodies[body];
        let name = &own.name;
        if let Some(node) = own.unread {
            let said = format!(
                "`{}` in body `{name}` is not read; {WRITES_IT_OUT}",
                node.tag_name().name()
            );
            return fault(node, said);
        }
        if own.node.attribute("gravcomp").is_some_and(is_not_zero) {
            return fault(
                own.node,
                format!("body `{name}`: `gravcomp` is not read: take it out"),
            );
        }
        let Some(part) = &own.inertial else {
            for geom in own.geoms.iter().filter(|_| self.settings.infers) {
                if !self.is_without_mass(geom)? {
                    let said = format!(
                        "body `{name}` has geoms and no `inertial`, which is then inferred; {WRITES_IT_OUT}"
                    );
                    return fault(geom.node, said);
                }
            }
            return Ok(Inertial::none());
        };
        let node = part.node;
        let mass = number(node, "mass", None)?;
        let tensor = match (
            node.has_attribute("diaginertia"),
            node.has_attribute("fullinertia"),
        ) {
            (true, false) => {
                Matrix3::from_diagonal(&numbers(node, "diaginertia", [0.0; 3])?.into())
            }
            (false, true) => {
                let [xx, yy, zz, xy, xz, yz] = numbers(node, "fullinertia", [0.0; 6])?;
                Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
            }
            _ => {
                let said = format!(
                    "the inertial of `{name}` needs one of `diaginertia` and `fullinertia`"
                );
                return fault(node, said);
            }
        };
        let place = Place::of(node, &self.settings)?;
        let tensor = place.turn * tensor * place.turn.transpose();
        let own = Inertial::about_centre(mass, place.origin, tensor);
        match own.impossible(Inertial::ROUNDING) {
            Some(reason) => fault(node, format!("body `{name}`: {reason}")),
            None => Ok(own.seen_from(&part.frame.turn, &part.frame.origin)),
        }
    }

    /// Whether a geom adds nothing to the mass of its body.
    fn is_without_mass(&self, geom: &Part<'a, 'i>) -> Read<bool> {
        let of = |what: &str| self.settings.attribute(geom.node, geom.class, what);
        Ok(match of("mass")? {
            Some(mass) => !is_not_zero(mass),
            None => of("density")?.is_some_and(|own| !is_not_zero(own)),
        })
    }
}

/// Whether an attribute holds anything but zeros.
fn is_not_zero(text: &str) -> bool {
    text.split_whitespace().any(|own| own.parse() != Ok(0.0))
}

#[cfg(test)]
mod tests;
