//! A map picture and the file beside it that says where it lies.

use crate::flight::files::FileSet;
use crate::frames::{Geodetic, LocalFrame};
use crate::imagery::{Georeference, GeoreferenceError, GeoreferencedPicture, decode_map};
use crate::raster::CodecError;

/// What is put in place of a picture's ending to name the file that says where it lies.
const SIDE_FILES: [&str; 9] = [
    ".jgw",
    ".jpgw",
    ".pgw",
    ".pngw",
    ".wld",
    "_georef.json",
    ".georef.json",
    ".georeference.json",
    ".json",
];

/// Why a picture cannot be a map.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
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
    /// The side file cannot be read.
    #[error("{file}: {cause}")]
    Georeference {
        /// Name of the side file.
        file: String,
        /// What is wrong with it.
        cause: GeoreferenceError,
    },
    /// The picture cannot be read.
    #[error("{file}: {cause}")]
    Picture {
        /// Name of the picture.
        file: String,
        /// What is wrong with it.
        cause: CodecError,
    },
    /// The picture would cover nothing.
    #[error("{file}: the picture would cover no ground; check for zeros")]
    Empty {
        /// Name of the side file.
        file: String,
    },
}

/// The picture `name` among `files` as a map in the world frame `frame`; a georeference on the globe
/// makes its own frame around its own origin where there is none.
pub fn open_map(
    files: &dyn FileSet,
    name: &str,
    frame: Option<LocalFrame>,
) -> Result<GeoreferencedPicture, MapError> {
    let bytes = files.read(name).ok_or_else(|| MapError::Missing {
        file: name.to_owned(),
    })?;
    let (side, text) = side_file(files, name).ok_or_else(|| MapError::NoGeoreference {
        file: name.to_owned(),
    })?;
    let georeference = |cause| MapError::Georeference {
        file: side.clone(),
        cause,
    };
    let place = Georeference::from_text(&text).map_err(georeference)?;
    let picture = decode_map(&bytes, true).map_err(|cause| MapError::Picture {
        file: name.to_owned(),
        cause,
    })?;
    let (width, height) = (picture.width(), picture.height());
    let frame = frame
        .or_else(|| place.origin(width, height).map(LocalFrame::new))
        // A world file in metres needs no place on the globe.
        .unwrap_or_else(|| LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0)));
    let ground_from_pixel = place
        .in_world(&frame, width, height)
        .map_err(georeference)?;
    GeoreferencedPicture::new(name, picture, ground_from_pixel)
        .ok_or(MapError::Empty { file: side })
}

fn side_file(files: &dyn FileSet, picture: &str) -> Option<(String, String)> {
    let (stem, _) = picture.rsplit_once('.')?;
    SIDE_FILES.iter().find_map(|ending| {
        let side = format!("{stem}{ending}");
        let bytes = files.read(&side)?;
        Some((side, String::from_utf8_lossy(&bytes).into_owned()))
    })
}
