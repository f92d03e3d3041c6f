//! Flights over maps of other dates, navigated by whole frames alone: where each frame is laid follows from those
//! before it.
//!
//! `cargo test -p pilotage-navigator --test sequences -- --nocapture` prints every frame.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

#[path = "../../../vision/tests/across_dates/photos.rs"]
mod photos;

use std::sync::Arc;

use photos::studies::either;
use photos::{Photo, Site};
use pilotage_base::frames::GroundPoint;
use pilotage_flight::{Channel, ChannelName, Flight, Frame, FrameError, FrameSource, StartFix};
use pilotage_mission::settings::{NavigatorSettings, VehicleChoice};
use pilotage_navigator::navigator::{KnownGround, Navigator};
use pilotage_raster::camera::UNSTATED_MOUNT_DEVIATION;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{Picture, decode_picture};
use pilotage_vision::registration::FollowSettings;

/// The pictures of photos.
struct Pictures(Vec<std::path::PathBuf>);

impl FrameSource for Pictures {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        Ok(decode_picture(&self.encoded(index)?).unwrap())
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let path = self.0.get(index).ok_or(FrameError::OutOfRange(index))?;
        Ok(std::fs::read(path).unwrap())
    }
}

/// Knowledge of the flight of photos beside its pictures.
struct Known {
    /// Place of the start, and its standard deviation, metres.
    start: (GroundPoint, f64),
    heading: bool,
}

fn flight(photos: &[Photo], known: &Known) -> Flight {
    let channel = |name, value: &dyn Fn(&Photo) -> f64| Channel {
        name,
        times: photos.iter().map(|p| p.time).collect(),
        values: photos.iter().map(value).collect(),
    };
    let mut channels = vec![
        channel(ChannelName::HeightAboveGround, &|p| p.height),
        channel(ChannelName::Pitch, &|p| p.pitch),
    ];
    if known.heading {
        channels.push(channel(ChannelName::Heading, &|p| p.heading));
    }
    let frame = |p: &Photo| Frame {
        time: p.time,
        name: p.name.clone(),
        stored_turn: 0.0,
    };
    Flight {
        name: "photos".into(),
        frame_on_globe: None,
        camera: photos[0].camera.clone(),
        ground_down: 0.0,
        channels,
        frames: photos.iter().map(frame).collect(),
        start: StartFix {
            time: photos[0].time,
            position: known.start.0,
            standard_deviation: known.start.1,
        },
        truth: None,
    }
}

/// Outcome of a frame.
struct Moment {
    name: String,
    /// Error of the estimate by what the photo's file says, metres.
    off: f64,
    /// Twice the variance per axis that was stated, m².
    stated: f64,
    /// Whether the frame corrected the estimate.
    laid: bool,
}

/// Flies over the photos of a site; what came of each.
fn fly(site: &Site, known: &Known) -> Vec<Moment> {
    fly_by(site, flight(&site.photos, known), &settings())
}

/// The same of a flight of those photos with other settings.
fn fly_by(site: &Site, flight: Flight, settings: &NavigatorSettings) -> Vec<Moment> {
    let photos = &site.photos;
    let map = Arc::new(site.map.clone());
    let mut pictures = Pictures(photos.iter().map(|p| p.file.clone()).collect());
    let ground = KnownGround::new(map);
    let mut navigator = Navigator::new(Arc::new(flight), &ground, settings).unwrap();
    let mut moments = Vec::new();
    let begun = std::time::Instant::now();
    let clock = || begun.elapsed().as_secs_f64() * 1e3;
    while let Some(step) = navigator.advance(&mut pictures, &clock) {
        let step = step.unwrap();
        let Some(frame) = &step.frame else { continue };
        let photo = &photos[frame.index];
        let laid = frame.laid.as_ref().unwrap();
        let position = step.after.position();
        let moment = Moment {
            name: photo.name.clone(),
            off: position.distance(&photo.below),
            stated: step.after.position_covariance().trace(),
            laid: frame.joint.is_some(),
        };
        println!(
            "{} {}: {:.1} m off, stated {:.1} m; {}; {:.0} ms",
            Imagery::name(&site.map),
            moment.name,
            moment.off,
            moment.stated.sqrt(),
            laid.refusal.as_deref().unwrap_or("laid"),
            step.timing.see
        );
        moments.push(moment);
    }
    moments
}

/// Number of frames that were laid, number of these that lie farther than `metres` from where the file says,
/// median error, and largest number of frames not laid one after the other.
fn tally(moments: &[Moment], metres: f64) -> (usize, usize, f64, usize) {
    let laid = moments.iter().filter(|m| m.laid);
    let wrong = laid.clone().filter(|m| m.off > metres).count();
    let mut errors: Vec<f64> = moments.iter().map(|m| m.off).collect();
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];
    let open = moments.split(|m| m.laid).map(<[_]>::len).max().unwrap();
    let squared = moments.iter().map(|m| m.off.powi(2) / m.stated);
    println!(
        "{} of {} laid, {wrong} of them wrong by {metres} m, median {median:.1} m, at most {open} open in a row, {:.2} \
         squared deviations",
        laid.clone().count(),
        moments.len(),
        squared.sum::<f64>() / moments.len() as f64
    );
    (laid.count(), wrong, median, open)
}

/// Nothing is known of the vehicle; the map is good to some 3 m.
fn settings() -> NavigatorSettings {
    NavigatorSettings {
        vehicle: VehicleChoice::ConstantVelocity,
        whole_frames: Some(FollowSettings {
            map_deviation: 3.0,
            measured_log_height_deviation: 0.06,
            heading_deviation: 6_f64.to_radians(),
            may_be_turned: false,
            tilt_deviation: 3_f64.to_radians(),
            shape_deviation: 0.02,
            ..FollowSettings::default()
        }),
        ..NavigatorSettings::default()
    }
}

#[test]
fn a_drone_finds_itself_anywhere_on_the_map_of_a_town_without_a_heading() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let known = Known {
        start: (site.map_middle(), 250.0),
        heading: false,
    };
    let moments = fly(&site, &known);
    let first = moments.iter().position(|m| m.laid).unwrap();
    let (laid, wrong, median, _) = tally(&moments, 15.0);
    assert!(first < 4, "{first}");
    assert!(
        laid >= 27 && wrong == 0 && median <= 6.0,
        "{laid}, {wrong}, {median}"
    );
}

#[test]
fn a_camera_whose_mount_nobody_states_is_told_by_the_start_and_believed_no_better() {
    let Some(mut site) = photos::fengyuan() else {
        return;
    };
    site.photos = site.photos.into_iter().step_by(either(3, 1)).collect();
    let known = Known {
        start: (site.photos[0].below, 5.0),
        heading: true,
    };
    // It looks 9.5° ahead of straight down: some 20 m.
    let flown = |deviation: f64| {
        let mut flight = flight(&site.photos, &known);
        flight.channels.retain(|c| c.name != ChannelName::Pitch);
        flight.camera.mount_deviation = deviation;
        let settings = NavigatorSettings::without_mission(&flight, true);
        let moments = fly_by(&site, flight, &settings);
        let mean = |of: &dyn Fn(&Moment) -> f64| {
            moments.iter().map(of).sum::<f64>() / moments.len() as f64
        };
        let square = mean(&|m| m.off.powi(2));
        (square.sqrt(), mean(&|m| 2.0 * m.off.powi(2) / m.stated))
    };
    let (taken, squared) = flown(0.0);
    assert!(taken > 15.0 && squared > 8.0, "{taken} {squared}");
    let (told, squared) = flown(UNSTATED_MOUNT_DEVIATION);
    assert!(told < 8.0 && squared < 4.0, "{told} {squared}");
}

#[test]
fn a_flight_over_fields_keeps_its_place_on_a_map_of_another_date_or_finds_it_again() {
    // Its frames have no times, so that no model of its motion is right: it is lost and found again several times.
    // What the file says of its place is off by 12 m for nine in ten.
    for month in ["map_january", "map_march"].iter().take(either(1, 2)) {
        let Some(site) = photos::adm(month) else {
            return;
        };
        let known = Known {
            start: (site.photos[0].below, 10.0),
            heading: true,
        };
        let (laid, wrong, median, open) = tally(&fly(&site, &known), 25.0);
        assert!(laid >= 53 && wrong == 0, "{laid}, {wrong}");
        assert!(median <= 8.0 && open <= 5, "{median}, {open}");
    }
}
