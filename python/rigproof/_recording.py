"""This file turns what Python has, paths, dicts of arrays and frames, into what the compiled part takes."""

from __future__ import annotations

import datetime
import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._errors import Error

# Names that a column of time stamps has, and how many of each unit make a second.
TIMES = ("time_s", "time", "t", "t_s", "timestamp", "timestamp_s", "stamp", "timestamp_ns", "time_ns", "t_ns")
# What the rows of a static sweep are counted as.
SWEPT = "row of the sweep"
SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9}


def taken(recording: Any, units: Mapping[str, str], time: str | None, name: str, is_sweep: bool = False) -> Any:
    """A path as text, or (name, time stamps in s, [(channel, unit, samples)]). The rows of a static sweep are counted."""
    if isinstance(recording, (str, os.PathLike)):
        return os.fspath(recording)
    columns = _columns(recording, name)
    if is_sweep and columns:
        columns = {SWEPT: np.arange(len(next(iter(columns.values()))), dtype=np.float64), **columns}
        time = SWEPT
    time = time or next((own for own in TIMES if own in columns), None)
    if time is None or time not in columns:
        known = ", ".join(map(str, columns))
        raise Error(f"{name}: no column is named {time or 'as a time'}; say which one is, time=..., of: {known}")
    stamps = _stamps(columns.pop(time), units.get(time), time, name)
    channels = []
    for own, samples in columns.items():
        numbers = _numbers(samples, own, name, wanted=own in units)
        if numbers is None:
            continue
        if len(numbers) != len(stamps):
            raise Error(f"{name}: `{own}` has {len(numbers)} samples, `{time}` has {len(stamps)}; give as many of each")
        channels.append((str(own), units.get(own, ""), numbers))
    missing = [own for own in units if own != time and own not in columns]
    if missing:
        raise Error(f"{name}: `{missing[0]}` of units is no column; the columns are {', '.join(map(str, columns))}")
    return (name, stamps, channels)


def _columns(recording: Any, name: str) -> dict[str, Any]:
    """The columns of a dict, or of a frame of pandas or polars; an index of pandas that has a name or holds times is one of them."""
    if isinstance(recording, Mapping):
        return dict(recording)
    if not hasattr(recording, "columns"):
        raise Error(f"{name}: a recording of type {type(recording).__name__} cannot be taken; give a path, a dict of arrays, or a frame")
    columns = {own: recording[own] for own in recording.columns}
    index = getattr(recording, "index", None)
    if index is not None and not any(own in columns for own in TIMES):
        is_time = getattr(index, "dtype", np.dtype(float)).kind in "mM"
        if index.name is not None or is_time:
            columns = {index.name or "time": index.to_numpy(), **columns}
    return columns


def _array(samples: Any) -> np.ndarray[Any, Any]:
    """Anything with one value a sample as an array; no copy where it is one."""
    if isinstance(samples, np.ma.MaskedArray):
        return np.asarray(np.ma.filled(samples.astype(np.float64), np.nan))
    return np.asarray(samples.to_numpy() if hasattr(samples, "to_numpy") else samples)


def _is_missing(value: Any) -> bool:
    """None, nan, and what pandas puts for a missing value, which equals nothing and says neither yes nor no."""
    try:
        return value is None or bool(value != value)
    except TypeError:
        return True


class Seconds:
    """Time stamps as seconds from the first, turned into floats where a part of them is asked for: the whole is not copied."""

    def __init__(self, array: np.ndarray[Any, Any], scale: float) -> None:
        # Dates and durations differ by whole numbers of nanoseconds at the finest.
        self._array = array.astype(f"{array.dtype.kind}8[ns]", copy=False) if array.dtype.kind in "mM" else array
        self._scale = scale

    def __len__(self) -> int:
        return len(self._array)

    def __getitem__(self, part: slice) -> np.ndarray[Any, Any]:
        # Nanoseconds since 1970 have more digits than a float holds: the difference is taken in whole numbers.
        since = self._array[part].astype(np.int64) - self._array[:1].astype(np.int64)
        return np.asarray(since * self._scale, dtype=np.float64)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray[Any, Any]:
        return np.asarray(self[:], dtype=dtype)


def _stamps(samples: Any, unit: str | None, time: str, name: str) -> Any:
    """Time stamps in seconds; dates, durations and whole numbers of large size count from the first."""
    array = _array(samples)
    if array.dtype.kind in "mM":
        if np.isnat(array).any():
            raise Error(f"{name}, line {int(np.isnat(array).argmax()) + 1}: the time stamp is missing; every sample needs one")
        return Seconds(array, 1e-9)
    if array.dtype.kind == "O" and array.size and hasattr(array[0], "utcoffset"):
        missing = next((k for k, own in enumerate(array) if _is_missing(own)), None)
        if missing is not None:
            raise Error(f"{name}, line {missing + 1}: the time stamp is missing; every sample needs one")
        return np.array([(own - array[0]) / datetime.timedelta(seconds=1) for own in array], dtype=np.float64)
    unit = unit or next((own for own in ("ns", "us", "ms") if str(time).endswith(f"_{own}")), None)
    if unit is not None and unit not in SECONDS:
        raise Error(f"{name}: `{unit}` is no unit of time; give one of {', '.join(SECONDS)}")
    if array.dtype.kind in "iu":
        if unit is None and array.size > 1 and abs(int(array[-1]) - int(array[0])) > 10**8:
            raise Error(f"{name}: `{time}` holds whole numbers too large for seconds; say what they are, units={{{time!r}: 'ns'}}")
        return Seconds(array, SECONDS[unit or "s"]) if array.size else array.astype(np.float64)
    numbers = _numbers(array, time, name, wanted=True)
    assert numbers is not None
    return numbers * SECONDS[unit] if unit not in (None, "s") else numbers


def _numbers(samples: Any, own: str, name: str, wanted: bool) -> np.ndarray[Any, Any] | None:
    """Samples as numbers; an array of them as it is, whatever its kind: the compiled part takes it in parts. None for text that nobody asked for."""
    array = _array(samples)
    if array.ndim != 1:
        raise Error(f"{name}: `{own}` has shape {array.shape}; give one value a sample, shape (n,)")
    if array.dtype.kind in "iufb":
        return array
    if array.dtype.kind == "O":
        numbers = np.full(len(array), np.nan)
        for k, value in enumerate(array):
            if _is_missing(value):
                continue
            if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
                if not wanted:
                    return None
                raise Error(f"{name}, line {k + 1} `{own}`: {value!r} is no number; give numbers, and nan where a sample is missing")
            numbers[k] = float(value)
        return numbers
    if wanted:
        raise Error(f"{name}: `{own}` is of type {array.dtype}; give numbers, and nan where a sample is missing")
    return None
