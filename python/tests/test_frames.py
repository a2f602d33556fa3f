"""This file holds what columns of arrays and frames may be: right, or a clear error; none is copied that is right as it is."""

from __future__ import annotations

import datetime
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
    return {"t": stamps, **{name: samples for name, _, samples in channels}}


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


# What a large recording takes beside its arrays while it is handed over: once as it is, and once in SI units.
MEASURE = """
import resource, sys, threading, time, numpy as np, rigproof, rigproof._recording
n = int(sys.argv[1])
t = np.arange(n) * 1e-3
x, f, g = np.sin(t), np.cos(t), np.sin(3.0 * t)
given = {"t": t, "x": x, "f": f, "g": g}
held = rigproof._recording.taken(given, {}, None, "r")
assert held[1] is t and held[2][0][2] is x
rig = rigproof.Rig.axis(position="x", command="f", inertia=(1.0, "kg"), command_gain=(1.0, "N/N"), motion="linear", position_unit="m", command_unit="N")
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    rigproof.diagnose(given, rig, from_s=1e9)
except rigproof.Error as error:
    print(error, file=sys.stderr)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / (4 * 8 * n))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the unit of ru_maxrss")
def test_a_large_recording_is_copied_twice_at_the_most() -> None:
    done = subprocess.run([sys.executable, "-c", MEASURE, "4000000"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    print(f"copies of 128 MB of arrays at the most: {float(done.stdout):.2f}; {done.stderr.strip()}")
    assert float(done.stdout) < 2.3, done.stderr
