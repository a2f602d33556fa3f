"""This file asks the program that the wheel puts on the path, and gives its JSON."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

from ._errors import Error

PathLike = str | os.PathLike[str]


def program() -> str:
    """The path of the program: the one beside this Python, or else the one on the path."""
    name = "rigproof.exe" if os.name == "nt" else "rigproof"
    own = Path(sysconfig.get_path("scripts")) / name
    found = str(own) if own.exists() else shutil.which("rigproof")
    if found is None:
        raise Error("rigproof: the program is not on the path; install the package again")
    return found


def asked(words: list[str]) -> dict[str, Any]:
    """Runs a verb with --json; a check that does not hold is an answer. The lock of the interpreter is free meanwhile, and Ctrl-C ends the program.

    Raises rigproof.Error where an input is not usable.
    """
    done = subprocess.run([program(), *words, "--json"], capture_output=True, text=True, encoding="utf-8")
    if done.returncode not in (0, 1) or not done.stdout.strip():
        raise Error(done.stderr.strip().removeprefix("error: ") or f"rigproof {words[0]}: it ended with {done.returncode}")
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def simulate(recording: PathLike, rig: PathLike, calibration: PathLike | None = None, out: PathLike | None = None) -> dict[str, Any]:
    """Runs a rig's model along a recorded file and says how far the two lie apart: unit, samples, rms, maximum, nrmse_percent. out: a CSV file to write."""
    words = ["simulate", os.fspath(recording), "--rig", os.fspath(rig)]
    words += ["--calibration", os.fspath(calibration)] if calibration is not None else []
    return asked(words + (["--out", os.fspath(out)] if out is not None else []))


def inspect(recording: PathLike, write_rig: PathLike | None = None, sweep: bool = False) -> dict[str, Any]:
    """Says what is in a recorded file: rate, gaps, channels with quantum and noise. write_rig: the rig description to begin. sweep: its rows are a static
    sweep, without a time."""
    words = ["inspect", os.fspath(recording), *(["--sweep"] if sweep else [])]
    return asked(words + (["--write-rig", os.fspath(write_rig)] if write_rig is not None else []))
