//! The app's state in words and as JSON, for screen readers and for journeys in the browser.

use crate::state_json::{object, object_of};
use egui::Rect;
use pilotage_core::imagery::terrain::Terrain as _;
use pilotage_core::navigator::{RegistrationReport, Run};
use serde_json::{Value, json};

use super::dialogs::Dialogs;
use super::side_tab::SideTab;
use super::views::Views;
use crate::context::DrawnTimes;
use crate::documents::{Documents, ViewState};
use crate::feature::examined;
use crate::shell::Toasts;
use crate::timeline::Playback;
use crate::units::clock;
use crate::views::inspector::sentence::placed_by;

fn rect_json(rect: Option<Rect>) -> Value {
    rect.map_or(Value::Null, |r| {
        json!([r.left(), r.top(), r.right(), r.bottom()])
    })
}

fn drawn_json(drawn: Option<DrawnTimes>) -> Value {
    drawn.map_or(
        Value::Null,
        |d| object!({"cursor": d.cursor, "content": d.content}),
    )
}

/// Parts of the app of which its state tells.
pub struct Report<'a> {
    /// Documents that are open.
    pub documents: &'a Documents,
    /// Time cursor.
    pub playback: &'a Playback,
    /// View state that is remembered between visits.
    pub view: &'a ViewState,
    /// Selected landmark.
    pub selection: Option<u32>,
    /// Tab that is open.
    pub side_tab: SideTab,
    /// Open state of the dialogs.
    pub dialogs: &'a Dialogs,
    /// Notices.
    pub toasts: &'a Toasts,
    /// Views and features.
    pub views: &'a Views,
    /// Progress of the computation under way, 0 to 1, and its words.
    pub job: Option<(f32, &'a str)>,
    /// Whether keys and clicks wait for the next frame.
    pub input_waits: bool,
}

impl Report<'_> {
    /// State of the screen, as JSON. Places on screen are in points; times in seconds; boxes in metres.
    pub fn state_json(&self) -> String {
        let mut all = self.documents_json();
        let features = self.views.features.iter();
        let features = features.map(|it| (it.info().id.to_owned(), it.state(self.documents)));
        let features = Value::Object(features.collect());
        for part in [self.run_json(), self.view_json(), features] {
            if let (Value::Object(all), Value::Object(part)) = (&mut all, part) {
                all.extend(part);
            }
        }
        all.to_string()
    }

    fn documents_json(&self) -> Value {
        let documents = self.documents;
        let landmarks: Vec<Value> = documents
            .mission
            .landmarks
            .iter()
            .map(|l| {
                object!({
                    "id": l.id,
                    "name": l.name,
                    "enabled": l.enabled,
                    "category": l.category(),
                    "detector": l.detector_choice().key(),
                    "trained": l.is_trained(),
                    "notes": l.notes(),
                    "height": l.height,
                    "orientation": l.orientation().map(f64::to_degrees),
                    "outline": l.outline().map(|o| o.iter().map(|p| [p.north, p.east]).collect::<Vec<_>>()),
                    "point": l.is_point(),
                    "reference": [l.reference.north, l.reference.east],
                    "south": l.bounds.south,
                    "north": l.bounds.north,
                    "west": l.bounds.west,
                    "east": l.bounds.east,
                })
            })
            .collect();
        let navigator = &documents.mission.navigator;
        let found = examined(&self.views.features, self.selection, documents).found;
        object!({
            "title": documents.title(),
            "origin": documents.world_origin().map(|o| {
                [o.latitude.to_degrees(), o.longitude.to_degrees()]
            }),
            "labels": documents.mission.labels.iter().map(|l| object!({
                "frame": l.frame,
                "boxes": l.boxes.iter().map(|b| json!([b.name, b.min, b.max])).collect::<Vec<_>>(),
                "absent": l.absent,
            })).collect::<Vec<_>>(),
            "terrain": documents.map.terrain.heights().map(|grid| {
                let center = grid.height_at(&self.views.map.camera.center);
                object!({
                    "name": grid.name(),
                    "datum": grid.datum().name(),
                    "spacing": grid.spacing(),
                    "extremes": grid.extremes().map(|(low, high)| [low, high]),
                    "center": center,
                })
            }),
            "flight": documents.flight.measured.as_ref().map(|f| f.name.clone()),
            "frames": documents.flight.measured.as_ref().map_or(0, |f| f.frames.len()),
            "pictures": documents.flight.pictures.count(),
            "bookmarks": documents.flight.bookmarks,
            "landmarks": landmarks,
            "selection": self.selection,
            "distinctness": found.map(|d| d.verdict.clone()),
            "undo": documents.mission.history.depth().0,
            "redo": documents.mission.history.depth().1,
            "navigator": object!({
                "alpha": navigator.alpha,
                "gate_confidence": navigator.gate_confidence,
                "redraw": navigator.redraw,
            }),
        })
    }

    fn run_json(&self) -> Value {
        let documents = self.documents;
        let run = documents.run.navigated.as_ref();
        let step = run.and_then(|r| r.step_at(self.playback.time));
        let frames = || {
            run.into_iter()
                .flat_map(|r| &r.steps)
                .filter_map(|s| s.frame.as_ref())
        };
        object!({
            "job": self.job.map(|(f, w)| object!({"progress": f, "words": w})),
            "run_steps": run.map_or(0, |r| r.steps.len()),
            "run_complete": documents.run.is_complete,
            "run_generation": documents.run.generation,
            "run_landmarks": run.map_or(0, |r| r.landmarks.iter().filter(|l| l.enabled).count()),
            "accepted": frames().map(|f| f.accepted().count()).sum::<usize>(),
            "laid": frames().filter(|f| f.laid.as_ref().is_some_and(RegistrationReport::is_believed)).count(),
            "candidates": frames().map(|f| f.candidates.len()).sum::<usize>(),
            "ghost_steps": documents.run.ghost.as_ref().map_or(0, |r| r.steps.len()),
            "step": step.map(|s| object!({
                "time": s.time,
                "north": s.after.position().north,
                "east": s.after.position().east,
                "frame": s.frame.as_ref().map(|f| f.index),
            })),
        })
    }

    fn view_json(&self) -> Value {
        let toasts: Vec<Value> = self
            .toasts
            .list()
            .iter()
            .map(|t| object!({"title": t.title, "text": t.text, "trouble": t.trouble}))
            .collect();
        let map = &self.views.map;
        object!({
            "time": self.playback.time,
            "span": self.documents.span().map(|(a, b)| [a, b]),
            "selected": self.playback.selected_span.map(|(a, b)| [a, b]),
            "playing": self.playback.playing,
            "speed": self.playback.speed,
            "loop": self.playback.looping,
            "workspace": self.view.workspace.label(),
            "side_tab": self.side_tab.name(),
            "dark": self.view.dark,
            "units": format!("{:?}", self.view.units),
            "toasts": toasts,
            "input_waits": self.input_waits,
            "dialogs": object!({
                "palette": self.dialogs.palette.is_open(),
                "help": self.dialogs.help,
                "notices": self.dialogs.notices,
                "settings": self.dialogs.settings,
            }),
            "map": object!({
                "rect": rect_json(map.rect()),
                "center": [map.camera.center.north, map.camera.center.east],
                "metres_per_point": map.camera.metres_per_point,
                "up": map.camera.up,
                "picking": map.picking,
                "middle": map.marks_middle(),
                "follow": map.follow,
                "track_up": map.track_up,
                "tiles": map.tiles.count(),
                "ground": map.tiles.has_ground(),
                "tiles_wanted": map.tiles.wanted().len(),
                "known": self.documents.map.info.is_some(),
                "whole": map.tiles.is_whole(),
                "attribution": self.documents.map.attribution(),
                "name": self.documents.map.info.as_ref().map(|m| m.name.clone()),
                "gsd": self.documents.map.info.as_ref().map(|m| m.native_gsd),
                "bounds": self.documents.map.info.as_ref().map(|m| {
                    [m.bounds.south, m.bounds.west, m.bounds.north, m.bounds.east]
                }),
            }),
            "timeline": rect_json(self.views.timeline.track()),
            "drawn": self.drawn_json(),
        })
    }

    /// Times of what views and panels drew last.
    fn drawn_json(&self) -> Value {
        let views = self.views;
        let own = [
            ("map", views.map.drawn()),
            ("camera", views.camera.drawn()),
            ("plots", views.plots.drawn()),
            ("inspector", views.inspector.drawn()),
            ("timeline", views.timeline.drawn()),
        ];
        let features = views.features.iter();
        let of_features = features.filter_map(|it| Some((it.info().id, Some(it.drawn()?))));
        let all = own.into_iter().chain(of_features);
        object_of(all.map(|(id, drawn)| (id, drawn_json(drawn))).collect())
    }

    /// Summary of the screen, in a sentence or three.
    pub fn summary_text(&self) -> String {
        let documents = self.documents;
        let workspace = self.view.workspace.label();
        let mut parts = vec![format!("{workspace} workspace. {}.", documents.title())];
        if let Some((fraction, words)) = self.job {
            let percent = 100.0 * fraction;
            parts.push(format!("Computing, {percent:.0} percent: {words}."));
        }
        let owner = self.views.owner(self.view.workspace);
        parts.extend(owner.and_then(|it| it.summary(documents, self.view.units)));
        match (&documents.run.navigated, documents.span()) {
            _ if self.views.hide_flight(self.view.workspace) => {}
            (Some(run), Some(span)) => parts.push(self.run_text(run, span)),
            _ if self.job.is_some() => {}
            _ => parts.push("No run yet.".to_owned()),
        }
        if let Some((from, to)) = self.playback.selected_span {
            let length = clock(to, from);
            let begin = clock(from, documents.clock_zero());
            parts.push(format!("Selected: {length} from {begin} on."));
        }
        if let Some(landmark) = self.selection.and_then(|id| documents.mission.landmark(id)) {
            parts.push(format!("Landmark {} is selected.", landmark.name));
        }
        if let Some(toast) = self.toasts.list().last() {
            parts.push(format!("Notice: {}. {}", toast.title, toast.text));
        }
        parts.join(" ")
    }

    fn run_text(&self, run: &Run, (first, last): (f64, f64)) -> String {
        let now = self.playback.time;
        let moving = if self.playback.playing {
            "playing"
        } else {
            "paused"
        };
        let time = format!(
            "Time {} of {}, {moving}.",
            clock(now, first),
            clock(last, first)
        );
        let Some(step) = run.step_at(now) else {
            return time;
        };
        let radius = self.view.units.short(step.radius_held());
        let index = run.index_at(now).unwrap_or_default();
        let state = placed_by(run, index).map_or_else(
            || "dead reckoning".to_owned(),
            |by| format!("corrected by {by}"),
        );
        format!("{time} The aircraft is {state}, its position within {radius} (95 %).")
    }
}
