"""This file holds what a calibration promises to an engine that is not ours."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
import rigproof

mujoco = pytest.importorskip("mujoco")
import rigproof.mujoco as own  # noqa: E402

DATA = Path(os.environ.get("RIGPROOF_DATA", "absent"))


def test_mujoco_fits_better_with_what_was_found(case, rig) -> None:
    xml = """<mujoco><option gravity="0 0 0" timestep="0.0005"/><worldbody><body><joint name="slide" type="slide" axis="1 0 0"/>
    <geom type="sphere" size="0.1" mass="0.5"/></body></worldbody><actuator><motor joint="slide"/></actuator></mujoco>"""
    report = rigproof.diagnose(case, rig)
    model = mujoco.MjModel.from_xml_string(xml)
    own.apply(rig, model)
    held = slice(4500, None)
    part = [case[key][held] for key in ("t", "x", "f")]
    before = own.replay(model, *part)["rms"]
    done = own.apply(report, model)
    after = own.replay(model, *part)["rms"]
    assert not done["not_held"] and abs(model.dof_damping[0] - 3.3) < 0.03 and abs(model.dof_armature[0] - 1.6) < 0.02
    assert after < 0.05 * before, (before, after)


ARM = """<mujoco><worldbody><body pos="0 0 0.3"><joint name="j1" axis="0 0.6 0.8"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="2.1"/>
<body pos="0.3 0 0"><joint name="j2" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.1 0 0.25" size="0.02" mass="1.3"/></body></body></worldbody>
<actuator><motor name="m1" joint="j1"/><motor name="m2" joint="j2" gear="2"/></actuator></mujoco>"""


def swung(model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, positions and the efforts that they take in a model, by its inverse dynamics."""
    t = np.arange(6000) * 2e-3
    parts = np.array([[(0.7, 2.1, 0.3), (0.4, 5.3, 1.1)], [(0.9, 3.1, 0.7), (0.3, 6.7, 2.0)]])
    waves = [[(a * np.sin(w * t + p), a * w * np.cos(w * t + p), -a * w * w * np.sin(w * t + p)) for a, w, p in joint] for joint in parts]
    q, v, a = (np.array([sum(wave[k] for wave in joint) for joint in waves]).T for k in range(3))
    data, efforts = mujoco.MjData(model), np.empty_like(q)
    for k in range(len(t)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[k], v[k], a[k]
        mujoco.mj_inverse(model, data)
        efforts[k] = data.qfrc_inverse
    return t, q, efforts


def test_an_arms_friction_and_constants_come_back_into_its_model(tmp_path: Path) -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    rig = rigproof.Rig.from_mjcf(model, ["q1", "q2"], effort=["f1", "f2"], urdf=tmp_path / "arm.urdf", effort_keys={"noise": 0.01}, position_keys={"quantum": 1e-6})
    model.dof_damping[0], model.dof_frictionloss[1] = 0.8, 0.5
    t, q, f = swung(model)
    f[:, 1] += 0.3
    f += 0.01 * np.random.default_rng(2).standard_normal(f.shape)
    report = rigproof.diagnose({"t": t, "q1": q[:, 0], "q2": q[:, 1], "f1": f[:, 0], "f2": f[:, 1]}, rig)
    found = {(row["mechanism"], row["where"]): row["value"] for row in report.names}
    assert set(found) == {("viscous", "j1"), ("dry_offset", "j2"), ("constant_bias", "j2")}, report.names
    assert [row["joint"] for row in report.joints] == ["j1", "j2"] and all(row["after"] < 0.1 * row["before"] for row in report.joints), report.joints
    fresh = mujoco.MjModel.from_xml_string(ARM)
    held = slice(4500, None)
    before = own.effort(fresh, t[held], q[held], f[held])
    done = own.apply(report, fresh)
    after = own.effort(fresh, t[held], q[held], f[held])
    assert not done["not_held"] and abs(fresh.dof_damping[0] - 0.8) < 0.02 and abs(fresh.dof_frictionloss[1] - 0.5) < 0.02
    # The second motor's gear is 2: half of the constant stands in the actuator.
    assert abs(fresh.actuator_biasprm[1, 0] + 0.15) < 0.01 and after["all"] < 0.1 * before["all"], (before["rms"], after["rms"])
    ends = [own.replay(model, t[k : k + 300], q[k : k + 300], f[k : k + 300] / [1.0, 2.0], ["j1", "j2"], ["m1", "m2"], 0.2)["rms"] for k in (4500,)]
    assert ends[0].shape == (2,) and np.isfinite(ends[0]).all()


def test_bodies_that_none_can_be_are_replaced_by_the_nearest(tmp_path: Path) -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    keys = ("mass", "x", "y", "z", "xx", "xy", "xz", "yy", "yz", "zz")
    effect = {"mechanism": "link_inertia", "joint": "j2", **{key: {"value": 0.0, "unit": ""} for key in keys}}
    effect["zz"] = {"value": -0.05, "unit": "kg·m^2"}
    done = own.apply(rigproof.Rig.from_dict({"plant": "chain", "effect": [effect]}), model)
    assert any("nearest real ones" in line for line in done["set"])
    for body in (1, 2):
        moments = np.sort(model.body_inertia[body])
        assert moments[0] > 0.0 and moments[2] <= moments[0] + moments[1] + 1e-9
    effect["zz"] = {"value": 0.004, "unit": "kg·m^2"}
    model = mujoco.MjModel.from_xml_string(ARM)
    old = own._inertia.numbers(model, 2)
    done = own.apply(rigproof.Rig.from_dict({"plant": "chain", "effect": [effect]}), model)
    changed = own._inertia.numbers(model, 2) - old
    assert not any("nearest" in line for line in done["set"]) and np.allclose(changed, [0.0] * 9 + [0.004], atol=1e-9)


def test_friction_that_builds_up_is_held_by_its_level_and_a_spring_joins_that_of_the_joint() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    model.jnt_stiffness[1], model.qpos_spring[1] = 2.0, 0.3
    effects = [
        {"mechanism": "presliding", "joint": "j1", "level": {"value": 0.41, "unit": "N·m"}, "travel": {"value": 0.0019, "unit": "rad"}},
        {
            "mechanism": "lugre_bristle",
            "joint": "j2",
            "level": {"value": 0.23, "unit": "N·m"},
            "viscous": {"value": 0.07, "unit": "N·m·s/rad"},
            "travel": {"value": 0.0031, "unit": "rad"},
        },
        {"mechanism": "spring", "joint": "j2", "stiffness": {"value": 6.0, "unit": "N·m/rad"}, "rest": {"value": -0.1, "unit": "rad"}},
        {"mechanism": "spring", "joint": "j1", "stiffness": {"value": -6.0, "unit": "N·m/rad"}},
    ]
    done = own.apply(rigproof.Rig.from_dict({"plant": "chain", "effect": effects}), model)
    assert np.allclose(model.dof_frictionloss, [0.41, 0.23]) and np.allclose(model.dof_damping, [0.0, 0.07])
    # The two springs at j2 are one of 8 N·m/rad at rest where their torques cancel.
    assert np.allclose(model.jnt_stiffness, [0.0, 8.0]) and np.isclose(model.qpos_spring[1], (2.0 * 0.3 - 6.0 * 0.1) / 8.0)
    assert [line.split(":")[0] for line in done["not_held"]] == ["j1", "j2", "j1"] and "0.0019 rad" in done["not_held"][0]


def test_a_public_arms_error_falls_in_mujoco_as_the_report_promises() -> None:
    folder = DATA / "panda"
    if not folder.exists():
        print("passed over: the recording of the Panda is absent")
        return
    names = [f"{kind}{k}" for kind in ("q", "tau") for k in range(1, 8)]
    table = np.genfromtxt(folder / "exciting_trajectory_1.csv", delimiter=",", skip_header=1)
    rig = rigproof.Rig.from_urdf(folder / "panda.urdf", names[:7], names[7:], tip="panda_link8")
    report = rigproof.diagnose({"t": table[:, 0], **dict(zip(names, table[:, 1:].T))}, rig, hold_out=0.5)
    held = next(row for row in report.before_after if row["part"] == "held_out")
    part = slice(len(table) // 2, None)
    given = (table[part, 0], table[part, 1:8], table[part, 8:])
    model = own.load(folder / "panda.urdf", tip="panda_link8")
    before = own.effort(model, *given)
    own.apply(report, model)
    after = own.effort(model, *given)
    promised, kept = held["before"] / held["after"], before["all"] / after["all"]
    print(f"Panda: promised {promised:.2f}, MuJoCo {kept:.2f}: {before['rms'].round(3)} -> {after['rms'].round(3)} N·m")
    assert promised > 2.0 and abs(kept / promised - 1.0) < 0.2


PENDULUM = """<mujoco><option timestep="0.001"/><worldbody><body><joint name="shaft" axis="0 1 0"/><geom type="sphere" size="0.01" pos="0 0 -0.1" mass="0.49"/></body>
</worldbody><actuator><general name="servo" joint="shaft"/></actuator></mujoco>"""


def test_a_public_servos_error_falls_in_mujoco_as_the_report_promises() -> None:
    """The servo has friction under load, for which MuJoCo has no number: held by a law at each step the promise is kept, and without it not."""
    records = [json.loads(file.read_text()) | {"file": file} for file in sorted((DATA / "bam_xl330").glob("*.json"))]
    if not records:
        print("passed over: the recordings of BAM are absent")
        return
    runs = {own["kp"]: rigproof.even(rigproof.read(own["file"], ["position", "goal_position"]), 0.005) for own in records if own["trajectory"] == "sin_sin"}

    def gain(kp: int) -> float:
        return kp * 0.0028774 * 7.4

    ripple = {"sine": {"value": 0.49 * 9.81 * 0.1, "unit": "N·m"}, "cosine": {"value": 0.0, "unit": "N·m"}, "period": {"value": 2.0 * np.pi, "unit": "rad"}}
    friction = [("dry_offset", "level", 0.02, "N·m"), ("viscous", "coefficient", 0.0046, "N·m·s/rad")]
    rig = rigproof.Rig.axis(
        position="position",
        command="goal_position",
        command_unit="rad",
        inertia=(0.0068, "kg·m^2/rad"),
        command_gain=(0.386 / 3.4, "N·m/V"),
        servo={"gain": gain(200), "supply_v": 7.4, "back_emf": 0.386},
        position_keys={"quantum": 2.0 * np.pi / 4096},
        effects=[{"mechanism": "ripple", **ripple}, *({"mechanism": law, key: {"value": x, "unit": unit, "status": "unknown"}} for law, key, x, unit in friction)],
    )
    pairs = {kp: (run, {"gain": gain(kp)}) for kp, run in runs.items()}
    report = rigproof.diagnose([pairs[100], pairs[400], pairs[800]], rig, hold_out=pairs[200])
    assert [row["mechanism"] for row in report.names] == ["load_friction"]
    held = next(row for row in report.before_after if row["part"] == "held_out")

    def error(kp: int, calibration, constant: float | None = None, law=None) -> float:
        model = mujoco.MjModel.from_xml_string(PENDULUM)
        own.apply(calibration, model)
        scale = gain(kp) / gain(200)
        model.actuator_gainprm[0, 0] *= scale
        model.actuator_biasprm[0, 1] *= scale
        if constant is not None:
            model.dof_frictionloss[0] = constant
        return own.replay(model, *(runs[kp][key] for key in ("t", "position", "goal_position")), restart_s=1e9, before_step=law)["rms"]

    # What MuJoCo alone can do: the constant friction that fits the fitted runs best.
    constants = np.arange(0.0, 0.31, 0.03)
    best = min(constants, key=lambda own: sum(error(kp, rig, own) ** 2 for kp in (100, 400, 800)))
    before, without = error(200, rig, best), error(200, report)
    after = error(200, report, law=own.load_friction(report))
    promised, kept = held["before"] / held["after"], before / after
    print(f"BAM: promised {promised:.2f}, MuJoCo {kept:.2f}: {before:.4f} (constant friction {best:.2f} N·m) -> {after:.4f} rad; without the law {without:.4f} rad")
    assert promised > 1.8 and abs(kept / promised - 1.0) < 0.2 and without > before
