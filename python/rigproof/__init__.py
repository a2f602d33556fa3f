"""Finds the physics that a rig's model left out, and shows the fit improve.

Five lines, from arrays to a name:

    import rigproof
    rig = rigproof.Rig.axis(position="x", command="u", inertia=(1.7, "kg"), command_gain=(35.5, "N/V"))
    report = rigproof.diagnose({"t": t, "x": x, "u": u}, rig, units={"x": "m", "u": "V"})
    print(report.verdict, report.names)
    report.save("found")

Times are in seconds and arrays have one value a sample, shape (n,), unless a docstring says otherwise.
"""

from . import blind, certify
from ._diagnose import diagnose
from ._errors import Error
from ._program import inspect, simulate
from ._report import Report
from ._rig import Rig
from ._rigproof import __version__
from .read import even, read

__all__ = ["Error", "Report", "Rig", "__version__", "blind", "certify", "diagnose", "even", "inspect", "read", "simulate"]
