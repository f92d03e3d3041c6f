//! Outcome of a study so far: errors and reliability by setting, and the flights that failed.

use pilotage_core::filter::{quantile, quantile_ranks};
use pilotage_core::training::evaluation::{Rate, correlation_within};
use pilotage_study::{DrawBy, MeasureKind, StudyPlan};

use super::grouping::{FlightGroups, StudyBy, compared};
use super::under_way::StudyUnderWay;

/// Share of the truth that an honest 95 % ellipse holds.
pub const PROMISED: f64 = 0.95;
/// Share of the time in the ellipse below which a flight failed.
const LEAST_INSIDE: f64 = 0.5;

/// Errors of the flights of a setting: quantiles, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorSpread {
    /// 5 %, 25 %, 50 %, 75 % and 95 %.
    pub quantiles: [f64; 5],
    /// 95 % interval of the median, by the binomial law of ranks; `None` where the flights are no independent draws, or too
    /// few.
    pub median: Option<[f64; 2]>,
}

impl ErrorSpread {
    fn of(mut values: Vec<f64>, are_independent: bool) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| quantile(&values, share);
        let ranks = quantile_ranks(values.len() as u64, 0.5).filter(|_| are_independent);
        let mut quantiles = [0.0; 5];
        for (value, share) in quantiles.iter_mut().zip([0.05, 0.25, 0.5, 0.75, 0.95]) {
            *value = at(share)?;
        }
        Some(Self {
            quantiles,
            median: ranks.map(|ranks| ranks.map(|rank| values[rank as usize])),
        })
    }
}

/// Flights of one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingOutcome {
    /// Setting in words.
    pub label: String,
    /// Flights that were flown.
    pub flights: usize,
    /// Their errors; `None` where none has any.
    pub error: Option<ErrorSpread>,
    /// Flights at whose end the truth lay in the 95 % ellipse, of those that came to their end.
    pub inside: [usize; 2],
    /// Wilson's 95 % interval of that share, of as many flights as those of the same draws are worth.
    pub interval: [f64; 2],
    /// Mean share of the time in which the truth lay in the ellipse.
    pub time_inside: Option<f64>,
}

impl SettingOutcome {
    /// Share of the flights at whose end the truth lay in the ellipse.
    pub fn share(&self) -> Option<f64> {
        let [inside, of] = self.inside;
        (of > 0).then(|| inside as f64 / of as f64)
    }

    /// Whether the filter believes too much, beyond chance.
    pub fn is_too_sure(&self) -> bool {
        self.inside[1] > 0 && self.interval[1] < PROMISED
    }
}

/// Flight that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct FailedRun {
    /// Number of the run.
    pub run: u64,
    /// Values that are compared, in words.
    pub setting: String,
    /// Largest error, metres; `None` of a flight that the filter gave up.
    pub largest: Option<f64>,
    /// Root mean square error, metres.
    pub rms: Option<f64>,
    /// Share of the time in which the truth lay in the 95 % ellipse.
    pub inside: Option<f64>,
    /// Why it failed, in words.
    pub why: String,
}

/// Outcome of a study so far.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyOutcome {
    /// Setting by setting, in the order of the plan or of their size.
    pub settings: Vec<SettingOutcome>,
    /// Flights that failed, in the order of their runs.
    pub failed: Vec<FailedRun>,
}

impl StudyOutcome {
    /// Outcome of what was flown, with errors of a kind, by a setting.
    pub fn of(study: &StudyUnderWay, error: MeasureKind, by: StudyBy) -> Self {
        let plan = study.plan();
        let groups = FlightGroups::of(study, by);
        let mut tallies = vec![SettingTally::default(); groups.labels.len()];
        let mut failed = Vec::new();
        for ((run, numbers), group) in study.rows().zip(&groups.of) {
            if let Some(tally) = tallies.get_mut(*group) {
                tally.take(run / plan.cells(), numbers, error);
            }
            failed.extend(failure(plan, numbers).map(|why| FailedRun {
                run,
                setting: compared(study, run % plan.cells()),
                largest: MeasureKind::ErrorMax.among(numbers),
                rms: MeasureKind::ErrorRms.among(numbers),
                inside: MeasureKind::Inside.among(numbers),
                why,
            }));
        }
        let settings = groups.labels.into_iter().zip(tallies);
        let is_random = plan.draw_by == DrawBy::Random;
        Self {
            settings: settings
                .map(|(label, tally)| tally.outcome(label, is_random))
                .collect(),
            failed,
        }
    }
}

/// Flights of a setting, counted.
#[derive(Clone, Default)]
struct SettingTally {
    flights: usize,
    errors: Vec<f64>,
    /// Latest draw: runs come draw by draw.
    draw: Option<u64>,
    /// Of each draw, flights that ended inside, and those that came to their end. Flights of a draw have the same seeds, so
    /// that they go alike.
    inside: Vec<(usize, usize)>,
    /// Sum of the shares of the time, and their number.
    time: (f64, f64),
}

impl SettingTally {
    fn take(&mut self, draw: u64, numbers: &[Option<f64>], error: MeasureKind) {
        self.flights += 1;
        self.errors.extend(error.among(numbers));
        if self.draw.replace(draw) != Some(draw) {
            self.inside.push((0, 0));
        }
        if let Some(is_inside) = MeasureKind::InsideAtEnd.among(numbers)
            && let Some(of_draw) = self.inside.last_mut()
        {
            of_draw.0 += usize::from(is_inside > 0.5);
            of_draw.1 += 1;
        }
        if let Some(share) = MeasureKind::Inside.among(numbers) {
            self.time.0 += share;
            self.time.1 += 1.0;
        }
    }

    /// Correlation of flights of the same draw in whether they ended inside. Where all end alike, or of a single draw, nothing
    /// tells how far they go together: a draw is worth one flight.
    fn correlation(&self) -> f64 {
        let inside: usize = self.inside.iter().map(|draw| draw.0).sum();
        let of: usize = self.inside.iter().map(|draw| draw.1).sum();
        let drawn = self.inside.iter().filter(|draw| draw.1 > 0).count();
        if drawn < 2 || inside == 0 || inside == of {
            1.0
        } else {
            correlation_within(&self.inside)
        }
    }

    fn outcome(self, label: String, is_random: bool) -> SettingOutcome {
        let has_one_of_each_draw = self.inside.len() == self.flights;
        let inside = Rate::clustered(&self.inside, self.correlation());
        let (sum, count) = self.time;
        SettingOutcome {
            label,
            flights: self.flights,
            error: ErrorSpread::of(self.errors, is_random && has_one_of_each_draw),
            inside: [inside.happened, inside.of],
            interval: [inside.low, inside.high],
            time_inside: (count > 0.0).then(|| sum / count),
        }
    }
}

/// Why a flight failed, in words; `None` if it did not: the filter gave up, an error passed a limit of the plan, or the
/// truth lay outside of the 95 % ellipse for more than half of the time.
fn failure(plan: &StudyPlan, numbers: &[Option<f64>]) -> Option<String> {
    if MeasureKind::Finished.among(numbers) != Some(1.0) {
        return Some("the filter gave up".to_owned());
    }
    let mut why = Vec::new();
    for measure in plan.measure.iter().filter(|m| m.at_most.is_some()) {
        let is_error = !measure.of.unit().is_empty();
        if is_error && measure.among(numbers) == Some(0.0) {
            why.push(format!("not {}", measure.name()));
        }
    }
    let inside = MeasureKind::Inside.among(numbers).unwrap_or(0.0);
    if inside < LEAST_INSIDE {
        why.push("mostly outside its ellipse".to_owned());
    }
    (!why.is_empty()).then(|| why.join("; "))
}

#[cfg(test)]
mod tests {
    use pilotage_study::{StudyDesign, StudyRow, StudyTally};

    use super::*;

    #[test]
    fn the_spread_of_errors_is_that_of_the_sorted_flights() {
        let values = (0..101).rev().map(f64::from).collect();
        let spread = ErrorSpread::of(values, true).unwrap();
        let expected = [5.0, 25.0, 50.0, 75.0, 95.0];
        for (value, expected) in spread.quantiles.into_iter().zip(expected) {
            assert!((value - expected).abs() < 1e-9);
        }
        // Ranks beyond which the binomial law of 101 flights has 2.5 % at most, by SciPy.
        assert_eq!(spread.median, Some([40.0, 60.0]));
        assert_eq!(ErrorSpread::of(Vec::new(), true), None);
        // Points of one scramble are no independent draws: their scatter is not that of the median.
        let of_points = ErrorSpread::of(vec![1.0, 2.0], false).unwrap();
        assert_eq!(of_points.median, None);
        // Of five flights the median lies beyond the smallest or the greatest once in sixteen times.
        let of_few = |count: u32| {
            let values = (0..count).map(f64::from).collect();
            ErrorSpread::of(values, true).unwrap().median
        };
        assert_eq!((of_few(5), of_few(6)), (None, Some([0.0, 5.0])));
    }

    #[test]
    fn flights_of_the_same_draw_are_worth_no_more_than_the_draw() {
        let outcome = |cells: u64, inside: u64| {
            let mut tally = SettingTally::default();
            // 20 draws, of which the last end outside, in every cell alike.
            for run in 0..20 * cells {
                let draw = run / cells;
                let numbers = MeasureKind::ALL.map(|kind| match kind {
                    MeasureKind::ErrorRms => Some(draw as f64),
                    MeasureKind::InsideAtEnd => Some(f64::from(u8::from(draw < inside))),
                    _ => None,
                });
                tally.take(draw, &numbers, MeasureKind::ErrorRms);
            }
            tally.outcome(String::new(), true)
        };
        let [one, ten] = [1, 10].map(|cells| outcome(cells, 18));
        // By the printed formulas: ranks of the binomial law of 20, and Wilson's interval of 18 of 20.
        assert_eq!(one.error.unwrap().median, Some([5.0, 14.0]));
        for outcome in [&one, &ten] {
            let [low, high] = outcome.interval;
            assert!((low - 0.6990).abs() < 1e-3 && (high - 0.9721).abs() < 1e-3);
            assert!(!outcome.is_too_sure());
        }
        assert_eq!((ten.inside, ten.flights), ([180, 200], 200));
        // Where all end inside, too: Wilson's interval of 20 of 20.
        let [low, high] = outcome(10, 20).interval;
        assert!((low - 0.8389).abs() < 1e-3 && (high - 1.0).abs() < 1e-9);
        assert_eq!(ten.error.unwrap().median, None);
    }

    /// Sorted flights on the page, tallies of constant size at the terminal.
    #[test]
    fn a_setting_has_the_figures_that_the_terminal_prints_of_its_cell() {
        let plan = "name = 'test'\nquestion = '?'\ndraws = 2001\n\
            measure = [{ of = 'error-rms' }, { of = 'inside-95-end' }]\n\
            cross.bias-heading = [0, 1, 2]";
        let design = StudyDesign::new(StudyPlan::read(plan).unwrap());
        let cells = design.plan().cells();
        let mut tally = StudyTally::new(&design);
        let mut settings = vec![SettingTally::default(); cells as usize];
        for run in 0..2001 * cells {
            let part = |step: f64| (step * run as f64).fract();
            let cell = (run % cells) as f64;
            let error = (1.0 + cell) * (2.5 * part(0.618_034)).exp();
            let is_inside = part(0.754_878) < 0.97 - 0.1 * cell;
            let inside = f64::from(u8::from(is_inside));
            let measured = vec![Some(error), Some(inside)];
            tally.take(StudyRow { run, measured }).unwrap();
            let numbers = MeasureKind::ALL.map(|kind| match kind {
                MeasureKind::ErrorRms => Some(error),
                MeasureKind::InsideAtEnd => Some(inside),
                _ => None,
            });
            settings[(run % cells) as usize].take(run / cells, &numbers, MeasureKind::ErrorRms);
        }
        let near = |a: f64, b: f64, most: f64| assert!((a - b).abs() <= most * b, "{a} {b}");
        for (cell, setting) in tally.summary().cells.iter().zip(settings) {
            let own = setting.outcome(String::new(), true);
            let [error, inside] = &cell.measures[..] else {
                panic!("{} measures", cell.measures.len())
            };
            let share = inside.mean.as_ref().unwrap();
            near(share.mean, own.share().unwrap(), 1e-12);
            for (theirs, own) in share.interval.unwrap().into_iter().zip(own.interval) {
                near(theirs, own, 1e-9);
            }
            // The terminal's quantiles are true to half a percent; neighbours here are 0.1 % apart.
            let spread = own.error.unwrap();
            let shares = [0.05, 0.25, 0.5, 0.75, 0.95];
            let mut compared = 0;
            for theirs in &error.quantiles {
                let same = shares.iter().position(|share| *share == theirs.share);
                if let Some(at) = same {
                    near(theirs.value, spread.quantiles[at], 0.007);
                    compared += 1;
                }
                if theirs.share == 0.5 {
                    let both = theirs
                        .interval
                        .unwrap()
                        .into_iter()
                        .zip(spread.median.unwrap());
                    both.for_each(|(theirs, own)| near(theirs, own, 0.007));
                }
            }
            assert!(compared >= 3, "{compared}");
        }
    }

    #[test]
    fn a_flight_fails_by_what_the_plan_says_or_by_an_ellipse_that_is_mostly_wrong() {
        let plan = StudyPlan::read(
            r#"
            name = "test"
            question = "?"
            draws = 1
            measure = [{ of = "error-max", name = "within 20 m", at_most = 20 }]
            "#,
        )
        .unwrap();
        let numbers = |finished: f64, largest: f64, inside: f64| {
            MeasureKind::ALL
                .map(|kind| match kind {
                    MeasureKind::Finished => Some(finished),
                    MeasureKind::ErrorMax => Some(largest),
                    MeasureKind::Inside => Some(inside),
                    _ => None,
                })
                .to_vec()
        };
        let why = |numbers: Vec<Option<f64>>| failure(&plan, &numbers);
        assert_eq!(why(numbers(1.0, 19.0, 0.6)), None);
        assert_eq!(
            why(numbers(1.0, 21.0, 0.9)),
            Some("not within 20 m".to_owned())
        );
        let both = why(numbers(1.0, 21.0, 0.2)).unwrap();
        assert_eq!(both, "not within 20 m; mostly outside its ellipse");
        assert_eq!(
            why(numbers(0.0, 1.0, 1.0)),
            Some("the filter gave up".to_owned())
        );
    }
}
