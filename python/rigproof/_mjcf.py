"""This file writes down what MuJoCo's compiler made of a model, as a description of one joint or as the URDF of an arm."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

import numpy as np

from ._errors import Error

Keys = dict[str, Any]
HINGE, SLIDE = 3, 2


def compiled(model: Any) -> Any:
    """An MjModel, from one or from a path."""
    import mujoco

    if not isinstance(model, (str, os.PathLike)):
        return model
    try:
        return mujoco.MjModel.from_xml_path(os.fspath(model))
    except ValueError as error:
        raise Error(f"{os.fspath(model)}: MuJoCo cannot compile it; {error}") from error


def chosen(model: Any, joints: Sequence[str] | None) -> list[int]:
    """The joints that are described, all of the model where none is named."""
    names = [model.joint(k).name for k in range(model.njnt)]
    for own in joints or []:
        if own not in names:
            raise Error(f"model: it has no joint `{own}`; there are {', '.join(names)}")
    found = [names.index(own) for own in joints] if joints else list(range(model.njnt))
    for k in found:
        if model.jnt_type[k] not in (HINGE, SLIDE):
            raise Error(f"model: joint `{names[k]}` neither turns about one axis nor slides along one; name those that do, joints=[...]")
    return found


def axis(model: Any, joint: int, actuator: str | int) -> tuple[Keys, list[str]]:
    """The keys of an axis that the model says: motion, inertia, gain, known effects and, of a position actuator, the servo; and a line on each."""
    import mujoco

    dof, place = int(model.jnt_dofadr[joint]), int(model.jnt_qposadr[joint])
    turns = model.jnt_type[joint] == HINGE
    travel, effort = ("rad", "N·m") if turns else ("m", "N")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    column, unit = np.zeros(model.nv), np.eye(model.nv)[dof]
    mujoco.mj_mulM(model, data, column, unit)
    inertia = {"value": float(column[dof]), "unit": "kg·m^2/rad" if turns else "kg"}
    said = [f"inertia {inertia['value']:.4g} {inertia['unit']}, of which armature {model.dof_armature[dof]:.4g}, in the position that the model begins in"]
    effects: list[Keys] = []

    def effect(mechanism: str, parameter: str, value: float, unit: str) -> None:
        if value != 0.0:
            effects.append({"mechanism": mechanism, parameter: {"value": float(value), "unit": unit}})
            said.append(f"{mechanism} {value:.4g} {unit}")

    effect("viscous", "coefficient", model.dof_damping[dof], f"{effort}·s/{travel}")
    effect("dry_offset", "level", model.dof_frictionloss[dof], effort)
    if model.jnt_stiffness[joint] != 0.0 or np.any(model.dof_dampingpoly[dof]):
        raise Error("model: the joint has a stiffness or damping with higher powers; take it out, and add it as effects of the description")
    gravity = []
    for own in (0.5 * np.pi, 0.0):
        data.qpos[:], data.qvel[:] = model.qpos0, 0.0
        data.qpos[place] = own
        mujoco.mj_forward(model, data)
        gravity.append(float(data.qfrc_bias[dof]))
    largest = max(map(abs, gravity))
    gravity = [0.0 if abs(own) < 1e-12 * largest else own for own in gravity]
    if turns and largest > 1e-9:
        ripple = {"sine": {"value": gravity[0], "unit": effort}, "cosine": {"value": gravity[1], "unit": effort}, "period": {"value": 2.0 * np.pi, "unit": "rad"}}
        effects.append({"mechanism": "ripple", **ripple})
        said.append(f"gravity {gravity[0]:.4g}·sin q {gravity[1]:+.4g}·cos q {effort}")
    elif not turns:
        effect("constant_bias", "level", gravity[0], effort)
    drive = _drive(model, joint, model.actuator(actuator), effort, travel, said)
    return {"motion": "rotary" if turns else "linear", "parameters": {"inertia": inertia, **drive.pop("parameters")}, "effect": effects, **drive}, said


def _drive(model: Any, joint: int, own: Any, effort: str, travel: str, said: list[str]) -> Keys:
    """The gain of a motor, or the servo of a position actuator."""
    import mujoco

    if int(model.actuator_trnid[own.id, 0]) != joint or model.actuator_trntype[own.id] != mujoco.mjtTrn.mjTRN_JOINT:
        raise Error(f"model: actuator `{own.name}` does not drive joint `{model.joint(joint).name}`; name the one that does, actuator=...")
    for k in range(model.nu):
        if k != own.id and model.actuator_trntype[k] == mujoco.mjtTrn.mjTRN_JOINT and model.actuator_trnid[k, 0] == joint and np.any(model.actuator_biasprm[k]):
            raise Error(f"model: actuator `{model.actuator(k).name}` pulls at the same joint without a command; take it out of the model")
    if own.dyntype[0] != mujoco.mjtDyn.mjDYN_NONE or own.gaintype[0] != mujoco.mjtGain.mjGAIN_FIXED:
        raise Error(f"model: actuator `{own.name}` has dynamics or a gain that changes; describe the joint yourself, Rig.axis(...)")
    gain, gear = float(own.gainprm[0]), float(own.gear[0])
    bias = np.asarray(own.biasprm[:3], dtype=float) if own.biastype[0] != mujoco.mjtBias.mjBIAS_NONE else np.zeros(3)
    if not bias.any():
        said.append(f"gain {gain * gear:.4g} {effort} for one of the command, gear included")
        return {"parameters": {"command_gain": {"value": gain * gear, "unit": effort}}}
    if bias[0] != 0.0 or not np.isclose(bias[1], -gain) or gear != 1.0 or not own.forcelimited[0]:
        raise Error(f"model: actuator `{own.name}` is no motor and no position servo with gear 1 and a force range; describe the joint yourself, Rig.axis(...)")
    limit = float(own.forcerange[1])
    said.append(f"position servo, {gain:.4g} {effort}/{travel} up to {limit:.4g} {effort}, damping {-bias[2]:.4g}; its `volt` is {effort}")
    return {
        "parameters": {"command_gain": {"value": 1.0, "unit": f"{effort}/V"}},
        "servo": {"gain": gain, "supply_v": limit, "back_emf": float(-bias[2])},
    }


def urdf(model: Any, joints: list[int], name: str) -> tuple[str, list[Keys], list[str]]:
    """An arm as URDF: its text, known effects beyond it (armatures), and a line on each joint. What moves beside the joints is fixed as it begins."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    bodies = [int(model.jnt_bodyid[k]) for k in joints]
    for k, (upper, lower) in enumerate(zip(bodies, bodies[1:])):
        if upper not in _ancestors(model, lower) or upper == lower:
            raise Error(f"model: joint `{model.joint(joints[k + 1]).name}` does not hang on `{model.joint(joints[k]).name}`; give the joints of a serial arm from its base on")
    gravity = np.asarray(model.opt.gravity)
    if abs(np.linalg.norm(gravity) - 9.81) > 0.05:
        raise Error(f"model: its gravity is {gravity.tolist()} m/s²; an arm has 9.81")
    # The base is turned so that gravity is along -z, as a URDF has it.
    place, turn = np.zeros(3), _upright(gravity)
    robot = ElementTree.Element("robot", name=name)
    ElementTree.SubElement(robot, "link", name="base")
    parent, effects, said = "base", [], []
    for k, body in zip(joints, bodies):
        own, slides = model.joint(k), model.jnt_type[k] == SLIDE
        axes, anchor = data.xmat[body].reshape(3, 3), data.xanchor[k]
        link = ElementTree.SubElement(robot, "link", name=f"{own.name}_link")
        mass, centre, tensor = _composite(model, data, body, bodies)
        inertial = ElementTree.SubElement(link, "inertial")
        ElementTree.SubElement(inertial, "origin", xyz=_text(axes.T @ (centre - anchor)), rpy="0 0 0")
        ElementTree.SubElement(inertial, "mass", value=repr(mass))
        seen = axes.T @ tensor @ axes
        ElementTree.SubElement(inertial, "inertia", {key: repr(float(seen[i, j])) for key, i, j in _MOMENTS})
        joint = ElementTree.SubElement(robot, "joint", name=own.name, type="prismatic" if slides else "continuous")
        ElementTree.SubElement(joint, "parent", link=parent)
        ElementTree.SubElement(joint, "child", link=link.get("name", ""))
        ElementTree.SubElement(joint, "origin", xyz=_text(turn.T @ (anchor - place)), rpy=_text(_angles(turn.T @ axes)))
        ElementTree.SubElement(joint, "axis", xyz=_text(axes.T @ data.xaxis[k]))
        dof = int(model.jnt_dofadr[k])
        ElementTree.SubElement(joint, "dynamics", damping=repr(float(model.dof_damping[dof])), friction=repr(float(model.dof_frictionloss[dof])))
        if model.dof_armature[dof] > 0.0:
            unit = "kg" if slides else "kg·m^2/rad"
            effects.append({"mechanism": "added_inertia", "joint": own.name, "inertia": {"value": float(model.dof_armature[dof]), "unit": unit}})
        said.append(f"{own.name}: mass {mass:.4g} kg, damping {model.dof_damping[dof]:.4g}, frictionloss {model.dof_frictionloss[dof]:.4g}, armature {model.dof_armature[dof]:.4g}")
        parent, place, turn = link.get("name", ""), anchor, axes
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n", effects, said


_MOMENTS = (("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2))


def _ancestors(model: Any, body: int) -> list[int]:
    """A body and those above it."""
    found = [body]
    while found[-1] != 0:
        found.append(int(model.body_parentid[found[-1]]))
    return found


def _composite(model: Any, data: Any, body: int, moving: list[int]) -> tuple[float, Any, Any]:
    """Mass, centre and tensor about it, in the world's axes, of a body and all that hangs on it up to the next one that moves."""
    own = [k for k in range(1, model.nbody) if next((up for up in _ancestors(model, k) if up in moving), None) == body]
    mass = float(sum(model.body_mass[k] for k in own))
    centre = sum(model.body_mass[k] * data.xipos[k] for k in own) / mass if mass > 0.0 else data.xpos[body]
    tensor = np.zeros((3, 3))
    for k in own:
        axes, arm = data.ximat[k].reshape(3, 3), data.xipos[k] - centre
        tensor += axes @ np.diag(model.body_inertia[k]) @ axes.T + model.body_mass[k] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return mass, centre, tensor


def _upright(gravity: Any) -> Any:
    """Axes whose z is against gravity."""
    up = -gravity / np.linalg.norm(gravity)
    x = np.cross([0.0, 1.0, 0.0], up) if abs(up[1]) < 0.9 else np.cross([1.0, 0.0, 0.0], up)
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(up, x), up])


def _angles(turn: Any) -> Any:
    """Roll, pitch, yaw of a rotation: Rz(yaw) Ry(pitch) Rx(roll)."""
    pitch = np.arctan2(-turn[2, 0], np.hypot(turn[0, 0], turn[1, 0]))
    if np.cos(pitch) < 1e-9:
        return np.array([np.arctan2(-turn[1, 2], turn[1, 1]), pitch, 0.0])
    return np.array([np.arctan2(turn[2, 1], turn[2, 2]), pitch, np.arctan2(turn[1, 0], turn[0, 0])])


def _text(numbers: Any) -> str:
    return " ".join(repr(float(own)) for own in numbers)
