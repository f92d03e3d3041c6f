//! Maps against rasterio and pyproj: every kind of file, pixel by pixel and place by place.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use nalgebra::Point2;
use pilotage_core::frames::{Geodetic, GroundPoint, LocalFrame, ReferenceSystem, wrap_pi};
use pilotage_core::imagery::tiff::{TiffFile, TileSamples};
use pilotage_core::imagery::{
    ByteSource, GeoTiff, GeoTiffFile, Imagery, MapMemory, MemoryBytes, Window,
};
use pilotage_tests::data::shared;
use pilotage_tests::oracle::{ask, bytes_of_hex};
use pilotage_tests::pyproj::{self, Coordinates};
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    directory: PathBuf,
    files: Vec<PathBuf>,
}

#[derive(Deserialize)]
struct File {
    name: String,
    path: PathBuf,
    lossy: bool,
    dtype: String,
    #[serde(flatten)]
    picture: Pixels,
    overviews: Vec<Pixels>,
    epsg: u32,
    transform: [f64; 6],
    points: Vec<[f64; 8]>,
}

/// The samples of a picture or an overview.
#[derive(Deserialize)]
struct Pixels {
    /// Height, width, bands.
    shape: [usize; 3],
    samples: String,
    valid: String,
}

impl File {
    /// The picture and its overviews, from the finest on.
    fn levels(&self) -> impl Iterator<Item = &Pixels> {
        std::iter::once(&self.picture).chain(&self.overviews)
    }

    fn open(&self) -> GeoTiffFile {
        let bytes = std::fs::read(&self.path).unwrap();
        let source: Arc<dyn ByteSource> = Arc::new(MemoryBytes::new(self.name.clone(), bytes));
        GeoTiffFile::open(source, None, None).unwrap_or_else(|error| panic!("{error}"))
    }

    fn frame(&self) -> LocalFrame {
        let [height, width, _] = self.picture.shape;
        let [a, b, c, d, e, f] = self.transform;
        let (x, y) = (0.5 * width as f64, 0.5 * height as f64);
        let system = ReferenceSystem::from_epsg(self.epsg).unwrap();
        let middle = system.geodetic(a * x + b * y + c, d * x + e * y + f);
        LocalFrame::new(middle.unwrap())
    }

    /// All samples of a level as real numbers.
    fn samples(&self, level: &Pixels) -> Vec<f64> {
        let bytes = bytes_of_hex(&level.samples);
        macro_rules! reals {
            ($kind:ty) => {
                (bytes.chunks_exact(size_of::<$kind>()))
                    .map(|v| <$kind>::from_le_bytes(v.try_into().unwrap()).into())
                    .collect()
            };
        }
        match self.dtype.as_str() {
            "uint8" => reals!(u8),
            "int8" => reals!(i8),
            "uint16" => reals!(u16),
            "int16" => reals!(i16),
            "uint32" => reals!(u32),
            "int32" => reals!(i32),
            "float32" => reals!(f32),
            "float64" => reals!(f64),
            other => panic!("{other}"),
        }
    }
}

/// All files, written and asked for once.
fn files() -> Option<&'static [File]> {
    static FILES: OnceLock<Option<Vec<File>>> = OnceLock::new();
    let files = FILES.get_or_init(|| {
        let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("maps");
        let files = shared("deepforest_neon/OSBS_029.tif").into_iter().collect();
        ask("rasterio_maps.py", &Question { directory, files })
    });
    files.as_deref()
}

/// All samples of a level, put together from its tiles.
fn all_samples(file: &TiffFile, level: usize) -> Vec<f64> {
    let layout = &file.levels()[level];
    let n = layout.samples;
    let mut all = vec![f64::NAN; layout.width * layout.height * n];
    for row in 0..layout.down() {
        for column in 0..layout.across() {
            let chunk = file
                .chunk(level, column, row)
                .unwrap_or_else(|error| panic!("{error}"));
            let real = |i: usize| chunk.as_ref().map_or(0.0, |c| c.samples.real(i));
            let height = chunk.as_ref().map_or(layout.chunk_height, |c| c.height);
            for y in 0..height.min(layout.height - row * layout.chunk_height) {
                for x in 0..layout
                    .chunk_width
                    .min(layout.width - column * layout.chunk_width)
                {
                    let to = (row * layout.chunk_height + y) * layout.width
                        + column * layout.chunk_width
                        + x;
                    for band in 0..n {
                        all[to * n + band] = real((y * layout.chunk_width + x) * n + band);
                    }
                }
            }
        }
    }
    all
}

/// The window of one pixel of a level of `width` × `height` pixels, seen exactly.
fn colour_at(map: &GeoTiff, (width, height): (usize, usize), column: usize, row: usize) -> [u8; 4] {
    let whole = map.placement().size();
    let (right, down) = (
        whole.0 as f64 / width as f64,
        whole.1 as f64 / height as f64,
    );
    let middle = Point2::new((column as f64 + 0.5) * right, (row as f64 + 0.5) * down);
    let ground = map.placement().ground_at(&middle);
    let gsd = map.native_gsd() * right;
    let window = Window {
        north_edge: ground.north + 0.5 * gsd,
        west_edge: ground.east - 0.5 * gsd,
        gsd,
        width: 1,
        height: 1,
    };
    map.window(&window).get(0, 0)
}

#[test]
fn samples_of_pictures_and_overviews_are_those_of_rasterio() {
    let Some(files) = files() else { return };
    let mut furthest_lossy: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    let (mut overviews, mut compared) = (0, 0);
    for file in files {
        let tiff = file.open().tiff;
        let sizes: Vec<_> = tiff.levels().iter().map(|l| (l.height, l.width)).collect();
        let known: Vec<_> = file.levels().map(|l| (l.shape[0], l.shape[1])).collect();
        assert_eq!(sizes, known, "{}: sizes of the levels", file.name);
        for (level, theirs) in file.levels().enumerate() {
            let name = format!("{}, level {level}", file.name);
            let ours = all_samples(&tiff, level);
            let theirs = file.samples(theirs);
            assert_eq!(ours.len(), theirs.len(), "{name}");
            overviews += usize::from(level > 0);
            compared += ours.len();
            let pairs = ours.iter().zip(&theirs);
            if file.lossy {
                let differences: Vec<f64> = pairs.map(|(a, b)| (a - b).abs()).collect();
                let furthest = differences.iter().copied().fold(0.0, f64::max);
                let mean = differences.iter().sum::<f64>() / differences.len() as f64;
                furthest_lossy.insert(name, (mean, furthest));
                continue;
            }
            // What is no number is none in both.
            let differs = |(a, b): (&f64, &f64)| a != b && !(a.is_nan() && b.is_nan());
            let other = pairs.into_iter().position(differs);
            assert_eq!(other, None, "{name}: first different sample");
        }
    }
    println!(
        "{} files with {overviews} overviews, {compared} samples; {} levels are JPEG",
        files.len(),
        furthest_lossy.len()
    );
    assert!(overviews > 100);
    for (name, (mean, furthest)) in &furthest_lossy {
        println!("{name}: mean difference {mean:.2}, largest {furthest}");
    }
    for (name, (mean, furthest)) in furthest_lossy {
        // Decoders round differently, and interpolate halved colour differently.
        let halved = name.contains("ycbcr");
        assert!(mean < if halved { 1.0 } else { 0.1 }, "{name}: {mean}");
        assert!(
            furthest <= if halved { 10.0 } else { 2.0 },
            "{name}: {furthest}"
        );
    }
}

#[test]
fn corners_and_a_thousand_points_of_every_map_lie_where_pyproj_puts_them() {
    let Some(files) = files() else { return };
    for file in files {
        let frame = file.frame();
        let placement = file.open().placement(&frame).unwrap();
        let mut furthest: f64 = 0.0;
        let mut back: f64 = 0.0;
        for &[column, row, x, y, latitude, longitude, north, east] in &file.points {
            let ours = placement.ground_at(&Point2::new(column, row));
            furthest = furthest.max(ours.distance(&GroundPoint::new(north, east)));
            let pixel = placement.pixel_at(&ours).unwrap();
            back = back.max((pixel - Point2::new(column, row)).norm() * placement.gsd());
            let system = ReferenceSystem::from_epsg(file.epsg).unwrap();
            let place = system.geodetic(x, y).unwrap();
            let theirs = Geodetic::from_degrees(latitude, longitude, 0.0);
            let off = (place.latitude - theirs.latitude)
                .hypot((place.longitude - theirs.longitude) * theirs.latitude.cos());
            assert!(off * 6.4e6 < 1e-6, "{}: {off} rad", file.name);
        }
        if !file.points.is_empty() {
            println!(
                "{}: {} points, furthest {furthest:.1e} m, there and back {back:.1e} m",
                file.name,
                file.points.len()
            );
        }
        assert!(furthest < 1e-3, "{}: {furthest} m", file.name);
        assert!(back < 1e-3, "{}: {back} m", file.name);
    }
}

#[test]
fn the_colours_of_a_map_stand_where_its_samples_do() {
    let Some(files) = files() else { return };
    let mut looked_at = 0;
    for file in files {
        let is_picture = matches!(file.dtype.as_str(), "uint8" | "uint16");
        let is_other = file.name == "white-is-zero" || file.name.starts_with("bits");
        if !is_picture || file.lossy || is_other {
            continue;
        }
        let opened = file.open();
        let alpha = opened.tiff.levels()[0].alpha.map(|(band, _)| band);
        let map = GeoTiff::new(opened, &file.frame(), MapMemory::default()).unwrap();
        for level in file.levels() {
            looked_at += compare_colours(file, level, &map, alpha);
        }
        assert!(map.problems().is_empty(), "{:?}", map.problems());
    }
    println!("{looked_at} pixels");
    assert!(looked_at > 10_000);
}

/// Compares some colours of a level and says of how many pixels.
fn compare_colours(file: &File, level: &Pixels, map: &GeoTiff, alpha: Option<usize>) -> usize {
    let (samples, valid) = (file.samples(level), bytes_of_hex(&level.valid));
    let [height, width, bands] = level.shape;
    let name = format!("{}, {width} × {height}", file.name);
    let mut looked_at = 0;
    for row in (0..height).step_by(7) {
        for column in (row % 5..width).step_by(9) {
            let pixel = &samples[(row * width + column) * bands..][..bands];
            let scale = 255.0 / f64::from(map.white());
            let colours = bands - usize::from(alpha.is_some());
            let shown = |band: usize| (pixel[band] * scale).round() as i32;
            let grey = colours < 3;
            let theirs = [0, 1, 2].map(|band| shown(if grey { 0 } else { band }));
            let ours = colour_at(map, (width, height), column, row);
            if let Some(band) = alpha {
                let whole = if file.dtype == "uint8" {
                    255.0
                } else {
                    65_535.0
                };
                let covered = (pixel[band] / whole * 255.0).round() as i32;
                assert!((i32::from(ours[3]) - covered).abs() <= 1, "{name}");
            } else if file.name != "sparse" {
                assert_eq!(ours[3], valid[row * width + column], "{name}");
            }
            if ours[3] == 0 {
                continue;
            }
            for (a, b) in ours.iter().zip(theirs) {
                assert!(
                    (i32::from(*a) - b).abs() <= 1,
                    "{name} at {column}, {row}: {ours:?}, not {theirs:?}"
                );
            }
            looked_at += 1;
        }
    }
    looked_at
}

#[test]
fn samples_with_a_sign_are_no_picture() {
    let Some(files) = files() else { return };
    let file = files.iter().find(|f| f.name == "no-data").unwrap();
    let opened = file.open();
    let chunk = opened.tiff.chunk(0, 0, 0).unwrap().unwrap();
    assert!(matches!(chunk.samples, TileSamples::I16(_)));
    let refused = GeoTiff::new(opened, &file.frame(), MapMemory::default());
    let message = refused.err().unwrap().to_string();
    assert!(message.contains("terrain"), "{message}");
}

#[test]
fn every_utm_zone_and_the_web_map_agree_with_pyproj_to_a_hundredth_of_a_millimetre() {
    let mut cases = Vec::new();
    let codes = (32_601..=32_660).chain(32_701..=32_760).chain([3857, 4326]);
    for epsg in codes {
        let system = ReferenceSystem::from_epsg(epsg).unwrap();
        let middle = match system {
            ReferenceSystem::Utm { zone, .. } => 6.0 * f64::from(zone) - 183.0,
            _ => 11.0,
        };
        let sign = if (32_700..33_000).contains(&epsg) {
            -1.0
        } else {
            1.0
        };
        let places: Vec<Geodetic> = (0..40)
            .map(|i| {
                let (i, turn) = (f64::from(i), 0.61 * f64::from(i));
                let latitude = sign * (0.5 + 2.1 * i);
                Geodetic::from_degrees(latitude, middle + 4.5 * turn.sin(), 0.0)
            })
            .collect();
        let coordinates = (places.iter())
            .map(|place| system.coordinates(place).unwrap().into())
            .collect();
        let first = places[7];
        cases.push((
            Coordinates {
                epsg,
                coordinates,
                origin: [
                    first.latitude.to_degrees(),
                    first.longitude.to_degrees(),
                    120.0,
                ],
            },
            places,
        ));
    }
    let (cases, places): (Vec<_>, Vec<_>) = cases.into_iter().unzip();
    let Some(answer) = pyproj::places(&cases) else {
        return;
    };
    let mut furthest: f64 = 0.0;
    let mut on_plane: f64 = 0.0;
    for ((case, places), answers) in cases.iter().zip(places).zip(answer) {
        let [latitude, longitude, height] = case.origin;
        let frame = LocalFrame::new(Geodetic::from_degrees(latitude, longitude, height));
        for (place, [latitude, longitude, north, east]) in places.iter().zip(answers) {
            let theirs = Geodetic::from_degrees(latitude, longitude, 0.0);
            let off = (place.latitude - theirs.latitude)
                .hypot(wrap_pi(place.longitude - theirs.longitude) * place.latitude.cos());
            furthest = furthest.max(off * 6_378_137.0);
            // The plane is of use near its origin only.
            if (place.latitude - frame.origin.latitude).abs() < 0.1 {
                let ours = frame.ground_from_geodetic(place);
                on_plane = on_plane.max(ours.distance(&GroundPoint::new(north, east)));
            }
        }
    }
    println!("furthest on the globe {furthest:.1e} m, on the plane {on_plane:.1e} m");
    assert!(furthest < 1e-5, "{furthest} m");
    assert!(on_plane < 1e-3, "{on_plane} m");
}
