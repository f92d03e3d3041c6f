//! The keys of `--filter`, in one table: what a key changes, and in which unit its value is.

use pilotage_core::landmark::TemplateFeatures;
use pilotage_core::navigator::{AidInfo, EstimatorChoice, NavigatorSettings, VehicleChoice};
use pilotage_core::registration::FollowSettings;

/// Key of `--filter` beside those of aids.
pub struct FilterKey {
    /// Name on the command line.
    pub key: &'static str,
    /// Unit of its value, `""` of numbers without one and of words.
    pub unit: &'static str,
    /// Change of the settings by its value.
    pub change: FilterChange,
}

/// Change of the settings by the value of a key, numbers in the unit of the key.
pub enum FilterChange {
    /// By any number; whether it makes sense the settings say themselves.
    Number(fn(&mut NavigatorSettings, f64)),
    /// By a number from zero on.
    Limit(fn(&mut NavigatorSettings, f64)),
    /// By a height above the ground.
    Height(fn(&mut NavigatorSettings, f64)),
    /// By true or false.
    Switch(fn(&mut NavigatorSettings, bool)),
    /// By a word; which there are is told of any other.
    Word(fn(&mut NavigatorSettings, &str) -> Result<(), String>),
}

use FilterChange::{Height, Limit, Number, Switch, Word};

const fn line(key: &'static str, unit: &'static str, change: FilterChange) -> FilterKey {
    FilterKey { key, unit, change }
}

/// Every key beside those of aids, in the order in which people are told of them.
pub const KEYS: [FilterKey; 42] = [
    line("vehicle", "", Word(set_vehicle)),
    line("estimator", "", Word(set_estimator)),
    line(
        "particles",
        "",
        Number(|s, value| s.estimator.particles.count = value as usize),
    ),
    line("alpha", "", Number(|s, value| s.alpha = value)),
    line("beta", "", Number(|s, value| s.beta = value)),
    line("redraw", "", Switch(|s, is_on| s.redraw = is_on)),
    line("gate", "", Number(|s, value| s.gate_confidence = value)),
    line("scale", "", Number(|s, value| s.measurement_scale = value)),
    line(
        "thesis-q",
        "",
        Switch(|s, is_on| s.process.thesis_per_step = is_on),
    ),
    line("wind", "m/s/√s", Number(|s, value| s.process.wind = value)),
    line("gust", "m/s", Number(|s, value| s.process.gust = value)),
    line(
        "gust-per-wind",
        "",
        Number(|s, value| s.process.gust_per_wind = value),
    ),
    line(
        "gust-time",
        "s",
        Number(|s, value| s.process.gust_time = value),
    ),
    line(
        "airspeed",
        "m/s/√Hz",
        Number(|s, value| s.process.airspeed = value),
    ),
    line(
        "heading",
        "rad/√Hz",
        Number(|s, value| s.process.heading = value),
    ),
    line(
        "position",
        "m/√s",
        Number(|s, value| s.process.position = value),
    ),
    line(
        "acceleration",
        "m/s²/√Hz",
        Number(|s, value| s.process.acceleration = value),
    ),
    line("drag", "1/s", Number(|s, value| s.process.drag = value)),
    line(
        "velocity",
        "m/s/√Hz",
        Number(|s, value| s.process.velocity = value),
    ),
    line(
        "roll",
        "°",
        Number(|s, value| s.sensors.roll = value.to_radians()),
    ),
    line(
        "pitch",
        "°",
        Number(|s, value| s.sensors.pitch = value.to_radians()),
    ),
    line(
        "yaw",
        "°",
        Number(|s, value| s.sensors.yaw = value.to_radians()),
    ),
    line("height", "m", Number(|s, value| s.sensors.height = value)),
    line(
        "tilt-bias",
        "°",
        Number(|s, value| s.sensors.tilt_bias = value.to_radians()),
    ),
    line(
        "yaw-bias",
        "°",
        Number(|s, value| s.sensors.yaw_bias = value.to_radians()),
    ),
    line(
        "height-bias",
        "m",
        Number(|s, value| s.sensors.height_bias = value),
    ),
    line("pixel", "px", Number(|s, value| s.sensors.pixel = value)),
    line("ground", "m", Number(|s, value| s.sensors.ground = value)),
    line("features", "", Word(set_features)),
    line(
        "map-deviation",
        "m",
        Number(|s, value| s.detector.map_deviation = value),
    ),
    line(
        "score",
        "",
        Number(|s, value| s.detector.least_score = value),
    ),
    line(
        "ambiguity",
        "",
        Number(|s, value| s.detector.greatest_ambiguity = value),
    ),
    line(
        "shortest-step",
        "s",
        Number(|s, value| s.shortest_step = value),
    ),
    line("start", "m", Number(|s, value| s.start.position = value)),
    line("start-wind", "m/s", Number(|s, value| s.start.wind = value)),
    line("whole-frames", "", Switch(set_whole_frames)),
    line(
        "frame-height",
        "m",
        Height(|s, value| frames(s).height = value),
    ),
    line(
        "frame-within",
        "m",
        Limit(|s, value| frames(s).farthest = Some(value)),
    ),
    line(
        "frame-heading-within",
        "°",
        Limit(|s, value| frames(s).limit_heading(value.to_radians())),
    ),
    line(
        "frame-height-within",
        "%",
        Limit(|s, value| frames(s).limit_height(0.01 * value)),
    ),
    line(
        "map-accuracy",
        "m",
        Limit(|s, value| frames(s).map_deviation = value),
    ),
    line(
        "estimate-height",
        "",
        Switch(|s, is_on| s.estimates_height = is_on),
    ),
];

/// Keys with their units, and those of the aids with their numbers, in words: `alpha, …; true or false switches an aid …`.
pub fn keys_in_words() -> String {
    let with_unit = |line: &FilterKey| match line.unit {
        "" => line.key.to_owned(),
        unit => format!("{} ({unit})", line.key),
    };
    let keys: Vec<String> = KEYS.iter().map(with_unit).collect();
    let aids: Vec<String> = AidInfo::ALL.iter().map(|info| numbers_of(info)).collect();
    let aids = aids.join(", ");
    format!(
        "{}; true or false switches an aid on or off, AID.NUMBER sets a number of it: {aids}",
        keys.join(", ")
    )
}

/// The aid with the numbers that it has: `gps-velocity (.noise, .apart)`.
fn numbers_of(info: &AidInfo) -> String {
    let numbers = info.numbers.iter();
    let numbers: Vec<String> = numbers.map(|number| format!(".{}", number.key)).collect();
    if numbers.is_empty() {
        info.key.to_owned()
    } else {
        format!("{} ({})", info.key, numbers.join(", "))
    }
}

fn set_vehicle(settings: &mut NavigatorSettings, value: &str) -> Result<(), String> {
    settings.vehicle = VehicleChoice::from_key(value)?;
    Ok(())
}

fn set_estimator(settings: &mut NavigatorSettings, value: &str) -> Result<(), String> {
    settings.estimator.choice = EstimatorChoice::from_key(value).ok_or_else(|| {
        let keys = EstimatorChoice::ALL.map(EstimatorChoice::key);
        format!("there are {}", keys.join(", "))
    })?;
    Ok(())
}

fn set_features(settings: &mut NavigatorSettings, value: &str) -> Result<(), String> {
    settings.detector.features = TemplateFeatures::named(value).ok_or_else(|| {
        let keys = TemplateFeatures::ALL.map(TemplateFeatures::key);
        format!("there are {}", keys.join(", "))
    })?;
    Ok(())
}

fn set_whole_frames(settings: &mut NavigatorSettings, is_on: bool) {
    settings.whole_frames = is_on.then(|| settings.whole_frames.unwrap_or_default());
}

/// Assumptions about whole frames, which are laid from now on.
fn frames(settings: &mut NavigatorSettings) -> &mut FollowSettings {
    settings.whole_frames.get_or_insert_default()
}
