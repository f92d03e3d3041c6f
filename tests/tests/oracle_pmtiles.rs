//! An archive of tiles that Protomaps' own library wrote.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::imagery::MemoryBytes;
use pilotage_core::imagery::web_tiles::{PmTiles, TileNumber, TileStore};
use pilotage_tests::oracle::{ask, bytes_of_hex};
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    path: PathBuf,
}

#[derive(Deserialize)]
struct Archive {
    zooms: (u8, u8),
    tiles: Vec<(u8, u32, u32, u64, Option<String>)>,
}

#[test]
fn every_tile_has_the_number_and_the_bytes_that_protomaps_gave_it() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("tiles.pmtiles");
    let question = Question { path: path.clone() };
    let Some(answer) = ask::<_, Archive>("pmtiles_archive.py", &question) else {
        return;
    };
    let bytes = std::fs::read(&path).unwrap();
    let archive = PmTiles::open(Arc::new(MemoryBytes::new("tiles.pmtiles", bytes))).unwrap();
    assert_eq!(archive.zooms(), answer.zooms);
    assert_eq!(archive.side(), 8);
    let mut found = 0;
    for (zoom, x, y, id, theirs) in &answer.tiles {
        let tile = TileNumber {
            zoom: *zoom,
            x: *x,
            y: *y,
        };
        assert_eq!(tile.hilbert(), *id, "{tile:?}");
        let ours = archive.bytes(&tile).unwrap();
        assert_eq!(ours, theirs.as_deref().map(bytes_of_hex), "{tile:?}");
        found += usize::from(theirs.is_some());
    }
    println!("{} tiles asked for, {found} there", answer.tiles.len());
    assert!(found > 500);
}
