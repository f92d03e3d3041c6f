//! Files that are saved as a feature: made by workers where they take long, and saved once they are there.

use pilotage_core::exchange::Format;
use pilotage_jobs::{ExportOrder, Job, JobEvent, JobId};

use super::missing::missing;
use super::mission_file::MissionFile;
use super::places::{landmarks_file, rally_file, route_file};
use super::track::track_file;
use crate::documents::{Documents, encode_run};
use crate::export_command::{EXPORTS, ExportCommand, ExportedFile};
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::host::stem;
use crate::shell::CommandLack;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, control, entry};
use crate::shell::sentences;

use egui::Key;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: EXPORTS,
    tab: "Exports",
    place: FeaturePlace::Nowhere,
    commands,
};

/// The mission and the run, then whatever other programs can read, in every format that holds it.
fn commands() -> Vec<CommandEntry> {
    let save_mission = "Save the mission".to_owned();
    let save_geojson = "Save the mission alone as GeoJSON".to_owned();
    let own = [
        (save_mission, ExportCommand::Mission),
        (save_geojson, ExportCommand::MissionAsGeoJson),
        ("Save the run".to_owned(), ExportCommand::Run),
    ];
    let label = |menu: BarMenu, format: Format| {
        let beginning = menu.beginning().unwrap_or_default();
        format!("{beginning} {}", format.as_words())
    };
    let routes = Format::all().map(|format| {
        let label = label(BarMenu::ExportRoute, format);
        (label, ExportCommand::Route(format))
    });
    let landmarks = Format::all().filter(|f| f.holds_landmarks());
    let landmarks = landmarks.map(|format| {
        let label = label(BarMenu::ExportLandmarks, format);
        (label, ExportCommand::Landmarks(format))
    });
    let tracks = Format::all().filter(|f| f.holds_tracks());
    let tracks = tracks.map(|format| {
        let label = label(BarMenu::ExportTrack, format);
        (label, ExportCommand::Track(format))
    });
    let rally = Format::of_rally_alone().map(|format| {
        let label = format!("Export the rally points as {}", format.as_words());
        (label, ExportCommand::Rally)
    });
    let all = own.into_iter().chain(routes).chain(rally);
    let all = all.chain(landmarks).chain(tracks);
    all.map(|(label, command)| {
        let keys = match command {
            ExportCommand::Mission => vec![control(Key::S)],
            _ => Vec::new(),
        };
        let menu = match command {
            ExportCommand::Mission | ExportCommand::Run => BarMenu::Save,
            ExportCommand::Route(_) => BarMenu::ExportRoute,
            ExportCommand::Landmarks(_) => BarMenu::ExportLandmarks,
            ExportCommand::Track(_) => BarMenu::ExportTrack,
            _ => BarMenu::Export,
        };
        entry(CommandGroup::Document, label, keys, command.into())
            .also("download file")
            .under(menu)
    })
    .collect()
}

/// Advice where the log that has values for a file is not there.
const LOG_AGAIN: &str =
    "If it was lost with its worker, the log is being read again: export once more after that.";

/// File that is being made.
#[derive(Debug)]
struct FileInWork {
    job: JobId,
    file: ExportedFile,
    /// Whether values of the log stand in it.
    is_of_log: bool,
}

/// Files that are being made.
#[derive(Debug, Default)]
pub struct ExportsFeature {
    making: Vec<FileInWork>,
    mission: MissionFile,
}

impl ExportsFeature {
    /// Has a file for another program made.
    fn make(&mut self, file: ExportedFile, order: ExportOrder, context: &mut FeatureContext<'_>) {
        let is_of_log = matches!(
            order,
            ExportOrder::Track {
                beside: Some(_),
                ..
            }
        );
        self.making.push(FileInWork {
            job: context.start(Job::Export(Box::new(order))),
            file,
            is_of_log,
        });
    }
}

impl Feature for ExportsFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action() else {
            return false;
        };
        if let Some(CommandLack { what, advice }) = missing(command, context.documents) {
            context.note(what, advice);
            return true;
        }
        let made = match command {
            ExportCommand::Mission => {
                self.mission.make(context);
                None
            }
            ExportCommand::MissionAsGeoJson => {
                save_geojson(context);
                None
            }
            ExportCommand::Run => {
                save_run(context);
                None
            }
            ExportCommand::Route(format) => route_file(*format, context),
            ExportCommand::Landmarks(format) => Some(landmarks_file(*format, context)),
            ExportCommand::Rally => rally_file(context),
            ExportCommand::Track(format) => track_file(*format, context),
            ExportCommand::File(made) => Some(made.as_ref().clone()),
        };
        if let Some((file, order)) = made {
            self.make(file, order, context);
        }
        true
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        missing(command.action()?, documents)
    }

    fn progress(&self) -> Option<(f32, &str)> {
        let making = self.making.last().map(|_| "Making the file");
        let words = making.or(self.mission.is_made().then_some("Saving the mission"));
        words.map(|words| (0.0, words))
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let mission = self.mission.stop();
        let jobs = self.making.drain(..).map(|it| it.job).chain(mission);
        jobs.map(|job| context.cancel(job)).count() > 0
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let Some(place) = self.making.iter().position(|it| it.job == job) else {
            return self.mission.take(job, event, context);
        };
        let is_last = event.is_last();
        let FileInWork {
            file, is_of_log, ..
        } = &self.making[place];
        let ExportedFile { what, format, name } = file;
        match event {
            JobEvent::Exported { bytes, notes } => {
                context.host.save_file(name, &bytes);
                let title = format!("{what} exported as {format}: {name}");
                context.note(&title, sentences(&notes));
            }
            JobEvent::Failed(why) => {
                let title = format!("{what} not exported as {format}");
                let mut why = vec![why];
                if *is_of_log {
                    // Only for it: what is on the page is there still, and nobody else would ask.
                    context.lose_log();
                    why.push(LOG_AGAIN.to_owned());
                }
                context.trouble(&title, sentences(&why));
            }
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.making.remove(place);
        }
        true
    }
}

fn save_run(context: &mut FeatureContext<'_>) {
    let title = "The run was not saved";
    match context.documents.run.navigated.as_ref().map(encode_run) {
        Some(Ok(bytes)) => {
            let name = format!("{}.run", stem(&context.documents.mission.name));
            context.host.save_file(&name, &bytes);
            let part = context.documents.part_flown();
            let part = part.map_or_else(String::new, |part| format!(": {part}"));
            context.note("Run saved", format!("{name}{part}"));
        }
        Some(Err(error)) => context.trouble(title, error.to_string()),
        None => {}
    }
}

fn save_geojson(context: &mut FeatureContext<'_>) {
    let mission = &context.documents.mission;
    let name = format!("{}.geojson", stem(&mission.name));
    let text = pilotage_core::mission::write_mission(mission);
    context.host.save_file(&name, text.as_bytes());
    context.note("Mission saved", name);
}
