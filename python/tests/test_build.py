"""This file holds the wheel to compiling nothing again that the program is made of."""

from __future__ import annotations

import shutil
import subprocess
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
