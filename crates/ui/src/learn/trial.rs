//! Something to try at a stop of the tour.

use pilotage_core::navigator::NavigatorSettings;

use crate::command::Command;

/// Something to try: what the button says, and what it sends.
pub(super) struct TourTrial {
    pub text: String,
    pub commands: Vec<Command>,
    /// Whether the flight plays then.
    pub plays: bool,
    /// Whether it changes the mission, so that it can be taken back.
    pub edits: bool,
}

impl TourTrial {
    /// Trial that changes nothing of the mission.
    pub fn look(text: &str, commands: Vec<Command>) -> Self {
        Self {
            text: text.to_owned(),
            commands,
            plays: false,
            edits: false,
        }
    }

    /// Trial that plays the flight from a time on, seconds.
    pub fn play(text: &str, from: f64) -> Self {
        let commands = vec![Command::SeekTo(from), Command::SetSpeed(1.0)];
        Self {
            plays: true,
            ..Self::look(text, commands)
        }
    }

    /// Trial that flies again with changed settings.
    pub fn change(
        settings: &NavigatorSettings,
        text: &str,
        edit: &dyn Fn(&mut NavigatorSettings),
    ) -> Self {
        let mut settings = settings.clone();
        edit(&mut settings);
        let commands = vec![Command::SetNavigator(Box::new(settings))];
        Self {
            edits: true,
            ..Self::look(text, commands)
        }
    }
}
