//! Outcome of a study: rows in the order of their numbers, gathered in constant memory.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::design::StudyDesign;
use super::digits::digits;
use super::fly::StudyRow;
use super::measured::{DrawPlace, MeanSummary, MeasureTally, QuantileSummary};
use super::philox::Philox;
use super::plan::{DrawBy, StudyError, StudyMeasure, refusal};
use super::resampled::weights;
use super::settings::StudySetting;
use super::value::SettingValue;

/// Measure in a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasureSummary {
    /// Name.
    pub name: String,
    /// Unit; empty of a share or a count.
    pub unit: String,
    /// Whether it is the share of flights for which something holds.
    pub is_share: bool,
    /// Mean over the flights that have such a number.
    pub mean: Option<MeanSummary>,
    /// Smallest and largest number.
    pub ends: Option<[f64; 2]>,
    /// Quantiles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub quantiles: Vec<QuantileSummary>,
    /// Mean of what this cell has more than the first in the same draw, over draws where both have a number; none of the
    /// first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minus_first: Option<MeanSummary>,
}

impl MeasureSummary {
    /// Number of `draws` flights that have no such number.
    pub(super) fn missing(&self, draws: u64) -> u64 {
        self.mean.as_ref().map_or(draws, |mean| mean.missing)
    }
}

/// Cell of what is crossed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellSummary {
    /// Crossed settings.
    pub settings: BTreeMap<String, SettingValue>,
    /// Measures in the order of the plan.
    pub measures: Vec<MeasureSummary>,
}

/// Summary of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudySummary {
    /// Name of the plan.
    pub name: String,
    /// Question of the plan.
    pub question: String,
    /// Draws that were flown in all cells.
    pub draws: u64,
    /// Flights.
    pub flights: u64,
    /// Whether the intervals were narrow enough before the end.
    pub is_stopped: bool,
    /// Reason why the rule to stop did not end the study, in words; none where it did, or where the plan has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_enough: Option<String>,
    /// Cells, the last of the crossed settings varying fastest.
    pub cells: Vec<CellSummary>,
}

/// Measures of a cell, and what they have more than the first cell.
struct CellTally {
    measures: Vec<MeasureTally>,
    minus_first: Vec<MeasureTally>,
}

/// Rows of a study, gathered in the order of their numbers.
pub struct StudyTally<'a> {
    design: &'a StudyDesign,
    random: Philox,
    cells: Vec<CellTally>,
    /// Rows of the draw that is not complete.
    held: Vec<StudyRow>,
    draws: u64,
    is_enough: bool,
}

/// Settings of a cell in words, with their units.
pub(super) fn cell_words<'a>(
    settings: impl Iterator<Item = (&'a String, &'a SettingValue)>,
) -> String {
    let words = settings
        .map(|(key, value)| format!("{key} {}", StudySetting::with_unit(key, &value.to_string())));
    words.collect::<Vec<_>>().join(", ")
}

impl<'a> StudyTally<'a> {
    /// Nothing yet.
    pub fn new(design: &'a StudyDesign) -> Self {
        let plan = design.plan();
        let scrambles = (plan.draw_by == DrawBy::Sobol).then_some(plan.scrambles);
        let tallies = |is_difference: bool| {
            let tally = move |measure: &StudyMeasure| {
                let is_share = measure.is_share() && !is_difference;
                let has_quantiles = !measure.is_share() && !is_difference;
                let [least, greatest] = measure.range();
                let range = if is_difference {
                    [least - greatest, greatest - least]
                } else {
                    [least, greatest]
                };
                MeasureTally::new(is_share, range, scrambles, has_quantiles)
            };
            plan.measure.iter().map(tally).collect::<Vec<_>>()
        };
        let cells = (0..plan.cells()).map(|cell| CellTally {
            measures: tallies(false),
            minus_first: if cell == 0 { Vec::new() } else { tallies(true) },
        });
        Self {
            design,
            random: Philox::new(plan.seed),
            cells: cells.collect(),
            held: Vec::new(),
            draws: 0,
            is_enough: false,
        }
    }

    /// Number of the run that comes next.
    pub fn next_run(&self) -> u64 {
        self.draws * self.cells.len() as u64 + self.held.len() as u64
    }

    /// Whether the rule of the plan says that it is enough, after the draws that were taken in: it is asked after fixed
    /// numbers of draws, so that the answer does not depend on who flew them.
    pub fn is_enough(&self) -> bool {
        self.is_enough
    }

    /// Draws after which it was enough.
    pub fn enough_after(&self) -> Option<u64> {
        self.is_enough.then_some(self.draws)
    }

    /// Takes in the next row; rows after it was enough are left out.
    ///
    /// ```
    /// use pilotage_study::{StudyDesign, StudyPlan, StudyRow, StudyTally};
    ///
    /// let plan = "name = 'end'\nquestion = 'How far off?'\ndraws = 3\nmeasure = [{ of = 'error-end' }]";
    /// let design = StudyDesign::new(StudyPlan::read(plan)?);
    /// let mut tally = StudyTally::new(&design);
    /// for (run, metres) in [(0, Some(2.0)), (1, None), (2, Some(6.0))] {
    ///     tally.take(StudyRow { run, measured: vec![metres] })?;
    /// }
    /// let summary = tally.summary();
    /// let mean = summary.cells[0].measures[0].mean.as_ref();
    /// assert_eq!(mean.map(|mean| (mean.count, mean.missing, mean.mean)), Some((2, 1, 4.0)));
    /// # Ok::<(), pilotage_study::StudyError>(())
    /// ```
    ///
    /// # Errors
    /// Where another row is the next.
    pub fn take(&mut self, row: StudyRow) -> Result<(), StudyError> {
        if self.is_enough {
            return Ok(());
        }
        let next = self.next_run();
        let measures = self.design.plan().measure.len();
        if row.run != next || row.measured.len() != measures {
            let why = format!(
                "run {} came with {} numbers where run {next} with {measures} was \
                               expected",
                row.run,
                row.measured.len()
            );
            return Err(refusal("rows", why));
        }
        self.held.push(row);
        if self.held.len() == self.cells.len() {
            self.take_draw();
        }
        Ok(())
    }

    fn take_draw(&mut self) {
        let plan = self.design.plan();
        let own = (plan.draw_by == DrawBy::Random).then(|| weights(self.random, self.draws));
        let place = match &own {
            Some(weights) => DrawPlace::Own(weights),
            None => DrawPlace::Scramble(self.design.cluster(self.draws) as usize),
        };
        for (cell, row) in self.cells.iter_mut().zip(&self.held) {
            for (tally, value) in cell.measures.iter_mut().zip(&row.measured) {
                tally.push(*value, &place);
            }
            let pairs = row.measured.iter().zip(&self.held[0].measured);
            for (tally, (value, first)) in cell.minus_first.iter_mut().zip(pairs) {
                let difference = value.zip(*first).map(|(value, first)| value - first);
                tally.push(difference, &place);
            }
        }
        self.held.clear();
        self.draws += 1;
        if let Some(stop) = &plan.stop
            && self.draws.is_multiple_of(stop.every)
        {
            let index = plan.measure.iter().position(|m| m.name() == stop.measure);
            self.is_enough = index.is_some_and(|index| {
                let widths = self
                    .cells
                    .iter()
                    .map(|cell| cell.measures[index].half_width());
                widths.fold(0.0, f64::max) <= stop.half_width
            });
        }
    }

    /// Reason why the rule to stop has not been met, by the cell that is farthest from it.
    fn not_enough(&self) -> Option<String> {
        let plan = self.design.plan();
        let stop = plan.stop.as_ref().filter(|_| !self.is_enough)?;
        let index = plan.measure.iter().position(|m| m.name() == stop.measure)?;
        let tallies = self.cells.iter().map(|cell| &cell.measures[index]);
        let mut widest: Option<(u64, &MeasureTally, f64)> = None;
        for (cell, tally) in (0..).zip(tallies) {
            let half = tally.half_width();
            if widest.is_none_or(|(.., most)| half > most) {
                widest = Some((cell, tally, half));
            }
        }
        let (cell, tally, half) = widest?;
        let cell = cell_words(plan.cross.keys().zip(self.design.cell_values(cell)));
        let unit = plan.measure[index].unit();
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        let why = match tally.mean() {
            None => "no flight has a number of it".to_owned(),
            Some(_) if half <= stop.half_width => {
                let looked = self.draws - self.draws % stop.every;
                let since = match looked {
                    0 => format!(
                        "it would first have been looked at after {} draws",
                        stop.every
                    ),
                    _ => format!("it was not when it was last looked at, after {looked} draws"),
                };
                format!("it is, to ± {}{unit}, but {since}", digits(half))
            }
            Some(_) if half.is_finite() => format!("its interval is ± {}{unit}", digits(half)),
            Some(_) => "it has no interval, as its numbers are too few or all alike".to_owned(),
        };
        Some(format!(
            "{} was to be known to ± {}{unit}{}; {why}",
            stop.measure,
            digits(stop.half_width),
            if cell.is_empty() {
                String::new()
            } else {
                format!(" in every cell: {cell}")
            },
        ))
    }

    /// Summary of the draws that were taken in.
    pub fn summary(&self) -> StudySummary {
        let plan = self.design.plan();
        let cells = self.cells.iter().zip(0..).map(|(cell, number)| {
            let values = self.design.cell_values(number);
            let settings = plan.cross.keys().cloned().zip(values.into_iter().cloned());
            let measures = plan.measure.iter().zip(&cell.measures).enumerate();
            let measures = measures.map(|(index, (measure, tally))| MeasureSummary {
                name: measure.name().to_owned(),
                unit: measure.unit().to_owned(),
                is_share: measure.is_share(),
                mean: tally.mean(),
                ends: tally.ends(),
                quantiles: tally.quantiles(),
                minus_first: cell.minus_first.get(index).and_then(MeasureTally::mean),
            });
            CellSummary {
                settings: settings.collect(),
                measures: measures.collect(),
            }
        });
        StudySummary {
            name: plan.name.clone(),
            question: plan.question.clone(),
            draws: self.draws,
            flights: self.draws * self.cells.len() as u64,
            is_stopped: self.is_enough && self.draws < plan.draws,
            not_enough: self.not_enough(),
            cells: cells.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::IntervalBy;
    use crate::plan::StudyPlan;

    fn design(more: &str) -> StudyDesign {
        let plan = format!(
            r#"
            name = "test"
            question = "Which?"
            draws = 400
            {more}
            cross.bias-heading = [0, 1]
            draw.wind-speed = {{ uniform = [0, 8] }}
            measure = [{{ of = "error-rms" }}, {{ of = "error-max", name = "near", at_most = 1 }}]
            "#
        );
        StudyDesign::new(StudyPlan::read(&plan).unwrap())
    }

    /// Rows in which the second cell has 0.2 more than the first, whose numbers scatter far more than that.
    fn rows(design: &StudyDesign) -> impl Iterator<Item = StudyRow> {
        (0..design.plan().runs()).map(|run| {
            let run_of = design.run(run).unwrap();
            let value = run_of.settings.wind_speed.unwrap() + 0.2 * run_of.cell as f64;
            StudyRow {
                run,
                measured: vec![Some(value), Some(f64::from(u8::from(value <= 1.0)))],
            }
        })
    }

    fn summary(design: &StudyDesign) -> StudySummary {
        let mut tally = StudyTally::new(design);
        for row in rows(design) {
            tally.take(row).unwrap();
        }
        tally.summary()
    }

    #[test]
    fn pairs_tell_a_difference_that_the_cells_by_themselves_do_not() {
        let summary = summary(&design(""));
        let [first, second] = [0, 1].map(|cell: usize| &summary.cells[cell].measures[0]);
        let interval = |mean: &MeanSummary| mean.interval.unwrap();
        let (first_mean, second_mean) = (first.mean.clone().unwrap(), second.mean.clone().unwrap());
        assert!(
            interval(&first_mean)[1] > interval(&second_mean)[0],
            "they overlap"
        );
        let difference = second.minus_first.clone().unwrap();
        let [low, high] = interval(&difference);
        assert!((difference.mean - 0.2).abs() < 1e-12 && high - low < 1e-9);
        assert!(first.minus_first.is_none());
        // An eighth of the winds are at most 1 m/s.
        let share = summary.cells[0].measures[1].mean.clone().unwrap();
        let [low, high] = share.interval.unwrap();
        assert!(low < 0.125 && 0.125 < high && share.interval_by == IntervalBy::Wilson);
        let table = summary.table();
        assert!(
            table.contains("bias-heading 1") && table.contains("error-rms, m"),
            "{table}"
        );
    }

    #[test]
    fn scrambled_points_have_a_far_narrower_interval_at_as_many_draws() {
        let width = |more: &str| {
            let mean = summary(&design(more)).cells[0].measures[0]
                .mean
                .clone()
                .unwrap();
            let [low, high] = mean.interval.unwrap();
            assert!(low < 4.0 && 4.0 < high, "{low} {high}");
            high - low
        };
        let (random, sobol) = (width(""), width("draw_by = \"sobol\""));
        assert!(sobol < 0.2 * random, "{sobol} {random}");
    }

    #[test]
    fn a_study_that_is_narrow_enough_ends_at_a_fixed_number_of_draws_and_leaves_the_rest_out() {
        let stop = "stop = { measure = \"near\", half_width = 0.08, every = 20 }";
        let design = design(stop);
        let summary = summary(&design);
        assert!(summary.is_stopped && summary.draws.is_multiple_of(20) && summary.draws < 400);
        let half = |summary: &StudySummary, cell: usize| {
            let mean = summary.cells[cell].measures[1].mean.clone().unwrap();
            let [low, high] = mean.interval.unwrap();
            0.5 * (high - low)
        };
        assert!((0..2).all(|cell| half(&summary, cell) <= 0.08));
        // Twenty draws before it was not.
        let mut before = StudyTally::new(&design);
        for row in rows(&design).take((summary.draws as usize - 20) * 2) {
            before.take(row).unwrap();
        }
        assert!(!before.is_enough() && (0..2).any(|cell| half(&before.summary(), cell) > 0.08));
    }

    #[test]
    fn a_row_out_of_order_is_refused() {
        let design = design("");
        let mut tally = StudyTally::new(&design);
        let row = rows(&design).nth(1).unwrap();
        assert!(tally.take(row).is_err());
    }
}
