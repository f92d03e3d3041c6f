//! The georeferencer as a feature: it has the window and the map for itself while a picture is open.

use egui::Ui;
use pilotage_jobs::{FlightSource, JobEvent, JobId, OpenedFiles};
use serde_json::Value;

use super::work::GeoreferencerFeature;
use super::{GeoreferenceCommand, ID};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, OpenedSet,
};
use crate::map::MapTool;
use crate::state_json::object;
use crate::views::CameraView;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Georeference picture",
    place: FeaturePlace::BesideMap,
    commands: Vec::new,
};

impl Feature for GeoreferencerFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<GeoreferenceCommand>() else {
            return false;
        };
        match command {
            GeoreferenceCommand::Close => self.close(context),
            GeoreferenceCommand::Load => context.host.ask_for_files(),
            GeoreferenceCommand::SavePoints => self.save_points(context),
            GeoreferenceCommand::SaveWorldFile => self.save_world_file(context),
            GeoreferenceCommand::UseAsMap => self.use_as_map(context),
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        if let Some(picture) = &mut self.picture {
            picture.panel(ui, context.tokens, context.units, context.commands);
        }
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        self.waits_for(job) && self.take(job, event, context)
    }

    /// Gives its place to another flight; a picture that came with the flight, or has points already, stays.
    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        let is_idle = self.picture.as_ref().is_some_and(|picture| {
            let came = FlightSource::Files(picture.key.clone());
            picture.points.is_empty() && context.documents.flight.source != came
        });
        if is_idle {
            self.close(context);
        }
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        self.ask_for_tiles(context);
    }

    /// Takes back and makes again what was done to the points.
    fn intercept(&mut self, command: &Command, _context: &mut FeatureContext<'_>) -> bool {
        let Some(picture) = &mut self.picture else {
            return false;
        };
        match command {
            Command::Undo => picture.undo(),
            Command::Redo => picture.redo(),
            _ => return false,
        }
        true
    }

    fn tool(&mut self) -> Option<&mut dyn MapTool> {
        let picture = self.picture.as_mut()?;
        Some(picture)
    }

    fn used_files(&self) -> Vec<&str> {
        let picture = self.picture.iter();
        picture.map(|picture| picture.key.as_str()).collect()
    }

    fn take_files(&mut self, set: &OpenedSet, context: &mut FeatureContext<'_>) -> bool {
        self.load(set, context)
    }

    fn take_first(
        &mut self,
        set: &OpenedSet,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let unplaced = opened.unplaced.take();
        let is_mine = unplaced.is_some();
        if let Some(unplaced) = unplaced {
            self.begin(set, unplaced, context);
        }
        is_mine
    }

    fn takes_window(&self) -> bool {
        self.picture.is_some()
    }

    fn window(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        _documents: &Documents,
        _camera: &mut CameraView,
    ) {
        if let Some(picture) = &mut self.picture {
            picture.show_picture(ui, context.tokens);
        }
    }

    fn state(&self, _documents: &Documents) -> Value {
        let Some(it) = &self.picture else {
            return Value::Null;
        };
        let fit = it.fitted().as_ref().ok();
        let rect = it.canvas.rect();
        let center = it.canvas.camera.center;
        object!({
            "name": it.name,
            "size": it.size.map(|(w, h)| [w, h]),
            "points": it.points.len(),
            "on": it.points.iter().filter(|p| p.enabled).count(),
            "pending": [it.pending.pixel.is_some(), it.pending.place.is_some()],
            "picture": rect.map(|r| [r.left(), r.top(), r.right(), r.bottom()]),
            "picture_center": [center.east, -center.north],
            "pixels_per_point": it.canvas.camera.metres_per_point,
            "rms_pixels": fit.map(|f| f.rms_in_pixels),
            "rms_metres": fit.map(|f| f.rms_in_plane),
            "rms_left_out": fit.and_then(|f| f.rms_left_out),
            "places": it.places.len(),
            "epsg": it.system.and_then(|s| s.epsg()),
        })
    }
}
