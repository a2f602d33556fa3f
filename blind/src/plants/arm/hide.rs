//! This file draws what an arm hides: friction and constants at its joints, other masses of a link, another torque constant, a rotor behind a gear.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::{At, Effect};
use crate::form::Form;
use crate::stratum::Stratum;

/// What is hidden as one: at a joint, of a link, or at every joint with numbers of their own.
const KINDS: &[Kind] = &[
    Kind::At(Form::Coulomb),
    Kind::At(Form::Viscous),
    Kind::At(Form::Stribeck),
    Kind::At(Form::Bias),
    Kind::At(Form::Rotor),
    Kind::At(Form::Gain),
    Kind::At(Form::Skew),
    Kind::At(Form::LinkMass),
    Kind::Last(Form::Payload),
    Kind::Absent(Form::Coulomb),
    Kind::Everywhere(Form::Coulomb),
    Kind::Everywhere(Form::Viscous),
];

#[derive(Clone, Copy)]
enum Kind {
    At(Form),
    /// Of the last link.
    Last(Form),
    /// A friction that the description states and the arm does not have.
    Absent(Form),
    Everywhere(Form),
}

/// Draws the hidden effects of a stratum: one to three of different kinds.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let count = match stratum {
        Stratum::Single => 1,
        Stratum::Two => 2,
        Stratum::Three => 3,
        _ => 0,
    };
    let mut left: Vec<Kind> = KINDS.to_vec();
    let states = setup.body.joints.iter().any(|member| member.dry > 0.0);
    left.retain(|kind| states || !matches!(kind, Kind::Absent(_)));
    let joints = setup.body.joints.len();
    let mut hidden: Vec<Effect> = Vec::new();
    for _ in 0..count {
        let kind = left.swap_remove(draw.below(left.len()));
        let drawn: Vec<Effect> = match kind {
            Kind::At(form) => {
                let joint = draw.below(joints);
                effect(setup, form, joint, draw).into_iter().collect()
            }
            Kind::Last(form) => effect(setup, form, joints - 1, draw).into_iter().collect(),
            Kind::Absent(form) => {
                let joint = draw.below(joints);
                let stated = setup.body.joints.get(joint).map_or(0.0, |own| own.dry);
                vec![form.of([-stated]).at(At::Arm(joint))]
            }
            Kind::Everywhere(form) => (0..joints)
                .filter_map(|joint| effect(setup, form, joint, draw))
                .collect(),
        };
        let is_new = |own: &Effect| {
            !hidden
                .iter()
                .any(|at| at.form == own.form && at.at == own.at)
        };
        let drawn: Vec<Effect> = drawn.into_iter().filter(is_new).collect();
        hidden.extend(drawn);
    }
    hidden
}

fn effect(setup: &Setup, form: Form, joint: usize, draw: &mut Draw) -> Option<Effect> {
    let [effort, speed] = *setup.usual.get(joint)?;
    let link = setup.body.joints.get(joint)?.link;
    let level = effort * draw.log_uniform(0.06, 0.4);
    let values = match form {
        Form::Viscous => [level / speed, 0.0, 0.0],
        Form::Stribeck => [level, speed * draw.log_uniform(0.05, 0.3), 1.0],
        Form::Bias => [draw.sign() * level, 0.0, 0.0],
        Form::Gain => [draw.sign() * draw.uniform(0.05, 0.25), 0.0, 0.0],
        Form::LinkMass => [
            link.mass
                * if draw.chance(0.7) {
                    draw.uniform(0.1, 0.5)
                } else {
                    -draw.uniform(0.1, 0.3)
                },
            0.0,
            0.0,
        ],
        Form::Payload => [link.mass * draw.uniform(0.15, 0.8), 0.0, 0.0],
        Form::Skew => [draw.log_uniform(0.004, 0.02), 0.0, 0.0],
        Form::Rotor => [setup.inertia(joint) * draw.uniform(0.15, 0.6), 0.0, 0.0],
        _ => [level, 0.0, 0.0],
    };
    Some(form.of(values).at(At::Arm(joint)))
}
