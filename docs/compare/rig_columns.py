"""This module smooths and differentiates a recording of the five-bar, subtracts the nominal model, and writes down what each mechanism of the
library would add to what is left: one column, or a few, of torques along θA and θB."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.signal import oaconvolve, savgol_coeffs

from rig_model import BACKLASH_DEG, BRAKES, JOINTS, brake_nm, gain_nm, inside_backlash, motion

ORDER = 3
# Slower than this, rad/s, a joint's sense is not believed.
SLOW_RAD_S = 0.02
# Rows are taken this far apart, s.
HOP_S = 0.005
STRIBECK_RAD_S = (0.1, 0.3)
DAHL_RAD = (0.05, 0.15)
RIPPLES_A_TURN = range(12, 62, 3)
OVERSHOOT_RAD = 0.12
PLAY_A = 0.1
WIDER_DEG = 1.0
STEP_RAD, STEP_SHARE = 0.01, 0.01


@dataclass
class Problem:
    """What the nominal model lacks, N·m, and candidates: (mechanism, joint or None) with its columns. Rows of θA stand before those of θB."""

    lacking_nm: np.ndarray
    candidates: list
    # Torque of the force on the tip, N·m.
    pushed_nm: np.ndarray


class Smoothing:
    """Savitzky and Golay's filter, passed twice: once leaves so much of the counts that the acceleration is noise."""

    def __init__(self, window, step_s):
        once = savgol_coeffs(window, ORDER)
        self.kernel, self.step_s = np.convolve(once, once), step_s

    def __call__(self, x):
        """The ends, half a kernel each, are spoilt and not used."""
        return oaconvolve(x, self.kernel.reshape(-1, *[1] * (x.ndim - 1)), mode="same", axes=0)

    def motion(self, theta_rad):
        """Angles and, by differences, rates and accelerations."""
        angles = theta_rad[0] + self(theta_rad - theta_rad[0])
        rates = np.gradient(angles, self.step_s, axis=0)
        return angles, rates, np.gradient(rates, self.step_s, axis=0)


def problem(recording, window_s):
    """The regression of a recording, smoothed over a window; `None` where too little is left of it."""
    window = 2 * int(0.5 * window_s / recording.step_s) + 1
    smooth = Smoothing(window, recording.step_s)
    moved = motion(recording.layout, *smooth.motion(recording.theta_rad))
    rates, angles, rows = moved.joint_rates(), moved.joint_angles(), moved.joint_rows()
    signs = np.sign(rates)
    braked = [JOINTS.index(joint) for joint in BRAKES[recording.layout]]
    slow = (np.abs(rates[braked]) < SLOW_RAD_S).any(axis=0)
    # What the smoothing brings in from a reversal or a rest is left out.
    near = np.convolve(slow, np.ones(2 * window), mode="same") > 0.5
    near[: 2 * window] = near[-2 * window :] = True
    used = np.flatnonzero(~near)[:: max(1, round(HOP_S / recording.step_s))]
    if len(used) < 100:
        return None
    brakes = {k: Brake(JOINTS[k], recording, angles[k], rates[k]) for k in braked}
    along = lambda k, torque: rows[k] * torque[:, None]
    known = sum(along(k, signs[k] * brake.torque_nm) for k, brake in brakes.items())
    stack = lambda x: x[used].T.reshape(-1)
    # Both sides pass the same filter; inertial terms are made of the smoothed motion.
    filtered = lambda x: stack(smooth(x))
    pushed = moved.of_tip_force_nm(recording.force_n)
    lacking = filtered(pushed - known) - stack(moved.inertial_nm())
    found = []
    for k, brake in brakes.items():
        at_joint(found, JOINTS[k], lambda torque, k=k: filtered(along(k, torque)), recording, angles[k], rates[k])
        in_brake(found, JOINTS[k], lambda torque, k=k: filtered(along(k, signs[k] * torque)), brake, rates[k])
    if "C" not in BRAKES[recording.layout]:
        bearing = [filtered(along(3, torque)) for torque in (signs[3], rates[3])]
        found.append(("bearing_friction", "C", bearing))
    elsewhere = lambda theta: other_lacking(recording, theta, smooth, signs, brakes, filtered, stack)
    of_sensors(found, recording, moved, filtered, stack, lacking, elsewhere)
    return Problem(lacking, found, filtered(pushed))


def at_joint(found, joint, column, recording, angle, rate):
    """Torques of a joint, as functions of where it is and how it moves; a bristle has the memory it needs."""
    sign = np.sign(rate)
    found += [
        ("dry_offset", joint, [column(sign)]),
        ("viscous", joint, [column(rate)]),
        ("direction_asymmetry", joint, [column(np.abs(rate))]),
        ("spring", joint, [column(angle - angle[0])]),
        ("load_dependent", joint, [column(sign * np.abs(recording.force_n))]),
    ]
    if joint in "AB":
        found.append(("constant_bias", joint, [column(np.ones(len(rate)))]))
    found += [("stribeck", joint, [column(sign * np.exp(-((rate / speed) ** 2)))]) for speed in STRIBECK_RAD_S]
    found += [("presliding", joint, [column(bristle(angle, travel))]) for travel in DAHL_RAD]
    for periods in RIPPLES_A_TURN:
        found.append(("ripple", joint, [column(np.sin(periods * angle)), column(np.cos(periods * angle))]))


def in_brake(found, joint, column, brake, rate):
    """What changes a brake's torque, to first order."""
    torque = brake.torque_nm
    slope = np.gradient(torque, brake.step_s)
    heat_j = np.cumsum(torque * np.abs(rate)) * brake.step_s
    found += [
        ("gain_error", joint, [column(torque)]),
        ("lag", joint, [column(-slope)]),
        ("backlash_width", joint, [column(brake.with_width(BACKLASH_DEG[joint] + WIDER_DEG) - torque)]),
        ("current_hysteresis", joint, [column(brake.with_play(PLAY_A) - brake.steady_nm)]),
        ("thermal_fade", joint, [column(-torque * heat_j / 100.0)]),
        ("reversal_overshoot", joint, [column(torque * np.exp(-travel_since_reversal(brake.angle_rad, rate) / OVERSHOOT_RAD))]),
    ]


def of_sensors(found, recording, moved, filtered, stack, lacking, other_lacking):
    """What belongs to the whole rig, and what the sensors may do; an encoder's errors by difference."""
    force = recording.force_n
    one = np.ones(len(force))
    late = np.gradient(force, recording.step_s)
    found += [
        ("payload", None, [stack(-moved.payload_nm())]),
        ("inertia_error", None, [stack(-moved.inertial_nm())]),
        ("gravity", None, [stack(moved.weight_nm(1.0)), stack(moved.weight_nm(1j))]),
        ("channel_skew", None, [filtered(moved.of_tip_force_nm(-late))]),
        ("force_gain", None, [filtered(moved.of_tip_force_nm(force))]),
        ("force_bias", None, [filtered(moved.of_tip_force_nm(one * unit)) for unit in (1.0, 1j)]),
        ("force_rotation", None, [filtered(moved.of_tip_force_nm(-1j * force))]),
    ]
    theta = recording.theta_rad
    for column, joint in enumerate("AB"):
        unit = np.eye(2)[column]
        shifted = other_lacking(theta + STEP_RAD * unit)
        scaled = other_lacking(theta + STEP_SHARE * unit * (theta - theta[0]))
        found.append(("encoder_offset", joint, [(shifted - lacking) / STEP_RAD]))
        found.append(("encoder_scale", joint, [(scaled - lacking) / STEP_SHARE]))


def other_lacking(recording, theta, smooth, signs, brakes, filtered, stack):
    """What the nominal model lacks if the angles are others, the brakes' torques kept."""
    moved = motion(recording.layout, *smooth.motion(theta))
    rows = moved.joint_rows()
    known = sum(rows[k] * (signs[k] * brake.torque_nm)[:, None] for k, brake in brakes.items())
    return filtered(moved.of_tip_force_nm(recording.force_n) - known) - stack(moved.inertial_nm())


class Brake:
    """A nominal brake along a recording."""

    def __init__(self, joint, recording, angle_rad, rate_rad_s):
        self.joint, self.angle_rad, self.rate_rad_s = joint, angle_rad, rate_rad_s
        self.current_a, self.step_s = recording.currents_a[joint], recording.step_s
        self.torque_nm = self.with_width(BACKLASH_DEG[joint])
        self.inside = inside_backlash(angle_rad, BACKLASH_DEG[joint])
        self.steady_nm = gain_nm(joint, np.where(self.inside, 0.0, self.current_a))

    def with_width(self, width_deg):
        return brake_nm(self.joint, self.current_a, self.angle_rad, self.rate_rad_s, self.step_s, width_deg)

    def with_play(self, half_a):
        """Steady torque if the current passes a play of this half width."""
        held, out = 0.0, []
        for current in self.current_a.tolist():
            held = max(min(max(held, current - half_a), current + half_a), 0.0)
            out.append(held)
        return gain_nm(self.joint, np.where(self.inside, 0.0, np.array(out)))


def bristle(angle_rad, travel_rad):
    """Dahl's bristle of unit level along a motion, slack at first."""
    bent, out = 0.0, [0.0]
    for moved in np.diff(angle_rad).tolist():
        way = math.copysign(1.0, moved)
        bent = way + (bent - way) * math.exp(-abs(moved) / travel_rad)
        out.append(bent)
    return np.array(out)


def travel_since_reversal(angle_rad, rate_rad_s):
    """Travel since the joint last turned round, rad; far away before the first time."""
    turned = np.flatnonzero(np.diff(np.sign(rate_rad_s)) != 0)
    path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(angle_rad)))])
    last = np.searchsorted(turned, np.arange(len(angle_rad)), side="left") - 1
    return np.where(last < 0, np.inf, path - path[turned[np.maximum(last, 0)]] if len(turned) else np.inf)
