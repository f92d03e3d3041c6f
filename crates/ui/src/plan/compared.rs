//! A route that was found in numbers, to be compared with another.

use pilotage_jobs::Foreseen;

/// Figures of a route in the comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteFigures {
    /// Length over the way-points, metres.
    pub length: f64,
    /// Duration with its turns, seconds.
    pub time: f64,
    /// Largest predicted standard deviation, metres.
    pub worst: f64,
    /// Its mean along the route, metres.
    pub mean: f64,
}

impl RouteFigures {
    /// Figures of a route; `None` without a prediction.
    pub fn of(foreseen: &Foreseen) -> Option<Self> {
        let last = foreseen.prediction.samples.last()?;
        Some(Self {
            length: foreseen.route.length,
            time: last.time,
            worst: foreseen.worst_sigma(),
            mean: foreseen.mean_sigma(),
        })
    }
}
