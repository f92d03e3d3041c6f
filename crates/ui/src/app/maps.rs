//! Maps and the height of the ground: opened, shown, made ready.

use super::App;
use crate::command::Workspace;
use crate::documents::planned_ground;
use crate::documents::{OpenedTerrain, TERRAIN_KEY};
use crate::host::Host;
use pilotage_core::frames::GroundRect;
use pilotage_jobs::{
    FlightSource, HeightsOrder, Job, JobEvent, JobId, MapInfo, MapSource, PrepareMapOrder,
    TerrainInfo,
};

/// Interval at which tiles that are not whole are asked for again while the map is made ready, milliseconds.
const REFRESH: f64 = 900.0;
/// Margin around the ground of interest in which heights are taken, metres.
const HEIGHTS_AROUND: f64 = 2_000.0;
/// Farthest from each other that ground of interest may lie, metres; of a larger map only the plan
/// gets heights.
const HEIGHTS_REACH: f64 = 60_000.0;

impl App {
    pub(super) fn tile_event(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        id: JobId,
        event: JobEvent,
    ) {
        match event {
            JobEvent::Tile {
                window,
                pixels,
                whole,
            } => {
                let tiles = &mut self.views.map.tiles;
                tiles.insert(context, &window, &pixels, whole);
                if !whole {
                    self.prepare_map(host);
                }
            }
            JobEvent::Remark(text) => self.tell_of_map(host, &text),
            JobEvent::Finished | JobEvent::Cancelled => {
                self.jobs.tiles.remove(&id);
            }
            JobEvent::Failed(_) => {
                // An empty tile is not asked for again; the map stays usable without it.
                if let Some(key) = self.jobs.tiles.remove(&id) {
                    let empty = pilotage_core::raster::Raster::filled(0, 0, [0; 4]);
                    self.views
                        .map
                        .tiles
                        .insert(context, &key.window(), &empty, true);
                }
            }
            _ => {}
        }
    }

    pub(super) fn map_event(&mut self, host: &mut dyn Host, event: JobEvent) {
        match event {
            JobEvent::MapInfo(info) => {
                if self.documents.run.is_none() && self.documents.flight.is_none() {
                    self.views.map.camera.center = info.bounds.center();
                }
                if std::mem::take(&mut self.views.map.fits_when_known) {
                    self.views.map.fit(info.bounds);
                }
                self.documents.map = Some(info);
                if std::mem::take(&mut self.jobs.fit_when_known) {
                    self.fit_to_flight_and_map();
                }
            }
            JobEvent::Failed(why) => {
                self.jobs.describe = None;
                self.toasts
                    .trouble(host.now(), "The map cannot be shown", why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.describe = None,
            _ => {}
        }
    }

    /// Whether a job makes the map ready or takes heights.
    pub(super) fn is_map_work(&self, id: JobId) -> bool {
        let preparing = self.jobs.preparing.as_ref().map(|p| p.0);
        preparing == Some(id) || self.jobs.heights == Some(id)
    }

    pub(super) fn map_work_event(&mut self, host: &mut dyn Host, id: JobId, event: JobEvent) {
        if let JobEvent::Remark(text) = event {
            self.tell_of_map(host, &text);
            return;
        }
        if self.jobs.heights == Some(id) {
            self.heights_event(host, event);
            return;
        }
        let now = host.now();
        match event {
            JobEvent::Progress(part, words) => {
                self.jobs.preparing = Some((id, part, words));
                if now - self.jobs.tiles_refreshed > REFRESH {
                    self.jobs.tiles_refreshed = now;
                    self.views.map.tiles.refresh();
                }
            }
            JobEvent::Finished => {
                self.jobs.preparing = None;
                self.views.map.tiles.refresh();
            }
            JobEvent::Failed(why) => {
                self.jobs.preparing = None;
                self.jobs.prepare_declined = true;
                self.toasts
                    .trouble(now, "Wide views of the map stay incomplete", why);
            }
            JobEvent::Cancelled => self.jobs.preparing = None,
            _ => {}
        }
    }

    fn heights_event(&mut self, host: &mut dyn Host, event: JobEvent) {
        let now = host.now();
        match event {
            JobEvent::Heights(grid) => {
                if grid.extremes().is_none() {
                    let text = "Its area lies elsewhere. The heights are used as soon as a map or a \
                        plan there is open.";
                    self.toasts.note(
                        now,
                        "The elevation model covers nothing of what is open",
                        text,
                    );
                }
                self.documents.terrain.take(*grid);
            }
            JobEvent::Failed(why) => {
                self.jobs.heights = None;
                self.toasts.trouble(now, "The heights cannot be read", why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.heights = None,
            _ => {}
        }
    }

    /// Part of the map cannot be read: said once.
    pub(super) fn tell_of_map(&mut self, host: &mut dyn Host, text: &str) {
        let sentence = format!("{}.", text.trim_end_matches('.'));
        self.toasts
            .trouble(host.now(), "A part of the map stays empty", sentence);
    }

    /// Has the map made ready for wide views, unless that is under way or was stopped.
    fn prepare_map(&mut self, host: &mut dyn Host) {
        if self.jobs.preparing.is_some() || self.jobs.prepare_declined {
            return;
        }
        let job = host.start(Job::PrepareMap(PrepareMapOrder(
            self.documents.map_source.clone(),
        )));
        self.jobs.preparing = Some((job, 0.0, "Making an overview of the map".to_owned()));
    }

    /// Stops making the map ready; true if that was under way.
    pub(super) fn stop_preparing(&mut self, host: &mut dyn Host) -> bool {
        let Some((id, ..)) = self.jobs.preparing.take() else {
            return false;
        };
        host.cancel(id);
        self.jobs.prepare_declined = true;
        let text = "Wide views show what was made of it; closer views are whole.";
        self.toasts
            .note(host.now(), "The overview was stopped", text);
        true
    }

    /// Stops looking at opened files; true if that was under way.
    pub(super) fn stop_opening(&mut self, host: &mut dyn Host) -> bool {
        let ids: Vec<JobId> = self.jobs.opening.iter().map(|(id, _)| *id).collect();
        for id in &ids {
            host.cancel(*id);
        }
        !ids.is_empty()
    }

    /// Shows a map that was opened without a flight, in a world of its own if it lies elsewhere.
    pub(super) fn show_opened_map(
        &mut self,
        host: &mut dyn Host,
        source: MapSource,
        info: MapInfo,
    ) {
        let world = self.documents.world_origin();
        if let Some(origin) = info.origin.filter(|origin| world != Some(*origin)) {
            if self.documents.flight.is_some() || !self.documents.mission.landmarks.is_empty() {
                let text = "It begins a plan of its own. Undo brings the mission back; the flight \
                    opens again from its files, or with \u{201c}Open the built-in demo\u{201d}.";
                self.toasts
                    .note(host.now(), "The map lies far from what was open", text);
            }
            self.stop_flying(host);
            let name = info.name.rsplit('/').next().unwrap_or_default();
            let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
            self.documents.begin_world(origin, stem);
            self.selection = None;
            self.show_workspace(Workspace::Plan);
        }
        self.change_map(host, source);
        self.views.map.fit(info.bounds);
        self.documents.map = Some(info);
        self.jobs.document_changed = true;
    }

    /// Uses another elevation model.
    pub(super) fn take_terrain(&mut self, host: &mut dyn Host, key: &str, info: &TerrainInfo) {
        if let Some(job) = self.jobs.heights.take() {
            host.cancel(job);
        }
        self.documents.terrain = OpenedTerrain::of_files(key);
        host.store(TERRAIN_KEY, key.as_bytes());
        self.jobs.document_changed = true;
        let text = format!(
            "Posts {:.0} m apart, heights above {}.",
            info.spacing,
            info.datum.name()
        );
        self.toasts
            .note(host.now(), format!("Heights come from {}", info.name), text);
    }

    /// Asks for the heights of the ground that is of interest, where they are not at hand.
    pub(super) fn ask_for_heights(&mut self, host: &mut dyn Host) {
        if self.documents.terrain.key().is_none() || self.jobs.heights.is_some() {
            return;
        }
        let Some(origin) = self.documents.world_origin() else {
            return;
        };
        let near = |r: &GroundRect| r.width().max(r.height()) <= HEIGHTS_REACH;
        let map = self.documents.map.as_ref().map(|m| m.bounds).filter(near);
        let plan = planned_ground(&self.documents.mission).filter(near);
        let area = match (map, plan) {
            (Some(a), Some(b)) => Some(a.union(&b)).filter(near).or(Some(b)),
            (a, b) => a.or(b),
        };
        let Some(area) = area.map(|a| a.grown(HEIGHTS_AROUND)) else {
            return;
        };
        let Some(key) = self.documents.terrain.key().map(str::to_owned) else {
            return;
        };
        if self.documents.terrain.wants(origin, &area) {
            let order = HeightsOrder { key, origin, area };
            self.jobs.heights = Some(host.start(Job::TakeHeights(Box::new(order))));
        }
    }

    /// Keeps the map to the mission's world where nothing is flown: after an undo, or a mission that was
    /// opened, that may be another one.
    pub(super) fn follow_world(&mut self, host: &mut dyn Host) {
        let documents = &self.documents;
        let Some(origin) = documents.map_source.origin() else {
            return;
        };
        let world = documents.mission.origin;
        if documents.flight_source == FlightSource::Nothing && world != origin {
            let moved = documents.map_source.moved(world);
            self.change_map(host, moved);
        }
    }
}
