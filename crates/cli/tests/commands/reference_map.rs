//! `pilotage reference-map` as a user calls it.

use pilotage_core::raster::{Picture, encode_png};
use pilotage_core::reference::ReferenceTable;

use super::folder::Folder;

#[test]
fn a_map_becomes_a_table_and_the_rows_of_the_thesis() {
    let folder = Folder::new("reference_map");
    // Rough green ground with smooth bright roofs of 12 by 16 m.
    let picture = Picture::from_fn(400, 400, |x, y| {
        let noise = ((x * 7919 + y * 104_729) % 37) as u8;
        let is_roof = (20..44).contains(&(x % 130)) && (30..62).contains(&(y % 130));
        if is_roof {
            [165, 110, 95]
        } else {
            [70 + noise, 92 + noise, 48 + noise]
        }
    });
    folder.write("map.png", encode_png(&picture).unwrap());
    folder.write("map.pgw", b"0.5\n0\n0\n-0.5\n100.25\n-50.25\n");
    let words = [
        "reference-map",
        "map.png",
        "-o",
        "map.table",
        "--pixel-rows",
        "rows.csv",
    ];
    let out = folder.run(&words).unwrap();
    let bytes = std::fs::read(folder.0.join("map.table")).unwrap();
    let table = ReferenceTable::from_bytes(&bytes).unwrap();
    let rows = std::fs::read_to_string(folder.0.join("rows.csv")).unwrap();
    assert_eq!(rows.lines().count(), table.landmarks().len());
    let said = format!("{} landmarks", table.landmarks().len());
    assert!(out.contains(&said), "{out}");
    assert!(
        folder
            .run(&["reference-map", "none.png", "-o", "none.table"])
            .is_err()
    );
}
