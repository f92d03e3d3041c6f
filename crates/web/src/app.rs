//! The app inside eframe.

use pilotage_ui::host::Host as _;

use crate::browser::now;
use crate::frame_times::FrameTimes;
use crate::host::PageHost;
use pilotage_ui::app::App;

/// Shortest time between two announcements to screen readers, milliseconds.
const BETWEEN_ANNOUNCEMENTS: f64 = 2_000.0;

/// Draws the app and keeps count of the time it takes.
pub struct PageApp {
    /// The app.
    pub app: App,
    /// Time per frame.
    pub times: FrameTimes,
    host: PageHost,
    context: egui::Context,
    announced_at: f64,
}

impl PageApp {
    /// The app on a page.
    pub fn new(context: &egui::Context, host: PageHost) -> Self {
        Self {
            app: App::new(context, &host),
            times: FrameTimes::default(),
            host,
            context: context.clone(),
            announced_at: 0.0,
        }
    }

    /// Stores what was edited last.
    pub fn store_now(&mut self) {
        self.app.store_now(&self.context, &mut self.host);
    }
}

impl eframe::App for PageApp {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        if let Some(seconds) = frame.info().cpu_usage {
            self.times.note(1e3 * f64::from(seconds));
        }
        self.app.ui(ui, &mut self.host);
        let now = now();
        if now - self.announced_at > BETWEEN_ANNOUNCEMENTS {
            self.announced_at = now;
            let text = self.app.summary_text();
            self.host.announce(&text);
        }
    }

    fn as_any_mut(&mut self) -> Option<&mut dyn core::any::Any> {
        Some(&mut *self)
    }
}
