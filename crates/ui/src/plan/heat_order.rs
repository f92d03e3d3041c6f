//! Field that the heat map is to show of the plan.

use pilotage_core::plan::{FieldView, Localizability, PlannedLandmark};
use serde_json::{Value, json};

use super::flown::flown_height;
use super::heat::BLIND;
use super::heat_command::HeatCommand;
use super::planner::Planner;
use crate::documents::Documents;
use pilotage_jobs::{FieldOrder, FixesFrom, PlanCircumstances};

impl Planner {
    /// The ground, the camera at a height above it, metres, and what gives fixes, for the heat map or a
    /// search; `None` without a map.
    pub fn field_order(
        &self,
        documents: &Documents,
        of: FixesFrom,
        height: f64,
    ) -> Option<FieldOrder> {
        let with = PlanCircumstances {
            height,
            ..self.planned_with(documents)
        };
        let region = documents.map.info.as_ref()?.bounds;
        let enabled = documents.mission.landmarks.iter().filter(|l| l.enabled);
        let planned = enabled.map(|landmark| PlannedLandmark {
            landmark: landmark.clone(),
            detection: self.expected(landmark),
        });
        Some(with.field(of, region, planned))
    }

    /// Camera's view of the ground from a height above it, metres, and the uncertainty of the position then.
    pub fn field_view(&self, documents: &Documents, height: f64) -> FieldView {
        let with = PlanCircumstances {
            height,
            ..self.planned_with(documents)
        };
        with.view()
    }

    /// Field that the heat map is to show; `None` while it is hidden.
    pub fn heat_order(&self, documents: &Documents) -> Option<FieldOrder> {
        let heat = &self.preferences.heat;
        if heat.shown {
            self.field_order(documents, heat.of, flown_height(documents))
        } else {
            None
        }
    }

    /// Carries a command out.
    pub fn heat_command(&mut self, command: HeatCommand) {
        let heat = &mut self.preferences.heat;
        match command {
            HeatCommand::Toggle => heat.shown = !heat.shown,
            HeatCommand::ToggleBlind => {
                // Whoever asks for blind areas wants to see them.
                heat.blind = !heat.blind || !heat.shown;
                heat.shown = true;
            }
            HeatCommand::Set(preferences) => *heat = preferences,
            HeatCommand::Stop => self.heat.stop(true),
            HeatCommand::Resume => self.heat.stop(false),
        }
    }

    /// The heat map for journeys.
    pub fn heat_json(&self) -> Value {
        let heat = &self.preferences.heat;
        let field = self.heat.field();
        json!({
            "shown": heat.shown,
            "blind": heat.blind,
            "known": field.map(Localizability::known),
            "blind_share": field.and_then(|f| f.blind_share(BLIND)),
            "complete": self.heat.is_complete(),
            "progress": self.heat.under_way().map(|(share, _)| share),
            "trouble": self.heat.trouble(),
        })
    }
}
