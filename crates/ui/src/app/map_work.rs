//! Work on the map that is shown: its description, its tiles, its overview for wide views.

use pilotage_jobs::{
    DescribeMapOrder, Job, JobEvent, JobId, MapSource, PrepareMapOrder, TileOrder,
};

use crate::documents::Documents;
use crate::host::Host;
use crate::job_owners::JobOwner;
use crate::map::{MapView, TILES_AT_A_TIME, TileKey};
use crate::shell::Toasts;
use crate::short_map::ShortMap;

/// Interval at which tiles that are not whole are asked for again while the map is made ready, milliseconds.
const REFRESH: f64 = 900.0;
/// Interval at which tiles are asked for again that are not whole for another reason, milliseconds.
const AGAIN: f64 = 10_000.0;

/// Jobs about the map that is shown.
#[derive(Debug, Default)]
pub struct MapWork {
    /// Tiles asked for.
    tiles: ShortMap<JobId, TileKey>,
    /// The map being made ready for wide views: job, how far, in words.
    preparing: Option<(JobId, f32, String)>,
    /// Whether the user stopped that.
    is_declined: bool,
    /// When tiles that are not whole were asked for again, milliseconds.
    refreshed: f64,
    /// When the map was last made ready, milliseconds.
    prepared: Option<f64>,
    /// The question what the map is.
    describing: Option<JobId>,
    /// Whether the map is to be fitted to the flight once it is known how far it reaches.
    pub fits_flight: bool,
}

/// Part of the app that work on the map uses.
pub struct MapParts<'a> {
    /// Documents that are open.
    pub documents: &'a mut Documents,
    /// Map view.
    pub view: &'a mut MapView,
    /// Notices.
    pub toasts: &'a mut Toasts,
    /// Services of the shell.
    pub host: &'a mut dyn Host,
}

impl MapWork {
    /// Takes an event of a job of its own; false if it waits for no such job, or nothing of that kind of it.
    pub fn take(
        &mut self,
        id: JobId,
        event: JobEvent,
        egui: &egui::Context,
        parts: &mut MapParts<'_>,
    ) -> bool {
        if self.tiles.contains_key(&id) {
            self.take_tile(id, event, egui, parts)
        } else if self.describing == Some(id) {
            self.take_description(event, parts)
        } else if self.preparing.as_ref().is_some_and(|it| it.0 == id) {
            self.take_overview(id, event, parts)
        } else {
            false
        }
    }

    /// Progress of the overview that is made, 0 to 1, and its words.
    pub fn progress(&self) -> Option<(f32, &str)> {
        let (_, part, words) = self.preparing.as_ref()?;
        Some((*part, words.as_str()))
    }

    /// Asks what the map is.
    pub fn describe(&mut self, documents: &Documents, host: &mut dyn Host) {
        if let Some(old) = self.describing.take() {
            host.leave(old);
        }
        let order = DescribeMapOrder(documents.map.source.clone());
        self.describing = Some(host.start(JobOwner::Map, Job::DescribeMap(order)));
    }

    /// Leaves the map that is shown for another one: nothing of the old one is of use. False if it is that already,
    /// of which what stayed empty is asked for again.
    pub fn leave_for(&mut self, map: MapSource, parts: &mut MapParts<'_>) -> bool {
        let documents = &mut *parts.documents;
        if documents.map.source == map && documents.map.info.is_some() {
            parts.view.tiles.forget_empty();
            return false;
        }
        let tiles = self.tiles.drain().map(|(id, _)| id);
        let preparing = self.preparing.take().map(|it| it.0);
        for id in tiles.chain(preparing) {
            parts.host.leave(id);
        }
        self.is_declined = false;
        self.prepared = None;
        documents.map.source = map;
        documents.map.info = None;
        parts.view.tiles.clear();
        true
    }

    /// Stops making the map ready; true if that was under way.
    pub fn stop(&mut self, toasts: &mut Toasts, host: &mut dyn Host) -> bool {
        let Some((id, ..)) = self.preparing.take() else {
            return false;
        };
        host.leave(id);
        self.is_declined = true;
        let text = "Wide views show what was made of it; closer views are whole.";
        toasts.note(host.now(), "The overview was stopped", text);
        true
    }

    /// Has tiles that are not whole asked for again from time to time, as those of the web that did not come; whether
    /// there are such.
    pub fn try_again(&mut self, view: &mut MapView, now: f64) -> bool {
        let waits = view.tiles.is_partial() && self.preparing.is_none() && !self.is_declined;
        if waits && now - self.refreshed >= AGAIN {
            self.refreshed = now;
            view.tiles.refresh();
        }
        waits
    }

    /// Asks for tiles that are looked at, and no longer for those that are not.
    pub fn ask_for_tiles(&mut self, documents: &Documents, view: &MapView, host: &mut dyn Host) {
        let wanted = view.tiles.wanted();
        let asked = self.tiles.iter();
        let stale = asked.filter(|(_, key)| !wanted.contains(key));
        let stale: Vec<_> = stale.map(|(id, _)| *id).collect();
        for id in stale {
            self.tiles.remove(&id);
            host.leave(id);
        }
        let under_way: Vec<_> = self.tiles.iter().map(|(_, key)| *key).collect();
        let room = TILES_AT_A_TIME.saturating_sub(under_way.len());
        let next = wanted.iter().filter(|key| !under_way.contains(key));
        for key in next.take(room).copied() {
            let order = TileOrder {
                map: documents.map.source.clone(),
                window: key.window(),
            };
            let id = host.start(JobOwner::Map, Job::Tile(order));
            self.tiles.insert(id, key);
        }
    }

    fn take_tile(
        &mut self,
        id: JobId,
        event: JobEvent,
        egui: &egui::Context,
        parts: &mut MapParts<'_>,
    ) -> bool {
        let tiles = &mut parts.view.tiles;
        match event {
            JobEvent::Tile {
                window,
                pixels,
                whole,
            } => {
                tiles.insert(egui, &window, &pixels, whole);
                if !whole {
                    self.prepare(parts);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.tiles.remove(&id);
            }
            JobEvent::Failed(why) => {
                tell_of_map(&why, parts.toasts, parts.host);
                // Asked for again once the map is chosen again: it may be too much for the machine.
                if let Some(key) = self.tiles.remove(&id) {
                    let empty = pilotage_core::raster::Raster::filled(0, 0, [0; 4]);
                    tiles.insert(egui, &key.window(), &empty, true);
                }
            }
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    fn take_description(&mut self, event: JobEvent, parts: &mut MapParts<'_>) -> bool {
        let (documents, view) = (&mut *parts.documents, &mut *parts.view);
        match event {
            JobEvent::MapInfo(info) => {
                if documents.run.navigated.is_none() && documents.flight.measured.is_none() {
                    view.camera.center = info.bounds.center();
                }
                if std::mem::take(&mut view.fits_when_known) {
                    view.fit(info.bounds);
                }
                documents.map.info = Some(info);
            }
            JobEvent::Failed(why) => {
                self.describing = None;
                let now = parts.host.now();
                parts.toasts.trouble(now, "The map cannot be shown", why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.describing = None,
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    fn take_overview(&mut self, id: JobId, event: JobEvent, parts: &mut MapParts<'_>) -> bool {
        let now = parts.host.now();
        let tiles = &mut parts.view.tiles;
        match event {
            JobEvent::Progress(part, words) => {
                self.preparing = Some((id, part, words));
                if now - self.refreshed > REFRESH {
                    self.refreshed = now;
                    tiles.refresh();
                }
            }
            JobEvent::Finished => {
                self.preparing = None;
                self.prepared = Some(now);
                tiles.refresh();
            }
            JobEvent::Failed(why) => {
                self.preparing = None;
                self.is_declined = true;
                let title = "Wide views of the map stay incomplete";
                parts.toasts.trouble(now, title, why);
            }
            JobEvent::Cancelled => self.preparing = None,
            _ => return false,
        }
        true
    }

    /// Has the map made ready for wide views, unless that is under way, was just done or was stopped.
    fn prepare(&mut self, parts: &mut MapParts<'_>) {
        let now = parts.host.now();
        let is_done = self.prepared.is_some_and(|at| now - at < AGAIN);
        let is_of_tiles = matches!(parts.documents.map.source, MapSource::Web(_));
        if self.preparing.is_some() || self.is_declined || is_done || is_of_tiles {
            return;
        }
        let order = PrepareMapOrder(parts.documents.map.source.clone());
        let job = parts.host.start(JobOwner::Map, Job::PrepareMap(order));
        self.preparing = Some((job, 0.0, "Making an overview of the map".to_owned()));
    }
}

/// Part of the map cannot be read: said once.
pub fn tell_of_map(text: &str, toasts: &mut Toasts, host: &dyn Host) {
    let sentence = format!("{}.", text.trim_end_matches('.'));
    toasts.trouble(host.now(), "A part of the map stays empty", sentence);
}
