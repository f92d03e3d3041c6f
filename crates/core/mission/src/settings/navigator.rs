//! Settings of the navigator for people.

use nalgebra::{Matrix4, Vector4};
use serde::{Deserialize, Serialize};

use super::{ChosenAid, EstimatorSettings};
use pilotage_estimation::vehicle::{Multirotor, VelocityDriven};
use pilotage_vision::landmark::TemplateSettings;
use pilotage_vision::registration::FollowSettings;

/// Choice of the process model of the filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum VehicleChoice {
    /// Position and wind, driven by airspeed and heading (DeAngelo 2016, eqs 25-30).
    #[default]
    AirplaneWind,
    /// As before, with a gust of finite memory beside the mean wind.
    AirplaneGust,
    /// As before, with slowly varying biases of airspeed and heading.
    AirplaneFull,
    /// No airspeed: position driven by nothing but uncertainty.
    RandomWalk,
    /// No airspeed: nearly constant velocity.
    ConstantVelocity,
    /// No airspeed: a multirotor that tilts to move, in a wind (DeAngelo 2016, eqs 49-54).
    Multirotor,
    /// No airspeed: a measured velocity over ground (DeAngelo 2016, eqs 55-56).
    VelocityDriven,
}

impl VehicleChoice {
    /// Every choice, in the order in which people read them.
    pub const ALL: [Self; 7] = [
        Self::AirplaneWind,
        Self::AirplaneGust,
        Self::AirplaneFull,
        Self::RandomWalk,
        Self::ConstantVelocity,
        Self::Multirotor,
        Self::VelocityDriven,
    ];

    /// Name on the command line and in plans of studies.
    pub fn key(self) -> &'static str {
        match self {
            Self::AirplaneWind => "airplane-wind",
            Self::AirplaneGust => "airplane-gust",
            Self::AirplaneFull => "airplane-full",
            Self::RandomWalk => "random-walk",
            Self::ConstantVelocity => "constant-velocity",
            Self::Multirotor => "multirotor",
            Self::VelocityDriven => "velocity-driven",
        }
    }

    /// The choice of that name.
    ///
    /// # Errors
    /// There is none: with the names that there are.
    ///
    /// ```
    /// use pilotage_mission::settings::VehicleChoice;
    ///
    /// assert_eq!(VehicleChoice::from_key("velocity-driven"), Ok(VehicleChoice::VelocityDriven));
    /// assert!(VehicleChoice::from_key("glider").is_err_and(|why| why.contains("random-walk")));
    /// ```
    pub fn from_key(key: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|choice| choice.key() == key);
        found.ok_or_else(|| format!("there are {}", Self::ALL.map(Self::key).join(", ")))
    }

    /// Whether its prediction needs a measured heading.
    pub fn needs_heading(self) -> bool {
        !matches!(
            self,
            Self::RandomWalk | Self::ConstantVelocity | Self::VelocityDriven
        )
    }

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::AirplaneWind => "Airplane + wind",
            Self::AirplaneGust => "Airplane + wind + gust",
            Self::AirplaneFull => "Airplane + wind + gust + sensor biases",
            Self::RandomWalk => "No airspeed, random walk",
            Self::ConstantVelocity => "No airspeed, nearly constant velocity",
            Self::Multirotor => "Multirotor + wind",
            Self::VelocityDriven => "No airspeed, measured velocity",
        }
    }
}

/// Uncertainty at the start, standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartError {
    /// Position per axis, metres.
    pub position: f64,
    /// Wind (or velocity, for models without airspeed) per axis, m/s.
    pub wind: f64,
    /// Error deliberately added to the start position, metres (north, east).
    pub offset: [f64; 2],
}

/// Airspeed to assume while none can be believed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cruise {
    /// The airspeed, m/s.
    pub airspeed: f64,
    /// Its standard deviation, m/s.
    pub deviation: f64,
}

impl Default for Cruise {
    fn default() -> Self {
        Self {
            airspeed: 18.0,
            deviation: 0.7,
        }
    }
}

/// Process noise as continuous-time densities, unless the thesis' per-step Q is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProcessNoise {
    /// White noise of the airspeed seen by the position, (m/s)/√Hz.
    pub airspeed: f64,
    /// White noise of the heading seen by the position, rad/√Hz.
    pub heading: f64,
    /// White noise of the position itself, m/√s.
    pub position: f64,
    /// Random walk of the wind, (m/s)/√s.
    pub wind: f64,
    /// Least standard deviation of the gust per axis, m/s.
    pub gust: f64,
    /// Standard deviation of the gust per axis in a wind of 1 m/s, where that is more: the filter
    /// expects the gusts of the wind that it has found.
    #[serde(default)]
    pub gust_per_wind: f64,
    /// Correlation time of the gust, seconds.
    pub gust_time: f64,
    /// Standard deviation of the airspeed bias at the start, m/s.
    pub airspeed_bias: f64,
    /// Standard deviation of the heading bias at the start, radians.
    pub heading_bias: f64,
    /// White noise of the acceleration for the model of nearly constant velocity and for the multirotor,
    /// (m/s²)/√Hz.
    pub acceleration: f64,
    /// Drag of a multirotor: its deceleration per velocity through the air, 1/s.
    #[serde(default = "usual_drag")]
    pub drag: f64,
    /// White noise of a measured velocity over ground, (m/s)/√Hz.
    #[serde(default = "usual_velocity")]
    pub velocity: f64,
    /// Airspeed to assume where none is measured; the navigator takes what a flight with failing instruments
    /// flies usually.
    #[serde(default)]
    pub cruise: Cruise,
    /// Use DeAngelo's Table 4 (distinct landmarks) once per step, whatever the step.
    pub thesis_per_step: bool,
}

/// White noise of a position of which nothing is measured, for slow vehicles, m/√s.
const UNKNOWN_MOTION: f64 = 6.0;

impl ProcessNoise {
    /// White noise of a position that moves by itself alone, as in a random walk, m/√s: as stated, or else that of an
    /// unknown motion. Without any, the position would be believed to stand still.
    pub fn position_alone(&self) -> f64 {
        if self.position > 0.0 {
            self.position
        } else {
            UNKNOWN_MOTION
        }
    }
}

fn usual_drag() -> f64 {
    Multirotor::default().drag
}

fn usual_velocity() -> f64 {
    VelocityDriven::default().velocity_noise_density
}

/// Standard deviations of what the camera's pose is computed from, per frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorNoise {
    /// Roll of the camera: sensor and mount vibration together, radians.
    pub roll: f64,
    /// Pitch of the camera, radians.
    pub pitch: f64,
    /// Yaw of the camera, radians.
    pub yaw: f64,
    /// Height above ground, metres.
    pub height: f64,
    /// Error of the detector's place that its covariance cannot know, added to it, pixels per axis.
    pub pixel: f64,
    /// The same on the ground, metres per axis: another sun and season move what a patch looks like, the same way in
    /// every frame and from every height.
    #[serde(default)]
    pub ground: f64,
    /// Part of roll's and of pitch's deviation that stays the same over a flight, radians each: two states of the filter
    /// where the height is none, and where the map's error is none either, or whole frames are laid that are taken to be
    /// tilted by less.
    #[serde(default)]
    pub tilt_bias: f64,
    /// The same of yaw, radians: a vehicle model that estimates the heading's bias knows it already.
    #[serde(default)]
    pub yaw_bias: f64,
    /// The same of the height, metres: looks at a landmark share it.
    #[serde(default)]
    pub height_bias: f64,
}

impl SensorNoise {
    /// Covariance of the camera's roll, pitch, yaw (radians) and height (metres).
    ///
    /// ```
    /// use pilotage_mission::settings::NavigatorSettings;
    ///
    /// let sensors = NavigatorSettings::default().sensors;
    /// let covariance = sensors.pose_covariance();
    /// // Roll 1.05°, height 0.6 m.
    /// assert!((covariance[(0, 0)] - 1.05_f64.to_radians().powi(2)).abs() < 1e-12);
    /// assert!((covariance[(3, 3)] - 0.36).abs() < 1e-12);
    /// ```
    pub fn pose_covariance(&self) -> Matrix4<f64> {
        let deviations = Vector4::new(self.roll, self.pitch, self.yaw, self.height);
        Matrix4::from_diagonal(&deviations.map(|sd| sd * sd))
    }

    /// The same with no part that stays over a flight larger than the whole.
    #[must_use]
    pub fn with_biases_within(&self) -> Self {
        Self {
            tilt_bias: self.tilt_bias.min(self.roll).min(self.pitch),
            yaw_bias: self.yaw_bias.min(self.yaw),
            height_bias: self.height_bias.min(self.height),
            ..*self
        }
    }

    /// The noise that is left of it in each frame where the biases of the tilt, and that of the yaw, are known apart.
    ///
    /// ```
    /// # use pilotage_mission::settings::NavigatorSettings;
    /// let usual = NavigatorSettings::default().sensors;
    /// let biased = pilotage_mission::settings::SensorNoise { tilt_bias: 0.63_f64.to_radians(), ..usual };
    /// // Of 1.05°, of which 0.63° stay, 0.84° are new in each frame.
    /// let left = biased.without_biases(true, false);
    /// assert!((left.roll - 0.84_f64.to_radians()).abs() < 1e-12);
    /// assert_eq!((left.tilt_bias, left.yaw), (0.0, usual.yaw));
    /// ```
    #[must_use]
    pub fn without_biases(&self, of_tilt: bool, of_yaw: bool) -> Self {
        let left = |all: f64, lasting: f64| (all * all - lasting * lasting).max(0.0).sqrt();
        let tilt = if of_tilt { self.tilt_bias } else { 0.0 };
        let yaw = if of_yaw { self.yaw_bias } else { 0.0 };
        Self {
            roll: left(self.roll, tilt),
            pitch: left(self.pitch, tilt),
            yaw: left(self.yaw, yaw),
            tilt_bias: self.tilt_bias - tilt,
            yaw_bias: self.yaw_bias - yaw,
            ..*self
        }
    }
}

/// Settings of the navigator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NavigatorSettings {
    /// Process model.
    pub vehicle: VehicleChoice,
    /// Spread of the sigma points, 1e-4 to 1 (eq 10).
    pub alpha: f64,
    /// Prior knowledge of the distribution, 2 for Gaussian (eq 12).
    pub beta: f64,
    /// Draw the sigma points anew after the process noise was added (otherwise carry them through).
    pub redraw: bool,
    /// Confidence of the innovation gate, e.g. 0.99.
    pub gate_confidence: f64,
    /// Uncertainty at the start.
    pub start: StartError,
    /// Process noise.
    pub process: ProcessNoise,
    /// Noise of the camera's pose.
    pub sensors: SensorNoise,
    /// Factor on the whole measurement covariance R.
    pub measurement_scale: f64,
    /// The template detector.
    pub detector: TemplateSettings,
    /// Most landmarks looked for in one frame.
    pub most_landmarks: usize,
    /// Shortest step from one picture-less moment to the next, seconds: measurements that follow each other
    /// faster are taken together. Zero makes a step of each.
    #[serde(default)]
    pub shortest_step: f64,
    /// Choice of the filter that works on the process model; files that say nothing mean the unscented one.
    #[serde(default)]
    pub estimator: EstimatorSettings,
    /// Lay whole frames on the map, with what is assumed of them; `None` looks for landmarks alone.
    #[serde(default)]
    pub whole_frames: Option<FollowSettings>,
    /// Aids beside pictures that are switched on, in the order in which they are asked.
    #[serde(default)]
    pub aids: Vec<ChosenAid>,
    /// Estimate the height of the vehicle as well, and the bias of its barometer: for aids that measure them. The map's
    /// error is then no state of the filter but noise of every frame.
    #[serde(default)]
    pub estimates_height: bool,
}

impl Default for NavigatorSettings {
    fn default() -> Self {
        Self {
            vehicle: VehicleChoice::default(),
            alpha: 1.0,
            beta: 2.0,
            redraw: true,
            gate_confidence: 0.997,
            start: StartError {
                position: 3.0,
                wind: 4.0,
                offset: [0.0, 0.0],
            },
            process: ProcessNoise {
                airspeed: 0.1,
                heading: 0.002,
                position: 0.0,
                wind: 0.05,
                gust: 0.3,
                gust_per_wind: 0.0,
                gust_time: 12.0,
                airspeed_bias: 0.2,
                heading_bias: 0.5_f64.to_radians(),
                acceleration: 1.0,
                drag: usual_drag(),
                velocity: usual_velocity(),
                cruise: Cruise::default(),
                thesis_per_step: false,
            },
            sensors: SensorNoise {
                roll: 1.05_f64.to_radians(),
                pitch: 1.05_f64.to_radians(),
                yaw: 1.15_f64.to_radians(),
                height: 0.6,
                pixel: 1.0,
                ground: 0.0,
                tilt_bias: 0.0,
                yaw_bias: 0.0,
                height_bias: 0.0,
            },
            measurement_scale: 1.0,
            detector: TemplateSettings::default(),
            most_landmarks: 8,
            shortest_step: 0.0,
            estimator: EstimatorSettings::default(),
            whole_frames: None,
            aids: Vec::new(),
            estimates_height: false,
        }
    }
}
