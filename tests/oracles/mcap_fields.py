"""Values of decoded MCAP messages, by the names of their fields. Shared by the scripts beside it."""

import json
import struct

from mcap_protobuf.decoder import DecoderFactory as ProtobufDecoder
from mcap_ros1.decoder import DecoderFactory as FirstRosDecoder
from mcap_ros2.decoder import DecoderFactory as SecondRosDecoder


def put(path, value, fields):
    if value is None:
        return
    if isinstance(value, float):
        fields[path] = {"double": struct.pack(">d", value).hex()}
    elif isinstance(value, (bool, int)):
        fields[path] = int(value)
    elif isinstance(value, str):
        fields[path] = value
    elif isinstance(value, (bytes, bytearray, memoryview)):
        fields[f"{path}.length"] = len(value)
    elif isinstance(value, dict):
        for name, part in value.items():
            put(f"{path}.{name}" if path else name, part, fields)
    elif hasattr(value, "DESCRIPTOR"):
        for field in value.DESCRIPTOR.fields:
            if not field.is_repeated and field.has_presence and not value.HasField(field.name):
                continue
            put(f"{path}.{field.name}" if path else field.name, getattr(value, field.name), fields)
    elif hasattr(value, "__slots__"):
        for name in value.__slots__:
            put(f"{path}.{name}" if path else name, getattr(value, name), fields)
    else:
        values = list(value)
        fields[f"{path}.length"] = len(values)
        for index, part in enumerate(values):
            put(f"{path}[{index}]", part, fields)


class JsonDecoder:
    def decoder_for(self, encoding, schema):
        return json.loads if encoding == "json" else None


DECODERS = [SecondRosDecoder(), FirstRosDecoder(), ProtobufDecoder(), JsonDecoder()]
