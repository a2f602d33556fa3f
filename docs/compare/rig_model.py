"""This module says what the five-bar of the thesis needs along a motion: its linkage, its masses and its brakes, in numpy, with plane vectors as
complex numbers. Equations and numbers are the thesis's (tables 3.1 to 3.3, 4.1 and 5.1)."""

import math
from dataclasses import dataclass

import numpy as np

JOINTS = "AEBC"
BRAKES = {"three_brake": "AEB", "four_brake": "AEBC"}
# Table 4.1, m: AE, ED, BC, CD, AB.
ARMS_M = {"three_brake": (0.305, 0.305, 0.305, 0.305, 0.0), "four_brake": (0.264, 0.305, 0.264, 0.305, 0.267)}
# Table 5.1: mass in kg, inertia about the centre of mass in kg·m², distance of the centre in m, of AE, ED, BC, CD.
MASSES = {
    "three_brake": ((3.70, 0.0661, 0.166), (2.74, 0.0336, 0.096), (2.62, 0.0355, 0.109), (2.59, 0.0355, 0.188)),
    "four_brake": ((3.70, 0.0535, 0.152), (2.74, 0.0336, 0.096), (3.70, 0.0535, 0.152), (3.48, 0.0593, 0.140)),
}
# Table 3.1, degrees.
BACKLASH_DEG = {"A": 0.0, "E": 1.7, "B": 1.5, "C": 1.8}
# Table 3.2: k1 to k5.
GAIN = {
    "A": (6.09, 0.22, -3.68, 12.05, -0.84), "E": (4.32, 0.21, -2.72, 9.37, -0.71),
    "B": (4.72, 0.24, -2.14, 8.76, -0.49), "C": (4.74, 0.27, -2.21, 8.48, -0.39),
}
# Table 3.3: average, a1 to a6, for torque that rises and falls.
RISING = {
    "A": (0.0075, 0.0697, 0.0129, -0.0623, -0.0055, 0.0141, 0.0025), "E": (0.0070, 0.0317, 0.0063, -0.0344, -0.0017, 0.0094, 0.0012),
    "B": (0.0075, 0.0260, 0.0046, -0.0278, -0.0019, 0.0076, 0.0055), "C": (0.0064, 0.0451, -0.0088, -0.0185, 0.0055, -0.0020, 0.0019),
}
FALLING = {
    "A": (0.0061, 0.0010, -0.0009, -0.0017, 0.0004, 0.0007, 0.0066), "E": (0.0054, 0.0017, -0.0002, -0.0017, 0.0006, 0.0000, 0.0050),
    "B": (0.0057, 0.0018, -0.0007, -0.0015, 0.0011, -0.0003, 0.0052), "C": (0.0052, 0.0045, -0.0003, -0.0017, 0.0032, -0.0028, 0.0023),
}
# Decisions 0002 to 0004 and 0006: where the thesis leaves a choice, the recordings' nominal model has taken it.
ENTRY_DEG, FALL_END_NM = 0.02, 0.005
# The speeds at which the brakes were tested.
TESTED_RPM = 0.5, 64.0


def dot(a, b):
    return (np.conj(a) * b).real


def cross(a, b):
    return (np.conj(a) * b).imag


@dataclass
class Motion:
    """The linkage along a motion. Pairs of the coordinates θA and θB have them last."""

    theta_rad: np.ndarray
    rates_rad_s: np.ndarray
    layout: str
    # Unit vectors along AE, ED, BC, CD, how the arms turn with θA and θB, and their rates and accelerations.
    along: list
    turns: list
    rates: list
    accelerations: list

    def joint_rows(self):
        """Rates of the joints A, E, B, C per rate of θA and θB."""
        ae, ed, bc, cd = self.turns
        return [ae, ed - ae, bc, cd - bc]

    def joint_rates(self):
        return np.stack([np.sum(row * self.rates_rad_s, axis=-1) for row in self.joint_rows()])

    def joint_angles(self):
        ae, ed, bc, cd = self.along
        return np.stack([self.theta_rad[:, 0], np.angle(ed / ae), self.theta_rad[:, 1], np.angle(cd / bc)])

    def points(self, which, distance_m):
        """Jacobian (per θA and θB) and acceleration of the point at a distance along an arm."""
        first, own = {0: (None, 0), 1: (0, 1), 2: (None, 2), 3: (2, 3)}[which]
        jacobian, acceleration = 0.0, 0.0
        for arm, length_m in [(first, ARMS_M[self.layout][2 * (which // 2)]), (own, distance_m)]:
            if arm is not None:
                u = length_m * self.along[arm]
                jacobian = jacobian + (1j * u)[:, None] * self.turns[arm]
                acceleration = acceleration + (1j * self.accelerations[arm] - self.rates[arm] ** 2) * u
        return jacobian, acceleration

    def inertial_nm(self):
        """M·q̈ and the terms of velocity, N·m along θA and θB: Lagrange's equations, arm by arm."""
        total = 0.0
        for which, (mass_kg, inertia_kg_m2, centre_m) in enumerate(MASSES[self.layout]):
            jacobian, acceleration = self.points(which, centre_m)
            turning = inertia_kg_m2 * self.accelerations[which]
            total = total + mass_kg * dot(jacobian, acceleration[:, None]) + turning[:, None] * self.turns[which]
        return total

    def payload_nm(self):
        """The same of 1 kg at the tip."""
        jacobian, acceleration = self.points(1, ARMS_M[self.layout][1])
        return dot(jacobian, acceleration[:, None])

    def weight_nm(self, field):
        """What a field (m/s², complex) that accelerates every mass alike does along θA and θB."""
        masses = enumerate(MASSES[self.layout])
        return sum(mass_kg * dot(self.points(which, centre_m)[0], field) for which, (mass_kg, _, centre_m) in masses)

    def of_tip_force_nm(self, force_n):
        """What a force on the tip (complex) does along θA and θB."""
        return dot(self.points(1, ARMS_M[self.layout][1])[0], force_n[:, None])


def motion(layout, theta_rad, rates_rad_s, accelerations_rad_s2):
    """The linkage by the intersection of two circles, with the arms' rates and accelerations."""
    ae_m, ed_m, bc_m, cd_m, ab_m = ARMS_M[layout]
    ae, bc = np.exp(1j * theta_rad).T
    e, c = ae_m * ae - ab_m / 2, bc_m * bc + ab_m / 2
    base = c - e
    square = np.abs(base) ** 2
    share = 0.5 * (1 + (ed_m**2 - cd_m**2) / square)
    # Where a faulty angle tears the arms apart they are taken to touch just so.
    height = np.sqrt(np.maximum(ed_m**2 / square - share**2, 1e-6))
    tip = e + (share + 1j * height) * base
    ed, cd = (tip - e) / ed_m, (tip - c) / cd_m

    def closed(right_side):
        """Arm ED's and CD's turning that carries the tip alike by either way round."""
        p, q = 1j * ed_m * ed, -1j * cd_m * cd
        return cross(right_side, q) / cross(p, q), cross(p, right_side) / cross(p, q)

    by_a, by_b = closed(-1j * ae_m * ae), closed(1j * bc_m * bc)
    one, none = np.ones(len(ae)), np.zeros(len(ae))
    turns = [np.stack(pair, axis=-1) for pair in [(one, none), (by_a[0], by_b[0]), (none, one), (by_a[1], by_b[1])]]
    rates = [np.sum(turn * rates_rad_s, axis=-1) for turn in turns]
    (a2, b2) = accelerations_rad_s2.T
    of_e = ae_m * ae * (1j * a2 - rates[0] ** 2) - ed_m * ed * rates[1] ** 2
    of_c = bc_m * bc * (1j * b2 - rates[2] ** 2) - cd_m * cd * rates[3] ** 2
    ed2, cd2 = closed(of_c - of_e)
    return Motion(theta_rad, rates_rad_s, layout, [ae, ed, bc, cd], turns, rates, [a2, ed2, b2, cd2])


def gain_nm(joint, current_a):
    """Steady torque of a current (3.3), between the off-state torque and the torque at 1 A."""
    k1, k2, k3, k4, k5 = GAIN[joint]
    fitted = np.where(current_a < 0.2, k1 * current_a + k2, (k3 * current_a + k4) * current_a + k5)
    return np.clip(fitted, k2, k3 + k4 + k5)


class Backlash:
    """The backlash window of a brake (§3.4.3), which begins around the shaft."""

    def __init__(self, angle_rad, width_deg):
        self.width, self.entry = math.radians(width_deg), math.radians(ENTRY_DEG)
        self.low, self.inside = angle_rad - self.width / 2, False

    def at(self, angle):
        """Whether the shaft is inside, with the window moved along by it."""
        if angle <= self.low:
            self.low, self.inside = angle, False
        elif angle >= self.low + self.width:
            self.low, self.inside = angle - self.width, False
        else:
            self.inside = self.inside or min(angle - self.low, self.low + self.width - angle) > self.entry
        return self.inside


def inside_backlash(angle_rad, width_deg):
    """Whether the shaft is inside its backlash window."""
    window = Backlash(angle_rad[0], width_deg)
    return np.array([window.at(angle) for angle in angle_rad.tolist()])


def slow_lag_terms_s(fit, log_rpm):
    """Time constant (3.6) of a slow brake as a constant and a factor of the current, of the binary logarithm of its speed."""
    _, a1, a2, a3, a4, a5, a6 = fit
    return (a4 * log_rpm + a2) * log_rpm + a6, (a5 * log_rpm + a3) * log_rpm + a1


def lag_terms_s(fit, threshold_rpm, speed_rpm):
    """Time constant (3.5), (3.6) as a constant and a factor of the current; the nearest tested speed."""
    speed_rpm = np.clip(speed_rpm, *TESTED_RPM)
    constant, per_a = slow_lag_terms_s(fit, np.log2(speed_rpm))
    fast = speed_rpm >= threshold_rpm
    return np.where(fast, fit[0], constant), np.where(fast, 0.0, per_a)


def brake_nm(joint, current_a, angle_rad, rate_rad_s, step_s, width_deg):
    """Yield torque along a motion, N·m, positive: (3.2) to (3.7), settled without current at first. A current holds until the next sample."""
    inside = inside_backlash(angle_rad, width_deg)
    held = np.concatenate([[0.0], current_a[:-1]])
    target = gain_nm(joint, np.where(inside, 0.0, held))
    tested = np.clip(held, 0.2, 1.0)
    speed_rpm = np.abs(rate_rad_s) * 30 / math.pi
    up, up_per_a = lag_terms_s(RISING[joint], 4.0, speed_rpm)
    rising = np.exp(-step_s / (up + up_per_a * tested))
    down, down_per_a = lag_terms_s(FALLING[joint], 2.0, speed_rpm)
    torque, origin, out = float(target[0]), 0.2, []
    for to, rise, fall, per_a, current in zip(*(x.tolist() for x in (target, rising, down, down_per_a, tested))):
        if torque - to <= FALL_END_NM:
            origin = current
        factor = math.exp(-step_s / (fall + per_a * origin)) if torque > to else rise
        torque = to + (torque - to) * factor
        out.append(torque)
    return np.array(out)
