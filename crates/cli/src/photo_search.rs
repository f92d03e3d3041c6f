//! Options of photos on the command line, and the search that they mean.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pilotage_core::flight::photo::{PhotoRow, PhotoRows, PhotoSearch};
use pilotage_jobs::places_of_photos;

use crate::files::{DirectoryFiles, DiskFile};
use crate::numbers::{any_number, lat_lon};

/// Facts that are known of photos better than they tell them.
#[derive(clap::Args)]
pub struct KnownOfPhotos {
    /// Place below the camera, degrees; what the photo says if absent.
    #[arg(long, value_name = "LAT,LON", allow_hyphen_values = true)]
    at: Option<String>,
    /// Height above the ground, metres; what the photo says if absent.
    #[arg(long, value_name = "METRES")]
    height: Option<f64>,
    /// Heading of the picture's top, degrees from north; what the photo says if absent.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = any_number)]
    heading: Option<f64>,
    /// Angle by which the camera looks ahead of straight down, degrees; what the photo says if absent.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = any_number)]
    ahead: Option<f64>,
    /// Focal length in pixels of the picture; what the photo says if absent.
    #[arg(long, value_name = "PIXELS")]
    focal: Option<f64>,
    /// Stated accuracy of the map, standard deviation per axis in metres. Satellite and aerial maps of the web have
    /// some 3.
    #[arg(long, value_name = "METRES", default_value_t = PhotoSearch::default().map_deviation)]
    map_accuracy: f64,
}

/// Ranges of a search to each side, as people state them.
pub struct SearchRanges {
    /// Of the place, metres.
    pub metres: f64,
    /// Of the height, percent.
    pub height_percent: f64,
    /// Of the heading, degrees.
    pub heading_degrees: f64,
}

impl KnownOfPhotos {
    /// The search for such photos, in metres and radians.
    pub fn search(&self, ranges: &SearchRanges) -> Result<PhotoSearch, String> {
        for (option, limit) in [
            ("--within", ranges.metres),
            ("--height-within", ranges.height_percent),
            ("--heading-within", ranges.heading_degrees),
            ("--map-accuracy", self.map_accuracy),
        ] {
            if !(limit.is_finite() && limit >= 0.0) {
                return Err(format!("{option}: {limit} is not zero or more"));
            }
        }
        for (option, value) in [("--height", self.height), ("--focal", self.focal)] {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(format!("{option}: {value} is not more than zero"));
            }
        }
        let at = self.at.as_deref().map(|at| lat_lon(at, "--at"));
        Ok(PhotoSearch {
            at: at.transpose()?,
            within: ranges.metres,
            height: self.height,
            height_within: 0.01 * ranges.height_percent,
            heading: self.heading.map(f64::to_radians),
            heading_within: ranges.heading_degrees.to_radians(),
            ahead: self.ahead.map(f64::to_radians),
            focal: self.focal,
            map_deviation: self.map_accuracy,
        })
    }
}

/// Places of photos in tables that lie in their folders, as far as these were looked through.
#[derive(Default)]
pub struct TablesBesidePhotos(BTreeMap<PathBuf, PhotoRows>);

impl TablesBesidePhotos {
    /// The row of a table in a photo's folder that tells of it.
    pub fn row(&mut self, photo: &Path) -> Option<PhotoRow> {
        let folder = photo.parent().filter(|it| !it.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        let rows = self.0.entry(folder).or_insert_with_key(|folder| {
            let files = DirectoryFiles::in_folder(folder);
            files.map_or_else(
                |_| PhotoRows::default(),
                |files| places_of_photos(&files).rows,
            )
        });
        let name = photo.file_name()?.to_string_lossy();
        rows.0.get(name.as_ref()).copied()
    }
}

/// The photo at a path, called by it in messages.
pub fn photo_file(path: &Path) -> Result<DiskFile, String> {
    let file = DiskFile::open(path, &path.to_string_lossy());
    file.map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_that_are_none_are_refused_in_words() {
        let known = KnownOfPhotos {
            at: None,
            height: None,
            heading: None,
            ahead: None,
            focal: None,
            map_accuracy: 3.0,
        };
        let search = |metres, height_percent, heading_degrees| {
            known.search(&SearchRanges {
                metres,
                height_percent,
                heading_degrees,
            })
        };
        assert_eq!(search(0.0, 0.0, 0.0).unwrap().height_within, 0.0);
        let why = search(40.0, -150.0, 40.0).unwrap_err();
        assert!(why.contains("--height-within: -150"), "{why}");
        let why = search(40.0, 20.0, f64::NAN).unwrap_err();
        assert!(why.contains("--heading-within"), "{why}");
        assert!(search(f64::INFINITY, 20.0, 40.0).is_err());
        let deep = KnownOfPhotos {
            height: Some(-5.0),
            ..known
        };
        let ranges = SearchRanges {
            metres: 40.0,
            height_percent: 20.0,
            heading_degrees: 40.0,
        };
        assert!(deep.search(&ranges).unwrap_err().contains("--height: -5"));
    }
}
