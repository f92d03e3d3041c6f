//! Points of real pictures whose class people told.

use std::path::{Path, PathBuf};

use pilotage_raster::imagery::decode_map;
use pilotage_raster::raster::{Gray, Raster, Rgba};
use pilotage_vision::ground_class::{CLASS_GSD, GroundCover};
use serde_json::Value;

/// Ground in a pixel of the grid on which places were traced, metres.
const TRACED_GSD: f64 = 0.5;

/// Ground in a pixel of windows whose words are told, metres, and their side, pixels: 24 m, in which most points show
/// one class.
pub const FINE_GSD: f64 = 0.3;
pub const WINDOW: usize = 80;

/// A point and its class.
pub struct Patch {
    /// Place (x, y), pixels of the picture of the site.
    pub pixel: [f64; 2],
    /// Class that the label names.
    pub cover: GroundCover,
}

/// A picture with the points that were told in it.
pub struct PatchSite {
    pub name: &'static str,
    /// North up, [`CLASS_GSD`] metres per pixel.
    pub picture: Raster<Rgba>,
    /// The same in [`FINE_GSD`].
    pub fine: Gray,
    pub patches: Vec<Patch>,
}

/// Names of the places, their pictures, and what of the picture was traced: column, row, width, height.
const SITES: [(&str, &str, Option<[usize; 4]>); 4] = [
    ("brighton_beach", "brighton_beach/ortho.jpg", None),
    ("caliterra", "caliterra/ortho.png", None),
    (
        "adm2014",
        "adm2014/map_january.jpg",
        Some([1700, 1400, 2730, 1600]),
    ),
    (
        "fengyuan",
        "fengyuan/map.jpg",
        Some([1450, 150, 2645, 3250]),
    ),
];

/// All places of which the pictures are at hand.
pub fn sites() -> Vec<PatchSite> {
    SITES.into_iter().filter_map(site).collect()
}

impl PatchSite {
    /// The window around a point, as far as the picture goes.
    pub fn window(&self, patch: &Patch) -> Gray {
        let corner = [0, 1].map(|i| {
            let size = [self.fine.width(), self.fine.height()][i];
            let middle = patch.pixel[i] * CLASS_GSD / FINE_GSD;
            (middle as usize)
                .saturating_sub(WINDOW / 2)
                .min(size - WINDOW)
        });
        self.fine
            .crop(corner[0], corner[1], WINDOW, WINDOW)
            .unwrap()
    }
}

fn beside(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let place = root.join(name);
    if place.exists() {
        return Some(place);
    }
    println!("skipped: no {name}");
    None
}

/// Class of a label; a place where cars stand is paved.
fn cover_of(label: &str) -> Option<GroundCover> {
    match label {
        "parking" | "road" => Some(GroundCover::Paved),
        label => GroundCover::named(label),
    }
}

fn site((name, picture, part): (&'static str, &str, Option<[usize; 4]>)) -> Option<PatchSite> {
    let trace = beside(&format!("tests/data/traces/{name}.geojson"))?;
    let file = beside(&format!("../shared/data/{picture}"))?;
    let json: Value = serde_json::from_slice(&std::fs::read(trace).unwrap()).unwrap();
    let whole = decode_map(&std::fs::read(file).unwrap(), true).unwrap();
    let [x, y, width, height] = part.unwrap_or([0, 0, whole.width(), whole.height()]);
    let native = whole.crop(x, y, width, height).unwrap();
    let pair = |value: &Value| [0, 1].map(|i| value[i].as_f64().unwrap());
    let grid = &json["picture"];
    let (corner, step) = (pair(&grid["corner"]), pair(&grid["pixel_deg"]));
    let size = |gsd: f64| pair(&grid["size"]).map(|pixels| (pixels * TRACED_GSD / gsd) as usize);
    let features = json["features"].as_array().unwrap();
    let patches = features.iter().filter_map(|feature| {
        let told = &feature["properties"];
        let is_patch = told["kind"] == "patch";
        let [lon, lat] = is_patch.then(|| pair(&feature["geometry"]["coordinates"]))?;
        let metres = [(lon - corner[0]) / step[0], (corner[1] - lat) / step[1]];
        Some(Patch {
            pixel: metres.map(|pixels| pixels * TRACED_GSD / CLASS_GSD),
            cover: cover_of(told["class"].as_str()?)?,
        })
    });
    Some(PatchSite {
        name,
        patches: patches.collect(),
        picture: averaged(&native, size(CLASS_GSD)),
        fine: averaged(&native, size(FINE_GSD)).to_gray(),
    })
}

/// The picture in so many pixels, each the mean of those that it covers; clear where there are none.
fn averaged(native: &Raster<Rgba>, [width, height]: [usize; 2]) -> Raster<Rgba> {
    let range = |at: usize, count: usize, size: usize| {
        let from = (at * size / count).min(size - 1);
        from..((at + 1) * size).div_ceil(count).clamp(from + 1, size)
    };
    Raster::from_fn(width, height, |column, row| {
        let (mut sum, mut count) = ([0_u32; 3], 0);
        for y in range(row, height, native.height()) {
            for pixel in &native.row(y)[range(column, width, native.width())] {
                if pixel[3] > 0 {
                    count += 1;
                    (0..3).for_each(|i| sum[i] += u32::from(pixel[i]));
                }
            }
        }
        let [red, green, blue] = sum.map(|s| (s / count.max(1)) as u8);
        [red, green, blue, if count > 0 { 255 } else { 0 }]
    })
}
