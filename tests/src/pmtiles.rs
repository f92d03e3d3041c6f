//! A small `PMTiles` archive for tests.

/// An archive of the one tile of zoom 0, a PNG of 128 to 16,383 bytes, with who made it.
#[must_use]
pub fn archive_of_one_tile(tile: &[u8]) -> Vec<u8> {
    let about = br#"{"attribution": "<b>&copy; Whoever</b>"}"#;
    // One entry: tile 0, a run of 1, its length in two groups of seven bits, the first offset.
    let length = tile.len();
    let root = [
        1,
        0,
        1,
        (length & 0x7f) as u8 | 0x80,
        (length >> 7) as u8,
        1,
    ];
    let mut file = b"PMTiles\x03".to_vec();
    let (described, data) = (127 + root.len(), 127 + root.len() + about.len());
    for (place, size) in [
        (127, root.len()),
        (described, about.len()),
        (data, 0),
        (data, length),
    ] {
        file.extend((place as u64).to_le_bytes());
        file.extend((size as u64).to_le_bytes());
    }
    file.resize(97, 0);
    file.extend([1, 1, 2, 0, 0]);
    for degrees in [-92.1, 46.84, -92.06, 46.87] {
        file.extend(((degrees * 1e7) as i32).to_le_bytes());
    }
    file.resize(127, 0);
    [&file, &root[..], about, tile].concat()
}
