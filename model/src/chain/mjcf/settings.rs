//! This file says what a whole MJCF file sets: units of angles, the order of Euler angles, gravity, and default classes.

use super::super::xml::{Read, child, fault, number, numbers, values};
use super::WRITES_IT_OUT;
use nalgebra::Vector3;
use roxmltree::Node;
use std::collections::BTreeMap;

/// One of three turns of Euler angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub axis: Vector3<f64>,
    /// Whether the axis is that of the frame turned so far.
    pub moves_along: bool,
}

const XYZ: [Step; 3] = [
    Step::along(Vector3::new(1.0, 0.0, 0.0)),
    Step::along(Vector3::new(0.0, 1.0, 0.0)),
    Step::along(Vector3::new(0.0, 0.0, 1.0)),
];

impl Step {
    const fn along(axis: Vector3<f64>) -> Step {
        let moves_along = true;
        Step { axis, moves_along }
    }
}

/// The settings of a file.
pub(super) struct Settings<'a, 'i> {
    is_in_degrees: bool,
    pub sequence: [Step; 3],
    /// m/s².
    pub gravity: Vector3<f64>,
    /// Whether a body without numbers of its own gets those of its geoms.
    pub infers: bool,
    /// The elements of each class, the innermost first.
    classes: BTreeMap<&'a str, Vec<Node<'a, 'i>>>,
}

/// The class of what names none.
pub(super) const MAIN: &str = "main";

impl<'a, 'i> Settings<'a, 'i> {
    pub(super) fn of(root: Node<'a, 'i>) -> Read<Settings<'a, 'i>> {
        let mut settings = Settings {
            is_in_degrees: true,
            sequence: XYZ,
            gravity: Vector3::new(0.0, 0.0, -9.81),
            infers: true,
            classes: BTreeMap::from([(MAIN, Vec::new())]),
        };
        let mut defaults = None;
        for node in root.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "compiler" => settings.compiler(node)?,
                "option" => settings.option(node)?,
                "default" if defaults.is_some() => {
                    return fault(node, "a second `default`: put both into one".to_owned());
                }
                "default" => defaults = Some(node),
                _ => {}
            }
        }
        defaults.map_or(Ok(()), |node| settings.class(node, &[], MAIN))?;
        Ok(settings)
    }

    fn compiler(&mut self, node: Node<'a, 'i>) -> Read<()> {
        for own in node.attributes() {
            let (name, value) = (own.name(), own.value());
            match (name, value) {
                ("angle", "degree" | "radian") => self.is_in_degrees = value == "degree",
                ("angle", _) => {
                    let said = format!("`angle=\"{value}\"` is neither `degree` nor `radian`");
                    return fault(node, said);
                }
                ("eulerseq", _) => match sequence(value) {
                    Some(own) => self.sequence = own,
                    None => {
                        let said =
                            format!("`eulerseq=\"{value}\"` is not three of x, y, z, X, Y, Z");
                        return fault(node, said);
                    }
                },
                ("inertiafromgeom", "false") => self.infers = false,
                ("inertiafromgeom", "true") => {
                    let said = format!(
                        "`inertiafromgeom=\"true\"`: the inertias would be those of geoms; {WRITES_IT_OUT}"
                    );
                    return fault(node, said);
                }
                ("coordinate", "global") => {
                    return fault(node, "`coordinate=\"global\"` is not read".to_owned());
                }
                ("boundmass" | "boundinertia" | "settotalmass", _)
                    if number(node, name, None)? > 0.0 =>
                {
                    let said = format!(
                        "`{name}` changes the inertias that the file states; {WRITES_IT_OUT}"
                    );
                    return fault(node, said);
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn option(&mut self, node: Node<'a, 'i>) -> Read<()> {
        self.gravity = Vector3::from(numbers(node, "gravity", self.gravity.into())?);
        for name in ["density", "viscosity"] {
            if number(node, name, Some(0.0))? != 0.0 {
                let said = format!("`{name}`: an arm in a fluid is not read; take it out");
                return fault(node, said);
            }
        }
        for flag in node.children().filter(|own| own.has_tag_name("flag")) {
            for own in flag.attributes().filter(|own| own.value() == "disable") {
                match own.name() {
                    "gravity" => self.gravity = Vector3::zeros(),
                    "constraint" | "damper" | "frictionloss" | "passive" => {
                        let said = format!(
                            "`{}=\"disable\"` switches off friction that joints state: take it out",
                            own.name()
                        );
                        return fault(flag, said);
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// A class below others, and those in it.
    fn class(&mut self, node: Node<'a, 'i>, above: &[Node<'a, 'i>], name: &'a str) -> Read<()> {
        if above.len() > super::DEEPEST {
            return fault(node, "the classes lie too deep in one another".to_owned());
        }
        let own: Vec<Node<'a, 'i>> = [node].into_iter().chain(above.iter().copied()).collect();
        for inner in node.children().filter(|own| own.has_tag_name("default")) {
            match inner.attribute("class") {
                Some(name) => self.class(inner, &own, name)?,
                None => {
                    return fault(
                        inner,
                        "a `default` in another one needs a `class`".to_owned(),
                    );
                }
            }
        }
        match name != MAIN && self.classes.contains_key(name) {
            true => fault(node, format!("the class `{name}` stands twice")),
            false => {
                self.classes.insert(name, own);
                Ok(())
            }
        }
    }

    /// An attribute of an element, or of its class: that which it names, else `class`.
    pub(super) fn attribute(
        &self,
        node: Node<'a, 'i>,
        class: &str,
        name: &str,
    ) -> Read<Option<&'a str>> {
        if let Some(own) = node.attribute(name) {
            return Ok(Some(own));
        }
        let class = node.attribute("class").unwrap_or(class);
        let Some(classes) = self.classes.get(class) else {
            let known: Vec<&str> = self.classes.keys().copied().collect();
            let said = format!(
                "there is no class `{class}`; there are {}",
                known.join(", ")
            );
            return fault(node, said);
        };
        let tag = node.tag_name().name();
        let mut each = classes.iter().filter_map(|own| child(*own, tag));
        Ok(each.find_map(|own| own.attribute(name)))
    }

    /// The numbers of an attribute of an element or of its class.
    pub(super) fn numbers<const N: usize>(
        &self,
        node: Node<'a, 'i>,
        class: &str,
        name: &str,
        otherwise: [f64; N],
    ) -> Read<[f64; N]> {
        let text = self.attribute(node, class, name)?;
        text.map_or(Ok(otherwise), |text| values(node, name, text))
    }

    /// An angle as the file writes it, rad.
    pub(super) fn rad(&self, angle: f64) -> f64 {
        if self.is_in_degrees {
            angle.to_radians()
        } else {
            angle
        }
    }
}

fn sequence(text: &str) -> Option<[Step; 3]> {
    let each = text.chars().map(|own| {
        let axis = match own.to_ascii_lowercase() {
            'x' => Vector3::x(),
            'y' => Vector3::y(),
            'z' => Vector3::z(),
            _ => return None,
        };
        let moves_along = own.is_ascii_lowercase();
        Some(Step { axis, moves_along })
    });
    each.collect::<Option<Vec<Step>>>()?.try_into().ok()
}
