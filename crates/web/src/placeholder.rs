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
            host.start(Job::Fly {
                flight: pilotage_ui::jobs::FlightSource::Simulated(
                    pilotage_ui::jobs::SimulationOptions {
                        scenario: "distinct-400ft-wind".to_owned(),
                        seed: 1,
                        other_day: true,
                        wind: None,
                        height: None,
                    },
                ),
                map: MapSource::Scenery,
                mission: None,
            });
            for i in 0..6 {
                host.start(Job::Tile {
                    map: MapSource::Scenery,
                    window: pilotage_core::imagery::Window {
                        north_edge: 64.0 * f64::from(i),
                        west_edge: 0.0,
                        gsd: 0.25,
                        width: 256,
                        height: 256,
                    },
                });
            }
            host.start(Job::Tile {
                map: MapSource::Scenery,
                window: pilotage_core::imagery::Window {
                    north_edge: 1024.0,
                    west_edge: -1024.0,
                    gsd: 8.0,
                    width: 256,
                    height: 256,
                },
            });
        }
        for (id, event) in host.events() {
            let now = host.now();
            use pilotage_ui::jobs::JobEvent as E;
            let text = match &event {
                E::Steps(s) => format!(
                    "{} steps to {:.1}, see {:?}",
                    s.len(),
                    s.last().map_or(0.0, |s| s.time),
                    s.iter()
                        .filter_map(|s| s.frame.as_ref().map(|_| s.timing.see.round()))
                        .collect::<Vec<_>>()
                ),
                E::FramePicture { index, encoded } => format!("picture {index}: {}", encoded.len()),
                E::Tile { window, .. } => format!("tile {}", window.gsd),
                E::Flight(_) | E::Mission(_) | E::RunStarted(_) => "head".into(),
                other => format!("{other:?}"),
            };
            if self.lines.len() > 60 {
                self.lines.truncate(40);
            }
            self.lines.insert(0, format!("{now:.0} job {id}: {text}"));
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
