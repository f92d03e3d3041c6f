"""Writes MCAP files with messages of every kind of schema, and says what the format's own libraries read in them.

Question: {"path": file to write, "packing": "", "lz4" or "zstd", "chunks": whether there are any, "seed"}. Answer:
{"messages": [[topic, schema, logged, published, {field: value}], ...] in the order of the file, "metadata": [[name,
text], ...], "attachments": [name, ...]}. Times are nanoseconds. A value is a whole number, a text, or
{"double": bits as hexadecimal digits}; of a list there is field.length, and of many bytes nothing else.
"""

import json
import random
import struct
import sys
from types import SimpleNamespace

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer
from mcap_fields import DECODERS, put
from mcap_protobuf.schema import build_file_descriptor_set
from mcap_ros1._vendor.genpy import dynamic
from mcap_ros2._dynamic import serialize_dynamic

START = 1_700_000_000_123_456_789
LINE = "=" * 80

PLAIN = """bool yes
byte octet
int8 i8
uint8 u8
int16 i16
uint16 u16
int32 i32
uint32 u32
int64 i64
uint64 u64
float32 f32
float64 f64
string text
"""

SECOND_ROS = (
    """# everything that ROS 2 has
std_msgs/Header header
uint8 KIND=3
string NAME = "constant # not a remark"
"""
    + PLAIN
    + f"""float64[3] three
float32[] some
float64[] doubles
uint8[] blob
int16[<=4] few
string<=20 short_text 'default'
string[] texts
Inner inner
test_msgs/Inner[2] pair
Inner[] inners
bool last true
{LINE}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
{LINE}
MSG: test_msgs/Inner
uint8 a
float64 b
Nothing nothing
{LINE}
MSG: test_msgs/Nothing
"""
)

FIRST_ROS = (
    """Header header
uint8 KIND=3
"""
    + PLAIN.replace("byte octet\n", "")
    + f"""time moment
duration span
float64[3] three
float32[] some
uint8[] blob
uint16[2] two
string[] texts
Inner inner
Inner[] inners
{LINE}
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
{LINE}
MSG: test_msgs/Inner
uint8 a
float64 b
"""
)

SCALARS = (
    "double float int64 uint64 int32 fixed64 fixed32 bool string - - bytes uint32 enum sfixed32 sfixed64 sint32 sint64"
).split()


def protobuf_types():
    """A message with a field of every type, once and many times, in a file with another that it needs."""
    inner = descriptor_pb2.FileDescriptorProto(name="inner.proto", package="test.deep", syntax="proto3")
    point = inner.message_type.add(name="Point")
    for number, name in enumerate("xyz", 1):
        point.field.add(name=name, number=number, type=1, label=1)
    tree = inner.message_type.add(name="Tree")
    tree.field.add(name="leaves", number=1, type=5, label=1)
    tree.field.add(name="branches", number=2, type=11, label=3, type_name=".test.deep.Tree")
    file = descriptor_pb2.FileDescriptorProto(
        name="every.proto", package="test", syntax="proto3", dependency=["inner.proto"]
    )
    colour = file.enum_type.add(name="Colour")
    for number, name in enumerate(("GREY", "RED", "BLUE")):
        colour.value.add(name=name, number=number)
    every = file.message_type.add(name="Every")
    nested = every.nested_type.add(name="Nested")
    nested.field.add(name="word", number=1, type=9, label=1)
    for number, name in enumerate(SCALARS, 1):
        if name == "-":
            continue
        kind = {"type_name": ".test.Colour"} if name == "enum" else {}
        every.field.add(name=f"one_{name}", number=number, type=number, label=1, **kind)
        every.field.add(name=f"many_{name}", number=100 + number, type=number, label=3, **kind)
    every.field.add(name="point", number=200, type=11, label=1, type_name=".test.deep.Point")
    every.field.add(name="points", number=3000, type=11, label=3, type_name=".test.deep.Point")
    every.field.add(name="tree", number=202, type=11, label=1, type_name=".test.deep.Tree")
    every.field.add(name="nested", number=203, type=11, label=3, type_name=".test.Every.Nested")
    every.oneof_decl.add(name="choice")
    every.field.add(name="this", number=204, type=13, label=1, oneof_index=0)
    every.field.add(name="that", number=205, type=2, label=1, oneof_index=0)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(inner)
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("test.Every"))


RANGES = {
    "i8": (-128, 127),
    "u8": (0, 255),
    "i16": (-(2**15), 2**15 - 1),
    "u16": (0, 2**16 - 1),
    "i32": (-(2**31), 2**31 - 1),
    "u32": (0, 2**32 - 1),
    "i64": (-(2**63), 2**63 - 1),
    "u64": (0, 2**64 - 1),
}


def whole(chance, kind):
    low, high = RANGES[kind]
    return chance.choice([low, high, 0, 1, chance.randint(low, high)])


def single(chance):
    value = chance.choice([0.0, 1.5, chance.uniform(-1e6, 1e6), float("inf")])
    return struct.unpack("<f", struct.pack("<f", value))[0]


def double(chance):
    return chance.choice([0.0, -1.5, chance.gauss(0, 1e9), float("nan"), 1e-300])


def text(chance):
    return chance.choice(["", "a", "attitude", "Grüße aus Höhenflug", "x" * chance.randint(0, 40)])


def some(chance, make, most=5):
    return [make(chance) for _ in range(chance.randint(0, most))]


def plain(chance):
    values = {name: whole(chance, name) for name in RANGES}
    return values | {
        "yes": chance.random() < 0.5,
        "octet": chance.randint(0, 255),
        "f32": single(chance),
        "f64": double(chance),
        "text": text(chance),
    }


def inner(chance):
    return {"a": chance.randint(0, 255), "b": double(chance)}


def space(values):
    if isinstance(values, dict):
        return SimpleNamespace(**{name: space(value) for name, value in values.items()})
    if isinstance(values, list):
        return [space(value) for value in values]
    return values


def second_ros(chance, index):
    def one(chance):
        return inner(chance) | {"nothing": {}}

    return space(
        plain(chance)
        | {
            "header": {"stamp": {"sec": 1_700_000_000 + index, "nanosec": 5}, "frame_id": "base_link"},
            "three": [double(chance) for _ in range(3)],
            "some": some(chance, single, 9),
            "doubles": some(chance, double),
            "blob": [chance.randint(0, 255) for _ in range(chance.randint(0, 300))],
            "few": some(chance, lambda c: whole(c, "i16"), 4),
            "short_text": "short",
            "texts": some(chance, text),
            "inner": one(chance),
            "pair": [one(chance), one(chance)],
            "inners": some(chance, one, 3),
            "last": True,
        }
    )


def first_ros(types, chance, index):
    import io

    time = types["test_msgs/Every"]().moment.__class__
    duration = types["test_msgs/Every"]().span.__class__

    def one(chance):
        return types["test_msgs/Inner"](**inner(chance))

    values = plain(chance)
    del values["octet"]
    message = types["test_msgs/Every"](
        header=types["std_msgs/Header"](seq=index, stamp=time(7, index), frame_id="map"),
        moment=time(1, 2),
        span=duration(-3, 4),
        three=[double(chance) for _ in range(3)],
        some=some(chance, single, 9),
        blob=bytes(chance.randint(0, 255) for _ in range(chance.randint(0, 300))),
        two=[1, whole(chance, "u16")],
        texts=some(chance, text),
        inner=one(chance),
        inners=some(chance, one, 3),
        **values,
    )
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


def protobuf(every, chance):
    message = every()
    makers = {
        "double": double,
        "float": single,
        "bool": lambda c: c.random() < 0.5,
        "string": text,
        "bytes": lambda c: bytes(c.randint(0, 9)),
        "enum": lambda c: c.randint(0, 2),
    }
    for name, kind in (("int32", "i32"), ("sint32", "i32"), ("sfixed32", "i32"), ("uint32", "u32"), ("fixed32", "u32")):
        makers[name] = lambda c, kind=kind: whole(c, kind)
        makers[name.replace("32", "64")] = lambda c, kind=kind.replace("32", "64"): whole(c, kind)
    for name, make in makers.items():
        if chance.random() < 0.8:
            setattr(message, f"one_{name}", make(chance))
        getattr(message, f"many_{name}").extend(some(chance, make))
    if chance.random() < 0.7:
        message.point.x = double(chance)
    for _ in range(chance.randint(0, 3)):
        message.points.add(y=double(chance))
    message.tree.leaves = 3
    message.tree.branches.add(leaves=1).branches.add(leaves=2)
    for _ in range(chance.randint(0, 2)):
        message.nested.add(word=text(chance))
    if chance.random() < 0.5:
        message.this = 5
    else:
        message.that = 2.5
    return message.SerializeToString()


def as_json(chance, index):
    values = {
        "index": index,
        "speed": chance.gauss(20, 5),
        "huge": 2**60 + index,
        "on": chance.random() < 0.5,
        "name": text(chance),
        "nothing": None,
        "pose": {"position": {"x": chance.gauss(0, 1), "y": -0.0}, "list": some(chance, lambda c: c.gauss(0, 1))},
        "objects": some(chance, lambda c: {"id": c.randint(0, 9), "words": some(c, text, 2)}, 3),
    }
    if index % 2:
        values["sometimes"] = 1.25
    return json.dumps(values).encode()


def write(question):
    chance = random.Random(question["seed"])
    packing = {"": CompressionType.NONE, "lz4": CompressionType.LZ4, "zstd": CompressionType.ZSTD}
    with open(question["path"], "wb") as file:
        writer = Writer(
            file,
            chunk_size=4000,
            compression=packing[question["packing"]],
            use_chunking=question["chunks"],
            enable_data_crcs=True,
        )
        writer.start(profile="test", library="by the format's authors")
        every = protobuf_types()
        types = dynamic.generate_dynamic("test_msgs/Every", FIRST_ROS)
        encode = serialize_dynamic("test_msgs/msg/Every", SECOND_ROS)["test_msgs/msg/Every"]
        kinds = [
            ("test_msgs/msg/Every", "ros2msg", SECOND_ROS.encode(), "cdr", lambda i: encode(second_ros(chance, i))),
            ("test_msgs/Every", "ros1msg", FIRST_ROS.encode(), "ros1", lambda i: first_ros(types, chance, i)),
            (
                "test.Every",
                "protobuf",
                build_file_descriptor_set(every).SerializeToString(),
                "protobuf",
                lambda i: protobuf(every, chance),
            ),
            ("Every", "jsonschema", b'{"type":"object"}', "json", lambda i: as_json(chance, i)),
        ]
        channels = []
        for name, form, data, encoding, make in kinds:
            schema = writer.register_schema(name, form, data)
            channel = writer.register_channel(f"/{encoding}", encoding, schema, {"made": "here"})
            channels.append((channel, make))
        writer.add_metadata("place", {"latitude": "46.8", "name": "Küste"})
        writer.add_attachment(1, 2, "notes.txt", "text/plain", bytes(range(256)) * 3)
        for index in range(40):
            for number, (channel, make) in enumerate(channels):
                time = START + index * 100_000_000 + number
                writer.add_message(channel, time, make(index), time - index % 2 * 1000, index)
        writer.finish()


question = json.load(sys.stdin)
write(question)
messages = []
with open(question["path"], "rb") as file:
    reader = make_reader(file, validate_crcs=True, decoder_factories=DECODERS)
    for schema, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
        fields = {}
        put("", decoded, fields)
        messages.append([channel.topic, schema.name, message.log_time, message.publish_time, fields])
    metadata = [[f"{m.name}: {k}", v] for m in reader.iter_metadata() for k, v in m.metadata.items()]
    attachments = [a.name for a in reader.iter_attachments()]
json.dump({"messages": messages, "metadata": metadata, "attachments": attachments}, sys.stdout)
