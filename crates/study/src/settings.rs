//! The settings of a flight by their names in plans.

use pilotage_core::navigator::{EstimatorChoice, VehicleChoice};
use pilotage_core::plan::TestedInstrument;
use pilotage_core::simulate::Scenario;

use super::fault_kind::FaultKind;
use super::run_settings::{LONGEST, RunSettings};
use super::value::SettingValue;

/// Setter of a number that was checked.
type SetNumber = fn(&mut RunSettings, f64);
/// Setter of a name; fails with the names that there are.
type SetText = fn(&mut RunSettings, &str) -> Result<(), String>;

/// Way of setting a value.
enum Setter {
    /// A number within bounds, and the factor that makes SI of its unit.
    Number([f64; 2], f64, SetNumber),
    Text(SetText),
}

/// Description of a setting for people.
pub struct StudySetting {
    /// Name in plans.
    pub key: &'static str,
    /// Unit in plans; empty of a name or a ratio.
    pub unit: &'static str,
    /// Words on what it is.
    pub about: &'static str,
    setter: Setter,
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
const POSITIVE: [f64; 2] = [0.0, f64::INFINITY];

const fn number(
    key: &'static str,
    unit: &'static str,
    about: &'static str,
    bounds: [f64; 2],
    set: SetNumber,
) -> StudySetting {
    // Degrees are told by their sign.
    let factor = if unit.len() == "°".len() && unit.as_bytes()[0] == "°".as_bytes()[0] {
        DEGREE
    } else {
        1.0
    };
    StudySetting {
        key,
        unit,
        about,
        setter: Setter::Number(bounds, factor, set),
    }
}

const fn text(key: &'static str, about: &'static str, set: SetText) -> StudySetting {
    StudySetting {
        key,
        unit: "",
        about,
        setter: Setter::Text(set),
    }
}

fn among<T: Copy>(name: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found = known.iter().find(|(key, _)| *key == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(key, _)| *key).collect();
        format!("there is no \"{name}\"; there are {}", names.join(", "))
    })
}

fn set_vehicle(run: &mut RunSettings, name: &str) -> Result<(), String> {
    let known = VehicleChoice::ALL.map(|choice| (choice.key(), choice));
    run.vehicle = Some(among(name, &known)?);
    Ok(())
}

fn set_scenario(run: &mut RunSettings, name: &str) -> Result<(), String> {
    let all = Scenario::all();
    let known: Vec<(&str, ())> = all
        .iter()
        .filter(|scenario| scenario.by_landmarks)
        .map(|scenario| (scenario.name, ()))
        .collect();
    among(name, &known).map_err(|why| format!("{why}, which fly by landmarks"))?;
    name.clone_into(&mut run.scenario);
    Ok(())
}

fn named(name: &str, what: &str) -> Result<String, String> {
    if name.trim().is_empty() {
        return Err(format!("give the name of a {what}"));
    }
    Ok(name.to_owned())
}

fn set_mission(run: &mut RunSettings, name: &str) -> Result<(), String> {
    run.mission = Some(named(name, "file of a mission")?);
    Ok(())
}

fn set_route(run: &mut RunSettings, name: &str) -> Result<(), String> {
    run.route = Some(named(name, "route")?);
    Ok(())
}

fn set_aids(run: &mut RunSettings, names: &str) -> Result<(), String> {
    let known = RunSettings::READ_AIDS.map(|key| (key, key));
    let names = names.split(',').map(str::trim);
    let names = names.filter(|name| !name.is_empty() && *name != "none");
    let aids = names.map(|name| among(name, &known).map(str::to_owned));
    run.aids = Some(aids.collect::<Result<_, _>>()?);
    Ok(())
}

fn set_told(run: &mut RunSettings, name: &str) -> Result<(), String> {
    run.is_told = Some(among(name, &[("yes", true), ("no", false)])?);
    Ok(())
}

fn set_doubts(run: &mut RunSettings, name: &str) -> Result<(), String> {
    run.doubts = among(name, &[("yes", true), ("no", false)])?;
    Ok(())
}

fn set_estimator(run: &mut RunSettings, name: &str) -> Result<(), String> {
    let known = EstimatorChoice::ALL.map(|choice| (choice.key(), choice));
    run.estimator = Some(among(name, &known)?);
    Ok(())
}

fn set_fault(run: &mut RunSettings, name: &str) -> Result<(), String> {
    run.fault = among(name, &FaultKind::ALL.map(|fault| (fault.key(), fault)))?;
    Ok(())
}

fn walk(run: &mut RunSettings, instrument: TestedInstrument, deviation: f64) {
    run.walks.push((instrument, deviation));
}

/// A list of settings, a line each.
macro_rules! settings {
    ($($kind:ident($($of:tt)*);)*) => {
        &[$($kind($($of)*)),*]
    };
}

impl StudySetting {
    /// A value of the setting `key` with its unit.
    ///
    /// ```
    /// use pilotage_study::StudySetting;
    ///
    /// assert_eq!(StudySetting::with_unit("wind-speed", "4"), "4 m/s");
    /// assert_eq!(StudySetting::with_unit("wind-from", "90"), "90°");
    /// assert_eq!(StudySetting::with_unit("vehicle", "airplane-wind"), "airplane-wind");
    /// ```
    pub fn with_unit(key: &str, value: &str) -> String {
        let setting = Self::ALL.iter().find(|setting| setting.key == key);
        match setting.map_or("", |setting| setting.unit) {
            "" => value.to_owned(),
            "°" => format!("{value}°"),
            unit => format!("{value} {unit}"),
        }
    }

    /// All of them, in the order in which people read them.
    pub const ALL: &[Self] = settings! {
        text("scenario", "scenario whose route and landmarks are flown", set_scenario);
        text("mission", "mission file beside the plan, flown over level ground in place of a scenario", set_mission);
        text("route", "route of the mission, if not the first", set_route);
        number("seconds", "s", "longest time flown; of a mission all of its route, but an hour at most, if not said", [1.0, LONGEST],
            |r, v| r.seconds = Some(v));
        number("height", "m", "height above ground", [10.0, 10_000.0], |r, v| r.height = Some(v));
        number("wind-speed", "m/s", "speed of the wind", [0.0, 14.0], |r, v| r.wind_speed = Some(v));
        number("wind-from", "°", "direction from which it blows", ANY, |r, v| r.wind_from = Some(v));
        number("wind-scatter", "m/s", "deviation of a wind added by chance, per axis", [0.0, 14.0],
            |r, v| r.wind_scatter = v);
        number("noise-airspeed", "m/s", "noise of an airspeed", POSITIVE, |r, v| r.sensors.airspeed.noise = v);
        number("bias-airspeed", "m/s", "deviation of its bias, drawn for each flight", POSITIVE,
            |r, v| r.sensors.airspeed.bias = v);
        number("noise-heading", "°", "noise of a heading", POSITIVE, |r, v| r.sensors.heading.noise = v);
        number("bias-heading", "°", "deviation of its bias", POSITIVE, |r, v| r.sensors.heading.bias = v);
        number("noise-attitude", "°", "noise of a roll and a pitch", POSITIVE, |r, v| r.sensors.attitude.noise = v);
        number("bias-attitude", "°", "deviation of their biases", POSITIVE, |r, v| r.sensors.attitude.bias = v);
        number("noise-height", "m", "noise of a height", POSITIVE, |r, v| r.sensors.height.noise = v);
        number("bias-height", "m", "deviation of its bias", POSITIVE, |r, v| r.sensors.height.bias = v);
        number("mount-shake", "°", "shake of the camera in each frame, per axis", [0.0, 30.0],
            |r, v| r.sensors.mount_vibration = v);
        number("frame-rate", "1/s", "frames each second", [0.1, 20.0], |r, v| r.sensors.frame_rate = v);
        number("start-error", "m", "deviation of the first position, per axis", POSITIVE,
            |r, v| r.sensors.start_position = v);
        number("recognised", "", "share of days on which a landmark can be recognised", [0.0, 1.0],
            |r, v| r.recognised = v);
        number("found", "", "share of frames that find it then", [0.0, 1.0], |r, v| r.per_frame = v);
        number("place-error", "m", "deviation of a found place, per axis", [1e-3, 100.0], |r, v| r.place = v);
        number("turn-error", "", "deviation of a found turn, radians, and logarithm of size", [1e-4, 1.0],
            |r, v| r.turn = v);
        number("walk-airspeed", "m/s", "step each second of an error that walks", POSITIVE,
            |r, v| walk(r, TestedInstrument::Airspeed, v));
        number("walk-roll", "°", "step each second of an error that walks", POSITIVE,
            |r, v| walk(r, TestedInstrument::Roll, v));
        number("walk-pitch", "°", "step each second of an error that walks", POSITIVE,
            |r, v| walk(r, TestedInstrument::Pitch, v));
        number("walk-heading", "°", "step each second of an error that walks", POSITIVE,
            |r, v| walk(r, TestedInstrument::Yaw, v));
        number("offset-airspeed", "m/s", "constant error", ANY, |r, v| r.offsets[0] = v);
        number("offset-heading", "°", "constant error", ANY, |r, v| r.offsets[1] = v);
        number("offset-roll", "°", "constant error", ANY, |r, v| r.offsets[2] = v);
        number("offset-pitch", "°", "constant error", ANY, |r, v| r.offsets[3] = v);
        number("offset-height", "m", "constant error", ANY, |r, v| r.offsets[4] = v);
        number("offset-north", "m", "constant error of the first position", ANY, |r, v| r.start_offset[0] = v);
        number("offset-east", "m", "constant error of the first position", ANY, |r, v| r.start_offset[1] = v);
        text("fault", "what an instrument does wrong", set_fault);
        number("fault-from", "s", "when that begins", POSITIVE, |r, v| r.fault_from = v);
        number("fault-turn", "°", "angle by which a heading is turned", ANY, |r, v| r.fault_turn = v);
        number("fault-delay", "s", "time by which a camera is late", [0.0, 60.0], |r, v| r.fault_delay = v);
        text("aids", "aids beside pictures, separated by commas, or none; those of the mission, without what looks at pictures or heights, if not said", set_aids);
        text("vehicle", "process model", set_vehicle);
        text("estimator", "estimator; that of the mission if not said", set_estimator);
        text("told", "whether the filter is told of the sensors' errors: yes or no; a mission has its own settings if not said", set_told);
        text("doubts", "whether the filter thinks of late pictures and turned compasses: yes or no", set_doubts);
        number("start-wind", "m/s", "deviation of the wind that the filter assumes at first", POSITIVE,
            |r, v| r.start_wind = Some(v));
        number("alpha", "", "spread of the sigma points", [1e-4, 1.0], |r, v| r.alpha = Some(v));
        number("gate", "", "confidence of the gate", [0.5, 0.999_999], |r, v| r.gate = Some(v));
        number("measurement-scale", "", "factor on the covariance of measurements; that of the mission if not said", [1e-3, 1e3],
            |r, v| r.measurement_scale = Some(v));
        number("step", "s", "shortest step of the filter between frames; 0 makes one of each measurement; that of the mission if not said", [0.0, 10.0],
            |r, v| r.step = Some(v));
    };
}

/// Least number of letters to insert, delete or replace that makes `to` of `from`.
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut counts: Vec<usize> = (0..=to.len()).collect();
    for (row, letter) in from.chars().enumerate() {
        let mut diagonal = counts[0];
        counts[0] = row + 1;
        for (column, other) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = counts[column + 1];
            counts[column + 1] = replaced.min(diagonal + 1).min(counts[column] + 1);
        }
    }
    counts[to.len()]
}

impl RunSettings {
    /// Whether there is a setting of that name.
    pub fn has(key: &str) -> bool {
        StudySetting::ALL.iter().any(|setting| setting.key == key)
    }

    /// Sets one by its name in plans.
    ///
    /// # Errors
    /// Why it cannot be set so, in words.
    ///
    /// ```
    /// use pilotage_study::{RunSettings, SettingValue};
    ///
    /// let mut run = RunSettings::default();
    /// run.set("wind-from", &SettingValue::Number(90.0))?;
    /// assert_eq!(run.wind_from, Some(90_f64.to_radians()));
    /// assert!(run.set("wind-form", &SettingValue::Number(90.0)).is_err());
    /// # Ok::<(), String>(())
    /// ```
    pub fn set(&mut self, key: &str, value: &SettingValue) -> Result<(), String> {
        let setting = StudySetting::ALL.iter().find(|setting| setting.key == key);
        let setting = setting.ok_or_else(|| {
            let keys: Vec<&str> = StudySetting::ALL.iter().map(|s| s.key).collect();
            let near = keys.iter().map(|known| (edits(key, known), *known)).min();
            let near = near.filter(|(count, _)| *count <= 2 && *count < key.chars().count());
            match near {
                Some((_, known)) => {
                    format!("there is no such setting; perhaps {known} is meant")
                }
                None => format!("there is no such setting; there are {}", keys.join(", ")),
            }
        })?;
        match (&setting.setter, value) {
            (Setter::Number([low, high], factor, set), SettingValue::Number(number)) => {
                if !(*low..=*high).contains(number) || !number.is_finite() {
                    return Err(format!("{number} is not within {low} to {high}"));
                }
                set(self, number * factor);
                Ok(())
            }
            (Setter::Text(set), SettingValue::Text(name)) => set(self, name),
            (Setter::Number(..), _) => Err("give a number".to_owned()),
            (Setter::Text(_), _) => Err("give a name in quotation marks".to_owned()),
        }
    }

    /// Sets one that was drawn, and gives the value that it has then: a tail beyond the bounds of a setting ends at them.
    pub(crate) fn set_drawn(
        &mut self,
        key: &str,
        drawn: SettingValue,
    ) -> Result<SettingValue, String> {
        let setting = StudySetting::ALL.iter().find(|setting| setting.key == key);
        let value = match (setting.map(|s| &s.setter), drawn) {
            (Some(Setter::Number([low, high], ..)), SettingValue::Number(number)) => {
                SettingValue::Number(number.clamp(*low, *high))
            }
            (_, drawn) => drawn,
        };
        self.set(key, &value)?;
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_has_a_name_of_its_own_and_changes_something() {
        let mut keys: Vec<&str> = StudySetting::ALL.iter().map(|s| s.key).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), StudySetting::ALL.len());
        let names = [
            ("scenario", "distinct-400ft-calm"),
            ("mission", "river.geojson"),
            ("route", "Out"),
            ("fault", "airspeed-stuck"),
            ("aids", "gps-velocity, magnetic-heading"),
            ("vehicle", "airplane-wind"),
            ("estimator", "ekf"),
            ("told", "no"),
            ("doubts", "no"),
        ];
        for setting in StudySetting::ALL {
            let value = match setting.setter {
                Setter::Number([low, high], ..) => {
                    SettingValue::Number((0.77_f64).clamp(low, high).max(low))
                }
                Setter::Text(_) => {
                    let (_, name) = names.iter().find(|(key, _)| *key == setting.key).unwrap();
                    SettingValue::Text((*name).to_owned())
                }
            };
            let mut run = RunSettings::default();
            run.set(setting.key, &value).unwrap();
            assert_ne!(run, RunSettings::default(), "{}", setting.key);
        }
    }

    #[test]
    fn plans_name_every_vehicle_model_that_there_is_and_a_wrong_name_is_told_with_all_of_them() {
        for vehicle in VehicleChoice::ALL {
            let mut run = RunSettings::default();
            let name = SettingValue::Text(vehicle.key().to_owned());
            run.set("vehicle", &name).unwrap();
            assert_eq!(run.vehicle, Some(vehicle));
            let wrong = SettingValue::Text("glider".to_owned());
            let told = run.set("vehicle", &wrong).unwrap_err();
            assert!(told.contains(vehicle.key()), "{told}");
        }
    }

    #[test]
    fn angles_are_degrees_in_plans_and_drawn_tails_end_at_the_bounds() {
        let mut run = RunSettings::default();
        run.set("noise-heading", &SettingValue::Number(2.0))
            .unwrap();
        assert_eq!(run.sensors.heading.noise, 2.0_f64.to_radians());
        let tail = SettingValue::Number(-0.3);
        assert!(run.set("wind-speed", &tail).is_err());
        let flown = run.set_drawn("wind-speed", tail);
        assert_eq!(flown, Ok(SettingValue::Number(0.0)));
        assert_eq!(run.wind_speed, Some(0.0));
    }

    #[test]
    fn a_setting_that_is_nearly_spelt_right_is_named_and_of_another_all_are_told() {
        let one = SettingValue::Number(1.0);
        let told = |key| RunSettings::default().set(key, &one).unwrap_err();
        assert!(told("recognized").ends_with("perhaps recognised is meant"));
        assert!(told("wind-sped").ends_with("perhaps wind-speed is meant"));
        let all = told("temperature");
        let has = |setting: &StudySetting| all.contains(setting.key);
        assert!(StudySetting::ALL.iter().all(has), "{all}");
    }

    #[test]
    fn a_scenario_that_needs_pictures_is_refused() {
        let roads = SettingValue::Text("roads-400ft".to_owned());
        let why = RunSettings::default().set("scenario", &roads).unwrap_err();
        assert!(why.contains("distinct-1000ft-extended"), "{why}");
    }
}
