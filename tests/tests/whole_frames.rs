//! Recorded flights navigated by laying whole frames on the map, without any landmark; Caliterra without anything else is
//! in `oracle_frames.rs`.
//!
//! Truth are the places of the pictures in the orthophoto by SIFT, of others.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::sync::Arc;

use nalgebra::Point3;
use pilotage_core::calibration::{CameraPrior, CameraToLog, camera_to_log};
use pilotage_core::flight::{ChannelName, Flight, FlightFolder};
use pilotage_core::frames::{GroundPoint, Pose};
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::navigator::{FrameReport, Run};
use pilotage_core::registration::FollowSettings;
use pilotage_core::simulate::{FlightDay, Overrides, Scenario, SensorSpec};
use pilotage_tests::studies::either;
use pilotage_tests::whole_frames::{Errors, MANOEUVRES, flight, laid, map, navigate, settings};

struct Brighton {
    folder: FlightFolder,
    map: Arc<dyn Imagery>,
    truth: Vec<GroundPoint>,
    turned: Vec<bool>,
}

/// The flight over Brighton Beach, whose pictures that are stored upside down are not said to be.
fn brighton() -> Option<Brighton> {
    let mut folder = flight("brighton", "brighton_beach")?;
    let flight = &mut folder.flight;
    let map = map(
        flight,
        "brighton_beach/ortho.jpg",
        "brighton_beach/ortho_georef.json",
    );
    let turned = flight.frames.iter().map(|f| f.stored_turn != 0.0).collect();
    for frame in &mut flight.frames {
        frame.stored_turn = 0.0;
    }
    let truth = flight.truth.take().unwrap().frames;
    let place = |p: &nalgebra::Point3<f64>| GroundPoint::new(p.x, p.y);
    Some(Brighton {
        map,
        truth: truth.iter().map(|frame| place(&frame.position)).collect(),
        turned,
        folder,
    })
}

impl Brighton {
    fn navigate(&mut self, flight: Flight) -> Run {
        let map = Arc::clone(&self.map);
        navigate(flight, map, &mut self.folder.frames, &settings(40.0))
    }

    /// Distances of what the camera sees in the middle of its picture, from where the estimate has it and as the
    /// log has its attitude, from what SIFT found there.
    fn errors_in_view(&self, flight: &Flight, run: &Run) -> Errors {
        let laid = laid(run);
        let of = laid.iter().filter_map(|(time, frame, at)| {
            let turn = frame.laid.as_ref()?.place.as_ref()?.stored_turn;
            let camera = flight.camera.stored_turned(turn);
            let height = flight.value(ChannelName::HeightAboveGround, *time)?;
            let pose = Pose {
                position_in_world: Point3::new(at.north, at.east, flight.ground_down - height),
                attitude: flight.attitude(*time)?,
            };
            let seen = camera.ground_at(&pose, &camera.principal, flight.ground_down)?;
            Some(seen.distance(&self.truth[frame.index]))
        });
        Errors::of(of)
    }

    /// Distances of the estimates from the truth where a frame corrected them.
    fn errors(&self, run: &Run) -> Errors {
        let laid = laid(run);
        Errors::of(
            laid.iter()
                .map(|(_, f, at)| at.distance(&self.truth[f.index])),
        )
    }
}

/// With the logged attitude and height.
#[test]
fn brighton_beach_is_navigated_and_turned_pictures_are_noticed() {
    let Some(mut site) = brighton() else { return };
    let run = site.navigate(site.folder.flight.clone());
    let laid = laid(&run);
    let place = |frame: &FrameReport| frame.laid.as_ref().unwrap().place.clone().unwrap();
    let centres = laid
        .iter()
        .map(|(_, f, _)| place(f).centre.distance(&site.truth[f.index]));
    println!("{}", Errors::of(centres).told("middle of the picture"));
    let errors = site.errors(&run);
    println!("{}", errors.told("estimate"));
    for (_, frame, _) in &laid {
        let found = place(frame).stored_turn.abs() > 3.0;
        assert_eq!(found, site.turned[frame.index], "frame {}", frame.index);
    }
    assert!(laid.len() >= 17, "{}", laid.len());
    assert!(errors.median() <= 0.5);
    assert!(errors.greatest() <= 1.0);
}

/// Time offset, mount and focal length are made wrong, estimated from the pictures, and corrected by it.
#[test]
fn brighton_beach_is_navigated_with_a_camera_that_the_program_put_beside_the_log() {
    let Some(mut site) = brighton() else { return };
    let mut flight = site.folder.flight.clone();
    flight.camera.focal *= 1.06;
    flight.camera.mount.yaw += 4_f64.to_radians();
    flight.camera.mount.pitch += 2_f64.to_radians();
    for frame in &mut flight.frames {
        frame.time += 0.7;
    }
    let believed = CameraPrior::default();
    let mut run = site.navigate(flight.clone());
    let before = site.errors_in_view(&flight, &run);
    println!("{}", before.told("before"));
    let mut found: Vec<CameraToLog> = Vec::new();
    for _ in 0..2 {
        let step = camera_to_log(&flight, &run, &believed).unwrap();
        println!("{step:#?}");
        flight = step.apply(&flight);
        found.push(step);
        run = site.navigate(flight.clone());
    }
    println!(
        "{}",
        site.errors(&run)
            .told("estimate, against the middle of the picture")
    );
    let errors = site.errors_in_view(&flight, &run);
    println!("{}", errors.told("after"));
    let offset: f64 = found.iter().map(|f| f.offset.value).sum();
    println!(
        "offset {offset:.2} s, focal {:.1}, mount {:?}",
        flight.camera.focal, flight.camera.mount
    );
    assert!(errors.count() >= 17);
    assert!(errors.median() <= 0.5);
    assert!(errors.median() < before.median());
    let [first, last] = [found[0], found[1]];
    assert!((offset + 0.7).abs() < 3.0 * first.offset.deviation);
    let focal = flight.camera.focal / site.folder.flight.camera.focal;
    assert!(focal.ln().abs() < 2.0 * first.log_focal.deviation);
    assert!(last.offset.value.abs() < first.offset.deviation);
    assert!(last.place_deviation[1] < 0.3 * first.place_deviation[0]);
}

/// The camera's satellite receiver lags: its fixes fit best a second from when the pictures were taken.
#[test]
fn the_lag_of_the_receiver_over_caliterra_is_found() {
    let Some(mut folder) = flight("caliterra", "caliterra") else {
        return;
    };
    let mut flight = folder.flight.clone();
    let (flown, within) = either((45, 3.0), (75, 2.0));
    flight.frames.truncate(flown);
    let map = map(
        &flight,
        "caliterra/ortho.png",
        "caliterra/ortho_georef.json",
    );
    let gps = |name| matches!(name, ChannelName::GpsNorth | ChannelName::GpsEast);
    flight.channels.retain(|c| gps(c.name));
    flight.start.standard_deviation = 20.0;
    let mut settings = settings(50.0);
    settings.process.acceleration = MANOEUVRES;
    let run = navigate(flight.clone(), map, &mut folder.frames, &settings);
    let found = camera_to_log(&flight, &run, &CameraPrior::default()).unwrap();
    println!("{found:#?}");
    // The receiver errs by 10 m for many frames on end: the lag is known to some tenths only, and says so.
    let error = found.offset.value - 1.0;
    assert!(error.abs() < within * found.offset.deviation, "{found:?}");
    assert!(found.offset.deviation < 0.8, "{found:?}");
}

/// The generated countryside on another day than the map's, whose truth is exact: without any landmark the
/// filter is right and says how sure it may be.
#[test]
fn a_simulated_airplane_is_navigated_by_whole_frames_with_an_honest_covariance() {
    let scenario = Scenario::named("distinct-400ft-wind").unwrap();
    let overrides = Overrides {
        day: Some(FlightDay::Other),
        ..Overrides::default()
    };
    let mut simulated = scenario.simulate(3, &overrides);
    let mut flight = simulated.flight.clone();
    let begin = flight.frames[0].time;
    flight
        .frames
        .retain(|frame| frame.time < begin + either(15.0, 30.0));
    let mut settings = scenario.navigator(&SensorSpec::default());
    settings.whole_frames = Some(FollowSettings::default());
    let map: Arc<dyn Imagery> = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), 128));
    let frames = flight.frames.len();
    let run = navigate(flight.clone(), map, &mut simulated.frames, &settings);
    let truth = flight.truth.unwrap();
    let (mut errors, mut nees) = (Vec::new(), Vec::new());
    for step in run.steps.iter().filter(|s| s.frame.is_some()) {
        let place = truth.position(step.time).unwrap();
        let off = step.after.position().to_vector() - place.xy().coords;
        errors.push(off.norm());
        let covariance = step.after.position_covariance();
        nees.push(off.dot(&(covariance.try_inverse().unwrap() * off)));
    }
    let laid = laid(&run).len();
    let mean = nees.iter().sum::<f64>() / nees.len() as f64;
    println!("simulated: {laid} of {frames} laid, NEES {mean:.2}");
    let errors = Errors::of(errors.into_iter());
    println!("{}", errors.told("simulated"));
    assert!(4 * laid >= 3 * frames, "{laid} of {frames}");
    assert!(errors.median() < 3.5);
    assert!(mean < 4.0, "mean NEES {mean}");
}
