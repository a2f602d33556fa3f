"""This module reads a recording of the five-bar with its description, and says what makes it unusable."""

import csv
import tomllib
from dataclasses import dataclass

import numpy as np

from rig_model import BRAKES


@dataclass
class Recording:
    layout: str
    step_s: float
    theta_rad: np.ndarray
    force_n: np.ndarray
    currents_a: dict
    # What a technician would throw the recording away for.
    fault: str | None


def read(folder):
    rig = tomllib.loads((folder / "rig.toml").read_text())
    with open(folder / "recording.csv", newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        names = [name.split(" (")[0] for name in next(rows)]
        cells = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    raw = dict(zip(names, cells.T))

    def channel(name):
        its = rig["channels"][name]
        return its.get("sign", 1) * its.get("scale", 1.0) * (raw[its["channel"]] - its.get("offset", 0.0))

    theta = np.stack([channel("theta_a"), channel("theta_b")], axis=-1)
    force = channel("force_x") + 1j * channel("force_y")
    currents = {joint: channel(f"current_{joint.lower()}") for joint in BRAKES[rig["layout"]]}
    step_s = float(np.median(np.diff(raw["time"])))
    return Recording(rig["layout"], step_s, theta, force, currents, fault(raw["time"], step_s, theta, force))


def fault(time_s, step_s, theta, force):
    """Empty cells, a clock that jumps, a force that is clipped, an angle that stands for long while the other one goes on to move."""
    if not all(np.isfinite(x).all() for x in (theta, force.real, force.imag)):
        return "empty cells"
    if np.abs(np.diff(time_s) - step_s).max() > 0.5 * step_s:
        return "clock"
    for part in (force.real, force.imag):
        if max(np.mean(part == part.max()), np.mean(part == part.min())) > 0.005:
            return "clipped force"
    for own, other in [(0, 1), (1, 0)]:
        begins, length = longest_stand(theta[:, own])
        if length > 0.095 * len(theta) and np.ptp(theta[begins : begins + length, other]) > 0.15 * np.ptp(theta[:, other]):
            return "angle that stands"
    return None


def longest_stand(values):
    """Where the longest run of one and the same value begins, and its length."""
    ends = np.concatenate([[-1], np.flatnonzero(np.diff(values)), [len(values) - 1]])
    lengths = np.diff(ends)
    longest = int(np.argmax(lengths))
    return int(ends[longest]) + 1, int(lengths[longest])
