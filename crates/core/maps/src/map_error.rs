//! Why something is no map.

use crate::GeoTiffError;
use crate::corners_error::CornersError;
use crate::systems::SystemError;
use crate::terrain::TerrainError;
use crate::tiff::TiffError;
use crate::web_tiles::PmTilesError;
use pilotage_base::georeference::GeoreferenceError;
use pilotage_raster::raster::CodecError;

/// Why a picture cannot be a map.
#[derive(Debug, thiserror::Error)]
pub enum MapFileError {
    /// An elevation model that cannot be read.
    #[error(transparent)]
    Terrain(#[from] TerrainError),
    /// The picture is not there.
    #[error("{file}: there is no such file")]
    Missing {
        /// Name of the picture.
        file: String,
    },
    /// Nothing beside the picture says where it lies.
    #[error(
        "{file}: a picture that does not say where it lies; put its world file (.jgw, .pgw, .wld) or a georeference in JSON beside it"
    )]
    NoGeoreference {
        /// Name of the picture.
        file: String,
    },
    /// The file is no picture, and nothing beside it says where it lies.
    #[error(
        "{file}: of no kind of map that is known here: neither a GeoTIFF nor tiles (PMTiles), and no JPEG or PNG picture"
    )]
    NoPicture {
        /// Name of the file.
        file: String,
    },
    /// The side file cannot be read.
    #[error("{file}: {cause}")]
    Georeference {
        /// Name of the side file.
        file: String,
        /// Error of the side file.
        cause: GeoreferenceError,
    },
    /// The picture cannot be read.
    #[error("{file}: {cause}")]
    Picture {
        /// Name of the picture.
        file: String,
        /// Error of the picture.
        cause: CodecError,
    },
    /// The file beside the picture names a reference system that is not known.
    #[error("{file}: {cause}")]
    System {
        /// Name of the .prj file.
        file: String,
        /// The fault in it.
        cause: SystemError,
    },
    /// The world file beside the picture counts in metres of a system that nothing names.
    #[error(
        "{file}: its world file counts from x = {x}, y = {y} and does not say in which reference system; which is it? Put its code (e.g. {example}) or its well-known text into {prj}, or name it by --system on the terminal"
    )]
    UnnamedSystem {
        /// Name of the picture.
        file: String,
        /// First coordinate of the top left pixel.
        x: f64,
        /// Second coordinate of the top left pixel.
        y: f64,
        /// Name of the .prj file that would say it.
        prj: String,
        /// A system by code and in words.
        example: String,
    },
    /// The `GeoTIFF` cannot be read or does not lie anywhere.
    #[error(transparent)]
    GeoTiff(#[from] GeoTiffError),
    /// The archive of tiles cannot be read.
    #[error(transparent)]
    PmTiles(#[from] PmTilesError),
    /// The table does not say where pictures lie.
    #[error("{file}: {cause}")]
    Corners {
        /// Name of the table.
        file: String,
        /// Error of the table.
        cause: CornersError,
    },
    /// A KML or KMZ that lays no picture on the ground.
    #[error("{file}: no map: there is no picture on the ground (GroundOverlay) in it")]
    NoOverlay {
        /// Name of the file.
        file: String,
    },
    /// The pictures on the ground of a KML or KMZ cannot be read.
    #[error("{file}: {cause}")]
    Overlay {
        /// Name of the file.
        file: String,
        /// The fault in it.
        cause: String,
    },
    /// Several pictures are too large to be kept in memory together.
    #[error(
        "{file}: its pictures have more than {megapixels} million pixels together; make one GeoTIFF of them (gdal_merge.py)"
    )]
    TooLarge {
        /// Name of the table.
        file: String,
        /// Most pixels, millions.
        megapixels: usize,
    },
    /// The picture would cover nothing.
    #[error("{file}: the picture would cover no ground; check for zeros")]
    Empty {
        /// Name of the side file.
        file: String,
    },
}

impl MapFileError {
    /// Whether the file begins as no map that is read, whatever its ending.
    pub fn is_of_another_kind(&self) -> bool {
        matches!(
            self,
            Self::NoPicture { .. }
                | Self::Picture {
                    cause: CodecError::UnknownFormat,
                    ..
                }
                | Self::GeoTiff(GeoTiffError::Tiff(TiffError::NotTiff { .. }))
                | Self::PmTiles(PmTilesError::NotPmTiles { .. })
        )
    }
}
