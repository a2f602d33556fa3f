"""This file makes recordings with a hidden cause, and scores what a diagnosis says of them."""

from __future__ import annotations

import os
from typing import Any

from ._program import PathLike, asked


def make(plant: str, seed: int, out: PathLike, stratum: str | None = None) -> dict[str, Any]:
    """Writes recording.csv, rig.toml and answer.sealed into the folder `out`. plant: `axis`, `bench` or `rig`; stratum: see `rigproof blind make --help`."""
    return asked(["blind", "make", "--plant", plant, "--seed", str(seed), "--out", os.fspath(out)] + (["--stratum", stratum] if stratum else []))


def score(answer: PathLike, report: PathLike) -> dict[str, Any]:
    """Opens a sealed answer and scores a report.json against it: `answer` and `score`."""
    return asked(["blind", "score", os.fspath(answer), os.fspath(report)])
