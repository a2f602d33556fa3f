"""This file holds what columns of arrays and frames may be: right, or a clear error; none is copied that is right as it is."""

from __future__ import annotations

import datetime
import os
import subprocess
import sys
from decimal import Decimal

import numpy as np
import pandas as pd
import polars as pl
import pytest
import rigproof
from rigproof._recording import taken

T = np.arange(6) * 0.1
X = np.array([0.5, -1.5, 2.5, 3.5, -4.5, 5.5])
HOLES = np.where(np.arange(6) == 2, np.nan, X)
START = 1_700_000_000_123_456_789


def columns(recording, units=None, time=None) -> dict[str, np.ndarray]:
    _, stamps, channels = taken(recording, units or {}, time, "recording")
    # As the compiled part takes them.
    return {name: own[0 : len(own)].astype("=f8") for name, own in (("t", stamps), *((name, own) for name, _, own in channels))}


@pytest.mark.parametrize(
    "samples",
    [
        X,
        X.astype(object),
        X.astype(">f8"),
        X.astype(np.float32),
        list(X),
        np.column_stack([X, X])[:, 1],
        X[::-1].copy()[::-1],
        [Decimal(str(x)) for x in X],
        pd.Series(X, dtype="Float64"),
        pd.Series(X, dtype="double[pyarrow]"),
        pl.Series(X),
    ],
    ids=["floats", "objects", "big endian", "single", "list", "strided", "reversed", "decimals", "nullable", "arrow", "polars"],
)
def test_a_column_of_numbers_is_taken(samples) -> None:
    found = columns({"t": T, "x": samples})["x"]
    assert found.dtype == np.float64 and found.dtype.isnative and np.array_equal(found, X)


@pytest.mark.parametrize(
    "samples",
    [
        HOLES,
        [None if np.isnan(x) else x for x in HOLES],
        np.ma.masked_invalid(HOLES),
        pd.Series(HOLES, dtype="Float64"),
        pd.Series([pd.NA if np.isnan(x) else x for x in HOLES], dtype=object),
        pd.Series([None if np.isnan(x) else x for x in HOLES], dtype="double[pyarrow]"),
        pl.Series([None if np.isnan(x) else x for x in HOLES]),
    ],
    ids=["nan", "None", "masked", "nullable", "NA", "arrow", "polars null"],
)
def test_a_missing_sample_is_missing(samples) -> None:
    assert np.array_equal(columns({"t": T, "x": samples})["x"], HOLES, equal_nan=True)


@pytest.mark.parametrize(
    "samples",
    [np.array(list("abcdef")), ["a"] * 6, pd.Series(["a"] * 6), pd.Categorical(["a"] * 6), pl.Series(["a"] * 6), pd.to_datetime(["2024-01-01"] * 6), X + 1j],
    ids=["numpy", "list", "pandas", "categories", "polars", "dates", "complex"],
)
def test_a_column_that_is_no_number_is_passed_over_unless_it_is_wanted(samples) -> None:
    assert list(columns({"t": T, "x": X, "note": samples})) == ["t", "x"]
    with pytest.raises(rigproof.Error, match="give numbers"):
        columns({"t": T, "note": samples}, units={"note": "m"})


@pytest.mark.parametrize(
    ("stamps", "units"),
    [
        (START + np.arange(6) * 100_000_000, {"t": "ns"}),
        (np.arange(6) * 100, {"t": "ms"}),
        (np.datetime64(START, "ns") + np.arange(6) * np.timedelta64(100, "ms"), {}),
        (np.arange(6) * np.timedelta64(100, "ms"), {}),
        (pd.Series(pd.to_datetime(START + np.arange(6) * 100_000_000, utc=True)), {}),
        (pl.Series([datetime.datetime(2024, 1, 1) + datetime.timedelta(milliseconds=100 * k) for k in range(6)]), {}),
    ],
    ids=["nanoseconds", "milliseconds", "dates", "durations", "pandas with a zone", "polars"],
)
def test_times_are_seconds_from_the_first(stamps, units) -> None:
    found = columns({"t": stamps, "x": X}, units=units)["t"]
    assert found.dtype == np.float64 and np.allclose(found, T, atol=1e-12)


def test_frames_of_pandas_and_polars_and_an_index_of_times() -> None:
    for frame in (pd.DataFrame({"t": T, "x": X}), pl.DataFrame({"t": T, "x": X}), pd.DataFrame({"x": X}, index=pd.Index(T, name="t"))):
        found = columns(frame)
        assert np.array_equal(found["t"], T) and np.array_equal(found["x"], X)
    found = columns(pd.DataFrame({"x": X}, index=pd.to_datetime(START + np.arange(6) * 100_000_000)))
    assert np.allclose(found["t"], T, atol=1e-12)
    twice = pd.DataFrame(np.column_stack([T, X, X]), columns=["t", "x", "x"])
    with pytest.raises(rigproof.Error, match="`x` has shape"):
        columns(twice)


def test_a_date_that_is_missing_is_said() -> None:
    stamps = pd.Series(pd.to_datetime(START + np.arange(6) * 100_000_000))
    stamps[3] = pd.NaT
    with pytest.raises(rigproof.Error, match="time stamp is missing") as refused:
        columns({"t": stamps, "x": X})
    assert refused.value.line == 4


# What a recording takes beside its arrays while two seconds of it are diagnosed. Once before, a short one is, so that code and threads are there already.
# Arrays above 32 MB are each given back to the system, so that what was freed before is not taken for free memory.
MEASURE = """
import sys, time, numpy as np, rigproof, rigproof._recording
def megabytes(key):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key)) / 1e3
def arrays(n, kind):
    t = np.arange(n) * 1e-3
    x, f, g = np.sin(t), np.cos(t), np.sin(3.0 * t)
    if kind == "kinds":
        t, f, g = np.arange(n) * 1_000_000, np.column_stack([f, f])[:, 1], g.astype(">f8")
    return {"t": t, "x": x, "f": f, "g": g}
n, kind = int(sys.argv[1]), sys.argv[2]
units = {"t": "s" if kind == "floats" else "ns"}
rig = rigproof.Rig.axis(position="x", command="f", inertia=(1.0, "kg"), command_gain=(1.0, "N/N"), motion="linear", position_unit="m", command_unit="N",
    position_keys={"quantum": 1e-9})
rigproof.diagnose(arrays(6000, kind), rig, from_s=1.0, to_s=3.0, units=units)
given = arrays(n, kind)
held = rigproof._recording.taken(given, units, None, "r")
assert kind != "floats" or held[1] is given["t"] and held[2][0][2] is given["x"]
with open("/proc/self/clear_refs", "w") as peak:
    peak.write("5")
before = megabytes("VmRSS:")
begun = time.monotonic()
rigproof.diagnose(given, rig, from_s=1.0, to_s=3.0, units=units)
print((megabytes("VmHWM:") - before) * 1.024e6 / (4 * 8 * n))
print(f"{time.monotonic() - begun:.1f} s", file=sys.stderr)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the peak of memory is read from /proc")
@pytest.mark.parametrize("kind", ["floats", "kinds"])
def test_a_large_recording_is_copied_once_at_the_most(kind: str) -> None:
    samples = os.environ.get("RIGPROOF_LARGE", "5000000")
    done = subprocess.run([sys.executable, "-c", MEASURE, samples, kind], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    copies = float(done.stdout)
    print(f"copies of {int(samples) * 32 / 1e9:.3f} GB of arrays ({kind}) at the most: {copies:.3f}; {done.stderr.strip()}")
    # One, a byte a sample that says what counts, and some megabytes for the diagnosis of two seconds.
    assert 0.9 < copies < 1.0 + 1.0 / 32 + 20e6 / (int(samples) * 32), done.stderr
