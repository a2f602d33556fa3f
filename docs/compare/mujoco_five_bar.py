"""Recordings of the five-bar in MuJoCo with a hidden cause: a source of truth that shares nothing with the project but the thesis's numbers.

Four bodies hang at hinges and are closed by an equality; each brake is the frictionloss of its hinge, set anew at every step (tables 3.1 to 3.3,
`rig_model.py`). A hand, which is a spring, a damper and a tremor, leads the tip along a path of sines; the brakes get steps of current. What is
hidden is one or two of `KINDS`. Written are NAME.csv, NAME.toml (the description) and key/NAME.json (what is hidden, and which names are right).

    python mujoco_five_bar.py FOLDER --seed 0 --count 40
"""
import argparse
import json
import math
import pathlib

import mujoco
import numpy as np

from rig_model import ARMS_M, BACKLASH_DEG, BRAKES, FALL_END_NM, FALLING, JOINTS, MASSES, RISING, TESTED_RPM, Backlash, gain_nm, slow_lag_terms_s

RATE_HZ, SUBSTEPS = 1000, 8
STEP_S = 1 / (RATE_HZ * SUBSTEPS)
COUNT_RAD, NOISE_N, FORCE_STEP_N = 2 * math.pi / 100_000, 0.02, 0.0326
SETTLE_S = 1.0

# What can be hidden: how to draw it from a generator and a letter of a brake, and the names of the vocabulary that are right about it.
KINDS = {
    "coulomb": (lambda rng, brake: {brake: rng.uniform(0.05, 0.3)}, ["dry_offset", "bearing_friction"]),
    "damping": (lambda rng, brake: {brake: rng.uniform(0.05, 0.4)}, ["viscous"]),
    "bias": (lambda rng, brake: {brake: rng.choice([-1, 1]) * rng.uniform(0.05, 0.3)}, ["constant_bias"]),
    "stiffness": (lambda rng, brake: {brake: rng.uniform(0.4, 2.0)}, ["spring"]),
    "springs": (lambda rng, brake: {"stiffness": rng.uniform(8, 25), "x": rng.uniform(-0.2, 0.2), "y": rng.uniform(-0.1, 0.1),
                                    "rest": rng.uniform(0.0, 0.15)}, ["spring", "plane_spring"]),
    "payload": (lambda rng, brake: {"mass": rng.uniform(0.25, 0.8)}, ["payload", "inertia_error"]),
    "armature": (lambda rng, brake: {brake: rng.uniform(0.01, 0.04)}, ["inertia_error", "payload", "added_inertia"]),
    "gravity": (lambda rng, brake: {"x": rng.uniform(-0.4, 0.4), "y": rng.uniform(-0.4, 0.4)}, ["gravity"]),
    "gain": (lambda rng, brake: {brake: 1 + rng.choice([-1, 1]) * rng.uniform(0.08, 0.3)}, ["gain_error", "current_gain"]),
    "scale": (lambda rng, brake: {"scale": rng.choice([rng.uniform(0.5, 0.75), rng.uniform(1.4, 2.0)])}, ["time_constant", "lag"]),
    "filter": (lambda rng, brake: {"time": rng.uniform(0.006, 0.03)}, ["lag", "dead_time"]),
    "delay": (lambda rng, brake: {"samples": int(rng.integers(3, 15))}, ["dead_time", "channel_skew", "lag"]),
    "late_force": (lambda rng, brake: {"samples": int(rng.integers(4, 15))}, ["channel_skew"]),
    "overshoot": (lambda rng, brake: {"amplitude": rng.uniform(0.15, 0.4), "travel": rng.uniform(0.03, 0.1)},
                  ["reversal_overshoot", "friction_overshoot"]),
    "peak": (lambda rng, brake: {"amplitude": rng.uniform(0.15, 0.45), "speed": rng.uniform(0.04, 0.15)}, ["stribeck"]),
    "asymmetry": (lambda rng, brake: {brake: rng.choice([-1, 1]) * rng.uniform(0.06, 0.2)}, ["direction_asymmetry", "constant_bias"]),
    "ripple": (lambda rng, brake: {brake: rng.uniform(0.05, 0.15), "order": int(rng.integers(5, 24)), "phase": rng.uniform(0, 6)}, ["ripple"]),
    "fade": (lambda rng, brake: {"share": rng.uniform(0.1, 0.3), "time": rng.uniform(3, 10)}, ["thermal_fade", "friction_fade"]),
    "wide": (lambda rng, brake: {"EB"[rng.integers(2)]: rng.uniform(1.5, 3.0)}, ["backlash_width"]),
    "force_gain": (lambda rng, brake: {"xy"[rng.integers(2)]: 1 + rng.choice([-1, 1]) * rng.uniform(0.06, 0.15)}, ["force_gain"]),
    "turned": (lambda rng, brake: {"angle": rng.choice([-1, 1]) * rng.uniform(0.04, 0.12)}, ["force_rotation"]),
    "tare": (lambda rng, brake: {"x": rng.uniform(-0.8, 0.8), "y": rng.uniform(-0.8, 0.8)}, ["force_bias"]),
    "magnet": (lambda rng, brake: {"radius": rng.uniform(0.04, 0.12), "share": rng.uniform(0.2, 0.5)}, ["current_hysteresis"]),
    "length": (lambda rng, brake: {"BC": rng.choice([-1, 1]) * rng.uniform(0.001, 0.004)}, ["link_length"]),
}
# Names that stand beside a right one without being false.
COMPANIONS = {"peak": ["lugre_bristle"], "asymmetry": ["dry_offset"], "filter": ["time_constant"], "scale": ["dead_time"]}

XML = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{step}" gravity="{gx} {gy} 0" integrator="implicitfast" cone="elliptic" iterations="50" tolerance="1e-12" noslip_iterations="20"/>
  <worldbody>{left}{right}</worldbody>
  <equality><connect site1="tip_ED" site2="tip_CD" solref="0.0006 1" solimp="0.999 0.9999 0.001"/></equality>
</mujoco>
"""
ARM = """<body name="{name}" pos="{x} 0 0"><joint name="{joint}" type="hinge" axis="0 0 1" ref="0" {own} solreffriction="0.0008 1"/>
  <inertial pos="{centre} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/><site name="tip_{name}" pos="{length} 0 0"/>{inner}</body>"""


def machine(layout, hidden):
    """The linkage in MuJoCo, with what is hidden in its own terms."""
    lengths, masses = list(ARMS_M[layout]), MASSES[layout]
    lengths[2] += hidden.get("length", {}).get("BC", 0.0)
    of = lambda kind, joint: hidden.get(kind, {}).get(joint, 0.0)
    payload = hidden.get("payload", {}).get("mass", 0.0)

    def arm(which, name, joint, x, inner, load=0.0):
        mass, inertia, centre = masses[which]
        total = mass + load
        both = (mass * centre + load * lengths[which]) / total
        about = inertia + mass * (centre - both) ** 2 + load * (lengths[which] - both) ** 2
        own = f'frictionloss="0.01" damping="{of("damping", joint)}" armature="{of("armature", joint)}"'
        return ARM.format(name=name, joint=joint, x=x, own=own, length=lengths[which], centre=both, mass=total, inertia=about, inner=inner)

    gravity = hidden.get("gravity", {"x": 0.0, "y": 0.0})
    outer = arm(1, "ED", "E", lengths[0], "", payload), arm(3, "CD", "C", lengths[2], "")
    return mujoco.MjModel.from_xml_string(XML.format(
        step=STEP_S, gx=gravity["x"], gy=gravity["y"], left=arm(0, "AE", "A", -lengths[4] / 2, outer[0]),
        right=arm(2, "BC", "B", lengths[4] / 2, outer[1]))), lengths


def pose(tip, lengths):
    """Angles of the hinges A, E, B, C with the tip at a point: the arms bend outward."""
    def side(base, first, second, outward):
        reach, along = abs(tip - base), np.angle(tip - base)
        inner = math.acos((first**2 + reach**2 - second**2) / (2 * first * reach))
        angle = along + outward * inner
        elbow = base + first * np.exp(1j * angle)
        bend = np.angle((tip - elbow) / np.exp(1j * angle))
        return float(angle), float(bend)
    return (*side(-lengths[4] / 2, lengths[0], lengths[1], 1), *side(lengths[4] / 2, lengths[2], lengths[3], -1))


class Brake:
    """The yield torque of a brake of the thesis, step by step, with what is hidden at it."""

    def __init__(self, joint, angle, hidden):
        self.joint, self.hidden = joint, hidden
        self.backlash = Backlash(angle, BACKLASH_DEG[joint] + hidden.get("wide", {}).get(joint, 0.0))
        self.torque, self.origin = float(gain_nm(joint, np.array(0.0))), 0.2
        self.current = self.memory = 0.0
        self.sense, self.turned_at, self.turned = 0.0, angle, False
        self.table = [float(x) for x in gain_nm(joint, np.linspace(0, 1.2, 1201))]

    def steady(self, current):
        place = min(max(current, 0.0), 1.1999) * 1000
        k = int(place)
        return self.table[k] + (place - k) * (self.table[k + 1] - self.table[k])

    def amplified(self, command):
        """The current that magnetises: gain, filter and play of the hidden kinds."""
        wanted = command * self.hidden.get("gain", {}).get(self.joint, 1.0)
        if "filter" in self.hidden:
            self.current += (wanted - self.current) * (1 - math.exp(-STEP_S / self.hidden["filter"]["time"]))
        else:
            self.current = wanted
        magnet = self.hidden.get("magnet")
        if not magnet:
            return self.current
        self.memory = min(max(self.memory, self.current - magnet["radius"]), self.current + magnet["radius"])
        return (1 - magnet["share"]) * self.current + magnet["share"] * self.memory

    def step(self, command, angle, rate):
        current = self.amplified(command)
        target = self.steady(0.0 if self.backlash.at(angle) else current)
        tested = min(max(current, 0.2), 1.0)
        if self.torque - target <= FALL_END_NM:
            self.origin = tested
        fit, threshold, amps = (FALLING, 2.0, self.origin) if self.torque > target else (RISING, 4.0, tested)
        slowest, fastest = TESTED_RPM
        rpm = min(max(abs(rate) * 30 / math.pi, slowest), fastest)
        constant, per_a = slow_lag_terms_s(fit[self.joint], math.log2(rpm))
        time = (fit[self.joint][0] if rpm >= threshold else constant + per_a * amps) * self.hidden.get("scale", {}).get("scale", 1.0)
        self.torque = target + (self.torque - target) * math.exp(-STEP_S / time)
        return self.torque

    def shown(self, angle, rate, time):
        """The torque with what is hidden as a share of it."""
        own, torque = self.hidden, self.torque
        sense = math.copysign(1.0, rate) if abs(rate) > 1e-4 else self.sense
        if sense != self.sense:
            self.turned = self.turned or self.sense != 0.0
            self.sense, self.turned_at = sense, angle
        share = 1.0
        if "peak" in own:
            share += own["peak"]["amplitude"] * math.exp(-((rate / own["peak"]["speed"]) ** 2))
        if "overshoot" in own and self.turned:
            share += own["overshoot"]["amplitude"] * math.exp(-abs(angle - self.turned_at) / own["overshoot"]["travel"])
        if self.joint in own.get("asymmetry", {}):
            share += own["asymmetry"][self.joint] * sense
        if self.joint in own.get("ripple", {}):
            share += own["ripple"][self.joint] * math.cos(own["ripple"]["order"] * angle + own["ripple"]["phase"])
        if "fade" in own:
            share -= own["fade"]["share"] * (1 - math.exp(-max(time, 0.0) / own["fade"]["time"]))
        return torque * share + own.get("coulomb", {}).get(self.joint, 0.0)


class Lab:
    """A hand, a path and currents."""

    def __init__(self, rng):
        self.layout = str(rng.choice(["three_brake", "four_brake"]))
        self.seconds = float(rng.choice([8, 8, 12, 12, 16]))
        self.centre = complex(rng.uniform(-0.03, 0.03), rng.uniform(0.34, 0.39))
        self.stiffness, self.damping = rng.uniform(250, 700), rng.uniform(15, 35)
        reach, pace = rng.uniform(0.02, 0.05), rng.uniform(0.15, 0.5)
        self.waves = [(reach * (0.6 if k else 1.0), pace * (1 + 0.83 * k) * rng.uniform(0.9, 1.1), rng.uniform(0, 6.3), rng.uniform(0, 6.3))
                      for k in range(3)]
        self.tremor = rng.uniform(0.05, 0.3), rng.uniform(8, 11), rng.uniform(0, 6.3)
        count = round((self.seconds + SETTLE_S) * RATE_HZ)
        self.commands = np.zeros((count, 4))
        for joint in range(len(BRAKES[self.layout])):
            at = 0
            while at < count:
                hold = round(rng.uniform(0.25, 0.9) * RATE_HZ)
                self.commands[at:at + hold, joint] = rng.choice([0.0, rng.uniform(0.03, 0.5), rng.uniform(0.03, 0.5)])
                at += hold
        self.says_held = bool(rng.random() < 0.5)

    def aim(self, time):
        edge = min(max(time + SETTLE_S, 0.0) / SETTLE_S, 1.0)
        x = sum(size * math.sin(2 * math.pi * pace * time + p) for size, pace, p, _ in self.waves)
        y = sum(size * math.sin(2 * math.pi * pace * 0.93 * time + q) for size, pace, _, q in self.waves)
        return self.centre + edge * edge * (3 - 2 * edge) * complex(x, y)

    def shake(self, time):
        size, pace, phase = self.tremor
        return size * complex(math.sin(2 * math.pi * pace * time + phase), math.cos(2 * math.pi * 0.87 * pace * time))


def simulate(lab, hidden):
    """Angles and forces at every sample: true ones, before the sensors."""
    model, lengths = machine(lab.layout, hidden)
    data, order = mujoco.MjData(model), [model.joint(joint).dofadr[0] for joint in JOINTS]
    start = pose(lab.centre, lengths)
    for dof, angle in zip(order, start):
        data.qpos[dof] = angle
    mujoco.mj_forward(model, data)
    body, count = model.body("ED").id, len(lab.commands)
    brakes = [Brake(joint, angle, hidden) for joint, angle in zip(JOINTS, start)]
    late = hidden.get("delay", {}).get("samples", 0)
    of = lambda kind, joint: hidden.get(kind, {}).get(joint, 0.0)
    springs = hidden.get("springs")
    reach = lengths[1]
    angles, forces = np.empty((count, 2)), np.empty(count, complex)
    for k in range(count):
        commands = lab.commands[max(k - late, 0)]
        for sub in range(SUBSTEPS):
            time = k / RATE_HZ + sub * STEP_S - SETTLE_S
            axes = data.xmat[body]
            centre = complex(data.xipos[body][0], data.xipos[body][1])
            elbow = complex(data.xpos[body][0], data.xpos[body][1])
            along = complex(axes[0], axes[3])
            tip = elbow + reach * along
            ea, ee = data.qvel[order[0]], data.qvel[order[0]] + data.qvel[order[1]]
            velocity = 1j * ea * (elbow + lengths[4] / 2) + 1j * ee * reach * along
            hand = lab.stiffness * (lab.aim(time) - tip) - lab.damping * velocity + lab.shake(time)
            if sub == 0:
                angles[k] = data.qpos[order[0]], data.qpos[order[2]]
                forces[k] = hand
            total = hand
            if springs:
                stretch = complex(springs["x"], springs["y"]) - tip
                total += springs["stiffness"] * (abs(stretch) - springs["rest"]) * stretch / abs(stretch)
            arm = tip - centre
            data.xfrc_applied[body] = (total.real, total.imag, 0, 0, 0, arm.real * total.imag - arm.imag * total.real)
            for which, brake in enumerate(brakes):
                dof = order[which]
                angle, rate = data.qpos[dof], data.qvel[dof]
                if brake.joint in BRAKES[lab.layout]:
                    brake.step(commands[which], angle, rate)
                    model.dof_frictionloss[dof] = max(brake.shown(angle, rate, time), 0.0)
                else:
                    model.dof_frictionloss[dof] = 0.0
                data.qfrc_applied[dof] = of("bias", brake.joint) - of("stiffness", brake.joint) * (angle - start[which])
            mujoco.mj_step(model, data)
    skip = round(SETTLE_S * RATE_HZ)
    return angles[skip:], forces[skip:], lab.commands[skip:]


def sensed(angles, forces, hidden, rng):
    """What encoders and force sensor show."""
    shift = rng.random(2) * COUNT_RAD
    counted = np.floor((angles + shift) / COUNT_RAD) * COUNT_RAD
    late = hidden.get("late_force", {}).get("samples", 0)
    forces = np.concatenate([np.full(late, forces[0]), forces[:len(forces) - late]])
    turned = forces * np.exp(1j * hidden.get("turned", {}).get("angle", 0.0))
    tare, gain = hidden.get("tare", {"x": 0, "y": 0}), hidden.get("force_gain", {})
    x = turned.real * gain.get("x", 1.0) + tare["x"] + rng.normal(0, NOISE_N, len(forces))
    y = turned.imag * gain.get("y", 1.0) + tare["y"] + rng.normal(0, NOISE_N, len(forces))
    return counted, np.round(x / FORCE_STEP_N) * FORCE_STEP_N, np.round(y / FORCE_STEP_N) * FORCE_STEP_N


def description(name, lab):
    noise = math.hypot(NOISE_N, FORCE_STEP_N / math.sqrt(12))
    currents = "\n".join(f'current_{j.lower()} = {{ channel = "I_{j}", unit = "A" }}' for j in BRAKES[lab.layout])
    angles = "\n".join(f'theta_{j} = {{ channel = "theta_{j.upper()}", unit = "rad", quantum = {COUNT_RAD!r} }}' for j in "ab")
    forces = "\n".join(f'force_{axis} = {{ channel = "F_{axis}", unit = "N", noise = {noise:.3g} }}' for axis in "xy")
    drive = 'drive = "held"\n' if lab.says_held else ""
    return (f'name = "{name}"\nplant = "rig"\nlayout = "{lab.layout}"\n\n[channels]\ntime = {{ channel = "t", unit = "s" }}\n'
            f"{angles}\n{forces}\n{currents}\n\n[protocol]\n{drive}start_samples = 20\n")


def write(folder, seed):
    rng = np.random.default_rng(seed)
    lab = Lab(rng)
    names = rng.choice(list(KINDS), size=rng.choice([0, 1, 1, 1, 1, 2]), replace=False)
    hidden = {}
    for name in names:
        hidden[str(name)] = KINDS[name][0](rng, str(rng.choice(list(BRAKES[lab.layout]))))
    angles, forces, commands = simulate(lab, hidden)
    counted, x, y = sensed(angles, forces, hidden, rng)
    name, brakes = f"mf_{seed:03}", BRAKES[lab.layout]
    rows = (f"{k / RATE_HZ:g},{a:.9g},{b:.9g},{fx:.4f},{fy:.4f}," + ",".join(f"{i:.9g}" for i in now[:len(brakes)])
            for k, ((a, b), fx, fy, now) in enumerate(zip(counted, x, y, commands)))
    header = "t,theta_A,theta_B,F_x,F_y," + ",".join(f"I_{j}" for j in brakes)
    (folder / f"{name}.csv").write_text("\n".join([header, *rows]) + "\n")
    (folder / f"{name}.toml").write_text(description(name, lab))
    key = {"seed": seed, "layout": lab.layout, "seconds": lab.seconds, "effects": hidden,
           "right": {kind: KINDS[kind][1] for kind in hidden}, "companions": {kind: COMPANIONS.get(kind, []) for kind in hidden}}
    (folder / "key" / f"{name}.json").write_text(json.dumps(key, indent=1, default=float) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    for name, default in (("--seed", 0), ("--count", 40)):
        parser.add_argument(name, type=int, default=default)
    args = parser.parse_args()
    (args.folder / "key").mkdir(parents=True, exist_ok=True)
    for seed in range(args.seed, args.seed + args.count):
        write(args.folder, seed)


if __name__ == "__main__":
    main()
