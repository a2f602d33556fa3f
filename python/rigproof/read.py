"""This file reads the files that robots and loggers write, with the libraries that are kept for them, into a dict of arrays that `diagnose` takes."""

from __future__ import annotations

import importlib
import json
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._errors import Error

Columns = dict[str, Any]


def read(path: str | os.PathLike[str], channels: Sequence[str] | None = None) -> Columns:
    """The columns of a file, each an array of shape (n,); the times are in seconds in `t` where the format knows them.

    `.parquet` (plain or LeRobot), a LeRobot folder, `.npz`, `.bag`, `.db3` and rosbag2 folders, `.tdms`, `.mf4` and `.dat`, BAM's `.json`. channels: those to
    take, all where it is None; of ROS bags `topic.field`, such as `/joint_states.position[0]`. Needs the extra of the format: rigproof[parquet], [ros], [tdms], [mdf].
    """
    path = Path(path)
    kinds: dict[str, Callable[[Path, Sequence[str] | None], Columns]] = {
        ".parquet": parquet, ".npz": npz, ".bag": ros, ".db3": ros, ".tdms": tdms, ".mf4": mdf, ".dat": mdf, ".json": bam,
    }
    own = kinds.get(path.suffix.lower())
    if own is None and path.is_dir():
        own = ros if (path / "metadata.yaml").exists() else parquet if (path / "meta" / "info.json").exists() else None
    if own is None:
        raise Error(f"{path}: no reader is kept for it; one is for {', '.join(kinds)}, LeRobot and rosbag2 folders; CSV and MCAP go to diagnose as a path")
    columns = own(path, channels)
    missing = [name for name in channels or [] if name not in columns]
    if missing:
        raise Error(f"{path}: `{missing[0]}` is not in it; there are {', '.join(map(str, columns))}")
    return {name: columns[name] for name in columns if channels is None or name in channels or name == "t"}


def _library(name: str, extra: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise Error(f"{name} is not installed; run: pip install 'rigproof[{extra}]'") from error


def parquet(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """A Parquet file, or the first file of a LeRobot folder; a column of lists becomes `name[0]`, `name[1]`, ...; a file of LeRobot gives its first episode."""
    library = _library("pyarrow.parquet", "parquet")
    file = min((path / "data").rglob("*.parquet")) if path.is_dir() else path
    table = library.read_table(file)
    names = table.column_names
    if "episode_index" in names:
        episode = table["episode_index"].to_numpy()
        table = table.filter(episode == episode[0])
    columns: Columns = {}
    for name in names:
        kind = str(table.schema.field(name).type)
        if "list" in kind:
            stacked = np.stack(table[name].to_numpy(zero_copy_only=False))
            columns.update({f"{name}[{k}]": stacked[:, k] for k in range(stacked.shape[1] if stacked.ndim == 2 else 0)})
        else:
            columns[name] = table[name].to_numpy()
    if "timestamp" in columns and "t" not in columns:
        columns = {"t": columns.pop("timestamp"), **columns}
    return columns


def npz(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """An archive of numpy: arrays of one dimension as they are, the columns of others as `name[0]`, `name[1]`, ..."""
    columns: Columns = {}
    with np.load(path, allow_pickle=False) as archive:
        for name in archive.files:
            array = archive[name]
            if array.ndim == 1:
                columns[name] = array
            elif array.ndim == 2:
                columns.update({f"{name}[{k}]": array[:, k] for k in range(array.shape[1])})
    return columns


def ros(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """A bag of ROS 1 or ROS 2: the channels of one topic, by the time at which messages were logged."""
    library = _library("rosbags.highlevel", "ros")
    if not channels:
        raise Error(f"{path}: a bag holds many topics; say channels=['/joint_states.position[0]', ...]")
    topics = {name.partition(".")[0] for name in channels}
    if len(topics) > 1:
        raise Error(f"{path}: the channels are of {len(topics)} topics, whose times differ; read one topic at a time")
    fields = {name: name.partition(".")[2].replace("]", "").replace("[", ".").split(".") for name in channels}
    stamps: list[int] = []
    columns: dict[str, list[float]] = {name: [] for name in channels}
    folder = path.parent if path.suffix == ".db3" and (path.parent / "metadata.yaml").exists() else path
    with library.AnyReader([folder]) as reader:
        for connection, stamp, raw in reader.messages([c for c in reader.connections if c.topic in topics]):
            message = reader.deserialize(raw, connection.msgtype)
            stamps.append(stamp)
            for name, parts in fields.items():
                value: Any = message
                for part in parts:
                    value = value[int(part)] if part.isdigit() else getattr(value, part)
                columns[name].append(float(value))
    if not stamps:
        raise Error(f"{path}: no message is on {topics.pop()}; look at the topics of the bag")
    return {"t": (np.array(stamps) - stamps[0]) * 1e-9, **{name: np.array(own) for name, own in columns.items()}}


def tdms(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """A file of LabVIEW: the channels of its groups, by the names of the channels; times from the increment of the first that has one."""
    columns: Columns = {}
    for group in _library("nptdms", "tdms").TdmsFile.read(path).groups():
        for channel in group.channels():
            columns[channel.name] = channel[:]
            if "t" not in columns and "wf_increment" in channel.properties:
                columns["t"] = channel.time_track()
    return columns


def mdf(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """A measurement file of ASAM: its channels brought to the times of all by asammdf, which interpolates."""
    with _library("asammdf", "mdf").MDF(path) as file:
        frame = file.to_dataframe(channels=list(channels) if channels else None)
    return {"t": frame.index.to_numpy(), **{name: frame[name].to_numpy() for name in frame.columns}}


def bam(path: Path, channels: Sequence[str] | None = None) -> Columns:
    """A record of the servo test bench BAM: position, speed, goal_position [rad] and the like, and `duty`, the share of full voltage that its controller gave."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        entries = record["entries"]
        columns = {name: np.array([entry[name] for entry in entries], dtype=float) for name in entries[0]}
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise Error(f"{path}: it is no record of BAM ({error!r}); it needs `entries` with the same keys") from error
    stamps = columns.pop("timestamp")
    if "goal_position" in columns and "kp" in record:
        # Position control of a Dynamixel XL330, as its authors' model has it.
        columns["duty"] = np.clip(record["kp"] * 0.0028774 * (columns["goal_position"] - columns["position"]), -1, 1)
    return {"t": stamps - stamps[0], **columns}


def even(columns: Columns, step_s: float) -> Columns:
    """The columns at even times, `step_s` apart, by straight lines between samples: recordings that are diagnosed together have one rate. Needs the times in `t`."""
    t = np.asarray(columns["t"], dtype=float)
    times = t[0] + step_s * np.arange(int((t[-1] - t[0]) / step_s) + 1)
    return {"t": times, **{name: np.interp(times, t, np.asarray(own, dtype=float)) for name, own in columns.items() if name != "t"}}
