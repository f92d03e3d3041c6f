//! Document and view in the browser's storage, behind what is open by a moment at most.

use crate::documents::{Documents, SESSION_KEY, Session, VIEW_KEY, ViewState};
use crate::host::Host;

/// Delay between a change and its storing, milliseconds.
const STORE_AFTER: f64 = 600.0;

/// Document and view as they were stored last.
#[derive(Debug)]
pub struct Stored {
    session: Vec<u8>,
    view: Vec<u8>,
    /// When the change happened that waits to be stored, milliseconds of the host's clock.
    since: Option<f64>,
    /// Whether the document changed since it was stored last.
    pub document_changed: bool,
}

impl Stored {
    /// Counts a session and a view as stored.
    pub fn new(session: &Session, view: &ViewState) -> Self {
        Self {
            session: session.encode(),
            view: view.encode(),
            since: None,
            document_changed: false,
        }
    }

    /// Has the document stored once more, whether it changes or not, a moment after `at`, if given.
    pub fn store_anew(&mut self, at: Option<f64>) {
        self.session.clear();
        self.document_changed = true;
        self.since = at;
    }

    /// Has what changed stored without waiting for more changes.
    pub fn hurry(&mut self) {
        self.since = Some(f64::NEG_INFINITY);
    }

    /// Whether a change waits to be stored.
    pub fn is_waiting(&self) -> bool {
        self.since.is_some()
    }

    /// Stores the document and the view a moment after they changed; whether the document was stored.
    pub fn tend(
        &mut self,
        documents: &Documents,
        view: &ViewState,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) -> bool {
        let view = view.encode();
        let view_changed = view != self.view;
        if !view_changed && !self.document_changed {
            return false;
        }
        let now = host.now();
        let since = *self.since.get_or_insert(now);
        let left = since + STORE_AFTER - now;
        if left > 0.0 {
            egui.request_repaint_after(std::time::Duration::from_secs_f64(1e-3 * left));
            return false;
        }
        self.since = None;
        self.document_changed = false;
        if view_changed {
            host.store(VIEW_KEY, &view);
            self.view = view;
        }
        let session = documents.session().encode();
        let session_changed = session != self.session;
        if session_changed {
            host.store(SESSION_KEY, &session);
            self.session = session;
        }
        session_changed
    }
}
