//! Stands in until the app lands.

use pilotage_ui::host::Host;
use pilotage_ui::jobs::{Job, MapSource};

/// Starts one job and shows what came of it.
pub struct App {
    asked: bool,
    lines: Vec<String>,
}

impl App {
    /// An app.
    pub fn new(_context: &egui::Context, _host: &dyn Host) -> Self {
        Self {
            asked: false,
            lines: Vec::new(),
        }
    }

    /// Draws.
    pub fn ui(&mut self, ui: &mut egui::Ui, host: &mut dyn Host) {
        if !self.asked {
            self.asked = true;
            host.start(Job::DescribeMap(MapSource::Scenery));
        }
        for (id, event) in host.events() {
            self.lines.push(format!("job {id}: {event:?}"));
        }
        for n in 0..host.lost_workers() {
            self.lines.push(format!("lost {n}"));
        }
        egui::CentralPanel::default().show(ui, |ui| {
            ui.heading("Pilotage");
            for line in &self.lines {
                ui.label(line);
            }
            if ui.button("Ask again").clicked() {
                host.start(Job::DescribeMap(MapSource::Scenery));
            }
        });
    }

    /// State.
    pub fn state_json(&self) -> String {
        serde_json::json!({ "lines": self.lines }).to_string()
    }

    /// Summary.
    pub fn summary_text(&self) -> String {
        self.lines.join("\n")
    }
}
