"""This file builds the wheel and the source archive: the program, which the wheel puts on the path, and the compiled part with maturin."""

import io
import os
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path
from typing import Any

import maturin

HERE = Path(__file__).resolve().parent.parent
ROOT = HERE.parent


def _with_program() -> None:
    """Compiles the program and lays it where maturin takes what goes on the path."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
    # One folder for both: what the program is made of is not compiled again for the compiled part (decision 0217).
    os.environ["CARGO_TARGET_DIR"] = str(target)
    subprocess.run(["cargo", "build", "--release", "--locked", "--bin", "rigproof"], cwd=ROOT, check=True)
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


def build_sdist(folder: str, settings: Any = None) -> str:
    """The source archive, from a clone: every room, since the program is made of them, with the description of the package at the top."""
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout.decode().split("\0")
    project = (HERE / "pyproject.toml").read_text(encoding="utf-8")
    for here, above in (('backend-path = ["build"]', 'backend-path = ["python/build"]'), ('= "."', '= "python"'), ('= "Cargo.toml"', '= "python/Cargo.toml"'), ('= "rigproof.data"', '= "python/rigproof.data"')):
        if project.count(here) != 1:
            raise RuntimeError(f"pyproject.toml says `{here}` {project.count(here)} times; build_sdist moves it one folder up")
        project = project.replace(here, above)
    with tempfile.TemporaryDirectory() as scratch:
        about = Path(scratch, prepare_metadata_for_build_wheel(scratch), "METADATA").read_bytes()
    version = next(line.split(": ")[1] for line in about.decode().splitlines() if line.startswith("Version: "))
    top = f"rigproof-{version}"
    with tarfile.open(Path(folder) / f"{top}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name in sorted(filter(None, files)):
            if (ROOT / name).is_file():
                archive.add(ROOT / name, f"{top}/{name}", filter=_nobodys)
        for name, content in (("pyproject.toml", project.encode()), ("PKG-INFO", about)):
            entry = tarfile.TarInfo(f"{top}/{name}")
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return f"{top}.tar.gz"


def _nobodys(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    """Without who made it and when, so that equal files give equal archives."""
    entry.uid = entry.gid = entry.mtime = 0
    entry.uname = entry.gname = ""
    return entry


get_requires_for_build_wheel = maturin.get_requires_for_build_wheel
