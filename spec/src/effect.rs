//! This file is the fixed vocabulary of left-out physics: one name for each mechanism, with its parameters.

mod quantity;

pub use quantity::{Motion, Quantity};

/// Rate of a joint below which its sense is rounding and no reversal, rad/s: a count of the encoder takes most of a day.
pub const LEAST_TURNING_RAD_S: f64 = 1e-9;

/// What an overshoot remembers of a joint that has not moved yet: more than the whole of its travel in either sense, so that its
/// first motion is no reversal.
pub const NOT_MOVED: f64 = 2.0;

/// Declares the vocabulary: a block a mechanism, with its meaning, its variant, its name in files, what the field calls it,
/// other words for it that somebody may try, and its parameters in their order.
macro_rules! vocabulary {
    ($($(#[doc = $doc:literal])+ $variant:ident = $name:literal called $called:literal $(| $also:literal)* [$($parameter:expr),* $(,)?],)+) => {
        /// A physical mechanism that a model may contain or may have left out.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Mechanism {
            $($(#[doc = $doc])+ $variant,)+
        }

        impl Mechanism {
            /// Every mechanism, in the order of the vocabulary.
            pub const ALL: [Mechanism; [$($name),+].len()] = [$(Mechanism::$variant),+];

            /// The name used in every file and report.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Mechanism::$variant => $name,)+
                }
            }

            /// What the field calls it, for a person who reads.
            pub const fn called(self) -> &'static str {
                match self {
                    $(Mechanism::$variant => $called,)+
                }
            }

            /// Other words for it that somebody may try, in small letters.
            pub const fn also(self) -> &'static [&'static str] {
                match self {
                    $(Mechanism::$variant => const { &[$($also),*] },)+
                }
            }

            /// The parameters of the mechanism, empty while no room computes it.
            pub const fn parameters(self) -> &'static [Parameter] {
                use Quantity::*;
                match self {
                    $(Mechanism::$variant => const { &[$($parameter),*] },)+
                }
            }
        }
    };
}

vocabulary! {
    /// Rate-independent (Coulomb) friction.
    DryOffset = "dry_offset" called "Coulomb friction" | "coulomb" | "dry friction" | "dry" | "sliding friction" [needed("level", Effort)],
    /// Wrong torque constant of a drive or a brake.
    GainError = "gain_error" called "wrong gain" | "gain" | "torque constant" | "motor constant" [needed("fraction", Number)],
    /// Friction proportional to speed.
    Viscous = "viscous" called "viscous friction" | "damping" | "drag" | "damper" [needed("coefficient", EffortPerSpeed)],
    /// Different friction in the two directions of motion.
    DirectionAsymmetry = "direction_asymmetry" called "direction-dependent friction" | "asymmetry" | "asymmetric friction" [needed("viscous", EffortPerSpeed), needed("dry", Effort)],
    /// Friction that falls with rising speed near standstill.
    Stribeck = "stribeck" called "breakaway (Stribeck) friction peak" | "stiction" | "breakaway" | "static friction" | "breakaway peak" [
        needed("peak", Effort),
        needed("speed", Speed).above_zero(),
        needed("exponent", Number),
        optional("travel", Travel).above_zero(),
    ],
    /// Higher torque of a brake just after a reversal.
    ReversalOvershoot = "reversal_overshoot" called "torque overshoot after a reversal" | "overshoot" [needed("fraction", Number), needed("travel", Travel).above_zero()],
    /// Friction that is higher just after each reversal.
    FrictionOvershoot = "friction_overshoot" called "friction overshoot after a reversal" | "breakaway overshoot" [needed("level", Effort), needed("travel", Travel).above_zero()],
    /// Wrong width of the backlash window.
    BacklashWidth = "backlash_width" called "backlash of a brake" [needed("width", Travel).not_below_zero()],
    /// Elastic motion before sliding (Dahl 1968).
    Presliding = "presliding" called "presliding friction" | "dahl" | "bristle" [needed("level", Effort), needed("travel", Travel).above_zero()],
    /// Elastic motion before sliding, with another limit in each direction.
    AsymmetricPresliding = "asymmetric_presliding" called "presliding friction, uneven" | "asymmetric dahl" [
        needed("forward", Effort),
        needed("backward", Effort),
        needed("travel", Travel).above_zero(),
    ],
    /// Memory of the current history.
    CurrentHysteresis = "current_hysteresis" called "magnetic hysteresis" | "remanence" [
        needed("half_width", Current).above_zero(),
        needed("share", Number).part(),
        optional("closing", Current).not_below_zero(),
        optional("spread", Number).part(),
        optional("top", Current).not_below_zero(),
    ],
    /// Memory of the displacement history (Bouc 1967, Wen 1976).
    Hysteresis = "hysteresis" called "Bouc-Wen hysteresis" | "bouc-wen" | "bouc_wen" [
        needed("alpha", EffortPerTravel),
        needed("beta_gamma", PerTravel),
        needed("beta_delta", PerTravel),
    ],
    /// First-order delay of the commanded effort.
    Lag = "lag" called "first-order lag of the drive" | "slow drive" | "low-pass" [needed("time_constant", Time).above_zero()],
    /// Pure delay of the commanded effort.
    DeadTime = "dead_time" called "dead time" | "latency" | "delay" | "transport delay" [needed("delay", Time).above_zero()],
    /// Limited effort.
    Saturation = "saturation" called "saturation of a brake" | "clipping" [
        needed("limit", Current).not_below_zero(),
        optional("sharpness", Number).above_zero(),
    ],
    /// Friction proportional to the transmitted load.
    LoadDependent = "load_dependent" called "friction under load at the tip" | "load friction" [needed("arm", Length)],
    /// Torque lost to heating.
    ThermalFade = "thermal_fade" called "fade by heat" | "fade" | "heat" [needed("per_joule", PerEnergy), needed("cooling", Time).above_zero()],
    /// A brake's torque changed by the time since the start.
    TorqueDrift = "torque_drift" called "drift of a brake's torque" | "torque fade" | "weakening brake" [needed("rate", PerTime), optional("settling", Time).above_zero()],
    /// Torque changed by rest (particle settling).
    Settling = "settling" called "settling of particles" | "sedimentation" [needed("level", Effort), needed("travel", Travel).above_zero()],
    /// Force periodic in position.
    Ripple = "ripple" called "torque ripple (cogging)" | "cogging" [needed("sine", Effort), needed("cosine", Effort), needed("period", Travel).above_zero()],
    /// Dry friction whose level is periodic in position.
    UnevenFriction = "uneven_friction" called "friction that varies along the travel" | "position-dependent friction" | "eccentric seal" [needed("sine", Effort), needed("cosine", Effort), needed("period", Travel).above_zero()],
    /// Weight of a tilted mechanism.
    Gravity = "gravity" called "gravity" | "tilt" | "weight" [needed("x", Acceleration), needed("y", Acceleration)],
    /// Linear spring.
    Spring = "spring" called "linear spring" | "stiffness" [needed("stiffness", EffortPerTravel), optional("rest", Travel)],
    /// Constant force.
    ConstantBias = "constant_bias" called "constant bias" | "bias" | "offset" [needed("level", Effort)],
    /// Constant force that drifts with the time since the start, and comes to an end where it settles.
    BiasDrift = "bias_drift" called "drift of the bias" | "drift" | "creep" | "zero drift" [needed("rate", EffortPerTime), optional("settling", Time).above_zero()],
    /// Wrong inertia.
    InertiaError = "inertia_error" called "wrong inertia of an arm" | "inertia" [
        needed("arm_ae", MomentOfInertia),
        needed("arm_bc", MomentOfInertia),
        needed("arm_ed", MomentOfInertia),
        needed("arm_cd", MomentOfInertia),
        needed("tip", Mass),
    ],
    /// Masses and inertias that are all wrong by one factor.
    InertiaScale = "inertia_scale" called "wrong scale of all inertias" | "mass scale" | "density" [needed("fraction", Number)],
    /// Extra mass at the tip.
    Payload = "payload" called "payload" | "tip mass" [needed("mass", Mass)],
    /// Friction at a joint without a brake.
    BearingFriction = "bearing_friction" called "bearing friction" | "bearing" [needed("level", Effort)],
    /// Structural flexibility.
    Compliance = "compliance" called "structural compliance" | "flexibility" | "elasticity" | "flexible joint" [
        needed("share", Number).part(),
        needed("resonance", PerTime).above_zero(),
        needed("damping", Number).above_zero(),
        optional("gap", Travel).above_zero(),
    ],
    /// Time shift between two channels.
    ChannelSkew = "channel_skew" called "time skew between channels" | "skew" [needed("delay", Time)],
    /// Wrong scale of a position channel.
    EncoderScale = "encoder_scale" called "encoder scale error" | "encoder gain" [needed("fraction", Number)],
    /// Wrong zero of a position channel.
    EncoderOffset = "encoder_offset" called "encoder zero error" | "homing" [needed("angle", Angle)],
    /// Wrong scale of a force channel.
    ForceGain = "force_gain" called "force sensor gain error" | "force scale" [needed("fraction", Number)],
    /// Wrong zero of a force channel.
    ForceBias = "force_bias" called "force sensor bias" | "tare" | "force offset" [needed("x", Force), needed("y", Force)],
    /// Rotated force sensor.
    ForceRotation = "force_rotation" called "rotated force sensor" | "force angle" [needed("angle", Angle)],
    /// Cubic spring.
    NonlinearSpring = "nonlinear_spring" called "cubic (Duffing) spring" | "duffing" | "cubic spring" [needed("cubic", EffortPerCubicTravel)],
    /// A stop, or a tether that is slack before it: a spring beyond a position.
    JointStop = "joint_stop" called "joint stop or tether" | "end stop" | "hard stop" | "bumper" [
        needed("stiffness", EffortPerTravel),
        needed("position", Travel),
        needed("side", Number).sign(),
    ],
    /// Friction proportional to a power of speed.
    VelocityPower = "velocity_power" called "drag by a power of speed" | "quadratic drag" | "turbulent drag" [
        needed("coefficient", Effort),
        needed("exponent", Number).above_zero(),
    ],
    /// Elastic motion before sliding with drag beside it (Canudas de Wit et al. 1995).
    LugreBristle = "lugre_bristle" called "LuGre friction" | "lugre" [
        needed("level", Effort),
        needed("viscous", EffortPerSpeed),
        needed("travel", Travel).above_zero(),
    ],
    /// Elastic motion before sliding on Dahl's own curve (Dahl 1968).
    DahlBristle = "dahl_bristle" called "Dahl friction" [
        needed("level", Effort),
        needed("travel", Travel).above_zero(),
        needed("exponent", Number).above_zero(),
    ],
    /// Wrong time constants of a brake.
    TimeConstant = "time_constant" called "wrong time constant of a brake" | "slow brake" [
        needed("scale", Number).above_zero(),
        optional("falling", Number).above_zero(),
    ],
    /// An amplifier that gives another current than the commanded one.
    CurrentGain = "current_gain" called "current gain error" | "amplifier gain" [needed("scale", Number).above_zero()],
    /// Another curve of a brake's effort over its command.
    CommandExponent = "command_exponent" called "wrong curve of a brake over its command" | "quadratic brake" | "nonlinear command" [
        needed("exponent", Number).above_zero(),
        needed("full", Current).above_zero(),
    ],
    /// A spring from the tip to an anchor in the plane.
    PlaneSpring = "plane_spring" called "spring to an anchor" | "tether" [
        needed("stiffness", ForcePerLength),
        needed("tension", Force),
        needed("x", Length),
        needed("y", Length),
    ],
    /// An arm of another length than described.
    LinkLength = "link_length" called "wrong link length" | "arm length" [needed("more", Length)],
    /// Friction that is missing while a gap is crossed after a reversal.
    Backlash = "backlash" called "backlash" | "play" | "dead zone" | "deadband" | "lost motion" [needed("missing", Effort), needed("gap", Travel).above_zero()],
    /// A gap between a joint and a part of its inertia.
    LoadBacklash = "load_backlash" called "backlash between motor and load" | "gear lash" | "two-mass backlash" [
        needed("inertia", Inertia).not_below_zero(),
        needed("gap", Travel).above_zero(),
    ],
    /// Another stiffness between a motor and its link than the stated one.
    TransmissionStiffness = "transmission_stiffness" called "wrong stiffness of a transmission" | "gear stiffness" | "joint stiffness" [needed("stiffness", EffortPerTravel)],
    /// A gap between a motor and its link, where the twist is recorded.
    TransmissionBacklash = "transmission_backlash" called "backlash in a transmission" | "gear backlash" [
        needed("stiffness", EffortPerTravel),
        needed("gap", Travel).above_zero(),
        optional("centre", Travel),
    ],
    /// Friction in proportion to the effort that a joint transmits, or to a power of it.
    LoadFriction = "load_friction" called "friction under load" | "gear efficiency" [
        needed("share", Number).not_below_zero(),
        optional("exponent", Number).above_zero(),
    ],
    /// Friction that falls with time.
    FrictionFade = "friction_fade" called "fading friction" | "warming up" [
        needed("rate", PerTime),
        needed("drag_rate", PerTime),
    ],
    /// Another inertia than the described one.
    AddedInertia = "added_inertia" called "wrong inertia" | "load inertia" | "armature" [needed("inertia", Inertia)],
    /// Other inertial numbers of a link than the described ones, as far as efforts hang on them.
    LinkInertia = "link_inertia" called "wrong inertial numbers of a link" | "base parameters" | "link mass" [
        needed("mass", Mass),
        needed("x", FirstMoment),
        needed("y", FirstMoment),
        needed("z", FirstMoment),
        needed("xx", MomentOfInertia),
        needed("xy", MomentOfInertia),
        needed("xz", MomentOfInertia),
        needed("yy", MomentOfInertia),
        needed("yz", MomentOfInertia),
        needed("zz", MomentOfInertia),
    ],
    /// A greatest effort of the drive.
    DriveSaturation = "drive_saturation" called "saturation of the drive" | "torque limit" | "torque saturation" [
        needed("limit", Effort).above_zero(),
        optional("sharpness", Number).above_zero(),
    ],
    /// A greatest rate of the drive's effort.
    RateLimit = "rate_limit" called "slew-rate limit of the drive" | "slew rate" | "rate limiter" | "slew limit" [needed("rate", EffortPerTime).above_zero()],
    /// Time stamps that scatter about an even clock.
    ClockJitter = "clock_jitter" called "jitter of the time stamps" | "jitter" | "time stamps" [needed("jitter", Time).not_below_zero()],
    /// An encoder whose disc turns off its centre, or that errs alike in every one of its lines.
    EccentricEncoder = "eccentric_encoder" called "encoder eccentricity" | "eccentricity" | "interpolation error" | "subdivisional error" [
        needed("sine", Travel),
        needed("cosine", Travel),
        optional("period", Travel).above_zero(),
    ],
}

impl Mechanism {
    /// The mechanism of a name, or `None`.
    pub fn from_name(name: &str) -> Option<Mechanism> {
        Mechanism::ALL
            .into_iter()
            .find(|mechanism| mechanism.name() == name)
    }

    /// The mechanism that somebody means by another word for it, however that is written: `Coulomb`, `dead-band`.
    pub fn meant_by(word: &str) -> Option<Mechanism> {
        let meant = |own: &Mechanism| {
            let mut words = [own.name(), own.called()]
                .into_iter()
                .chain(own.also().iter().copied());
            words.any(|own| same_word(own, word))
        };
        let is_name = Mechanism::from_name(word).is_some();
        Mechanism::ALL
            .into_iter()
            .find(|own| !is_name && meant(own))
    }

    /// Every mechanism whose other words or whose word in the field hold this one, such as `friction`; the plainest come first.
    pub fn suggested_by(word: &str) -> impl Iterator<Item = Mechanism> + '_ {
        let holds = move |text: &str| {
            let mut parts = text.split(|c: char| !c.is_alphanumeric());
            parts.any(|part| part.eq_ignore_ascii_case(word))
        };
        let all = Mechanism::ALL.into_iter();
        all.filter(move |own| holds(own.called()) || own.also().iter().any(|also| holds(also)))
    }

    /// How many of the parameters may not be left out.
    pub fn needed(self) -> usize {
        let all = self.parameters().iter();
        all.filter(|parameter| !parameter.is_optional).count()
    }
}

/// Whether two words are one, letter case, blanks and marks between their parts left out.
fn same_word(one: &str, other: &str) -> bool {
    fn letters(word: &str) -> impl Iterator<Item = char> + '_ {
        let plain = word.chars().filter(|c| c.is_alphanumeric());
        plain.flat_map(char::to_lowercase)
    }
    letters(one).eq(letters(other))
}

/// One parameter of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The name used in files and reports.
    pub name: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Whether it may be left out; none stands before one that may not.
    pub is_optional: bool,
    /// Which numbers have a meaning.
    pub range: Range,
}

/// Which numbers a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Every finite one.
    Any,
    /// 0 or more: a width, a limit.
    NotBelowZero,
    /// More than 0: a law divides by it, or it is a time.
    AboveZero,
    /// From 0 to 1: a part of something.
    Part,
    /// Every finite one, of which the sign alone counts.
    Sign,
}

impl Range {
    /// The least and the greatest number that has a meaning, or that one comes near to.
    pub const fn ends(self) -> [f64; 2] {
        match self {
            Range::Any | Range::Sign => [f64::NEG_INFINITY, f64::INFINITY],
            Range::NotBelowZero | Range::AboveZero => [0.0, f64::INFINITY],
            Range::Part => [0.0, 1.0],
        }
    }
}

const fn needed(name: &'static str, quantity: Quantity) -> Parameter {
    Parameter {
        name,
        quantity,
        is_optional: false,
        range: Range::Any,
    }
}

const fn optional(name: &'static str, quantity: Quantity) -> Parameter {
    Parameter {
        is_optional: true,
        ..needed(name, quantity)
    }
}

impl Parameter {
    const fn above_zero(self) -> Parameter {
        Parameter {
            range: Range::AboveZero,
            ..self
        }
    }

    const fn part(self) -> Parameter {
        Parameter {
            range: Range::Part,
            ..self
        }
    }

    const fn sign(self) -> Parameter {
        Parameter {
            range: Range::Sign,
            ..self
        }
    }

    const fn not_below_zero(self) -> Parameter {
        Parameter {
            range: Range::NotBelowZero,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_other_words_are_unique_and_read_back() {
        assert_eq!(Mechanism::meant_by("Coulomb"), Some(Mechanism::DryOffset));
        assert_eq!(Mechanism::meant_by("dead-band"), Some(Mechanism::Backlash));
        for mechanism in Mechanism::ALL {
            assert_eq!(Mechanism::from_name(mechanism.name()), Some(mechanism));
            assert_eq!(Mechanism::meant_by(mechanism.name()), None);
            for other in Mechanism::ALL {
                let is_other = other != mechanism;
                assert!(!is_other || other.called() != mechanism.called());
                assert!(!is_other || other.name() != mechanism.name());
                for word in mechanism.also() {
                    assert!(*word != other.name());
                    assert!(!is_other || !other.also().contains(word), "{word}");
                }
            }
            for word in mechanism.also() {
                assert_eq!(Mechanism::meant_by(word), Some(mechanism));
                assert!(!same_word(word, mechanism.called()), "{word}");
            }
        }
    }

    #[test]
    fn a_family_suggests_its_members_the_plainest_first() {
        let mut friction = Mechanism::suggested_by("Friction");
        assert_eq!(friction.next(), Some(Mechanism::DryOffset));
        assert_eq!(friction.next(), Some(Mechanism::Viscous));
        assert!(friction.any(|own| own == Mechanism::Stribeck));
        assert_eq!(Mechanism::suggested_by("zeal").count(), 0);
    }

    #[test]
    fn no_optional_parameter_stands_before_one_that_is_needed() {
        for mechanism in Mechanism::ALL {
            let optional = mechanism.parameters().iter().skip(mechanism.needed());
            assert!(optional.clone().all(|own| own.is_optional), "{mechanism:?}");
        }
    }
}
