//! Films of the replay, made by the browser's own encoder while it plays.

use pilotage_core::navigator::Run;

use crate::command::Command;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureId, FeatureInfo, FeaturePlace,
};
use crate::host::stem;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry};
use crate::units::clock;

/// Identity of the feature.
const ID: FeatureId = "replay-film";

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Film of the replay",
    place: FeaturePlace::Nowhere,
    commands,
};

/// Film the selected span of time, or all of it; a film that is being made ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Film;

fn commands() -> Vec<CommandEntry> {
    let label = "Film the selected time of the replay (WebM), or end the film";
    let film = Command::Feature(FeatureCommand::new(ID, Film));
    let entry = entry(CommandGroup::Document, label, Vec::new(), film);
    vec![entry.also("video movie record screencast")]
}

/// Film that is being made.
#[derive(Debug)]
struct Recording {
    /// Name of its file.
    name: String,
    /// First and last time that it shows, seconds.
    span: (f64, f64),
    /// Time that was shown last.
    shown: f64,
    words: String,
}

/// Films of the replay.
#[derive(Debug, Default)]
pub struct Films {
    recording: Option<Recording>,
}

impl Films {
    fn begin(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let run = documents.run.navigated.as_ref().and_then(Run::span);
        let (Some(whole), Some((_, last))) = (documents.span(), run) else {
            let text = "Open or simulate a flight first; it is filmed as it is replayed.";
            return context.note("There is nothing to film", text);
        };
        let (from, to) = context.playback.selected_span.unwrap_or(whole);
        if from >= last {
            let text = format!(
                "The flight is flown up to {} so far; the selected time begins at {}.",
                clock(last, whole.0),
                clock(from, whole.0)
            );
            return context.note("There is nothing to film yet", text);
        }
        // The replay waits for what is still being flown.
        let goes_on = !documents.run.is_complete;
        let span = (from, if goes_on { to } else { to.min(last) });
        let ending = context.host.start_film();
        if ending.is_empty() {
            let text =
                "It has no encoder for what is drawn on a page. Single pictures can be saved.";
            return context.trouble("This browser makes no films", text);
        }
        let title = documents.subject();
        let times = format!("{}-{}", clock(span.0, whole.0), clock(span.1, whole.0));
        self.recording = Some(Recording {
            name: format!("{}.{ending}", stem(&format!("{title}-{times}"))),
            span,
            shown: span.0,
            words: "Filming".to_owned(),
        });
        context.playback.time = span.0;
        context.playback.playing = true;
    }

    fn end(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(recording) = self.recording.take() {
            context.host.stop_film(&recording.name);
            context.playback.playing = false;
            context.note("Film saved", recording.name);
        }
    }
}

impl Feature for Films {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        if command.action::<Film>().is_none() {
            return false;
        }
        if self.recording.is_some() {
            self.end(context);
        } else {
            self.begin(context);
        }
        true
    }

    /// Ends the film once its time is over, or when people stop the replay or seek back.
    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        let Some(recording) = &mut self.recording else {
            return;
        };
        let time = context.playback.time;
        let is_over = time >= recording.span.1 || time < recording.shown;
        recording.shown = time;
        if is_over || !context.playback.playing {
            self.end(context);
        }
    }

    fn progress(&self) -> Option<(f32, &str)> {
        let recording = self.recording.as_ref()?;
        let (from, to) = recording.span;
        let done = (recording.shown - from) / (to - from).max(f64::MIN_POSITIVE);
        Some((done as f32, &recording.words))
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let was_filming = self.recording.is_some();
        self.end(context);
        was_filming
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.end(context);
    }
}
