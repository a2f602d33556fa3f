"""This file reads and sets the inertial numbers of a body of a MuJoCo model: mass, first and second moments about the body's own frame."""

from __future__ import annotations

from typing import Any

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]


def _crossed(v: Floats) -> Floats:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def numbers(model: Any, body: int) -> Floats:
    """The ten numbers m [kg], mx, my, mz [kg·m], xx, xy, xz, yy, yz, zz [kg·m²], about the origin of the body's frame."""
    import mujoco

    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    axes = turn.reshape(3, 3)
    mass, arm = float(model.body_mass[body]), _crossed(model.body_ipos[body])
    second = axes @ np.diag(model.body_inertia[body]) @ axes.T - mass * arm @ arm
    return np.array([mass, *(mass * model.body_ipos[body]), *second[np.triu_indices(3)]])


def put(model: Any, body: int, own: Floats) -> None:
    """Sets the ten numbers of a body; the mass is above 0."""
    import mujoco

    mass, centre = own[0], own[1:4] / own[0]
    arm, second = _crossed(centre), np.zeros((3, 3))
    second[np.triu_indices(3)] = own[4:]
    second = second + np.triu(second, 1).T
    moments, axes = np.linalg.eigh(second + mass * arm @ arm)
    if np.linalg.det(axes) < 0.0:
        axes[:, 2] *= -1.0
    turn = np.zeros(4)
    mujoco.mju_mat2Quat(turn, np.ascontiguousarray(axes).ravel())
    model.body_mass[body], model.body_ipos[body], model.body_inertia[body], model.body_iquat[body] = mass, centre, moments, turn
    # MuJoCo takes a short way where it knows that a body's frame is its own principal frame.
    model.body_sameframe[body] = model.body_simple[body] = 0
