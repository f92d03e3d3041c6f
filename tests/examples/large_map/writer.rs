//! Streams a tiled `GeoTIFF` to disk: rows in, tiles out, no more than a row of tiles in memory.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use flate2::{Compression, write::ZlibEncoder};

const WIDTH: usize = 22_167;
const HEIGHT: usize = 25_100;
const TILE: usize = 256;
/// Side of a pixel, metres.
const GSD: f64 = 0.3;

/// Level of the map: rows that wait for a whole row of tiles, and the tiles that are written.
struct Level {
    width: usize,
    height: usize,
    rows: Vec<u8>,
    /// Row that waits for the one below it, to become half a row of the next level.
    odd: Option<Vec<u8>>,
    pushed: usize,
    offsets: Vec<u32>,
    counts: Vec<u32>,
}

struct Output {
    file: BufWriter<File>,
    place: u32,
}

impl Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<u32> {
        let at = self.place;
        self.file.write_all(bytes)?;
        self.place += bytes.len() as u32;
        Ok(at)
    }
}

/// Writes the map to `path`.
pub fn write(path: &Path, has_overviews: bool) -> io::Result<()> {
    let mut levels = vec![Level::new(WIDTH, HEIGHT)];
    while has_overviews
        && let Some(last) = levels.last()
        && last.width > TILE
    {
        levels.push(Level::new(last.width / 2, last.height / 2));
    }
    let mut output = Output {
        file: BufWriter::new(File::create(path)?),
        place: 0,
    };
    output.write(b"II\x2a\0\0\0\0\0")?;
    for row in 0..HEIGHT {
        let pixels = (0..WIDTH).flat_map(|column| colour(column, row)).collect();
        push(&mut levels, pixels, &mut output)?;
        if row % 2048 == 0 {
            println!("row {row} of {HEIGHT}");
        }
    }
    for level in &mut levels {
        level.flush(&mut output)?;
    }
    let first = directories(&levels, &mut output)?;
    let Output { mut file, .. } = output;
    file.flush()?;
    let mut file = file.into_inner()?;
    io::Seek::seek(&mut file, io::SeekFrom::Start(4))?;
    file.write_all(&first.to_le_bytes())
}

/// Fields of one colour with fine texture: compresses about as well as a photograph.
fn colour(column: usize, row: usize) -> [u8; 3] {
    let mix = |a: usize, b: usize| {
        let mut z = (a as u64) << 32 | b as u64;
        z = (z ^ (z >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let field = mix(column / 700, row / 500).to_le_bytes();
    let grain = (mix(column / 2, row / 2) & 31) as u8;
    [
        60 + field[0] / 3 + grain,
        70 + field[1] / 3 + grain,
        50 + field[2] / 4 + grain,
    ]
}

fn push(levels: &mut [Level], row: Vec<u8>, output: &mut Output) -> io::Result<()> {
    let Some((level, coarser)) = levels.split_first_mut() else {
        return Ok(());
    };
    if level.pushed == level.height {
        return Ok(());
    }
    level.rows.extend(&row);
    level.pushed += 1;
    if level.rows.len() == TILE * level.width * 3 {
        level.flush(output)?;
    }
    if coarser.is_empty() {
        return Ok(());
    }
    let Some(above) = level.odd.take() else {
        level.odd = Some(row);
        return Ok(());
    };
    let halved = (0..coarser[0].width * 3)
        .map(|i| {
            let left = i / 3 * 6 + i % 3;
            let sum = [above[left], above[left + 3], row[left], row[left + 3]];
            ((sum.iter().map(|v| u16::from(*v)).sum::<u16>() + 2) / 4) as u8
        })
        .collect();
    push(coarser, halved, output)
}

impl Level {
    fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            rows: Vec::new(),
            odd: None,
            pushed: 0,
            offsets: Vec::new(),
            counts: Vec::new(),
        }
    }

    /// Writes the rows that wait as a row of tiles.
    fn flush(&mut self, output: &mut Output) -> io::Result<()> {
        if self.rows.is_empty() {
            return Ok(());
        }
        let stride = self.width * 3;
        for left in (0..self.width).step_by(TILE) {
            let mut tile = vec![0; TILE * TILE * 3];
            let bytes = (self.width - left).min(TILE) * 3;
            let rows = self.rows.chunks_exact(stride);
            for (to, row) in tile.chunks_exact_mut(TILE * 3).zip(rows) {
                to[..bytes].copy_from_slice(&row[left * 3..][..bytes]);
            }
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(&tile)?;
            let packed = encoder.finish()?;
            self.offsets.push(output.write(&packed)?);
            self.counts.push(packed.len() as u32);
        }
        self.rows.clear();
        Ok(())
    }
}

/// Writes the directories of all levels; gives the place of the first.
fn directories(levels: &[Level], output: &mut Output) -> io::Result<u32> {
    let mut next = 0_u32;
    for (index, level) in levels.iter().enumerate().rev() {
        let long = |v: usize| (4_u16, (v as u32).to_le_bytes().to_vec());
        let shorts = |v: &[u16]| (3_u16, v.iter().flat_map(|v| v.to_le_bytes()).collect());
        let longs = |v: &[u32]| (4_u16, v.iter().flat_map(|v| v.to_le_bytes()).collect());
        let doubles = |v: &[f64]| (12_u16, v.iter().flat_map(|v| v.to_le_bytes()).collect());
        let mut tags: Vec<(u16, (u16, Vec<u8>))> = vec![
            (254, long(usize::from(index > 0))),
            (256, long(level.width)),
            (257, long(level.height)),
            (258, shorts(&[8, 8, 8])),
            (259, shorts(&[8])),
            (262, shorts(&[2])),
            (277, shorts(&[3])),
            (322, shorts(&[TILE as u16])),
            (323, shorts(&[TILE as u16])),
            (324, longs(&level.offsets)),
            (325, longs(&level.counts)),
        ];
        if index == 0 {
            let keys = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32_615];
            let corner = [0.0, 0.0, 0.0, 570_000.0, 5_190_000.0, 0.0];
            tags.push((33_550, doubles(&[GSD, GSD, 0.0])));
            tags.push((33_922, doubles(&corner)));
            tags.push((34_735, shorts(&keys)));
        }
        let mut entries = (tags.len() as u16).to_le_bytes().to_vec();
        for (tag, (kind, values)) in tags {
            let size = [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8][usize::from(kind)];
            entries.extend(tag.to_le_bytes());
            entries.extend(kind.to_le_bytes());
            entries.extend(((values.len() / size) as u32).to_le_bytes());
            if values.len() > 4 {
                entries.extend(output.write(&values)?.to_le_bytes());
            } else {
                let mut inline = values;
                inline.resize(4, 0);
                entries.extend(inline);
            }
        }
        entries.extend(next.to_le_bytes());
        next = output.write(&entries)?;
    }
    Ok(next)
}
