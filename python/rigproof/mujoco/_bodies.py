"""This file finds real bodies whose efforts are nearest to those of inertial numbers that no real body may have.

A recording of efforts tells sums over links only, so the numbers that a calibration gives to one link need not be those of a body: moments may be negative. MuJoCo
needs real ones. The tensor of a link is that of a body exactly when its pseudo-inertia is positive (Wensing, Kim and Slotine 2018).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _inertia

Floats = np.ndarray[Any, np.dtype[np.float64]]

STATES = 60
# After a tenth of them the last link of a Panda is not there yet.
ROUNDS = 20000
# How much smaller a body's least direction may be than the described body's: share of its mass and moments.
LEAST = 1e-3


def _pseudo() -> Floats:
    """The linear map from ten numbers to the pseudo-inertia, shape (16, 10)."""
    columns = []
    for k in range(10):
        n = np.eye(10)[k]
        tensor = np.array([[n[4], n[5], n[6]], [n[5], n[7], n[8]], [n[6], n[8], n[9]]])
        whole = np.zeros((4, 4))
        whole[:3, :3] = 0.5 * np.trace(tensor) * np.eye(3) - tensor
        whole[:3, 3] = whole[3, :3] = n[1:4]
        whole[3, 3] = n[0]
        columns.append(whole.ravel())
    return np.array(columns).T


PSEUDO = _pseudo()


def efforts(model: Any, bodies: list[int], joints: list[int]) -> Floats:
    """What one unit more of each number, ten a body and then the armature of each joint, adds to the efforts at drawn states; shape (states·nv, numbers)."""
    import mujoco

    drawn, data = np.random.default_rng(1), mujoco.MjData(model)
    states = [(2.0 * drawn.standard_normal(model.nq), drawn.standard_normal(model.nv), 2.0 * drawn.standard_normal(model.nv)) for _ in range(STATES)]

    def of_model() -> Floats:
        force, all_of = np.zeros(model.nv), []
        for q, v, a in states:
            data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_comVel(model, data)
            mujoco.mj_rne(model, data, 1, force)
            all_of.append(force.copy())
        return np.concatenate(all_of)

    plain, columns = of_model(), []
    for body in bodies:
        own = _inertia.numbers(model, body)
        for k in range(10):
            _inertia.put(model, body, own + 0.01 * np.eye(10)[k])
            columns.append((of_model() - plain) / 0.01)
        _inertia.put(model, body, own)
    for joint in joints:
        columns.append(np.concatenate([np.eye(model.nv)[model.jnt_dofadr[joint]] * a for _, _, a in states]))
    return np.array(columns).T


def nearest(columns: Floats, described: Floats, wanted: Floats, count: int) -> Floats:
    """The numbers of `count` real bodies, ten each, and armatures of 0 or more, whose efforts are nearest to those of `wanted`; of equal ones those nearest to
    the described. Alternating directions (Boyd et al. 2011)."""
    spread = np.zeros((16 * count, 10 * count))
    for k in range(count):
        spread[16 * k : 16 * k + 16, 10 * k : 10 * k + 10] = PSEUDO
    whole = np.zeros((len(spread) + len(wanted) - 10 * count, len(wanted)))
    whole[: len(spread), : 10 * count] = spread
    whole[len(spread) :, 10 * count :] = np.eye(len(wanted) - 10 * count)
    solid = np.array([PSEUDO @ described[10 * k : 10 * k + 10] for k in range(count)]).reshape(count, 4, 4)
    least = LEAST * np.maximum(np.linalg.eigvalsh(solid)[:, :1], 1e-9)
    gram = columns.T @ columns / len(columns)
    # The pull to the described numbers decides only where no effort does.
    pull, step = 1e-6 * np.trace(gram) / len(gram), 1e-2 * np.trace(gram) / len(gram)
    inverse = np.linalg.inv(gram + (pull + step) * whole.T @ whole)
    from_efforts = whole @ inverse @ (gram @ wanted + pull * whole.T @ (whole @ described))
    from_seen = step * whole @ inverse @ whole.T
    seen, lag = whole @ described, np.zeros(len(whole))
    for _ in range(ROUNDS):
        own = from_efforts + from_seen @ (seen - lag)
        seen = own + lag
        values, axes = np.linalg.eigh(seen[: 16 * count].reshape(count, 4, 4))
        seen[: 16 * count] = (axes * np.maximum(values, least)[:, None] @ axes.swapaxes(1, 2)).ravel()
        seen[16 * count :] = np.maximum(seen[16 * count :], 0.0)
        lag += own - seen
    # From the real side: what is returned is real to the last digit.
    return np.asarray(np.linalg.lstsq(whole, seen, rcond=None)[0], dtype=np.float64)


def is_real(numbers: Floats) -> bool:
    """Whether ten numbers are those of a body."""
    return bool(np.linalg.eigvalsh((PSEUDO @ numbers).reshape(4, 4))[0] > 0.0)
