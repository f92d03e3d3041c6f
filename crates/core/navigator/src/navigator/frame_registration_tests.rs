//! Tests of `frame_registration`.

use nalgebra::{DMatrix, Matrix6, Point3, SMatrix};

use super::super::engine::engine;
use super::super::found_places::SearchedRegion;
use super::*;
use pilotage_base::frames::{Attitude, Pose};
use pilotage_flight::{Channel, Frame, StartFix};
use pilotage_mission::settings::{ChosenAid, VehicleChoice};
use pilotage_raster::imagery::Blank;
use pilotage_raster::raster::Gray;
use pilotage_vision::registration::{HeadingPrior, MapPose, MapShape, PoseFit, UNKNOWNS};

/// A place of a frame whose fit has the variance 0.25 m² per axis, over a map as good as `frames` say.
fn place(frames: &FollowSettings, north: f64, east: f64) -> Registration {
    let pose = Pose {
        position_in_world: Point3::new(north, east, -100.0),
        attitude: Attitude::level(0.0),
    };
    let of_map = frames.map_deviation.powi(2);
    let mut covariance = Matrix6::identity() * 0.25;
    covariance[(0, 0)] += of_map;
    covariance[(1, 1)] += of_map;
    Registration {
        fit: PoseFit {
            at: MapPose {
                pose,
                shape: MapShape::default(),
            },
            covariance: SMatrix::<f64, UNKNOWNS, UNKNOWNS>::identity() * 0.25,
            deviation: 1.0,
        },
        matches: Vec::new(),
        tried: 10,
        laid_by: RegistrationMethod::Patches,
        log_false_alarms: -8.0,
        probability: 0.99,
        camera: CameraPlace {
            pose,
            covariance,
            by_tilt: Matrix2::zeros(),
        },
        centre: GroundPoint::new(north, east),
        centre_covariance: Matrix2::identity() * (0.25 + of_map),
        stored_turn: 0.0,
        score: 0.5,
    }
}

/// Places found of a frame that lies at `place` by a filter with these settings.
fn found(settings: &NavigatorSettings, place: &Registration) -> FoundPlaces {
    let frames = settings.whole_frames.expect("frames are laid");
    let position = GroundPoint::default();
    FoundPlaces {
        time: 0.0,
        ground_down: 0.0,
        searched: SearchedRegion {
            position,
            deviation: 3.0,
        },
        prior: Follower::new(frames).prior(0.0, position, 3.0, &InstrumentReadings::default()),
        tilt_biases: [0.0; 2],
        tilt: LastingTilt::of(settings),
        on_map: PlaceOnMap::of(settings, frames.map_deviation),
        places: vec![place.clone()],
    }
}

#[test]
fn of_a_place_is_taken_no_more_of_the_maps_error_than_was_told_with_it() {
    // Standard deviation of the map of frames, whether roads (2 m by themselves) are an aid as well, whether the height
    // is a state, which leaves none for the map in the largest model: variance of the noise per axis.
    for (of_frames, by_roads, at_height, variance) in [
        (0.0, false, false, 0.25),
        (0.0, true, false, 0.25),
        (1.0, true, false, 0.25),
        (3.0, true, false, 0.25),
        (3.0, false, false, 0.25),
        (3.0, false, true, 9.25),
        (0.0, true, true, 0.25),
    ] {
        let settings = NavigatorSettings {
            whole_frames: Some(FollowSettings {
                map_deviation: of_frames,
                ..FollowSettings::default()
            }),
            aids: by_roads
                .then(|| ChosenAid::usual("roads"))
                .into_iter()
                .collect(),
            estimates_height: at_height,
            vehicle: if at_height {
                VehicleChoice::AirplaneFull
            } else {
                VehicleChoice::default()
            },
            ..NavigatorSettings::default()
        };
        let filter = engine(&settings, GroundPoint::default(), 3.0).unwrap();
        let place = place(&settings.whole_frames.unwrap(), 1.0, -1.0);
        let seen = SeenPlace::by(
            &settings,
            filter.as_ref(),
            &found(&settings, &place),
            &place,
        );
        let noise = seen.unwrap().observation.noise;
        let wanted = DMatrix::identity(2, 2) * (variance * settings.measurement_scale);
        assert!(
            (&noise - wanted).amax() < 1e-12,
            "{of_frames} {by_roads} {at_height}: {noise}"
        );
    }
}

/// A flight of one picture, 100 m above ground.
fn flight() -> Flight {
    let channel = |name, value| Channel {
        name,
        times: vec![0.0, 1.0],
        values: vec![value; 2],
    };
    Flight {
        name: "one picture".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(64, 48, 1.0),
        ground_down: 0.0,
        channels: vec![
            channel(ChannelName::Heading, 1.0),
            channel(ChannelName::HeightAboveGround, 100.0),
        ],
        frames: vec![Frame {
            time: 0.5,
            name: String::new(),
            stored_turn: 0.0,
        }],
        start: StartFix {
            time: 0.0,
            position: GroundPoint::default(),
            standard_deviation: 3.0,
        },
        truth: None,
    }
}

/// Search for a grey picture over a blank map, by a filter with these settings that believes this.
fn looked_for(settings: &NavigatorSettings, believed: &Estimate) -> FoundPlaces {
    let frames = settings.whole_frames.expect("frames are laid");
    let registration = FrameRegistration::new(Arc::new(Blank), frames, settings);
    let measured = InstrumentReadings {
        heading: Some(1.0),
        height: Some(100.0),
        ..InstrumentReadings::default()
    };
    let grey = Pyramid::new(Gray::filled(64, 48, 0.5), 1);
    registration
        .lay(&flight(), &measured, 0, &grey, believed)
        .found
}

#[test]
fn places_are_weighed_against_what_was_searched_and_no_farther() {
    let mut frames = FollowSettings::default();
    let mut deviation = |farthest| {
        frames.farthest = farthest;
        let settings = NavigatorSettings {
            whole_frames: Some(frames),
            ..NavigatorSettings::default()
        };
        let filter = engine(&settings, GroundPoint::default(), 200.0).unwrap();
        looked_for(&settings, &filter.state()).searched.deviation
    };
    assert!((deviation(None) - 200.0).abs() < 1e-9);
    // 80 m are 2.5 standard deviations.
    assert!((deviation(Some(80.0)) - 32.0).abs() < 1e-9);
}

/// Belief of a filter over a map that is off by 6 m to the north, as it knows: its position is known to 0.7 m, and the sum
/// of the two to half a metre.
fn knows_the_map(settings: &NavigatorSettings) -> Estimate {
    let mut believed = engine(settings, GroundPoint::new(100.0, 50.0), 0.7)
        .expect("a filter begins")
        .state();
    let north = place_in_state(settings, StateComponent::MapErrorNorth).expect("it is a state");
    believed.mean[north] = 6.0;
    for axis in 0..2 {
        // 0.49 + 0.49 - 2 · 0.365 = 0.25.
        believed.covariance[(north + axis, north + axis)] = 0.49;
        believed.covariance[(axis, north + axis)] = -0.365;
        believed.covariance[(north + axis, axis)] = -0.365;
    }
    believed
}

#[test]
fn a_frame_is_looked_for_and_expected_where_the_map_shows_the_aircraft() {
    let frames = FollowSettings {
        map_deviation: 3.0,
        ..FollowSettings::default()
    };
    let settings = NavigatorSettings {
        whole_frames: Some(frames),
        ..NavigatorSettings::default()
    };
    let believed = knows_the_map(&settings);
    let looked = looked_for(&settings, &believed);
    let at = GroundPoint::new(106.0, 50.0);
    assert!(looked.searched.position.distance(&at) < 1e-9);
    assert!((looked.searched.deviation - 0.5).abs() < 1e-9);
    // Both the filter and the search expect the fit's 0.25 m² about it and 0.25 m² of their own.
    let place = place(&frames, 106.0, 50.5);
    let density = (-0.5 * 0.25 / 0.5_f64).exp() / (std::f64::consts::TAU * 0.5);
    assert!((looked.density_believed(&believed, &place) / density - 1.0).abs() < 1e-9);
    assert!((looked.density_searched(&place) / density - 1.0).abs() < 1e-9);
}

#[test]
fn an_error_of_the_map_that_is_no_state_widens_the_search() {
    let settings = NavigatorSettings {
        whole_frames: Some(FollowSettings {
            map_deviation: 3.0,
            ..FollowSettings::default()
        }),
        estimates_height: true,
        vehicle: VehicleChoice::AirplaneFull,
        ..NavigatorSettings::default()
    };
    let filter = engine(&settings, GroundPoint::default(), 4.0).unwrap();
    let looked = looked_for(&settings, &filter.state());
    assert!((looked.searched.deviation - 5.0).abs() < 1e-9);
    let place = place(&settings.whole_frames.unwrap(), 0.0, 0.0);
    let density = 1.0 / (std::f64::consts::TAU * 25.25);
    assert!((looked.density_believed(&filter.state(), &place) / density - 1.0).abs() < 1e-9);
    assert!((looked.density_searched(&place) / density - 1.0).abs() < 1e-9);
}

#[test]
fn a_frame_is_turned_as_the_heading_is_without_the_bias_that_the_filter_knows() {
    let settings = NavigatorSettings {
        vehicle: VehicleChoice::AirplaneFull,
        whole_frames: Some(FollowSettings::default()),
        ..NavigatorSettings::default()
    };
    let mut believed = engine(&settings, GroundPoint::default(), 3.0)
        .unwrap()
        .state();
    let bias = place_in_state(&settings, StateComponent::HeadingBias).expect("it is a state");
    believed.mean[bias] = 0.14;
    let looked = looked_for(&settings, &believed);
    let HeadingPrior::Around { heading, .. } = looked.prior.heading else {
        panic!("{:?}", looked.prior);
    };
    // The compass reads 1 rad.
    assert!((heading - 0.86).abs() < 1e-12, "{heading}");
}
