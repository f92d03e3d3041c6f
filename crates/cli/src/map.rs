//! `pilotage map`: what a map is, and pictures out of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Point2;
use pilotage_core::frames::{
    Geodetic, GroundPoint, GroundRect, LocalFrame, ReferenceSystem, wrap_pi,
};
use pilotage_core::imagery::systems;
use pilotage_core::imagery::terrain::{Dem, Terrain};
use pilotage_core::imagery::{GeoTiffFile, Georeference, Imagery, Placement, Window};
use pilotage_core::mission::{MapFileError, MapOptions, OpenMap, open_dem, open_map_with};
use pilotage_core::raster::encode_png_with_coverage;
use serde::Serialize;

use crate::CommandResult;
use crate::files::{DirectoryFiles, DiskFile};
use crate::numbers::{lat_lon, numbers};
use crate::opening::foreign_words;

/// Endings of pictures, which may be maps.
const PICTURES: [&str; 6] = ["png", "jpg", "jpeg", "webp", "tif", "tiff"];
/// Most pixels of a picture that is written.
const MOST_PIXELS: usize = 100_000_000;

/// Arguments of `pilotage map`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    job: MapCommand,
}

#[derive(clap::Subcommand)]
enum MapCommand {
    /// Say what a map is and where it lies, as JSON.
    Info {
        #[command(flatten)]
        map: MapArguments,
        /// A place of which the height is wanted, where the file is an elevation model.
        #[arg(long, value_name = "LAT,LON", allow_hyphen_values = true)]
        height_at: Option<String>,
    },
    /// Write a north-up picture out of a map.
    Tile {
        #[command(flatten)]
        map: MapArguments,
        /// PNG to write.
        #[arg(long)]
        out: PathBuf,
        /// Part of the map: column and row of its first pixel in the map, and its width and height in the
        /// map's pixels. The whole map if absent.
        #[arg(
            long,
            value_name = "COLUMN,ROW,WIDTH,HEIGHT",
            allow_hyphen_values = true
        )]
        window: Option<String>,
        /// Metres per pixel of the picture; what the map has, or what makes it 2048 pixels wide.
        #[arg(long)]
        gsd: Option<f64>,
    },
    /// Put a picture on the ground by points that are known in both.
    Georef(crate::georef::Arguments),
}

#[derive(clap::Args)]
struct MapArguments {
    /// `GeoTIFF`, `PMTiles`, JPEG or PNG with a world file or a georeference beside it, or a table (CSV) of several
    /// pictures with the latitude and longitude of their corners, KMZ or KML with a picture on the ground; for info also
    /// elevation models (.hgt, .asc, .xyz).
    file: PathBuf,
    /// Reference system of the map's coordinates, before what its files say, e.g. EPSG:32617.
    #[arg(long)]
    system: Option<String>,
}

/// Description of a map.
#[derive(Serialize)]
struct Info {
    file: String,
    kind: &'static str,
    /// Pixels; zero for tiles, which have many sizes.
    width: usize,
    height: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    reference_system: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    epsg: Option<u32>,
    gsd_m: f64,
    width_m: f64,
    height_m: f64,
    /// Latitude and longitude in degrees of the corners, from the top left one clockwise.
    corners_lat_lon: Option<[[f64; 2]; 4]>,
    #[serde(flatten)]
    pixels: Option<Pixels>,
    #[serde(flatten)]
    tiles: Option<TileArchiveSummary>,
    /// Number of pictures that it is made of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures: Option<usize>,
    #[serde(flatten)]
    heights: Option<ElevationSummary>,
}

/// Description of an archive of tiles.
#[derive(Serialize)]
struct TileArchiveSummary {
    /// Coarsest and deepest.
    zooms: (u8, u8),
    attribution: Option<String>,
}

/// Storage of the pixels of a `GeoTIFF`.
#[derive(Serialize)]
struct Pixels {
    samples: usize,
    sample: String,
    compression: String,
    cut: String,
    overviews: Vec<[usize; 2]>,
    has_mask: bool,
    no_data: Option<f64>,
}

/// Description of an elevation model.
#[derive(Serialize)]
struct ElevationSummary {
    #[serde(rename = "heights_above")]
    above: String,
    /// Name of the frame that heights are in.
    #[serde(rename = "height_frame")]
    frame: &'static str,
    height_in_the_middle_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_at_place_m: Option<f64>,
}

/// Does what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    match &arguments.job {
        MapCommand::Info { map, height_at } => info(map, height_at.as_deref()),
        MapCommand::Tile {
            map,
            out,
            window,
            gsd,
        } => tile(map, out, window.as_deref(), *gsd),
        MapCommand::Georef(arguments) => crate::georef::run(arguments),
    }
}

impl MapArguments {
    fn system(&self) -> Result<Option<ReferenceSystem>, String> {
        let Some(name) = &self.system else {
            return Ok(None);
        };
        let found = systems::by_name(name).map_err(|cause| format!("--system: {cause}"))?;
        Ok(Some(found))
    }

    fn name(&self) -> String {
        let name = self.file.file_name();
        name.map(|n| n.to_string_lossy().into_owned())
            .unwrap_or_default()
    }

    fn has_ending(&self, endings: &[&str]) -> bool {
        pilotage_disk::opening::has_ending(&self.file, endings)
    }
}

fn info(arguments: &MapArguments, height_at: Option<&str>) -> CommandResult {
    let system = arguments.system()?;
    let place = height_at.map(|at| lat_lon(at, "--height-at")).transpose()?;
    let is_tiff = arguments.has_ending(&["tif", "tiff"]);
    let is_height = arguments.has_ending(&["hgt", "asc", "xyz"]);
    if place.is_some() && !is_tiff && !is_height {
        return Err(format!(
            "--height-at: {} is no elevation model; a GeoTIFF, a .hgt file or a grid of text (.asc, .xyz) may be one: `gdal_translate` makes a GeoTIFF of other models",
            arguments.name()
        )
        .into());
    }
    // Who asks for a height says by that what the samples are.
    let is_elevation =
        is_height || place.is_some() || disk_file(arguments).is_ok_and(|file| Dem::is_one(file));
    let info = if is_elevation {
        elevation(arguments, system, place)?
    } else {
        picture(arguments, system)?
    };
    println!("{}", serde_json::to_string_pretty(&info)?);
    Ok(())
}

fn geo_tiff(
    arguments: &MapArguments,
    system: Option<ReferenceSystem>,
) -> Result<GeoTiffFile, Box<dyn std::error::Error>> {
    Ok(GeoTiffFile::open(disk_file(arguments)?, None, system)?)
}

fn disk_file(arguments: &MapArguments) -> Result<Arc<DiskFile>, String> {
    let file = DiskFile::open(&arguments.file, &arguments.name());
    file.map(Arc::new)
        .map_err(|e| format!("{}: {e}", arguments.file.display()))
}

fn elevation(
    arguments: &MapArguments,
    system: Option<ReferenceSystem>,
    place: Option<Geodetic>,
) -> Result<Info, Box<dyn std::error::Error>> {
    let frame = place.map(LocalFrame::new);
    let directory = DirectoryFiles::around(&arguments.file)?;
    let dem = open_dem(&directory, &arguments.name(), frame, system)?;
    let (width, height) = dem.placement().size();
    let middle = Point2::new(0.5 * width as f64, 0.5 * height as f64);
    let file = geo_tiff(arguments, system).ok();
    for note in dem.notes() {
        eprintln!("note: {note}");
    }
    let heights = ElevationSummary {
        above: dem.datum().name().to_owned(),
        frame: dem.datum().frame(),
        height_in_the_middle_m: dem.height_at(&dem.placement().ground_at(&middle)),
        height_at_place_m: place.and_then(|_| dem.height_at(&GroundPoint::default())),
    };
    if let Some(problem) = dem.problem() {
        return Err(problem.into());
    }
    if let Some(place) = place.filter(|_| heights.height_at_place_m.is_none()) {
        let pixel = dem.placement().pixel_at(&GroundPoint::default());
        let is_inside = pixel.is_some_and(|pixel| {
            (0.0..=width as f64).contains(&pixel.x) && (0.0..=height as f64).contains(&pixel.y)
        });
        let cause = if is_inside {
            "data are missing there"
        } else {
            "the model does not reach there"
        };
        return Err(format!(
            "--height-at: {} has no height at {}, {}: {cause}",
            arguments.name(),
            place.latitude.to_degrees(),
            place.longitude.to_degrees(),
        )
        .into());
    }
    let geographic = ReferenceSystem::Geographic;
    let system = match &file {
        Some(file) => system_of(&file.georeference),
        None => dem
            .placement()
            .georeference()
            .map_or(Some(geographic), system_of),
    };
    Ok(Info {
        file: arguments.name(),
        kind: "elevation model",
        width,
        height,
        reference_system: system.map(|s| s.name()),
        epsg: system.and_then(|s| s.epsg()),
        gsd_m: dem.spacing(),
        width_m: dem.bounds().width(),
        height_m: dem.bounds().height(),
        corners_lat_lon: corners(dem.placement()),
        pixels: file.as_ref().map(pixels),
        tiles: None,
        pictures: None,
        heights: Some(heights),
    })
}

fn picture(
    arguments: &MapArguments,
    system: Option<ReferenceSystem>,
) -> Result<Info, Box<dyn std::error::Error>> {
    let file = if arguments.has_ending(&["tif", "tiff"]) {
        geo_tiff(arguments, system).ok()
    } else {
        None
    };
    let map = open(arguments, system)?;
    for note in map.notes() {
        eprintln!("note: {note}");
    }
    let placement = map.placement();
    let (width, height) = match &map {
        OpenMap::Mosaic(mosaic) => mosaic.size(),
        _ => placement.map_or((0, 0), Placement::size),
    };
    let tiles = match &map {
        OpenMap::PmTiles(tiles) => Some(TileArchiveSummary {
            zooms: tiles.zooms(),
            attribution: tiles.attribution().map(str::to_owned),
        }),
        _ => None,
    };
    let system = match tiles {
        Some(_) => ReferenceSystem::from_epsg(3857),
        None => file.as_ref().and_then(|f| system_of(&f.georeference)),
    };
    Ok(Info {
        file: arguments.name(),
        kind: match map {
            OpenMap::Picture(_) => "picture with a georeference beside it",
            OpenMap::GeoTiff(_) => "GeoTIFF",
            OpenMap::PmTiles(_) => "PMTiles",
            OpenMap::Mosaic(_) => "several pictures",
        },
        width,
        height,
        reference_system: system.map(|s| s.name()),
        epsg: system.and_then(|s| s.epsg()),
        gsd_m: map.native_gsd(),
        width_m: map.bounds().width(),
        height_m: map.bounds().height(),
        corners_lat_lon: match (&map, placement) {
            (OpenMap::PmTiles(tiles), _) => Some(corners_of(&tiles.bounds(), tiles.frame())),
            (OpenMap::Mosaic(mosaic), _) => Some(corners_of(&mosaic.bounds(), mosaic.frame())),
            (_, placement) => placement.and_then(corners),
        },
        pixels: file.as_ref().map(pixels),
        tiles,
        pictures: match &map {
            OpenMap::Mosaic(mosaic) => Some(mosaic.count()),
            _ => None,
        },
        heights: None,
    })
}

fn system_of(georeference: &Georeference) -> Option<ReferenceSystem> {
    match georeference {
        Georeference::Projected { system, .. } => Some(*system),
        _ => None,
    }
}

/// The corners by the georeference itself, which is exact where the plane of the world does not reach.
fn corners(placement: &Placement) -> Option<[[f64; 2]; 4]> {
    placement.frame()?;
    let (width, height) = placement.size();
    let (w, h) = (width as f64, height as f64);
    // Both ends of a map of the world stay apart.
    let is_world = placement
        .turn()
        .is_some_and(|turn| turn.norm() <= w.max(h) + 1e-6);
    let corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)].map(|(x, y)| {
        let place = placement.place_at(&Point2::new(x, y))?;
        let longitude = place.longitude.to_degrees();
        let is_wrapped = longitude.abs() > 180.0 + 1e-9 && !is_world;
        let longitude = if is_wrapped {
            wrap_pi(place.longitude).to_degrees()
        } else {
            longitude
        };
        Some([place.latitude.to_degrees(), longitude])
    });
    let [Some(a), Some(b), Some(c), Some(d)] = corners else {
        return None;
    };
    Some([a, b, c, d])
}

/// The corners of `rect` from the north-west one on, as degrees of latitude and longitude.
fn corners_of(rect: &GroundRect, frame: &LocalFrame) -> [[f64; 2]; 4] {
    let mut corners = rect.corners();
    corners.reverse();
    corners.map(|corner| degrees(frame, &corner))
}

/// Degrees of latitude and longitude of a place.
fn degrees(frame: &LocalFrame, place: &GroundPoint) -> [f64; 2] {
    let place = frame.geodetic_from_ground(place);
    [place.latitude.to_degrees(), place.longitude.to_degrees()]
}

fn pixels(file: &GeoTiffFile) -> Pixels {
    let layout = &file.tiff.levels()[0];
    Pixels {
        samples: layout.samples,
        sample: format!("{:?}", layout.kind),
        compression: format!("{:?}", layout.compression),
        cut: if layout.is_tiled {
            format!("tiles of {} × {}", layout.chunk_width, layout.chunk_height)
        } else {
            "strips".to_owned()
        },
        overviews: (file.tiff.levels()[1..].iter())
            .map(|level| [level.width, level.height])
            .collect(),
        has_mask: file.tiff.mask(0).is_some(),
        no_data: layout.no_data,
    }
}

fn open(
    arguments: &MapArguments,
    system: Option<ReferenceSystem>,
) -> Result<OpenMap, Box<dyn std::error::Error>> {
    let directory = DirectoryFiles::around(&arguments.file)?;
    let options = MapOptions {
        system,
        ..MapOptions::default()
    };
    let map = open_map_with(&directory, &arguments.name(), &options);
    Ok(map.map_err(|error| {
        // What is of another kind is called by its name.
        let is_bare = matches!(error, MapFileError::NoGeoreference { .. });
        let is_foreign = error.is_of_another_kind() || is_bare && !arguments.has_ending(&PICTURES);
        let named = is_foreign.then(|| foreign_words(&arguments.file)).flatten();
        named.unwrap_or_else(|| error.to_string())
    })?)
}

fn tile(
    arguments: &MapArguments,
    out: &Path,
    window: Option<&str>,
    gsd: Option<f64>,
) -> CommandResult {
    let map = open(arguments, arguments.system()?)?;
    for note in map.notes() {
        eprintln!("note: {note}");
    }
    let rect = match (window, map.placement()) {
        (None, _) => map.bounds(),
        (Some(_), None) => {
            return Err("--window: tiles and several pictures have no one size of pixels".into());
        }
        (Some(text), Some(placement)) => {
            let [column, row, width, height] = numbers(text, "--window")?;
            let corners = [
                (column, row),
                (column + width, row),
                (column, row + height),
                (column + width, row + height),
            ];
            let ground = |(x, y)| placement.ground_at(&Point2::new(x, y));
            let rect = GroundRect::around(corners.map(ground)).unwrap_or(map.bounds());
            if !rect.overlaps(&map.bounds()) {
                return Err(format!("--window: {text} is not on the map").into());
            }
            rect
        }
    };
    let usual = map.native_gsd().max(rect.width() / 2048.0);
    let gsd = gsd.unwrap_or(usual);
    let pixels = rect.width() / gsd * (rect.height() / gsd);
    if !(gsd > 0.0 && pixels.is_finite() && pixels <= MOST_PIXELS as f64) {
        return Err(format!("a picture of {pixels:.0} pixels; choose a larger --gsd").into());
    }
    let picture = map.window(&Window::covering(&rect, gsd));
    for problem in map.problems() {
        eprintln!("note: {problem}");
    }
    crate::files::write_whole(out, encode_png_with_coverage(&picture)?)?;
    println!(
        "{}: {} × {} pixels of {gsd:.3} m",
        out.display(),
        picture.width(),
        picture.height()
    );
    Ok(())
}
