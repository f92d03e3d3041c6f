//! A map of several pictures, each where a table says that its corners lie.

mod corners;

use pilotage_base::files::FileSet;
use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, Placement, Window, decode_map};
use pilotage_raster::raster::{Raster, Rgba};

use crate::map_error::MapFileError;
use crate::map_options::{MapOptions, frame_of, is_geo_tiff};
use crate::tiff::TiffFile;
use crate::{GeoTiff, GeoTiffError, GeoTiffFile};
pub(crate) use corners::CorneredPicture;
use corners::read_corners;

/// Ending of a table of corners.
pub(crate) const ENDING: &str = ".csv";
/// Most pixels of pictures that are kept whole in memory: 1 GB with their pyramids.
const MOST_PIXELS: usize = 200_000_000;

/// Several pictures as one map. Where they overlap, the finest is seen.
pub struct Mosaic {
    name: String,
    frame: LocalFrame,
    bounds: GroundRect,
    /// The finest first.
    pieces: Vec<Box<dyn Imagery>>,
    /// Notes on it, in sentences.
    notes: Vec<String>,
}

impl Mosaic {
    /// The map that the table `name` among `files` makes of the pictures beside it.
    ///
    /// # Errors
    /// A table that does not say where pictures lie, or a picture that is not there or cannot be read.
    ///
    /// ```
    /// use pilotage_maps::files::{FileSink, MemoryFiles};
    /// use pilotage_maps::{MapOptions, Mosaic};
    /// # use pilotage_raster::imagery::Imagery;
    /// # use pilotage_raster::raster::{Raster, encode_png};
    /// # let picture = encode_png(&Raster::filled(40, 20, [90, 120, 60]))?;
    /// # let mut files = MemoryFiles::default();
    ///
    /// files.write("west.png", &picture)?;
    /// files.write("east.png", &picture)?;
    /// let table = "file,north,west,south,east\n\
    ///              west.png,0.001,-0.002,0,0\neast.png,0.001,0,0,0.002\n";
    /// files.write("corners.csv", table.as_bytes())?;
    /// let map = Mosaic::open(&files, "corners.csv", &MapOptions::default())?;
    /// assert_eq!(map.count(), 2);
    /// // 0.004° of longitude at the equator.
    /// assert!((map.bounds().width() - 445.28).abs() < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open(
        files: &dyn FileSet,
        name: &str,
        options: &MapOptions,
    ) -> Result<Self, MapFileError> {
        let bytes = files.read(name).ok_or_else(|| missing(name))?;
        let wrong = |cause| MapFileError::Corners {
            file: name.to_owned(),
            cause,
        };
        let text = String::from_utf8_lossy(&bytes);
        let rows = read_corners(&text, options.system).map_err(wrong)?;
        let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
        Self::of(files, name, folder, &rows, options)
    }

    /// The map of pictures that lie in `folder` among `files`; there is at least one.
    pub(crate) fn of(
        files: &dyn FileSet,
        name: &str,
        folder: &str,
        rows: &[CorneredPicture],
        options: &MapOptions,
    ) -> Result<Self, MapFileError> {
        let middle = rows[0].georeference(1, 1);
        let middle = middle.and_then(|place| place.origin(1, 1));
        let frame = frame_of(options, middle);
        let mut pieces = Vec::new();
        let mut kept = 0;
        for row in rows {
            let file = if folder.is_empty() {
                row.file.clone()
            } else {
                format!("{folder}/{}", row.file)
            };
            let piece: Box<dyn Imagery> = if is_geo_tiff(&file) {
                Box::new(geo_tiff(files, &file, row, frame, options)?)
            } else {
                let picture = picture(files, &file, row, frame)?;
                let (width, height) = picture.size();
                kept += width * height;
                Box::new(picture)
            };
            if kept > MOST_PIXELS {
                return Err(MapFileError::TooLarge {
                    file: name.to_owned(),
                    megapixels: MOST_PIXELS / 1_000_000,
                });
            }
            pieces.push(piece);
        }
        pieces.sort_by(|a, b| a.native_gsd().total_cmp(&b.native_gsd()));
        let notes = rows[0].system.note_on(name).into_iter().collect();
        let corners = pieces.iter().flat_map(|piece| piece.bounds().corners());
        let origin = GroundPoint::default();
        Ok(Self {
            name: name.to_owned(),
            frame,
            bounds: GroundRect::around(corners)
                .unwrap_or_else(|| GroundRect::centered(origin, 0.0, 0.0)),
            pieces,
            notes,
        })
    }

    /// The map with more that is to be told of it.
    pub(crate) fn with_notes(mut self, notes: Vec<String>) -> Self {
        self.notes.extend(notes);
        self
    }

    /// Notes on it, in sentences: another datum than WGS 84, pictures that were left out.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The world frame that it was put into.
    pub fn frame(&self) -> &LocalFrame {
        &self.frame
    }

    /// Number of its pictures.
    pub fn count(&self) -> usize {
        self.pieces.len()
    }

    /// Size that its pictures would have as one of the finest sampling, pixels.
    pub fn size(&self) -> (usize, usize) {
        let window = Window::covering(&self.bounds, self.native_gsd());
        (window.width, window.height)
    }
}

fn missing(name: &str) -> MapFileError {
    MapFileError::Missing {
        file: name.to_owned(),
    }
}

fn empty(name: &str) -> MapFileError {
    MapFileError::Empty {
        file: name.to_owned(),
    }
}

/// A TIFF, read by pieces, where its row says.
fn geo_tiff(
    files: &dyn FileSet,
    name: &str,
    row: &CorneredPicture,
    frame: LocalFrame,
    options: &MapOptions,
) -> Result<GeoTiff, MapFileError> {
    let source = files.source(name).ok_or_else(|| missing(name))?;
    let tiff = TiffFile::open(source.clone()).map_err(GeoTiffError::from)?;
    let (width, height) = (tiff.levels()[0].width, tiff.levels()[0].height);
    let place = row.georeference(width, height).ok_or_else(|| empty(name))?;
    let file = GeoTiffFile::put(source, place)?;
    Ok(GeoTiff::new(file, &frame, options.memory)?)
}

/// A picture, whole in memory, where its row says.
fn picture(
    files: &dyn FileSet,
    name: &str,
    row: &CorneredPicture,
    frame: LocalFrame,
) -> Result<GeoreferencedPicture, MapFileError> {
    let bytes = files.read(name).ok_or_else(|| missing(name))?;
    // Dark water at the edge of a tile is no border.
    let picture = decode_map(&bytes, false).map_err(|cause| MapFileError::Picture {
        file: name.to_owned(),
        cause,
    })?;
    let (width, height) = (picture.width(), picture.height());
    let place = row.georeference(width, height).ok_or_else(|| empty(name))?;
    let placement = Placement::on_globe(place, frame, width, height).map_err(|cause| {
        MapFileError::Georeference {
            file: name.to_owned(),
            cause,
        }
    })?;
    GeoreferencedPicture::placed(name, picture, placement).ok_or_else(|| empty(name))
}

/// Fills what `under` leaves uncovered of a pixel: covers of neighbours that meet in it add up.
fn filled([r, g, b, covered]: Rgba, [under_r, under_g, under_b, under]: Rgba) -> Rgba {
    let fresh = under.min(255 - covered);
    let whole = u32::from(covered) + u32::from(fresh);
    if fresh == 0 || whole == 0 {
        return [r, g, b, covered];
    }
    let mixed = |over: u8, beneath: u8| {
        let sum = u32::from(over) * u32::from(covered) + u32::from(beneath) * u32::from(fresh);
        ((sum + whole / 2) / whole) as u8
    };
    [
        mixed(r, under_r),
        mixed(g, under_g),
        mixed(b, under_b),
        whole as u8,
    ]
}

impl Mosaic {
    fn laid(
        &self,
        window: &Window,
        part_of: &mut dyn FnMut(&dyn Imagery, &Window) -> Raster<Rgba>,
    ) -> Raster<Rgba> {
        let mut out = Raster::filled(window.width, window.height, [0; 4]);
        for piece in &self.pieces {
            let Some((part, (left, top))) = window.touching(&piece.bounds()) else {
                continue;
            };
            let pixels = part_of(piece.as_ref(), &part);
            for row in 0..pixels.height() {
                let target = &mut out.row_mut(top + row)[left..left + pixels.width()];
                for (over, under) in target.iter_mut().zip(pixels.row(row)) {
                    *over = filled(*over, *under);
                }
            }
        }
        out
    }
}

impl Imagery for Mosaic {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&self) -> GroundRect {
        self.bounds
    }

    fn native_gsd(&self) -> f64 {
        self.pieces[0].native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        self.laid(window, &mut |piece, part| piece.window(part))
    }

    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        let mut is_whole = true;
        let laid = self.laid(window, &mut |piece, part| {
            let (pixels, is_there) = piece.window_so_far(part);
            is_whole &= is_there;
            pixels
        });
        (laid, is_whole)
    }

    fn prepare(&self, pieces: usize) -> (usize, usize) {
        let (mut done, mut all) = (0, 0);
        let mut left = pieces;
        for piece in &self.pieces {
            let (before, of) = piece.prepare(0);
            let (after, _) = if left > 0 && before < of {
                piece.prepare(left)
            } else {
                (before, of)
            };
            left = left.saturating_sub(after - before);
            done += after;
            all += of;
        }
        (done, all)
    }

    fn problems(&self) -> Vec<String> {
        self.pieces
            .iter()
            .flat_map(|piece| piece.problems())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use crate::open_map;
    use pilotage_base::files::MemoryFiles;
    use pilotage_raster::raster::{Picture, encode_png};

    fn shade(x: usize, y: usize) -> [u8; 3] {
        [(40 + 3 * x) as u8, (40 + 4 * y) as u8, 90]
    }

    /// A picture of 64 by 48 pixels, some of a hundred-thousandth of a degree each, whole with its world file and in
    /// four unequal parts with a table.
    fn files() -> MemoryFiles {
        const DEGREE: f64 = 1e-5;
        let (west, north) = (8.5, 47.4);
        let mut files = MemoryFiles::default();
        let part = |x: usize, y: usize, width: usize, height: usize| {
            let picture = Picture::from_fn(width, height, |i, j| shade(x + i, y + j));
            encode_png(&picture).unwrap()
        };
        files.0.insert("whole.png".to_owned(), part(0, 0, 64, 48));
        let world = format!(
            "{DEGREE}\n0\n0\n-{DEGREE}\n{}\n{}\n",
            west + 0.5 * DEGREE,
            north - 0.5 * DEGREE
        );
        files.0.insert("whole.pgw".to_owned(), world.into_bytes());
        let mut table = "file,LT_lat,LT_lon,RB_lat,RB_lon\n".to_owned();
        for (name, x, y, width, height) in [
            ("a.png", 0, 0, 40, 20),
            ("b.png", 40, 0, 24, 20),
            ("c.png", 0, 20, 40, 28),
            ("d.png", 40, 20, 24, 28),
        ] {
            files.0.insert(name.to_owned(), part(x, y, width, height));
            let at = |column: usize, row: usize| {
                (north - row as f64 * DEGREE, west + column as f64 * DEGREE)
            };
            let ((lat, lon), (other_lat, other_lon)) = (at(x, y), at(x + width, y + height));
            writeln!(table, "{name},{lat},{lon},{other_lat},{other_lon}").unwrap();
        }
        files.0.insert("corners.csv".to_owned(), table.into_bytes());
        files
    }

    #[test]
    fn four_parts_are_the_whole_without_seams() {
        let files = files();
        let whole = open_map(&files, "whole.png", None).unwrap();
        let parts = open_map(&files, "corners.csv", whole.frame().copied()).unwrap();
        let (own, other) = (whole.bounds(), parts.bounds());
        assert!((own.north - other.north).abs() < 1e-3 && (own.east - other.east).abs() < 1e-3);
        assert!((whole.native_gsd() - parts.native_gsd()).abs() < 0.01);
        // Along the seams colours of two parts are not interpolated between.
        let parts_of = |window: &Window, column: usize, row: usize| {
            let at = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            let pixel = whole.placement().unwrap().pixel_at(&at).unwrap();
            [(pixel.x, 40.0, 64.0), (pixel.y, 20.0, 48.0)]
        };
        for gsd in [0.9, 3.0] {
            let window = Window::covering(&own, gsd);
            let (one, two) = (whole.window(&window), parts.window(&window));
            let mut compared = 0;
            for row in 0..window.height {
                for column in 0..window.width {
                    let near = 1.5 * gsd.max(1.0);
                    let is_inside = |(at, seam, end): (f64, f64, f64)| {
                        (at - seam).abs() > near && at > near && end - at > near
                    };
                    let (a, b) = (one.get(column, row), two.get(column, row));
                    if !parts_of(&window, column, row).into_iter().all(is_inside) {
                        continue;
                    }
                    let off = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
                    assert!(off.unwrap_or(0) <= 12, "{a:?}, {b:?} at {column}, {row}");
                    compared += 1;
                }
            }
            assert!(compared > 80, "{compared} at {gsd} m");
            let inner = two.get(window.width / 2, window.height / 2);
            assert!(inner[3] > 250, "{inner:?}");
        }
    }

    #[test]
    fn the_finest_is_seen_where_pictures_overlap() {
        let mut files = MemoryFiles::default();
        for (name, size, colour) in [
            ("coarse.png", 10, [200, 0, 0]),
            ("fine.png", 40, [0, 200, 0]),
        ] {
            let picture = Picture::filled(size, size, colour);
            files
                .0
                .insert(name.to_owned(), encode_png(&picture).unwrap());
        }
        let table =
            "file,north,west,south,east\ncoarse.png,0.002,0,0,0.002\nfine.png,0.001,0,0,0.001\n";
        files.0.insert("map.csv".to_owned(), table.into());
        let map = open_map(&files, "map.csv", None).unwrap();
        let window = Window::covering(&map.bounds(), 10.0);
        let seen = map.window(&window);
        assert_eq!(seen.get(2, window.height - 3), [0, 200, 0, 255]);
        assert_eq!(seen.get(window.width - 3, 2), [200, 0, 0, 255]);
    }

    #[test]
    fn a_picture_that_is_not_there_is_named() {
        let mut files = files();
        files.0.remove("c.png");
        let error = open_map(&files, "corners.csv", None).err().unwrap();
        assert_eq!(error.to_string(), "c.png: there is no such file");
    }
}
