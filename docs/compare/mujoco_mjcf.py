"""Inverse dynamics of arms in MJCF, by rigproof and by MuJoCo, from the same files.

Arms of two to seven joints are drawn, and each is written in the ways that MJCF has: bodies and inertials placed by quat, axisangle, euler, xyaxes or
zaxis, angles in degrees or radians, any order of Euler angles, diagonal or full inertias, joints off the body's origin and with a reference position,
one to three joints a body, frames, fixed bodies, default classes, any gravity. Every third file is compiled, saved and read again as MuJoCo writes it.
The efforts of both at drawn states are compared, as a share of the greatest effort of the state.

    python mujoco_mjcf.py target/release/examples/inverse --seed 0 --count 300
"""
import argparse
import pathlib
import subprocess
import tempfile

import mujoco
import numpy as np

STATES = 20


def text(values):
    return " ".join(repr(float(value)) for value in np.ravel(values))


def orientation(rng, angle):
    """An orientation in one of the ways to write it; `angle` is one radian as the file writes it."""
    a, b = rng.normal(size=(2, 3))
    return str(rng.choice([
        "",
        f'quat="{text(rng.normal(size=4))}"',
        f'axisangle="{text([*a, rng.uniform(-3, 3) * angle])}"',
        f'euler="{text(rng.uniform(-3, 3, 3) * angle)}"',
        f'xyaxes="{text([*a, *b])}"',
        f'zaxis="{text(a if rng.random() < 0.9 else [0, 0, -1])}"',
    ]))


def inertial(rng, angle):
    """A turned box with uneven density: moments that a body can have."""
    mass, sides = rng.uniform(0.3, 4), rng.uniform(0.05, 0.4, 3)
    moments = mass / 12 * (np.sum(sides**2) - sides**2)
    head = f'<inertial pos="{text(rng.normal(scale=0.1, size=3))}" mass="{mass!r}"'
    if rng.random() < 0.5:
        return f'{head} diaginertia="{text(moments)}" {orientation(rng, angle)}/>'
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    m = turn @ np.diag(moments) @ turn.T
    return f'{head} fullinertia="{text([m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[0, 2], m[1, 2]])}"/>'


def joint(rng, name, angle):
    slides = rng.random() < 0.2
    words = [f'<joint name="{name}"'] + [f'class="{rng.choice(["main", "stiff", "light"])}"'] * int(rng.integers(2))
    words += [f'type="{"slide" if slides else "hinge"}"', f'axis="{text(rng.normal(size=3))}"']
    if rng.random() < 0.6:
        words.append(f'pos="{text(rng.normal(scale=0.1, size=3))}"')
    if rng.random() < 0.5:
        words.append(f'ref="{rng.uniform(-1, 1) * (1 if slides else angle)!r}"')
    words += [f'{what}="{rng.uniform(0, 0.5)!r}"' for what in ("damping", "frictionloss", "armature") if rng.random() < 0.3]
    return " ".join(words) + "/>"


def body(rng, left, angle, count):
    """A body with one to three joints, what is fixed to it, and the bodies beyond."""
    here = min(left, int(rng.choice([1, 1, 1, 2, 3])))
    joints = "".join(joint(rng, f"j{count - left + k}", angle) for k in range(here))
    own = inertial(rng, angle)
    if rng.random() < 0.3:
        own = f'<frame pos="{text(rng.normal(scale=0.1, size=3))}" {orientation(rng, angle)}>{joints}</frame>{own}'
    else:
        own = joints + own
    place = lambda: f'pos="{text(rng.normal(scale=0.3, size=3))}" {orientation(rng, angle)}'
    if rng.random() < 0.4:
        own += f'<body name="on{left}" {place()}>{inertial(rng, angle)}<geom size="0.01" mass="0"/></body>'
    if left > here:
        beyond = body(rng, left - here, angle, count)
        if rng.random() < 0.3:
            beyond = f'<body {place()} childclass="{rng.choice(["stiff", "light"])}">{inertial(rng, angle)}{beyond}</body>'
        if rng.random() < 0.3:
            beyond = f"<frame {place()}>{beyond}</frame>"
        own += beyond
    else:
        own += f'<site name="tip" pos="{text(rng.normal(size=3))}"/>'
    return f'<body name="b{left}" {place()}>{own}</body>'


def arm(rng):
    degrees, count = rng.random() < 0.5, int(rng.integers(2, 8))
    angle = 180 / np.pi if degrees else 1.0
    sequence = "".join(rng.choice(list("xyzXYZ"), size=3))
    compiler = f'<compiler angle="{"degree" if degrees else "radian"}" eulerseq="{sequence}"/>' if not degrees or rng.random() < 0.8 else ""
    return count, f"""<mujoco>{compiler}<option gravity="{text(rng.normal(scale=6, size=3))}"/>
<default><joint damping="{rng.uniform()!r}"/><default class="stiff"><joint armature="{rng.uniform()!r}" pos="{text(rng.normal(scale=0.1, size=3))}"/>
<default class="light"><joint frictionloss="0.2" ref="{rng.uniform()!r}"/></default></default></default>
<worldbody><geom type="plane" size="1 1 1"/>{body(rng, count, angle, count)}</worldbody></mujoco>"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    for name, default in (("--seed", 0), ("--count", 300)):
        parser.add_argument(name, type=int, default=default)
    args = parser.parse_args()
    worst, states, joints = 0.0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "arm.xml"
        for seed in range(args.seed, args.seed + args.count):
            rng = np.random.default_rng(seed)
            count, xml = arm(rng)
            if seed % 3 == 0:
                spec = mujoco.MjSpec.from_string(xml)
                spec.compile()
                xml = spec.to_xml()
            file.write_text(xml)
            model = mujoco.MjModel.from_xml_string(xml)
            # Coulomb friction is a constraint there, and left out on both sides.
            model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
            data = mujoco.MjData(model)
            drawn = rng.normal(scale=2, size=(STATES, 3, count))
            lines = "\n".join(text(state) for state in drawn)
            said = subprocess.run([args.program, file, "tip"], input=lines, capture_output=True, text=True, check=False)
            assert said.returncode == 0, f"{seed}: {said.stderr}\n{xml}"
            ours = np.array([[float(own) for own in line.split()] for line in said.stdout.splitlines()])
            for own, (q, v, a) in zip(ours, drawn):
                data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
                mujoco.mj_inverse(model, data)
                off = np.max(np.abs(own - data.qfrc_inverse)) / np.max(np.abs(data.qfrc_inverse))
                assert off < 1e-9, f"{seed}: {off}\n{xml}"
                worst = max(worst, off)
            states, joints = states + STATES, joints + count
    print(f"MuJoCo {mujoco.__version__}: {args.count} arms, {joints} joints, {states} states: greatest difference {worst:.1e} of the greatest effort")


if __name__ == "__main__":
    main()
