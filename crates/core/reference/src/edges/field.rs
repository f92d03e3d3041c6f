//! Likelihood of an edge at any place and of any direction, by the edges of a table.

use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Gray, gaussian_blur};
use std::f64::consts::PI;

use super::seen::EDGE;
use crate::{GenericClass, GenericLandmark, ReferenceTable};

/// Directions that are told apart, π / 12 apart.
pub(super) const DIRECTIONS: usize = 12;
/// Ground in a cell, metres.
pub(super) const CELL: f64 = 1.0;
/// Standard deviation of an edge's place across it, metres, and of its direction, radians.
const ACROSS: f64 = 1.5;
const TURNED: f64 = 0.15;
/// Share of the edges of a picture that the table has too.
const SHARED: f64 = 0.5;
/// Distance between places along an edge that are entered, metres.
const ENTERED: f64 = 0.5;
/// Distance of the corners of a square over half its side.
pub(super) const CORNER: f64 = std::f64::consts::SQRT_2;
/// Half the length of the longest edges that reach into a field from beyond, metres.
pub(super) const LONGEST: f64 = 50.0;

/// Logarithm of how much likelier an edge is at each place in each direction if the table is right there than
/// anywhere.
pub struct EdgeField {
    pub(super) window: Window,
    /// By direction, row by row.
    pub(super) log_ratios: Vec<Gray>,
}

impl EdgeField {
    /// The field of the edges of `table` around `place`, as far as `reach` metres to each side.
    pub fn around(place: GroundPoint, reach: f64, table: &ReferenceTable) -> Self {
        let rect = GroundRect::centered(place, 2.0 * reach, 2.0 * reach);
        let window = Window::covering(&rect, CELL);
        let is_edge = |landmark: &&GenericLandmark| match landmark.class {
            GenericClass::Other(name) => table.others()[usize::from(name)] == EDGE,
            _ => false,
        };
        let edges: Vec<_> = table
            .near(place, CORNER * reach + LONGEST)
            .filter(is_edge)
            .collect();
        let channel = |number: usize| {
            let direction = number as f64 * PI / DIRECTIONS as f64;
            let mut sums = Gray::filled(window.width, window.height, 0.0);
            for edge in &edges {
                enter(&mut sums, &window, edge, direction);
            }
            gaussian_blur(&sums, ACROSS / CELL)
        };
        let mut log_ratios: Vec<Gray> = (0..DIRECTIONS).map(channel).collect();
        // Beyond what the table covers nothing is known, which is not the same as that nothing is there.
        let bounds = table.bounds();
        let is_known = |index: usize| {
            let (column, row) = (index % window.width, index / window.width);
            let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            bounds.is_some_and(|bounds| bounds.contains(&place))
        };
        let known: Vec<bool> = (0..window.width * window.height).map(is_known).collect();
        let all = log_ratios
            .iter()
            .flat_map(|channel| channel.pixels().iter().zip(&known));
        let sum: f64 = all
            .filter(|(_, known)| **known)
            .map(|(value, _)| f64::from(*value))
            .sum();
        let count = known.iter().filter(|known| **known).count();
        let share = SHARED * (DIRECTIONS * count) as f64 / sum.max(1e-9);
        for channel in &mut log_ratios {
            for (value, known) in channel.pixels_mut().iter_mut().zip(&known) {
                let ratio = 1.0 - SHARED + share * f64::from(*value);
                *value = if *known { ratio.ln() as f32 } else { 0.0 };
            }
        }
        Self { window, log_ratios }
    }
}

/// Adds the places along an edge as far as it runs in `direction`.
fn enter(sums: &mut Gray, window: &Window, edge: &GenericLandmark, direction: f64) {
    let apart = (direction - edge.orientation + 0.5 * PI).rem_euclid(PI) - 0.5 * PI;
    let weight = (-0.5 * (apart / TURNED).powi(2)).exp() as f32;
    if weight < 0.02 {
        return;
    }
    let (sin, cos) = edge.orientation.sin_cos();
    let count = (edge.size / ENTERED) as usize;
    for number in 0..count {
        let along = (number as f64 + 0.5) * ENTERED - 0.5 * edge.size;
        let (north, east) = (
            edge.place.north + along * cos,
            edge.place.east + along * sin,
        );
        let (x, y) = window.pixel_at(&GroundPoint::new(north, east));
        if x >= 0.0 && y >= 0.0 && x < window.width as f64 && y < window.height as f64 {
            let (x, y) = (x as usize, y as usize);
            sums.set(x, y, sums.get(x, y) + weight);
        }
    }
}
