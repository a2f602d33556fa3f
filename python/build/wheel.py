"""This file builds the wheel: first the program, which the wheel puts on the path, then the compiled part with maturin."""

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import maturin

HERE = Path(__file__).resolve().parent.parent


def _with_program() -> None:
    """Compiles the program and lays it where maturin takes what goes on the path."""
    root = HERE.parent
    target = Path(os.environ.get("CARGO_TARGET_DIR", root / "target")).resolve()
    # One folder for both, so that what both need is fetched and compiled once where it is the same.
    os.environ["CARGO_TARGET_DIR"] = str(target)
    subprocess.run(["cargo", "build", "--release", "--locked", "--bin", "rigproof"], cwd=root, check=True)
    name = "rigproof.exe" if os.name == "nt" else "rigproof"
    scripts = HERE / "rigproof.data" / "scripts"
    scripts.mkdir(parents=True, exist_ok=True)
    shutil.copy2(target / "release" / name, scripts / name)
    if shutil.which("strip"):
        subprocess.run(["strip", str(scripts / name)], check=True)


def build_wheel(folder: str, settings: Any = None, metadata: Any = None) -> str:
    """A wheel, as `pip install .` and `python -m build --wheel` ask for it."""
    _with_program()
    return str(maturin.build_wheel(folder, settings, metadata))


def prepare_metadata_for_build_wheel(folder: str, settings: Any = None) -> str:
    """The metadata alone; what goes on the path need not be there yet."""
    (HERE / "rigproof.data").mkdir(exist_ok=True)
    return str(maturin.prepare_metadata_for_build_wheel(folder, settings))


get_requires_for_build_wheel = maturin.get_requires_for_build_wheel
