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

/// Routes and landmarks that one file holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum HeldTogether {
    /// A mission of an aircraft, and nothing else.
    Mission,
    /// Any number of routes, or of landmarks: its rows are of one kind.
    Either,
    /// Any number of both.
    Both,
}

/// Description of a format; it stands beside the code that writes it.
pub(super) struct FormatInfo {
    /// Name for people.
    pub name: &'static str,
    /// Words for a file of the format, as in "save the route as …".
    pub as_words: &'static str,
    /// Extensions of file names, without the dot; the first is written.
    pub extensions: &'static [&'static str],
    /// Those of its extensions that files of anything have: its words tell it then.
    pub anybodys: &'static [&'static str],
    /// Maker whose missions have the extensions of another format, as people name it to programs; else the extension of a
    /// file's name tells the format.
    pub maker: Option<&'static str>,
    /// Routes and landmarks that one file holds.
    pub together: HeldTogether,
    /// Whether it holds a flown track.
    pub holds_tracks: bool,
    /// Contents that it holds beside routes and landmarks.
    pub beside: HeldBeside,
}

impl FormatInfo {
    /// Whether the extension of a file's name is one of its own, whoever else's it is.
    pub fn has_extension(&self, name: &str) -> bool {
        has_one(name, self.extensions)
    }

    /// Whether the extension of a file's name is one of its own that files of anything have.
    pub fn has_extension_of_anybody(&self, name: &str) -> bool {
        has_one(name, self.anybodys)
    }

    /// Whether the extension of a file's name tells it.
    pub fn is_named(&self, name: &str) -> bool {
        self.maker.is_none() && self.has_extension(name)
    }
}

fn has_one(name: &str, extensions: &[&str]) -> bool {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let mut all = extensions.iter();
    all.any(|one| one.eq_ignore_ascii_case(extension))
}
