//! Readers and writers of all formats: a new one is a line here, too.

use super::format_work::FormatWork;
use super::{Format, csv_write, geojson, gpx, kml, litchi, old_mission, waypoints, wpml_format};

/// Readers and writers of every format.
const TABLE: [&FormatWork; 9] = [
    &old_mission::WORK,
    &waypoints::WORK,
    &kml::KML_WORK,
    &kml::KMZ_WORK,
    &wpml_format::WORK,
    &litchi::WORK,
    &gpx::WORK,
    &geojson::WORK,
    &csv_write::WORK,
];

impl Format {
    /// Its reader and writers.
    pub(super) fn work(self) -> &'static FormatWork {
        let found = TABLE.iter().find(|work| work.format == self);
        found.unwrap_or(&TABLE[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_has_its_own_reader_and_a_writer_of_tracks_if_it_says_so() {
        for format in Format::all() {
            assert_eq!(format.work().format, format);
            assert_eq!(format.work().track.is_some(), format.holds_tracks());
        }
    }
}
