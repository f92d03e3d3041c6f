//! A detector trained for each landmark of a mission, a landmark in a piece.

use std::path::PathBuf;

use pilotage_core::flight::FrameSource as _;
use pilotage_core::landmark::{DetectorChoice, Landmark};
use pilotage_core::mission::{FrameLabels, write_mission};
use pilotage_core::plan::Proposal;
use pilotage_core::training::TrainingPlan;
use pilotage_jobs::{FlownCamera, JobEvent, LabelledFrames, TrainOrder};
use serde::{Deserialize, Serialize};

use super::named_file::NamedFile;
use super::piecework::{Piecework, PieceworkOutcome, order_each};
use super::plan::MapWorkPlan;
use crate::notes::told_ground;
use crate::plan::PlannedFlight;
use crate::train::{keep, labelled_flight};
use crate::workers::Lent;

/// A detector that was trained, and how it did. The time that it took is left out: it is another each time.
#[derive(Serialize, Deserialize)]
struct Trained {
    detector: String,
    judged: usize,
    found: usize,
    false_alarms: usize,
    sigmas: [f64; 2],
}

/// Piece that a landmark came to.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum TrainedPiece {
    /// A detector.
    Trained(Trained),
    /// None, whoever trains it.
    Untrainable {
        /// Why, in words.
        untrainable: String,
    },
}

/// The detectors to be trained.
pub struct TrainedDetectors {
    ground: PlannedFlight,
    lent: Lent,
    landmarks: Vec<Landmark>,
    plan: TrainingPlan,
    labelled: Option<LabelledFrames>,
}

impl TrainedDetectors {
    /// Those of the landmarks of a plan's mission that have none, or of all that are switched on.
    pub fn open(plan: &MapWorkPlan) -> Result<Self, Box<dyn std::error::Error>> {
        let ground = told_ground(PlannedFlight::at(&plan.source())?);
        let landmarks: Vec<Landmark> = TrainOrder::wanted(&ground.mission).cloned().collect();
        if landmarks.is_empty() {
            return Err("the mission has no landmark that is switched on".into());
        }
        let mut lent = ground.lent();
        let labelled = labelled_flight(plan.flight.as_ref(), &ground)?.map(|folder| {
            lent = lent.clone().with_flight(&folder);
            LabelledFrames {
                flight: Lent::flight(),
                camera: FlownCamera::of(&ground.mission),
                labels: ground.mission.labels.clone(),
            }
        });
        Ok(Self {
            plan: TrainingPlan {
                seed: plan.seed,
                ..TrainOrder::usual_plan(&ground.mission, plan.photos)
            },
            ground,
            lent,
            landmarks,
            labelled,
        })
    }
}

impl Piecework for TrainedDetectors {
    fn pieces(&self) -> u64 {
        self.landmarks.len() as u64
    }

    fn read(&self) -> &[PathBuf] {
        &self.ground.read
    }

    fn pictures(&self) -> Result<Vec<NamedFile>, String> {
        let Some(labelled) = &self.labelled else {
            return Ok(Vec::new());
        };
        let mut worker = self.lent.worker();
        let open = worker.flight(&labelled.flight)?;
        let mut open = open.borrow_mut();
        let names: Vec<String> = (open.flight.frames.iter())
            .map(|frame| frame.name.clone())
            .collect();
        let flight = open.flight.identity();
        let is_labelled =
            |name: &str| FrameLabels::place_among(&labelled.labels, &flight, name).is_some();
        let pictures = names
            .iter()
            .enumerate()
            .filter(|(_, name)| is_labelled(name));
        let pictures = pictures.map(|(index, name)| {
            let bytes = open.frames.encoded(index).map_err(|why| why.to_string())?;
            Ok(NamedFile::of(name, &bytes))
        });
        pictures.collect()
    }

    fn carry_out(
        &self,
        wanted: &[u64],
        threads: usize,
        keep: &mut dyn FnMut(u64, Vec<u8>) -> Result<(), String>,
    ) -> Result<(), String> {
        let with = self.ground.circumstances(Proposal::POSITION);
        let order = |piece: u64| {
            let landmark = &self.landmarks[piece as usize];
            let order = with.training(landmark, self.plan.clone(), self.labelled.clone());
            let envelope = order.envelope();
            order.within(envelope)
        };
        let of = |event: JobEvent| match event {
            JobEvent::Trained(outcome) => {
                let trained = Trained {
                    detector: outcome.detector,
                    judged: outcome.judged,
                    found: outcome.found,
                    false_alarms: outcome.false_alarms,
                    sigmas: outcome.sigmas,
                };
                Some(TrainedPiece::Trained(trained))
            }
            // It is an outcome as well: the others do not wait for one that there cannot be.
            JobEvent::Untrainable(untrainable) => Some(TrainedPiece::Untrainable { untrainable }),
            _ => None,
        };
        let of = move |event: JobEvent| {
            let piece = of(event)?;
            Some(serde_json::to_vec(&piece).map_err(|why| why.to_string()))
        };
        order_each(wanted, (&order, &of), (threads, &self.lent), keep)
    }

    fn conclude(
        &self,
        pieces: Vec<Vec<u8>>,
    ) -> Result<PieceworkOutcome, Box<dyn std::error::Error>> {
        let mut mission = self.ground.mission.clone();
        let (mut words, mut count) = (String::new(), 0);
        for (landmark, piece) in self.landmarks.iter().zip(pieces) {
            let trained = match serde_json::from_slice(&piece)? {
                TrainedPiece::Trained(trained) => trained,
                TrainedPiece::Untrainable { untrainable } => {
                    words += &["not trained: ", &untrainable, "\n"].concat();
                    continue;
                }
            };
            count += 1;
            let [north, east] = trained.sigmas;
            let line = format!(
                "{}: found in {} of {} held-out photos, {} false alarms, ± {north:.2} m north, {east:.2} m east\n",
                landmark.name, trained.found, trained.judged, trained.false_alarms
            );
            words.push_str(&line);
            let kept = mission.landmarks.iter_mut().find(|l| l.id == landmark.id);
            let changed = kept.and_then(|it| keep(it, &trained.detector, DetectorChoice::Cascade));
            words.extend(changed.map(|changed| format!("  {changed}\n")));
        }
        if count == 0 {
            return Err(format!("no detector could be trained\n{}", words.trim_end()).into());
        }
        Ok(PieceworkOutcome {
            name: "mission.geojson",
            bytes: write_mission(&mission).into_bytes(),
            words,
        })
    }
}
