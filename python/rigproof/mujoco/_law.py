"""This file works out, at each step, friction that MuJoCo has no number for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .._errors import Error
from ._apply import Keys, keys_of

Law = Callable[[Any, Any], None]


def load_friction(calibration: Any, joint: str | int = 0) -> Law:
    """Coulomb friction that grows with the effort of the drive, as a calibration of one joint has it: for `replay(..., before_step=...)`, or to be called with
    model and data, whose forces are up to date, before each `mj_step` of your own.

    calibration: a Report, a Rig, or the TOML text of one, with a `load_friction`. The effort is the actuator's, less what a servo's back-EMF takes.
    """
    keys: Keys = keys_of(calibration)
    effects = {effect["mechanism"]: effect for effect in keys.get("effect", []) if "onset" not in effect}
    if keys.get("plant") != "axis" or "load_friction" not in effects:
        raise Error("calibration: it has no friction under load of one joint; `apply` sets all that MuJoCo holds")
    found = effects["load_friction"]
    share = float(found["share"]["value"])
    exponent = float(found["exponent"]["value"]) if "exponent" in found else 1.0
    level = float(effects["dry_offset"]["level"]["value"]) if "dry_offset" in effects else 0.0
    drag = float(keys["parameters"]["command_gain"]["value"] * keys.get("servo", {}).get("back_emf", 0.0))

    def law(model: Any, data: Any) -> None:
        dof = model.joint(joint).dofadr[0]
        model.dof_frictionloss[dof] = max(0.0, level + share * abs(data.qfrc_actuator[dof] - drag * data.qvel[dof]) ** exponent)

    return law
