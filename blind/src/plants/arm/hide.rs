//! This file draws what an arm hides: friction and constants at its joints, other masses of a link, another torque constant, a rotor behind a gear.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::{At, Effect};
use crate::form::Form;
use crate::stratum::Stratum;
use std::f64::consts::TAU;

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

/// Physics of a joint in several forms, one of which may stand in place of what was drawn last.
const ELSE: &[&[Form]] = &[
    &[Form::Root, Form::Square, Form::Tanh],
    &[Form::Spring, Form::Anchored],
    &[Form::Ripple, Form::Toothed, Form::TwoOrders],
    &[Form::LoadShare, Form::LoadSided, Form::LoadSquare],
    &[Form::DahlPower, Form::MaxwellSlip, Form::ElastoPlastic],
];
/// How often it does.
const INSTEAD: f64 = 0.3;

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
    if !hidden.is_empty() && draw.chance(INSTEAD) {
        hidden.pop();
        let forms = ELSE
            .get(draw.below(ELSE.len()))
            .copied()
            .unwrap_or_default();
        let form = forms.get(draw.below(forms.len()));
        let joint = draw.below(joints);
        hidden.extend(form.and_then(|form| effect(setup, *form, joint, draw)));
    }
    hidden
}

fn effect(setup: &Setup, form: Form, joint: usize, draw: &mut Draw) -> Option<Effect> {
    let [effort, speed] = *setup.usual.get(joint)?;
    let link = setup.body.joints.get(joint)?.link;
    let level = effort * draw.log_uniform(0.06, 0.4);
    let swing = setup.paths.get(joint)?.swing();
    let yields = |draw: &mut Draw| swing * draw.log_uniform(0.002, 0.03);
    let period = |draw: &mut Draw| swing * draw.log_uniform(0.15, 1.5);
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
        Form::Root | Form::Square | Form::Tanh => [level, speed, 0.0],
        Form::Spring => [level / swing, 0.0, 0.0],
        Form::Anchored => [
            level / swing,
            draw.sign() * swing * draw.uniform(0.3, 2.0),
            0.0,
        ],
        Form::Ripple => {
            let (sine, cosine) = libm::sincos(draw.uniform(0.0, TAU));
            [level * sine, level * cosine, period(draw)]
        }
        Form::Toothed => [level, period(draw), draw.uniform(1.5, 4.0)],
        Form::TwoOrders => [level, period(draw), draw.uniform(0.3, 0.7)],
        Form::LoadShare => [draw.uniform(0.05, 0.3), 0.0, 0.0],
        Form::LoadSided => [draw.uniform(0.05, 0.3), draw.uniform(0.02, 0.15), 0.0],
        Form::LoadSquare => [level, effort, 0.0],
        Form::DahlPower => [level, yields(draw), draw.pick(&[0.5, 1.5, 2.0])],
        Form::MaxwellSlip => [level, 3.0 * yields(draw), 0.0],
        Form::ElastoPlastic => [level, yields(draw), draw.uniform(0.3, 0.8)],
        _ => [level, 0.0, 0.0],
    };
    Some(form.of(values).at(At::Arm(joint)))
}
