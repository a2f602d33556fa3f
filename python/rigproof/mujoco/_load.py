"""This file makes a MuJoCo model of an arm from its URDF."""

from __future__ import annotations

import os
from typing import Any

from .._errors import Error


def load(urdf: str | os.PathLike[str], tip: str | None = None) -> Any:
    """An MjModel of a URDF, without shapes, with a motor a joint of the joint's name, gear 1. tip: the link beyond which nothing is attached, as in a rig file;
    what hangs on it is left out. The joints' limits are left out too: a recorded arm keeps to its own."""
    import mujoco

    try:
        spec = mujoco.MjSpec.from_file(os.fspath(urdf))
    except ValueError as error:
        raise Error(f"{os.fspath(urdf)}: MuJoCo cannot read it; {error}") from error
    for shape in [*spec.geoms, *spec.meshes]:
        spec.delete(shape)
    if tip is not None:
        if spec.body(tip) is None:
            raise Error(f"{os.fspath(urdf)}: `{tip}` is no link of it; there are {', '.join(body.name for body in spec.bodies[1:])}")
        for body in list(spec.body(tip).bodies):
            spec.delete(body)
    for joint in spec.joints:
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
        spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    return spec.compile()
