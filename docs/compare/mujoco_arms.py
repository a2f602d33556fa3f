"""Recordings of serial arms in MuJoCo with a hidden cause, in MuJoCo's own terms: a source of truth that shares nothing with the project.

An arm of two to seven joints with links of possible bodies; a servo in this file (computed torque of the described arm, from encoder counts, 4 kHz)
leads it along sums of sines, so that friction stops and frees its joints. As it comes, MuJoCo's frictionloss lets a joint creep where it should stand;
here it is made a thousand times stiffer. What is hidden is none, one or two of: more frictionloss, more damping or
another armature at a joint, another mass of a link, a payload, another gear of a joint, an effort that is recorded late, and a described friction that
is absent. Written are NAME.csv (t, q1, effort1, ...), NAME.urdf and NAME.toml (the description) and key/NAME.json (what is hidden, how
much of it shows in the noise of the sensors, and which names are right).

    python mujoco_arms.py FOLDER --seed 0 --count 30
    python mujoco_arms.py FOLDER --seed 0 --count 30 --kinds stiffness frictionloss damping
"""
import argparse
import json
import math
import pathlib

import mujoco
import numpy as np

RATE_HZ, SERVO = 500, 8


def turned(roll, pitch, yaw):
    """The matrix of fixed-axis angles, as a URDF has them."""
    quaternion, matrix = np.zeros(4), np.zeros(9)
    mujoco.mju_euler2Quat(quaternion, np.array([roll, pitch, yaw]), "XYZ")
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def box(long, heavy, rng):
    """A turned box: mass, centre and moments that a body can have."""
    mass, along = heavy * rng.uniform(0.6, 1.4), int(rng.integers(3))
    sides = long * rng.uniform(0.2, 0.5, 3)
    sides[along] = long * rng.uniform(0.8, 1.2)
    turn = turned(*rng.uniform(-0.4, 0.4, 3))
    moments = turn @ np.diag(mass / 12 * (np.sum(sides**2) - sides**2)) @ turn.T
    centre = long * rng.uniform(-0.12, 0.12, 3)
    centre[along] = rng.choice([-1, 1]) * long * rng.uniform(0.25, 0.55)
    return {"mass": mass, "centre": centre, "moments": moments}


def draw_arm(rng):
    """The described arm: a list of joints with the links that they move, and the flange."""
    count = int(rng.integers(2, 8))
    size = math.exp(rng.uniform(math.log(0.5), math.log(1.2)))
    heavy = math.exp(rng.uniform(math.log(0.8), math.log(4))) * size**2
    joints = []
    for k in range(count):
        outward = 1 - 0.75 * k / count
        long = size * outward * rng.uniform(0.2, 0.45)
        place = [[long, 0, 0], [0, long, 0.1 * long], [0.1 * long, 0, long]][int(rng.integers(3))]
        angles = [rng.choice([-0.5, 0, 0.5, 0]) * math.pi, rng.uniform(-0.6, 0.6) if rng.random() < 0.3 else 0, rng.choice([-0.5, 0, 0.5, 0]) * math.pi]
        if k == 0:
            angles = [math.pi / 2, 0, 0] if rng.random() < 0.5 else [0, 0, rng.uniform(-3, 3)]
        joints.append({"name": f"joint{k + 1}", "place": np.array(place), "angles": np.array(angles, float), "slides": k > 0 and rng.random() < 0.1,
                       "link": box(long, heavy * outward**2, rng), "friction": 0.0, "damping": 0.0, "armature": 0.0, "gear": 1.0, "stiffness": 0.0})
    return joints, np.array([0, 0, size * rng.uniform(0.08, 0.2)])


def heavier(link, mass):
    share = mass / link["mass"]
    return {"mass": mass, "centre": link["centre"], "moments": link["moments"] * share}


def with_ball(link, mass, at):
    """A link with a point mass fixed to it."""
    whole = link["mass"] + mass
    centre = (link["mass"] * link["centre"] + mass * at) / whole
    moved = lambda m, r: m * (np.dot(r, r) * np.eye(3) - np.outer(r, r))
    moments = link["moments"] + moved(link["mass"], link["centre"] - centre) + moved(mass, at - centre)
    return {"mass": whole, "centre": centre, "moments": moments}


def numbers(values):
    return " ".join(f"{value:.17g}" for value in np.ravel(values))


def six(m):
    return [m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[0, 2], m[1, 2]]


def compiled(joints):
    """The arm as MuJoCo has it."""
    bodies = "".join(
        f'<body pos="{numbers(own["place"])}" euler="{numbers(own["angles"])}"><joint name="{own["name"]}" type="{"slide" if own["slides"] else "hinge"}"'
        f' axis="0 0 1" frictionloss="{own["friction"]:.17g}" damping="{own["damping"]:.17g}" armature="{own["armature"]:.17g}" stiffness="{own["stiffness"]:.17g}"'
        f' solreffriction="0.0005 1" solimpfriction="0.999 0.9999 0.001"/><inertial pos="{numbers(own["link"]["centre"])}" mass="{own["link"]["mass"]:.17g}"'
        f' fullinertia="{numbers(six(own["link"]["moments"]))}"/>' for own in joints)
    motors = "".join(f'<motor joint="{own["name"]}" gear="{own["gear"]:.17g}"/>' for own in joints)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian" eulerseq="XYZ"/><option timestep="{1 / (RATE_HZ * SERVO)}" gravity="0 0 -9.81"'
        f' integrator="RK4" cone="elliptic" iterations="60" tolerance="1e-12"/><worldbody>{bodies}{"</body>" * len(joints)}</worldbody>'
        f"<actuator>{motors}</actuator></mujoco>")


def draw_paths(joints, seconds, rng):
    """Positions, speeds and accelerations at the servo's times: sums of sines about a middle, without an end that is known."""
    time = np.arange(int(seconds * RATE_HZ) * SERVO) / (RATE_HZ * SERVO)
    out = np.zeros((3, len(joints), len(time)))
    for k, own in enumerate(joints):
        reach, base = (rng.uniform(0.04, 0.12) if own["slides"] else rng.uniform(0.4, 1.0)), 2 * math.pi * rng.uniform(0.09, 0.18)
        out[0, k] += 0 if own["slides"] else rng.uniform(-1.2, 1.2)
        for order in range(1, 6):
            size, rate, phase = reach * rng.uniform(0.3, 1) / (0.8 + 0.4 * order), base * order, rng.uniform(0, 2 * math.pi)
            for row, wave in enumerate((np.sin, np.cos, lambda x: -np.sin(x))):
                out[row, k] += size * rate**row * wave(rate * time + phase)
    return out


def inverse(model, data, q, v, a):
    data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
    mujoco.mj_inverse(model, data)
    return data.qfrc_inverse.copy()


def rigid(joints):
    return compiled([dict(own, friction=0.0) for own in joints])


def draw(rng):
    """A laboratory: the arm that the description states, its motion and its sensors."""
    joints, flange = draw_arm(rng)
    seconds = float(rng.integers(10, 15))
    paths = draw_paths(joints, seconds, rng)
    bare = rigid(joints)
    data = mujoco.MjData(bare)
    some = [inverse(bare, data, *paths[:, :, k]) for k in range(0, paths.shape[2], 199)]
    usual = np.sqrt(np.mean(np.square(some), axis=0))
    speed = np.sqrt(np.mean(np.square(paths[1]), axis=1))
    stated, bits = rng.random() < 0.5, int(rng.choice([18, 19, 20, 21]))
    for k, own in enumerate(joints):
        own["quantum"] = (0.05 if own["slides"] else 2 * math.pi) / 2**bits
        own["noise"] = usual[k] * math.exp(rng.uniform(math.log(0.002), math.log(0.02)))
        if stated:
            own["friction"], own["damping"] = usual[k] * rng.uniform(0.05, 0.25), usual[k] / speed[k] * rng.uniform(0.05, 0.25)
    return {"joints": joints, "flange": flange, "seconds": seconds, "paths": paths, "usual": usual, "speed": speed, "stated": stated, "bits": bits}


def mass_at(joints, k):
    """What joint k moves when it moves alone, about its zero."""
    model = rigid(joints)
    data, count = mujoco.MjData(model), len(joints)
    one = np.eye(count)[k]
    rest = np.zeros(count)
    return (inverse(model, data, rest, rest, one) - inverse(model, data, rest, rest, rest))[k]


def hide(rng, lab, kinds):
    """None, one or two causes, each with its joint, its amount and the names that are right."""
    joints, last = lab["joints"], len(lab["joints"]) - 1
    kinds = kinds or ["frictionloss", "damping", "armature", "mass", "payload", "gear", "delay"] + ["absent"] * lab["stated"]
    count = rng.choice([0, 1, 1, 1, 1, 1, 2, 2, 2, 2])
    hidden = []
    for kind in rng.choice(kinds, size=min(count, len(kinds)), replace=False):
        k = last if kind == "payload" else int(rng.integers(last + 1))
        level, sign = lab["usual"][k] * rng.uniform(0.06, 0.4), float(rng.choice([-1, 1]))
        amount = {
            "frictionloss": level, "damping": level / lab["speed"][k], "armature": mass_at(joints, k) * rng.uniform(0.15, 0.6),
            "mass": joints[k]["link"]["mass"] * (rng.uniform(0.1, 0.5) if sign > 0 else -rng.uniform(0.1, 0.3)),
            "payload": joints[k]["link"]["mass"] * rng.uniform(0.15, 0.8), "gear": sign * rng.uniform(0.05, 0.25),
            "delay": int(rng.integers(2, 9)) / RATE_HZ, "absent": -joints[k]["friction"], "stiffness": level / np.std(lab["paths"][0, k]),
        }[str(kind)]
        if {"frictionloss", "absent"} <= {str(kind), *(own["kind"] for own in hidden if own["joint"] == k)}:
            continue
        hidden.append({"kind": str(kind), "joint": k, "amount": amount})
    return hidden


def right(own, last):
    """Names at places that are right about a cause, and those that other parameters of a link make equal to it."""
    k = own["joint"]
    at = lambda name, joints: [[name, f"joint{j + 1}"] for j in joints]
    links = at("link_inertia", range(k + 1))
    return {
        "frictionloss": at("dry_offset", [k]), "absent": at("dry_offset", [k]), "damping": at("viscous", [k]),
        # A rotor is a moment of the link about its own axis where nothing before it moves.
        "armature": at("added_inertia", [k]) + (at("link_inertia", [0]) if k == 0 else []),
        "mass": links + at("added_inertia", [0]) + (at("payload", [k]) if k == last else []),
        "payload": at("payload", [k]) + links + at("added_inertia", [0]),
        "gear": at("gain_error", [k]), "stiffness": at("spring", [k]), "delay": at("channel_skew", [k]),
    }[own["kind"]]


def true_arm(lab, hidden):
    joints = [dict(own) for own in lab["joints"]]
    for cause in hidden:
        own, amount = joints[cause["joint"]], cause["amount"]
        if cause["kind"] in ("frictionloss", "absent"):
            own["friction"] += amount
        elif cause["kind"] in ("damping", "armature", "stiffness"):
            own[cause["kind"]] += amount
        elif cause["kind"] == "mass":
            own["link"] = heavier(own["link"], own["link"]["mass"] + amount)
        elif cause["kind"] == "payload":
            own["link"] = with_ball(own["link"], amount, lab["flange"])
        elif cause["kind"] == "gear":
            own["gear"] = 1 + amount
    return joints


def simulate(lab, hidden, rng):
    """Positions in counts and commanded efforts at the recording's times."""
    model, described = compiled(true_arm(lab, hidden)), rigid(lab["joints"])
    data, plan = mujoco.MjData(model), mujoco.MjData(described)
    quantum = np.array([own["quantum"] for own in lab["joints"]])
    zero, paths = rng.random(len(quantum)), lab["paths"]
    natural = 2 * math.pi * rng.uniform(2, 4)
    data.qpos[:], data.qvel[:] = paths[0, :, 0], paths[1, :, 0]
    seen, rate = paths[0, :, 0], paths[1, :, 0].copy()
    positions, efforts = [], []
    for aim, aim_rate, aim_faster in paths.transpose(2, 0, 1):
        before, seen = seen, np.floor(data.qpos / quantum + zero) * quantum
        rate += ((seen - before) * RATE_HZ * SERVO - rate) / 24
        wanted = aim_faster + natural**2 * (aim - seen) + 1.6 * natural * (aim_rate - rate)
        data.ctrl[:] = inverse(described, plan, aim, aim_rate, wanted)
        positions.append(seen)
        efforts.append(data.ctrl.copy())
        mujoco.mj_step(model, data)
    # A drive logs the mean of its effort over a sample's interval, here about the sample.
    weights = np.ones(SERVO) / SERVO
    efforts = np.array([np.convolve(own, weights, "same") for own in np.array(efforts).T]).T[SERVO::SERVO]
    positions = np.array(positions)[SERVO::SERVO]
    for cause in hidden:
        if cause["kind"] == "delay":
            late, k = round(cause["amount"] * RATE_HZ), cause["joint"]
            efforts[late:, k] = efforts[:-late, k].copy()
    efforts += rng.normal(0, 1, efforts.shape) * [own["noise"] for own in lab["joints"]]
    late = max([round(own["amount"] * RATE_HZ) for own in hidden if own["kind"] == "delay"], default=0)
    return positions[late:], efforts[late:]


def efforts_along(joints, states):
    """The efforts of an arm along a motion, friction by its sign."""
    model = rigid(joints)
    data = mujoco.MjData(model)
    dry = np.array([own["friction"] for own in joints])
    own = np.array([inverse(model, data, *state) + dry * np.sign(state[1]) for state in states])
    return own / [own["gear"] for own in joints]


def size(lab, cause):
    """What a cause alone changes in averages of 80 ms, in the noise of such an average: the joint that shows it best."""
    joints, length = lab["joints"], round(0.08 * RATE_HZ)
    states = lab["paths"][:, :, ::SERVO].transpose(2, 0, 1)
    before = efforts_along(joints, states)
    if cause["kind"] == "delay":
        late, k = round(cause["amount"] * RATE_HZ), cause["joint"]
        after = before.copy()
        after[late:, k] = before[:-late, k]
    else:
        after = efforts_along(true_arm(lab, [cause]), states)
    count = len(before) // length
    averages = (after - before)[:count * length].reshape(count, length, -1).mean(axis=1)
    curved = [mass_at(joints, k) * math.sqrt(720 / length) * own["quantum"] / math.sqrt(12) / 0.08**2 for k, own in enumerate(joints)]
    noise = np.hypot(curved, [own["noise"] / math.sqrt(length) for own in joints])
    return float(np.max(np.sqrt(np.mean(averages**2, axis=0)) / noise))


def urdf(name, lab):
    text = f'<robot name="{name}">\n  <link name="base"/>\n'
    for k, own in enumerate(lab["joints"]):
        xx, yy, zz, xy, xz, yz = (f"{value:.17g}" for value in six(own["link"]["moments"]))
        friction = f'\n    <dynamics damping="{own["damping"]:.17g}" friction="{own["friction"]:.17g}"/>' if lab["stated"] else ""
        text += f"""  <joint name="{own["name"]}" type="{"prismatic" if own["slides"] else "continuous"}">
    <origin xyz="{numbers(own["place"])}" rpy="{numbers(own["angles"])}"/>
    <parent link="{f"link{k}" if k else "base"}"/><child link="link{k + 1}"/><axis xyz="0 0 1"/>{friction}
  </joint>
  <link name="link{k + 1}"><inertial>
    <origin xyz="{numbers(own["link"]["centre"])}"/><mass value="{own["link"]["mass"]:.17g}"/>
    <inertia ixx="{xx}" ixy="{xy}" ixz="{xz}" iyy="{yy}" iyz="{yz}" izz="{zz}"/>
  </inertial></link>
"""
    return text + f"""  <joint name="flange" type="fixed">
    <origin xyz="{numbers(lab["flange"])}"/><parent link="link{len(lab["joints"])}"/><child link="tool"/>
  </joint>
  <link name="tool"/>
</robot>
"""


def description(name, lab):
    text = f'name = "{name}"\nplant = "chain"\nurdf = "{name}.urdf"\n\n[channels]\ntime = {{ channel = "t", unit = "s" }}\n'
    for k, own in enumerate(lab["joints"]):
        motion, travel, effort = ("linear", "m", "N") if own["slides"] else ("rotary", "rad", "N·m")
        text += f"""
[[joint]]
name = "{own["name"]}"
motion = "{motion}"
position = {{ channel = "q{k + 1}", unit = "{travel}", quantum = {own["quantum"]!r} }}
effort = {{ channel = "effort{k + 1}", unit = "{effort}", noise = {float(own["noise"])!r} }}
"""
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    for name, default in (("--seed", 0), ("--count", 30)):
        parser.add_argument(name, type=int, default=default)
    parser.add_argument("--kinds", nargs="*", help="hide these only, for example stiffness: a spring at a joint")
    args = parser.parse_args()
    (args.folder / "key").mkdir(parents=True, exist_ok=True)
    for seed in range(args.seed, args.seed + args.count):
        rng = np.random.default_rng(seed)
        lab = draw(rng)
        hidden = hide(rng, lab, args.kinds)
        positions, efforts = simulate(lab, hidden, rng)
        name, count = f"mja_{seed:03}", len(lab["joints"])
        head = "t," + ",".join(f"q{k + 1}" for k in range(count)) + "," + ",".join(f"effort{k + 1}" for k in range(count))
        rows = "".join(f"{k / RATE_HZ:g},{','.join(f'{x:.9g}' for x in (*q, *e))}\n" for k, (q, e) in enumerate(zip(positions, efforts)))
        (args.folder / f"{name}.csv").write_text(f"{head}\n{rows}")
        (args.folder / f"{name}.urdf").write_text(urdf(name, lab))
        (args.folder / f"{name}.toml").write_text(description(name, lab))
        last = count - 1
        key = {"seed": seed, "joints": count, "stated": lab["stated"], "effects": [dict(own, right=right(own, last), size=size(lab, own)) for own in hidden]}
        (args.folder / "key" / f"{name}.json").write_text(json.dumps(key, indent=1, default=float) + "\n")


if __name__ == "__main__":
    main()
