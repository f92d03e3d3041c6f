//! Landmarks proposed for a mission, a share of the places in a piece.

use std::path::PathBuf;

use pilotage_core::mission::write_mission;
use pilotage_core::plan::LandmarkCandidate;
use pilotage_jobs::{JobEvent, Share, ShareOrder, SuggestOrder};

use super::piecework::{Piecework, PieceworkOutcome, order_each};
use super::plan::MapWorkPlan;
use crate::notes::told_ground;
use crate::plan::PlannedFlight;
use crate::plan::propose::{choose, list, proposal};

/// Shares in which places are rehearsed.
const SHARES: usize = 16;

/// The landmarks to be proposed.
pub struct ProposedLandmarks {
    ground: PlannedFlight,
    order: SuggestOrder,
}

impl ProposedLandmarks {
    /// Those that a plan asks for.
    pub fn open(plan: &MapWorkPlan) -> Result<Self, Box<dyn std::error::Error>> {
        let ground = told_ground(PlannedFlight::at(&plan.source())?);
        let order = SuggestOrder {
            side: plan.side,
            seed: plan.seed,
            ..proposal(&ground, plan.position, plan.count)
        };
        Ok(Self { ground, order })
    }
}

impl Piecework for ProposedLandmarks {
    fn pieces(&self) -> u64 {
        SHARES as u64
    }

    fn read(&self) -> &[PathBuf] {
        &self.ground.read
    }

    fn carry_out(
        &self,
        wanted: &[u64],
        threads: usize,
        keep: &mut dyn FnMut(u64, Vec<u8>) -> Result<(), String>,
    ) -> Result<(), String> {
        let order = |piece: u64| {
            let share = Share {
                part: piece as usize,
                of: SHARES,
            };
            ShareOrder(Box::new(self.order.clone()), share)
        };
        let of = |event: JobEvent| match event {
            JobEvent::Candidates(_, found) => {
                Some(serde_json::to_vec(&found).map_err(|why| why.to_string()))
            }
            _ => None,
        };
        let lent = self.ground.lent();
        order_each(wanted, (&order, &of), (threads, &lent), keep)
    }

    fn conclude(
        &self,
        pieces: Vec<Vec<u8>>,
    ) -> Result<PieceworkOutcome, Box<dyn std::error::Error>> {
        let mut found: Vec<LandmarkCandidate> = Vec::new();
        for piece in pieces {
            found.extend(serde_json::from_slice::<Vec<LandmarkCandidate>>(&piece)?);
        }
        let places = found.len();
        let chosen = choose(Box::new(self.order.clone()), found, &self.ground.lent())?;
        let mut mission = self.ground.mission.clone();
        let free = mission.free_landmark_id();
        let proposed = chosen.iter().zip(free..);
        let proposed: Vec<_> = proposed.map(|(it, id)| it.landmark(id)).collect();
        mission.landmarks.extend(proposed);
        Ok(PieceworkOutcome {
            name: "mission.geojson",
            bytes: write_mission(&mission).into_bytes(),
            words: format!("{places} places would do; chosen:\n{}", list(&chosen)),
        })
    }
}
