//! Contents of provided files.

use pilotage_core::exchange::labels::FoundLabels;
use pilotage_core::flight::Flight;
use pilotage_core::flight::columns::GuessedTable;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::Run;
use serde::{Deserialize, Serialize};

use super::{Beside, ImportedFile, MapInfo, TerrainInfo, Unplaced};

/// Contents of provided files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OpenedFiles {
    /// Key of the files.
    pub key: String,
    /// A flight, if there is one.
    pub flight: Option<Flight>,
    /// Name of a flight log that is to be read, if there is one.
    pub log: Option<String>,
    /// A map, if there is one.
    pub map: Option<MapInfo>,
    /// An elevation model, if there is one.
    pub terrain: Option<TerrainInfo>,
    /// A mission, if there is one.
    pub mission: Option<Mission>,
    /// A saved run, if there is one.
    pub run: Option<Run>,
    /// A picture that does not say where it lies, if there is nothing else.
    pub unplaced: Option<Unplaced>,
    /// Names of the photos, if there is nothing else but a map or the flight that they are.
    pub photos: Vec<String>,
    /// Routes and landmarks of other programs, to be added to the mission.
    pub imports: Vec<ImportedFile>,
    /// Tables of a flight, if it is to be asked what their columns mean.
    pub tables: Vec<GuessedTable>,
    /// Labels of pictures, to be added to the mission.
    pub labels: Option<FoundLabels>,
    /// Simulation, bookmarks and measurements that were open beside the mission when it was saved.
    pub beside: Option<Beside>,
    /// Remarks on skipped things, in words.
    pub remarks: Vec<String>,
}
