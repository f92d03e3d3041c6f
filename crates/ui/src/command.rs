//! Commands that people can give: one enum feeds menu, palette, shortcuts and the help sheet.

use pilotage_core::frames::GroundRect;
use pilotage_core::navigator::NavigatorSettings;

use crate::feature_command::{FeatureCommand, FeatureId};
use serde::{Deserialize, Serialize};

/// Something to do, sent by a view and carried out by the app at the end of the frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Play or pause.
    TogglePlay,
    /// Move the time cursor to a time of the flight, seconds.
    SeekTo(f64),
    /// Move the time cursor by camera frames.
    StepFrames(i32),
    /// Move the time cursor by seconds.
    Jump(f64),
    /// Move the time cursor to the first time.
    GoToStart,
    /// Move the time cursor to the last time.
    GoToEnd,
    /// Select a span of time, seconds of the flight, or none.
    SelectSpan(Option<(f64, f64)>),
    /// Let the selected span begin at the cursor.
    SelectFromHere,
    /// Let the selected span end at the cursor.
    SelectToHere,
    /// Playback speed, times real time.
    SetSpeed(f64),
    /// Repeat at the end, or not.
    ToggleLoop,
    /// Drop a bookmark at the cursor, or take it away.
    ToggleBookmark,
    /// Go to the previous bookmark.
    PreviousBookmark,
    /// Go to the next bookmark.
    NextBookmark,
    /// Select a landmark by id, or none.
    SelectLandmark(Option<u32>),
    /// Begin to draw a landmark on the map, or stop.
    TogglePickTool,
    /// Have all tools leave the map but that of a feature.
    LeaveMap(FeatureId),
    /// Add a landmark with this box.
    AddLandmark(GroundRect),
    /// Give a landmark another box; `finished` is false while the drag goes on.
    ReshapeLandmark {
        /// Landmark id.
        id: u32,
        /// Its new box.
        bounds: GroundRect,
        /// Whether the drag is over (one undo step).
        finished: bool,
    },
    /// Name a landmark.
    RenameLandmark {
        /// Landmark id.
        id: u32,
        /// Its new name.
        name: String,
    },
    /// Switch a landmark on or off.
    EnableLandmark {
        /// Landmark id.
        id: u32,
        /// Whether the navigator looks for it.
        enabled: bool,
    },
    /// Delete a landmark.
    DeleteLandmark(u32),
    /// Delete the landmark that is selected.
    DeleteSelectedLandmark,
    /// Navigate with other settings; the run recomputes.
    SetNavigator(Box<NavigatorSettings>),
    /// Take the last edit back.
    Undo,
    /// Make the edit taken back again.
    Redo,
    /// Compute the run again.
    FlyAgain,
    /// Stop what is being computed.
    CancelJob,
    /// Show or hide the command palette.
    TogglePalette,
    /// Show or hide the sheet of shortcuts.
    ToggleHelp,
    /// Show or hide the sheet of notices.
    ToggleNotices,
    /// Show or hide the filter settings.
    ToggleSettings,
    /// Open files.
    Open,
    /// North up or track up.
    ToggleTrackUp,
    /// Show the whole flight on the map.
    FitMap,
    /// Dark or light.
    ToggleTheme,
    /// Metric or aviation units.
    ToggleUnits,
    /// Go back to the built-in demo.
    OpenDemo,
    /// Show a workspace.
    ShowWorkspace(Workspace),
    /// Show or hide the column at the right.
    ToggleSide,
    /// Show or hide the plots.
    TogglePlots,
    /// Have the panels and the map of the workspace as they were at first.
    ResetView,
    /// Keep the aircraft in the middle of the map, or not.
    ToggleFollow,
    /// Something that a feature does.
    Feature(FeatureCommand),
}

/// The three workspaces over the same documents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Workspace {
    /// Landmarks on the map.
    Plan,
    /// A flight run through the navigator.
    #[default]
    Replay,
    /// The method step by step.
    Learn,
}

impl Workspace {
    /// Every workspace, in the order of the tabs.
    pub const ALL: [Self; 3] = [Self::Replay, Self::Plan, Self::Learn];

    /// Name on the tab.
    pub fn label(self) -> &'static str {
        match self {
            Self::Plan => "Plan",
            Self::Replay => "Replay",
            Self::Learn => "Learn",
        }
    }
}
