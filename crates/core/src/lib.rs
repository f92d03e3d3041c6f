//! The method of Pilotage without a screen: frames, pictures, cameras, filter, vehicles, imagery,
//! landmarks, flights, the navigator, a world to try it in, detectors trained in it, and studies.
//!
//! A facade: every name here is that of one of the crates in the folders beside it, by the subject under
//! which people look for it. None of them reaches a screen, a clock, a file system or a thread.

pub use pilotage_base::{angle_text, frames, gazetteer, place_text, sorting, text, viridis};
pub use pilotage_estimation::vehicle;
pub use pilotage_mission::exchange;
pub use pilotage_navigator::{instruments, study};
pub use pilotage_raster::{camera, raster};
pub use pilotage_reference as reference;
pub use pilotage_roads as roads;
pub use pilotage_simulate::simulate;
pub use pilotage_training as training;
pub use pilotage_vision::{ground_class, landmark, registration, road, straight_edge};

/// Estimators, gates, consistency, and the distributions behind them.
pub mod filter {
    pub use pilotage_base::statistics::*;
    pub use pilotage_estimation::filter::*;
}

/// Whatever can be a map: the trait over it, and its sources.
pub mod imagery {
    pub use pilotage_base::bytes::*;
    pub use pilotage_base::georeference::*;
    pub use pilotage_maps::{
        GeoKeys, GeoTiff, GeoTiffError, GeoTiffFile, MapMemory, georeferencer, systems, terrain,
        tiff, web_tiles,
    };
    pub use pilotage_raster::imagery::*;
}

/// Measurements of a flight, and the files of other programs that hold them.
pub mod flight {
    pub use pilotage_base::files;
    pub use pilotage_flight::*;
    pub use pilotage_readers::*;
}

/// Missions that people author, and the map that they lie on.
pub mod mission {
    pub use pilotage_maps::{
        CornersError, MapFileError, MapOptions, Mosaic, OpenMap, open_dem, open_map, open_map_with,
        places_in_degrees, with_world_file,
    };
    pub use pilotage_mission::mission::*;
}

/// The pipeline from prediction to report, and its settings.
pub mod navigator {
    pub use pilotage_mission::settings::{
        ChosenAid, Cruise, EstimatorChoice, EstimatorSettings, NavigatorSettings, ProcessNoise,
        ROAD_MAP, SensorNoise, StartError, VehicleChoice,
    };
    pub use pilotage_navigator::navigator::*;
}

/// A camera put in time and place beside a log.
pub mod calibration {
    pub use pilotage_mission::settings::CameraAdjustment;
    pub use pilotage_navigator::calibration::*;
}

/// Forecasts of a flight before take-off.
pub mod plan {
    pub use pilotage_plan::*;
    pub use pilotage_simulate::other_days::*;
}
