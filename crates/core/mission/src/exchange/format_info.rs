//! Description of a format, apart from the code that reads and writes it: menus link no readers.

/// Contents that a format holds beside routes and landmarks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum HeldBeside {
    /// None.
    Nothing,
    /// Rally points in a file of their own.
    RallyAlone,
    /// Rally points.
    Rally,
    /// No-fly areas and rally points.
    AreasAndRally,
}

/// Description of a format; it stands beside the code that writes it.
pub(super) struct FormatInfo {
    /// Name for people.
    pub name: &'static str,
    /// Words for a file of the format, as in "save the route as …".
    pub as_words: &'static str,
    /// Extensions of file names, without the dot; the first is written.
    pub extensions: &'static [&'static str],
    /// Whether the extension of a file's name tells it; else that is another format's.
    pub is_told_by_extension: bool,
    /// Whether it holds one mission of an aircraft, and nothing else.
    pub is_mission: bool,
    /// Whether it holds a flown track.
    pub holds_tracks: bool,
    /// Contents that it holds beside routes and landmarks.
    pub beside: HeldBeside,
}

impl FormatInfo {
    /// Whether the extension of a file's name is one of its own, whoever else's it is.
    pub fn has_extension(&self, name: &str) -> bool {
        let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
        let mut own = self.extensions.iter();
        own.any(|own| own.eq_ignore_ascii_case(extension))
    }

    /// Whether the extension of a file's name tells it.
    pub fn is_named(&self, name: &str) -> bool {
        self.is_told_by_extension && self.has_extension(name)
    }
}
