//! Elevation models in files: `GeoTIFF`, the .hgt of the shuttle's radar and grids of text.

use std::sync::Arc;

use nalgebra::Point2;

use super::hgt::Hgt;
use super::text_grid::{TextGrid, is_ascii_grid};
use super::tiff_posts::{TiffPosts, holds_heights};
use super::{HeightDatum, HeightGrid, Terrain, TerrainError, between_posts};
use crate::map_options::is_geo_tiff;
use crate::tiff::{TiffError, TiffFile};
use crate::{GeoTiffError, GeoTiffFile};
use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame, ReferenceSystem};
use pilotage_base::{bytes::ByteSource, georeference::GeoreferenceError};
use pilotage_raster::imagery::Placement;

/// Ending of the files of the shuttle's radar.
const HGT: &str = ".hgt";
/// Endings of grids of text.
const TEXTS: [&str; 2] = [".asc", ".xyz"];

/// Heights at a grid of posts; between posts they are interpolated.
pub struct Dem {
    posts: Posts,
    placement: Placement,
    frame: LocalFrame,
    datum: HeightDatum,
}

enum Posts {
    GeoTiff(Box<TiffPosts>),
    Hgt(Hgt),
    Text(TextGrid),
}

impl Dem {
    /// Opens an elevation model, in the world frame `frame` or else around its own middle. `system`
    /// stands in for a reference system that the file does not name. Of several bands the first holds
    /// the heights; [`notes`](Self::notes) says so. Scale, offset, unit and masks of the file are used.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use pilotage_maps::bytes::MemoryBytes;
    /// use pilotage_maps::frames::GroundPoint;
    /// use pilotage_maps::terrain::{Dem, Terrain};
    ///
    /// // The shuttle's radar mission: 1201 × 1201 heights in metres, here all of 300 m.
    /// let bytes = 300_i16.to_be_bytes().repeat(1201 * 1201);
    /// let file = MemoryBytes::new("N46W092.hgt", bytes);
    /// let terrain = Dem::open(Arc::new(file), None, None)?;
    /// assert_eq!(terrain.height_at(&GroundPoint::new(100.0, 200.0)), Some(300.0));
    /// # Ok::<(), pilotage_maps::terrain::TerrainError>(())
    /// ```
    pub fn open(
        source: Arc<dyn ByteSource>,
        frame: Option<LocalFrame>,
        system: Option<ReferenceSystem>,
    ) -> Result<Self, TerrainError> {
        if source.name().to_ascii_lowercase().ends_with(HGT) {
            return Self::open_hgt(source.as_ref(), frame);
        }
        if has_ending(source.name(), &TEXTS) {
            return Self::open_text(source.as_ref(), frame, system);
        }
        Self::of_geo_tiff(&GeoTiffFile::open(source, None, system)?, frame)
    }

    /// The model of a file whose place is known, in the world frame `frame` or else around its own middle.
    ///
    /// # Errors
    /// Its samples are no heights, or it does not lie anywhere.
    pub fn of_geo_tiff(
        file: &GeoTiffFile,
        frame: Option<LocalFrame>,
    ) -> Result<Self, TerrainError> {
        let posts = Box::new(TiffPosts::new(file)?);
        let own = file.origin().map(LocalFrame::new);
        let frame = frame.or(own).ok_or_else(|| GeoTiffError::Georeference {
            file: file.tiff.name().to_owned(),
            cause: GeoreferenceError::Degenerate,
        })?;
        Ok(Self {
            placement: file.placement(&frame)?,
            frame,
            datum: HeightDatum::of(&file.keys),
            posts: Posts::GeoTiff(posts),
        })
    }

    fn open_hgt(source: &dyn ByteSource, frame: Option<LocalFrame>) -> Result<Self, TerrainError> {
        let wrong = |cause: String| TerrainError::Hgt {
            file: source.name().to_owned(),
            cause,
        };
        let hgt = Hgt::read(source).map_err(wrong)?;
        let georeference = hgt.georeference();
        let own = georeference.origin(hgt.side(), hgt.side());
        let frame = frame.or(own.map(LocalFrame::new));
        let frame = frame.ok_or_else(|| wrong("its name says no place on Earth".to_owned()))?;
        let placement = Placement::on_globe(georeference, frame, hgt.side(), hgt.side())
            .map_err(|e| wrong(e.to_string()))?;
        Ok(Self {
            posts: Posts::Hgt(hgt),
            placement,
            frame,
            // The shuttle's heights are above the geoid EGM96.
            datum: HeightDatum::MeanSeaLevel("EGM96".to_owned()),
        })
    }

    fn open_text(
        source: &dyn ByteSource,
        frame: Option<LocalFrame>,
        system: Option<ReferenceSystem>,
    ) -> Result<Self, TerrainError> {
        let wrong = |cause: String| TerrainError::Text {
            file: source.name().to_owned(),
            cause,
        };
        let bytes = source.read(0, source.length() as usize).map_err(wrong)?;
        let grid = TextGrid::read(source.name(), &bytes, system).map_err(wrong)?;
        let georeference = grid.georeference();
        let (columns, rows) = grid.size();
        let own = georeference.origin(columns, rows);
        let frame = frame.or(own.map(LocalFrame::new));
        let frame = frame.ok_or_else(|| wrong("it says no place on Earth".to_owned()))?;
        let placement = Placement::on_globe(georeference, frame, columns, rows)
            .map_err(|e| wrong(e.to_string()))?;
        Ok(Self {
            posts: Posts::Text(grid),
            placement,
            frame,
            datum: HeightDatum::NotStated,
        })
    }

    /// A grid over `area` for its heights, its posts as far apart as the model's, or farther so that it has at most
    /// `most_posts` along a side. [`HeightGrid::take_rows`] fills it.
    pub fn grid(&self, area: GroundRect, most_posts: usize) -> HeightGrid {
        let (name, datum) = (Terrain::name(self), Terrain::datum(self).clone());
        HeightGrid::over(name, datum, area, self.spacing(), most_posts)
    }

    /// Whether a file is an elevation model without being asked for as one: `.hgt` by its name, a grid of text, or a TIFF with samples
    /// that no picture has.
    pub fn is_one(source: Arc<dyn ByteSource>) -> bool {
        let name = source.name().to_ascii_lowercase();
        name.ends_with(HGT)
            || has_ending(&name, &TEXTS[..1])
                && source
                    .read(0, 64.min(source.length() as usize))
                    .is_ok_and(|head| is_ascii_grid(&head))
            || is_geo_tiff(&name) && TiffFile::open(source).is_ok_and(|file| holds_heights(&file))
    }

    /// Placement of the posts, which stand in the middle of pixels.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// The world frame.
    pub fn frame(&self) -> &LocalFrame {
        &self.frame
    }

    /// The ground that has heights.
    pub fn bounds(&self) -> GroundRect {
        self.placement.bounds()
    }

    /// Distance between posts, metres.
    pub fn spacing(&self) -> f64 {
        self.placement.gsd()
    }

    /// The first part of the file that could not be read, if any; its heights are unknown.
    pub fn problem(&self) -> Option<TiffError> {
        match &self.posts {
            Posts::GeoTiff(posts) => posts.problem(),
            Posts::Hgt(_) | Posts::Text(_) => None,
        }
    }

    /// Notes on choices that the file leaves open, and on the error by another datum than WGS 84, in
    /// sentences that name the file.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = match &self.posts {
            Posts::GeoTiff(posts) => posts.notes(),
            Posts::Hgt(_) | Posts::Text(_) => Vec::new(),
        };
        let georeference = self.placement.georeference();
        notes.extend(georeference.and_then(|place| place.system()?.note_on(self.name())));
        notes
    }

    /// Height at a post, metres; panics outside.
    fn post(&self, column: usize, row: usize) -> Option<f64> {
        match &self.posts {
            Posts::GeoTiff(posts) => posts.post(column, row),
            Posts::Hgt(hgt) => hgt.post(column, row),
            Posts::Text(grid) => grid.post(column, row),
        }
    }
}

/// Whether a name has one of those endings, in small letters or capitals.
fn has_ending(name: &str, endings: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    endings.iter().any(|ending| name.ends_with(ending))
}

impl Terrain for Dem {
    fn name(&self) -> &str {
        match &self.posts {
            Posts::GeoTiff(posts) => posts.name(),
            Posts::Hgt(hgt) => hgt.name(),
            Posts::Text(grid) => grid.name(),
        }
    }

    fn datum(&self) -> &HeightDatum {
        &self.datum
    }

    /// Bilinear between the four posts around the place; the outermost half post repeats the edge.
    /// Unknown where a post that counts is.
    fn height_at(&self, place: &GroundPoint) -> Option<f64> {
        let Point2 { coords: pixel } = self.placement.pixel_at(place)?;
        let (width, height) = self.placement.size();
        if !(0.0..=width as f64).contains(&pixel.x) || !(0.0..=height as f64).contains(&pixel.y) {
            return None;
        }
        // Posts stand in the middle of pixels.
        let x = (pixel.x - 0.5).clamp(0.0, (width - 1) as f64);
        let y = (pixel.y - 0.5).clamp(0.0, (height - 1) as f64);
        between_posts((x, y), (width - 1, height - 1), |column, row| {
            self.post(column, row)
        })
    }
}
