//! Plans of work on a map: files of TOML that say what is made of which map.

use std::path::{Path, PathBuf};

use pilotage_core::plan::Proposal;
use pilotage_core::training::TrainingPlan;
use serde::{Deserialize, Serialize};

use crate::plan::PlanSource;

/// Thing that is made of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MapWorkKind {
    /// Table of generic landmarks, as by `pilotage reference-map`.
    ReferenceTable,
    /// Proposed landmarks, as by `pilotage plan --suggest`.
    Suggestions,
    /// A detector for each landmark, as by `pilotage train`.
    Detectors,
}

/// Plan of work on a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapWorkPlan {
    /// Name, by which its folder is called.
    pub name: String,
    /// Thing that is made.
    pub work: MapWorkKind,
    /// The map; of a mission that holds its own it may be left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<PathBuf>,
    /// The mission, of suggestions and detectors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mission: Option<PathBuf>,
    /// A built-in scenario in place of map and mission.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scenario: Option<String>,
    /// Flight folder whose camera is flown, if the mission states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flight: Option<PathBuf>,
    /// Height above ground, metres, in place of that of the route.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// Number of landmarks to propose.
    #[serde(default = "usual_count")]
    pub count: usize,
    /// Side of their boxes, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<f64>,
    /// Standard deviation of the position per axis when they are looked for, metres.
    #[serde(default = "usual_position")]
    pub position: f64,
    /// Photos that each detector learns from.
    #[serde(default = "usual_photos")]
    pub photos: usize,
    /// Seed of days and photos.
    #[serde(default = "usual_seed")]
    pub seed: u64,
}

fn usual_count() -> usize {
    10
}

fn usual_position() -> f64 {
    Proposal::POSITION
}

fn usual_photos() -> usize {
    TrainingPlan::default().photos
}

fn usual_seed() -> u64 {
    1
}

impl MapWorkPlan {
    /// Its settings and what they are, for people.
    pub const SETTINGS: [(&'static str, &'static str); 12] = [
        ("name", "name of letters, digits and hyphens"),
        ("work", "reference-table, suggestions or detectors"),
        (
            "map",
            "the map; of a mission that holds its own it may be left out",
        ),
        ("mission", "the mission on it, of suggestions and detectors"),
        ("scenario", "a built-in scenario in place of both"),
        (
            "flight",
            "flight folder whose camera is flown, if the mission states none",
        ),
        ("height", "m above ground, in place of that of the route"),
        ("count", "landmarks to propose; 10 if not said"),
        ("side", "m, side of their boxes"),
        (
            "position",
            "m, deviation of the position per axis when they are looked for; 10 if not said",
        ),
        ("photos", "photos that each detector learns from"),
        ("seed", "seed of days and photos; 1 if not said"),
    ];

    /// The plan in a text; `None` where it is that of a study.
    ///
    /// # Errors
    /// In words, where it is a plan of such work and wrong.
    pub fn read(text: &str) -> Result<Option<Self>, String> {
        #[derive(Deserialize)]
        struct Kind {
            work: Option<String>,
        }
        let kind: Option<Kind> = basic_toml::from_str(text).ok();
        if kind.is_none_or(|kind| kind.work.is_none()) {
            return Ok(None);
        }
        let plan: Self = basic_toml::from_str(text).map_err(|why| why.to_string())?;
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-';
        if plan.name.is_empty() || !plan.name.chars().all(is_plain) {
            return Err("name: give a word of letters, digits and hyphens".to_owned());
        }
        if plan.work == MapWorkKind::ReferenceTable && plan.map.is_none() {
            return Err("map: say the map that is made into a table".to_owned());
        }
        plan.check_numbers()?;
        let has_mission = plan.mission.is_some() || plan.scenario.is_some();
        if plan.work != MapWorkKind::ReferenceTable && !has_mission {
            return Err("mission: say the mission on the map, or a scenario".to_owned());
        }
        Ok(Some(plan))
    }

    /// Refuses numbers that nothing can be made of, and that the plan in a folder could not be written with.
    fn check_numbers(&self) -> Result<(), String> {
        let lengths = [("height", self.height), ("side", self.side)];
        let is_length = |metres: f64| metres.is_finite() && metres > 0.0;
        let unsound = lengths
            .iter()
            .find(|(_, metres)| metres.is_some_and(|metres| !is_length(metres)));
        if let Some((name, _)) = unsound {
            return Err(format!("{name}: give metres above zero"));
        }
        if !(self.position.is_finite() && self.position >= 0.0) {
            return Err("position: give metres, not below zero".to_owned());
        }
        let counts = [("count", self.count), ("photos", self.photos)];
        match counts.into_iter().find(|(_, count)| *count == 0) {
            Some((name, _)) => Err(format!("{name}: give a number above zero")),
            None => Ok(()),
        }
    }

    /// The same with the files that it names beside `folder`, wherever it is read.
    ///
    /// # Errors
    /// Where a file is not there.
    pub fn beside(mut self, folder: &Path) -> Result<Self, String> {
        let files = [&mut self.map, &mut self.mission, &mut self.flight];
        for path in files.into_iter().flatten() {
            let full = folder.join(&*path);
            *path =
                std::path::absolute(&full).map_err(|why| format!("{}: {why}", full.display()))?;
            if !path.exists() {
                return Err(format!("{}: there is no such file", path.display()));
            }
        }
        Ok(self)
    }

    /// The source of its map, mission and camera.
    pub fn source(&self) -> PlanSource {
        PlanSource {
            scenario: self.scenario.clone(),
            mission: self.mission.clone(),
            map: self.map.clone(),
            flight: self.flight.clone(),
            height: self.height,
            dem: None,
        }
    }

    /// The same without places of files: equal for all who do the same work.
    pub fn without_places(&self) -> Self {
        let name = |path: &Option<PathBuf>| Some(PathBuf::from(path.as_ref()?.file_name()?));
        Self {
            map: name(&self.map),
            mission: name(&self.mission),
            flight: name(&self.flight),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_is_told_to_people() {
        let whole = MapWorkPlan {
            map: Some("a".into()),
            mission: Some("b".into()),
            scenario: Some("c".to_owned()),
            flight: Some("d".into()),
            height: Some(1.0),
            side: Some(2.0),
            ..MapWorkPlan::read("name = \"a\"\nwork = \"reference-table\"\nmap = \"m\"")
                .unwrap()
                .unwrap()
        };
        let text = basic_toml::to_string(&whole).unwrap();
        let mut keys: Vec<&str> = text
            .lines()
            .filter_map(|line| Some(line.split_once(" = ")?.0))
            .collect();
        let mut told = MapWorkPlan::SETTINGS.map(|(key, _)| key);
        keys.sort_unstable();
        told.sort_unstable();
        assert_eq!(keys, told);
    }

    #[test]
    fn a_plan_of_work_is_told_from_that_of_a_study_and_says_what_it_lacks() {
        let study = "name = \"a\"\nquestion = \"?\"\ndraws = 1\n";
        assert_eq!(MapWorkPlan::read(study), Ok(None));
        assert_eq!(MapWorkPlan::read("name = "), Ok(None));
        let read = |more: &str| MapWorkPlan::read(&format!("name = \"county\"\n{more}"));
        let plan = read("work = \"reference-table\"\nmap = \"county.tif\"")
            .unwrap()
            .unwrap();
        assert_eq!((plan.count, plan.seed, plan.position), (10, 1, 10.0));
        for (more, words) in [
            ("work = \"reference-table\"", "map: say the map"),
            (
                "work = \"suggestions\"\nmap = \"county.tif\"",
                "mission: say the mission",
            ),
            ("work = \"tables\"\nmap = \"county.tif\"", "unknown variant"),
            (
                "work = \"suggestions\"\nmission = \"m\"\nheight = inf",
                "height: give metres above zero",
            ),
            (
                "work = \"suggestions\"\nmission = \"m\"\nposition = nan",
                "position: give metres, not below zero",
            ),
            (
                "work = \"suggestions\"\nmission = \"m\"\nside = -3",
                "side: give metres above zero",
            ),
            (
                "work = \"suggestions\"\nmission = \"m\"\ncount = 0",
                "count: give a number above zero",
            ),
            (
                "work = \"detectors\"\nmission = \"m\"\nphotos = 0",
                "photos: give a number above zero",
            ),
            (
                "work = \"detectors\"\nmission = \"m\"\nphoto = 3",
                "unknown field `photo`",
            ),
        ] {
            let why = read(more).unwrap_err();
            assert!(why.contains(words), "{why}");
        }
    }
}
