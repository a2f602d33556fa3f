"""This file holds the schema of a rig description to the reader: what the tool writes passes both, and what one refuses the other does too."""

from __future__ import annotations

import copy
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import rigproof
from rigproof._program import program

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

jsonschema = pytest.importorskip("jsonschema")

ROOT = Path(__file__).parent.parent.parent
RIGS = ROOT / "rigs"
LINE = "#:schema rig.schema.json\n"

# Descriptions with every table and every kind of key.
AXIS = """
name = "all of an axis"
plant = "axis"
motion = "rotary"
source = "a test"
[channels]
time = { channel = "t", unit = "ms" }
position = { channel = "q", unit = "deg", column_unit = "rad", offset = 0.3, scale = 1.7, sign = -1, quantum = 0.01, noise = 0.02, limit = 90.5 }
command = { channel = "goal", unit = "rad" }
enabled = { channel = "on", unit = "1" }
[text]
separator = ";"
decimal = ","
header_lines = 2
[parameters]
inertia = { value = 0.0068, unit = "kg·m^2", status = "uncertain", sd = 0.0003, low95 = 0.006, high95 = 0.0075 }
command_gain = { value = 0.11, unit = "N·m/V" }
[servo]
gain = 4.2
supply_v = 7.4
dead_band = 0.01
back_emf = 0.386
[[recording]]
file = "one.csv"
gain = 8.5
[[effect]]
mechanism = "stribeck"
peak = { value = 0.13, unit = "N·m", status = "unknown" }
speed = { value = 0.4, unit = "rad/s" }
exponent = { value = 1.9, unit = "1" }
travel = { value = 0.02, unit = "rad" }
onset = { value = 3.5, unit = "s" }
[protocol]
drive = "straight"
start_samples = 20
substeps = 2
warm_up_periods = 0
[provenance]
fit = "weighted windows"
"""
BENCH = """
name = "all of a bench"
plant = "bench"
motion = "rotary"
[channels]
position = { channel = "q", unit = "rad" }
torque = { channel = "f", unit = "N·m" }
current = { channel = "i", unit = "A" }
simulated = { channel = "s", unit = "N·m" }
[brake]
joint = "E"
backlash_width = { value = 0.01, unit = "rad" }
"""


def written(folder: Path) -> dict[str, str]:
    """What the tool writes, by where it comes from."""

    def run(*words: str) -> None:
        subprocess.run([program(), *words], check=True, capture_output=True, cwd=folder)

    for plant in ("axis", "bench", "rig"):
        run("new", plant, "--plant", plant)
    run("blind", "make", "--plant", "axis", "--seed", "5", "--forms", "other", "--out", "forms")
    run("inspect", "bench/recording.csv", "--write-rig", "begun.toml")
    run("diagnose", "bench/recording.csv", "--rig", "bench/rig.toml", "--out", "found")
    for laid in ("rig.schema.json", "axis/rig.schema.json"):
        assert (folder / laid).read_bytes() == (ROOT / "docs/rig.schema.json").read_bytes()
    names = ("axis/rig.toml", "bench/rig.toml", "rig/rig.toml", "forms/rig.toml", "begun.toml", "found/calibration.toml")
    texts = {name: (folder / name).read_text(encoding="utf-8") for name in names}
    assert all(text.startswith(LINE) for text in texts.values())
    return texts


def kept() -> dict[str, str]:
    """The descriptions of the project, and those that hold everything."""
    texts = {file.name: file.read_text(encoding="utf-8") for file in RIGS.glob("*.toml")}
    assert len(texts) > 5 and all(text.startswith("#:schema ../docs/rig.schema.json\n") for text in texts.values())
    return {**texts, "axis": AXIS, "bench": BENCH}


def tables(value: Any, at: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if isinstance(value, dict):
        yield at
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, own in inner:
        yield from tables(own, (*at, key))


def at(keys: Any, place: tuple[Any, ...]) -> Any:
    for key in place:
        keys = keys[key]
    return keys


def spoilt(keys: dict[str, Any]) -> Iterator[tuple[str, tuple[Any, ...], dict[str, Any]]]:
    """A description with a key more, a key less, or a key of another kind, in every table and at every key."""
    for place in tables(keys):
        if place[-1:] == ("provenance",):
            continue
        changed = copy.deepcopy(keys)
        at(changed, place)["zzz"] = 1
        yield "more", place, changed
        for key in at(keys, place):
            for how in ("less", "other"):
                changed = copy.deepcopy(keys)
                if how == "less":
                    del at(changed, place)[key]
                else:
                    at(changed, place)[key] = True
                yield how, (*place, key), changed


def test_every_description_passes_and_what_is_spoilt_in_it_is_refused_by_both(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    schema = json.loads((ROOT / "docs/rig.schema.json").read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    validator.check_schema(schema)
    (tmp_path / "short.csv").write_text("t,x\n0,1\n")
    for model in RIGS.glob("*.urdf"):
        (tmp_path / model.name).write_bytes(model.read_bytes())
    # Descriptions of arms name their URDF without a folder.
    monkeypatch.chdir(tmp_path)

    def refusal(keys: dict[str, Any]) -> str | None:
        """What the reader says of a description; of a right one it comes as far as the recording, which is too short."""
        with pytest.raises(rigproof.Error) as refused:
            rigproof.diagnose("short.csv", keys, progress=False)
        said = str(refused.value)
        return None if said.startswith("short.csv") else said

    jobs = []
    for name, text in {**kept(), **written(tmp_path)}.items():
        keys = tomllib.loads(text)
        assert [error.message for error in validator.iter_errors(keys)] == [], name
        assert refusal(keys) is None, name
        jobs += [(name, *own) for own in spoilt(keys)]

    def disagreement(name: str, how: str, place: tuple[Any, ...], keys: dict[str, Any]) -> tuple[bool, str | None]:
        passes, said = validator.is_valid(keys), refusal(keys)
        # The reader knows more than shapes, such as what goes together; but a key that is missing is a shape.
        agree = (said is None or (how == "less" and "missing" not in said)) if passes else said is not None
        return passes, None if agree else f"{name}: {how} {place}: the schema {'passes' if passes else 'refuses'} it, the reader says {said}"

    done = [disagreement(*job) for job in jobs]
    assert [why for _, why in done if why] == []
    assert sum(not passes for passes, _ in done) > 500
