"""This file diagnoses: what the program's verb of that name does, from files or from arrays."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _rigproof
from ._errors import Error
from ._recording import taken
from ._report import Report
from ._rig import Rig


def diagnose(
    recording: Any,
    rig: Any,
    hold_out: Any = None,
    progress: bool | Callable[[float], object] = True,
    *,
    units: Mapping[str, str] | None = None,
    time: str | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    calibrate: int | None = None,
    jobs: int = 0,
    out: str | os.PathLike[str] | None = None,
) -> Report:
    """Finds out why a recording disagrees with its rig's model.

    recording: a path (CSV, MCAP, or a folder of them), a dict of arrays of shape (n,), a frame of pandas or polars, or a list of these, which are diagnosed
    together; each may be a pair with its settings, (recording, {"gain": 8.5}), the gain of the position servo in it. rig: a path, a dict, or a Rig. hold_out: another recording, or the share (0.05 to 0.8) of the end on which the result is shown; 0.25 where it is
    None. units: the unit of each column of arrays, such as {"q": "deg"}; where it says nothing the rig's own counts. time: the column of time stamps; `time`,
    `t`, `timestamp` and the like are found; the rows of a static sweep need none. Whole numbers, such as nanoseconds, count from the first. from_s, to_s: what lies between these stamps counts.
    calibrate: so many simulated recordings say what the result is worth. jobs: 0 takes every processor; the result does not depend on it. progress: True shows
    what is worked on and the seconds, on a terminal and in a notebook; a callable is called with the seconds. out: the folder to write; a temporary one where it is None.

    Raises rigproof.Error where an input is not usable. Ctrl-C raises KeyboardInterrupt at once and ends the work; nothing is written then.
    """
    several: Sequence[Any] = recording if isinstance(recording, (list, tuple)) and not _is_set(recording) else [recording]
    if not several:
        raise Error("recording: the list is empty; give at least one recording")
    many = len(several) > 1
    settings: list[tuple[str, Mapping[str, float]]] = []
    described = Rig.of(rig)

    def of(one: Any, name: str) -> Any:
        one, own = one if _is_set(one) else (one, {})
        given = taken(one, units or {}, time, name, described.is_sweep)
        if own:
            settings.append((os.path.basename(given) if isinstance(given, str) else name, own))
        return given

    given = [of(one, f"recording {k + 1}" if many else "recording") for k, one in enumerate(several)]
    is_share = isinstance(hold_out, (int, float)) and not isinstance(hold_out, bool)
    held_out = None if hold_out is None or is_share else of(hold_out, "hold_out")
    scratch = None
    if out is None:
        scratch = tempfile.TemporaryDirectory(prefix="rigproof-", ignore_cleanup_errors=True)
        out = os.path.join(scratch.name, "diagnosis")
    tick = _telling(progress)
    try:
        curves = _rigproof.diagnose(
            given,
            described.given(settings),
            os.fspath(out),
            held_out=held_out,
            hold_out_share=float(hold_out) if is_share else None,
            from_s=from_s,
            to_s=to_s,
            calibrate=calibrate,
            jobs=jobs,
            tick=tick,
        )
    except ValueError as error:
        raise Error(str(error)) from None
    finally:
        if tick is _shown:
            sys.stderr.write("\r" + " " * 60 + "\r")
    arrays = {key: np.frombuffer(own) if isinstance(own, bytes) else own for key, own in curves.items()}
    return Report(os.fspath(out), arrays, scratch)


def _is_set(one: Any) -> bool:
    """Whether it is a recording with its settings."""
    return isinstance(one, tuple) and len(one) == 2 and isinstance(one[1], Mapping) and set(one[1]) == {"gain"}


def _telling(progress: bool | Callable[[float], object]) -> Callable[[float, str], object] | None:
    """What is called while the work goes on."""
    if callable(progress):
        own = progress
        return lambda seconds, doing: own(seconds)
    return _shown if progress and (sys.stderr.isatty() or "ipykernel" in sys.modules) else None


def _shown(seconds: float, doing: str) -> None:
    # What is longer than this line is wiped by the one that follows it.
    sys.stderr.write(f"\r{doing or 'diagnosing'}, {seconds:.0f} s".ljust(60))
    sys.stderr.flush()
