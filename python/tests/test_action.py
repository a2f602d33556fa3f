"""This file runs what the examples of a workflow and of hooks run, and what makes a release."""

from __future__ import annotations

import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest
import rigproof
from rigproof._program import program

ROOM = Path(__file__).parent.parent
ACTION = ROOM / "action"
SOUND = '[controller]\nnamed = "sdof_with_gap"\n[baseline]\nnamed = "proportional_low"\n'


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


def steps(job: str) -> list[str]:
    """The commands of a job of the workflow, in their order."""
    jobs = re.split(r"^  (\w+):\n", (ACTION / "diagnose.yml").read_text().partition("jobs:\n")[2], flags=re.M)
    own = dict(zip(jobs[1::2], jobs[2::2]))[job]
    # Fewer trials than a repository would run.
    put = {"${{ github.event.number }}": "7", "--scenarios 200": "--scenarios 24 --seconds 1"}
    return [re.sub("|".join(map(re.escape, put)), lambda found: put[found[0]], line) for line in re.findall(r"^ *- run: (.*)$", own, re.M)]


def workflow(job: str, folder: Path) -> list[int]:
    """Runs a job as its machine does, each step in a shell of its own until one fails; `pip` and `gh`, which reach out, say what they were asked for."""
    stubs = folder / "stubs"
    stubs.mkdir(exist_ok=True)
    for name in ("pip", "gh"):
        (stubs / name).write_text(f'#!/bin/sh\necho "{name} $*" >> calls\n')
        (stubs / name).chmod(0o755)
    path = os.pathsep.join([str(stubs), str(Path(sys.executable).parent), str(Path(program()).parent), os.environ["PATH"]])
    given = {**os.environ, "PATH": path, "RIG": "rig.toml", "RECORDING": "recording.csv", "RIGPROOF_CLONE": str(ROOM.parent)}
    codes: list[int] = []
    for step in steps(job):
        codes.append(subprocess.run(["bash", "-e", "-c", step], cwd=folder, env=given, capture_output=True).returncode)
        if codes[-1] != 0:
            break
    return codes


def write(case, rig, folder: Path) -> None:
    rows = (f"{t!r},{x!r},{f!r}" for t, x, f in zip(*(case[key][:3000].tolist() for key in ("t", "x", "f"))))
    (folder / "recording.csv").write_text("t (s),x (m),f (N)\n" + "\n".join(rows) + "\n")
    rig.write(folder / "rig.toml")


@pytest.mark.skipif(os.name == "nt", reason="the workflow is for bash")
def test_the_workflow_comments_a_diagnosis_and_refuses_a_controller(case, rig, tmp_path: Path) -> None:
    write(case, rig, tmp_path)
    assert workflow("diagnose", tmp_path) == [0, 0, 0, 0]
    assert "| viscous | whole | coefficient 3.3 N·s/m |" in (tmp_path / "summary.md").read_text(encoding="utf-8")
    assert (tmp_path / "calls").read_text() == f"pip install {ROOM}\ngh pr comment 7 --body-file summary.md\n"
    # A recording at fault is a result too, and is commented; one that cannot be read stops the job.
    still = (tmp_path / "recording.csv").read_text().splitlines()
    (tmp_path / "recording.csv").write_text("\n".join([still[0], *(line.split(",")[0] + ",0.5,0.25" for line in still[1:])]) + "\n")
    assert workflow("diagnose", tmp_path) == [0, 0, 0, 0] and "gh" in (tmp_path / "calls").read_text()
    assert "viscous" not in (tmp_path / "summary.md").read_text(encoding="utf-8")
    (tmp_path / "recording.csv").write_text("nothing\n")
    codes = workflow("diagnose", tmp_path)
    assert len(codes) == 2 and codes[1] != 0
    (tmp_path / "certify.toml").write_text(SOUND)
    assert workflow("certify", tmp_path) == [0, 0]
    (tmp_path / "certify.toml").write_text(SOUND + "[limits]\nswitching_per_s = 0.5\n")
    shutil.rmtree(tmp_path / "certified")
    assert workflow("certify", tmp_path) == [0, 1]


def hook(name: str, folder: Path) -> int:
    """The exit code of a hook of the example, in a folder."""
    text = (ACTION / "pre-commit-config.yaml").read_text()
    entry = re.search(rf"- id: {name}\n(?:.*\n)*?\s+entry: (.*)\n", text)
    assert entry
    path = f"{Path(program()).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(shlex.split(entry[1]), cwd=folder, capture_output=True, env={**os.environ, "PATH": path}).returncode


@pytest.mark.skipif(os.name == "nt", reason="the hooks are for bash")
def test_a_hook_passes_what_is_sound_and_stops_what_is_not(case, rig, tmp_path: Path) -> None:
    write(case, rig, tmp_path)
    (tmp_path / "certify.toml").write_text(SOUND)
    assert hook("rig", tmp_path) == 0 and hook("controller", tmp_path) == 0
    (tmp_path / "rig.toml").write_text(rig.text.replace('"x"', '"y"'))
    (tmp_path / "certify.toml").write_text(SOUND + "[limits]\nswitching_per_s = 0.5\n")
    assert hook("rig", tmp_path) == 1 and hook("controller", tmp_path) == 1


def test_a_release_holds_the_program_and_its_sums(tmp_path: Path) -> None:
    words = [sys.executable, ROOM / "build/release.py", "--program", program()]
    for folder in ("one", "two"):
        subprocess.run([*words, tmp_path / folder], check=True, capture_output=True)
    (made,) = (tmp_path / "one").glob("*.tar.gz")
    assert made.read_bytes() == (tmp_path / "two" / made.name).read_bytes()
    assert (tmp_path / "one/SHA256SUMS").read_text() == f"{hashlib.sha256(made.read_bytes()).hexdigest()}  {made.name}\n"
    with tarfile.open(made) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        assert {"rigproof", "LICENSE-MIT", "README.md", "man/rigproof.1", "completions/rigproof.bash"} <= names
        archive.extractall(tmp_path / "out", filter="data")
    (unpacked,) = (tmp_path / "out").iterdir()
    assert subprocess.run([unpacked / "rigproof", "--version"], capture_output=True, text=True).stdout.startswith("rigproof ")
