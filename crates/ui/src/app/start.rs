//! The first moments, and what is remembered of an earlier visit.

use std::collections::BTreeSet;

use super::App;
use super::aside::Aside;
use super::fly_work::FlyWork;
use super::frame_pictures::FramePictureRequests;
use super::height_work::HeightWork;
use super::keeping::{do_without, used_files};
use super::map_work::MapWork;
use super::openings::Openings;
use super::storage::Keeping;
use super::stored::Stored;
use crate::command::Workspace;
use crate::documents::{
    Documents, OpenedTerrain, SESSION_KEY, Session, TERRAIN_KEY, UNREAD_KEY, VIEW_KEY, ViewState,
};
use crate::feature::FlightFiles;
use crate::host::Host;
use crate::shell::keys::ShortcutListener;
use crate::shell::{Toasts, apply_theme, fonts};
use crate::timeline::Playback;
use crate::tokens::Tokens;
use pilotage_jobs::{FirstMap, FirstSeconds};

impl App {
    /// The app as it was left, or with the built-in demo.
    pub fn new(context: &egui::Context, host: &dyn Host) -> Self {
        let stored = host.recall(SESSION_KEY);
        let read = |bytes: &Vec<u8>| Session::decode(bytes);
        let session = stored.as_ref().and_then(read);
        let mut aside = stored.filter(|_| session.is_none()).map(Aside::Keep);
        let mut session = session.unwrap_or_else(Session::demo);
        // What could not be read when it was stored may be now.
        if aside.is_none()
            && session.mission.is_none()
            && let Some(before) = host.recall(UNREAD_KEY).as_ref().and_then(read)
        {
            session = before;
            aside = Some(Aside::Taken);
        }
        let view = host.recall(VIEW_KEY).map_or_else(
            || ViewState {
                dark: !host.prefers_light(),
                ..ViewState::default()
            },
            |bytes| ViewState::decode(&bytes),
        );
        let tokens = Tokens {
            touch: host.is_touched_first(),
            ..Tokens::of(view.dark)
        };
        context.set_fonts(fonts());
        apply_theme(context, &tokens);
        let features = crate::features::FeatureTable::all();
        let catalog = crate::features::catalog(&features);
        context.add_plugin(ShortcutListener::new(&catalog));
        let mut app = Self {
            documents: Documents::new(&session),
            playback: Playback {
                is_still: host.prefers_stillness(),
                speed: view.speed,
                looping: view.looping,
                ..Playback::default()
            },
            tokens,
            selection: None,
            side_tab: super::SideTab::default(),
            dialogs: super::Dialogs::default(),
            toasts: Toasts::default(),
            views: super::Views {
                features,
                ..super::Views::default()
            },
            frame_pictures: FramePictureRequests::default(),
            fly_work: FlyWork::default(),
            openings: Openings::default(),
            map_work: MapWork::default(),
            height_work: HeightWork::default(),
            commands: Vec::new(),
            input_waits: false,
            started: false,
            catalog,
            followed: (0, session.flight.clone()),
            aside,
            keeping: Keeping::default(),
            last_now: None,
            stored: Stored::new(&session, &view),
            view,
        };
        app.views.map.follow = true;
        app.views.map.camera.metres_per_point = super::execute::USUAL_SCALE;
        app.views.map.layers.hide_names(&app.view.hidden_layers);
        for feature in &mut app.views.features {
            let own = feature.info().id;
            let saved = app.view.features.iter().find(|(id, _)| id == own);
            if let Some((_, part)) = saved {
                feature.restore(part);
            }
        }
        app
    }

    pub(super) fn start(&mut self, context: &egui::Context, host: &mut dyn Host) {
        self.lay_first_ground(context, host);
        let terrain = host.recall(TERRAIN_KEY);
        if let Some(key) = terrain.and_then(|bytes| String::from_utf8(bytes).ok()) {
            self.documents.map.terrain = OpenedTerrain::of_files(&key);
        }
        let aside = self.aside.take();
        if let Some(Aside::Taken) = aside {
            host.forget(UNREAD_KEY);
            self.stored.store_anew(None);
        }
        if let Some(Aside::Keep(bytes)) = aside {
            host.store(UNREAD_KEY, &bytes);
            let title = "The work of your last visit cannot be read";
            let text = "It is damaged, or a later version of this page stored it. It is kept aside \
                until a version can read it; meanwhile, this is the demo.";
            self.toasts.trouble(host.now(), title, text);
        }
        self.start_features(context, host);
        // Files opened from now on must not take the place of those that a feature keeps.
        let features = self.views.features.iter();
        for set in features.flat_map(|it| it.used_files()) {
            self.openings.count_on(set);
        }
        if host
            .interrupted_saves()
            .iter()
            .any(|key| key == SESSION_KEY)
        {
            self.toasts.trouble(
                host.now(),
                "The last save was broken off",
                "What is here is as it was saved before that: at most your last edit is missing.",
            );
        }
        let gone = self.restore_files(host);
        let map = self.documents.map.source.key();
        if !map.is_some_and(|key| gone.contains(key)) {
            self.map_work.describe(&self.documents, host);
        }
        self.fly_session(context, host);
    }

    /// Shows the stored picture of the demo's ground until its tiles are there.
    fn lay_first_ground(&mut self, context: &egui::Context, host: &dyn Host) {
        let first = host.recall(FirstSeconds::KEY);
        let first = first.and_then(|bytes| FirstMap::decode(&bytes));
        let is_shown = |first: &FirstMap| first.source == self.documents.map.source;
        let pixels = host.recall(FirstSeconds::GROUND_KEY);
        let (Some(first), Some(pixels)) = (first.filter(is_shown), pixels) else {
            return;
        };
        let side = (pixels.len() / 4).isqrt();
        if 4 * side * side != pixels.len() {
            return;
        }
        let image = egui::ColorImage::from_rgba_unmultiplied([side, side], &pixels);
        self.views
            .map
            .tiles
            .lay_ground(context, first.ground, image);
    }

    /// Flies what is open by name only: of files, what they tell is read first.
    pub(super) fn fly_session(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        match FlightFiles::open(&self.documents) {
            Some(files) => self.read_flight(&files, egui, host),
            None => self.fly_open(host, self.documents.session()),
        }
    }

    /// Opens a session in the place of what is open.
    pub(super) fn open_session(
        &mut self,
        session: &Session,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        self.fly_work.stop(host);
        self.documents.replace(session);
        self.restore_files(host);
        self.map_work.describe(&self.documents, host);
        self.fly_session(egui, host);
    }

    /// Gives the workers the files of the earlier visit, and goes on without those that are gone; the keys of these.
    fn restore_files(&mut self, host: &mut dyn Host) -> BTreeSet<String> {
        let documents = &mut self.documents;
        let gone = self.keeping.restore(documents, &mut self.openings, host);
        if gone.is_empty() {
            return gone;
        }
        let planned = do_without(&gone, documents, &mut self.toasts, host);
        if let Some(ground) = planned {
            self.show_workspace(Workspace::Plan);
            self.views.map.fit(ground);
        }
        gone
    }

    /// Stores what was edited last without waiting for more edits: nothing is drawn any more.
    pub fn store_now(&mut self, context: &egui::Context, host: &mut dyn Host) {
        self.stored.hurry();
        // Files that are still being kept are not waited for: the edit would be lost with them.
        self.store_session(true, context, host);
    }

    /// Stores the document and the view a moment after they changed.
    pub(super) fn remember(&mut self, context: &egui::Context, host: &mut dyn Host) {
        self.store_session(self.keeping.is_done(), context, host);
    }

    /// Stores the document and the view if that may be done now.
    fn store_session(&mut self, is_due: bool, context: &egui::Context, host: &mut dyn Host) {
        self.view.speed = self.playback.speed;
        self.view.looping = self.playback.looping;
        for feature in &self.views.features {
            if let Some(part) = feature.save() {
                let own = feature.info().id;
                let parts = &mut self.view.features;
                parts.retain(|(id, _)| id != own);
                parts.push((own.to_owned(), part));
            }
        }
        self.view.hidden_layers = self.views.map.layers.hidden_names();
        let (documents, view) = (&self.documents, &self.view);
        let is_stored = is_due && self.stored.tend(documents, view, context, host);
        if is_stored && self.keeping.is_done() {
            self.forget_unused_files();
        }
    }

    /// Forgets files that neither the document nor a flight about to begin needs.
    fn forget_unused_files(&mut self) {
        if self.openings.keys().next().is_none() {
            let features = &self.views.features;
            let used = used_files(&self.documents, &self.fly_work, features);
            self.keeping.forget_others(&used);
        }
    }
}
