//! Writes small MCAP files with messages of every kind of schema.

use std::io::Write as _;

/// Compression of chunks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum McapPacking {
    /// There are none: messages stand by themselves.
    NoChunks,
    /// Not at all.
    Not,
    /// LZ4.
    Lz4,
    /// Zstandard.
    Zstandard,
}

impl McapPacking {
    /// Every way.
    pub const ALL: [Self; 4] = [Self::NoChunks, Self::Not, Self::Lz4, Self::Zstandard];
}

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
const SECOND_ROS: &str = "std_msgs/Header header\nfloat64[3] three\nfloat32[] some\nstring name\nInner[] inner\n===\n\
    MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n===\nMSG: a/Inner\nuint8 a\nfloat64 b\n";
const FIRST_ROS: &str = "Header header\nuint8[] blob\nint16 word\ntime moment\n";

/// Letters after their number.
fn text(letters: &[u8]) -> Vec<u8> {
    [&(letters.len() as u32).to_le_bytes(), letters].concat()
}

fn record(kind: u8, parts: &[&[u8]]) -> Vec<u8> {
    let contents = parts.concat();
    [
        &[kind][..],
        &(contents.len() as u64).to_le_bytes(),
        &contents,
    ]
    .concat()
}

/// A field of Protocol Buffers that is bytes.
fn nested(number: u8, bytes: &[u8]) -> Vec<u8> {
    [&[number << 3 | 2, bytes.len() as u8], bytes].concat()
}

/// A descriptor of a field: name, number, label, type.
fn field(name: &str, number: u8, label: u8, kind: u8, type_name: &str) -> Vec<u8> {
    let numbers = [0x18, number, 0x20, label, 0x28, kind];
    let type_name = if type_name.is_empty() {
        Vec::new()
    } else {
        nested(6, type_name.as_bytes())
    };
    nested(
        2,
        &[nested(1, name.as_bytes()), numbers.to_vec(), type_name].concat(),
    )
}

fn descriptors() -> Vec<u8> {
    let tree = [
        nested(1, b"Tree"),
        field("x", 1, 1, 1, ""),
        field("id", 2, 1, 17, ""),
        field("words", 3, 3, 9, ""),
        field("packed", 4, 3, 13, ""),
        field("more", 5, 3, 11, ".p.Tree"),
    ];
    let file = [
        nested(1, b"p.proto"),
        nested(2, b"p"),
        nested(4, &tree.concat()),
        nested(12, b"proto3"),
    ];
    nested(1, &file.concat())
}

fn schemas() -> Vec<u8> {
    let schema = |number: u16, name: &str, form: &str, data: &[u8]| {
        record(
            3,
            &[
                &number.to_le_bytes(),
                &text(name.as_bytes()),
                &text(form.as_bytes()),
                &text(data),
            ],
        )
    };
    let channel = |number: u16, schema: u16, topic: &str, form: &str| {
        let numbers = [number.to_le_bytes(), schema.to_le_bytes()].concat();
        record(
            4,
            &[
                &numbers,
                &text(topic.as_bytes()),
                &text(form.as_bytes()),
                &[0; 4],
            ],
        )
    };
    [
        schema(1, "a/msg/Second", "ros2msg", SECOND_ROS.as_bytes()),
        schema(2, "a/First", "ros1msg", FIRST_ROS.as_bytes()),
        schema(3, "p.Tree", "protobuf", &descriptors()),
        channel(1, 1, "/second", "cdr"),
        channel(2, 2, "/first", "ros1"),
        channel(3, 3, "/tree", "protobuf"),
        channel(4, 0, "/json", "json"),
    ]
    .concat()
}

/// Contents of message `index` of a channel.
fn contents(channel: u16, index: u64) -> Vec<u8> {
    let byte = index as u8;
    let float = (index as f64 * 0.75).to_le_bytes();
    match channel {
        1 => {
            let mut data = [
                &[0, 1, 0, 0][..],
                &[byte, 0, 0, 0, 7, 0, 0, 0],
                &text(b"map\0"),
                &float,
                &float,
            ]
            .concat();
            data.extend(float);
            let some = index % 3;
            data.extend((some as u32).to_le_bytes());
            (0..some).for_each(|i| data.extend((i as f32).to_le_bytes()));
            data.extend(text(b"abc\0"));
            data.extend((index as u32 % 2).to_le_bytes());
            if index % 2 == 1 {
                // Eight bytes begin at a multiple of eight behind the head.
                data.push(9);
                data.resize(4 + (data.len() - 4).next_multiple_of(8), 0);
                data.extend(float);
            }
            data
        }
        2 => [
            &[byte, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0][..],
            &text(b"x"),
            &text(&[1, 2, 3]),
            &[byte, 1],
            &[5; 8],
        ]
        .concat(),
        3 => {
            let leaf = [
                &[0x09][..],
                &float,
                &[0x10, byte & 0x7f],
                &nested(3, b"w"),
                &nested(4, &[1, 2, 3]),
            ]
            .concat();
            [leaf.clone(), nested(5, &leaf)].concat()
        }
        _ => format!("{{\"i\":{index},\"a\":{{\"b\":[1.5,{byte}]}},\"s\":\"{index}\",\"t\":true}}")
            .into_bytes(),
    }
}

fn messages(first: u64, count: u64) -> Vec<u8> {
    let one = |index: u64| {
        let channel = 1 + (index % 4) as u16;
        let time = (1_700_000_000_000_000_000 + 10_000_000 * index).to_le_bytes();
        let published = if index.is_multiple_of(5) {
            [0; 8]
        } else {
            time
        };
        record(
            5,
            &[
                &channel.to_le_bytes(),
                &[0; 4],
                &time,
                &published,
                &contents(channel, index),
            ],
        )
    };
    (first..first + count).flat_map(one).collect()
}

fn chunk(packing: McapPacking, records: &[u8]) -> Vec<u8> {
    let (name, packed) = match packing {
        McapPacking::NoChunks => return records.to_vec(),
        McapPacking::Not => ("", records.to_vec()),
        McapPacking::Lz4 => {
            let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
            encoder.write_all(records).expect("memory takes it");
            ("lz4", encoder.finish().expect("memory takes it"))
        }
        McapPacking::Zstandard => {
            use ruzstd::encoding::{CompressionLevel, compress_to_vec};
            ("zstd", compress_to_vec(records, CompressionLevel::Fastest))
        }
    };
    let checksum = crc32fast::hash(records).to_le_bytes();
    let [size, length] = [records.len() as u64, packed.len() as u64].map(u64::to_le_bytes);
    record(
        6,
        &[
            &[0; 16],
            &size,
            &checksum,
            &text(name.as_bytes()),
            &length,
            &packed,
        ],
    )
}

/// A file of `count` messages of four kinds, `in_chunk` of them together, with a summary.
pub fn file(packing: McapPacking, count: u64, in_chunk: u64) -> Vec<u8> {
    let mut file = [MAGIC, &record(1, &[&text(b"test"), &text(b"by hand")])].concat();
    for first in (0..count).step_by(in_chunk as usize) {
        let described = if first == 0 { schemas() } else { Vec::new() };
        let records = [described, messages(first, in_chunk.min(count - first))].concat();
        file.extend(chunk(packing, &records));
    }
    let attached = [
        &[0; 16][..],
        &text(b"a.txt"),
        &text(b"text/plain"),
        &3_u64.to_le_bytes(),
        b"abc",
    ]
    .concat();
    file.extend(record(
        9,
        &[&attached, &crc32fast::hash(&attached).to_le_bytes()],
    ));
    file.extend(record(
        12,
        &[&text(b"site"), &text(&[text(b"a"), text(b"b")].concat())],
    ));
    file.extend(record(15, &[&crc32fast::hash(&file).to_le_bytes()]));
    let summary = [
        schemas(),
        record(11, &[&count.to_le_bytes(), &[0; 34], &[0; 4]]),
    ]
    .concat();
    let start = (file.len() as u64).to_le_bytes();
    file.extend(summary);
    file.extend(record(2, &[&start, &[0; 8], &[0; 4]]));
    file.extend(MAGIC);
    file
}
