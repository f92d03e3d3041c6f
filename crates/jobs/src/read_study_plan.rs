//! The plan of a study read from its text.

use pilotage_core::mission::Mission;
use pilotage_core::text::{capitalised, plain_name};
use pilotage_study::{StudyError, StudyPlan, StudyPlanParts};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Text of a plan to read, TOML: event `Figures` with a [`ReadStudyPlan`], or `Failed` with why it cannot be followed and
/// where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadStudyPlanOrder {
    /// The text.
    pub text: String,
    /// Mission that is open, which it may name.
    pub open: Option<Box<Mission>>,
}

/// A plan that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadStudyPlan {
    /// The plan.
    pub parts: StudyPlanParts,
    /// Sentences on what may surprise of its missions.
    pub notes: Vec<String>,
}

impl From<StudyPlan> for ReadStudyPlan {
    fn from(plan: StudyPlan) -> Self {
        Self {
            notes: plan.notes(),
            parts: plan.into(),
        }
    }
}

/// The open mission, if a plan that calls it `name` means it: by its own name or by that of its file.
fn meant(open: Option<&Mission>, name: &str) -> Result<Mission, String> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let is_own = |own: &str| own == name || plain_name(own) == plain_name(stem);
    match open {
        Some(mission) if is_own(&mission.name) => Ok(mission.clone()),
        Some(mission) => Err(format!(
            "“{name}” is not the mission that is open; that is called “{}”",
            mission.name
        )),
        None => Err(format!("no mission is open that could be “{name}”")),
    }
}

impl Order for ReadStudyPlanOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let open = self.open.as_deref();
            let read = StudyPlan::read_with(&self.text, &mut |name| meant(open, name));
            let plan = read.map_err(|why| match why {
                StudyError::NoPlan(_) => capitalised(&why.to_string()),
                StudyError::Plan { .. } => format!("In the plan, {why}"),
            })?;
            emit(JobEvent::of_figures(&ReadStudyPlan::from(plan))?);
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::{Altitude, AltitudeFrame, GroundPoint};
    use pilotage_core::mission::{Route, WayPoint};
    use pilotage_core::simulate::Scenario;
    use pilotage_study::SHIPPED_PLANS;

    use super::*;
    use crate::running::{figures, finished};

    #[test]
    fn a_plan_means_the_open_mission_by_its_name_or_that_of_its_file() {
        let mut mission = Scenario::named("distinct-400ft-calm").unwrap().mission();
        mission.name = "Mill: A/B".to_owned();
        mission.camera = None;
        let [one, other] = [0.0, 500.0].map(|north| {
            let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
            WayPoint::new(GroundPoint::new(north, 0.0), altitude)
        });
        mission.routes.push(Route {
            way_points: vec![one, other],
            ..Route::default()
        });
        let read = |name: &str| {
            let text = format!(
                "name = \"a\"\nquestion = \"?\"\ndraws = 2\nfixed.mission = \"{name}\"\nmeasure = [{{ of = \"error-rms\" }}]"
            );
            let open = Some(Box::new(mission.clone()));
            finished(ReadStudyPlanOrder { text, open })
        };
        for name in ["Mill: A/B", "Mill--A-B.geojson"] {
            let events = read(name);
            let read: ReadStudyPlan = events[0].read_figures().unwrap();
            assert!(
                read.notes[0].contains("states no camera"),
                "{:?}",
                read.notes
            );
            let plan = StudyPlan::from(read.parts);
            let kept = plan.missions.get(name).unwrap().read().unwrap();
            assert_eq!(
                (kept.routes.len(), kept.landmarks.len()),
                (1, mission.landmarks.len())
            );
        }
        let refused = read("Tower.geojson");
        let Some(JobEvent::Failed(why)) = refused.last() else {
            panic!("{refused:?}");
        };
        assert!(
            why.contains("Tower.geojson") && why.contains("Mill: A/B"),
            "{why}"
        );
    }

    #[test]
    fn every_plan_passes_from_the_worker_as_it_is() {
        let stops = r#"
            name = "stops"
            question = "When is it enough?"
            draws = 32
            fixed = { seconds = 20, vehicle = "airplane-wind" }
            draw.wind-speed = { normal = [4, 1] }
            draw.wind-from = { choice = [0, 90] }
            draw.step = { log-uniform = [0.1, 1] }
            measure = [{ of = "error-max", name = "within 20 m", at_most = 20 }]
            stop = { measure = "within 20 m", half_width = 0.01, every = 16 }
        "#;
        for text in SHIPPED_PLANS.into_iter().chain([stops]) {
            let plan = StudyPlan::read(text).unwrap();
            let text = text.to_owned();
            let read: ReadStudyPlan = figures(ReadStudyPlanOrder { text, open: None });
            assert!(read.notes.is_empty());
            assert_eq!(StudyPlan::from(read.parts), plan);
        }
    }
}
