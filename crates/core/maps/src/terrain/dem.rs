//! Elevation models in files: `GeoTIFF` and the .hgt of the shuttle's radar.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Point2;

use super::hgt::Hgt;
use super::{HeightDatum, Terrain, between_posts};
use crate::tiff::{Chunk, TiffError, TiffFile};
use crate::{GeoTiffError, GeoTiffFile};
use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame, ReferenceSystem};
use pilotage_base::{bytes::ByteSource, georeference::GeoreferenceError};
use pilotage_raster::imagery::Placement;
use pilotage_raster::imagery::kept::Kept;

/// Bytes of unpacked tiles that are kept.
const MEMORY: usize = 32 << 20;
/// Heights beyond are marks for missing data that the file does not declare, metres.
const HIGHEST: f64 = 12_000.0;

/// Why a file cannot be terrain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TerrainError {
    /// A `GeoTIFF` that cannot be read.
    #[error(transparent)]
    GeoTiff(#[from] GeoTiffError),
    /// A `GeoTIFF` that is a picture.
    #[error("{file}: {samples} samples a pixel; an elevation model has one")]
    Picture {
        /// Name of the file.
        file: String,
        /// Samples of a pixel.
        samples: usize,
    },
    /// A .hgt file that cannot be read.
    #[error("{file}: {cause}")]
    Hgt {
        /// Name of the file.
        file: String,
        /// What is wrong.
        cause: String,
    },
}

/// Heights at a grid of posts; between posts they are interpolated.
pub struct Dem {
    posts: Posts,
    placement: Placement,
    frame: LocalFrame,
    datum: HeightDatum,
    problem: Mutex<Option<TiffError>>,
}

enum Posts {
    GeoTiff {
        file: TiffFile,
        kept: Kept<(usize, usize), Option<Chunk>>,
        metres_per_height: f64,
    },
    Hgt(Hgt),
}

impl Dem {
    /// Opens an elevation model, in the world frame `frame` or else around its own middle. `system`
    /// stands in for a reference system that the file does not name.
    pub fn open(
        source: Arc<dyn ByteSource>,
        frame: Option<LocalFrame>,
        system: Option<ReferenceSystem>,
    ) -> Result<Self, TerrainError> {
        if source.name().to_ascii_lowercase().ends_with(".hgt") {
            return Self::open_hgt(source.as_ref(), frame);
        }
        let file = GeoTiffFile::open(source, None, system)?;
        let picture = &file.tiff.levels()[0];
        if picture.samples != 1 {
            return Err(TerrainError::Picture {
                file: file.tiff.name().to_owned(),
                samples: picture.samples,
            });
        }
        let own = file.origin().map(LocalFrame::new);
        let frame = frame.or(own).ok_or_else(|| GeoTiffError::Georeference {
            file: file.tiff.name().to_owned(),
            cause: GeoreferenceError::Degenerate,
        })?;
        Ok(Self {
            placement: file.placement(&frame)?,
            frame,
            datum: HeightDatum::of(&file.keys),
            posts: Posts::GeoTiff {
                metres_per_height: file.keys.metres_per_height,
                file: file.tiff,
                kept: Kept::new(MEMORY),
            },
            problem: Mutex::new(None),
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
            problem: Mutex::new(None),
        })
    }

    /// Where the posts stand: in the middle of pixels.
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
        let problem = self.problem.lock().unwrap_or_else(PoisonError::into_inner);
        problem.clone()
    }

    /// Height at a post, metres.
    fn post(&self, column: usize, row: usize) -> Option<f64> {
        let (file, kept, metres_per_height) = match &self.posts {
            Posts::Hgt(hgt) => return hgt.post(column, row),
            Posts::GeoTiff {
                file,
                kept,
                metres_per_height,
            } => (file, kept, metres_per_height),
        };
        let layout = &file.levels()[0];
        let place = (column / layout.chunk_width, row / layout.chunk_height);
        let made = kept.get_or_make(place, || {
            let chunk = file.chunk(0, place.0, place.1)?;
            let bytes = chunk
                .as_ref()
                .map_or(0, |c| c.samples.len() * layout.kind.bits() / 8);
            Ok((chunk, bytes))
        });
        let chunk = match made {
            Ok(chunk) => chunk,
            Err(problem) => {
                let mut first = self.problem.lock().unwrap_or_else(PoisonError::into_inner);
                first.get_or_insert(problem);
                return None;
            }
        };
        let chunk = chunk.as_ref().as_ref()?;
        let inside = (column % layout.chunk_width, row % layout.chunk_height);
        let value = chunk.samples.real(inside.1 * chunk.width + inside.0);
        let height = value * metres_per_height;
        let is_known = layout.no_data != Some(value) && height.abs() <= HIGHEST;
        is_known.then_some(height)
    }
}

impl Terrain for Dem {
    fn name(&self) -> &str {
        match &self.posts {
            Posts::GeoTiff { file, .. } => file.name(),
            Posts::Hgt(hgt) => hgt.name(),
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
