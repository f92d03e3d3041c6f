"""The messages of MAVLink as pymavlink's definitions have them, one to a line.

Answer, to any question, a text: a line is the number of the message, its name, and its fields in the order
of the definition, parted by `;`; a field is a letter for its type (those of Python's struct, with the length
behind it if it is an array), its name and its unit; a `+` parts the fields that version 1 of the protocol
does not have. Messages made to test generators are left out.
"""

import contextlib
import json
import os
import sys

import pymavlink
from pymavlink.generator import mavparse

LETTERS = {
    "char": "c",
    "int8_t": "b",
    "uint8_t": "B",
    "int16_t": "h",
    "uint16_t": "H",
    "int32_t": "i",
    "uint32_t": "I",
    "int64_t": "q",
    "uint64_t": "Q",
    "float": "f",
    "double": "d",
}
FOR_TESTS = {"python_array_test.xml", "test.xml"}
FOLDER = os.path.join(os.path.dirname(pymavlink.__file__), "dialects", "v20")


def definitions(name, seen):
    if name in seen or name in FOR_TESTS:
        return []
    seen.add(name)
    dialect = mavparse.MAVXML(os.path.join(FOLDER, name), "2.0")
    included = [message for other in dialect.include for message in definitions(other, seen)]
    return dialect.message + included


def line(message):
    parts = [str(message.id), message.name]
    for index, field in enumerate(message.fields):
        if index == message.extensions_start:
            parts.append("+")
        length = str(field.array_length) if field.array_length else ""
        unit = field.units.strip("[]")
        parts.append(f"{LETTERS[field.type]}{length} {field.name} {unit}".rstrip())
    return ";".join(parts)


json.load(sys.stdin)
# The parser says on the standard output what it finds strange.
with contextlib.redirect_stdout(sys.stderr):
    messages = sorted(definitions("all.xml", set()), key=lambda message: message.id)
json.dump("".join(line(message) + "\n" for message in messages), sys.stdout)
