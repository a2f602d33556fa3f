"""This file runs what the example of a workflow runs."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
import rigproof
from rigproof._program import program

ACTION = Path(__file__).parent.parent / "action"


def test_the_summary_says_verdict_names_and_before_and_after(case, rig, tmp_path: Path) -> None:
    report = rigproof.diagnose(case, rig, out=tmp_path / "found")
    words = [sys.executable, ACTION / "summary.py", tmp_path / "found/report.json"]
    said = subprocess.run(words, check=True, capture_output=True, text=True, encoding="utf-8").stdout
    assert said.startswith(f"### rigproof: {report.verdict}") and "| viscous | whole | coefficient 3.3 N·s/m |" in said and "before" in said


@pytest.mark.parametrize("verb", ["diagnose", "certify"])
def test_the_program_knows_every_option_of_the_workflow(verb: str) -> None:
    line = next(line for line in (ACTION / "diagnose.yml").read_text().splitlines() if f"rigproof {verb}" in line)
    options = re.findall(r"--[a-z-]+", line)
    said = subprocess.run([program(), verb, "--help"], check=True, capture_output=True, text=True).stdout
    assert options and all(option in said for option in options)
