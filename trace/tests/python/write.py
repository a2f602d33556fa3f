"""This file writes the same joints with every package and in every form, for us to read."""

import json
import math
import pathlib
import sys

from mcap.writer import CompressionType, Writer
from mcap_ros2.writer import Writer as Ros2Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter
from rosbags.typesys import Stores, get_typestore

FOLDER = pathlib.Path(sys.argv[1])
START_NS = 1_749_315_324_012_847_872
ROWS = 50

JOINT_STATE = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def time_ns(row):
    return START_NS + 1_000_017 * row


def position(row):
    return math.sin(0.1 * row) / 3 + 0.0137


def stamp(row):
    return {"sec": time_ns(row) // 10**9, "nanosec": time_ns(row) % 10**9}


with open(FOLDER / "ros2.mcap", "wb") as stream:
    writer = Ros2Writer(stream)
    schema = writer.register_msgdef("sensor_msgs/msg/JointState", JOINT_STATE)
    for row in range(ROWS):
        # The order of the joints changes on the way: they are found by name.
        names = ["wrist", "elbow"] if row < 20 else ["elbow", "wrist"]
        values = {"elbow": position(row), "wrist": -float(row)}
        writer.write_message(
            topic="/joint_states",
            schema=schema,
            message={
                "header": {"stamp": stamp(row), "frame_id": "base"},
                "name": names,
                "position": [values[name] for name in names],
                "velocity": [],
                "effort": [],
            },
            log_time=time_ns(row) + 1_200_000,
            publish_time=time_ns(row),
            sequence=row,
        )
    writer.finish()

for name, options in {
    "lz4": {"compression": CompressionType.LZ4, "chunk_size": 500},
    "zstd": {"compression": CompressionType.ZSTD, "chunk_size": 500},
    "plain": {"compression": CompressionType.NONE},
    "unchunked": {"use_chunking": False},
    "bare": {
        "use_statistics": False,
        "use_summary_offsets": False,
        "repeat_schemas": False,
        "repeat_channels": False,
        "index_types": 0,
        "enable_crcs": False,
    },
}.items():
    with open(FOLDER / f"{name}.mcap", "wb") as stream:
        if "index_types" in options:
            from mcap.writer import IndexType

            options["index_types"] = IndexType.NONE
        writer = Writer(stream, **options)
        writer.start(profile="", library="")
        schema = writer.register_schema(name="Joints", encoding="jsonschema", data=b"{}")
        channel = writer.register_channel(topic="/joint_states", message_encoding="json", schema_id=schema)
        for row in range(ROWS):
            data = {
                "header": {"stamp": stamp(row)},
                "name": ["elbow", "wrist"],
                "position": [position(row), -float(row)],
            }
            writer.add_message(
                channel_id=channel,
                log_time=time_ns(row) + 1_200_000,
                publish_time=time_ns(row),
                data=json.dumps(data).encode(),
            )
        writer.finish()

store = get_typestore(Stores.ROS2_HUMBLE)
JointState = store.types["sensor_msgs/msg/JointState"]
Header = store.types["std_msgs/msg/Header"]
Time = store.types["builtin_interfaces/msg/Time"]
with BagWriter(FOLDER / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
    import numpy

    connection = bag.add_connection("/joint_states", JointState.__msgtype__, typestore=store)
    empty = numpy.array([], dtype=numpy.float64)
    for row in range(ROWS):
        message = JointState(
            header=Header(stamp=Time(**stamp(row)), frame_id="base"),
            name=["elbow", "wrist"],
            position=numpy.array([position(row), -float(row)]),
            velocity=empty,
            effort=empty,
        )
        bag.write(connection, time_ns(row) + 1_200_000, store.serialize_cdr(message, JointState.__msgtype__))

for row in range(ROWS):
    print(time_ns(row), position(row).hex(), repr(position(row)))
