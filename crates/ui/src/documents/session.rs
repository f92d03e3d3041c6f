//! Documents and view that are remembered between visits.

use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::panel_layout::PanelLayout;
use crate::command::Workspace;
use crate::units::Units;
use pilotage_jobs::{FlightSource, MapSource, SimulationOptions};

/// Key of the document in the browser's storage.
pub const SESSION_KEY: &str = "session";
/// Key of a document that could not be read: a later version of the program may.
pub const UNREAD_KEY: &str = "unread session";
/// Key of the view in the browser's storage.
pub const VIEW_KEY: &str = "view";

/// The document: what was flown, over which map, with which mission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Session {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// The mission, if it was changed from the scenario's own.
    pub mission: Option<Mission>,
    /// Bookmarks, seconds in the flight's time base.
    pub bookmarks: Vec<f64>,
    /// Name of the log among the flight's files, if it was read from one.
    #[serde(default)]
    pub log: Option<String>,
}

impl Session {
    /// The built-in demo.
    pub fn demo() -> Self {
        let demo = SimulationOptions::demo();
        Self {
            map: demo.map(),
            flight: FlightSource::Simulated(demo),
            mission: None,
            bookmarks: Vec::new(),
            log: None,
        }
    }
}

/// View preferences of the user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewState {
    /// Dark colours.
    pub dark: bool,
    /// The user's units.
    pub units: Units,
    /// The open workspace.
    pub workspace: Workspace,
    /// Whether the column at the right is open; by the window's size if the user never said.
    pub side_open: Option<bool>,
    /// Whether the plots are open; by the window's height if the user never said.
    pub plots_open: Option<bool>,
    /// Width of the column at the right, points, if the user changed it.
    pub side_width: Option<f32>,
    /// Height of the plots, points, if the user changed it.
    pub plots_height: Option<f32>,
    /// Height of the prediction's strip, points, if the user changed it.
    pub strip_height: Option<f32>,
    /// Kind of work that the panels above are of; empty in sessions that know one layout alone.
    pub panels_of: String,
    /// Panels of other kinds of work.
    pub other_panels: Vec<(String, PanelLayout)>,
    /// Number of times that panels were reset at this visit.
    #[serde(skip)]
    pub resets: u32,
    /// Whether the first line of advice was dismissed.
    pub advice_dismissed: bool,
    /// Playback speed, times real time.
    pub speed: f64,
    /// Repeat at the end.
    pub looping: bool,
    /// Map layers that are switched off, by name.
    pub hidden_layers: Vec<String>,
    /// Parts of features as JSON by their identities: they are stored beside the fields above, of which none is an
    /// object.
    #[serde(skip)]
    pub features: Vec<(String, String)>,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            dark: true,
            units: Units::default(),
            workspace: Workspace::default(),
            side_open: None,
            plots_open: None,
            side_width: None,
            plots_height: None,
            strip_height: None,
            panels_of: String::new(),
            other_panels: Vec::new(),
            resets: 0,
            advice_dismissed: false,
            speed: 2.0,
            looping: true,
            hidden_layers: Vec::new(),
            features: Vec::new(),
        }
    }
}

impl ViewState {
    /// As bytes for the storage.
    pub fn encode(&self) -> Vec<u8> {
        let mut text = serde_json::to_string(self).unwrap_or_default();
        for (id, part) in &self.features {
            if text.pop().is_some() {
                text = format!("{text},\"{id}\":{part}}}");
            }
        }
        text.into_bytes()
    }

    /// From the storage; the default if there is nothing readable.
    pub fn decode(bytes: &[u8]) -> Self {
        let text = std::str::from_utf8(bytes).unwrap_or_default();
        let all: Map<String, Value> = serde_json::from_str(text).unwrap_or_default();
        let parts = all.into_iter().filter(|(_, part)| part.is_object());
        Self {
            features: parts.map(|(id, part)| (id, part.to_string())).collect(),
            ..serde_json::from_str(text).unwrap_or_default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::mission::NoFlyZone;
    use serde_json::json;

    #[test]
    fn a_session_survives_the_storage() {
        let session = Session {
            mission: Some(crate::documents::empty_mission()),
            bookmarks: vec![1.5],
            ..Session::demo()
        };
        assert_eq!(Session::decode(&session.encode()), Some(session));
    }

    #[test]
    fn a_session_of_another_version_is_not_read() {
        let mut bytes = Session::demo().encode();
        bytes[0] = 0;
        assert_eq!(Session::decode(&bytes), None);
    }

    #[test]
    fn areas_that_were_stored_before_they_could_have_holes_are_read() {
        let mut mission = crate::documents::empty_mission();
        mission.no_fly.push(NoFlyZone {
            name: "Village".to_owned(),
            ..NoFlyZone::default()
        });
        let session = Session {
            mission: Some(mission),
            ..Session::demo()
        };
        let text = String::from_utf8(session.encode()).unwrap();
        let before = text.replace("\"holes\":[],", "");
        assert_ne!(before, text);
        assert_eq!(Session::decode(before.as_bytes()), Some(session));
    }

    #[test]
    fn parts_of_features_are_stored_beside_what_is_the_views_own() {
        let stored = br#"{"dark":false,"plan":{"limit":7.5}}"#;
        let mut view = ViewState::decode(stored);
        assert!(!view.dark);
        let part = (String::from("plan"), String::from("{\"limit\":7.5}"));
        assert_eq!(view.features, [part]);
        view.dark = true;
        let again: Value = serde_json::from_slice(&view.encode()).unwrap();
        assert_eq!(again["dark"], json!(true));
        assert_eq!(again["plan"], json!({"limit": 7.5}));
        assert_eq!(ViewState::decode(&view.encode()).dark, view.dark);
    }

    #[test]
    fn a_damaged_view_is_the_default_one() {
        assert_eq!(ViewState::decode(b"{"), ViewState::default());
    }
}
