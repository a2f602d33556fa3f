"""This file writes files as robots and loggers do, with the libraries that are kept for them, and reads them back."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
import rigproof

T = np.arange(40) * 0.01
Q = np.column_stack([np.sin(7.0 * T), np.cos(7.0 * T)])


def test_npz_parquet_and_bam_read_back(tmp_path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    np.savez(tmp_path / "run.npz", t=T, q=Q)
    assert np.array_equal(rigproof.read(tmp_path / "run.npz", channels=["q[1]"])["q[1]"], Q[:, 1])
    table = pa.table({"timestamp": T, "action": list(Q), "episode_index": [3] * 25 + [4] * 15})
    pq.write_table(table, tmp_path / "run.parquet")
    read = rigproof.read(tmp_path / "run.parquet", channels=["action[0]"])
    assert np.array_equal(read["t"], T[:25]) and np.array_equal(read["action[0]"], Q[:25, 0])
    entries = [{"position": 0.1, "goal_position": 0.1 + 3.0 * k, "timestamp": 7.0 + 0.5 * k} for k in range(2)]
    (tmp_path / "run.json").write_text(json.dumps({"kp": 200, "entries": entries}))
    read = rigproof.read(tmp_path / "run.json")
    assert list(read["t"]) == [0.0, 0.5] and list(read["duty"]) == [0.0, 1.0]
    with pytest.raises(rigproof.Error, match="is not in it"):
        rigproof.read(tmp_path / "run.npz", channels=["p"])
    with pytest.raises(rigproof.Error, match="no reader"):
        rigproof.read(tmp_path / "run.xyz")


def test_a_folder_of_lerobot_gives_its_first_episode(tmp_path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    for part in ("meta", "data/chunk-000"):
        (tmp_path / part).mkdir(parents=True)
    (tmp_path / "meta/info.json").write_text(json.dumps({"codebase_version": "v3.0", "fps": 100}))
    state = pa.array(list(Q), type=pa.list_(pa.float64(), 2))
    columns = {"timestamp": T.astype(np.float32), "observation.state": state, "episode_index": [0] * 30 + [1] * 10, "task_index": [0] * 40}
    pq.write_table(pa.table(columns), tmp_path / "data/chunk-000/file-000.parquet")
    read = rigproof.read(tmp_path, channels=["observation.state[1]"])
    assert len(read["t"]) == 30 and np.array_equal(read["observation.state[1]"], Q[:30, 1])


def joint_states(store, k: int):
    """A message of JointState, as a driver sends it."""
    kinds = store.types
    seconds, rest = divmod(round(T[k] * 1e9) + 1_700_000_000_123_456_789, 10**9)
    stamp = kinds["builtin_interfaces/msg/Time"](sec=seconds, nanosec=rest)
    words = {"seq": k} if "seq" in kinds["std_msgs/msg/Header"].__annotations__ else {}
    header = kinds["std_msgs/msg/Header"](stamp=stamp, frame_id="base", **words)
    return kinds["sensor_msgs/msg/JointState"](header=header, name=["a", "b"], position=Q[k], velocity=0.0 * Q[k], effort=2.0 * Q[k])


@pytest.mark.parametrize("kind", ["ros1", "ros2"])
def test_bags_of_ros_1_and_2_read_back(tmp_path: Path, kind: str) -> None:
    pytest.importorskip("rosbags")
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import Writer as Writer2
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if kind == "ros1" else Stores.ROS2_HUMBLE)
    path = tmp_path / ("run.bag" if kind == "ros1" else "run")
    with Writer1(path) if kind == "ros1" else Writer2(path, version=8) as writer:
        topic = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
        other = writer.add_connection("/empty", "sensor_msgs/msg/JointState", typestore=store)
        for k in range(len(T)):
            message = joint_states(store, k)
            raw = store.serialize_ros1(message, topic.msgtype) if kind == "ros1" else store.serialize_cdr(message, topic.msgtype)
            writer.write(topic, round(T[k] * 1e9) + 1_700_000_000_000_000_000, raw)
        assert other.topic == "/empty"
    names = ["/joint_states.position[0]", "/joint_states.effort[1]"]
    for own in [path] if kind == "ros1" else [path, *path.glob("*.db3")]:
        read = rigproof.read(own, channels=names)
        assert np.allclose(read["t"], T, atol=1e-9, rtol=0) and np.array_equal(read[names[0]], Q[:, 0]) and np.array_equal(read[names[1]], 2.0 * Q[:, 1])
    with pytest.raises(rigproof.Error, match="many topics"):
        rigproof.read(path)
    with pytest.raises(rigproof.Error, match="no message is on /empty"):
        rigproof.read(path, channels=["/empty.position[0]"])
    with pytest.raises(rigproof.Error, match="one topic at a time"):
        rigproof.read(path, channels=["/empty.position[0]", names[0]])


def test_tdms_reads_back(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    timed = {"wf_increment": 0.01, "wf_start_offset": 0.0}
    with nptdms.TdmsWriter(tmp_path / "run.tdms") as writer:
        writer.write_segment([nptdms.ChannelObject("rig", "q", Q[:, 0], timed), nptdms.ChannelObject("rig", "f", Q[:, 1].astype(np.float32), timed)])
    read = rigproof.read(tmp_path / "run.tdms")
    assert np.allclose(read["t"], T) and np.array_equal(read["q"], Q[:, 0]) and np.allclose(read["f"], Q[:, 1], atol=1e-7)


def test_mdf_reads_back_on_one_time(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(Q[:, 0], T, name="q", unit="rad")])
        file.append([asammdf.Signal(Q[::2, 1], T[::2], name="f", unit="N")])
        file.save(tmp_path / "run.mf4")
    read = rigproof.read(tmp_path / "run.mf4", channels=["q", "f"])
    assert np.allclose(read["t"], T) and np.allclose(read["q"], Q[:, 0]) and np.allclose(read["f"][::2], Q[::2, 1])


def test_a_servo_bench_of_others_reads() -> None:
    folder = Path(os.environ.get("RIGPROOF_DATA", "absent")) / "bam_xl330"
    files = sorted(folder.glob("*.json"))
    if not files:
        print("passed over: the recordings of BAM are absent")
        return
    read = rigproof.read(files[0])
    assert read["t"][0] == 0.0 and 5.0 < read["t"][-1] < 7.0 and np.ptp(read["position"]) > 0.5
