//! OpenStreetMap's PBF: blocks of Protocol Buffers, compressed one by one.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::error::RoadFileError;
use super::globe_road::RoadsRead;
use super::open_street_map::{OsmData, OsmPass, OsmWay};
use super::protobuf::{ProtobufMessage, deltas, packed};
use pilotage_base::varint::unzigzag;

/// Largest block by the format's own rule, bytes.
const LARGEST_BLOCK: u64 = 32 << 20;

/// Whether these are the first bytes of such a file: the size of a header that names its block.
pub fn is_pbf(bytes: &[u8]) -> bool {
    matches!(bytes, [0, 0, _, _, 0x0a, 9, b'O', b'S', b'M', b'H', ..])
}

/// Reads the roads of a file.
pub fn read(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    OsmData::read(|pass, data| go_through(bytes, pass, data))
}

fn go_through(bytes: &[u8], pass: OsmPass, data: &mut OsmData) -> Result<(), RoadFileError> {
    let mut place = 0;
    let take = |place: &mut usize, count: usize| {
        let end = place.checked_add(count).filter(|end| *end <= bytes.len());
        let end = end.ok_or_else(|| RoadFileError::broken(*place, "the file ends too early"))?;
        let taken = &bytes[*place..end];
        *place = end;
        Ok(taken)
    };
    while place < bytes.len() {
        let size = take(&mut place, 4)?;
        let size = u32::from_be_bytes([size[0], size[1], size[2], size[3]]);
        let mut header = ProtobufMessage::new(take(&mut place, size as usize)?);
        let (mut kind, mut size): (&[u8], usize) = (&[], 0);
        while let Some((field, value)) = header.next()? {
            match field {
                1 => kind = value.bytes(),
                3 => size = value.number().max(0) as usize,
                _ => {}
            }
        }
        let begin = place;
        let block = unpacked(take(&mut place, size)?, begin)?;
        match kind {
            b"OSMHeader" => check_header(&block)?,
            b"OSMData" => read_block(&block, pass, data)?,
            _ => {}
        }
    }
    Ok(())
}

/// Content of a blob that begins at `place` of the file.
fn unpacked(blob: &[u8], place: usize) -> Result<Vec<u8>, RoadFileError> {
    let mut message = ProtobufMessage::new(blob);
    while let Some((field, value)) = message.next()? {
        match field {
            1 => return Ok(value.bytes().to_vec()),
            3 => {
                let mut content = Vec::new();
                let decoder = ZlibDecoder::new(value.bytes());
                let read = decoder.take(LARGEST_BLOCK).read_to_end(&mut content);
                read.map_err(|error| RoadFileError::broken(place, error))?;
                return Ok(content);
            }
            4..=7 => {
                let what = "blocks that are not compressed by zlib";
                return Err(RoadFileError::Unread(what.to_owned()));
            }
            _ => {}
        }
    }
    Ok(Vec::new())
}

/// Refuses files that need what is not read here.
fn check_header(block: &[u8]) -> Result<(), RoadFileError> {
    let mut message = ProtobufMessage::new(block);
    while let Some((field, value)) = message.next()? {
        let feature = value.bytes();
        if field == 4 && ![&b"OsmSchema-V0.6"[..], b"DenseNodes"].contains(&feature) {
            let feature = String::from_utf8_lossy(feature);
            return Err(RoadFileError::Unread(format!("the feature {feature}")));
        }
    }
    Ok(())
}

/// Scale and offsets of a block's places, 1e-9 degrees.
struct Grid {
    step: i64,
    latitude: i64,
    longitude: i64,
}

impl Grid {
    fn node(&self, number: i64, latitude: i64, longitude: i64) -> (i64, f64, f64) {
        let degrees = |offset: i64, steps: i64| {
            1e-9 * offset.wrapping_add(self.step.wrapping_mul(steps)) as f64
        };
        let (longitude, latitude) = (
            degrees(self.longitude, longitude),
            degrees(self.latitude, latitude),
        );
        (number, longitude, latitude)
    }
}

fn read_block(block: &[u8], pass: OsmPass, data: &mut OsmData) -> Result<(), RoadFileError> {
    let mut grid = Grid {
        step: 100,
        latitude: 0,
        longitude: 0,
    };
    let (mut texts, mut groups) = (Vec::new(), Vec::new());
    let mut message = ProtobufMessage::new(block);
    while let Some((field, value)) = message.next()? {
        match field {
            1 => {
                let mut table = ProtobufMessage::new(value.bytes());
                while let Some((_, text)) = table.next()? {
                    texts.push(text.bytes());
                }
            }
            2 => groups.push(value.bytes()),
            17 => grid.step = value.number(),
            19 => grid.latitude = value.number(),
            20 => grid.longitude = value.number(),
            _ => {}
        }
    }
    for group in groups {
        let mut message = ProtobufMessage::new(group);
        while let Some((field, value)) = message.next()? {
            match (field, pass) {
                (1, OsmPass::Nodes) => {
                    let (number, longitude, latitude) = node(value.bytes(), &grid)?;
                    data.add_node(number, longitude, latitude);
                }
                (2, OsmPass::Nodes) => dense_nodes(value.bytes(), &grid, data)?,
                (3, OsmPass::Ways) => data.add_way(way(value.bytes(), &texts)?),
                _ => {}
            }
        }
    }
    Ok(())
}

fn node(bytes: &[u8], grid: &Grid) -> Result<(i64, f64, f64), RoadFileError> {
    let mut message = ProtobufMessage::new(bytes);
    let (mut number, mut latitude, mut longitude) = (0, 0, 0);
    while let Some((field, value)) = message.next()? {
        let signed = unzigzag(value.number().cast_unsigned());
        match field {
            1 => number = signed,
            8 => latitude = signed,
            9 => longitude = signed,
            _ => {}
        }
    }
    Ok(grid.node(number, latitude, longitude))
}

fn dense_nodes(bytes: &[u8], grid: &Grid, data: &mut OsmData) -> Result<(), RoadFileError> {
    let mut message = ProtobufMessage::new(bytes);
    let (mut numbers, mut latitudes, mut longitudes) = (Vec::new(), Vec::new(), Vec::new());
    while let Some((field, value)) = message.next()? {
        match field {
            1 => numbers = deltas(value.bytes())?,
            8 => latitudes = deltas(value.bytes())?,
            9 => longitudes = deltas(value.bytes())?,
            _ => {}
        }
    }
    let places = latitudes.into_iter().zip(longitudes);
    let nodes = numbers.into_iter().zip(places);
    for (number, (latitude, longitude)) in nodes {
        let (number, longitude, latitude) = grid.node(number, latitude, longitude);
        data.add_node(number, longitude, latitude);
    }
    Ok(())
}

fn way(bytes: &[u8], texts: &[&[u8]]) -> Result<OsmWay, RoadFileError> {
    let mut message = ProtobufMessage::new(bytes);
    let (mut way, mut keys, mut values) = (OsmWay::default(), Vec::new(), Vec::new());
    while let Some((field, value)) = message.next()? {
        match field {
            2 => keys = packed(value.bytes())?,
            3 => values = packed(value.bytes())?,
            8 => way.nodes = deltas(value.bytes())?,
            _ => {}
        }
    }
    let text = |index: u64| {
        let bytes = texts.get(index as usize).copied().unwrap_or_default();
        std::str::from_utf8(bytes).unwrap_or_default()
    };
    for (key, value) in keys.into_iter().zip(values) {
        way.tag(text(key), text(value));
    }
    Ok(way)
}
