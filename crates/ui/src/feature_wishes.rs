//! Wishes of features, which the app fulfils, and the files and flights that they are of.

use pilotage_core::mission::Mission;
use pilotage_jobs::{FlightSource, MapSource};

use crate::command::Command;
use crate::documents::{Documents, Session};
use crate::host::OpenedFile;

/// Wish of a feature as to its panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PanelWish {
    /// It is to be shown.
    Shown,
    /// Another one is to be shown.
    Hidden,
    /// It is to be shown, unless one is that takes the whole column.
    Offered,
}

/// Wishes of a feature that the app fulfils once the feature is done.
#[derive(Debug, Default)]
pub struct FeatureWishes {
    /// Its panel.
    pub panel: Option<PanelWish>,
    /// Whether the mission changed in a way that changes the run.
    pub is_run_stale: bool,
    /// Whether no worker may have the log any more.
    pub is_log_lost: bool,
    /// Whether something changed that is stored with the documents.
    pub is_document_changed: bool,
    /// Landmark that was just made, to be presented.
    pub presented: Option<u32>,
    /// Commands that are carried out then.
    pub commands: Vec<Command>,
    /// Map to be shown.
    pub map: Option<MapSource>,
    /// Flight to be flown in the place of the one that is being flown.
    pub flight: Option<FlightWish>,
    /// Files to be kept for the next visit.
    pub kept: Vec<OpenedSet>,
    /// Files to be opened as if people had chosen them, each set by itself.
    pub opened: Vec<Vec<OpenedFile>>,
    /// Flight in opened files to be read, and flown then.
    pub read: Option<FlightFiles>,
    /// Session that takes the place of what is open.
    pub session: Option<Session>,
}

/// Flight to be flown in the place of the one that is being flown.
#[derive(Debug)]
pub enum FlightWish {
    /// None.
    Nothing,
    /// A flight, over this map, with the mission that is open.
    Open(Box<(FlightSource, MapSource)>),
    /// A flight, over this map, with the mission that comes with it.
    Own(Box<(FlightSource, MapSource)>),
    /// A flight of files, over this map.
    Read(Box<(FlightFiles, MapSource)>),
}

/// Set of files that were opened at once.
#[derive(Clone, Debug)]
pub struct OpenedSet {
    /// Key under which the workers have them.
    pub key: String,
    /// Name of the files for people.
    pub name: String,
    /// The files themselves.
    pub files: Vec<OpenedFile>,
}

/// Flight in opened files.
#[derive(Clone, Debug)]
pub struct FlightFiles {
    /// Key under which the workers have the files.
    pub key: String,
    /// Name of its log among them, or of the flight if it is tables or photos.
    pub name: String,
    /// Map over which it is flown, where that is known already.
    pub map: Option<MapSource>,
    /// Mission to fly it with, where there is one.
    pub mission: Option<Mission>,
    /// Whether it is the flight that is open, so that the mission that is open is its own.
    pub is_open: bool,
}

impl FlightFiles {
    /// Flight of files that were opened.
    pub fn opened(
        key: String,
        name: String,
        map: Option<MapSource>,
        mission: Option<Mission>,
    ) -> Self {
        Self {
            key,
            name,
            map,
            mission,
            is_open: false,
        }
    }

    /// Flight of files that is open, to be read once more; none if no flight of files is.
    pub fn open(documents: &Documents) -> Option<Self> {
        let Session {
            flight: FlightSource::Files(key),
            map,
            mission,
            log,
            ..
        } = documents.session()
        else {
            return None;
        };
        Some(Self {
            key,
            name: log.unwrap_or_else(|| "The flight".to_owned()),
            map: Some(map),
            mission,
            is_open: true,
        })
    }
}
