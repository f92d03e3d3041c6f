//! The stops of the tour: what each is called and what it invites people to try.

use pilotage_core::navigator::NavigatorSettings;

use super::moment::TourMoment;
use crate::command::Command;
use crate::feature_command::FeatureCommand;
use crate::views::MATCH;

/// Stop of the tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    FirstLandmark,
    Shrinking,
    Gate,
    Refused,
    Wind,
    DeadReckoning,
    Growing,
    Reacquired,
    Alpha,
    Consistency,
    YourTurn,
}

/// Something to try: what the button says, and what it sends.
pub(crate) struct TourTrial {
    pub text: String,
    pub commands: Vec<Command>,
    /// Whether it changes the mission, so that it can be taken back.
    pub edits: bool,
}

impl Stop {
    /// Every stop in order.
    pub const ALL: [Self; 11] = [
        Self::FirstLandmark,
        Self::Shrinking,
        Self::Gate,
        Self::Refused,
        Self::Wind,
        Self::DeadReckoning,
        Self::Growing,
        Self::Reacquired,
        Self::Alpha,
        Self::Consistency,
        Self::YourTurn,
    ];

    /// Heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::FirstLandmark => "A landmark is found",
            Self::Shrinking => "The sigma points draw together",
            Self::Gate => "The gate: how far off is too far",
            Self::Refused => "A match is refused",
            Self::Wind => "The wind is learned",
            Self::DeadReckoning => "Nothing in view: dead reckoning",
            Self::Growing => "The sigma points spread",
            Self::Reacquired => "Found again",
            Self::Alpha => "What α does",
            Self::Consistency => "Does the filter know how wrong it is?",
            Self::YourTurn => "Your turn",
        }
    }

    /// Trial for people at this stop; `alpha` is what the slider of that stop says.
    pub fn trial(
        self,
        moment: Option<&TourMoment>,
        settings: &NavigatorSettings,
        playing: bool,
        alpha: f64,
    ) -> TourTrial {
        let play = |from: f64| {
            let mut commands = vec![Command::SeekTo(from), Command::SetSpeed(1.0)];
            if !playing {
                commands.push(Command::TogglePlay);
            }
            commands
        };
        let look = |text: &str, commands: Vec<Command>| TourTrial {
            text: text.to_owned(),
            commands,
            edits: false,
        };
        let time = moment.map_or(0.0, |m| m.time);
        match self {
            Self::FirstLandmark => {
                look("Watch it happen from two seconds before", play(time - 2.0))
            }
            Self::Shrinking => look("Step to the next picture", vec![Command::StepFrames(1)]),
            Self::Refused => look(
                "Open in match view",
                vec![
                    Command::SelectLandmark(moment.and_then(|m| m.landmark)),
                    Command::Feature(FeatureCommand::show(MATCH)),
                ],
            ),
            Self::DeadReckoning => look("Play this stretch", play(moment.map_or(0.0, |m| m.from))),
            Self::Growing => look(
                "Go back to where it began",
                vec![Command::SeekTo(moment.map_or(0.0, |m| m.from))],
            ),
            Self::Reacquired => look("Watch the last two seconds before", play(time - 2.0)),
            Self::Gate => change(settings, "Fly again with a gate of 80 %", |s| {
                s.gate_confidence = 0.80;
            }),
            Self::Wind => change(
                settings,
                "Fly again with the wind pinned to zero at the start",
                |s| {
                    s.start.wind = 0.1;
                },
            ),
            Self::Alpha => change(settings, &format!("Fly again with α = {alpha:.2}"), |s| {
                s.alpha = alpha;
            }),
            Self::Consistency => change(
                settings,
                "Fly again with a measurement noise nine times too large",
                |s| {
                    s.measurement_scale *= 9.0;
                },
            ),
            Self::YourTurn => look("Draw a landmark on the map", vec![Command::TogglePickTool]),
        }
    }
}

/// A trial that flies again with changed settings.
fn change(
    settings: &NavigatorSettings,
    text: &str,
    edit: impl FnOnce(&mut NavigatorSettings),
) -> TourTrial {
    let mut settings = settings.clone();
    edit(&mut settings);
    TourTrial {
        text: text.to_owned(),
        commands: vec![Command::SetNavigator(Box::new(settings))],
        edits: true,
    }
}
