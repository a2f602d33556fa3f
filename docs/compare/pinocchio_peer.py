"""This file builds and runs `pinocchio_steps.cpp`, which steps the five-bar with Pinocchio's constrained dynamics."""

import subprocess
from pathlib import Path

import numpy as np
import pinocchio

# As Pinocchio's own CMake targets have them.
DEFINITIONS = [
    "BOOST_MPL_LIMIT_LIST_SIZE=30", "BOOST_MPL_LIMIT_VECTOR_SIZE=30", "BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "BOOST_FUSION_INVOKE_MAX_ARITY=12", "PINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION",
]


def build(folder):
    """Compiles the program against the wheels' headers and libraries, once a folder."""
    program = Path(folder) / "pinocchio_steps"
    source = Path(__file__).with_name("pinocchio_steps.cpp")
    if program.exists() and program.stat().st_mtime > source.stat().st_mtime:
        return program
    prefix = Path(pinocchio.__file__).parents[4]
    include, library = prefix / "include", prefix / "lib"
    command = ["g++", "-std=c++17", "-O2", "-DNDEBUG", *(f"-D{name}" for name in DEFINITIONS)]
    command += [f"-I{include}", f"-I{include / 'eigen3'}", str(source), "-o", str(program)]
    command += [f"-L{library}", "-lpinocchio_default", f"-Wl,-rpath,{library}"]
    subprocess.run(command, check=True, stderr=subprocess.PIPE)
    return program


class Peer:
    """One case under one scheme; `rate` is that of Baumgarte's stabilisation, 1/s."""

    def __init__(self, program, folder, case, forces_n, scheme, steps_a_tick=1, rate=0.0):
        self.program, self.folder = program, Path(folder)
        self.choice = [scheme, str(steps_a_tick), str(rate)]
        arms = (case["arms"][name] for name in ("AE", "ED", "BC", "CD"))
        numbers = [case["step_s"], case["base_m"]]
        numbers += [arm[key] for arm in arms for key in ("length_m", "mass_kg", "inertia_kg_m2", "centre_m")]
        numbers += case["start_rad"]
        (self.folder / "pinocchio.rig").write_text(" ".join(map(repr, numbers)))
        np.savetxt(self.folder / "pinocchio.forces", forces_n, fmt="%.17g")
        self.files = [self.folder / "pinocchio.rig", self.folder / "pinocchio.forces"]

    def _run(self, runs):
        out = self.folder / "pinocchio.csv"
        done = subprocess.run(
            [self.program, *self.files, *self.choice, str(runs), out], check=True, capture_output=True, text=True
        )
        return out, [float(value) for value in done.stdout.split()]

    def tips_m(self):
        """The tips of ED and of CD, a row a tick."""
        rows = np.loadtxt(self._run(0)[0], delimiter=",", skiprows=1)
        return rows[:, :2], rows[:, 2:]

    def steps_ns(self, runs):
        """The CPU time of a step in each of several whole runs, ns: median and least."""
        return self._run(runs)[1]
