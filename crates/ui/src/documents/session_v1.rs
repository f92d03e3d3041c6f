//! The document as version 1 stored it: postcard, which knows no names, so that every member had to
//! be there in its order. Kept as it was, before missions had routes, whatever became of them since.

use std::collections::BTreeMap;

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::Geodetic;
use pilotage_core::landmark::{Landmark, TemplateSettings};
use pilotage_core::mission::{MapReference, Mission};
use pilotage_core::navigator::{
    NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice,
};
use serde::Deserialize;

use super::Session;
use super::empty_mission::empty_mission;
use pilotage_jobs::{FlightSource, MapSource};

#[derive(Deserialize)]
struct SessionV1 {
    flight: FlightSource,
    map: MapSource,
    mission: Option<MissionV1>,
    bookmarks: Vec<f64>,
}

#[derive(Deserialize)]
struct MissionV1 {
    name: String,
    origin: Geodetic,
    map: Option<MapReference>,
    landmarks: Vec<Landmark>,
    camera: Option<CameraModel>,
    navigator: NavigatorV1,
    properties: BTreeMap<String, String>,
}

#[derive(Deserialize)]
struct NavigatorV1 {
    vehicle: VehicleChoice,
    alpha: f64,
    beta: f64,
    redraw: bool,
    gate_confidence: f64,
    start: StartError,
    process: ProcessV1,
    sensors: SensorNoise,
    measurement_scale: f64,
    detector: TemplateV1,
    most_landmarks: usize,
}

#[derive(Deserialize)]
struct TemplateV1 {
    least_score: f64,
    greatest_ambiguity: f64,
    search_sigmas: f64,
    rotation_range: f64,
    scale_range: f64,
}

#[derive(Deserialize)]
struct ProcessV1 {
    airspeed: f64,
    heading: f64,
    position: f64,
    wind: f64,
    gust: f64,
    gust_time: f64,
    airspeed_bias: f64,
    heading_bias: f64,
    acceleration: f64,
    thesis_per_step: bool,
}

/// Reads what follows the number of the version.
pub fn read(body: &[u8]) -> Option<Session> {
    let (old, rest): (SessionV1, _) = postcard::take_from_bytes(body).ok()?;
    // What was stored while the mission had more members is not mistaken for one without.
    rest.is_empty().then(|| Session {
        log: None,
        flight: old.flight,
        map: old.map,
        mission: old.mission.map(mission),
        bookmarks: old.bookmarks,
    })
}

fn mission(old: MissionV1) -> Mission {
    let it = old.navigator;
    let p = it.process;
    Mission {
        name: old.name,
        origin: old.origin,
        map: old.map,
        landmarks: old.landmarks,
        camera: old.camera,
        camera_to_log: None,
        navigator: NavigatorSettings {
            vehicle: it.vehicle,
            alpha: it.alpha,
            beta: it.beta,
            redraw: it.redraw,
            gate_confidence: it.gate_confidence,
            start: it.start,
            process: ProcessNoise {
                airspeed: p.airspeed,
                heading: p.heading,
                position: p.position,
                wind: p.wind,
                gust: p.gust,
                gust_per_wind: 0.0,
                gust_time: p.gust_time,
                airspeed_bias: p.airspeed_bias,
                heading_bias: p.heading_bias,
                acceleration: p.acceleration,
                thesis_per_step: p.thesis_per_step,
                ..NavigatorSettings::default().process
            },
            sensors: it.sensors,
            measurement_scale: it.measurement_scale,
            detector: TemplateSettings {
                least_score: it.detector.least_score,
                greatest_ambiguity: it.detector.greatest_ambiguity,
                search_sigmas: it.detector.search_sigmas,
                rotation_range: it.detector.rotation_range,
                scale_range: it.detector.scale_range,
                ..TemplateSettings::default()
            },
            most_landmarks: it.most_landmarks,
            ..NavigatorSettings::default()
        },
        properties: old.properties,
        ..empty_mission()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stored by the program of that time: a mission with one landmark over opened files.
    const STORED: &[u8] = include_bytes!("session_v1.bin");

    #[test]
    fn what_the_first_version_stored_is_read_whole() {
        let session = Session::decode(STORED).unwrap();
        assert_eq!(session.flight, FlightSource::Files("opened-3".into()));
        assert_eq!(session.map, MapSource::Files("opened-3".into()));
        assert_eq!(session.bookmarks, [1.5, 20.25]);
        let mission = session.mission.unwrap();
        let barn = &mission.landmarks[0];
        assert_eq!(
            (barn.name.as_str(), barn.id, barn.enabled),
            ("Barn", 4, false)
        );
        assert_eq!(barn.properties["owner"], "\"Ann\"");
        assert_eq!(mission.properties["weather"], "\"fine\"");
        assert_eq!(mission.camera, Some(CameraModel::pinhole(640, 480, 0.8)));
        let settings = &mission.navigator;
        assert_eq!(
            (settings.process.gust_time, settings.most_landmarks),
            (7.5, 5)
        );
        assert!(mission.routes.is_empty());
        assert_eq!(Session::decode(&STORED[..STORED.len() - 1]), None);
        assert_eq!(Session::decode(&[STORED, &[0]].concat()), None);
    }
}
