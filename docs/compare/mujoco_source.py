"""Recordings of one driven hinge in MuJoCo with a hidden cause, in MuJoCo's own terms: a source of truth that shares nothing with the project.

A motor turns a hinge with frictionloss, damping, armature and stiffness; a servo in this file tracks sines and triangles from encoder counts and
holds its torque from one millisecond to the next. What is hidden is one or two of: another frictionloss, damping or armature than the description
states, a stiffness (about the start or elsewhere), another gear, a first-order actuator, a delayed command, and play between two hinges. Written are
NAME.csv (t, q, u), NAME.toml (the description) and key/NAME.json (what is hidden, and which names are right).

    python mujoco_source.py FOLDER --seed 0 --count 100
"""
import argparse
import json
import math
import pathlib

import mujoco
import numpy as np

RATE_HZ, SUBSTEPS = 1000, 8
# What can be hidden, with the names of the vocabulary that are right about it.
RIGHT = {
    "frictionloss": ["dry_offset"],
    "damping": ["viscous"],
    "armature": ["added_inertia", "inertia_error", "payload"],
    "stiffness": ["spring"],
    "springref": ["spring"],
    "gear": ["gain_error"],
    "filter": ["lag", "dead_time"],
    "delay": ["dead_time", "channel_skew", "lag"],
    "backlash": ["load_backlash", "backlash_width", "backlash", "compliance"],
}
COMPANIONS = {"springref": ["constant_bias"], "filter": ["channel_skew"],
              "backlash": ["presliding", "hysteresis", "inertia_error", "payload"]}

XML = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{dt}" gravity="0 0 0" integrator="implicitfast" cone="elliptic" iterations="60" tolerance="1e-12"/>
  <worldbody>
    <body>
      <joint name="motor" type="hinge" axis="0 0 1" armature="{armature}" damping="{damping}" frictionloss="{friction}"
             stiffness="{stiffness}" springref="{springref}" solreffriction="0.0008 1"/>
      <inertial pos="0 0 0" mass="0.1" diaginertia="{motor} {motor} {motor}"/>
      {load}
    </body>
  </worldbody>
  <actuator>{actuator}</actuator>
</mujoco>
"""
LOAD = """<body><joint name="play" type="hinge" axis="0 0 1" limited="true" range="{low} {high}" solreflimit="0.0012 1"/>
        <inertial pos="0 0 0" mass="0.1" diaginertia="{inertia} {inertia} {inertia}"/></body>"""


def draw(rng):
    """A laboratory: the machine that the description states, the loop, the sensors."""
    travel, frequency = rng.uniform(0.4, 1.5), rng.uniform(0.5, 1.1)
    omega = 2 * math.pi * frequency
    inertia = math.exp(rng.uniform(math.log(0.004), math.log(0.1)))
    effort = inertia * travel * omega**2
    return {
        "travel": travel, "frequency": frequency, "inertia": inertia, "effort": effort, "speed": 0.5 * travel * omega,
        "friction": effort * rng.uniform(0.08, 0.3), "damping": effort / (0.5 * travel * omega) * rng.uniform(0.08, 0.3),
        "counts": int(rng.choice([4096, 8192, 20000, 65536, 100000])), "noise": effort * rng.uniform(0.001, 0.006),
        "seconds": float(rng.integers(12, 19)), "bandwidth": rng.uniform(3, 6), "phases": rng.uniform(0, 2 * math.pi, 5).tolist(),
        "known": {name: bool(rng.random() < 0.6) for name in ("inertia", "friction", "damping")},
    }


def hide(rng, lab):
    """None, one or two causes; a number can be wrong only where the description says that it knows it."""
    stated = {"frictionloss": "friction", "damping": "damping", "armature": "inertia"}
    kinds = [kind for kind in RIGHT if kind not in stated or lab["known"][stated[kind]]]
    if not any(lab["known"].values()):  # With every number open a gear is one of the others.
        kinds.remove("gear")
    count = rng.choice([0, 1, 1, 1, 1, 2])
    names = [str(name) for name in rng.choice(kinds, size=count, replace=False)]
    names = [name for name in names if name != "springref" or "stiffness" not in names]
    sign = float(rng.choice([-1, 1]))
    wrong = rng.uniform(0.4, 1.5) if sign > 0 else -rng.uniform(0.4, 0.8)
    amounts = {
        "frictionloss": {"more": lab["friction"] * wrong}, "damping": {"more": lab["damping"] * wrong},
        "armature": {"more": lab["inertia"] * rng.uniform(0.1, 0.6)},
        "stiffness": {"stiffness": lab["effort"] / lab["travel"] * rng.uniform(0.1, 0.5), "springref": 0.0},
        "springref": {"stiffness": lab["effort"] / lab["travel"] * rng.uniform(0.1, 0.4), "springref": sign * lab["travel"] * rng.uniform(0.3, 1)},
        "gear": {"gear": 1 + sign * rng.uniform(0.08, 0.3)},
        "filter": {"time": rng.uniform(0.004, 0.02)},
        "delay": {"samples": int(rng.integers(3, 16))},
        "backlash": {"gap": lab["travel"] * rng.uniform(0.01, 0.06), "share": rng.uniform(0.3, 0.6)},
    }
    return {name: amounts[name] for name in names}


def model(lab, hidden):
    get = lambda kind, name: hidden.get(kind, {}).get(name, 0.0)
    inertia = lab["inertia"] + get("armature", "more")
    load_inertia = get("backlash", "share") * inertia
    half = 0.5 * get("backlash", "gap")
    load = LOAD.format(low=-half, high=half, inertia=load_inertia) if half else ""
    gear = get("gear", "gear") or 1.0
    spring = hidden.get("stiffness") or hidden.get("springref") or {"stiffness": 0.0, "springref": 0.0}
    if "filter" in hidden:
        lag = f'dyntype="filter" dynprm="{hidden["filter"]["time"]}"'
        drive = f'<general joint="motor" gear="{gear}" {lag} gainprm="1" biastype="none"/>'
    else:
        drive = f'<motor joint="motor" gear="{gear}"/>'
    half_own = 0.5 * (inertia - load_inertia)
    return mujoco.MjModel.from_xml_string(XML.format(
        dt=1 / (RATE_HZ * SUBSTEPS), armature=half_own, motor=half_own, damping=lab["damping"] + get("damping", "more"),
        friction=lab["friction"] + get("frictionloss", "more"), stiffness=spring["stiffness"],
        springref=spring["springref"], load=load, actuator=drive))


def reference(lab, t):
    """Sines of unlike frequencies, then slow triangles, then a sine that grows: eased in from rest."""
    third = lab["seconds"] / 3
    omega = 2 * math.pi * lab["frequency"]
    if t < third:
        wave = sum(0.5 / (0.6 + r * r) * math.sin(omega * r * t + p) for r, p in zip((0.31, 0.67, 1.0, 1.43, 2.1), lab["phases"]))
    elif t < 2 * third:
        wave = 0.8 * math.asin(0.99 * math.sin(0.3 * omega * (t - third))) / math.asin(0.99)
    else:
        wave = (t - 2 * third) / third * math.sin(omega * (t - 2 * third))
    edge = min(t % third, third - t % third) / 0.4
    return lab["travel"] * wave * (1.0 if edge >= 1 else edge**3 * (10 + edge * (6 * edge - 15)))


def simulate(lab, hidden, rng):
    m = model(lab, hidden)
    data = mujoco.MjData(m)
    count, natural = int(lab["seconds"] * RATE_HZ), 2 * math.pi * lab["bandwidth"]
    quantum, zero = 2 * math.pi / lab["counts"], rng.random()
    late = hidden.get("delay", {}).get("samples", 0)
    commands, angles, rate, before, aim_before = [0.0] * late, np.empty(count), 0.0, 0.0, 0.0
    for k in range(count):
        seen = math.floor(data.qpos[0] / quantum + zero) * quantum
        rate += ((seen - before) * RATE_HZ - rate) / 4
        aim = reference(lab, k / RATE_HZ)
        command = lab["inertia"] * (natural**2 * (aim - seen) + 1.8 * natural * ((aim - aim_before) * RATE_HZ - rate))
        before, aim_before = seen, aim
        commands.append(float(np.clip(command, -40 * lab["effort"], 40 * lab["effort"])))
        angles[k] = seen
        data.ctrl[0] = commands[k]
        mujoco.mj_step(m, data, SUBSTEPS)
    return angles, np.array(commands[late:]) + rng.normal(0, lab["noise"], count)


def description(name, lab, rng):
    def number(key, value, unit):
        known = lab["known"][key]
        stated = value if known else float(f"{value * rng.uniform(0.4, 2.0):.3g}")
        return f'{{ value = {stated!r}, unit = "{unit}", status = "{"known" if known else "unknown"}" }}'
    return f"""name = "{name}"
plant = "axis"
motion = "rotary"

[channels]
time = {{ channel = "t", unit = "s" }}
position = {{ channel = "q", unit = "rad", quantum = {2 * math.pi / lab["counts"]!r} }}
command = {{ channel = "u", unit = "N·m", noise = {lab["noise"]!r} }}

[parameters]
inertia = {number("inertia", lab["inertia"], "kg·m^2/rad")}
command_gain = {{ value = 1.0, unit = "1", status = "known" }}

[[effect]]
mechanism = "dry_offset"
level = {number("friction", lab["friction"], "N·m")}

[[effect]]
mechanism = "viscous"
coefficient = {number("damping", lab["damping"], "N·m·s/rad")}

[protocol]
drive = "held"
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    for name, default in (("--seed", 0), ("--count", 100)):
        parser.add_argument(name, type=int, default=default)
    args = parser.parse_args()
    (args.folder / "key").mkdir(parents=True, exist_ok=True)
    for seed in range(args.seed, args.seed + args.count):
        rng = np.random.default_rng(seed)
        lab = draw(rng)
        hidden = hide(rng, lab)
        angles, commands = simulate(lab, hidden, rng)
        name = f"mj_{seed:03}"
        rows = "".join(f"{k / RATE_HZ:g},{q:.9g},{u:.9g}\n" for k, (q, u) in enumerate(zip(angles, commands)))
        (args.folder / f"{name}.csv").write_text("t,q,u\n" + rows)
        (args.folder / f"{name}.toml").write_text(description(name, lab, rng))
        key = {"seed": seed, "laboratory": lab, "effects": hidden, "right": {kind: RIGHT[kind] for kind in hidden},
               "companions": {kind: COMPANIONS.get(kind, []) for kind in hidden}}
        (args.folder / "key" / f"{name}.json").write_text(json.dumps(key, indent=1) + "\n")


if __name__ == "__main__":
    main()
