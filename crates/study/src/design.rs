//! Designs: what each run of a study is, by its number alone.
//!
//! Runs are numbered draw by draw, and within a draw cell by cell: a study that ends early has flown every cell as often
//! as any other. All cells of a draw have the same seeds and the same drawn settings (common random numbers), so that
//! what differs between them is the cell alone.

use super::philox::{Philox, Stream};
use super::plan::{DrawBy, StudyError, StudyPlan};
use super::run_settings::RunSettings;
use super::seeds::Seeds;
use super::sobol::SobolPoints;
use super::study_flight::StudyFlight;
use super::study_mission::FlownMission;
use super::value::SettingValue;

/// Run of a study before it is flown.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRun {
    /// Number of the run.
    pub number: u64,
    /// Number of its draw.
    pub draw: u64,
    /// Number of its cell.
    pub cell: u64,
    /// Settings.
    pub settings: RunSettings,
    /// Values of the crossed settings, then of the drawn ones as they are flown, each in the order of their names.
    pub values: Vec<SettingValue>,
    /// Seeds by stream.
    pub(crate) seeds: Seeds,
    /// Mission that is flown in place of a scenario.
    pub(crate) mission: Option<FlownMission>,
}

impl StudyRun {
    /// The flight of the run by itself.
    pub fn flight(&self) -> StudyFlight {
        StudyFlight {
            settings: self.settings.clone(),
            seeds: self.seeds,
            mission: self.mission.clone(),
        }
    }
}

/// Design of a study: run numbers and what they mean.
#[derive(Clone, Debug)]
pub struct StudyDesign {
    plan: StudyPlan,
    random: Philox,
    points: SobolPoints,
}

impl StudyDesign {
    /// The design of a plan.
    pub fn new(plan: StudyPlan) -> Self {
        Self {
            random: Philox::new(plan.seed),
            points: SobolPoints::new(plan.draw.len()),
            plan,
        }
    }

    /// The plan.
    pub fn plan(&self) -> &StudyPlan {
        &self.plan
    }

    /// Names of the crossed settings, then of the drawn ones.
    pub fn setting_names(&self) -> Vec<&str> {
        let names = self.plan.cross.keys().chain(self.plan.draw.keys());
        names.map(String::as_str).collect()
    }

    /// Values of the crossed settings in cell number `cell`, in the order of their names; the last varies fastest.
    pub fn cell_values(&self, cell: u64) -> Vec<&SettingValue> {
        let mut left = cell;
        let mut values: Vec<&SettingValue> = self
            .plan
            .cross
            .values()
            .rev()
            .map(|values| {
                let count = values.len() as u64;
                let value = &values[(left % count) as usize];
                left /= count;
                value
            })
            .collect();
        values.reverse();
        values
    }

    /// Number of the scramble of a draw, of which the draws of one are no independent samples; the draw itself where each
    /// is drawn by itself.
    pub fn cluster(&self, draw: u64) -> u64 {
        match self.plan.draw_by {
            DrawBy::Random => draw,
            DrawBy::Sobol => draw % self.plan.scrambles,
        }
    }

    fn unit(&self, draw: u64, index: usize) -> f64 {
        match self.plan.draw_by {
            DrawBy::Random => self.random.unit(Stream::Setting, draw, index as u32),
            DrawBy::Sobol => {
                let point = (draw / self.plan.scrambles) as u32;
                let key = self.random.word(Stream::Scramble, self.cluster(draw), 0);
                self.points.scrambled(point, index, key)
            }
        }
    }

    /// Run number `number`.
    ///
    /// ```
    /// use pilotage_study::{StudyDesign, StudyPlan};
    ///
    /// let design = StudyDesign::new(StudyPlan::read(r#"
    ///     name = "gusts"
    ///     question = "Does a gust in the state pay?"
    ///     draws = 50
    ///     cross.vehicle = ["airplane-wind", "airplane-gust"]
    ///     draw.wind-speed = { uniform = [2, 8] }
    ///     measure = [{ of = "error-rms" }]
    /// "#)?);
    /// // Each draw is flown in both cells, in the same wind: runs 6 and 7 are the fourth draw.
    /// let [first, second] = [design.run(6)?, design.run(7)?];
    /// assert_eq!((first.draw, first.cell, second.draw, second.cell), (3, 0, 3, 1));
    /// assert_eq!(first.settings.wind_speed, second.settings.wind_speed);
    /// # Ok::<(), pilotage_study::StudyError>(())
    /// ```
    ///
    /// # Errors
    /// Where a drawn setting makes no sense beside the others.
    pub fn run(&self, number: u64) -> Result<StudyRun, StudyError> {
        let cells = self.plan.cells();
        let (draw, cell) = (number / cells, number % cells);
        let mut settings = RunSettings::default();
        let refused = |key: &str| {
            let key = key.to_owned();
            move |why| super::plan::refusal(format!("run {number}: {key}"), why)
        };
        for (key, value) in self.plan.fixed.iter() {
            settings.set(key, value).map_err(refused(key))?;
        }
        let mut values: Vec<SettingValue> = Vec::new();
        let crossed = self.cell_values(cell);
        for (key, value) in self.plan.cross.keys().zip(crossed) {
            settings.set(key, value).map_err(refused(key))?;
            values.push(value.clone());
        }
        for (index, (key, distribution)) in self.plan.draw.iter().enumerate() {
            let drawn = distribution.at(self.unit(draw, index));
            let flown = settings.set_drawn(key, drawn).map_err(refused(key))?;
            values.push(flown);
        }
        let missions = &self.plan.missions;
        let named = settings
            .mission
            .as_ref()
            .and_then(|name| missions.get(name));
        let mission = named.map(|own| own.along(settings.route.as_deref()));
        Ok(StudyRun {
            mission,
            number,
            draw,
            cell,
            settings,
            values,
            seeds: Seeds::new(self.random, draw),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn design(more: &str) -> StudyDesign {
        let plan = format!(
            r#"
            name = "test"
            question = "?"
            seed = 5
            draws = 64
            {more}
            cross.vehicle = ["airplane-wind", "airplane-full"]
            cross.bias-heading = [0, 1, 2]
            draw.wind-speed = {{ uniform = [0, 8] }}
            draw.wind-from = {{ uniform = [0, 360] }}
            measure = [{{ of = "error-rms" }}]
            "#
        );
        StudyDesign::new(StudyPlan::read(&plan).unwrap())
    }

    #[test]
    fn cells_of_a_draw_differ_by_what_is_crossed_and_share_what_is_drawn() {
        let design = design("");
        let runs: Vec<StudyRun> = (12..18).map(|n| design.run(n).unwrap()).collect();
        for run in &runs {
            assert_eq!(
                (run.draw, run.values[2..].to_vec()),
                (2, runs[0].values[2..].to_vec())
            );
            assert_eq!(run.seeds, runs[0].seeds);
        }
        let mut cells: Vec<String> = runs
            .iter()
            .map(|run| format!("{} {}", run.values[0], run.values[1]))
            .collect();
        assert_eq!(cells[1], "0 airplane-full");
        cells.sort_unstable();
        cells.dedup();
        assert_eq!(cells.len(), 6);
        let other = design.run(18).unwrap();
        assert_ne!(other.values[2..], runs[0].values[2..]);
        assert_ne!(
            other.seeds.of(Stream::Flight),
            runs[0].seeds.of(Stream::Flight)
        );
        assert_ne!(other.seeds.of(Stream::Flight), other.seeds.of(Stream::Walk));
    }

    #[test]
    fn each_scramble_spreads_its_draws_evenly_over_every_drawn_setting() {
        let design = design("draw_by = \"sobol\"\nscrambles = 8");
        for scramble in 0..8 {
            let mut eighths: Vec<u64> = (0..64)
                .filter(|draw| design.cluster(*draw) == scramble)
                .map(|draw| {
                    let run = design.run(draw * 6).unwrap();
                    run.settings.wind_speed.unwrap() as u64
                })
                .collect();
            eighths.sort_unstable();
            assert_eq!(eighths, [0, 1, 2, 3, 4, 5, 6, 7]);
        }
    }

    #[test]
    fn rows_have_the_settings_that_are_flown() {
        let plan = StudyPlan::read(
            r#"
            name = "tails"
            question = "?"
            draws = 40
            draw.noise-heading = { normal = [0, 2] }
            draw.wind-speed = { normal = [14, 3] }
            measure = [{ of = "error-rms" }]
            "#,
        );
        let design = StudyDesign::new(plan.unwrap());
        let (mut calm, mut strongest) = (0, 0);
        for number in 0..40 {
            let run = design.run(number).unwrap();
            let noise = run.settings.sensors.heading.noise.to_degrees();
            let wind = run.settings.wind_speed.unwrap();
            for (value, flown) in run.values.iter().zip([noise, wind]) {
                let SettingValue::Number(value) = value else {
                    panic!("{value} is no number");
                };
                assert!((value - flown).abs() < 1e-9, "{value} {flown}");
            }
            calm += u32::from(noise == 0.0);
            strongest += u32::from(wind == 14.0);
        }
        assert!(calm > 10 && strongest > 10, "{calm} {strongest}");
    }
}
