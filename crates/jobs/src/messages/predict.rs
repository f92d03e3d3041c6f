//! A plan whose uncertainty is to be predicted.

use pilotage_core::camera::CameraModel;
use pilotage_core::flight::Flight;
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::DetectionStatistics;
use pilotage_core::simulate::{SensorSpec, Target, Wind};
use serde::{Deserialize, Serialize};

/// Room beside a leg that is flown over because of wind and turns, metres.
const BESIDE: f64 = 150.0;
/// Width that the camera sees to each side, of the height.
const SIDEWAYS: f64 = 1.5;

/// Path of a planned flight, and with what it is flown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedPath {
    /// Way-points over the ground.
    pub way_points: Vec<GroundPoint>,
    /// Height above ground, metres.
    pub height: f64,
    /// Height and airspeed at each way-point; empty where all are flown over alike.
    pub targets: Vec<Target>,
    /// Airspeed, m/s; the aircraft's cruise if `None`.
    pub airspeed: Option<f64>,
    /// Bank limit, radians; the aircraft's if `None`.
    pub bank: Option<f64>,
    /// Mean wind.
    pub wind: Wind,
    /// The camera.
    pub camera: CameraModel,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Pictures a second; as many as the simulator's camera takes if `None`.
    #[serde(default)]
    pub frame_rate: Option<f64>,
}

/// Planned flight whose uncertainty is to be predicted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictionOrder {
    /// Path of the flight.
    pub path: PlannedPath,
    /// Settings of the navigator of the planned flight.
    pub navigator: NavigatorSettings,
    /// The landmarks that are switched on, and what is expected of them.
    pub landmarks: Vec<(Landmark, DetectionStatistics)>,
    /// Worlds to try: [`COARSE`] or [`FINE`].
    pub worlds: usize,
    /// Seed of the worlds; [`Self::SEED`], so that the same plan has the same prediction.
    pub seed: u64,
    /// Standard deviation of the position (longer axis) over which stretches are marked, metres.
    pub limit: f64,
}

impl PredictionOrder {
    /// Standard deviation of the position (longer axis) that is accepted where nobody states another, metres.
    pub const LIMIT: f64 = 10.0;
    /// Seed of predictions where nobody states one.
    pub const SEED: u64 = 1;

    /// Coarse prediction of a path with the navigator of a mission, of whose landmarks nothing is expected yet.
    pub fn along(path: PlannedPath, mission: &Mission) -> Self {
        Self {
            path,
            navigator: mission.navigator.clone(),
            landmarks: Vec::new(),
            worlds: 0,
            seed: Self::SEED,
            limit: f64::INFINITY,
        }
    }
}

impl PlannedPath {
    /// Path over places at one height above level ground, metres, in calm air, as the aircraft usually flies.
    pub fn level(way_points: Vec<GroundPoint>, height: f64, camera: CameraModel) -> Self {
        Self {
            way_points,
            height,
            targets: Vec::new(),
            airspeed: None,
            bank: None,
            wind: Wind::default(),
            camera,
            ground_down: 0.0,
            frame_rate: None,
        }
    }

    /// Pictures a second of the camera that took a flight, by the median of the times between two; `None` where it has fewer
    /// than two.
    pub fn frame_rate_of(flight: &Flight) -> Option<f64> {
        let pairs = flight.frames.windows(2);
        let between = pairs.map(|pair| pair[1].time - pair[0].time);
        let mut between: Vec<f64> = between.filter(|time| *time > 0.0).collect();
        let middle = between.len() / 2;
        (!between.is_empty())
            .then(|| 1.0 / *between.select_nth_unstable_by(middle, f64::total_cmp).1)
    }

    /// Pictures a second with which a flight by such a camera is planned, where it takes fewer than the simulator's. Of more,
    /// each shows what the one before it showed, and is found or missed with it: they are not counted.
    pub fn sparse(frame_rate: Option<f64>) -> Option<f64> {
        frame_rate.filter(|rate| *rate < 0.99 * Self::usual_frame_rate())
    }

    /// Pictures a second of the simulator's camera.
    pub fn usual_frame_rate() -> f64 {
        SensorSpec::default().frame_rate
    }

    /// Ground that the camera may see, by legs.
    pub fn ground(&self) -> Vec<GroundRect> {
        let heights = self.targets.iter().map(|target| target.height);
        let height = heights.fold(self.height, f64::max);
        let legs = self.way_points.windows(2);
        legs.filter_map(|leg| GroundRect::around(leg.iter().copied()))
            .map(|leg| leg.grown(BESIDE + SIDEWAYS * height))
            .collect()
    }
}

/// Worlds of a coarse prediction.
pub const COARSE: usize = 8;

/// Worlds of a fine prediction.
pub const FINE: usize = 100;
