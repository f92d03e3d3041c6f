//! Plans of studies: what varies and how, what is measured, when it is enough. Files of TOML.

use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};

use super::by_name::ByName;
use super::measure::MeasureKind;
use super::run_settings::RunSettings;
use super::sobol::SobolPoints;
use super::study_mission::PlanMission;
use super::value::{SettingDistribution, SettingValue};

/// Fewest scrambles whose scatter tells an error.
const FEWEST_SCRAMBLES: u64 = 8;
/// Most scrambles, each of which has sums of its own in every cell.
const MOST_SCRAMBLES: u64 = 4096;
/// Most flights of a study: some four months of a processor.
const MOST_RUNS: u64 = 1_000_000_000;
/// Most cells times measures, each of which takes some 50 kB.
const MOST_TALLIES: u64 = 10_000;

/// Way of drawing the settings that are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DrawBy {
    /// Each by itself.
    #[default]
    Random,
    /// By Sobol's points, in several independent scrambles.
    Sobol,
}

/// Measure of a study: a number of each flight, or whether it lies on one side of a limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyMeasure {
    /// Kind of number.
    pub of: MeasureKind,
    /// Name in tables, if another than that of the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Limit up to which the number counts as one and beyond as zero, in its unit; so does a flight that the filter gave
    /// up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

impl StudyMeasure {
    /// Name in tables.
    pub fn name(&self) -> &str {
        self.name.as_deref().unwrap_or(self.of.key())
    }

    /// The measure of a flight whose number of its kind is `number`.
    pub fn judged(&self, number: Option<f64>) -> Option<f64> {
        let Some(limit) = self.at_most else {
            return number;
        };
        Some(f64::from(u8::from(
            number.is_some_and(|number| number <= limit),
        )))
    }

    /// The measure of a flight with these numbers of all kinds, in the order of [`MeasureKind::ALL`].
    pub fn among(&self, numbers: &[Option<f64>]) -> Option<f64> {
        self.judged(self.of.among(numbers))
    }

    /// Whether it is the share of flights for which something holds.
    pub fn is_share(&self) -> bool {
        self.at_most.is_some() || self.of.is_share()
    }

    /// Unit of its number; none of a share.
    pub fn unit(&self) -> &'static str {
        if self.is_share() { "" } else { self.of.unit() }
    }

    /// Smallest and largest number that there can be.
    pub(crate) fn range(&self) -> [f64; 2] {
        let is_part = self.is_share() || self.of == MeasureKind::Inside;
        [0.0, if is_part { 1.0 } else { f64::INFINITY }]
    }
}

/// Rule by which a study ends before all its flights are flown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StopRule {
    /// Name of the measure that is looked at.
    pub measure: String,
    /// Half width of its 95 % interval that is narrow enough in every cell, in its unit.
    pub half_width: f64,
    /// Number of draws after which it is looked at, again and again.
    pub every: u64,
}

/// Plan of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyPlan {
    /// Name, of letters, digits and hyphens.
    pub name: String,
    /// Question that it answers.
    pub question: String,
    /// Seed of all that is drawn.
    #[serde(default)]
    pub seed: u64,
    /// Number of draws; each is flown once in every cell of what is crossed, with the same random numbers.
    pub draws: u64,
    /// Way of drawing.
    #[serde(default)]
    pub draw_by: DrawBy,
    /// Number of independent scrambles that share the draws, by Sobol's points.
    #[serde(default = "usual_scrambles")]
    pub scrambles: u64,
    /// Settings of all flights.
    #[serde(default)]
    pub fixed: ByName<SettingValue>,
    /// Settings of which every value is flown with every value of the others: the cells that are compared.
    #[serde(default)]
    pub cross: ByName<Vec<SettingValue>>,
    /// Settings that are drawn.
    #[serde(default)]
    pub draw: ByName<SettingDistribution>,
    /// Measures, in the order of the tables.
    pub measure: Vec<StudyMeasure>,
    /// When it is enough, if before the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopRule>,
    /// Missions that are flown, by the names that settings call them.
    #[serde(default, skip_serializing_if = "ByName::is_empty")]
    pub missions: ByName<PlanMission>,
}

fn usual_scrambles() -> u64 {
    16
}

/// Why a plan cannot be followed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// It is no plan.
    #[error("the plan cannot be read: {0}")]
    NoPlan(String),
    /// Something in it makes no sense.
    #[error("{place}: {why}")]
    Plan {
        /// Place in the plan.
        place: String,
        /// Why, and what to do.
        why: String,
    },
}

/// Refusal of what stands at `place`.
pub(crate) fn refusal(place: impl Into<String>, why: impl Into<String>) -> StudyError {
    StudyError::Plan {
        place: place.into(),
        why: why.into(),
    }
}

impl StudyPlan {
    /// The plan in a file of TOML.
    ///
    /// # Errors
    /// In words, with the line where it is no TOML or no plan, and with what stands in it that makes no sense.
    ///
    /// ```
    /// use pilotage_study::StudyPlan;
    ///
    /// let plan = StudyPlan::read(
    ///     r#"
    ///     name = "vehicles"
    ///     question = "Does a gust in the state pay?"
    ///     draws = 100
    ///     cross.vehicle = ["airplane-wind", "airplane-gust"]
    ///     draw.wind-speed = { uniform = [0, 8] }
    ///     [[measure]]
    ///     of = "error-rms"
    ///     "#,
    /// )?;
    /// assert_eq!(plan.runs(), 200);
    /// # Ok::<(), pilotage_study::StudyError>(())
    /// ```
    pub fn read(text: &str) -> Result<Self, StudyError> {
        Self::read_with(text, &mut |name| {
            Err(format!(
                "\"{name}\" is not in the plan; pilotage study PLAN --pack FILE puts mission files into one"
            ))
        })
    }

    /// The plan in a file of TOML, with the missions that it names and has not: `find` says what mission a name means, or why
    /// there is none.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with(
        text: &str,
        find: &mut dyn FnMut(&str) -> Result<Mission, String>,
    ) -> Result<Self, StudyError> {
        let mut plan: Self =
            basic_toml::from_str(text).map_err(|why| StudyError::NoPlan(why.to_string()))?;
        plan.take_missions(find)?;
        plan.check()?;
        Ok(plan)
    }

    /// The plan as TOML, with its missions.
    ///
    /// # Errors
    /// Where it cannot be written, in words.
    pub fn to_toml(&self) -> Result<String, String> {
        basic_toml::to_string(self).map_err(|why| why.to_string())
    }

    /// Number of cells that are compared.
    pub fn cells(&self) -> u64 {
        let sizes = self.cross.values().map(|values| values.len() as u64);
        sizes.fold(1, u64::saturating_mul)
    }

    /// Number of flights, if none are left out in the end.
    pub fn runs(&self) -> u64 {
        self.draws.saturating_mul(self.cells())
    }

    fn check(&self) -> Result<(), StudyError> {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-';
        if self.name.is_empty() || !self.name.chars().all(is_plain) {
            return Err(refusal(
                "name",
                "give a word of letters, digits and hyphens",
            ));
        }
        for (place, values) in self.cross.iter() {
            if values.is_empty() {
                return Err(refusal(format!("cross.{place}"), "give at least one value"));
            }
        }
        if self.draws == 0 || self.runs() > MOST_RUNS {
            return Err(refusal(
                "draws",
                format!("give 1 to {MOST_RUNS} flights in all"),
            ));
        }
        let tallies = self.cells().saturating_mul(self.measure.len() as u64);
        if tallies > MOST_TALLIES {
            let why = format!(
                "{} cells with {} measures each are more than memory is for: give {MOST_TALLIES} in all at most",
                self.cells(),
                self.measure.len()
            );
            return Err(refusal("cross", why));
        }
        if self.draw_by == DrawBy::Sobol {
            self.check_sobol()?;
        }
        self.check_settings()?;
        self.check_missions()?;
        self.check_measures()
    }

    fn check_sobol(&self) -> Result<(), StudyError> {
        let most = SobolPoints::MOST_DIMENSIONS;
        if self.draw.is_empty() || self.draw.len() > most {
            let why = format!("Sobol's points are here for 1 to {most} drawn settings");
            return Err(refusal("draw", why));
        }
        if !(FEWEST_SCRAMBLES..=MOST_SCRAMBLES).contains(&self.scrambles) {
            let why = format!(
                "give {FEWEST_SCRAMBLES} to {MOST_SCRAMBLES}, whose scatter tells the error"
            );
            return Err(refusal("scrambles", why));
        }
        let points = self.draws / self.scrambles;
        if !self.draws.is_multiple_of(self.scrambles) || points > u64::from(u32::MAX) {
            let why = "give a multiple of the scrambles; best a power of two of each";
            return Err(refusal("draws", why));
        }
        Ok(())
    }

    fn check_settings(&self) -> Result<(), StudyError> {
        let is_fixed = |key: &str| self.fixed.get(key).is_some();
        let again = self.cross.keys().find(|key| is_fixed(key));
        let again = again.map(|key| ("cross", key)).or_else(|| {
            let is_set = |key: &str| is_fixed(key) || self.cross.get(key).is_some();
            let key = self.draw.keys().find(|key| is_set(key));
            key.map(|key| ("draw", key))
        });
        if let Some((place, key)) = again {
            let why = "it is set twice; keep it fixed, crossed or drawn";
            return Err(refusal(format!("{place}.{key}"), why));
        }
        // Every value is tried: a study must not fail after an hour.
        let try_out = |place: &str, key: &str, value: &SettingValue| {
            let set = RunSettings::default().set(key, value);
            set.map_err(|why| refusal(format!("{place}.{key}"), why))
        };
        for (key, value) in self.fixed.iter() {
            try_out("fixed", key, value)?;
        }
        for (key, values) in self.cross.iter() {
            for value in values {
                try_out("cross", key, value)?;
            }
        }
        for (key, distribution) in self.draw.iter() {
            let place = format!("draw.{key}");
            if let Some(why) = distribution.trouble() {
                return Err(refusal(place, why));
            }
            if let SettingDistribution::Choice(values) = distribution {
                for value in values {
                    try_out("draw", key, value)?;
                }
            } else {
                // The tails of a normal distribution are cut where they would make no sense.
                try_out("draw", key, &distribution.at(0.5))?;
                if !matches!(distribution, SettingDistribution::Normal(_)) {
                    try_out("draw", key, &distribution.at(1e-9))?;
                    try_out("draw", key, &distribution.at(1.0 - 1e-9))?;
                }
            }
        }
        Ok(())
    }

    fn check_measures(&self) -> Result<(), StudyError> {
        let mut names: Vec<&str> = Vec::new();
        for measure in &self.measure {
            if names.contains(&measure.name()) {
                let why = format!("\"{}\" is there twice; give them names", measure.name());
                return Err(refusal("measure", why));
            }
            names.push(measure.name());
            if measure.at_most.is_some_and(|limit| !limit.is_finite()) {
                let why = format!("give \"{}\" a finite number", measure.name());
                return Err(refusal("measure.at_most", why));
            }
            let is_taken = ["run", "draw", "cell"].contains(&measure.name())
                || RunSettings::has(measure.name());
            if is_taken {
                let why = format!("\"{}\" is the name of another column", measure.name());
                return Err(refusal("measure", why));
            }
        }
        if names.is_empty() {
            return Err(refusal("measure", "say what to measure"));
        }
        let Some(stop) = &self.stop else {
            return Ok(());
        };
        if !names.contains(&stop.measure.as_str()) {
            let why = format!("\"{}\" is not measured", stop.measure);
            return Err(refusal("stop.measure", why));
        }
        if !(stop.half_width.is_finite() && stop.half_width > 0.0) {
            return Err(refusal(
                "stop.half_width",
                "give a finite number above zero",
            ));
        }
        if stop.every == 0 {
            return Err(refusal("stop.every", "give a number of draws above zero"));
        }
        if self.draw_by == DrawBy::Sobol && !stop.every.is_multiple_of(self.scrambles) {
            return Err(refusal("stop.every", "give a multiple of the scrambles"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = r#"
        name = "two"
        question = "Which?"
        draws = 32
        draw_by = "sobol"
        [fixed]
        seconds = 20
        [cross]
        vehicle = ["airplane-wind", "airplane-full"]
        bias-heading = [0, 1, 2]
        [draw]
        wind-speed = { uniform = [0, 8] }
        [[measure]]
        of = "error-rms"
        [[measure]]
        of = "error-max"
        name = "within 20 m"
        at_most = 20
        [stop]
        measure = "within 20 m"
        half_width = 0.01
        every = 16
    "#;

    #[test]
    fn a_plan_counts_its_cells_and_flights_and_survives_being_written() {
        let plan = StudyPlan::read(PLAN).unwrap();
        assert_eq!((plan.cells(), plan.runs(), plan.scrambles), (6, 192, 16));
        assert!(plan.measure[1].is_share() && !plan.measure[0].is_share());
        let again = StudyPlan::read(&basic_toml::to_string(&plan).unwrap()).unwrap();
        assert_eq!(again, plan);
    }

    #[test]
    fn more_cells_than_memory_is_for_are_refused() {
        let values: Vec<String> = (0..2501).map(|value| value.to_string()).collect();
        let text = PLAN.replace("[0, 1, 2]", &format!("[{}]", values.join(", ")));
        let why = StudyPlan::read(&text).unwrap_err().to_string();
        let told = "cross: 5002 cells with 2 measures each";
        assert!(why.starts_with(told) && why.contains("10000"), "{why}");
        let fewer = text.replace("vehicle = [\"airplane-wind\", ", "vehicle = [");
        assert_eq!(StudyPlan::read(&fewer).unwrap().cells(), 2501);
    }

    #[test]
    fn a_plan_that_makes_no_sense_is_refused_with_the_place_and_a_remedy() {
        let broken = [
            ("draws = 32", "draws = 33", "draws"),
            ("draws = 32", "draws = 0", "draws"),
            (
                "vehicle = [\"airplane-wind\"",
                "vehicle = [\"zeppelin\"",
                "cross.vehicle",
            ),
            ("seconds = 20", "wind-speed = 20", "draw.wind-speed"),
            ("seconds = 20", "second = 20", "fixed.second"),
            ("uniform = [0, 8]", "uniform = [8, 0]", "draw.wind-speed"),
            ("uniform = [0, 8]", "uniform = [-8, 0]", "draw.wind-speed"),
            (
                "measure = \"within 20 m\"",
                "measure = \"x\"",
                "stop.measure",
            ),
            ("every = 16", "every = 15", "stop.every"),
            ("every = 16", "every = 0", "stop.every"),
            ("half_width = 0.01", "half_width = inf", "stop.half_width"),
            ("half_width = 0.01", "half_width = -0.01", "stop.half_width"),
            ("at_most = 20", "at_most = inf", "measure.at_most"),
            ("at_most = 20", "at_most = nan", "measure.at_most"),
            ("seconds = 20", "wind-scatter = inf", "fixed.wind-scatter"),
            ("[0, 1, 2]", "[0, 1, nan]", "cross.bias-heading"),
            ("uniform = [0, 8]", "uniform = [0, inf]", "draw.wind-speed"),
            ("draws = 32", "draws = 200000000", "draws"),
            (
                "draws = 32",
                "draws = 40960000\nscrambles = 8192",
                "scrambles",
            ),
            ("name = \"within 20 m\"", "name = \"error-rms\"", "measure"),
            ("name = \"two\"", "name = \"../two\"", "name"),
            ("[0, 1, 2]", "[]", "cross.bias-heading"),
        ];
        for (what, instead, place) in broken {
            let text = PLAN.replace(what, instead);
            assert_ne!(text, PLAN, "{what}");
            let Err(StudyError::Plan { place: told, .. }) = StudyPlan::read(&text) else {
                panic!("{instead} is accepted");
            };
            assert_eq!(told, place, "{instead}");
        }
        let unknown = StudyPlan::read(&PLAN.replace("draws = 32", "drawz = 32"));
        assert!(matches!(unknown, Err(StudyError::NoPlan(why)) if why.contains("drawz")));
    }
}
