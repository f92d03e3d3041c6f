//! An MCAP file written record by record.

use std::io::Write as _;

use super::super::MAGIC;

/// A file so far.
#[derive(Clone)]
pub(super) struct Written(pub Vec<u8>);

/// Letters after their number.
pub(super) fn text(letters: &str) -> Vec<u8> {
    counted(letters.as_bytes())
}

fn counted(bytes: &[u8]) -> Vec<u8> {
    let length = u32::try_from(bytes.len()).expect("a test is short");
    [&length.to_le_bytes(), bytes].concat()
}

/// Any record.
pub(super) fn record(kind: u8, parts: &[&[u8]]) -> Vec<u8> {
    let contents = parts.concat();
    let length = contents.len() as u64;
    [&[kind][..], &length.to_le_bytes(), &contents].concat()
}

pub(super) fn schema(number: u16, name: &str, encoding: &str, data: &[u8]) -> Vec<u8> {
    let parts: [&[u8]; 4] = [
        &number.to_le_bytes(),
        &text(name),
        &text(encoding),
        &counted(data),
    ];
    record(3, &parts)
}

pub(super) fn channel(number: u16, schema: u16, topic: &str, encoding: &str) -> Vec<u8> {
    let numbers = [number.to_le_bytes(), schema.to_le_bytes()].concat();
    record(4, &[&numbers, &text(topic), &text(encoding), &[0; 4]])
}

/// A message logged and published at a time in nanoseconds.
pub(super) fn message(channel: u16, time: u64, data: &[u8]) -> Vec<u8> {
    let time = time.to_le_bytes();
    record(5, &[&channel.to_le_bytes(), &[0; 4], &time, &time, data])
}

/// Compression of a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Not,
    Lz4,
    Zstandard,
}

pub(super) const PACKINGS: [Packing; 3] = [Packing::Not, Packing::Lz4, Packing::Zstandard];

/// A chunk of these records.
pub(super) fn chunk(packing: Packing, records: &[u8]) -> Vec<u8> {
    let (name, packed) = match packing {
        Packing::Not => ("", records.to_vec()),
        Packing::Lz4 => {
            use lz4_flex::frame::{BlockSize, FrameEncoder, FrameInfo};
            let form = FrameInfo::new().block_size(BlockSize::Max64KB);
            let mut encoder = FrameEncoder::with_frame_info(form, Vec::new());
            encoder.write_all(records).expect("memory takes it");
            ("lz4", encoder.finish().expect("memory takes it"))
        }
        Packing::Zstandard => {
            use ruzstd::encoding::{CompressionLevel, compress_to_vec};
            ("zstd", compress_to_vec(records, CompressionLevel::Fastest))
        }
    };
    let checksum = crc32fast::hash(records).to_le_bytes();
    let [size, length] = [records.len() as u64, packed.len() as u64].map(u64::to_le_bytes);
    record(
        6,
        &[&[0; 16], &size, &checksum, &text(name), &length, &packed],
    )
}

impl Written {
    /// The beginning of a file.
    pub fn new() -> Self {
        Self(MAGIC.to_vec()).and(&record(1, &[&text("test"), &text("by hand")]))
    }

    pub fn and(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    /// The end of a file that says how many messages it has, with the records `again` in its summary.
    pub fn end(self, messages: u64, again: &[u8]) -> Vec<u8> {
        let data = crc32fast::hash(&self.0);
        let file = self.and(&record(15, &[&data.to_le_bytes()]));
        let start = file.0.len();
        let statistics = record(11, &[&messages.to_le_bytes(), &[0; 34], &[0; 4]]);
        let mut file = file.and(again).and(&statistics);
        let begin = (start as u64).to_le_bytes();
        let footer = record(2, &[&begin, &[0; 8], &[0; 4]]);
        file.0.extend_from_slice(&footer[..footer.len() - 4]);
        let summary = crc32fast::hash(&file.0[start..]);
        file.and(&summary.to_le_bytes()).and(&MAGIC).0
    }
}

/// Schema and channel of the messages of [`messages`].
pub(super) fn description() -> Vec<u8> {
    let text = b"float64 angle\nfloat32[] rates\nstring name\nuint8[2] flags\n";
    let schema = schema(3, "my_msgs/msg/Turn", "ros2msg", text);
    [schema, channel(7, 3, "/turn", "cdr")].concat()
}

/// So many messages from `first` on, a tenth of a second apart.
pub(super) fn messages(first: u64, count: u64) -> Vec<u8> {
    let one = |index: u64| {
        let rates = index % 3;
        let mut data = vec![0, 1, 0, 0];
        data.extend((index as f64 / 8.0).to_le_bytes());
        data.extend((rates as u32).to_le_bytes());
        (0..rates).for_each(|rate| data.extend((rate as f32 + 0.5).to_le_bytes()));
        data.extend([4, 0, 0, 0, b'o', b'n', b'e', 0]);
        data.extend([index as u8, 9]);
        message(7, 1_700_000_000_000_000_000 + 100_000_000 * index, &data)
    };
    (first..first + count).flat_map(one).collect()
}

/// A whole flight of `count` messages, ten in a chunk, or none in chunks.
pub(super) fn flight(count: u64, packing: Option<Packing>) -> Vec<u8> {
    let mut file = Written::new();
    match packing {
        None => file = file.and(&description()).and(&messages(0, count)),
        Some(packing) => {
            for first in (0..count).step_by(10) {
                let before = if first == 0 {
                    description()
                } else {
                    Vec::new()
                };
                let records = [before, messages(first, 10.min(count - first))].concat();
                file = file.and(&chunk(packing, &records));
            }
        }
    }
    file.end(count, &description())
}
