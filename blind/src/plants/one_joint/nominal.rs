//! This file says which physics the nominal model already has.

use super::setup::{Kind, Setup};
use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::Form;

/// Draws the laws of the nominal model, true in the plant; nothing hidden is among them.
pub fn draw(setup: &Setup, hidden: &[Effect], draw: &mut Draw) -> Vec<Effect> {
    // A number that is stated as known may be wrong: then its own law is hidden besides.
    let hides = |name: &str| !setup.known && hidden.iter().any(|law| law.name() == name);
    let asymmetry = hidden.iter().find(|law| law.form == Form::Asymmetric);
    let asymmetry = asymmetry.map(|law| {
        let [dry, viscous, ..] = law.values;
        (dry != 0.0, viscous != 0.0)
    });
    let (needs_dry, needs_viscous) = asymmetry.unwrap_or((false, false));
    let may_dry = !hides(setup.dry.name());
    let may_viscous = !hides(setup.viscous.name());
    // Asymmetry and bias are one and the same shift of dry friction, so one is never nominal when the other is hidden.
    let may_bias = asymmetry.is_none() && !hides(setup.bias.name());
    let damper = matches!(setup.kind, Kind::Bench(None));
    let (dry_chance, viscous_chance, bias_chance) = match setup.kind {
        Kind::Axis(_) => (0.6, 0.6, 0.0),
        Kind::Bench(None) => (1.0, 0.5, 0.3),
        Kind::Bench(Some(_)) => (0.0, 0.4, 0.0),
    };
    let (dry, viscous, bias) = (
        draw.chance(dry_chance),
        draw.chance(viscous_chance) || (damper && !may_dry),
        draw.chance(bias_chance),
    );
    let mut laws = Vec::new();
    if may_viscous && (viscous || needs_viscous) {
        laws.push(setup.viscous);
    }
    if may_dry && (dry || needs_dry) {
        laws.push(setup.dry);
    }
    if may_bias && bias {
        laws.push(setup.bias);
    }
    laws
}
