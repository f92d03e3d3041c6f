//! Measuring as a feature.

use egui::{Key, Rect, Ui};
use pilotage_core::frames::LocalFrame;
use serde_json::Value;

use super::line::{Line, LineStage};
use super::{ID, Measure, MeasureCommand};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::map::{MapButton, MapTool};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, shift};
use crate::shell::icons::Icon;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Measure",
    place: FeaturePlace::Nowhere,
    commands,
};

const LABEL: &str = "Measure distance and area";

fn commands() -> Vec<CommandEntry> {
    let toggle = MeasureCommand::Toggle.into();
    let keys = vec![shift(Key::U)];
    let entry = entry(CommandGroup::View, LABEL, keys, toggle);
    vec![
        entry
            .also("ruler length course bearing")
            .under(BarMenu::View),
    ]
}

impl Feature for Measure {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action() else {
            return false;
        };
        match command {
            MeasureCommand::Toggle => {
                let is_on = !self.is_on;
                *self = Self {
                    is_on,
                    ..Self::default()
                };
                if is_on {
                    // A drag over a selected landmark would move that.
                    *context.selection = None;
                    context.take_map();
                }
            }
            MeasureCommand::Close => self.line.close(),
            MeasureCommand::Clear => self.line = Line::default(),
            MeasureCommand::Copy => {
                let rows = self.line.measures(self.frame.as_ref()).rows(self.units);
                context.egui.copy_text(rows.join("\n"));
            }
        }
        true
    }

    /// Takes the last point of its line back.
    fn intercept(&mut self, command: &Command, _context: &mut FeatureContext<'_>) -> bool {
        *command == Command::Undo && self.is_on && self.line.take_back()
    }

    fn leave_map(&mut self, _context: &mut FeatureContext<'_>) {
        self.is_on = false;
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        let frame = context.documents.world_origin().map(LocalFrame::new);
        if frame != self.frame {
            // Points of another world lie elsewhere in this one.
            self.line = Line::default();
        }
        (self.frame, self.units) = (frame, context.view.units);
    }

    fn tool(&mut self) -> Option<&mut dyn MapTool> {
        if self.is_on { Some(self) } else { None }
    }

    fn over_map(&self, ui: &mut Ui, rect: Rect, context: &mut ViewContext<'_>) -> Vec<Rect> {
        let card = self.is_on.then(|| self.card(ui, rect, context));
        card.into_iter().collect()
    }

    fn is_open_over(&self) -> bool {
        self.is_on
    }

    fn map_button(&self) -> Option<MapButton> {
        Some(MapButton {
            icon: Icon::Ruler,
            label: LABEL,
            command: MeasureCommand::Toggle.into(),
            is_on: self.is_on,
        })
    }

    fn needs_no_advice(&self) -> bool {
        self.is_on
    }

    fn state(&self, _documents: &Documents) -> Value {
        if !self.is_on {
            return Value::Null;
        }
        let measures = self.line.measures(self.frame.as_ref());
        let legs = measures.legs.iter();
        let legs: Vec<[f64; 2]> = legs.map(|it| [it.length, it.course.to_degrees()]).collect();
        let points = self.line.points.iter();
        object!({
            "points": points.map(|p| [p.north, p.east]).collect::<Vec<_>>(),
            "drawing": self.line.stage == LineStage::Drawing,
            "closed": self.line.stage == LineStage::Closed,
            "legs": legs,
            "length": measures.length,
            "area": measures.area,
        })
    }
}
