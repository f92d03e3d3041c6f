//! Recorded flights navigated by laying whole frames on the map, without any landmark.

use std::sync::Arc;

use pilotage_core::flight::{ChannelName, Flight, FlightFolder, FrameSource};
use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::{
    CachedImagery, Georeference, GeoreferencedPicture, Imagery, decode_map,
};
use pilotage_core::navigator::{
    FrameReport, KnownGround, Navigator, NavigatorSettings, Run, VehicleChoice,
};
use pilotage_core::registration::FollowSettings;

use crate::{data::shared, recorded};

/// White noise of the acceleration of a multirotor that surveys, (m/s²)/√Hz: with it the mean of the normalized
/// innovations squared over Caliterra is nearly what it should be.
pub const MANOEUVRES: f64 = 3.0;

/// The recorded flight `site`, or `None` where its data are absent.
///
/// # Panics
/// If it cannot be read.
pub fn flight(site: &str, data: &str) -> Option<FlightFolder> {
    Some(recorded::flight(site, data)?.expect("the flight reads"))
}

/// The picture of the shared data as a map of the flight's world.
///
/// # Panics
/// If it cannot be read.
pub fn map(flight: &Flight, picture: &str, georeference: &str) -> Arc<dyn Imagery> {
    let read = |name: &str| {
        let place = shared(name).expect("the map lies beside the flight");
        std::fs::read(place).expect("the map reads")
    };
    let decoded = decode_map(&read(picture), true).expect("the map is a picture");
    let text = String::from_utf8(read(georeference)).expect("the georeference is text");
    let world = flight.frame_on_globe.expect("the flight is on the globe");
    let place = Georeference::from_json(&text)
        .and_then(|g| g.in_world(&world, decoded.width(), decoded.height()))
        .expect("the map has a place");
    let map = GeoreferencedPicture::new("ortho", decoded, place).expect("the map has pixels");
    Arc::new(CachedImagery::new(Arc::new(map), 128))
}

/// Nothing is known of the vehicle: nearly constant velocity; `height` is about that above the ground, metres.
pub fn settings(height: f64) -> NavigatorSettings {
    NavigatorSettings {
        vehicle: VehicleChoice::ConstantVelocity,
        whole_frames: Some(FollowSettings {
            height,
            ..FollowSettings::default()
        }),
        ..NavigatorSettings::default()
    }
}

/// The flight from its beginning to its end.
///
/// # Panics
/// If the navigator cannot begin or go on.
pub fn navigate(
    flight: Flight,
    map: Arc<dyn Imagery>,
    frames: &mut dyn FrameSource,
    settings: &NavigatorSettings,
) -> Run {
    let navigator = Navigator::new(Arc::new(flight), &KnownGround::new(map), settings);
    let navigator = navigator.expect("the navigator begins");
    let begun = std::time::Instant::now();
    let stopwatch = || begun.elapsed().as_secs_f64() * 1e3;
    let run = navigator.fly(frames, &stopwatch);
    run.expect("the navigator goes on")
}

/// Frames that corrected the estimate: their times, what was seen, and the estimate after it.
pub fn laid(run: &Run) -> Vec<(f64, &FrameReport, GroundPoint)> {
    let of_frames = run.steps.iter().filter_map(|step| {
        let frame = step.frame.as_ref()?;
        frame.joint.as_ref()?;
        Some((step.time, frame, step.after.position()))
    });
    of_frames.collect()
}

/// The flight over Caliterra of which neither attitude nor height is known, and of its position nothing but the
/// first fix, which is 36 m off.
pub struct Unaided {
    /// Its frames' times, the first fix, and the truth, which is not navigated by.
    pub flight: Flight,
    map: Arc<dyn Imagery>,
    folder: FlightFolder,
}

/// That flight, or `None` where its data are absent.
///
/// # Panics
/// If it cannot be read.
pub fn caliterra_unaided() -> Option<Unaided> {
    let folder = flight("caliterra", "caliterra")?;
    let mut flight = folder.flight.clone();
    let map = map(
        &flight,
        "caliterra/ortho.png",
        "caliterra/ortho_georef.json",
    );
    let first = |name| flight.channel(name).expect("there are fixes").values[0];
    flight.start.position =
        GroundPoint::new(first(ChannelName::GpsNorth), first(ChannelName::GpsEast));
    flight.start.standard_deviation = 20.0;
    flight.channels.clear();
    Some(Unaided {
        flight,
        map,
        folder,
    })
}

impl Unaided {
    /// Navigates it.
    ///
    /// # Panics
    /// If the navigator cannot begin or go on.
    pub fn run(&mut self) -> Run {
        let mut flight = self.flight.clone();
        flight.truth = None;
        let mut settings = settings(50.0);
        settings.process.acceleration = MANOEUVRES;
        let map = Arc::clone(&self.map);
        navigate(flight, map, &mut self.folder.frames, &settings)
    }
}

/// Distances from where something is, metres, from the smallest to the largest.
#[derive(Debug)]
pub struct Errors(Vec<f64>);

impl Errors {
    /// These, in order.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.collect();
        values.sort_by(f64::total_cmp);
        Self(values)
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Half of them are larger. There has to be one.
    pub fn median(&self) -> f64 {
        let middle = self.0.len() / 2;
        0.5 * (self.0[(self.0.len() - 1) / 2] + self.0[middle])
    }

    /// The largest, or zero of none.
    pub fn greatest(&self) -> f64 {
        self.0.last().copied().unwrap_or(0.0)
    }

    /// In words, as errors of `what`.
    pub fn told(&self, what: &str) -> String {
        format!(
            "{what}: {} frames, median {:.2} m, largest {:.2} m",
            self.count(),
            self.median(),
            self.greatest()
        )
    }
}
