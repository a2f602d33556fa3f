"""This file holds the diagnosis from Python to the program's, and to what frames and arrays may be."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pytest
import rigproof
from rigproof import _rigproof
from rigproof._program import program


def drag(report: rigproof.Report) -> float:
    return next(row["value"] for row in report.names if row["mechanism"] == "viscous")


def test_the_report_has_the_same_bytes_as_the_programs(tmp_path: Path) -> None:
    rigproof.blind.make("axis", 48, tmp_path / "case", stratum="masked")
    recording, rig = tmp_path / "case/recording.csv", tmp_path / "case/rig.toml"
    subprocess.run([program(), "diagnose", recording, "--rig", rig, "--out", tmp_path / "by-program"], check=True, capture_output=True)
    report = rigproof.diagnose(recording, rig, out=tmp_path / "by-python")
    names = sorted(file.name for file in (tmp_path / "by-program").iterdir())
    assert "report.json" in names and names == sorted(file.name for file in (tmp_path / "by-python").iterdir())
    for name in ("report.json", "calibration.toml", "before-after.svg"):
        assert (tmp_path / "by-program" / name).read_bytes() == (tmp_path / "by-python" / name).read_bytes(), name
    score = rigproof.blind.score(tmp_path / "case/answer.sealed", tmp_path / "by-python/report.json")
    assert score["score"]["exact"] and report.verdict == json.loads((tmp_path / "by-program/report.json").read_text())["verdict"]


def test_arrays_frames_and_their_kinds_of_columns_give_one_answer(case, rig) -> None:
    plain = rigproof.diagnose(case, rig)
    assert plain.verdict == "explained" and abs(drag(plain) - 3.3) < 0.03
    wide = np.zeros((len(case["t"]), 5))
    wide[:, 3] = case["x"]
    assert not wide[:, 3].flags["C_CONTIGUOUS"]
    start = 1_700_000_000_000_000_000
    nanoseconds = start + np.round(case["t"] * 1e9).astype(np.int64)
    for recording, units in [
        ({**case, "x": wide[:, 3]}, {}),
        ({**case, "x": case["x"].astype(">f8"), "f": case["f"].astype(np.float32)}, {}),
        (pd.DataFrame({**case, "note": ["a"] * len(case["t"]), "x": case["x"].astype(object)}), {}),
        (pl.DataFrame(case), {}),
        ({"t": nanoseconds, "x": case["x"], "f": case["f"]}, {"t": "ns"}),
        (pd.DataFrame({"x": case["x"], "f": case["f"]}, index=pd.to_datetime(nanoseconds)), {}),
        ({**case, "x": case["x"] * 1e3}, {"x": "mm"}),
    ]:
        assert abs(drag(rigproof.diagnose(recording, rig, units=units)) - drag(plain)) < 1e-3


def test_the_rows_of_a_static_sweep_need_no_time() -> None:
    rng = np.random.default_rng(7)
    current = np.tile(np.concatenate([np.linspace(0, 2, 21), np.linspace(2, 0, 21)]), 2)
    torque = 0.1 + 0.5 * current**2 + 0.01 * rng.standard_normal(current.size)
    rig = {
        "name": "brake",
        "plant": "bench",
        "motion": "rotary",
        "channels": {"torque": {"channel": "tau", "unit": "N·m"}, "current": {"channel": "i", "unit": "A"}},
        "characteristic": {"command": {"points": [0, 2], "unit": "A"}, "effort": {"points": [0.1, 2.1], "unit": "N·m"}},
        "protocol": {"drive": "static"},
    }
    report = rigproof.diagnose({"tau": torque, "i": current}, rig, progress=False)
    assert {row["mechanism"] for row in report.names} == {"command_exponent"}
    assert abs(next(row["value"] for row in report.names if row["parameter"] == "exponent") - 2) < 0.1


def test_missing_samples_and_repeated_stamps_are_mended_or_said(case, rig) -> None:
    holes = case["x"].copy()
    holes[1000:1003] = np.nan
    assert abs(drag(rigproof.diagnose({**case, "x": holes}, rig)) - 3.3) < 0.05
    twice = case["t"].copy()
    twice[2000] = twice[1999]
    report = rigproof.diagnose({**case, "t": twice}, rig)
    assert any("repeated" in line for line in report.json["protocol"]), report.json["protocol"]
    back = case["t"].copy()
    back[2000] = back[1990]
    with pytest.raises(rigproof.Error, match="goes backward") as refused:
        rigproof.diagnose({**case, "t": back}, rig)
    assert refused.value.line == 2001 and refused.value.hint
    with pytest.raises(rigproof.Error, match="time stamp is missing"):
        rigproof.diagnose({**case, "t": holes}, rig)


def test_what_cannot_be_taken_is_said_with_what_to_do(case, rig, tmp_path: Path) -> None:
    for recording, units, words in [
        ({**case, "x": case["x"][:-1]}, {}, "5999 samples"),
        ({**case, "x": ["a"] * 6000}, {"x": "m"}, "give numbers"),
        ({**case, "x": case["x"].reshape(-1, 2)}, {}, "shape"),
        ({"x": case["x"], "f": case["f"]}, {}, "time=..."),
        ({"t": np.arange(6000) * 10**6, "x": case["x"], "f": case["f"]}, {}, "'ns'"),
        ({"t": case["t"], "x": case["x"]}, {}, "`f`"),
        (7, {}, "type int"),
        ([], {}, "empty"),
    ]:
        with pytest.raises(rigproof.Error) as refused:
            rigproof.diagnose(recording, rig, units=units)
        assert words in str(refused.value)
    file = tmp_path / "rig.toml"
    file.write_text('name = "a"\nplant = "axes"\n')
    with pytest.raises(rigproof.Error) as refused:
        rigproof.diagnose(case, file)
    assert (refused.value.file, refused.value.line, refused.value.column) == (str(file), 2, 9)


def test_a_report_draws_saves_and_shows_itself(case, rig, tmp_path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    report = rigproof.diagnose(case, rig, hold_out=0.3)
    assert len(report.plot().lines) == 3 and "viscous" in report._repr_html_()
    assert (report.save(tmp_path / "found") / "report.html").stat().st_size > 10_000
    held = next(row for row in report.before_after if row["part"] == "held_out")
    assert held["after"] < 0.1 * held["before"] and len(report.names.frame()) == len(report.names)
    assert report.calibration and "viscous" in report.calibration


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_ctrl_c_returns_at_once_and_other_threads_run_meanwhile(tmp_path: Path) -> None:
    rigproof.blind.make("axis", 48, tmp_path / "case", stratum="masked")
    # Whoever started the tests in the background may have had the signal ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    beats: list[float] = []
    stop = threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT))
    stop.start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        # Long enough that it is not done before the signal.
        rigproof.diagnose(tmp_path / "case/recording.csv", tmp_path / "case/rig.toml", progress=beats.append, calibrate=50)
    assert time.monotonic() - begun < 2.0 and beats
    # The thread that computes ends too, long before fifty simulated recordings would be done.
    while _rigproof.working() > 0:
        assert time.monotonic() - begun < 60.0
        time.sleep(0.05)
