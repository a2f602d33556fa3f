"""This file holds readers, MuJoCo and the types to what they say."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import rigproof


def test_npz_parquet_and_bam_read_back(tmp_path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    t, q = np.arange(30) * 0.01, np.arange(60.0).reshape(30, 2)
    np.savez(tmp_path / "run.npz", t=t, q=q)
    assert np.array_equal(rigproof.read(tmp_path / "run.npz", channels=["q[1]"])["q[1]"], q[:, 1])
    table = pa.table({"timestamp": t, "action": list(q), "episode_index": [3] * 20 + [4] * 10})
    pq.write_table(table, tmp_path / "run.parquet")
    read = rigproof.read(tmp_path / "run.parquet", channels=["action[0]"])
    assert np.array_equal(read["t"], t[:20]) and np.array_equal(read["action[0]"], q[:20, 0])
    entries = [{"position": 0.1, "goal_position": 0.1 + 3.0 * k, "timestamp": 7.0 + 0.5 * k} for k in range(2)]
    (tmp_path / "run.json").write_text(json.dumps({"kp": 200, "entries": entries}))
    read = rigproof.read(tmp_path / "run.json")
    assert list(read["t"]) == [0.0, 0.5] and list(read["duty"]) == [0.0, 1.0]
    with pytest.raises(rigproof.Error, match="is not in it"):
        rigproof.read(tmp_path / "run.npz", channels=["p"])
    with pytest.raises(rigproof.Error, match="no reader"):
        rigproof.read(tmp_path / "run.xyz")


def test_a_servo_bench_of_others_reads() -> None:
    folder = Path(os.environ.get("RIGPROOF_DATA", "absent")) / "bam_xl330"
    files = sorted(folder.glob("*.json"))
    if not files:
        pytest.skip("the recordings of BAM are absent")
    read = rigproof.read(files[0])
    assert read["t"][0] == 0.0 and 5.0 < read["t"][-1] < 7.0 and np.ptp(read["position"]) > 0.5


def test_mujoco_fits_better_with_what_was_found(case, rig) -> None:
    mujoco = pytest.importorskip("mujoco")
    import rigproof.mujoco as own

    xml = """<mujoco><option gravity="0 0 0" timestep="0.0005"/><worldbody><body><joint name="slide" type="slide" axis="1 0 0"/>
    <geom type="sphere" size="0.1" mass="0.5"/></body></worldbody><actuator><motor joint="slide"/></actuator></mujoco>"""
    report = rigproof.diagnose(case, rig)
    model = mujoco.MjModel.from_xml_string(xml)
    own.apply(rig, model)
    held = slice(4500, None)
    part = [case[key][held] for key in ("t", "x", "f")]
    before = own.replay(model, *part)["rms"]
    done = own.apply(report, model)
    after = own.replay(model, *part)["rms"]
    assert not done["not_held"] and abs(model.dof_damping[0] - 3.3) < 0.03 and abs(model.dof_armature[0] - 1.6) < 0.02
    assert after < 0.05 * before, (before, after)


def test_the_types_hold() -> None:
    room = Path(__file__).parent.parent
    words = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--cache-dir", os.devnull, "-p", "rigproof"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=room)
    assert done.returncode == 0, done.stdout
