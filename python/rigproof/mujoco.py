"""This file carries a calibration of one joint into MuJoCo, and runs MuJoCo's own model beside a recording.

    import mujoco, rigproof, rigproof.mujoco
    model = mujoco.MjModel.from_xml_path("motor.xml")
    print(rigproof.mujoco.apply(report, model, joint="shaft", actuator="motor"))
    print(rigproof.mujoco.replay(model, t, position, command)["rms"])
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np

from ._errors import Error
from ._report import Report
from ._rig import Rig

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


def apply(calibration: Any, model: Any, joint: str | int = 0, actuator: str | int = 0) -> dict[str, list[str]]:
    """Sets what MuJoCo can hold of a calibration of one joint: damping, frictionloss, armature (so that the joint's whole inertia is the calibrated one), and the
    actuator's gain. `calibration` is a Report, a Rig, or the TOML text of one; `model` an MjModel, which is changed. Gives `set` and `not_held`, a line each:
    laws that MuJoCo has no number for, such as a breakaway peak or a delay, are not held and nothing stands in for them.
    """
    text = calibration.calibration if isinstance(calibration, Report) else calibration.text if isinstance(calibration, Rig) else calibration
    if text is None:
        raise Error("calibration: nothing was fitted, so nothing can be set; look at the verdict of the report")
    keys = tomllib.loads(text)
    if keys.get("plant") != "axis":
        raise Error(f"calibration: a plant of kind `{keys.get('plant')}` cannot be carried into MuJoCo yet; give one of an `axis`")
    dof = model.joint(joint).dofadr[0]
    own = model.actuator(actuator)
    done: dict[str, list[str]] = {"set": [], "not_held": []}
    model.dof_damping[dof] = model.dof_frictionloss[dof] = 0.0
    for effect in keys.get("effect", []):
        law = effect["mechanism"]
        number = next((effect[key] for key in ("coefficient", "level") if key in effect), None)
        if law not in ("viscous", "dry_offset") or "onset" in effect or number is None:
            onset = " from an onset on" if "onset" in effect else ""
            done["not_held"].append(f"{law}{onset}: MuJoCo has no number for it")
            continue
        target = model.dof_damping if law == "viscous" else model.dof_frictionloss
        target[dof] += number["value"]
        done["set"].append(f"{'damping' if law == 'viscous' else 'frictionloss'} {target[dof]:.4g} {number['unit']}")
    inertia, gain = keys["parameters"]["inertia"], keys["parameters"]["command_gain"]
    kept, model.dof_armature[dof] = model.dof_armature[dof], 0.0
    rest = _inertia(model, dof)
    if inertia["value"] < rest:
        model.dof_armature[dof] = kept
        done["not_held"].append(f"inertia {inertia['value']:.4g}: the bodies of the model alone have {rest:.4g}")
    else:
        model.dof_armature[dof] = inertia["value"] - rest
        done["set"].append(f"armature {model.dof_armature[dof]:.4g} {inertia['unit']}")
    # MuJoCo keeps the inertia of simple joints in numbers of its own, which follow the armature only when it is told to.
    _inertia(model, dof)
    own.gainprm[0] = gain["value"] / own.gear[0]
    done["set"].append(f"gain of the actuator {own.gainprm[0]:.4g} {gain['unit']}")
    return done


def _inertia(model: Any, dof: int) -> float:
    """The inertia that a joint moves in the position that the model begins in."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_setConst(model, data)
    mujoco.mj_forward(model, data)
    unit, force = np.zeros(model.nv), np.zeros(model.nv)
    unit[dof] = 1.0
    mujoco.mj_mulM(model, data, force, unit)
    return float(force[dof])


def replay(model: Any, time_s: Any, position: Any, command: Any, joint: str | int = 0, actuator: str | int = 0, restart_s: float = 1.0) -> dict[str, Any]:
    """Runs the model freely beside a recording, the command held between samples, and starts from the recorded state again every `restart_s` seconds.

    time_s, position (m or rad), command (the unit of the calibrated gain): shape (n,). Gives `rms` of simulated less recorded position, `simulated`, shape (n,),
    and `runs`. The step of the model's `opt.timestep` is made to divide the interval of the samples, which is taken as even.
    """
    import mujoco

    t, x, u = (np.asarray(own, dtype=float) for own in (time_s, position, command))
    if not (t.ndim == 1 and t.shape == x.shape == u.shape and len(t) > 20):
        raise Error(f"replay: shapes {t.shape}, {x.shape}, {u.shape}; give three arrays of the same shape (n,), n > 20")
    step_s = float(t[-1] - t[0]) / (len(t) - 1)
    inner = max(1, round(step_s / model.opt.timestep))
    kept, model.opt.timestep = model.opt.timestep, step_s / inner
    data, simulated, every = mujoco.MjData(model), np.empty(len(t)), max(20, round(restart_s / step_s))
    qpos, dof = model.joint(joint).qposadr[0], model.joint(joint).dofadr[0]
    try:
        for begin in range(0, len(t), every):
            # The speed at the start: a parabola through the samples around it, which noise moves less than one difference.
            low, high = max(0, begin - 10), min(len(t), begin + 11)
            mujoco.mj_resetData(model, data)
            state = np.polyfit(t[low:high] - t[begin], x[low:high], 2)
            data.qpos[qpos], data.qvel[dof] = state[2], state[1]
            for k in range(begin, min(begin + every, len(t))):
                simulated[k] = data.qpos[qpos]
                data.ctrl[model.actuator(actuator).id] = u[k]
                mujoco.mj_step(model, data, inner)
    finally:
        model.opt.timestep = kept
    return {"rms": float(np.sqrt(np.nanmean((simulated - x) ** 2))), "simulated": simulated, "runs": -(-len(t) // every)}
