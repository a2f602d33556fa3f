"""This file sets in a MuJoCo model what a calibration found, and says what MuJoCo cannot hold."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

from .._errors import Error
from .._report import Report
from .._rig import Rig
from . import _bodies, _inertia

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

Keys = dict[str, Any]
Done = dict[str, list[str]]


def apply(calibration: Any, model: Any, joint: str | int = 0, actuator: str | int = 0, joints: Mapping[str, str] | None = None) -> Done:
    """Sets what MuJoCo can hold of a calibration, and gives `set` and `not_held`, a line each. Nothing stands in for what is not held.
    Of friction that builds up over a travel the level is set, and the travel is not held.

    calibration: a Report, a Rig, or the TOML text of one. model: an MjModel, which is changed.

    Of one joint (`axis`): damping, frictionloss, spring, armature, so that the joint's whole inertia is the calibrated one, and the actuator's gain, or of a
    position servo its gain, limit and back-EMF. joint, actuator: their names or numbers. These numbers are set, so that a second calibration replaces the first.

    Of an arm (`chain`): at each joint damping, frictionloss, spring and armature, of each link mass, centre and inertia, and constant torques in the joint's
    actuator.
    joints: the model's name of a joint by the rig's, where they differ. These numbers are added to what the model has from its URDF: apply once.
    """
    keys = keys_of(calibration)
    done: Done = {"set": [], "not_held": []}
    if keys.get("plant") == "axis":
        _axis(keys, model, joint, model.actuator(actuator), done)
    elif keys.get("plant") == "chain":
        _arm(keys, model, joints or {}, done)
    else:
        raise Error(f"calibration: a plant of kind `{keys.get('plant')}` cannot be carried into MuJoCo; give one of an `axis` or a `chain`")
    _settle(model)
    return done


def keys_of(calibration: Any) -> Keys:
    """The keys of a Report's calibration, of a Rig, or of the TOML text of one."""
    text = calibration.calibration if isinstance(calibration, Report) else calibration.text if isinstance(calibration, Rig) else calibration
    if text is None:
        raise Error("calibration: nothing was fitted, so nothing can be set; look at the verdict of the report")
    return tomllib.loads(text)


# Friction that builds up over a travel, and is Coulomb friction from there on.
BUILDS_UP = ("presliding", "dahl_bristle", "lugre_bristle")


def _friction(effect: Keys, model: Any, dof: int, where: str, done: Done) -> bool:
    """Adds viscous or Coulomb friction; False where the effect is another."""
    if effect["mechanism"] in BUILDS_UP and "onset" not in effect:
        done["not_held"].append(f"{where}{effect['mechanism']}: MuJoCo has no number for the travel of {effect['travel']['value']:.3g} {effect['travel']['unit']}")
        _friction({"mechanism": "dry_offset", "level": effect["level"]}, model, dof, where, done)
        if "viscous" in effect:
            _friction({"mechanism": "viscous", "coefficient": effect["viscous"]}, model, dof, where, done)
        return True
    number: Keys = effect.get("coefficient") or effect.get("level") or {}
    if effect["mechanism"] in ("viscous", "dry_offset") and number["value"] < 0.0:
        done["not_held"].append(f"{where}{effect['mechanism']} {number['value']:.4g} {number['unit']}: MuJoCo holds no friction that drives")
    elif effect["mechanism"] == "viscous" and "onset" not in effect:
        model.dof_damping[dof] += effect["coefficient"]["value"]
        done["set"].append(f"{where}damping {model.dof_damping[dof]:.4g} {effect['coefficient']['unit']}")
    elif effect["mechanism"] == "dry_offset" and "onset" not in effect:
        model.dof_frictionloss[dof] += effect["level"]["value"]
        done["set"].append(f"{where}frictionloss {model.dof_frictionloss[dof]:.4g} {effect['level']['unit']}")
    else:
        return False
    return True


def _spring(effect: Keys, model: Any, joint: int, where: str, done: Done) -> bool:
    """Adds a spring to that of the joint; False where the effect is another."""
    if effect["mechanism"] != "spring" or "onset" in effect:
        return False
    stiffness, rest = effect["stiffness"]["value"], effect.get("rest", {"value": 0.0})["value"]
    if stiffness < 0.0:
        done["not_held"].append(f"{where}spring {stiffness:.4g} {effect['stiffness']['unit']}: MuJoCo holds no spring that pushes away")
        return True
    before, place = model.jnt_stiffness[joint], model.jnt_qposadr[joint]
    model.jnt_stiffness[joint] = before + stiffness
    model.qpos_spring[place] = (before * model.qpos_spring[place] + stiffness * rest) / max(before + stiffness, 1e-300)
    done["set"].append(f"{where}stiffness {model.jnt_stiffness[joint]:.4g} {effect['stiffness']['unit']} about {model.qpos_spring[place]:.4g}")
    return True


def _not_held(effect: Keys, where: str, done: Done) -> None:
    since = " from an onset on" if "onset" in effect else ""
    how = "; load_friction(...) works it out at each step" if effect["mechanism"] == "load_friction" and not where else ""
    done["not_held"].append(f"{where}{effect['mechanism']}{since}: MuJoCo has no number for it{how}")


def _axis(keys: Keys, model: Any, joint: str | int, actuator: Any, done: Done) -> None:
    dof = model.joint(joint).dofadr[0]
    own = model.dof_jntid[dof]
    model.dof_damping[dof] = model.dof_frictionloss[dof] = model.jnt_stiffness[own] = 0.0
    for effect in keys.get("effect", []):
        if not (_friction(effect, model, dof, "", done) or _spring(effect, model, own, "", done) or _gravity(effect, model, dof, done)):
            _not_held(effect, "", done)
    inertia, gain = keys["parameters"]["inertia"], keys["parameters"]["command_gain"]
    kept, model.dof_armature[dof] = model.dof_armature[dof], 0.0
    rest = _moved(model, dof)
    if inertia["value"] < rest:
        model.dof_armature[dof] = kept
        done["not_held"].append(f"inertia {inertia['value']:.4g}: the bodies of the model alone have {rest:.4g}")
    else:
        model.dof_armature[dof] = inertia["value"] - rest
        done["set"].append(f"armature {model.dof_armature[dof]:.4g} {inertia['unit']}")
    actuator.gainprm[0] = gain["value"] / actuator.gear[0]
    if "servo" in keys:
        _servo(keys["servo"], gain["value"], model, dof, actuator, done)
    else:
        done["set"].append(f"gain of the actuator {actuator.gainprm[0]:.4g} {gain['unit']}")


def _servo(servo: Keys, gain: float, model: Any, dof: int, actuator: Any, done: Done) -> None:
    """A servo's control is a goal: the actuator's force follows from the error, up to what the supply gives; the motion's own voltage damps."""
    import mujoco

    stiffness = servo["gain"] * gain
    if actuator.gear[0] != 1.0:
        raise Error(f"servo: the gear of the actuator is {actuator.gear[0]:g}; a goal is an angle of the joint, so give the actuator gear 1")
    actuator.gaintype[0], actuator.biastype[0] = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
    actuator.gainprm[0], actuator.biasprm[:3] = stiffness, [0.0, -stiffness, 0.0]
    limit = abs(servo["supply_v"] * gain)
    actuator.forcelimited[0], actuator.forcerange[:] = 1, [-limit, limit]
    model.dof_damping[dof] += servo.get("back_emf", 0.0) * gain
    done["set"] += [f"servo of {stiffness:.4g} for an error of 1, up to {limit:.4g}", f"damping with back-EMF {model.dof_damping[dof]:.4g}"]
    if servo.get("dead_band"):
        done["not_held"].append(f"dead band of the servo {servo['dead_band']:.3g}: MuJoCo has no number for it")


def _gravity(effect: Keys, model: Any, dof: int, done: Done) -> bool:
    """A ripple of one turn is gravity, which the bodies hold: whether they hold this one."""
    if effect["mechanism"] != "ripple" or abs(effect["period"]["value"] - 2.0 * np.pi) > 1e-6 or "onset" in effect:
        return False
    import mujoco

    data = mujoco.MjData(model)
    place = model.jnt_qposadr[model.dof_jntid[dof]]
    own = []
    for angle in (np.pi / 2.0, 0.0):
        data.qpos[:] = model.qpos0
        data.qpos[place] = angle
        mujoco.mj_forward(model, data)
        own.append(float(data.qfrc_bias[dof]))
    wanted = [effect[key]["value"] for key in ("sine", "cosine")]
    held = np.hypot(own[0] - wanted[0], own[1] - wanted[1]) < 0.02 * np.hypot(*wanted)
    said = f"gravity {wanted[0]:.4g}·sin q {wanted[1]:+.4g}·cos q N·m"
    done["set" if held else "not_held"].append(said + (", by the bodies as they are" if held else f": the bodies have {own[0]:.4g} and {own[1]:.4g}; change mass or arm"))
    return True


def _arm(keys: Keys, model: Any, names: Mapping[str, str], done: Done) -> None:
    numbers: dict[int, np.ndarray[Any, Any]] = {}
    armature: dict[int, float] = {}
    for effect in keys.get("effect", []):
        own = names.get(effect["joint"], effect["joint"])
        try:
            joint = model.joint(own)
        except KeyError:
            raise Error(f"calibration: the model has no joint `{own}`; say what it is called there: joints={{{effect['joint']!r}: ...}}") from None
        where, law = f"{own}: ", effect["mechanism"]
        if "onset" in effect:
            _not_held(effect, where, done)
        elif law == "link_inertia":
            # Differences from the described numbers, about the origin of the joint's frame, which is the body's.
            numbers[joint.id] = np.array([effect[key]["value"] for key in ("mass", "x", "y", "z", "xx", "xy", "xz", "yy", "yz", "zz")])
        elif law == "added_inertia":
            armature[joint.id] = effect["inertia"]["value"]
        elif law == "constant_bias":
            _bias(effect, model, joint.id, where, done)
        elif not (_friction(effect, model, int(joint.dofadr[0]), where, done) or _spring(effect, model, joint.id, where, done)):
            _not_held(effect, where, done)
    if numbers or armature:
        _bodies_of(model, numbers, armature, done)


def _bodies_of(model: Any, numbers: Mapping[int, Any], armature: Mapping[int, float], done: Done) -> None:
    """Sets bodies and armatures: as the calibration has them where these are real, and the nearest real ones otherwise."""
    joints = list(range(model.njnt))
    bodies, dofs = [int(model.jnt_bodyid[k]) for k in joints], [int(model.jnt_dofadr[k]) for k in joints]
    described = np.concatenate([*(_inertia.numbers(model, body) for body in bodies), model.dof_armature[dofs]])
    wanted = described.copy()
    for k in joints:
        wanted[10 * k : 10 * k + 10] += numbers.get(k, 0.0)
        wanted[10 * len(joints) + k] += armature.get(k, 0.0)
    rest = wanted[10 * len(joints) :]
    put = wanted
    if not all(_bodies.is_real(wanted[10 * k : 10 * k + 10]) for k in joints) or (rest < 0.0).any():
        columns = _bodies.efforts(model, bodies, joints)
        put = _bodies.nearest(columns, described, wanted, len(joints))
        away, size = (float(np.sqrt(np.mean((columns @ own) ** 2))) for own in (put - wanted, wanted - described))
        done["set"].append(f"bodies: the calibration's numbers are sums over links that no real bodies have one by one; the nearest real ones are {away / size:.1%} of the change away")
    for k, body, dof in zip(joints, bodies, dofs):
        _inertia.put(model, body, put[10 * k : 10 * k + 10])
        model.dof_armature[dof] = max(0.0, put[10 * len(joints) + k])
        done["set"].append(f"{model.joint(k).name}: mass {model.body_mass[body]:.4g} kg, centre {np.round(model.body_ipos[body], 4).tolist()} m, armature {model.dof_armature[dof]:.3g}")


def _bias(effect: Keys, model: Any, joint: int, where: str, done: Done) -> None:
    """A constant resistance, as a constant force against it of the joint's actuator; an actuator with a bias of its own is left as it is."""
    import mujoco

    own = [k for k in range(model.nu) if model.actuator_trntype[k] == mujoco.mjtTrn.mjTRN_JOINT and model.actuator_trnid[k, 0] == joint]
    free = [k for k in own if model.actuator_biastype[k] == mujoco.mjtBias.mjBIAS_NONE or not model.actuator_biasprm[k, 1:].any()]
    if not free:
        done["not_held"].append(f"{where}constant_bias {effect['level']['value']:.4g}: no motor at this joint can hold it")
        return
    model.actuator_biastype[free[0]] = mujoco.mjtBias.mjBIAS_AFFINE
    model.actuator_biasprm[free[0], 0] -= effect["level"]["value"] / model.actuator_gear[free[0], 0]
    done["set"].append(f"{where}constant force of the actuator {model.actuator_biasprm[free[0], 0]:.4g} {effect['level']['unit']}")


def _settle(model: Any) -> None:
    """MuJoCo keeps some inertias in numbers of its own, which follow only when they are told to."""
    import mujoco

    mujoco.mj_setConst(model, mujoco.MjData(model))


def _moved(model: Any, dof: int) -> float:
    """The inertia that a joint moves in the position that the model begins in."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_setConst(model, data)
    mujoco.mj_forward(model, data)
    unit, force = np.zeros(model.nv), np.zeros(model.nv)
    unit[dof] = 1.0
    mujoco.mj_mulM(model, data, force, unit)
    return float(force[dof])
