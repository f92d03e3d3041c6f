"""Dataflash logs as pymavlink reads them.

Question: {"logs": [{"name", "hex", "is_text"}, ...]}. Answer: a list of {"formats": {name: {"letters",
"columns", "units"}}, "messages": [[name, instance, seconds, [value, ...]], ...], "modes": [name after each
MODE message], "parameters": {name: value}, "start": seconds since 1970 of the log's second zero}.
Seconds are those of pymavlink's own clock with the log's base at zero. A value is a string: "i" and a whole
number, "f" and the sixteen hexadecimal digits of a double, "s" and letters, "b" and bytes in hexadecimal,
"a" and thirty-two numbers.
"""

import array
import contextlib
import json
import os
import struct
import sys
import tempfile

from pymavlink import DFReader


def value(v):
    if isinstance(v, bool) or isinstance(v, int):
        return f"i{v}"
    if isinstance(v, float):
        return "f" + struct.pack(">d", v).hex()
    if isinstance(v, bytes):
        return "b" + v.hex()
    if isinstance(v, array.array):
        return "a" + " ".join(str(n) for n in v)
    return "s" + v


def open_log(log, place, zero_time_base):
    reader = DFReader.DFReader_text if log["is_text"] else DFReader.DFReader_binary
    return reader(place, zero_time_base=zero_time_base)


def number(v):
    return struct.pack(">d", float(v)).hex()


def first_time(reader):
    while (message := reader.recv_msg()) is not None:
        if "TimeUS" in message.get_fieldnames() or "TimeMS" in message.get_fieldnames()[:1]:
            return message._timestamp
    return None


def read(log, place):
    reader = open_log(log, place, True)
    messages, modes, formats = [], [], {}
    while (message := reader.recv_msg()) is not None:
        kind = message.fmt
        instance = None
        if kind.instance_field is not None:
            instance = str(getattr(message, kind.instance_field))
        values = [value(getattr(message, column)) for column in kind.columns]
        messages.append([kind.name, instance, number(message._timestamp), values])
        formats[kind.name] = {
            "letters": kind.format if isinstance(kind.format, str) else kind.format.decode(),
            "columns": kind.columns,
            "units": [kind.get_unit(column) for column in kind.columns],
        }
        if kind.name == "MODE":
            modes.append(reader.flightmode)
    zero = first_time(open_log(log, place, True))
    dated = first_time(open_log(log, place, False))
    return {
        "formats": formats,
        "messages": messages,
        "modes": modes,
        "parameters": {name: number(v) for name, v in reader.params.items()},
        "start": None if dated is None else dated - zero,
    }


def answer(log):
    with tempfile.TemporaryDirectory() as folder:
        place = os.path.join(folder, log["name"])
        with open(place, "wb") as file:
            file.write(bytes.fromhex(log["hex"]))
        # What pymavlink says on the way is no part of the answer.
        with contextlib.redirect_stdout(sys.stderr):
            return read(log, place)


json.dump([answer(log) for log in json.load(sys.stdin)["logs"]], sys.stdout)
