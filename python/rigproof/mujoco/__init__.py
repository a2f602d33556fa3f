"""This package carries a calibration into MuJoCo, and holds MuJoCo's own model against a recording.

One joint, run freely:

    import mujoco, rigproof, rigproof.mujoco
    model = mujoco.MjModel.from_xml_path("motor.xml")
    print(rigproof.mujoco.apply(report, model, joint="shaft", actuator="motor"))
    print(rigproof.mujoco.replay(model, t, position, command, joint="shaft", actuator="motor")["rms"])

An arm, by the efforts that its motion takes:

    model = rigproof.mujoco.load("arm.urdf", tip="flange")
    before = rigproof.mujoco.effort(model, t, q, tau)["rms"]
    rigproof.mujoco.apply(report, model)
    after = rigproof.mujoco.effort(model, t, q, tau)["rms"]
"""

from ._apply import apply
from ._effort import effort
from ._law import load_friction
from ._load import load
from ._replay import replay

__all__ = ["apply", "effort", "load", "load_friction", "replay"]
