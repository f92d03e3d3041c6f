//! The missions that a plan names.

use pilotage_core::mission::Mission;
use pilotage_core::navigator::ChosenAid;

use super::plan::{StudyError, StudyPlan, refusal};
use super::run_settings::{LONGEST, RunSettings};
use super::study_mission::{PlanMission, StudyMission};
use super::value::{SettingDistribution, SettingValue};

/// Settings of missions.
const MISSION: &str = "mission";
const ROUTE: &str = "route";

impl StudyPlan {
    /// Takes the missions that it names and has not.
    pub(crate) fn take_missions(
        &mut self,
        find: &mut dyn FnMut(&str) -> Result<Mission, String>,
    ) -> Result<(), StudyError> {
        for name in self.values_of(MISSION) {
            if self.missions.get(&name).is_none() {
                let mission = find(&name).map_err(|why| refusal(MISSION, why))?;
                self.missions.add(name, PlanMission::of(&mission));
            }
        }
        Ok(())
    }

    /// Sentences on what may surprise of its missions.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (name, text) in self.missions.iter() {
            let Ok(mission) = text.read() else { continue };
            if mission.landmarks.is_empty() {
                notes.push(format!(
                    "{name} has no landmark that is switched on: it is flown by dead reckoning alone"
                ));
            }
            if mission.camera.is_none() {
                notes.push(format!(
                    "{name} states no camera: that of the built-in scenarios is taken"
                ));
            }
            notes.extend(self.notes_on_aids(name, &mission));
            notes.extend(self.notes_on_time(name, text));
        }
        notes
    }

    /// Sentences on the aids of a mission, where the plan names none itself: those that it flies by, and those that are left
    /// out.
    fn notes_on_aids(&self, name: &str, mission: &Mission) -> Vec<String> {
        if self.sets("aids") {
            return Vec::new();
        }
        let aids = mission.navigator.aids.iter();
        let (flown, left): (Vec<_>, Vec<_>) = aids.partition(|aid| RunSettings::reads(aid));
        let told = |aids: Vec<&ChosenAid>, words: &str| {
            let keys: Vec<&str> = aids.iter().map(|aid| aid.key.as_str()).collect();
            let keys = Some(keys.join(", ")).filter(|keys| !keys.is_empty());
            keys.map(|keys| format!("{name} {words}: {keys}"))
        };
        let flown = told(
            flown,
            "is navigated by its own aids too, unless the plan says aids = \"none\"",
        );
        let left = told(
            left,
            "switches on aids that look at pictures or heights, which studies do not have; they are left out",
        );
        flown.into_iter().chain(left).collect()
    }

    /// Sentences on the routes of a mission that take longer than can be flown, where the plan says no time itself.
    fn notes_on_time(&self, name: &str, mission: &PlanMission) -> Vec<String> {
        if self.sets("seconds") {
            return Vec::new();
        }
        let named = self.values_of(ROUTE);
        let routes = named.iter().map(|route| Some(route.as_str()));
        let first = named.is_empty().then_some(None);
        let note = |route: Option<&str>| {
            let lasts = mission.along(route).lasts;
            let which = route.map_or("first route".to_owned(), |route| {
                format!("route \"{route}\"")
            });
            (lasts.is_finite() && lasts > LONGEST).then(|| {
                format!(
                    "the {which} of {name} takes {:.0} min in calm air: its first {:.0} min are flown, and the rest is left out",
                    lasts / 60.0,
                    LONGEST / 60.0
                )
            })
        };
        routes.chain(first).filter_map(note).collect()
    }

    /// Whether it says a setting in any way.
    fn sets(&self, key: &str) -> bool {
        self.fixed.get(key).is_some()
            || self.cross.get(key).is_some()
            || self.draw.get(key).is_some()
    }

    /// All values that a setting may have, as text.
    pub(crate) fn values_of(&self, key: &str) -> Vec<String> {
        let drawn = match self.draw.get(key) {
            Some(SettingDistribution::Choice(values)) => &values[..],
            _ => &[],
        };
        let crossed = self.cross.get(key).map_or(&[][..], Vec::as_slice);
        let values = self.fixed.get(key).into_iter().chain(crossed).chain(drawn);
        values.map(SettingValue::to_string).collect()
    }

    /// Every route of every mission is tried.
    pub(crate) fn check_missions(&self) -> Result<(), StudyError> {
        let missions = self.values_of(MISSION);
        let routes = self.values_of(ROUTE);
        if missions.is_empty() {
            return match routes.first() {
                Some(_) => Err(refusal(ROUTE, "say the mission that has it")),
                None => Ok(()),
            };
        }
        if !self.values_of("scenario").is_empty() {
            return Err(refusal(MISSION, "fly missions or scenarios, not both"));
        }
        for name in missions {
            let refused = |why: String| refusal(MISSION, format!("{name}: {why}"));
            let Some(text) = self.missions.get(&name) else {
                return Err(refused("it is not in the plan".to_owned()));
            };
            let mission = text.read().map_err(refused)?;
            let named = routes.iter().map(|route| Some(route.as_str()));
            let first = routes.is_empty().then_some(None);
            for route in named.chain(first) {
                StudyMission::along(&mission, route, None).map_err(refused)?;
            }
        }
        Ok(())
    }
}
