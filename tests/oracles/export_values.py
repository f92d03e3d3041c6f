"""Every value that `pilotage export` wrote of a log, beside what the format's other readers read in it.

Question: {"log": path, "format": "ulog", "dataflash", "text", "tlog" or "mcap", "json": what was exported of all topics,
"tables": {topic: [path of its table in CSV, and in Parquet]}}. Answer: {"topics", "rows", "values", "table_values": counts of what was
compared, "differences": the first of them in words}. Numbers are equal to the bit; where the format has a scale (a unit
with a prefix, a multiplier), to the last digit of a double.
"""

import contextlib
import csv
import json
import math
import os
import struct
import sys

os.environ["MAVLINK20"] = "1"
os.environ["MAVLINK_DIALECT"] = "all"

# Differences that are told.
MOST = 20
# Rows of a topic that may be left out for their times.
FEW = 3
# Parts that MAVLink's definitions count in, of the units that people read.
PARTS = {
    "degE7": 1e7, "degE5": 1e5, "cdeg": 1e2, "ddeg/s": 10, "mrad/s": 1e3, "cdegC": 1e2, "mm": 1e3, "cm": 1e2,
    "dm": 10, "mm/s": 1e3, "cm/s": 1e2, "dm/s": 10, "m/s*5": 5, "mG": 1e3, "mgauss": 1e3, "mV": 1e3, "cV": 1e2,
    "mA": 1e3, "cA": 1e2, "c%": 1e2, "d%": 10, "deg/2": 0.5, "dam": 0.1, "hJ": 0.01, "hPa": 0.01,
}  # fmt: skip

# The receivers of PX4, and their scaled integers.
RECEIVERS = {"sensor_gps", "vehicle_gps_position"}
INTEGERS = {"lat": 1e7, "lon": 1e7, "alt": 1e3, "alt_ellipsoid": 1e3}


def single(number):
    try:
        return struct.unpack("f", struct.pack("f", number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)


class Theirs:
    """Columns of a topic as the other reader has them."""

    def __init__(self):
        self.times = []
        self.columns = {}
        # Columns that are compared to the last digit only.
        self.is_scaled = set()

    def add(self, name, value):
        column = self.columns.setdefault(name, [])
        # Of fields that not every message has, nothing was said before.
        column.extend([None] * (len(self.times) - 1 - len(column)))
        column.append(value)


def letters(raw):
    raw = bytes(raw).split(b"\0")[0]
    try:
        return raw.decode()
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def ulog(path):
    from pyulog import ULog

    topics = {}
    for data in ULog(path).data_list:
        topic = topics[f"{data.name}[{data.multi_id}]"] = Theirs()
        topic.times = [time / 1e6 for time in data.data["timestamp"].tolist()]
        texts = {}
        for field in data.field_data:
            column = data.data[field.field_name]
            if "_padding" in field.field_name:
                continue
            if field.type_str == "char":
                texts.setdefault(field.field_name.rsplit("[", 1)[0], []).append(column.tolist())
            elif parts := data.name in RECEIVERS and field.type_str == "int32_t" and INTEGERS.get(field.field_name):
                topic.columns[field.field_name] = [value / parts for value in column.tolist()]
            elif field.type_str == "bool":
                topic.columns[field.field_name] = [int(value != 0) for value in column.tolist()]
            else:
                topic.columns[field.field_name] = column.tolist()
        for name, columns in texts.items():
            topic.columns[name] = [letters(ord(c) if isinstance(c, str) else c & 255 for c in row) for row in zip(*columns)]
    return topics


def dataflash(path, is_text):
    from pymavlink import DFReader

    kind = DFReader.DFReader_text if is_text else DFReader.DFReader_binary
    reader = kind(path, zero_time_base=True)
    factors, multipliers, topics = {}, {}, {}
    messages = []
    while (message := reader.recv_msg()) is not None:
        if message.fmt.name == "MULT":
            multipliers[chr(message.Id)] = message.Mult
        elif message.fmt.name == "FMTU":
            factors[message.FmtType] = message.MultIds
        messages.append(message)
    for message in messages:
        kind = message.fmt
        name = kind.name
        if kind.instance_field is not None:
            name += f"[{getattr(message, kind.instance_field)}]"
        topic = topics.setdefault(name, Theirs())
        topic.times.append(message._timestamp or None)
        for index, (column, letter) in enumerate(zip(kind.columns, kind.format)):
            letter = letter if isinstance(letter, str) else chr(letter)
            value = getattr(message, column)
            if letter == "M":
                value = int(message._elements[index])
            elif isinstance(value, str) and letter == "a":
                value = [int(number) for number in value.strip("[]").split()]
            elif isinstance(value, bytes):
                value = value.hex()
            elif name == "FILE" and letter == "Z":
                value = value.encode().ljust(64, b"\0").hex()
            elif is_text and letter in "fg" and not isinstance(value, str):
                value = single(value)
            ids = factors.get(kind.type, "")
            factor = multipliers.get(ids[index]) if index < len(ids) else None
            is_free = kind.msg_mults[index] is None and kind.units and kind.units[index]
            values = {f"{column}[{place}]": number for place, number in enumerate(value)} if letter == "a" else {column: value}
            for field, number in values.items():
                if factor not in (None, 0, 1) and is_free and isinstance(number, (int, float)):
                    # Multipliers are stored in single precision.
                    number *= float(f"{factor:.7g}")
                    topic.is_scaled.add(field)
                topic.add(field, number)
    if is_text:
        topics.pop("UNIT", None)  # pymavlink leaves out lines that end with an empty text.
    return topics


def tlog(path):
    from pymavlink import mavutil
    from pymavlink.dialects.v20 import all as mavlink

    units = {
        kind.msgname: dict(zip(kind.fieldnames, (kind.fieldunits_by_name.get(n, "") for n in kind.fieldnames)))
        for kind in mavlink.mavlink_map.values()
    }
    log = mavutil.mavlink_connection(path)
    messages, components, topics = [], {}, {}
    while (message := log.recv_match()) is not None:
        messages.append(message)
        of, component = (message.get_type(), message.get_srcSystem()), message.get_srcComponent()
        # Of the components of a system the one that is heard first, but the autopilot wherever it is heard.
        components[of] = component if component == 1 else components.get(of, component)
    first = round(messages[0]._timestamp * 1e6) if messages else 0
    for message in messages:
        kind = message.get_type()
        time = round(message._timestamp * 1e6)
        system, component = message.get_srcSystem(), message.get_srcComponent()
        own = components[(kind, system)] == component
        topic = topics.setdefault(f"{kind}[{system if own else 1000 * system + component}]", Theirs())
        topic.times.append((time - first) / 1e6)
        for name in message.get_fieldnames():
            raw = getattr(message, f"_{name}_raw", None)
            value = letters(raw) if raw is not None else getattr(message, name)
            parts = PARTS.get(units[kind][name].strip("[]"), 1)
            if isinstance(value, list) and f"{kind}.{name}" in BYTES:
                topic.add(name, bytes(value).hex())
                continue
            for place, number in enumerate(value if isinstance(value, list) else [value]):
                field = f"{name}[{place}]" if isinstance(value, list) else name
                if parts != 1:
                    number /= parts
                    topic.is_scaled.add(field)
                topic.add(field, number)
    return topics


def mcap(path):
    from mcap.reader import make_reader
    from mcap_fields import DECODERS, put

    topics, zero = {}, None
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=DECODERS)
        for _, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
            zero = message.log_time if zero is None else zero
            topic = topics.setdefault(channel.topic, Theirs())
            topic.times.append((message.log_time - zero) / 1e9)
            fields = {}
            put("", decoded, fields)
            for name, value in fields.items():
                if isinstance(value, dict):
                    value = struct.unpack(">d", bytes.fromhex(value["double"]))[0]
                topic.add(name, value)
    return topics


def is_same(ours, theirs, is_scaled):
    """Whether two values are one; JSON has no number for what is none."""
    if isinstance(theirs, (int, float)) and not isinstance(theirs, bool):
        if not math.isfinite(theirs):
            return ours is None or (isinstance(ours, float) and (ours == theirs or ours != ours and theirs != theirs))
        if not isinstance(ours, (int, float)):
            return False
        if is_scaled:
            return math.isclose(ours, theirs, rel_tol=4e-16 * 8, abs_tol=0)
        return ours == theirs and math.copysign(1, ours) == math.copysign(1, theirs)
    # Of lines of text pymavlink leaves out what follows a comma.
    return ours == theirs or form == "text" and isinstance(ours, str) and ours.startswith(f"{theirs}, ")


def is_blank(ours):
    """What stands where nothing was said."""
    return ours in (None, 0, "") or ours != ours or (isinstance(ours, str) and set(ours) == {"0"})


class Comparison:
    def __init__(self):
        self.counts = {"topics": 0, "rows": 0, "values": 0, "table_values": 0}
        self.differences = []

    def say(self, words):
        if len(self.differences) < MOST:
            self.differences.append(words)

    def column(self, place, ours, theirs, is_scaled):
        theirs = theirs + [None] * (len(ours) - len(theirs))
        if len(ours) != len(theirs):
            self.say(f"{place}: {len(ours)} values, not {len(theirs)}")
            return
        for row, (our, their) in enumerate(zip(ours, theirs)):
            if their is None and not is_blank(our) or their is not None and not is_same(our, their, is_scaled):
                self.say(f"{place}, row {row}: {our!r}, not {their!r}")
                return
        self.counts["values"] += len(ours)

    def topic(self, name, ours, theirs, form):
        times = ours["time_s"]
        columns = theirs.columns
        if form == "ulog" and len(times) < len(theirs.times):
            # Rows whose times cannot be are left out, and told.
            kept, at = [], 0
            for row, time in enumerate(theirs.times):
                if at < len(times) and times[at] == time:
                    kept.append(row)
                    at += 1
            if len(theirs.times) - len(kept) > FEW:
                self.say(f"{name}: {len(times)} rows of {len(theirs.times)}")
            theirs.times = [theirs.times[row] for row in kept]
            columns = {field: [column[row] for row in kept] for field, column in columns.items()}
        if len(times) != len(theirs.times):
            self.say(f"{name}: {len(times)} rows, not {len(theirs.times)}")
            return
        for row, (our, their) in enumerate(zip(times, theirs.times)):
            # pymavlink adds seconds since 1970 to those of a log, and knows no time before the first.
            near = 1e-9 if form in ("dataflash", "text") else 0
            if their is not None and not math.isclose(our, their, rel_tol=near, abs_tol=near):
                self.say(f"{name}, time of row {row}: {our!r}, not {their!r}")
                break
        self.counts["topics"] += 1
        self.counts["rows"] += len(times)
        for field, column in columns.items():
            if field in ours:
                self.column(f"{name}.{field}", ours[field], column, field in theirs.is_scaled)
            elif not (form == "mcap" and field.endswith(".length")):
                self.say(f"{name} has no {field}")
        for field in ours.keys() - columns.keys() - {"time_s", "publish_time"}:
            if not all(map(is_blank, ours[field])):
                self.say(f"{name}.{field} is no field of theirs")

    def table(self, name, path, ours):
        """The table of a topic has the values of the object."""
        with open(path, newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        fields = [column.rsplit(" [", 1)[0] if column.endswith("]") and " [" in column else column for column in head]

        def is_same(text, value):
            if value is None:
                return text == "" or not math.isfinite(float(text))
            return type(value)(text) == value

        self.columns(f"the table of {name}", fields, zip(*rows), ours, is_same)

    def parquet(self, name, path, ours):
        """The table in Parquet, as DuckDB reads it, has them too: numbers are numbers there, and what is none is null."""
        import duckdb

        table = duckdb.read_parquet(path)

        def is_same(stored, value):
            if value is None:
                return stored is None or not math.isfinite(stored)
            # A column with one real number has real numbers; one of 64 bits without a sign may not be JSON's.
            return isinstance(stored, str) == isinstance(value, str) and stored == value

        rows = table.fetchall()
        self.columns(f"the Parquet table of {name}", table.columns, zip(*rows), ours, is_same)

    def columns(self, place, fields, columns, ours, is_same):
        if sorted(fields) != sorted(ours):
            self.say(f"{place} has {fields}")
            return
        for field, column in zip(fields, columns):
            for row, (stored, value) in enumerate(zip(column, ours[field], strict=True)):
                if not is_same(stored, value):
                    self.say(f"{place}, {field}, row {row}: {stored!r}, not {value!r}")
                    break
                self.counts["table_values"] += 1


question = json.load(sys.stdin)
form = question["format"]
BYTES = set()
# pymavlink says on the standard output what it finds strange.
with contextlib.redirect_stdout(sys.stderr):
    with open(question["json"], encoding="utf-8") as file:
        exported = json.load(file)
    if form == "tlog":
        # Many bytes stay together.
        texts = ((topic.split("[")[0], field) for topic in exported for field in exported[topic])
        BYTES = {f"{topic}.{field}" for topic, field in texts if "[" not in field}
    readers = {
        "ulog": ulog,
        "dataflash": lambda path: dataflash(path, False),
        "text": lambda path: dataflash(path, True),
        "tlog": tlog,
        "mcap": mcap,
    }
    read = readers[form](question["log"])
    comparison = Comparison()
    for name in sorted(read.keys() | exported.keys()):
        if name not in exported:
            # Rows whose times cannot be are left out, and told.
            if len(read[name].times) > (FEW if form == "ulog" else 0):
                comparison.say(f"{name} was not exported")
        elif name not in read:
            if not (form == "text" and name == "UNIT"):
                comparison.say(f"{name} is no topic of theirs")
        else:
            comparison.topic(name, exported[name], read[name], form)
    for name, (table, parquet) in question["tables"].items():
        comparison.table(name, table, exported[name])
        comparison.parquet(name, parquet, exported[name])
json.dump({**comparison.counts, "differences": comparison.differences}, sys.stdout)
