//! Compressed copies beside the files of the page.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use brotli::{CompressorWriter, enc::BrotliEncoderParams};
use flate2::{Compression, write::GzEncoder};

use super::{files, side_by_side::side_by_side};
use crate::failure::Failure;

/// Endings of files that shrink; pictures are compressed already.
const SHRINKING: [&str; 9] = [
    "bin",
    "css",
    "html",
    "js",
    "json",
    "mjs",
    "svg",
    "wasm",
    "webmanifest",
];

/// `file.ending` with `.br` or `.gz` behind it.
pub fn beside(file: &Path, ending: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// Writes a `.br` of the given quality (0 to 11) and a `.gz` beside every file that shrinks.
pub fn folder(dist: &Path, brotli_quality: u32) -> Result<(), Failure> {
    let shrinks = |file: &PathBuf| {
        let ending = file.extension().and_then(|ending| ending.to_str());
        SHRINKING.contains(&ending.unwrap_or_default())
    };
    let mut left = files::below(dist)?;
    left.retain(shrinks);
    side_by_side(&left, |file| {
        let place = dist.join(file);
        let content = fs::read(&place).map_err(Failure::file(&place))?;
        let brotli = beside(&place, "br");
        write_brotli(&brotli, &content, brotli_quality).map_err(Failure::file(&brotli))?;
        let gzip = beside(&place, "gz");
        write_gzip(&gzip, &content).map_err(Failure::file(&gzip))
    })
}

fn write_brotli(place: &Path, content: &[u8], quality: u32) -> std::io::Result<()> {
    let parameters = BrotliEncoderParams {
        quality: quality.cast_signed(),
        lgwin: 22,
        size_hint: content.len(),
        ..BrotliEncoderParams::default()
    };
    let file = fs::File::create(place)?;
    let mut writer = CompressorWriter::with_params(file, 1 << 16, &parameters);
    writer.write_all(content)?;
    writer.flush()
}

fn write_gzip(place: &Path, content: &[u8]) -> std::io::Result<()> {
    let mut writer = GzEncoder::new(fs::File::create(place)?, Compression::best());
    writer.write_all(content)?;
    writer.finish()?;
    Ok(())
}
