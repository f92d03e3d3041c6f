//! Results of single views of a landmark, and tallies of them.

use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use pilotage_vision::landmark::Sighting;

/// Result of one view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewResult {
    /// Index of the day.
    pub day: usize,
    /// Heading of the camera, radians.
    pub heading: f64,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Tilt of the camera of which the filter knew, radians.
    pub tilt: f64,
    /// Tilt of the camera of which it did not know, radians.
    pub attitude_error: f64,
    /// Distance of the landmark from the middle of the picture, pixels.
    pub off_centre: f64,
    /// Answer of the detector.
    pub sighting: Sighting,
    /// Distance of the place it found from where the landmark is, metres on the ground.
    pub error: Option<f64>,
    /// Whether it was accepted, though it is wrong.
    pub wrong: bool,
    /// Probability that the landmark is accepted in a picture, as far as real maps of another date tell; `None` with
    /// a detector for maps of the flight's own.
    #[serde(default)]
    pub lasting: Option<f64>,
}

impl ViewResult {
    /// Whether it was accepted and right.
    pub fn found(&self) -> bool {
        matches!(self.sighting, Sighting::Found(_)) && !self.wrong
    }
}

/// Tally of the looks for a landmark under some circumstances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LookTally {
    /// Looks in which it lay whole in the picture.
    pub looks: usize,
    /// Those in which it was found.
    pub found: usize,
    /// Those in which a wrong place was accepted.
    pub wrong: usize,
    /// Sum of the covariances of the place (north, east) where it was found, square metres.
    pub covariances: Matrix2<f64>,
}

impl LookTally {
    /// Sums views up.
    pub fn of<'a>(views: impl IntoIterator<Item = &'a ViewResult>) -> Self {
        let mut sum = Self::default();
        views.into_iter().for_each(|view| sum.add(view));
        sum
    }

    /// Sums the views of each of `days` days up.
    pub fn by_day(views: &[ViewResult], days: usize) -> Vec<Self> {
        let of_day = |day| Self::of(views.iter().filter(|view| view.day == day));
        (0..days).map(of_day).collect()
    }

    /// Counts one view more.
    pub fn add(&mut self, view: &ViewResult) {
        self.looks += 1;
        self.wrong += usize::from(view.wrong);
        if let Some(found) = view.sighting.best().filter(|_| view.found()) {
            self.found += 1;
            self.covariances += found.covariance.fixed_view::<2, 2>(0, 0);
        }
    }

    /// Mean covariance of the place (north, east) where it was found, square metres; `None` if never.
    pub fn covariance(&self) -> Option<Matrix2<f64>> {
        (self.found > 0).then(|| self.covariances / self.found as f64)
    }

    /// Share of the looks in which it was found; `None` without a look.
    pub fn share(&self) -> Option<f64> {
        (self.looks > 0).then(|| self.found as f64 / self.looks as f64)
    }
}

/// Tallies of views between neighbouring `edges` (ascending) of `quantity`, e.g. the heading.
pub fn tally_by(
    views: &[ViewResult],
    edges: &[f64],
    quantity: impl Fn(&ViewResult) -> f64,
) -> Vec<LookTally> {
    let within = |pair: &[f64]| {
        let between = |view: &&ViewResult| (pair[0]..pair[1]).contains(&quantity(view));
        LookTally::of(views.iter().filter(between))
    };
    edges.windows(2).map(within).collect()
}
