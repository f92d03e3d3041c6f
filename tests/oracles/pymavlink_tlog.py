"""A telemetry log with every message of MAVLink by pymavlink, and what pymavlink reads in it.

Question: {"path": where to write, "seed": number, "version": of the protocol; pymavlink stumbles where short
messages of the first follow those of the second}. Answer: {"messages": [[microseconds, name, system,
component, {field: value, list of values, or letters and bytes as hex}], ...], "parameters": {name: value},
"modes": [[microseconds, name], ...] of the first system}.
"""

import contextlib
import json
import os
import random
import struct
import sys

os.environ["MAVLINK20"] = "1"
os.environ["MAVLINK_DIALECT"] = "all"

with contextlib.redirect_stdout(sys.stderr):
    from pymavlink import mavutil
    from pymavlink.dialects.v20 import all as mavlink

START = 1_650_000_000_000_000
# Messages made to test generators.
FOR_TESTS = {"TEST_TYPES"}
FOR_TESTS |= {f"ARRAY_TEST_{i}" for i in range(9)}
RANGES = {
    "int8_t": "b",
    "uint8_t": "B",
    "int16_t": "h",
    "uint16_t": "H",
    "int32_t": "i",
    "uint32_t": "I",
    "int64_t": "q",
    "uint64_t": "Q",
}


def number(kind, dice):
    if kind in ("float", "double"):
        code = "f" if kind == "float" else "d"
        return struct.unpack(code, struct.pack(code, dice.gauss(0, 1000)))[0]
    bits = 8 * struct.calcsize("<" + RANGES[kind])
    low = -(2 ** (bits - 1)) if kind.startswith("int") else 0
    # Zeros at the end are left out on the way.
    return dice.choice([0, low, low + 2**bits - 1, dice.randrange(low, low + 2**bits)])


def values(message, dice):
    found = []
    for kind, count in zip(
        message.fieldtypes, [message.array_lengths[i] for i in message.orders], strict=True
    ):
        if kind == "char":
            length = dice.randrange(count + 1)
            found.append(bytes(dice.randrange(1, 128) for _ in range(length)).ljust(count, b"\0"))
        elif count:
            found.append([number(kind, dice) for _ in range(count)])
        else:
            found.append(number(kind, dice))
    return found


def write(path, dice, version):
    def stamped(time, message, sender):
        return struct.pack(">Q", START + time) + message.pack(sender, force_mavlink1=version == 1)

    senders = []
    for system, component, signed in [(1, 1, False), (1, 154, False), (7, 1, version == 2)]:
        sender = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
        if signed:
            sender.signing.secret_key = bytes(range(32))
            sender.signing.timestamp = 1
            sender.signing.sign_outgoing = True
        senders.append(sender)
    time = 0
    with open(path, "wb") as file:
        for mode in (5, 10, 10, 11):
            time += 1_000_000
            beat = mavlink.MAVLink_heartbeat_message(1, 3, 1, mode, 4, 3)
            file.write(stamped(time, beat, senders[0]))
        for name, value in [("ARSPD_RATIO", 1.9936), ("SYSID_THISMAV", 1.0), ("ARSPD_RATIO", 2.25)]:
            time += 1234
            parameter = mavlink.MAVLink_param_value_message(name.encode(), value, 9, 2, 0)
            file.write(stamped(time, parameter, senders[0]))
        kinds = [kind for kind in mavlink.mavlink_map.values() if kind.msgname not in FOR_TESTS]
        if version == 1:
            kinds = [kind for kind in kinds if kind.id < 256]
        for _ in range(3):
            for kind in sorted(kinds, key=lambda kind: kind.id):
                # More parameters and modes than those above would come of chance.
                sender = senders[-1] if kind.id in (0, 22) else dice.choice(senders)
                time += dice.randrange(1, 100_000)
                file.write(stamped(time, kind(*values(kind, dice)), sender))


def field(message, name):
    raw = getattr(message, f"_{name}_raw", None)
    return raw.hex() if raw is not None else getattr(message, name)


def read(path):
    log = mavutil.mavlink_connection(path)
    messages, parameters, modes = [], {}, []
    while (message := log.recv_match()) is not None:
        system, component = message.get_srcSystem(), message.get_srcComponent()
        time = round(message._timestamp * 1e6)
        fields = {name: field(message, name) for name in message.get_fieldnames()}
        messages.append([time, message.get_type(), system, component, fields])
        if (system, component) == (1, 1):
            if message.get_type() == "PARAM_VALUE":
                parameters[message.param_id] = message.param_value
            mode = mavutil.mode_string_v10(message) if message.get_type() == "HEARTBEAT" else None
            if mode and (not modes or modes[-1][1] != mode):
                modes.append([time, mode])
    return {"messages": messages, "parameters": parameters, "modes": modes}


question = json.load(sys.stdin)
# pymavlink says on the standard output what it finds strange.
with contextlib.redirect_stdout(sys.stderr):
    write(question["path"], random.Random(question["seed"]), question["version"])
    answer = read(question["path"])
json.dump(answer, sys.stdout)
