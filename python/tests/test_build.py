"""This file holds the wheel to compiling nothing again that the program is made of."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent


def features(*words: str) -> set[str]:
    """Every package of a build with its features, as cargo resolves them."""
    call = ["cargo", "tree", "--locked", "--prefix", "none", "--edges", "normal,build", "--no-dedupe", "--format", "{p} {f}", *words]
    return set(subprocess.run(call, check=True, capture_output=True, text=True, cwd=ROOT).stdout.splitlines())


@pytest.mark.skipif(shutil.which("cargo") is None, reason="cargo is absent")
def test_the_extension_has_the_programs_packages_with_the_same_features() -> None:
    program = features("-p", "rigproof")
    assert len(program) > 100
    other = program - features("-p", "rigproof-python", "--features", "extension")
    assert not other, f"compiled again for the wheel; name them in cli/Cargo.toml with the features of the extension (decision 0217): {sorted(other)}"


def backend(folder: Path, call: str) -> str:
    """What the package's own build backend gives, in a folder that holds its pyproject.toml."""
    code = f"import sys; sys.path.insert(0, {str(folder / ('python/build' if (folder / 'PKG-INFO').exists() else 'build'))!r}); import wheel; print(wheel.{call})"
    # maturin is found on the path, as in the environment that pip builds in.
    path = {**os.environ, "PATH": f"{sysconfig.get_path('scripts')}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=folder, env=path)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()[-1]


@pytest.mark.skipif(shutil.which("cargo") is None or not (ROOT / ".git").exists(), reason="cargo or the clone is absent")
def test_the_source_archive_holds_what_the_wheel_is_built_from(tmp_path: Path) -> None:
    pytest.importorskip("maturin")
    name = backend(ROOT / "python", f"build_sdist({str(tmp_path)!r})")
    with tarfile.open(tmp_path / name) as archive:
        archive.extractall(tmp_path, filter="data")
    top = tmp_path / name.removesuffix(".tar.gz")
    assert (top / "PKG-INFO").read_text().startswith("Metadata-Version") and (top / "spec/Cargo.toml").exists()
    # Its own backend, from its own folder: cargo and maturin find every room.
    subprocess.run(["cargo", "metadata", "--no-deps", "--locked", "--format-version", "1"], check=True, capture_output=True, cwd=top)
    made = backend(top, f"prepare_metadata_for_build_wheel({str(tmp_path / 'about')!r})")
    # The order of the extras is not the same each time, and the licences lie beside the description only here.
    own, kept = (sorted(line for line in file.read_text().splitlines() if not line.startswith("License-File")) for file in (tmp_path / "about" / made / "METADATA", top / "PKG-INFO"))
    assert made == "rigproof-0.1.0.dist-info" and own == kept
