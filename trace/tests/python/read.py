"""This file reads an MCAP file with Python's packages and prints every number by its bits."""

import json
import struct
import sys

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory


def bits(value):
    return struct.pack(">d", float(value)).hex()


with open(sys.argv[1], "rb") as stream:
    reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
    for schema, channel, message in reader.iter_messages():
        words = [channel.topic, str(message.log_time), str(message.publish_time)]
        if channel.message_encoding == "json":
            row = json.loads(message.data)
            words += [f"{key}={bits(value)}" for key, value in row.items()]
        print("\t".join(words))
    for schema, channel, message, decoded in reader.iter_decoded_messages(topics=["/joint_states"]):
        stamp = decoded.header.stamp.sec * 1_000_000_000 + decoded.header.stamp.nanosec
        numbers = [*decoded.position, *decoded.velocity, *decoded.effort]
        print("\t".join(["joints", str(stamp), *decoded.name, *map(bits, numbers)]))
    for schema, channel, message, decoded in reader.iter_decoded_messages(topics=["/wrench"]):
        force, torque = decoded.wrench.force, decoded.wrench.torque
        numbers = [force.x, force.y, force.z, torque.x, torque.y, torque.z]
        print("\t".join(["wrench", *map(bits, numbers)]))
    names = [attachment.name for attachment in reader.iter_attachments()]
    tables = [record.metadata for record in reader.iter_metadata()]
    print("\t".join(["extras", *names, *(table["seed"] for table in tables)]))
