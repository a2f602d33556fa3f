//! This file says which arms and which settings of a controller are taken for a rig of this size. The thesis prints none of these ranges.

/// Longest arm that is taken for a length of this linkage, m: a thousand times the thesis's, so that a length in mm shows.
pub const LONGEST_ARM_M: f64 = 300.0;
/// Shortest arm that is taken for a length of this linkage, m.
pub const SHORTEST_ARM_M: f64 = 1e-6;
/// Shortest piece of a path that has a direction, m: a hundredth of what one count of an encoder moves the tip.
pub const SHORTEST_PIECE_M: f64 = 1e-7;
/// Largest distance that is taken for a boundary or a gap of this rig, m: its greatest reach.
pub const GREATEST_DISTANCE_M: f64 = 0.61;
/// Boundary of the velocity field (§6.1.1), m.
pub const BOUNDARY_RANGE_M: [f64; 2] = [SHORTEST_PIECE_M, GREATEST_DISTANCE_M];
/// Greatest force asked for at the tip (§6.1.2), N.
pub const FORCE_LIMIT_RANGE_N: [f64; 2] = [0.0, 1000.0];
/// Gain of proportional control (6.13), N·s/m: up to the high gain of table 6.1, read per centimetre.
pub const PROPORTIONAL_GAIN_RANGE_N_S_PER_M: [f64; 2] = [0.0, 1e6];
/// Gain of velocity ratio control (§2.2.2), N·m·s/rad.
pub const RATIO_GAIN_RANGE_NM_S_PER_RAD: [f64; 2] = [0.0, 1e6];
/// Stiffness of a virtual spring (§2.2.2), N/m.
pub const STIFFNESS_RANGE_N_PER_M: [f64; 2] = [0.0, 1e6];
/// Damping of a virtual damper (§2.2.2), N·s/m.
pub const DAMPING_RANGE_N_S_PER_M: [f64; 2] = [0.0, 1e6];
/// Weights of optimal control (§2.2.2): of the squared angle, 1/rad², and of the squared change of energy, 1.
pub const WEIGHT_RANGE: [f64; 2] = [0.0, 1e6];
/// Horizon of optimal control (§2.2.2), s.
pub const HORIZON_RANGE_S: [f64; 2] = [1e-6, 1.0];
