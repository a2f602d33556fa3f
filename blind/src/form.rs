//! This file lists the forms that hidden physics takes: one row a form, with its mechanism, where it acts, its numbers and its source.

use rigproof_spec::effect::Quantity;

/// Where in the machine a form acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// A force at a joint.
    Joint,
    /// Ahead of the mechanism, in the drive or in the brake.
    Drive,
    /// In masses, lengths and springs between bodies; it has no force of its own in the books.
    Body,
    /// A field of force in which the whole stands.
    Field,
    /// In what the sensors and the recorder show.
    Sensor,
}

/// One number of a form.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    /// The vocabulary's name where it has the same number; empty where the answer does not tell it.
    pub name: &'static str,
    pub quantity: Quantity,
    /// Whether it grows with the effect's strength, the shape kept.
    pub strong: bool,
}

/// What is known of a form.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// The vocabulary's name of the mechanism, or this room's where there is none.
    pub mechanism: &'static str,
    pub stage: Stage,
    pub values: &'static [Value],
}

/// Rows of `Form: "mechanism", Stage, [values]`; a value with `*` grows with the strength, one with `-` keeps the shape.
macro_rules! forms {
    ($($(#[$doc:meta])* $form:ident: $mechanism:literal, $stage:ident, [$($mark:tt $value:literal $quantity:ident),*];)*) => {
        /// A law in one form.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Form { $($(#[$doc])* $form,)* }

        impl Form {
            /// Every form.
            #[cfg(test)]
            pub const ALL: &[Form] = &[$(Form::$form,)*];

            /// What is known of the form.
            pub const fn facts(self) -> Facts {
                match self {
                    $(Form::$form => Facts {
                        mechanism: $mechanism,
                        stage: Stage::$stage,
                        values: const { &[$(Value {
                            name: $value,
                            quantity: Quantity::$quantity,
                            strong: forms!(@ $mark),
                        }),*] },
                    },)*
                }
            }
        }
    };
    (@ *) => { true };
    (@ -) => { false };
}

forms! {
    /// Coulomb friction: a set at rest, `level` in motion (Coulomb 1785).
    Coulomb: "dry_offset", Joint, [*"level" Effort];
    /// Linear damping (Reynolds 1886).
    Viscous: "viscous", Joint, [*"coefficient" EffortPerSpeed];
    /// Dry friction or damping of a bearing at a joint without a brake.
    Bearing: "bearing_friction", Joint, [*"dry" Effort, *"viscous" EffortPerSpeed];
    /// `dry` more and `viscous` steeper forward, as much less backward (Armstrong-Hélouvry, Dupont and Canudas de Wit 1994).
    Asymmetric: "direction_asymmetry", Joint, [*"dry" Effort, *"viscous" EffortPerSpeed];
    /// `peak·exp(−|v/speed|^exponent)` (Tustin 1947: 1; Bo and Pavelescu 1982: 2).
    Stribeck: "stribeck", Joint, [*"peak" Effort, -"speed" Speed, -"exponent" Number];
    /// `peak/(1 + (v/speed)²)` (Hess and Soom 1990).
    Rational: "stribeck", Joint, [*"peak" Effort, -"speed" Speed];
    /// Tustin's peak carried by a bristle: it comes back over `memory` of travel (Canudas de Wit et al. 1995).
    Travelled: "stribeck", Joint, [*"peak" Effort, -"speed" Speed, -"memory" Travel];
    /// The bristle of LuGre whose level `peak·exp(−(v/speed)²)` is gone at speed (Canudas de Wit, Olsson, Åström and Lischinsky 1995).
    Lugre: "stribeck", Joint, [*"peak" Effort, -"speed" Speed, -"exponent" Number, -"" EffortPerTravel];
    /// `dz/dq = (level − z·sgn v)/travel` (Dahl 1968).
    Dahl: "presliding", Joint, [*"level" Effort, -"travel" Travel];
    /// `dz/dq = level/travel·(1 − z·sgn v/level)^exponent` (Dahl 1976, Bliman 1992).
    DahlPower: "presliding", Joint, [*"level" Effort, -"yield_travel" Travel, -"dahl_exponent" Number];
    /// LuGre's bristle of a constant level with damping of its own, s (Canudas de Wit et al. 1995).
    Bristle: "presliding", Joint, [*"level" Effort, -"yield_travel" Travel, -"bristle_damping" Time];
    /// A spring that begins to creep at a share of its level (Dupont, Hayward, Armstrong and Altpeter 2002).
    ElastoPlastic: "presliding", Joint, [*"level" Effort, -"yield_travel" Travel, -"elastic_share" Number];
    /// Six elements side by side, the last one yielding after `last_yield` (Iwan 1966; Al-Bender, Lampaert and Swevers 2005).
    MaxwellSlip: "presliding", Joint, [*"level" Effort, -"last_yield" Travel];
    /// The same with another limit in each direction.
    OneSided: "asymmetric_presliding", Joint, [*"forward" Effort, *"backward" Effort, -"last_yield" Travel];
    /// `dz/dq = alpha − beta_gamma·z·sgn v − beta_delta·|z|` (Bouc 1967, Wen 1976).
    BoucWen: "hysteresis", Joint, [*"alpha" EffortPerTravel, -"beta_gamma" PerTravel, -"beta_delta" PerTravel];
    /// `level·(v/speed)²`: turbulent drag.
    Square: "velocity_power", Joint, [*"level" Effort, -"speed" Speed];
    /// `level·√(v/speed)`: a porous or shear-thinning film (Ostwald 1925, index one half).
    Root: "velocity_power", Joint, [*"level" Effort, -"speed" Speed];
    /// `level·(v/speed)^exponent`: a shear-thickening film (Ostwald 1925).
    Power: "velocity_power", Joint, [*"level" Effort, -"speed" Speed, -"exponent" Number];
    /// `level·tanh(v/speed)`: drag that saturates (Andersson, Söderberg and Björklund 2007).
    Tanh: "velocity_power", Joint, [*"level" Effort, -"speed" Speed];
    /// A constant (a string, a preload).
    Bias: "constant_bias", Joint, [*"level" Effort];
    /// A constant that grows with time.
    Drift: "bias_drift", Joint, [*"rate" EffortPerTime];
    /// A constant that creeps to its end: `level·(1 − exp(−t/time))`.
    Creep: "bias_drift", Joint, [*"level" Effort, -"time" Time];
    /// Linear spring about the start.
    Spring: "spring", Joint, [*"stiffness" EffortPerTravel];
    /// Linear spring about a place of its own.
    Anchored: "spring", Joint, [*"stiffness" EffortPerTravel, -"anchor" Travel];
    /// A tether that is slack on this side of a place and a spring beyond it, on the side of its sign.
    Tether: "joint_stop", Joint, [*"stiffness" EffortPerTravel, -"beyond" Travel];
    /// Cubic spring about the start (Duffing 1918).
    Cubic: "nonlinear_spring", Joint, [*"cubic" EffortPerCubicTravel];
    /// A spring that hardens: `stiffness·q + cubic·q³`.
    Hardening: "nonlinear_spring", Joint, [*"stiffness" EffortPerTravel, *"cubic" EffortPerCubicTravel];
    /// Force periodic in position: cogging, gear mesh (Armstrong-Hélouvry 1991).
    Ripple: "ripple", Joint, [*"sine" Effort, *"cosine" Effort, -"period" Travel];
    /// Cogging of two orders, the second with twice the order: `level·(sin x + share·sin(2x + 1))`.
    TwoOrders: "ripple", Joint, [*"level" Effort, -"period" Travel, -"share" Number];
    /// Cogging with flat tops: `level·tanh(sharpness·sin x)/tanh(sharpness)`.
    Toothed: "ripple", Joint, [*"level" Effort, -"period" Travel, -"sharpness" Number];
    /// Cogging with two periods that have no common one.
    TwoRipples: "cogging_with_two_periods", Joint, [*"level" Effort, -"first_period" Travel, -"second_period" Travel];
    /// Dry friction that swells and falls with the position, as an eccentric seal's does (Armstrong-Hélouvry 1991).
    Uneven: "uneven_friction", Joint, [*"level" Effort, -"depth" Number, -"period" Travel];
    /// Friction proportional to the drive's effort (gear and bearing load).
    LoadShare: "load_dependent", Joint, [*"fraction" Number];
    /// Friction proportional to the force on the tip, N·m/N.
    LoadArm: "load_dependent", Joint, [*"arm" Length];
    /// One share of the load where it drives, another where the mechanism drives it (Schlegel 1974; gears under load).
    LoadSided: "load_dependent", Joint, [*"driving" Number, *"driven" Number];
    /// `level·(load/reference)²` (Hertzian contact in a gear).
    LoadSquare: "load_dependent", Joint, [*"level" Effort, -"reference" Effort];
    /// Dry friction that fades as its own work warms the contact: halved after `travel` at full level.
    WorkFade: "thermal_fade", Joint, [*"level" Effort, -"travel" Travel];
    /// Dry friction that is lost in proportion to time, all of `level` after `time`.
    FadeLinear: "thermal_fade", Joint, [*"level" Effort, -"time" Time];
    /// Dry friction that is lost as `level·(1 − exp(−t/time))`.
    FadeExponential: "thermal_fade", Joint, [*"level" Effort, -"time" Time];
    /// Dry friction that is lost with the way slid, which is its energy: `level·(1 − exp(−way/travel))`.
    FadeByWay: "thermal_fade", Joint, [*"level" Effort, -"travel" Travel];
    /// Breakaway that grows with dwell time at rest (Rabinowicz 1958) and is worn off by sliding.
    Settling: "settling", Joint, [*"level" Effort, -"time" Time, -"travel" Travel];
    /// Extra friction after a reversal that dies out with travel (thesis §3.5).
    Overshoot: "reversal_overshoot", Joint, [*"level" Effort, -"travel" Travel];
    /// The same, gone in proportion to the travel.
    OvershootLinear: "reversal_overshoot", Joint, [*"level" Effort, -"travel" Travel];
    /// Inside a gap after a reversal `level` of the friction is missing (a coupling with play).
    Gap: "backlash_width", Joint, [*"level" Effort, -"gap" Travel];
    /// A disturbance periodic in time.
    Disturbance: "periodic_disturbance", Joint, [*"level" Effort, -"period" Time];

    /// First-order delay of the effort.
    Lag: "lag", Drive, [*"time_constant" Time];
    /// Second-order delay: twice `time_constant` slow in all, with a damping ratio.
    LagSecond: "lag", Drive, [*"time_constant" Time, -"damping" Number];
    /// The effort changes by no more than this in a second.
    RateLimit: "lag", Drive, [-"rate" EffortPerTime];
    /// The effort is late by whole samples or by a part of one.
    DeadTime: "dead_time", Drive, [*"delay" Time];
    /// Every effort × (1 + fraction).
    Gain: "gain_error", Drive, [*"fraction" Number];
    /// The effort ends at `level`.
    Saturation: "saturation", Drive, [*"level" Effort];
    /// The effort bends to `level`: `level·tanh(effort/level)` (a magnetic circuit).
    SoftSaturation: "saturation", Drive, [*"level" Effort];
    /// The drive gives nothing below `level` and loses it above.
    DeadZone: "dead_zone", Drive, [*"level" Effort];
    /// The magnetic circuit lags the current by a play of `width_a` ampere (thesis figure 3.17).
    Play: "current_hysteresis", Drive, [*"width_a" Number];
    /// Share of the current that goes through a Preisach operator of even density (Preisach 1935, Mayergoyz 1986).
    Preisach: "current_hysteresis", Drive, [*"preisach_share" Number];
    /// Share of the current that goes through three plays (Prandtl 1928, Ishlinskii 1944), the widest of `width_a`.
    Plays: "current_hysteresis", Drive, [*"plays_share" Number, -"width_a" Current];
    /// Share of the current that goes through a Bouc–Wen law of `width_a` (Bouc 1967, Wen 1976).
    BoucWenCurrent: "current_hysteresis", Drive, [*"bouc_wen_share" Number, -"width_a" Current];
    /// A backlash window of another width.
    Backlash: "backlash_width", Drive, [*"width" Travel];
    /// Torque lost as the fluid warms: fluid and housing, two masses (K/J and s), a share per kelvin.
    Thermal: "thermal_fade", Drive, [*"loss_per_kelvin" Number];
    /// Torque lost in proportion to time: all of `loss` after `time`.
    YieldFade: "thermal_fade", Drive, [*"loss" Number, -"time" Time];
    /// Torque raised by a fraction after a reversal, dying out with travel (thesis §3.5).
    YieldOvershoot: "reversal_overshoot", Drive, [*"fraction" Number, -"travel" Travel];
    /// The same, gone in proportion to the travel.
    YieldOvershootLinear: "reversal_overshoot", Drive, [*"fraction" Number, -"travel" Travel];
    /// The brake's rising and falling times × (1 + fraction) each.
    TimeConstants: "time_constant", Drive, [*"rising_fraction" Number, *"falling_fraction" Number];
    /// Torque that is there without current, more than the table has.
    OffState: "off_state_torque", Drive, [*"level" Effort];

    /// A point mass at the tip, or an inertia × (1 + mass).
    Payload: "payload", Body, [*"mass" Mass];
    /// Masses and inertias × (1 + fraction).
    Inertia: "inertia_error", Body, [*"fraction" Number];
    /// A link of an arm weighs so much more, its shape kept.
    LinkMass: "link_inertia", Body, [*"heavier_by" Mass];
    /// What a motor's rotor adds at a joint of an arm, behind its gear.
    Rotor: "added_inertia", Body, [*"inertia" Inertia];
    /// A mass on a spring of its own: the handle, between sensor and tip.
    Compliance: "compliance", Body, [*"mass" Mass, -"frequency" Number];
    /// A share of the inertia behind a spring of a frequency, with play in it.
    TwoMass: "compliance", Body, [-"share" Number, -"frequency" Number, -"gap" Travel];
    /// A share of the inertia behind a gap that closes with an impact (Nordin and Gutman 2002).
    ImpactGap: "backlash_width", Body, [-"share" Number, -"frequency" Number, *"gap" Travel];
    /// An arm is longer than its table says, m.
    LinkLength: "link_length", Body, [*"length" Length];
    /// Acceleration of gravity in the plane of a base that is not level.
    Gravity: "gravity", Field, [*"x" Acceleration, *"y" Acceleration];
    /// A spring from the tip to a place in the plane, with a length at which it is slack, N/m and m.
    PlaneSpring: "anchored_spring", Field, [*"stiffness" Force, -"anchor_x" Length, -"anchor_y" Length, -"rest_length" Length];

    /// A channel is late by `delay`, early when negative: position on an axis, effort on a bench, forces on a five-bar.
    Skew: "channel_skew", Sensor, [*"delay" Time];
    /// Late by a delay that swings between nothing and twice this.
    VaryingSkew: "varying_delay", Sensor, [*"delay" Time, -"period" Time];
    /// The encoder shows (1 + fraction)·(angle − start) + start.
    EncoderScale: "encoder_scale", Sensor, [*"fraction" Number];
    /// The encoder shows this much more.
    EncoderOffset: "encoder_offset", Sensor, [*"angle" Angle];
    /// The disc sits off its axis: `amplitude·sin` once a turn.
    Eccentric: "encoder_eccentricity", Sensor, [*"amplitude" Travel, -"phase" Angle];
    /// The interpolation between two lines is uneven: `amplitude·sin` once a line.
    Interpolation: "encoder_eccentricity", Sensor, [*"amplitude" Travel, -"line" Travel];
    /// Both force channels × (1 + fraction).
    ForceGain: "force_gain", Sensor, [*"fraction" Number];
    /// A share of the other force channel is in this one.
    Crosstalk: "force_crosstalk", Sensor, [*"share" Number];
    /// Added to the force channels, N.
    ForceBias: "force_bias", Sensor, [*"x" Force, *"y" Force];
    /// The force sensor is turned to the left by this angle.
    ForceRotation: "force_rotation", Sensor, [*"angle" Angle];
    /// Bursts in which every channel repeats its last value: so many a second, of so many samples.
    Repeated: "repeated_samples", Sensor, [*"a_second" Number, -"samples" Number];
    /// The recorder's clock runs fast by a share, and its stamps scatter, s.
    Clock: "clock", Sensor, [*"skew" Number, *"jitter" Time];
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::effect::Mechanism;

    /// A number with the vocabulary's name is the vocabulary's number; a law of another family has names of its own.
    #[test]
    fn a_shared_name_is_a_shared_number() {
        let mut own = 0;
        for form in Form::ALL {
            let facts = form.facts();
            assert!(
                !facts.values.is_empty() && facts.values.len() <= 4,
                "{form:?}"
            );
            assert!(
                facts.values.iter().any(|value| value.strong)
                    || *form == Form::RateLimit
                    || *form == Form::TwoMass
            );
            let Some(mechanism) = Mechanism::from_name(facts.mechanism) else {
                own += 1;
                continue;
            };
            for theirs in mechanism.parameters() {
                for value in facts
                    .values
                    .iter()
                    .filter(|value| value.name == theirs.name)
                {
                    assert_eq!(value.quantity, theirs.quantity, "{form:?} {}", value.name);
                }
            }
        }
        assert!(own < 16, "{own} mechanisms are not in the vocabulary");
    }
}
