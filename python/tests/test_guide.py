"""This file runs the Python of the guide, and holds the demo to it."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
from rigproof._program import program

GUIDE = Path(__file__).parent.parent.parent / "docs/guide/src"


def test_five_lines_give_the_report_of_the_demo(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (lines,) = re.findall(r"```python\n(.*?)```", (GUIDE / "python.md").read_text(encoding="utf-8"), re.S)
    assert len(lines.splitlines()) == 5 and all(re.findall("```python", page.read_text()) == [] for page in GUIDE.glob("*.md") if page.name != "python.md")
    monkeypatch.chdir(tmp_path)
    exec(compile(lines, "python.md", "exec"), {})
    subprocess.run([program(), "demo", "--out", "demo"], check=True, capture_output=True)

    def report(folder: str) -> dict[str, Any]:
        own = json.loads((tmp_path / folder / "report.json").read_text(encoding="utf-8"))
        # The demo's recording is in memory before it is in a file: how the file was read stands in the other alone.
        assert [Path(own.pop("path")).name for own in own["inputs"]] == ["recording.csv", "rig.toml"]
        for one in own["inputs"]:
            one.pop("read_as", None)
        own["protocol"] = [line for line in own["protocol"] if "recording.csv" not in line]
        return own

    assert report("found") == report("demo")
