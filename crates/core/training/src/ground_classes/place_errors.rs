//! Errors of the places of generic landmarks: seen from the air on some day, against where the map has them.

use std::fmt;

use nalgebra::Point3;

use super::looks::GeneratedLooks;
use pilotage_base::frames::GroundRect;
use pilotage_reference::seeing::{GROUP_SIZES, PictureView, size_group};
use pilotage_reference::{GenericClass, GenericLandmark};
use pilotage_vision::ground_class::CoverNetwork;

/// Farthest that the same thing lies from itself, metres.
const FARTHEST: f64 = 8.0;
/// Largest ratio of its two sizes.
const LARGEST_RATIO: f64 = 2.0;

/// Landmarks of one class and about one size.
#[derive(Clone, Debug, Default)]
struct PlaceGroup {
    /// Landmarks of the map that were in view whole.
    in_view: usize,
    /// Errors of those that were seen: north and east, metres; logarithm of the size seen over that in the map.
    errors: Vec<[f64; 3]>,
    /// Landmarks seen in that class and size, in the map or not.
    seen: usize,
}

/// Errors of places by class and size.
#[derive(Clone, Debug, Default)]
pub struct PlaceErrors {
    groups: Vec<(GenericClass, [PlaceGroup; GROUP_SIZES.len() + 1])>,
    /// Mean error of each day's landmarks, metres north and east, and their number.
    shifts: Vec<([f64; 2], usize)>,
}

impl PlaceErrors {
    /// Looks down at `pictures` places of the country of `country` on a day drawn by `day`, with a table of the map's
    /// day, and compares.
    pub fn look(&mut self, country: u64, day: u64, pictures: usize, network: &CoverNetwork) {
        let mut looks = GeneratedLooks::of(country, day, network);
        let (mut sum, mut count) = ([0.0; 2], 0);
        for _ in 0..pictures {
            let (pose, picture) = looks.take();
            let model = looks.camera.model();
            let Some(view) = PictureView::of(model, &pose, 0.0, &picture, network) else {
                continue;
            };
            let seen = &view.seen;
            let is_in_view = |landmark: &GenericLandmark| {
                let half = 0.5 * landmark.size + 3.0;
                let rect = GroundRect::centered(landmark.place, 2.0 * half, 2.0 * half);
                rect.corners().iter().all(|corner| {
                    let point = Point3::new(corner.north, corner.east, 0.0);
                    let pixel = model.project(&pose, &point);
                    pixel.is_some_and(|pixel| model.in_picture(&pixel, 2.0))
                })
            };
            let around = view.around(&mut looks.known, 260.0);
            let in_view: Vec<GenericLandmark> = around.into_iter().filter(is_in_view).collect();
            for landmark in seen {
                self.group(landmark).seen += 1;
            }
            for landmark in &in_view {
                let same = |other: &&GenericLandmark| {
                    let ratio = (other.size / landmark.size).ln().abs();
                    other.class == landmark.class
                        && other.place.distance(&landmark.place) < FARTHEST
                        && ratio < LARGEST_RATIO.ln()
                };
                let distance = |other: &&GenericLandmark| other.place.distance(&landmark.place);
                let nearest = seen.iter().filter(same);
                let nearest = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b)));
                let group = self.group(landmark);
                group.in_view += 1;
                if let Some(other) = nearest {
                    let north = other.place.north - landmark.place.north;
                    let east = other.place.east - landmark.place.east;
                    let log_size = (other.size / landmark.size).ln();
                    group.errors.push([north, east, log_size]);
                    sum = [sum[0] + north, sum[1] + east];
                    count += 1;
                }
            }
        }
        let share = 1.0 / f64::from(count.max(1));
        self.shifts
            .push((sum.map(|sum| sum * share), count as usize));
    }

    fn group(&mut self, landmark: &GenericLandmark) -> &mut PlaceGroup {
        let known = self.groups.iter().position(|(c, _)| *c == landmark.class);
        let index = known.unwrap_or_else(|| {
            self.groups.push((landmark.class, Default::default()));
            self.groups.len() - 1
        });
        &mut self.groups[index].1[size_group(landmark.size)]
    }
}

impl fmt::Display for PlaceErrors {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            to,
            "class      size  in view  found   seen  RMS per axis  median per axis  log size"
        )?;
        for (class, groups) in &self.groups {
            for (number, group) in groups.iter().enumerate() {
                let from = if number == 0 {
                    0.0
                } else {
                    GROUP_SIZES[number - 1]
                };
                let count = group.errors.len().max(1) as f64;
                let squares = |axis: usize| group.errors.iter().map(move |e| e[axis] * e[axis]);
                let rms =
                    ((squares(0).sum::<f64>() + squares(1).sum::<f64>()) / (2.0 * count)).sqrt();
                let log_size = (squares(2).sum::<f64>() / count).sqrt();
                let mut distances: Vec<f64> =
                    group.errors.iter().map(|e| e[0].hypot(e[1])).collect();
                distances.sort_by(f64::total_cmp);
                // The median of a Rayleigh distribution is 1.177 times the deviation per axis.
                let median = distances
                    .get(distances.len() / 2)
                    .map_or(0.0, |d| d / 1.177);
                let found = group.errors.len() as f64 / group.in_view.max(1) as f64;
                let name = format!("{class:?}");
                writeln!(
                    to,
                    "{name:<9} {from:5.1} {:8} {found:6.3} {:6} {rms:13.2} {median:16.2} {log_size:9.3}",
                    group.in_view, group.seen
                )?;
            }
        }
        let days = self.shifts.len().max(1) as f64;
        let squares = self.shifts.iter().map(|(s, _)| s[0] * s[0] + s[1] * s[1]);
        let rms = (squares.sum::<f64>() / (2.0 * days)).sqrt();
        let counts = self.shifts.iter().map(|(_, count)| count);
        let each = counts.sum::<usize>() as f64 / days;
        writeln!(
            to,
            "mean shift of a day: RMS {rms:.2} m per axis over {days} days of {each:.0} landmarks each"
        )
    }
}
