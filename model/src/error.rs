//! This file says what the reference model refuses to compute, with the value, its range and what to do.

use rigproof_spec::geometry::Angle;

use crate::linkage::Pair;

/// What the reference model refuses to compute.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// An angle lies outside its range.
    #[error(
        "the angle at joint {} is {value_deg} °, its range is {least_deg} ° to {greatest_deg} °; move the tip or change the range",
        angle.letter()
    )]
    AngleRange {
        /// Which angle.
        angle: Angle,
        /// Its value, degrees.
        value_deg: f64,
        /// The least allowed, degrees.
        least_deg: f64,
        /// The greatest allowed, degrees.
        greatest_deg: f64,
    },
    /// A range of angles has no inside.
    #[error(
        "the range of the angle at joint {} runs from {least_deg} ° to {greatest_deg} °; give the lower end first, and no other than finite numbers",
        angle.letter()
    )]
    AngleRangeCrossed {
        /// Which angle.
        angle: Angle,
        /// The lower end as given, degrees.
        least_deg: f64,
        /// The upper end as given, degrees.
        greatest_deg: f64,
    },
    /// An arm length is no length.
    #[error(
        "the length {arm} is {value_m} m; it must be {} and at most {greatest_m} m: check the number and its unit",
        if *least_m > 0.0 { format!("at least {least_m} m") } else { "0 m or more".to_owned() }
    )]
    ArmLength {
        /// The length as the thesis writes it.
        arm: &'static str,
        /// Its value, m.
        value_m: f64,
        /// The least allowed, m.
        least_m: f64,
        /// The greatest allowed, m.
        greatest_m: f64,
    },
    /// Arms AE and BC have passed each other.
    #[error(
        "arms AE and BC have passed each other: the angle at A, {theta_a_deg} °, is less than the angle at B, {theta_b_deg} °; \
         it must be at least that"
    )]
    BaseArmsCrossed {
        /// θA, degrees.
        theta_a_deg: f64,
        /// θB, degrees.
        theta_b_deg: f64,
    },
    /// The outer arms cannot meet in the tip.
    #[error(
        "joints E and C are {distance_m} m apart, arms ED and CD meet only between {least_m} m and {greatest_m} m; \
         change the base angles or the arm lengths"
    )]
    CannotClose {
        /// Distance between joints E and C, m.
        distance_m: f64,
        /// The least at which the arms meet, m.
        least_m: f64,
        /// The greatest at which the arms meet, m.
        greatest_m: f64,
    },
    /// A current that the amplifiers cannot give.
    #[error(
        "the current of brake {brake} is {value_a} A; it must be between 0 A and {greatest_a} A"
    )]
    Current {
        /// The brake's joint.
        brake: &'static str,
        /// The current, A.
        value_a: f64,
        /// The greatest allowed, A.
        greatest_a: f64,
    },
    /// A current for a joint without a brake.
    #[error("joint {joint} carries no brake on this layout but is given {value_a} A; give it 0 A")]
    CurrentWithoutBrake {
        /// The joint.
        joint: &'static str,
        /// The current, A.
        value_a: f64,
    },
    /// An effect that the rig cannot be given.
    #[error(
        "the effect `{mechanism}` at {joint} cannot act on the rig: {reason}; take it out or mend it"
    )]
    Effect {
        /// The mechanism's name.
        mechanism: &'static str,
        /// The joint, or that there is none.
        joint: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// A number of an effect that is not one of its mechanism's.
    #[error(
        "the effect `{mechanism}` at {joint} cannot act on the rig: its `{parameter}` is {value} in SI units and has to be {allowed}; mend it"
    )]
    EffectValue {
        /// The mechanism's name.
        mechanism: &'static str,
        /// The joint, or that there is none.
        joint: &'static str,
        /// The parameter's name.
        parameter: &'static str,
        /// Its value, SI.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Brakes stick and slip again without end.
    #[error(
        "the brakes stuck and slipped {events} times within one step at {time_s} s; check the force for steps inside a step"
    )]
    Events {
        /// How often.
        events: u32,
        /// When, s.
        time_s: f64,
    },
    /// A mass or a moment of inertia is none.
    #[error(
        "{symbol} of {part} is {value} {unit}; it must be finite and above 0 {unit}, only that of the tip may be 0: check table 5.1 or the payload"
    )]
    Mass {
        /// Which part.
        part: &'static str,
        /// The symbol of table 5.1.
        symbol: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The equations of motion have no solution.
    #[error(
        "the equations of motion (5.66) have no solution at this pose; move away from the singularity or give every arm a mass"
    )]
    NoAcceleration,
    /// A number is not finite.
    #[error("{quantity} is {value} {unit}; it must be a finite number")]
    NotFinite {
        /// What was given.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The tip is off the table.
    #[error(
        "the tip at ({x_m} m, {y_m} m) is off the table; each coordinate must lie between -{half_side_m} m and {half_side_m} m"
    )]
    OffTable {
        /// x of the tip, m.
        x_m: f64,
        /// y of the tip, m.
        y_m: f64,
        /// Half the side of the table, m.
        half_side_m: f64,
    },
    /// A piece of a path is too short to have a direction.
    #[error(
        "the {piece} is {length_m} m long; it must be at least {least_m} m: check the points and their unit"
    )]
    PathPiece {
        /// Which piece.
        piece: &'static str,
        /// Its length, m.
        length_m: f64,
        /// The least allowed, m.
        least_m: f64,
    },
    /// A setting lies outside its range.
    #[error(
        "{setting} is {value} {unit}; it must lie between {least} {unit} and {greatest} {unit}"
    )]
    SettingRange {
        /// Which setting.
        setting: &'static str,
        /// Its value.
        value: f64,
        /// The least allowed.
        least: f64,
        /// The greatest allowed.
        greatest: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Two arms are parallel, or folded beyond it.
    #[error(
        "arms {} and {} are parallel or folded over: the angle at joint {} is {value_deg} °, it must lie between {least_deg} ° and {greatest_deg} °; \
         move away from the singularity",
        pair.arms()[0], pair.arms()[1], pair.angle().letter()
    )]
    Singular {
        /// The two arms.
        pair: Pair,
        /// The angle between them, degrees.
        value_deg: f64,
        /// The angle at one singularity, degrees; itself not allowed.
        least_deg: f64,
        /// The angle at the other singularity, degrees; itself not allowed.
        greatest_deg: f64,
    },
    /// The grid of a workspace is not usable.
    #[error(
        "the step of the grid is {step_m} m; it must be between {least_m} m and {greatest_m} m for arms of this size"
    )]
    Step {
        /// The step, m.
        step_m: f64,
        /// The least allowed, m.
        least_m: f64,
        /// The greatest allowed, m.
        greatest_m: f64,
    },
    /// A duration that is none.
    #[error("the step is {value_s} s; it must be above 0 s and at most {greatest_s} s")]
    TimeStep {
        /// The step, s.
        value_s: f64,
        /// The greatest allowed, s.
        greatest_s: f64,
    },
    /// Too few points or samples.
    #[error("{count} {what} are too few; give at least {least}")]
    TooFew {
        /// Of what.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// The least allowed.
        least: usize,
    },
    /// The tip is out of reach.
    #[error(
        "the tip at ({x_m} m, {y_m} m) is {distance_m} m away from base joint {base}, its arms reach from {least_m} m to {greatest_m} m; \
         move the tip or change the arm lengths"
    )]
    Unreachable {
        /// x of the tip, m.
        x_m: f64,
        /// y of the tip, m.
        y_m: f64,
        /// The base joint, A or B.
        base: &'static str,
        /// Distance of the tip from it, m.
        distance_m: f64,
        /// The least reach of its arms, m.
        least_m: f64,
        /// The greatest reach of its arms, m.
        greatest_m: f64,
    },
}
