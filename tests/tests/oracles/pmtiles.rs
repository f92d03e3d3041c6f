//! An archive of tiles that Protomaps' own library wrote and reads.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::imagery::MemoryBytes;
use pilotage_core::imagery::web_tiles::{PmTiles, TileNumber, TileStore};
use pilotage_tests::oracle::{ask, bytes_of_hex};
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    path: PathBuf,
    format: &'static str,
}

/// Zoom, column, row, number, bytes and pixels.
type Tile = (u8, u32, u32, u64, Option<String>, Option<String>);

#[derive(Deserialize)]
struct Archive {
    zooms: (u8, u8),
    leaves: u64,
    corners: [f64; 4],
    attribution: String,
    tiles: Vec<Tile>,
}

/// The archive as it is told and as it is read here; `None` without the oracle.
fn archive(format: &'static str) -> Option<(Archive, PmTiles)> {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{format}.pmtiles"));
    let question = Question {
        path: path.clone(),
        format,
    };
    let answer = ask::<_, Archive>("pmtiles_archive.py", &question)?;
    let bytes = std::fs::read(&path).unwrap();
    let archive = PmTiles::open(Arc::new(MemoryBytes::new("tiles.pmtiles", bytes))).unwrap();
    Some((answer, archive))
}

/// Largest difference of a colour of a tile from that in `theirs`, red, green and blue by pixel.
fn furthest(archive: &PmTiles, tile: &TileNumber, theirs: &[u8]) -> u8 {
    let ours = archive.tile(tile).unwrap().unwrap();
    assert_eq!(ours.pixels().len() * 3, theirs.len(), "{tile:?}");
    let pairs = ours.pixels().iter().zip(theirs.chunks_exact(3));
    let differences = pairs.flat_map(|(a, b)| (0..3).map(|i| a[i].abs_diff(b[i])));
    differences.max().unwrap()
}

/// Checks that the archive lies where it is told to and names its makers.
fn compare_head(answer: &Archive, archive: &PmTiles) {
    let (low, high) = archive.corners();
    let ours = [low.latitude, low.longitude, high.latitude, high.longitude];
    for (ours, theirs) in ours.iter().zip(answer.corners) {
        assert!((ours.to_degrees() - theirs).abs() < 1e-7, "{ours} {theirs}");
    }
    assert!(answer.attribution.contains("&copy; Map makers</a>"));
    let shown = archive.metadata().attribution.as_deref();
    assert_eq!(shown, Some("© Map makers & others"));
    assert_eq!(archive.metadata().name.as_deref(), Some("A map"));
}

#[test]
fn every_tile_and_what_an_archive_says_of_itself_are_as_protomaps_reads_them() {
    for (format, most) in [("png", 0), ("jpeg", 2)] {
        let Some((answer, archive)) = archive(format) else {
            return;
        };
        compare_head(&answer, &archive);
        assert_eq!(archive.zooms(), answer.zooms);
        assert_eq!(archive.side(), 8);
        assert!(answer.leaves > 0, "the archive is too small to have leaves");
        let mut found = 0;
        for (zoom, x, y, id, bytes, pixels) in &answer.tiles {
            let tile = TileNumber {
                zoom: *zoom,
                x: *x,
                y: *y,
            };
            assert_eq!(tile.hilbert(), *id, "{tile:?}");
            let ours = archive.bytes(&tile).unwrap();
            assert_eq!(ours, bytes.as_deref().map(bytes_of_hex), "{tile:?}");
            if let Some(pixels) = pixels {
                let off = furthest(&archive, &tile, &bytes_of_hex(pixels));
                assert!(off <= most, "{format} {tile:?}: {off}");
                found += 1;
            }
        }
        println!("{format}: {} asked for, {found} there", answer.tiles.len());
        assert!(found > 500);
    }
}
