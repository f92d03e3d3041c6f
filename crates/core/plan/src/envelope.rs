//! From where a landmark can be found: over heights and tilts of the camera.

use serde::{Deserialize, Serialize};

use super::{Assessor, LookTally};

/// Tallies of how often a landmark is found, over heights and tilts: what a view draws as a grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// Heights of the camera above ground, metres.
    pub heights: Vec<f64>,
    /// Tilts of the camera that the filter knows of, radians.
    pub tilts: Vec<f64>,
    /// Height by height the tally of each tilt. No look where the landmark does not fit into the
    /// picture.
    pub cells: Vec<LookTally>,
}

impl Envelope {
    /// The tally at a height and a tilt, by their indices.
    pub fn at(&self, height: usize, tilt: usize) -> Option<&LookTally> {
        let row = self.cells.chunks(self.tilts.len().max(1)).nth(height)?;
        row.get(tilt)
    }
}

/// Fills an envelope, a look a call, so that the caller can show progress and stop.
pub struct EnvelopeSurvey {
    assessor: Assessor,
    envelope: Envelope,
    each: usize,
    done: usize,
}

impl EnvelopeSurvey {
    /// Days on which it looks.
    pub const DAYS: usize = 3;
    /// Looks in each cell.
    pub const LOOKS: usize = 6;
    /// Heights that are tried, as shares of the planned one.
    pub const HEIGHTS: [f64; 5] = [0.5, 0.75, 1.0, 1.5, 2.25];
    /// Tilts that are tried, degrees.
    pub const TILTS: [f64; 4] = [0.0, 10.0, 20.0, 30.0];

    /// The usual heights around the planned one and the usual tilts.
    pub fn usual(assessor: Assessor) -> Self {
        let heights = Self::HEIGHTS.map(|share| share * assessor.height());
        let tilts = Self::TILTS.map(f64::to_radians);
        Self::new(assessor, heights.to_vec(), tilts.to_vec(), Self::LOOKS)
    }

    /// `each` looks from every height (metres) with every tilt (radians).
    pub fn new(assessor: Assessor, heights: Vec<f64>, tilts: Vec<f64>, each: usize) -> Self {
        let cells = vec![LookTally::default(); heights.len() * tilts.len()];
        Self {
            assessor,
            envelope: Envelope {
                heights,
                tilts,
                cells,
            },
            each,
            done: 0,
        }
    }

    /// Looks taken, and looks in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.done, self.each * self.envelope.cells.len())
    }

    /// Takes the next look; false when all are taken. Cells take turns.
    pub fn advance(&mut self) -> bool {
        let (done, all) = self.progress();
        if done >= all {
            return false;
        }
        self.done += 1;
        let cell = done % self.envelope.cells.len();
        let tilts = self.envelope.tilts.len();
        let height = self.envelope.heights[cell / tilts];
        let tilt = self.envelope.tilts[cell % tilts];
        // Every cell goes through the days, however many cells there are.
        let day = done / self.envelope.cells.len();
        if let Some(view) = self.assessor.look_from(day, height, tilt) {
            self.envelope.cells[cell].add(&view);
        }
        true
    }

    /// Tallies so far.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::Circumstances;
    use pilotage_raster::imagery::CachedImagery;
    use pilotage_simulate::other_days::{OtherDays, SceneryDays};
    use pilotage_simulate::simulate::Scenario;

    #[test]
    fn a_pool_is_found_from_its_usual_height_and_does_not_fit_into_a_picture_from_far_below() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let pool = mission.landmarks.last().unwrap();
        let map = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), 64));
        let circumstances = Circumstances {
            camera: Scenario::camera(),
            height: scenario.height,
            position: 4.0,
            sensors: mission.navigator.sensors,
            detector: mission.navigator.detector,
            ground_down: 0.0,
            tilt: 0.0,
        };
        let days = SceneryDays {
            scenery: Scenario::map(),
        };
        let assessor = Assessor::new(pool, map, &days.spread(2, 5), circumstances, 5);
        let (heights, tilts) = (vec![30.0, 122.0], vec![0.0, 0.3]);
        let mut survey = EnvelopeSurvey::new(assessor, heights, tilts, 4);
        while survey.advance() {}
        let envelope = survey.envelope();
        assert_eq!(survey.progress(), (16, 16));
        assert_eq!(envelope.at(0, 0).unwrap().looks, 0);
        let usual = envelope.at(1, 0).unwrap();
        assert!(usual.looks == 4 && usual.found >= 3, "{envelope:?}");
        assert!(envelope.at(1, 1).unwrap().looks >= 3, "{envelope:?}");
        // Two cells hold the pool and there are two days: neither cell sees one of them alone.
        let on = |tilt: f64, day: usize| {
            let views = survey.assessor.views().iter();
            views.filter(|v| v.tilt == tilt && v.day == day).count()
        };
        assert_eq!([on(0.0, 0), on(0.0, 1)], [2, 2]);
        assert!(on(0.3, 0) > 0 && on(0.3, 1) > 0);
    }
}
