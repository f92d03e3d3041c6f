"""What pyulog reads in a ULog file, and such a file with everything that the format knows.

Question: {"path": file, "write": whether to write the file first}. Answer: {"topics": [{"name",
"instance", "fields": [[name, type, bytes of the column as hex], ...]}, ...], "initial": {name: value},
"changed": [[microseconds, name, value], ...], "defaults": [{name: value} of the system, of the airframe],
"words": [[level, tag or null, microseconds, text], ...], "dropouts": [[microseconds, milliseconds], ...],
"facts": [[name, text or number or null for bytes], ...]}.
"""

import json
import struct
import sys

import numpy
from pyulog import ULog


def message(kind, data):
    return struct.pack("<HB", len(data), ord(kind)) + data


def keyed(kind, before, key, value):
    return message(kind, before + struct.pack("<B", len(key)) + key.encode() + value)


def row(number, form, *values):
    return message("D", struct.pack("<H" + form, number, *values))


def everything():
    """A ULog with every kind of message and every type of field, appended data included."""
    start = 12_345_678
    plain = "int8_t a;uint8_t b;int16_t c;uint16_t d;int32_t e;uint32_t f;int64_t g;uint64_t h;"
    parts = [
        ULog.HEADER_BYTES + struct.pack("<BQ", 1, start),
        message("B", bytes(40)),
        message("F", b"every:uint64_t timestamp;" + plain.encode() + b"float i;double j;bool k;char l;"),
        message("F", b"inner:float[3] xyz;uint8_t quality;uint8_t[3] _padding0;"),
        message("F", b"outer:inner[2] sensors;uint64_t timestamp;inner last;char[10] name;uint8_t[2] _padding0;"),
        keyed("I", b"", "char[3] sys_name", b"PX4"),
        keyed("I", b"", "uint32_t ver_sw_release", struct.pack("<I", 0x010F00FF)),
        keyed("I", b"", "int32_t time_ref_utc", struct.pack("<i", -3600)),
        keyed("I", b"", "uint8_t[4] key", b"\x01\x02\xfe\xff"),
        keyed("M", b"\x00", "char[6] boot_console_output", "Grüß".encode()),
        keyed("M", b"\x01", "char[5] boot_console_output", b" Gott"),
        keyed("P", b"", "float FW_AIRSPD_TRIM", struct.pack("<f", 15.1)),
        keyed("P", b"", "int32_t SYS_AUTOSTART", struct.pack("<i", -2100)),
        keyed("Q", b"\x03", "int32_t SYS_AUTOSTART", struct.pack("<i", 0)),
        keyed("Q", b"\x02", "float FW_AIRSPD_TRIM", struct.pack("<f", 13.7)),
        message("A", struct.pack("<BH", 0, 7) + b"every"),
        message("A", struct.pack("<BH", 1, 300) + b"outer"),
        message("A", struct.pack("<BH", 0, 301) + b"outer"),
    ]
    ends = [-128, 255, -32768, 65535, -(2**31), 2**32 - 1, -(2**63), 2**64 - 1]
    middle = [5, 6, 7, 8, 9, 10, 11, 12]
    random = numpy.random.default_rng(1)
    for i, values in enumerate([ends, middle, ends]):
        time = start + 100_000 * i
        numbers = [*values, random.normal(), random.normal(), i % 2 == 0, b"x"]
        parts.append(row(7, "QbBhHiIqQfd?c", time, *numbers))
        for number in (300, 301):
            floats = random.normal(size=9)
            parts.append(
                row(number, "3fB3x3fB3xQ3fB3x10s", *floats[:3], 9, *floats[3:6], 8, time, *floats[6:], 7, b"name%d" % i)
            )
        parts.append(message("S", ULog.SYNC_BYTES))
        parts.append(message("O", struct.pack("<H", 20 + i)))
        parts.append(message("L", struct.pack("<BQ", ord("0") + 2 * i, time) + b"words %d" % i))
        parts.append(message("C", struct.pack("<BHQ", ord("7"), i, time) + b"tagged"))
        parts.append(keyed("P", b"", "float FW_AIRSPD_TRIM", struct.pack("<f", 16.5 + i)))
    parts.append(message("R", struct.pack("<H", 300)))
    parts.append(message("z", b"a kind of later versions"))
    file = bytearray(b"".join(parts))
    # The data that a crash leaves behind, after a message that it cut off.
    file += row(7, "Q", 1)[:5]
    struct.pack_into("<B", file, 16 + 3 + 8, 1)
    struct.pack_into("<Q", file, 16 + 3 + 16, len(file))
    file += keyed("M", b"\x00", "char[5] hardfault_plain", b"at 17")
    return bytes(file)


def columns(data):
    return [
        [field.field_name, field.type_str, data.data[field.field_name].tobytes().hex()]
        for field in data.field_data
    ]


def plain(value):
    return None if isinstance(value, bytes) else value


question = json.load(sys.stdin)
if question["write"]:
    with open(question["path"], "wb") as file:
        file.write(everything())
# pyulog says on the standard output what it finds strange.
answer, sys.stdout = sys.stdout, sys.stderr
log = ULog(question["path"])
words = [[m.log_level, None, m.timestamp, m.message] for m in log.logged_messages]
for tag, messages in log.logged_messages_tagged.items():
    words += [[m.log_level, tag, m.timestamp, m.message] for m in messages]
facts = [[name, plain(value)] for name, value in log.msg_info_dict.items()]
for name, groups in log.msg_info_multiple_dict.items():
    facts += [[name, plain(value)] for group in groups for value in group]
json.dump(
    {
        "topics": [
            {"name": data.name, "instance": data.multi_id, "fields": columns(data)}
            for data in log.data_list
        ],
        "initial": log.initial_parameters,
        "changed": log.changed_parameters,
        "defaults": [log.get_default_parameters(kind) for kind in (0, 1)],
        "words": words,
        "dropouts": [[d.timestamp, d.duration] for d in log.dropouts],
        "facts": facts,
    },
    answer,
)
