//! Costs of the engines, which tell the faster one for each size.
//!
//! The constants are nanoseconds measured on one core of a 2023 server (AVX2) and, for
//! WebAssembly, in Chromium on the same machine; only their ratio matters, and being 30 % wrong
//! near the break-even costs little.

use super::fourier::good_length;

/// Nanoseconds for one multiply-add of the direct engine.
const DIRECT: f64 = if cfg!(target_arch = "wasm32") {
    0.12
} else {
    0.024
};
/// Nanoseconds per sample and per doubling of the length for one real transform.
const FOURIER: f64 = if cfg!(target_arch = "wasm32") {
    0.4
} else {
    0.085
};
/// Nanoseconds per sample for the passes around a transform.
const AROUND: f64 = if cfg!(target_arch = "wasm32") {
    1.2
} else {
    0.6
};
/// Pictures up to this many pixels are transformed in one piece.
const ONE_PIECE: usize = 1 << 17;

/// Nanoseconds for the direct correlation.
pub(super) fn direct(columns: usize, rows: usize, width: usize, height: usize) -> f64 {
    // A block computes four rows from height + 3 rows of the search.
    let offsets = columns.next_multiple_of(8) * rows.next_multiple_of(4);
    DIRECT * (offsets * width * (height + 3)) as f64
}

/// Nanoseconds for `transforms` transforms over `length` samples.
pub(super) fn fourier(length: usize, transforms: f64) -> f64 {
    let length = length as f64;
    transforms * length * (FOURIER * length.log2() + AROUND)
}

/// Size of the tiles in which to search a picture: its own size if one piece is best.
pub(super) fn tile(
    search_width: usize,
    search_height: usize,
    width: usize,
    height: usize,
) -> (usize, usize) {
    let whole = (search_width, search_height);
    if search_width * search_height <= ONE_PIECE || search_width < width || search_height < height {
        return whole;
    }
    let (columns, rows) = (search_width - width + 1, search_height - height + 1);
    if direct(columns, rows, width, height)
        <= fourier(good_length(search_width * search_height), 2.0)
    {
        return whole;
    }
    let cost = |(tile_width, tile_height): (usize, usize)| {
        let tiles =
            columns.div_ceil(tile_width - width + 1) * rows.div_ceil(tile_height - height + 1);
        let length = good_length(tile_width * tile_height);
        // Out of the second-level cache every pass costs more.
        let slow = if length > ONE_PIECE { 1.5 } else { 1.0 };
        slow * fourier(length, 2.0 * tiles as f64 + 1.0)
    };
    [128, 192, 256, 320, 384, 512, 768]
        .into_iter()
        .map(|side: usize| {
            (
                side.max(width).min(search_width),
                side.max(height).min(search_height),
            )
        })
        .chain([whole])
        .min_by(|&a, &b| cost(a).total_cmp(&cost(b)))
        .unwrap_or(whole)
}
