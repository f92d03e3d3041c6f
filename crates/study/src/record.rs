//! Record of a study that was flown whole: what the documents quote, and what tells whether it is still true.

use serde::{Deserialize, Serialize};

use super::digits::digits;
use super::fly::{Study, StudyRow};
use super::plan::{StudyError, StudyPlan};
use super::settings::StudySetting;
use super::summary::{CellSummary, MeasureSummary, StudySummary};
use super::value::SettingValue;

/// Number of draws whose flights are kept, to be flown again.
const KEPT_DRAWS: u64 = 3;
/// Share by which a number of a flight may differ on another machine.
const TOLERANCE: f64 = 1e-6;

/// Record of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyRecord {
    /// Date and state of the program with which it was flown, for people.
    pub made: String,
    /// Its plan.
    pub plan: StudyPlan,
    /// Outcome.
    pub summary: StudySummary,
    /// Its first flights.
    pub first: Vec<StudyRow>,
}

impl StudyRecord {
    /// The record of a study that came to `summary`, flown on the day and with the program that `made` tells.
    ///
    /// # Errors
    /// Where a flight's settings make no sense.
    pub fn new(study: &Study, summary: StudySummary, made: String) -> Result<Self, StudyError> {
        let plan = study.design().plan().clone();
        let kept = KEPT_DRAWS.min(plan.draws) * plan.cells();
        let first = (0..kept).map(|run| study.fly(run));
        Ok(Self {
            made,
            plan,
            summary,
            first: first.collect::<Result<_, _>>()?,
        })
    }

    /// Differences between the record and what `plan` and the program say today, in words; none where it still holds.
    ///
    /// # Errors
    /// Where a plan cannot be flown.
    pub fn out_of_date(&self, plan: &StudyPlan) -> Result<Vec<String>, StudyError> {
        if *plan != self.plan {
            return Ok(vec![format!("the plan of {} is another", plan.name)]);
        }
        let study = Study::new(plan.clone())?;
        let mut differences = Vec::new();
        for kept in &self.first {
            let flown = study.fly(kept.run)?;
            let measures = plan.measure.iter().zip(&kept.measured).zip(&flown.measured);
            for ((measure, kept_value), flown_value) in measures {
                if !are_equal(*kept_value, *flown_value) {
                    differences.push(format!(
                        "{}, run {}, {}: {kept_value:?} was recorded, {flown_value:?} is flown",
                        plan.name,
                        kept.run,
                        measure.name()
                    ));
                }
            }
        }
        Ok(differences)
    }

    /// Lines of a table in Markdown, one for each cell: study and cell, flights, when, and the means of all measures with
    /// their intervals of 95 %.
    ///
    /// ```
    /// use pilotage_study::{Study, StudyPlan, StudyRecord, StudyTally};
    ///
    /// let plan = r#"
    ///     name = "short"
    ///     question = "How far off is it?"
    ///     draws = 2
    ///     fixed = { seconds = 5, step = 0.5 }
    ///     measure = [{ of = "error-rms" }]
    /// "#;
    /// let study = Study::new(StudyPlan::read(plan)?)?;
    /// let mut tally = StudyTally::new(study.design());
    /// for run in 0..2 {
    ///     tally.take(study.fly(run)?)?;
    /// }
    /// let record = StudyRecord::new(&study, tally.summary(), "28 November 2026".to_owned())?;
    /// assert!(record.lines().starts_with("| `short` | 2 | 28 November 2026 | error-rms "));
    /// assert!(record.out_of_date(study.design().plan())?.is_empty());
    /// # Ok::<(), pilotage_study::StudyError>(())
    /// ```
    pub fn lines(&self) -> String {
        let summary = &self.summary;
        let line = |cell: &CellSummary| {
            let settings = cell.settings.iter().map(|(key, value)| match value {
                SettingValue::Number(number) => {
                    let value = StudySetting::with_unit(key, &number.to_string());
                    format!(", {key} {value}")
                }
                SettingValue::Text(name) => format!(", {name}"),
            });
            let figures = cell.measures.iter().map(|it| figure(it, summary.draws));
            let figures: Vec<String> = figures.collect();
            format!(
                "| `{}`{} | {} | {} | {} |\n",
                summary.name,
                settings.collect::<String>(),
                summary.draws,
                self.made,
                figures.join("; ")
            )
        };
        summary.cells.iter().map(line).collect()
    }
}

fn are_equal(one: Option<f64>, other: Option<f64>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => {
            (one - other).abs() <= TOLERANCE * one.abs().max(other.abs()).max(1.0)
        }
        (None, None) => true,
        _ => false,
    }
}

/// Name of a measure and its mean with the interval, and of how many of `draws` flights that is where some have no such number;
/// a share in percent.
fn figure(measure: &MeasureSummary, draws: u64) -> String {
    let (scale, unit) = if measure.is_share {
        (100.0, " %")
    } else {
        (1.0, "")
    };
    let unit = match measure.unit.as_str() {
        "" => unit.to_owned(),
        unit => format!(" {unit}"),
    };
    let mean = measure.mean.as_ref().map_or("-".to_owned(), |mean| {
        let interval = mean.interval.map_or(String::new(), |[low, high]| {
            format!(" [{}, {}]", digits(scale * low), digits(scale * high))
        });
        format!("{}{interval}{unit}", digits(scale * mean.mean))
    });
    let of = match measure.missing(draws) {
        0 => String::new(),
        missing => format!(" of {} flights", draws - missing),
    };
    format!("{} {mean}{of}", measure.name)
}
