"""This file is what a diagnosis found, as Python objects."""

from __future__ import annotations

import html
import json
import os
import shutil
from pathlib import Path
from typing import Any

Row = dict[str, Any]


class Names(list[Row]):
    """Rows of a small table: a list of dicts, and `.frame()` of pandas."""

    def frame(self) -> Any:
        """The rows as a frame of pandas."""
        import pandas

        return pandas.DataFrame(list(self))


class Report:
    """What a diagnosis found; `.json` is all of report.json, in SI units unless a unit stands beside a number."""

    def __init__(self, folder: str, curves: dict[str, Any], keep: Any = None) -> None:
        self.folder = Path(folder)
        self.curves = curves
        self._keep = keep
        self.json: dict[str, Any] = json.loads((self.folder / "report.json").read_text(encoding="utf-8"))

    @property
    def verdict(self) -> str:
        """`consistent`, `explained`, `partly_explained`, `ambiguous`, `none_of_library`, `not_excited` or `data_fault`."""
        return str(self.json["verdict"])

    @property
    def summary(self) -> str:
        """The verdict in one sentence."""
        return str(self.json["summary"])

    @property
    def names(self) -> Names:
        """A row for each parameter of each named mechanism: mechanism, where, scope, probability, parameter, value, low95, high95, unit."""
        rows = Names()
        for effect in self.json["effects"]:
            head = {
                "mechanism": effect["mechanism"],
                "where": effect.get("at") or effect.get("joint") or "whole",
                "scope": effect.get("scales") or "absolute",
                "probability": effect.get("probability"),
            }
            numbers = effect["parameters"] or {None: {}}
            for parameter, number in numbers.items():
                rows.append({**head, "parameter": parameter, **{key: number.get(key) for key in ("value", "low95", "high95", "unit")}})
        return rows

    @property
    def explanations(self) -> Names:
        """The explanations that were weighed, the most probable first: names, probability, leaves (standard deviations of the sensors' noise)."""
        return Names(self.json["explanations"])

    @property
    def located(self) -> Names:
        """Where the unexplained energy is: regime, share, its 95 % interval, share of time, and what is left."""
        return Names(self.json["located"])

    @property
    def joints(self) -> Names:
        """An arm's joints: joint, effort left over before and after (root mean square, held out), unit, share of it before; none on other plants."""
        arm = self.json["arm"] or {"joints": []}
        return Names({key: own[key] for key in ("joint", "before", "after", "unit", "share")} for own in arm["joints"])

    @property
    def remaining(self) -> Row:
        """What is left: `floor` (residual against noise), `unknown` (its shape, or None)."""
        return {key: self.json[key] for key in ("floor", "unknown")}

    @property
    def before_after(self) -> Names:
        """Errors before and after, a row each: part, horizon_s (None for the whole part), before, after, unit; none where nothing was fitted."""
        fit = self.json["fit"]
        if fit is None:
            return Names()
        rows = Names()
        for part in ("train", "held_out"):
            if fit[part] is not None:
                rows.append({"part": part, "horizon_s": None, "before": fit[part]["before"], "after": fit[part]["after"], "unit": fit["unit"]})
        for own in fit["horizon"]:
            rows.append({key: own[key] for key in ("part", "horizon_s", "before", "after", "unit")})
        return rows

    @property
    def next_experiment(self) -> Row | None:
        """What would tell rival explanations apart; None where there is none."""
        found: Row | None = self.json["next_experiment"]
        return found

    @property
    def calibration(self) -> str | None:
        """The rig description with what was found, as TOML; None where nothing was fitted."""
        file = self.folder / "calibration.toml"
        return file.read_text(encoding="utf-8") if file.exists() else None

    @property
    def urdf(self) -> str | None:
        """An arm's URDF with what was found, as text; None for other plants and where nothing was fitted."""
        file = self.folder / "calibrated.urdf"
        return file.read_text(encoding="utf-8") if file.exists() else None

    def plot(self, axes: Any = None) -> Any:
        """Draws recorded, old and new model over the held-out part (matplotlib); gives the axes."""
        import matplotlib.pyplot as plt

        axes = axes if axes is not None else plt.subplots(figsize=(8, 3))[1]
        for key, label, style in (("recorded", "recorded", "k"), ("before", "old model", "C1--"), ("after", "new model", "C0")):
            axes.plot(self.curves["time_s"], self.curves[key], style, label=label, linewidth=1)
        axes.set_xlabel("time [s]")
        axes.set_ylabel(f"{self.curves['output']} [{self.curves['unit']}]")
        axes.legend(loc="best")
        return axes

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Writes what the program writes: report.json, report.html, calibration.toml and pictures. The folder must not be there."""
        return Path(shutil.copytree(self.folder, folder))

    def __repr__(self) -> str:
        return f"<rigproof.Report {self.verdict}: {self.summary}>"

    def _repr_html_(self) -> str:
        said = html.escape
        body = ""
        for row in self.names:
            cells = (row["mechanism"], row["where"], row["parameter"], _short(row["value"]), _interval(row), row["unit"], _short(row["probability"]))
            body += "<tr>" + "".join(f"<td>{said(str(cell if cell is not None else ''))}</td>" for cell in cells) + "</tr>"
        head = "".join(f"<th>{name}</th>" for name in ("mechanism", "where", "parameter", "value", "95 %", "unit", "probability"))
        table = f"<table><tr>{head}</tr>{body}</table>" if body else ""
        return f"<div><b>{said(self.verdict.replace('_', ' '))}</b><p>{said(self.summary)}</p>{table}</div>"


def _short(number: Any) -> str:
    return f"{number:.3g}" if isinstance(number, (int, float)) else ""


def _interval(row: Row) -> str:
    return "" if row["low95"] is None else f"{_short(row['low95'])} to {_short(row['high95'])}"
