//! The colour map viridis (van der Walt and Smith 2015, CC0), which grows lighter evenly and reads the same without
//! red or green.

/// Red, green and blue from 0 to 255 at nine equidistant places, from the least value to the greatest; Matplotlib's
/// `viridis(i / 8)`, rounded.
pub const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];
