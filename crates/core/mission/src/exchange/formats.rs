//! All formats in one table: a new one is a file with its description, and a line here.

use super::format_info::FormatInfo;
use super::{Format, csv_write, geojson, gpx, kml, litchi, old_mission, waypoints, wpml_format};

/// Every format, in the order in which people are offered them.
const TABLE: [&FormatInfo; 9] = [
    &old_mission::INFO,
    &waypoints::INFO,
    &kml::KML,
    &kml::KMZ,
    &wpml_format::INFO,
    &litchi::INFO,
    &gpx::INFO,
    &geojson::INFO,
    &csv_write::INFO,
];

impl Format {
    /// All formats, in the order in which people are offered them.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|info| info.format)
    }

    /// Formats that the extension of a file's name tells, in that order: those of makers have extensions of others.
    pub fn told_by_extension() -> impl Iterator<Item = Self> {
        let told = TABLE.iter().filter(|info| info.is_told_by_extension);
        told.map(|info| info.format)
    }

    /// Its description.
    fn info(self) -> &'static FormatInfo {
        let found = TABLE.iter().find(|info| info.format == self);
        found.unwrap_or(&TABLE[0])
    }

    /// Words for a file of the format, as in "save the route as …".
    pub fn as_words(self) -> &'static str {
        self.info().as_words
    }

    /// Name for people.
    pub fn name(self) -> &'static str {
        self.info().name
    }

    /// Extensions of file names, without the dot; the first is written.
    pub fn extensions(self) -> &'static [&'static str] {
        self.info().extensions
    }

    /// Whether it holds landmarks; all formats hold routes.
    pub fn holds_landmarks(self) -> bool {
        !self.info().is_mission
    }

    /// Whether it holds more than one route.
    pub fn holds_several_routes(self) -> bool {
        !self.info().is_mission
    }

    /// Whether it holds a flown track.
    pub fn holds_tracks(self) -> bool {
        self.info().holds_tracks
    }

    /// The format that the extension of a file's name says.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert_eq!(Format::of_name("flights/Out.GPX"), Some(Format::Gpx));
    /// assert_eq!(Format::of_name("letter.pdf"), None);
    /// ```
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        Self::told_by_extension().find(|format| {
            format
                .extensions()
                .iter()
                .any(|own| own.eq_ignore_ascii_case(extension))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_has_its_own_description() {
        let all = [
            Format::Plan,
            Format::Waypoints,
            Format::Kml,
            Format::Kmz,
            Format::GeoJson,
            Format::Gpx,
            Format::Csv,
            Format::Wpml,
            Format::Litchi,
        ];
        for format in all {
            assert_eq!(format.info().format, format);
            assert_eq!(Format::all().filter(|other| *other == format).count(), 1);
        }
    }
}
