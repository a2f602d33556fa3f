//! This file says where an element of MJCF lies: its position, and its orientation in each of the ways to write one.

use super::super::dynamics::turned;
use super::super::xml::{Read, fault, numbers};
use super::settings::Settings;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use roxmltree::Node;

/// Where a frame lies in another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub turn: Matrix3<f64>,
    /// m.
    pub origin: Vector3<f64>,
}

impl Place {
    pub(super) fn none() -> Place {
        Place::at(Vector3::zeros())
    }

    pub(super) fn at(origin: Vector3<f64>) -> Place {
        let turn = Matrix3::identity();
        Place { turn, origin }
    }

    /// Where a frame lies that lies so in this one.
    pub(super) fn then(&self, next: &Place) -> Place {
        Place {
            turn: self.turn * next.turn,
            origin: self.origin + self.turn * next.origin,
        }
    }

    pub(super) fn of(node: Node<'_, '_>, settings: &Settings<'_, '_>) -> Read<Place> {
        Ok(Place {
            turn: turn(node, settings)?,
            origin: Vector3::from(numbers(node, "pos", [0.0; 3])?),
        })
    }
}

const WAYS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

fn turn(node: Node<'_, '_>, settings: &Settings<'_, '_>) -> Read<Matrix3<f64>> {
    let written: Vec<&str> = WAYS
        .into_iter()
        .filter(|own| node.has_attribute(*own))
        .collect();
    let way = match written[..] {
        [] => return Ok(Matrix3::identity()),
        [way] => way,
        _ => {
            let all = written.join("` and `");
            return fault(
                node,
                format!("the orientation stands twice, as `{all}`: write one"),
            );
        }
    };
    let direction = |vector: [f64; 3]| match Vector3::from(vector).try_normalize(1e-12) {
        Some(own) => Ok(own),
        None => fault(node, format!("`{way}` has no direction")),
    };
    match way {
        "quat" => {
            let [w, x, y, z] = numbers(node, way, [0.0; 4])?;
            match UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12) {
                Some(own) => Ok(own.to_rotation_matrix().into_inner()),
                None => fault(node, "`quat` has length 0".to_owned()),
            }
        }
        "axisangle" => {
            let [x, y, z, angle] = numbers(node, way, [0.0; 4])?;
            Ok(turned(&direction([x, y, z])?, settings.rad(angle)))
        }
        "euler" => {
            let angles: [f64; 3] = numbers(node, way, [0.0; 3])?;
            let each = settings.sequence.iter().zip(angles);
            Ok(each.fold(Matrix3::identity(), |before, (step, angle)| {
                let own = turned(&step.axis, settings.rad(angle));
                if step.moves_along {
                    before * own
                } else {
                    own * before
                }
            }))
        }
        "xyaxes" => {
            let [a, b, c, d, e, f] = numbers(node, way, [0.0; 6])?;
            let x = direction([a, b, c])?;
            let y = Vector3::new(d, e, f);
            let y = direction((y - x * x.dot(&y)).into())?;
            Ok(Matrix3::from_columns(&[x, y, x.cross(&y)]))
        }
        _ => {
            // The least turn that brings z there.
            let z = direction(numbers(node, way, [0.0; 3])?)?;
            let across = Vector3::z().cross(&z);
            let axis = across.try_normalize(1e-12).unwrap_or(Vector3::x());
            Ok(turned(&axis, libm::atan2(across.norm(), z.z)))
        }
    }
}
