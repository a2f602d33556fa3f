"""This file says what a report.json found as Markdown, for a comment on a change: python summary.py report.json"""

import json
import sys
from typing import Any


def markdown(report: dict[str, Any]) -> str:
    """The verdict, the names with their numbers, and before and after."""
    lines = [f"### rigproof: {report['verdict'].replace('_', ' ')}", "", report["summary"], ""]
    if report["effects"]:
        lines += ["| mechanism | where | number | 95 % |", "|---|---|---|---|"]
    for effect in report["effects"]:
        for name, number in effect["parameters"].items():
            interval = "" if number["low95"] is None else f"{number['low95']:.3g} to {number['high95']:.3g}"
            where = effect["joint"] or "whole"
            lines.append(f"| {effect['mechanism']} | {where} | {name} {number['value']:.3g} {number['unit']} | {interval} |")
    held = report["fit"] and report["fit"]["held_out"]
    if held:
        lines += ["", f"Error on the held-out part: {held['before']:.3g} before, {held['after']:.3g} {report['fit']['unit']} after."]
    return "\n".join(lines)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        print(markdown(json.load(file)))
