//! Series of the plots, taken from a run step by step as it streams in.

use pilotage_core::filter::chi_square_interval;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{AidInfo, Outcome, Run, StepReport, UpdateReport};
use pilotage_core::vehicle::StateComponent;

use super::pyramid::ExtentPyramid;
use crate::short_map::ShortMap;

/// Most steps taken over in one frame of the screen, so that a long run fills without a stutter.
const STEPS_PER_FRAME: usize = 20_000;
/// Without a correction for this long, it is called dead reckoning, seconds.
pub(crate) const DEAD_RECKONING_AFTER: f64 = 2.0;

/// The step at which anything told the place last: step `index` of the run, or one a moment before; it is dead reckoning
/// without one.
pub(crate) fn placed_lately(run: &Run, index: usize) -> Option<&StepReport> {
    let now = run.steps.get(index)?.time;
    let steps = run.steps[..=index].iter().rev();
    let mut lately = steps.take_while(|step| now - step.time <= DEAD_RECKONING_AFTER);
    lately.find(|step| step.is_placed())
}

/// Columns of the table of steps, SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepColumn {
    NorthError,
    EastError,
    Distance,
    NorthSigma,
    EastSigma,
    DeadReckoning,
    WindNorth,
    WindEast,
    WindNorthLow,
    WindEastLow,
    WindNorthHigh,
    WindEastHigh,
    TrueWindNorth,
    TrueWindEast,
}

impl StepColumn {
    const COUNT: usize = 14;
}

/// Columns of the table of corrected frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrameColumn {
    Nis,
    Low,
    High,
}

/// Columns of the table of an aid beside pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AidColumn {
    /// NIS of what corrected the estimate.
    Used,
    /// The same of what was refused.
    Refused,
    Low,
    High,
}

/// Columns of the tables of innovations, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InnovationColumn {
    Right,
    Down,
    RightSigma,
    DownSigma,
}

/// Times and the columns that go with them.
#[derive(Clone, Debug)]
pub(crate) struct SeriesTable {
    pub times: Vec<f64>,
    columns: Vec<ExtentPyramid>,
}

impl SeriesTable {
    /// A table without rows.
    pub fn new(columns: usize) -> Self {
        Self {
            times: Vec::new(),
            columns: vec![ExtentPyramid::default(); columns],
        }
    }

    /// Appends a row; a hole for every value that is not there.
    pub fn push(&mut self, time: f64, row: impl IntoIterator<Item = Option<f64>>) {
        self.times.push(time);
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value.map_or(f32::NAN, |v| v as f32));
        }
    }

    /// Column `index` of the table.
    pub fn column(&self, index: usize) -> &ExtentPyramid {
        &self.columns[index]
    }
}

/// Readings of an aid over time, by [`AidColumn`].
#[derive(Clone, Debug)]
pub(crate) struct PlottedAid {
    /// Name of the aid in files.
    aid: String,
    /// Name for people.
    pub label: String,
    pub table: SeriesTable,
}

/// Fingerprint that tells whether a run is still the one that was taken over.
#[derive(Clone, Debug, PartialEq)]
struct Fingerprint {
    time: f64,
    north: f64,
    east: f64,
    variance: f64,
    truth: usize,
}

impl Fingerprint {
    fn of(step: &StepReport, flight: Option<&Flight>) -> Self {
        Self {
            time: step.time,
            north: step.after.mean[0],
            east: step.after.mean[1],
            variance: step.after.covariance[(0, 0)],
            truth: truth_length(flight),
        }
    }
}

fn truth_length(flight: Option<&Flight>) -> usize {
    flight
        .and_then(|f| f.truth.as_ref())
        .map_or(0, |t| t.states.len())
}

/// Everything the plots draw of one run.
#[derive(Clone, Debug)]
pub(crate) struct RunSeries {
    pub steps: SeriesTable,
    pub frames: SeriesTable,
    pub accepted: SeriesTable,
    pub refused: SeriesTable,
    pub aids: Vec<PlottedAid>,
    /// Stretches without a correction, seconds.
    pub gaps: Vec<(f64, f64)>,
    /// Another number whenever anything in here is another.
    pub revision: u64,
    last_correction: Option<f64>,
    seen: Option<Fingerprint>,
    bounds: ShortMap<usize, (f64, f64)>,
}

impl Default for RunSeries {
    fn default() -> Self {
        Self {
            steps: SeriesTable::new(StepColumn::COUNT),
            frames: SeriesTable::new(3),
            accepted: SeriesTable::new(4),
            refused: SeriesTable::new(4),
            aids: Vec::new(),
            gaps: Vec::new(),
            revision: 0,
            last_correction: None,
            seen: None,
            bounds: ShortMap::default(),
        }
    }
}

impl RunSeries {
    /// Takes over what has come since the last call; starts anew if the run is another one.
    ///
    /// Returns whether there is more to take over.
    pub fn update(&mut self, run: Option<&Run>, flight: Option<&Flight>) -> bool {
        let Some(run) = run else {
            if !self.steps.times.is_empty() {
                self.start_anew();
            }
            return false;
        };
        let taken = self.steps.times.len();
        let same = match (&self.seen, taken.checked_sub(1)) {
            (Some(seen), Some(last)) => run
                .steps
                .get(last)
                .is_some_and(|s| Fingerprint::of(s, flight) == *seen),
            _ => true,
        };
        if !same {
            self.start_anew();
        }
        let from = self.steps.times.len();
        let to = run.steps.len().min(from + STEPS_PER_FRAME);
        let wind = run
            .state_index(StateComponent::WindNorth)
            .zip(run.state_index(StateComponent::WindEast));
        for step in &run.steps[from..to] {
            self.add(step, flight, wind);
        }
        if to > from {
            self.revision += 1;
        }
        if let Some(last) = to.checked_sub(1) {
            self.seen = Some(Fingerprint::of(&run.steps[last], flight));
        }
        to < run.steps.len()
    }

    fn start_anew(&mut self) {
        *self = Self {
            revision: self.revision + 1,
            ..Self::default()
        };
    }

    fn add(&mut self, step: &StepReport, flight: Option<&Flight>, wind: Option<(usize, usize)>) {
        let truth = flight.and_then(|f| f.truth.as_ref());
        let position = truth.and_then(|t| t.position(step.time));
        let error = position.map(|p| (step.after.mean[0] - p.x, step.after.mean[1] - p.y));
        let sigma = |i: usize| step.after.covariance[(i, i)].max(0.0).sqrt();
        let mut row = [None; StepColumn::COUNT];
        let mut set = |column: StepColumn, value: Option<f64>| row[column as usize] = value;
        set(StepColumn::NorthError, error.map(|e| e.0));
        set(StepColumn::EastError, error.map(|e| e.1));
        set(StepColumn::Distance, error.map(|e| e.0.hypot(e.1)));
        set(StepColumn::NorthSigma, Some(sigma(0)));
        set(StepColumn::EastSigma, Some(sigma(1)));
        set(
            StepColumn::DeadReckoning,
            position.map(|p| (step.dead_reckoned.north - p.x).hypot(step.dead_reckoned.east - p.y)),
        );
        if let Some((north, east)) = wind {
            let mean = &step.after.mean;
            set(StepColumn::WindNorth, Some(mean[north]));
            set(StepColumn::WindEast, Some(mean[east]));
            set(StepColumn::WindNorthLow, Some(mean[north] - sigma(north)));
            set(StepColumn::WindEastLow, Some(mean[east] - sigma(east)));
            set(StepColumn::WindNorthHigh, Some(mean[north] + sigma(north)));
            set(StepColumn::WindEastHigh, Some(mean[east] + sigma(east)));
        }
        let true_wind = truth.and_then(|t| t.wind(step.time));
        set(StepColumn::TrueWindNorth, true_wind.map(|w| w.x));
        set(StepColumn::TrueWindEast, true_wind.map(|w| w.y));
        self.steps.push(step.time, row);
        self.add_frame(step);
        for update in &step.updates {
            self.add_reading(step.time, update);
        }
        self.add_gap(step);
    }

    /// Bounds within which 95 % of an honest filter's NIS with so many degrees of freedom are.
    fn bounds(&mut self, freedom: usize) -> (f64, f64) {
        let known = self.bounds.get(&freedom).copied();
        known.unwrap_or_else(|| {
            let found = chi_square_interval(freedom as f64);
            self.bounds.insert(freedom, found);
            found
        })
    }

    fn add_reading(&mut self, time: f64, update: &UpdateReport) {
        let (low, high) = self.bounds(update.degrees_of_freedom);
        let (nis, is_used) = (Some(update.nis), update.is_accepted());
        let row = [
            nis.filter(|_| is_used),
            nis.filter(|_| !is_used),
            Some(low),
            Some(high),
        ];
        let place = self.aids.iter().position(|known| known.aid == update.aid);
        let place = place.unwrap_or_else(|| {
            let label = AidInfo::named(&update.aid).map_or(&*update.aid, |info| info.label);
            self.aids.push(PlottedAid {
                aid: update.aid.clone(),
                label: label.to_owned(),
                table: SeriesTable::new(4),
            });
            self.aids.len() - 1
        });
        self.aids[place].table.push(time, row);
    }

    fn add_frame(&mut self, step: &StepReport) {
        let Some(frame) = &step.frame else { return };
        if let Some(joint) = &frame.joint {
            let (low, high) = self.bounds(joint.degrees_of_freedom);
            self.frames
                .push(step.time, [Some(joint.nis), Some(low), Some(high)]);
        }
        for candidate in &frame.candidates {
            let Some(innovation) = candidate.innovation else {
                continue;
            };
            let covariance = &candidate.innovation_covariance;
            let row = [
                Some(innovation.x),
                Some(innovation.y),
                Some(covariance[(0, 0)].max(0.0).sqrt()),
                Some(covariance[(1, 1)].max(0.0).sqrt()),
            ];
            if candidate.outcome == Outcome::Accepted {
                self.accepted.push(step.time, row);
            } else {
                self.refused.push(step.time, row);
            }
        }
    }

    fn add_gap(&mut self, step: &StepReport) {
        let since = *self.last_correction.get_or_insert(step.time);
        if step.is_placed() {
            self.last_correction = Some(step.time);
        } else if step.time - since > DEAD_RECKONING_AFTER {
            match self.gaps.last_mut() {
                Some(gap) if gap.0 == since => gap.1 = step.time,
                _ => self.gaps.push((since, step.time)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::super::super::fixture::{Fixture, reading_of_gps};
    use super::*;

    #[test]
    fn a_run_that_streams_in_gives_the_same_series_as_the_whole_one() {
        let fixture = Fixture::lasting(15.0);
        let mut whole = RunSeries::default();
        whole.update(Some(&fixture.run), Some(&fixture.flight));
        let mut partial = fixture.run.clone();
        partial.steps.clear();
        let mut streamed = RunSeries::default();
        for chunk in fixture.run.steps.chunks(17) {
            partial.steps.extend_from_slice(chunk);
            streamed.update(Some(&partial), Some(&fixture.flight));
        }
        assert_eq!(whole.steps.times, streamed.steps.times);
        assert_eq!(whole.frames.times, streamed.frames.times);
        assert_eq!(whole.gaps, streamed.gaps);
        let column = StepColumn::Distance as usize;
        assert_eq!(
            whole.steps.column(column).extent(0, 300),
            streamed.steps.column(column).extent(0, 300)
        );
    }

    #[test]
    fn another_run_takes_the_place_of_the_first() {
        let fixture = Fixture::lasting(15.0);
        let mut series = RunSeries::default();
        series.update(Some(&fixture.run), Some(&fixture.flight));
        let mut other = fixture.run.clone();
        other.steps.truncate(40);
        for step in &mut other.steps {
            step.after.mean[0] += 5.0;
        }
        series.update(Some(&other), Some(&fixture.flight));
        assert_eq!(series.steps.times.len(), 40);
        let index = other.index_at(1.0).unwrap();
        let error = series
            .steps
            .column(StepColumn::NorthError as usize)
            .get(index);
        let error = f64::from(error.unwrap());
        let step = &other.steps[index];
        let truth = fixture
            .flight
            .truth
            .as_ref()
            .unwrap()
            .position(step.time)
            .unwrap();
        assert!((error - (step.after.mean[0] - truth.x)).abs() < 1e-4);
    }

    #[test]
    fn nis_of_aids_stands_beside_that_of_pictures_used_and_refused() {
        let mut fixture = Fixture::lasting(15.0);
        for (step, nis, gain) in [(3, 1.5, Some(DMatrix::zeros(4, 2))), (8, 40.0, None)] {
            fixture.run.steps[step]
                .updates
                .push(reading_of_gps(nis, gain));
        }
        let mut series = RunSeries::default();
        series.update(Some(&fixture.run), Some(&fixture.flight));
        let [gps] = &series.aids[..] else {
            panic!("{:?}", series.aids);
        };
        assert_eq!((&*gps.label, gps.table.times.len()), ("GPS position", 2));
        let of = |column: AidColumn, row| gps.table.column(column as usize).get(row);
        assert_eq!(of(AidColumn::Used, 0), Some(1.5));
        assert_eq!(of(AidColumn::Refused, 1), Some(40.0));
        assert!(of(AidColumn::Refused, 0).is_none_or(f32::is_nan));
    }

    #[test]
    fn each_aid_has_the_bounds_of_its_own_count_of_numbers() {
        let mut fixture = Fixture::lasting(15.0);
        for step in &mut fixture.run.steps {
            let reading = reading_of_gps(1.5, Some(DMatrix::zeros(4, 2)));
            let range = UpdateReport {
                aid: "ground-range".to_owned(),
                degrees_of_freedom: 1,
                ..reading.clone()
            };
            step.updates = vec![reading, range];
        }
        let mut series = RunSeries::default();
        series.update(Some(&fixture.run), Some(&fixture.flight));
        // From printed tables: chi-square of 2.5 % and 97.5 % with two degrees of freedom and with one.
        let expected = [[0.0506, 7.378], [0.000_982, 5.024]];
        assert_eq!(series.aids.len(), expected.len());
        for (readings, expected) in series.aids.iter().zip(expected) {
            let columns = [AidColumn::Low, AidColumn::High].into_iter().zip(expected);
            for (column, expected) in columns {
                let bound = readings.table.column(column as usize).get(7).unwrap();
                let off = f64::from(bound) / expected - 1.0;
                assert!(off.abs() < 1e-3, "{} {column:?}: {bound}", readings.label);
            }
        }
    }

    #[test]
    fn the_stretch_between_school_and_pool_is_a_gap() {
        let fixture = Fixture::new();
        let mut series = RunSeries::default();
        series.update(Some(&fixture.run), Some(&fixture.flight));
        let longest = series.gaps.iter().map(|g| g.1 - g.0).fold(0.0, f64::max);
        assert!(longest > 10.0, "{longest}");
    }
}
