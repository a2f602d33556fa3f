"""This file holds rigs that are read from URDF and MJCF to what MuJoCo makes of the same files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import rigproof
import rigproof.mujoco

mujoco = pytest.importorskip("mujoco")

# Nothing here is simple: axes askew, an anchor off the body's origin, a slide, a body that is welded on, an armature.
ARM = """<mujoco><worldbody><body pos="0.1 0 0.5" euler="10 20 30"><joint name="j1" axis="0 0.6 0.8" pos="0.02 0.01 0" damping="0.3" armature="0.011"/>
<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="2.1"/><body pos="0.3 0 0" euler="0 90 0"><joint name="j2" axis="0 1 0" frictionloss="0.2"/>
<geom type="capsule" fromto="0 0 0 0 0 0.25" size="0.02" mass="1.3"/><body pos="0 0 0.25"><joint name="j3" type="slide" axis="0 0 1"/>
<geom type="box" size="0.02 0.03 0.04" pos="0.01 0.02 0.03" mass="0.7"/><body pos="0.05 0 0" euler="5 6 7"><geom type="sphere" size="0.03" mass="0.2" pos="0.1 0.02 0"/>
</body></body></body></body></worldbody></mujoco>"""

MOTOR = """<mujoco><worldbody><body><joint name="shaft" axis="0 1 0" damping="0.013" armature="0.0021" frictionloss="0.031"/>
<geom type="sphere" size="0.02" pos="0 0 -0.1" mass="0.49"/></body></worldbody>
<actuator><motor name="motor" joint="shaft" gear="2.5"/></actuator></mujoco>"""
SERVO = '<position name="servo" joint="shaft" kp="3" kv="0.2" forcerange="-2 2"/>'


def efforts(model, states) -> np.ndarray:
    """Without friction and armature, which a URDF states beside its bodies."""
    data, force, found = mujoco.MjData(model), np.zeros(model.nv), []
    for q, v, a in states:
        data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
        for step in (mujoco.mj_kinematics, mujoco.mj_comPos, mujoco.mj_comVel):
            step(model, data)
        mujoco.mj_rne(model, data, 1, force)
        found.append(force.copy())
    return np.array(found)


@pytest.mark.parametrize("gravity", ["0 0 -9.81", "0 9.81 0", "5.886 0 -7.848"])
def test_an_arm_of_mjcf_has_the_same_dynamics_as_its_urdf(tmp_path: Path, gravity: str) -> None:
    model = mujoco.MjModel.from_xml_string(ARM.replace("<worldbody>", f'<option gravity="{gravity}"/><worldbody>', 1))
    rig = rigproof.Rig.from_mjcf(model, ["q1", "q2", "q3"], effort=["f1", "f2", "f3"], urdf=tmp_path / "arm.urdf")
    written = rigproof.mujoco.load(tmp_path / "arm.urdf")
    states = np.random.default_rng(3).standard_normal((20, 3, 3))
    assert np.abs(efforts(model, states) - efforts(written, states)).max() < 1e-12
    assert list(written.dof_damping) == [0.3, 0.0, 0.0] and list(written.dof_frictionloss) == [0.0, 0.2, 0.0]
    assert '"mechanism" = "added_inertia", "joint" = "j1"' in rig.text and "0.011" in rig.text and any("armature 0.011" in line for line in rig.inferred)


def test_one_joint_of_mjcf_says_what_was_inferred() -> None:
    model = mujoco.MjModel.from_xml_string(MOTOR)
    rig = rigproof.Rig.from_mjcf(model, "q", command="u")
    keys = rigproof.mujoco._apply.tomllib.loads(rig.text)
    ball = 0.49 * (0.1**2 + 0.4 * 0.02**2)
    assert abs(keys["parameters"]["inertia"]["value"] - ball - 0.0021) < 1e-12 and keys["parameters"]["command_gain"] == {"value": 2.5, "unit": "N·m/N·m"}
    ripple = next(effect for effect in keys["effect"] if effect["mechanism"] == "ripple")
    assert abs(ripple["sine"]["value"] - 0.49 * 9.81 * 0.1) < 1e-12 and abs(ripple["cosine"]["value"]) < 1e-12
    assert [effect["mechanism"] for effect in keys["effect"]] == ["viscous", "dry_offset", "ripple"] and len(rig.inferred) == 5
    head, _ = MOTOR.split("<actuator>")
    model = mujoco.MjModel.from_xml_string(f"{head}<actuator>{SERVO}</actuator></mujoco>")
    servo = rigproof.mujoco._apply.tomllib.loads(rigproof.Rig.from_mjcf(model, "q", command="goal", actuator="servo").text)
    assert servo["servo"] == {"gain": 3.0, "supply_v": 2.0, "back_emf": 0.2} and servo["channels"]["command"]["unit"] == "rad"
    both = mujoco.MjModel.from_xml_string(MOTOR.replace("</actuator>", f"{SERVO}</actuator>"))
    with pytest.raises(rigproof.Error, match="`servo` pulls at the same joint"):
        rigproof.Rig.from_mjcf(both, "q", command="u")


def test_a_model_and_its_own_description_go_the_same_way() -> None:
    """A recording that MuJoCo makes is explained by the description that is read out of the same model."""
    plain = MOTOR.replace('damping="0.013" ', "").replace(' frictionloss="0.031"', "")
    model = mujoco.MjModel.from_xml_string(plain.replace("<worldbody>", '<option timestep="0.00025"/><worldbody>', 1))
    rig = rigproof.Rig.from_mjcf(model, "q", command="u", drive="held", position_keys={"quantum": 1e-6}, command_keys={"noise": 1e-6})
    model.dof_damping[0] += 0.027
    data, t, q, u = mujoco.MjData(model), np.arange(4000) * 1e-3, [], []
    for now in t:
        data.ctrl[0] = 0.11 * np.sin(3.1 * now) + 0.07 * np.sin(11.3 * now)
        q.append(data.qpos[0])
        u.append(data.ctrl[0])
        mujoco.mj_step(model, data, 4)
    report = rigproof.diagnose({"t": t, "q": np.array(q), "u": np.array(u)}, rig)
    assert [row["mechanism"] for row in report.names] == ["viscous"] and abs(report.names[0]["value"] - 0.027) < 0.002, report.names


def test_what_is_no_arm_is_said(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    joint = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/></joint>'
    links = "".join(f'<link name="{name}"/>' for name in ("base", "one", "two", "hand"))
    rest = joint.format("b", "prismatic", "one", "two") + joint.format("c", "fixed", "one", "hand")
    file.write_text(f"<robot>{links}{joint.format('a', 'revolute', 'base', 'one')}{rest}</robot>")
    rig = rigproof.Rig.from_urdf(file, ["q1", "q2"], ["f1", "f2"], tip="two", units={"q1": "deg"})
    assert '"unit" = "deg"' in rig.text and '"motion" = "linear"' in rig.text and '"unit" = "N"' in rig.text
    for words, message in [
        ({}, "ends two, hand"),
        ({"tip": "three"}, "no link"),
        ({"tip": "hand"}, "give 1, one for each of a"),
        ({"tip": "two", "joints": ["a", "d"]}, "`d`"),
    ]:
        with pytest.raises(rigproof.Error, match=message):
            rigproof.Rig.from_urdf(file, ["q1", "q2"], ["f1", "f2"], **words)
    file.write_text("<robot>\n<link")
    with pytest.raises(rigproof.Error) as refused:
        rigproof.Rig.from_urdf(file, ["q1"], ["f1"])
    assert refused.value.line == 2
    model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><freejoint name="free"/><geom size="1"/></body></worldbody></mujoco>')
    with pytest.raises(rigproof.Error, match="`free` neither turns"):
        rigproof.Rig.from_mjcf(model, "q", command="u")
