//! A map: a `GeoTIFF`, an archive of tiles, a picture and the file beside it that says where it lies, or several pictures
//! and a table of their corners.

use crate::map_error::MapFileError;
use crate::map_options::{MapOptions, frame_of, is_geo_tiff};
use crate::mosaic::{self, Mosaic};
use crate::overlay::{is_overlay, open_overlay};
use crate::place_beside::{mask_beside, place_beside, refuse_unnamed, system_beside};
use crate::web_tiles::{PmTiles, WebTiles};
use crate::{GeoTiff, GeoTiffError, GeoTiffFile};
use pilotage_base::files::FileSet;
use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_base::georeference::Georeference;
use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, Placement, Window, decode_map};
use pilotage_raster::raster::{Raster, Rgba};

/// Farthest from the world's origin that tiles of a web map are used, metres.
const TILES_REACH: f64 = 100_000.0;

/// An open map.
pub enum OpenMap {
    /// A picture, whole in memory.
    Picture(Box<GeoreferencedPicture>),
    /// A `GeoTIFF`, read by pieces.
    GeoTiff(Box<GeoTiff>),
    /// An archive of tiles.
    PmTiles(Box<WebTiles>),
    /// Several pictures.
    Mosaic(Box<Mosaic>),
}

impl OpenMap {
    /// The world frame that the map was put into; `None` if it counts in metres of no place on the
    /// globe.
    pub fn frame(&self) -> Option<&LocalFrame> {
        match self {
            Self::Picture(picture) => picture.placement().frame(),
            Self::GeoTiff(map) => map.placement().frame(),
            Self::PmTiles(map) => Some(map.frame()),
            Self::Mosaic(map) => Some(map.frame()),
        }
    }

    /// Placement of the pixels; `None` for tiles and several pictures, which have many sizes of pixels and no
    /// one place.
    pub fn placement(&self) -> Option<&Placement> {
        match self {
            Self::Picture(picture) => Some(picture.placement()),
            Self::GeoTiff(map) => Some(map.placement()),
            Self::PmTiles(_) | Self::Mosaic(_) => None,
        }
    }

    /// Notes on the map, in sentences that name the file: another datum than WGS 84, a mask that is not read,
    /// pixels of a negative height.
    pub fn notes(&self) -> Vec<String> {
        if let Self::Mosaic(map) = self {
            return map.notes().to_vec();
        }
        let georeference = self.placement().and_then(Placement::georeference);
        let system = georeference.and_then(Georeference::system);
        let note = system.and_then(|system| system.note_on(self.name()));
        let more = match self {
            Self::GeoTiff(map) => map.notes(),
            Self::PmTiles(map) => map.note().map(str::to_owned).into_iter().collect(),
            _ => Vec::new(),
        };
        note.into_iter().chain(more).collect()
    }

    fn imagery(&self) -> &dyn Imagery {
        match self {
            Self::Picture(picture) => picture.as_ref(),
            Self::GeoTiff(map) => map.as_ref(),
            Self::PmTiles(map) => map.as_ref(),
            Self::Mosaic(map) => map.as_ref(),
        }
    }
}

impl Imagery for OpenMap {
    fn name(&self) -> &str {
        self.imagery().name()
    }

    fn bounds(&self) -> GroundRect {
        self.imagery().bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.imagery().native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        self.imagery().window(window)
    }

    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        self.imagery().window_so_far(window)
    }

    fn source(&self) -> Option<&dyn Imagery> {
        Some(self.imagery())
    }
}

/// The map `name` among `files` in the world frame `frame`; a georeference on the globe makes its
/// own frame around its own origin where there is none.
///
/// ```
/// use pilotage_maps::files::{FileSink, MemoryFiles};
/// use pilotage_maps::open_map;
/// use pilotage_raster::imagery::Imagery;
/// use pilotage_raster::raster::{Raster, encode_png};
///
/// // 40 × 20 pixels of 0.5 m with the north-west corner in the origin, by a world file.
/// let picture = encode_png(&Raster::filled(40, 20, [90, 120, 60]))?;
/// let mut files = MemoryFiles::default();
/// files.write("town.png", &picture)?;
/// files.write("town.pgw", b"0.5\n0\n0\n-0.5\n0.25\n-0.25\n")?;
/// let map = open_map(&files, "town.png", None)?;
/// assert_eq!((map.bounds().east, map.bounds().south), (20.0, -10.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn open_map(
    files: &dyn FileSet,
    name: &str,
    frame: Option<LocalFrame>,
) -> Result<OpenMap, MapFileError> {
    let options = MapOptions {
        frame,
        ..MapOptions::default()
    };
    open_map_with(files, name, &options)
}

/// As [`open_map`], with more that is known about the map.
pub fn open_map_with(
    files: &dyn FileSet,
    name: &str,
    options: &MapOptions,
) -> Result<OpenMap, MapFileError> {
    let lower = name.to_ascii_lowercase();
    if lower.ends_with(mosaic::ENDING) {
        return Mosaic::open(files, name, options).map(|map| OpenMap::Mosaic(Box::new(map)));
    }
    if is_overlay(name) {
        let (map, notes) = open_overlay(files, name, options)?;
        return Ok(OpenMap::Mosaic(Box::new(map.with_notes(notes))));
    }
    if is_geo_tiff(name) {
        return open_geo_tiff(files, name, options).map(|map| OpenMap::GeoTiff(Box::new(map)));
    }
    if lower.ends_with(".pmtiles") {
        return open_pm_tiles(files, name, options).map(|map| OpenMap::PmTiles(Box::new(map)));
    }
    let bytes = files.read(name).ok_or_else(|| missing(name))?;
    let (side, place) =
        place_beside(files, name, options)?.ok_or_else(|| without_place(name, &bytes))?;
    refuse_unnamed(&place, name, options)?;
    let georeference = |cause| MapFileError::Georeference {
        file: side.clone(),
        cause,
    };
    let picture = decode_map(&bytes, true).map_err(|cause| MapFileError::Picture {
        file: name.to_owned(),
        cause,
    })?;
    let (width, height) = (picture.width(), picture.height());
    let frame = frame_of(options, place.origin(width, height));
    let placement = Placement::on_globe(place, frame, width, height).map_err(georeference)?;
    GeoreferencedPicture::placed(name, picture, placement)
        .map(|map| OpenMap::Picture(Box::new(map)))
        .ok_or(MapFileError::Empty { file: side })
}

/// Complaint about a file beside which nothing tells where it lies: of what is no picture, that.
fn without_place(name: &str, bytes: &[u8]) -> MapFileError {
    let file = name.to_owned();
    let [jpeg, png] = [&b"\xff\xd8\xff"[..], b"\x89PNG\r\n\x1a\n"];
    if bytes.starts_with(jpeg) || bytes.starts_with(png) {
        MapFileError::NoGeoreference { file }
    } else {
        MapFileError::NoPicture { file }
    }
}

fn open_geo_tiff(
    files: &dyn FileSet,
    name: &str,
    options: &MapOptions,
) -> Result<GeoTiff, MapFileError> {
    if let Some(place) = options.place {
        let source = files.source(name).ok_or_else(|| missing(name))?;
        let file = GeoTiffFile::put(source, place)?;
        let frame = frame_of(options, file.origin());
        return Ok(GeoTiff::new(file, &frame, options.memory)?);
    }
    let file = geo_tiff_file(files, name, options)?;
    let frame = frame_of(options, file.origin());
    let map = GeoTiff::new(file, &frame, options.memory)?;
    Ok(map.with_mask(mask_beside(files, name)))
}

/// The `GeoTIFF` that is called `name`, placed by what it says itself, or else by what lies beside it.
pub(crate) fn geo_tiff_file(
    files: &dyn FileSet,
    name: &str,
    options: &MapOptions,
) -> Result<GeoTiffFile, MapFileError> {
    let source = files.source(name).ok_or_else(|| missing(name))?;
    let open = |beside, system| GeoTiffFile::open(source.clone(), beside, system);
    // Files beside it are read only for what it does not say itself: what is wrong in them is none of its concern else.
    let (beside, opened) = match open(None, options.system) {
        Err(GeoTiffError::NoPlace { .. } | GeoTiffError::ByCamera { .. }) => {
            let beside = place_beside(files, name, options)?.map(|(_, place)| place);
            (beside, open(beside, options.system))
        }
        other => (None, other),
    };
    let file = match opened {
        Err(GeoTiffError::NoSystem { .. }) => open(beside, system_beside(files, name)?),
        other => other,
    }?;
    refuse_unnamed(&file.georeference, name, options)?;
    Ok(file)
}

fn open_pm_tiles(
    files: &dyn FileSet,
    name: &str,
    options: &MapOptions,
) -> Result<WebTiles, MapFileError> {
    let source = files.source(name).ok_or_else(|| missing(name))?;
    let archive = PmTiles::open(source)?;
    let reach = GroundRect::centered(GroundPoint::default(), 2.0 * TILES_REACH, 2.0 * TILES_REACH);
    let around = |place: Geodetic| {
        let frame = frame_of(options, Some(place));
        // Of a map of the world only the part around the origin lies near the plane.
        let own = archive.area(&frame).filter(|area| {
            [area.south, area.north, area.west, area.east]
                .iter()
                .all(|v| v.abs() <= TILES_REACH)
        });
        (frame, own)
    };
    let (mut frame, own) = around(archive.middle());
    let mut note = None;
    if own.is_none() {
        // Programs that do not know the bounds state those of the world, and the centre of what there is.
        if let Some(centre) = archive.centre() {
            frame = around(centre).0;
        }
        let origin = frame.origin;
        note = Some(format!(
            "{name}: the archive states a larger area; read is what lies within {} km of {:.4}°, {:.4}° (latitude, longitude)",
            TILES_REACH / 1000.0,
            origin.latitude.to_degrees(),
            origin.longitude.to_degrees()
        ));
    }
    let area = own.unwrap_or(reach);
    let map = WebTiles::new(Box::new(archive), frame, area, options.memory.tiles);
    Ok(map.with_note(note))
}

pub(crate) fn missing(name: &str) -> MapFileError {
    MapFileError::Missing {
        file: name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point2;

    use super::*;
    use pilotage_base::files::MemoryFiles;
    use pilotage_raster::raster::{Picture, encode_png};

    fn files(files: &[(&str, &[u8])]) -> MemoryFiles {
        let picture = encode_png(&Picture::filled(40, 20, [90, 120, 60])).unwrap();
        let mut all = MemoryFiles::default();
        all.0.insert("map.png".to_owned(), picture);
        for (name, bytes) in files {
            all.0.insert((*name).to_owned(), bytes.to_vec());
        }
        all
    }

    const TURNED: &[u8] = b"0.4\n0.3\n0.3\n-0.4\n500000.2\n4000000.0\n";
    const PRJ: &[u8] = br#"PROJCS["WGS_1984_UTM_Zone_17N",GEOGCS["GCS_WGS_1984","#;

    #[test]
    fn a_world_file_counts_in_the_system_of_the_prj_beside_it() {
        let map = open_map(
            &files(&[("map.pgw", TURNED), ("map.prj", PRJ)]),
            "map.png",
            None,
        );
        let map = map.unwrap();
        // The central meridian's scale of 0.9996 makes the ground a little larger than the grid.
        assert!((map.native_gsd() - 0.5 / 0.9996).abs() < 1e-4);
        let middle = map.placement().unwrap().ground_at(&Point2::new(20.0, 10.0));
        assert!(middle.north.hypot(middle.east) < 1e-6, "{middle:?}");
        let right = map.placement().unwrap().ground_at(&Point2::new(30.0, 10.0));
        assert!((right.east - 4.0).abs() < 0.01 && (right.north - 3.0).abs() < 0.01);
    }

    #[test]
    fn a_map_keeps_to_a_world_that_is_near_and_makes_its_own_elsewhere() {
        let files = files(&[("map.pgw", TURNED), ("map.prj", PRJ)]);
        let own = open_map(&files, "map.png", None).unwrap();
        let own = own.frame().unwrap().origin;
        let world = |degrees_north: f64| {
            let mut origin = own;
            origin.latitude += degrees_north.to_radians();
            let options = MapOptions {
                near: Some((LocalFrame::new(origin), 50_000.0)),
                ..MapOptions::default()
            };
            let map = open_map_with(&files, "map.png", &options).unwrap();
            (origin, map.frame().unwrap().origin, map.bounds().north)
        };
        let (near, chosen, north) = world(0.1);
        assert_eq!(chosen, near);
        assert!((north + 11_100.0).abs() < 100.0, "{north}");
        let (_, chosen, north) = world(1.0);
        assert_eq!(chosen, own);
        assert!(north.abs() < 100.0);
    }

    #[test]
    fn an_unknown_prj_is_named() {
        let prj: &[u8] = br#"PROJCS["Timbalai_1948_RSO_Borneo_m","#;
        let error = open_map(
            &files(&[("map.pgw", TURNED), ("map.prj", prj)]),
            "map.png",
            None,
        );
        let text = error.err().unwrap().to_string();
        assert!(
            text.starts_with("map.prj") && text.contains("Timbalai"),
            "{text}"
        );
    }

    #[test]
    fn what_is_no_picture_is_not_told_to_get_a_world_file() {
        let files = files(&[
            ("a.ntf", b"NITF02.10BF01"),
            ("a.tif", b"version https://git-lfs"),
        ]);
        let told = |name| open_map(&files, name, None).err().unwrap();
        let error = told("a.ntf");
        assert!(error.is_of_another_kind(), "{error}");
        assert!(told("a.tif").is_of_another_kind());
        let picture = told("map.png");
        assert!(!picture.is_of_another_kind(), "{picture}");
        assert!(
            picture.to_string().contains("put its world file"),
            "{picture}"
        );
    }

    #[test]
    fn a_tiff_that_is_none_is_named() {
        let error = open_map(&files(&[("a.tif", b"GIF89a..")]), "a.tif", None);
        let text = error.err().unwrap().to_string();
        assert!(text.starts_with("a.tif: not a TIFF"), "{text}");
    }
}
