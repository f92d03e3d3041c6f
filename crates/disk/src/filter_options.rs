//! `--filter key=value,…`: changes to the navigator's settings.

use pilotage_core::navigator::{AidInfo, ChosenAid, NavigatorSettings};

use super::filter_keys::{FilterChange, KEYS, keys_in_words};

/// Explanation of `--filter` for the long help of a command, with all keys.
///
/// ```
/// assert!(pilotage_disk::filter_options::help().contains("tilt-bias (°)"));
/// ```
pub fn help() -> String {
    format!(
        "Changes to the filter: KEY=VALUE, separated by commas. Keys are {}",
        keys_in_words()
    )
}

/// Applies `key=value` changes, separated by commas.
///
/// # Errors
/// A key that there is not, or a value that it cannot have: in words that say which there are.
///
/// ```
/// use pilotage_core::navigator::{NavigatorSettings, VehicleChoice};
/// use pilotage_disk::filter_options::apply;
///
/// let mut settings = NavigatorSettings::default();
/// apply(&mut settings, "alpha=0.5,vehicle=airplane-gust")?;
/// assert_eq!((settings.alpha, settings.vehicle), (0.5, VehicleChoice::AirplaneGust));
/// assert!(apply(&mut settings, "alpha=much").is_err());
/// # Ok::<(), String>(())
/// ```
pub fn apply(settings: &mut NavigatorSettings, changes: &str) -> Result<(), String> {
    for change in changes.split(',').filter(|c| !c.trim().is_empty()) {
        let (key, value) = change
            .split_once('=')
            .ok_or_else(|| format!("--filter: \"{change}\" is not key=value"))?;
        set(settings, key.trim(), value.trim())?;
        let refused = |why| format!("--filter {}: {why}", change.trim());
        settings.check().map_err(refused)?;
    }
    Ok(())
}

fn set(settings: &mut NavigatorSettings, key: &str, value: &str) -> Result<(), String> {
    let number = || {
        value
            .parse::<f64>()
            .map_err(|_| format!("--filter {key}: \"{value}\" is not a number"))
    };
    let limit = || {
        let limit = Some(number()?).filter(|limit| limit.is_finite() && *limit >= 0.0);
        limit.ok_or_else(|| format!("--filter {key}: \"{value}\" is not zero or more"))
    };
    let switch = || {
        value
            .parse::<bool>()
            .map_err(|_| format!("--filter {key}: say true or false"))
    };
    let Some(line) = KEYS.iter().find(|line| line.key == key) else {
        return set_aid(settings, key, switch, number);
    };
    match line.change {
        FilterChange::Number(set) => set(settings, number()?),
        FilterChange::Limit(set) => set(settings, limit()?),
        FilterChange::Height(set) => {
            let above = Some(limit()?).filter(|height| *height > 0.0);
            let below = || format!("--filter {key}: \"{value}\" is not above the ground");
            set(settings, above.ok_or_else(below)?);
        }
        FilterChange::Switch(set) => set(settings, switch()?),
        FilterChange::Word(set) => {
            set(settings, value).map_err(|why| format!("--filter {key}: {why}"))?;
        }
    }
    Ok(())
}

/// Switches an aid on or off, or sets one of its numbers (`NAME.NUMBER`).
fn set_aid(
    settings: &mut NavigatorSettings,
    key: &str,
    switch: impl Fn() -> Result<bool, String>,
    number: impl Fn() -> Result<f64, String>,
) -> Result<(), String> {
    let (name, number_name) = key.split_once('.').unwrap_or((key, ""));
    let unknown = |_| {
        let keys = keys_in_words();
        format!("--filter: there is no setting \"{key}\"; there are {keys}")
    };
    let info = AidInfo::named(name).map_err(unknown)?;
    let known = settings.aids.iter().position(|aid| aid.key == name);
    let mut aid = known.map_or_else(
        || ChosenAid::usual(name),
        |index| settings.aids.remove(index),
    );
    if number_name.is_empty() {
        if !switch()? {
            return Ok(());
        }
    } else {
        aid = aid.with(number_name, number()?);
    }
    info.values(&aid)
        .map_err(|e| format!("--filter {key}: {e}"))?;
    let place = known.unwrap_or(settings.aids.len());
    settings.aids.insert(place, aid);
    Ok(())
}

#[cfg(test)]
mod tests {
    use pilotage_core::landmark::TemplateFeatures;
    use pilotage_core::navigator::VehicleChoice;

    use super::*;

    #[test]
    fn whoever_writes_a_key_wrong_is_told_all_keys_with_their_units_and_all_aids_with_their_numbers()
     {
        let told = apply(&mut NavigatorSettings::default(), "gats=0.9").unwrap_err();
        for line in &KEYS {
            assert!(told.contains(&format!(" {}", line.key)), "{}", line.key);
        }
        for info in AidInfo::ALL {
            assert!(told.contains(info.key), "{}", info.key);
            for number in info.numbers {
                assert!(told.contains(&format!(".{}", number.key)), "{}", number.key);
            }
        }
        assert!(
            told.contains("roll (°)") && told.contains("\"gats\""),
            "{told}"
        );
        let of_aid = apply(&mut NavigatorSettings::default(), "gps-velocity.colour=1").unwrap_err();
        assert!(of_aid.contains("noise"), "{of_aid}");
    }

    #[test]
    fn a_key_stands_once_in_the_table_and_is_no_name_of_an_aid() {
        for line in &KEYS {
            let same = KEYS.iter().filter(|other| other.key == line.key);
            assert_eq!(same.count(), 1, "{}", line.key);
            assert!(AidInfo::named(line.key).is_err(), "{}", line.key);
        }
    }

    #[test]
    fn settings_change_by_name_and_unknown_names_are_refused() {
        let mut settings = NavigatorSettings::default();
        apply(&mut settings, "alpha=0.5, vehicle=random-walk").unwrap();
        assert_eq!(settings.alpha, 0.5);
        assert_eq!(settings.vehicle, VehicleChoice::RandomWalk);
        apply(&mut settings, "features=orientation,map-deviation=3").unwrap();
        assert_eq!(settings.detector.features, TemplateFeatures::Orientation);
        assert_eq!(settings.detector.map_deviation, 3.0);
        assert!(apply(&mut settings, "features=smell").is_err());
        apply(&mut settings, "frame-height=45").unwrap();
        assert_eq!(settings.whole_frames.unwrap().height, 45.0);
        let limits =
            "frame-within=60,frame-heading-within=15,frame-height-within=12,map-accuracy=3";
        apply(&mut settings, limits).unwrap();
        let frames = settings.whole_frames.unwrap();
        assert_eq!(
            (frames.farthest, frames.map_deviation, frames.height),
            (Some(60.0), 3.0, 45.0)
        );
        assert!((frames.heading_limit() - 15_f64.to_radians()).abs() < 1e-12);
        assert!((frames.height_limit() - 0.12).abs() < 1e-12);
        for wrong in [
            "frame-height-within=-150",
            "frame-heading-within=nan",
            "frame-within=inf",
            "map-accuracy=-3",
            "frame-height=0",
        ] {
            let (key, value) = wrong.split_once('=').unwrap();
            let why = apply(&mut settings, wrong).unwrap_err();
            assert!(why.contains(key) && why.contains(value), "{why}");
        }
        assert_eq!(settings.whole_frames, Some(frames));
        for change in [
            "gate=99",
            "gate=0",
            "gate=nan",
            "scale=-1",
            "scale=0",
            "pixel=nan",
            "roll=nan",
            "pitch=-1",
            "yaw=inf",
            "height=-1",
            "start=-3",
            "start-wind=nan",
            "gust-time=0",
            "wind=-1",
            "velocity=-inf",
            "map-deviation=-1",
            "score=nan",
            "shortest-step=-1",
        ] {
            let why = apply(&mut NavigatorSettings::default(), change).unwrap_err();
            let name = change.split('=').next().unwrap();
            assert!(
                why.contains(change) && why.contains(&format!("setting {name} = ")),
                "{why}"
            );
        }
        apply(&mut settings, "tilt-bias=0.9,yaw-bias=0.4,height-bias=2").unwrap();
        let sensors = settings.sensors;
        assert_eq!(
            (sensors.tilt_bias, sensors.yaw_bias, sensors.height_bias),
            (0.9_f64.to_radians(), 0.4_f64.to_radians(), 2.0)
        );
        apply(&mut settings, "whole-frames=false").unwrap();
        assert!(settings.whole_frames.is_none());
        apply(&mut settings, "gps-velocity.noise=0.4,gps-position=true").unwrap();
        let velocity = ChosenAid::usual("gps-velocity").with("noise", 0.4);
        assert_eq!(
            settings.aids,
            [velocity.clone(), ChosenAid::usual("gps-position")]
        );
        apply(&mut settings, "gps-position=false,estimate-height=true").unwrap();
        assert!(settings.estimates_height);
        assert_eq!(settings.aids, [velocity]);
        assert!(
            apply(&mut settings, "gps-velocity.colour=1")
                .unwrap_err()
                .contains("colour")
        );
        assert!(
            apply(&mut settings, "alhpa=1")
                .unwrap_err()
                .contains("alhpa")
        );
        assert!(
            apply(&mut settings, "alpha=one")
                .unwrap_err()
                .contains("one")
        );
    }
}
