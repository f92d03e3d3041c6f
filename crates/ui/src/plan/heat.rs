//! The heat map: where a fix would be had, as a worker computes it.

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use pilotage_core::plan::Localizability;

use crate::feature::FeatureContext;
use crate::views::color_map::viridis;
use pilotage_jobs::{FieldOrder, Job, JobEvent, JobId, MapSource};

/// A place where a fix is less likely than this is blind.
pub const BLIND: f64 = 0.2;
/// Time for which the plan must rest before the heat map is computed anew, milliseconds.
const REST: f64 = 300.0;

/// A heat map under way.
#[derive(Debug)]
struct AskedHeatMap {
    id: JobId,
    order: FieldOrder,
}

/// The heat map, and what is being computed of it.
#[derive(Default)]
pub struct Heat {
    field: Option<(FieldOrder, Localizability)>,
    asked: Option<AskedHeatMap>,
    progress: (f32, String),
    trouble: Option<String>,
    /// Field that was asked for last, and since when, milliseconds.
    wanted: Option<(FieldOrder, f64)>,
    complete: bool,
    stopped: bool,
    texture: Option<TextureHandle>,
    /// Style in which the texture was painted: true if only blind areas are marked; `None` if it is not of
    /// the field as it is now.
    painted: Option<bool>,
}

impl Heat {
    /// The field, as far as it is known.
    pub fn field(&self) -> Option<&Localizability> {
        self.field.as_ref().map(|(_, field)| field)
    }

    /// Order of the field that is known.
    pub fn order(&self) -> Option<&FieldOrder> {
        self.field.as_ref().map(|(order, _)| order)
    }

    /// Progress of the work, 0 to 1, and its words.
    pub fn under_way(&self) -> Option<(f32, &str)> {
        self.asked.as_ref()?;
        Some((self.progress.0, self.progress.1.as_str()))
    }

    /// Whether all of it is known.
    pub fn is_complete(&self) -> bool {
        self.complete && self.asked.is_none()
    }

    /// Whether the user stopped it.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Why there is none.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Its picture.
    pub fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// Stops or goes on at the next opportunity.
    pub fn stop(&mut self, stopped: bool) {
        self.stopped = stopped;
        self.complete &= stopped;
    }

    /// Forgets the field of another map than `map`: its places mean nothing on this one, and neither does its time.
    pub fn keep_to(&mut self, map: &MapSource, context: &mut FeatureContext<'_>) {
        let wanted = self.wanted.as_ref().map(|(wanted, _)| wanted);
        let mut orders = self.order().into_iter().chain(wanted);
        if orders.any(|order| order.map != *map) {
            self.cancel(context);
            *self = Self::default();
        }
    }

    /// Asks for what is missing; true if time must pass first.
    pub fn work(
        &mut self,
        wanted: Option<FieldOrder>,
        blind: bool,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let now = context.host.now();
        let Some(wanted) = wanted else {
            self.cancel(context);
            return false;
        };
        if self.wanted.as_ref().is_none_or(|(w, _)| *w != wanted) {
            self.wanted = Some((wanted.clone(), now));
            self.cancel(context);
            self.trouble = None;
            self.complete = false;
            self.stopped = false;
        }
        if self.stopped {
            self.cancel(context);
            self.forget_others();
        }
        self.paint(blind, context.egui);
        if self.asked.is_some() || self.complete || self.stopped || self.trouble.is_some() {
            return false;
        }
        let first = self.field.is_none();
        if !first && self.wanted.as_ref().is_some_and(|(_, at)| now - at < REST) {
            return true;
        }
        let id = context.start(Job::Field(Box::new(wanted.clone())));
        self.progress = (0.0, "Waiting for a worker".to_owned());
        self.asked = Some(AskedHeatMap { id, order: wanted });
        false
    }

    /// Forgets the field of another plan, where none of this one follows.
    fn forget_others(&mut self) {
        let wanted = self.wanted.as_ref().map(|(wanted, _)| wanted);
        if self.order() != wanted {
            (self.field, self.texture, self.painted) = (None, None, None);
        }
    }

    fn cancel(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(asked) = self.asked.take() {
            context.cancel(asked.id);
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some(asked) = self.asked.take_if(|asked| asked.id == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(fraction, words) => {
                self.progress = (*fraction, words.clone());
                self.asked = Some(asked);
            }
            JobEvent::Field(field) => {
                self.field = Some((asked.order.clone(), field.as_ref().clone()));
                self.painted = None;
                self.asked = Some(asked);
            }
            JobEvent::Finished => self.complete = true,
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.forget_others();
            }
            JobEvent::Cancelled => {}
            _ => {
                self.asked = Some(asked);
                return false;
            }
        }
        true
    }

    fn paint(&mut self, blind: bool, context: &Context) {
        if self.painted == Some(blind) {
            return;
        }
        let Some((_, field)) = &self.field else {
            return;
        };
        let pixel = |value: &f32| match value {
            v if !v.is_finite() => Color32::TRANSPARENT,
            v if blind && f64::from(*v) < BLIND => blind_color(),
            _ if blind => Color32::TRANSPARENT,
            v => viridis(*v),
        };
        let size = [field.columns, field.rows];
        let image = ColorImage::new(size, field.values.iter().map(pixel).collect());
        let options = if blind {
            TextureOptions::NEAREST
        } else {
            TextureOptions::LINEAR
        };
        self.texture = Some(context.load_texture("localizability", image, options));
        self.painted = Some(blind);
    }
}

/// Colour of a blind place.
pub fn blind_color() -> Color32 {
    Color32::from_rgb(214, 60, 90)
}
