//! This file is a stop, or a tether that is slack before it: nothing on one side of a position, a spring beyond it.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::JointStop,
    form: Form::Resistance(|p| {
        Box::new(Stop {
            stiffness: parameter(p, 0),
            position: parameter(p, 1),
            side: f64::signum(parameter(p, 2)),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a force that goes on changing with position on the free side",
    equation: "stiffness·(q − position) beyond the position, on the side of the sign of side; nothing before it",
    facts: Facts {
        usual: Usual::Rare,
        // What stops a joint seldom pushes back in proportion.
        has_forms: true,
        shapes: Shapes::Stop,
        ..Facts::of(
            Family::Position,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Joints,
            },
            Words {
                what: "a stop or a tether that pushes it back beyond a position",
                look_for: "a bumper, the end of the travel, a cable that becomes taut",
            },
        )
    },
};

struct Stop {
    stiffness: f64,
    position: f64,
    side: f64,
}

impl Law for Stop {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        let beyond = self.side * (now.position - self.position);
        self.stiffness * self.side * if beyond > 0.0 { beyond } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::{Instant, law};
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn it_pushes_back_on_its_side_alone() {
        let force = |position: f64, side: f64| {
            let law = law(Mechanism::JointStop, &[3.7, 0.2, side]).unwrap();
            law.smooth(
                &Instant {
                    time_s: 0.0,
                    position,
                    speed: 0.3,
                    sense: 1.0,
                },
                0.0,
            )
        };
        assert_eq!((force(0.19, 1.0), force(0.21, -1.0)), (0.0, 0.0));
        assert!((force(0.3, 1.0) - 0.37).abs() < 1e-12);
        assert!((force(-0.1, -1.0) + 1.11).abs() < 1e-12);
    }
}
