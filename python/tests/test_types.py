"""This file holds the package, its stubs and its use to their types."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOM = Path(__file__).parent.parent
USE = """
import rigproof
report = rigproof.diagnose({"t": [0.0]}, rigproof.Rig.axis(position="x", command="f", inertia=(2.0, "kg"), command_gain=(1.0, "N/N")), hold_out=0.3)
verdict: str = report.verdict
wrong: int = report.verdict
rigproof.diagnose()
"""


def mypy(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--cache-dir", os.devnull, *words], capture_output=True, text=True, cwd=ROOM)


def test_the_types_hold() -> None:
    done = mypy("-p", "rigproof")
    assert done.returncode == 0, done.stdout


def test_who_uses_the_package_is_checked(tmp_path: Path) -> None:
    (tmp_path / "use.py").write_text(USE)
    said = mypy(str(tmp_path / "use.py")).stdout
    assert "use.py:5: error: Incompatible types" in said and "use.py:6: error: Missing positional arguments" in said and "Found 2 errors" in said, said


def test_the_stub_names_what_the_compiled_part_has(tmp_path: Path) -> None:
    # Not in the room itself, where the package has no compiled part: what is checked is the package as it is installed.
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "--mypy-config-file", str(ROOM / "pyproject.toml"), "rigproof._rigproof"], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
