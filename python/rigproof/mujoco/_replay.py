"""This file runs a MuJoCo model freely beside a recording."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .._errors import Error

Named = str | int


def replay(
    model: Any,
    time_s: Any,
    position: Any,
    command: Any,
    joint: Named | Sequence[Named] = 0,
    actuator: Named | Sequence[Named] = 0,
    restart_s: float = 1.0,
    before_step: Callable[[Any, Any], None] | None = None,
) -> dict[str, Any]:
    """Runs the model freely beside a recording, the command held between samples, and starts from the recorded state again every `restart_s` seconds.

    time_s: shape (n,). position (m or rad), command (the unit of the calibrated gain): shape (n,) of one joint; of k joints shape (n, k), a column for each of
    `joint` and `actuator`. Gives `rms` of simulated less recorded position, a number or shape (k,), `simulated`, shaped as position, and `runs`. The step of the
    model's `opt.timestep` is made to divide the interval of the samples, which is taken as even.
    before_step: called with model and data before each step, the forces up to date, such as `load_friction(report)`.
    """
    import mujoco

    t, given, u = (np.asarray(own, dtype=float) for own in (time_s, position, command))
    several = given.ndim == 2
    joints, actuators = (list(own) if isinstance(own, (list, tuple)) else [own] for own in (joint, actuator))
    shape = (len(t), len(joints)) if several else (len(t),)
    if not (t.ndim == 1 and given.shape == u.shape == shape and len(joints) == len(actuators) and len(t) > 20):
        raise Error(f"replay: shapes {t.shape}, {given.shape}, {u.shape}; give (n,) and twice (n,), or (n, k) for k joints and actuators, n > 20")
    x, u = given.reshape(len(t), -1), u.reshape(len(t), -1)
    step_s = float(t[-1] - t[0]) / (len(t) - 1)
    inner = max(1, round(step_s / model.opt.timestep))
    kept, model.opt.timestep = model.opt.timestep, step_s / inner
    data, simulated, every = mujoco.MjData(model), np.empty_like(x), max(20, round(restart_s / step_s))
    places, dofs = ([int(getattr(model.joint(own), key)[0]) for own in joints] for key in ("qposadr", "dofadr"))
    inputs = [model.actuator(own).id for own in actuators]
    try:
        for begin in range(0, len(t), every):
            # The speed at the start: a parabola through the samples around it, which noise moves less than one difference.
            low, high = max(0, begin - 10), min(len(t), begin + 11)
            mujoco.mj_resetData(model, data)
            state = np.polyfit(t[low:high] - t[begin], x[low:high], 2)
            data.qpos[places], data.qvel[dofs] = state[2], state[1]
            for k in range(begin, min(begin + every, len(t))):
                simulated[k] = data.qpos[places]
                data.ctrl[inputs] = u[k]
                _step(model, data, inner, before_step)
    finally:
        model.opt.timestep = kept
    rms = np.sqrt(np.nanmean((simulated - x) ** 2, axis=0))
    return {"rms": rms if several else float(rms[0]), "simulated": simulated.reshape(given.shape), "runs": -(-len(t) // every)}


def _step(model: Any, data: Any, count: int, before_step: Callable[[Any, Any], None] | None) -> None:
    import mujoco

    if before_step is None:
        mujoco.mj_step(model, data, count)
        return
    for _ in range(count):
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mujoco.mj_fwdActuation(model, data)
        before_step(model, data)
        mujoco.mj_step(model, data)
