"""This file says which efforts a recorded motion takes in a MuJoCo model, beside those that were recorded."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._errors import Error

# The exponent of the window's shape, as a diagnosis has it: (1 - x²)⁴.
ORDER = 4


def effort(
    model: Any, time_s: Any, position: Any, effort: Any, joints: Sequence[str] | None = None, window_s: float = 0.155, least_speed: float | None = None
) -> dict[str, Any]:
    """Inverse dynamics along a recorded motion, by MuJoCo.

    time_s: shape (n,). position, effort: shape (n, k), rad or m and N·m or N, a column a joint, in the order of `joints`, or of the model where it is None.
    window_s: the width over which positions and efforts are averaged, and from which speed and acceleration come. It is what a diagnosis of an arm takes, so
    that `rms` compares with the report's held-out error. least_speed: samples whose joint is slower say nothing about its friction's sign and do not count for
    that joint; 2 % of its greatest speed where it is None.

    Gives `rms`, shape (k,), of computed less recorded effort; `all`, their root mean square; `time_s`, `computed` and `recorded`, shapes (m,) and (m, k), inside
    the recording by half a window.
    """
    import mujoco

    t, q, tau = np.asarray(time_s, dtype=float), np.asarray(position, dtype=float), np.asarray(effort, dtype=float)
    names = [model.joint(k).name for k in range(model.njnt)] if joints is None else list(joints)
    if not (t.ndim == 1 and q.shape == tau.shape == (len(t), len(names))):
        raise Error(f"effort: shapes {t.shape}, {q.shape}, {tau.shape}; give (n,), (n, {len(names)}) and (n, {len(names)}), a column for each of {', '.join(names)}")
    if len(names) != model.nv:
        raise Error(f"effort: the model has {model.nv} joints' motions, and {len(names)} are recorded; leave the others out of the model (load(..., tip=...))")
    step = float(np.median(np.diff(t)))
    even = np.arange(t[0], t[-1], step)
    half = max(3, round(0.5 * window_s / step))
    weights = (1.0 - (np.arange(-half, half + 1) / (half + 1)) ** 2) ** ORDER
    weights /= weights.sum()

    def seen(columns: Any) -> Any:
        return np.column_stack([np.convolve(np.interp(even, t, own), weights, mode="valid") for own in columns.T])

    q, tau, even = seen(q), seen(tau), even[half : len(even) - half]
    speed = np.gradient(q, step, axis=0)
    acceleration = np.gradient(speed, step, axis=0)
    data, computed = mujoco.MjData(model), np.empty_like(q)
    own = [model.joint(name) for name in names]
    places, dofs = [int(j.qposadr[0]) for j in own], [int(j.dofadr[0]) for j in own]
    for k in range(len(even)):
        data.qpos[places], data.qvel[dofs], data.qacc[dofs] = q[k], speed[k], acceleration[k]
        # The actuators' constant forces, at no control.
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mujoco.mj_fwdActuation(model, data)
        held = data.qfrc_actuator[dofs].copy()
        data.qacc[dofs] = acceleration[k]
        mujoco.mj_inverse(model, data)
        computed[k] = data.qfrc_inverse[dofs] - held
    floor = 0.02 * np.abs(speed).max(axis=0) if least_speed is None else least_speed
    error = np.where(np.abs(speed) > floor, computed - tau, np.nan)
    rms = np.sqrt(np.nanmean(error**2, axis=0))
    return {"rms": rms, "all": float(np.sqrt(np.nanmean(error**2))), "time_s": even, "computed": computed, "recorded": tau}
