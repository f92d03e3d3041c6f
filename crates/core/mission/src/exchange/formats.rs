//! Questions of people and programs to a format; the table of all is in `mod.rs`.

use super::Format;
use super::format_info::{HeldBeside, HeldTogether};

/// Declares the files of the formats, and makes their enum, in the order in which people are offered them. Descriptions
/// and works are asked for apart: what only names formats links no reader.
macro_rules! formats {
    ($($(#[$about:meta])* $name:ident($file:ident),)*) => {
        $(mod $file;)*

        /// A format of files with routes or landmarks.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        pub enum Format {
            $(
                $(#[$about])*
                #[doc = concat!("See `", stringify!($file), "`.")]
                $name,
            )*
        }

        impl Format {
            /// All formats, in the order in which people are offered them.
            pub fn all() -> impl Iterator<Item = Self> {
                [$(Self::$name,)*].into_iter()
            }

            /// Its description.
            fn info(self) -> &'static format_info::FormatInfo {
                match self {
                    $(Self::$name => &$file::INFO,)*
                }
            }

            /// Its reader and writers.
            fn work(self) -> &'static format_work::FormatWork {
                match self {
                    $(Self::$name => &$file::WORK,)*
                }
            }
        }
    };
}

/// Extensions under which nothing is written: what is in such files is written as another format.
const ONLY_READ: [&str; 3] = ["mission", "wpml", "lnmpln"];

impl Format {
    /// Formats that the extension of a file's name tells, in that order: those of makers have extensions of others.
    pub fn told_by_extension() -> impl Iterator<Item = Self> {
        Self::all().filter(|format| format.info().maker.is_none())
    }

    /// Makers whose missions have the extensions of other formats, as people name them to programs, each with its format.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// let makers: Vec<_> = Format::of_makers().map(|(maker, _)| maker).collect();
    /// assert_eq!(makers, ["dji", "litchi"]);
    /// ```
    pub fn of_makers() -> impl Iterator<Item = (&'static str, Self)> {
        Self::all().filter_map(|format| Some((format.info().maker?, format)))
    }

    /// The format that holds rally points in a file of their own.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// let format = Format::of_rally_alone().map(Format::name);
    /// assert_eq!(format, Some("QGC WPL 110"));
    /// ```
    pub fn of_rally_alone() -> Option<Self> {
        Self::all().find(|format| format.info().beside == HeldBeside::RallyAlone)
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

    /// Extensions of all formats, each once, in words: `.plan, .mission, …`.
    ///
    /// ```
    /// assert!(pilotage_mission::exchange::Format::all_extensions().contains(".gpx, .lnmpln, "));
    /// ```
    pub fn all_extensions() -> String {
        in_words(Self::all().flat_map(Self::extensions))
    }

    /// Extensions of the formats that hold flown tracks, in words.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert_eq!(Format::track_extensions(), ".kml, .kmz, .gpx, .geojson, .csv");
    /// ```
    pub fn track_extensions() -> String {
        let formats = Self::all().filter(|format| format.holds_tracks());
        in_words(formats.filter_map(|format| format.extensions().first()))
    }

    /// Whether the extension of a file's name is one of any format.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert!(Format::is_extension_of_one("flights/Out.WPML"));
    /// assert!(!Format::is_extension_of_one("letter.pdf"));
    /// ```
    pub fn is_extension_of_one(name: &str) -> bool {
        Self::all().any(|format| format.info().has_extension(name))
    }

    /// Whether the extension of a file's name is one of any format, and not one that files of anything have.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert!(Format::is_extension_of_formats_alone("out.waypoints"));
    /// assert!(!Format::is_extension_of_formats_alone("notes.txt"));
    /// ```
    pub fn is_extension_of_formats_alone(name: &str) -> bool {
        let mut all = Self::all().map(Self::info);
        Self::is_extension_of_one(name) && !all.any(|info| info.has_extension_of_anybody(name))
    }

    /// Whether it holds landmarks; all formats hold routes.
    pub fn holds_landmarks(self) -> bool {
        self.info().together != HeldTogether::Mission
    }

    /// Whether it holds more than one route.
    pub fn holds_several_routes(self) -> bool {
        self.info().together != HeldTogether::Mission
    }

    /// Whether one file holds routes and landmarks.
    pub fn holds_both(self) -> bool {
        self.info().together == HeldTogether::Both
    }

    /// Whether it holds a flown track.
    pub fn holds_tracks(self) -> bool {
        self.info().holds_tracks
    }

    /// Whether it holds no-fly areas.
    pub fn holds_areas(self) -> bool {
        self.info().beside == HeldBeside::AreasAndRally
    }

    /// Whether it holds rally points, beside routes or in a file of their own.
    pub fn holds_rally(self, is_beside_routes: bool) -> bool {
        match self.info().beside {
            HeldBeside::Nothing => false,
            HeldBeside::RallyAlone => !is_beside_routes,
            HeldBeside::Rally | HeldBeside::AreasAndRally => true,
        }
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
        Self::all().find(|format| format.info().is_named(name))
    }

    /// The format to write under a file's name; `None` also for extensions of files that are only read.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert_eq!(Format::to_write("out.plan"), Some(Format::Plan));
    /// assert_eq!(Format::to_write("out.mission"), None);
    /// ```
    pub fn to_write(name: &str) -> Option<Self> {
        let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
        let mut only_read = ONLY_READ.iter();
        let is_only_read = only_read.any(|only| only.eq_ignore_ascii_case(extension));
        Self::of_name(name).filter(|_| !is_only_read)
    }
}

/// Extensions, each once, with their dots and commas between.
fn in_words(extensions: impl Iterator<Item = &'static &'static str>) -> String {
    let mut all: Vec<String> = Vec::new();
    for extension in extensions {
        let dotted = format!(".{extension}");
        if !all.contains(&dotted) {
            all.push(dotted);
        }
    }
    all.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_plan_is_written_under_the_name_of_an_old_mission() {
        assert_eq!(Format::of_name("o.mission"), Some(Format::Plan));
        for name in ["o.mission", "o.MISSION", "o.wpml", "o.lnmpln"] {
            assert_eq!(Format::to_write(name), None, "{name}");
        }
        for format in Format::told_by_extension() {
            let name = format!("o.{}", format.extensions()[0]);
            assert_eq!(Format::to_write(&name), Some(format));
        }
    }

    #[test]
    fn every_format_has_a_name_of_its_own_and_a_writer_of_tracks_if_it_says_so() {
        for format in Format::all() {
            let same = Format::all().filter(|other| other.name() == format.name());
            assert_eq!(same.count(), 1, "{format:?}");
            assert_eq!(format.work().track.is_some(), format.holds_tracks());
        }
    }
}
