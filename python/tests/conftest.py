"""This file makes the recording that the tests share: an axis with hidden viscous drag, exact but for the counts of its encoder."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import rigproof


@pytest.fixture(scope="session")
def case() -> dict[str, Any]:
    mass, drag, step = 2.1, 3.3, 1e-3
    decay = np.exp(-drag * step / mass)
    t = np.arange(6000) * step
    f = 4.1 * np.sin(3.1 * t) + 2.3 * np.sin(11.3 * t)
    x, v, position = 0.0, 0.0, []
    for force in f:
        position.append(round(x / 1e-7) * 1e-7)
        limit = force / drag
        x, v = x + limit * step + (v - limit) * (1 - decay) * mass / drag, limit + (v - limit) * decay
    return {"t": t, "x": np.array(position), "f": f}


@pytest.fixture(scope="session")
def rig() -> rigproof.Rig:
    return rigproof.Rig.from_dict(
        {
            "name": "slide",
            "plant": "axis",
            "motion": "linear",
            "channels": {"position": {"channel": "x", "unit": "m", "quantum": 1e-7}, "command": {"channel": "f", "unit": "N", "noise": 1e-6}},
            "parameters": {"inertia": {"value": 2.1, "unit": "kg"}, "command_gain": {"value": 1.0, "unit": "N/N"}},
            "protocol": {"drive": "held"},
        }
    )
