//! Catalogue of all commands: their words, groups and keys. Menu, palette, shortcuts and the help sheet all
//! read this one table.

use egui::{Key, KeyboardShortcut, Modifiers};

pub use super::entry::{
    BarMenu, CommandEntry, CommandGroup, control, describe, entry, plain, shift,
};
use crate::command::{Command, Workspace};

/// Speeds set by the digits 1 to 9 and 0.
pub const DIGIT_SPEEDS: [(Key, f64); 10] = [
    (Key::Num1, 0.1),
    (Key::Num2, 0.25),
    (Key::Num3, 0.5),
    (Key::Num4, 1.0),
    (Key::Num5, 2.0),
    (Key::Num6, 4.0),
    (Key::Num7, 8.0),
    (Key::Num8, 12.0),
    (Key::Num9, 16.0),
    (Key::Num0, 20.0),
];

/// Table of the commands that are the app's own, in reading order; features have tables of theirs.
pub fn catalog() -> Vec<CommandEntry> {
    let mut entries = playback();
    entries.extend(view());
    entries.extend(edit());
    entries.extend(document());
    entries
}

fn playback() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| entry(CommandGroup::Playback, label, shortcuts, command);
    let mut entries = vec![
        of(
            "Play or pause",
            vec![plain(Key::Space)],
            Command::TogglePlay,
        ),
        of(
            "Previous frame",
            vec![plain(Key::ArrowLeft)],
            Command::StepFrames(-1),
        ),
        of(
            "Next frame",
            vec![plain(Key::ArrowRight)],
            Command::StepFrames(1),
        ),
        of(
            "Back 5 seconds",
            vec![shift(Key::ArrowLeft)],
            Command::Jump(-5.0),
        ),
        of(
            "Forward 5 seconds",
            vec![shift(Key::ArrowRight)],
            Command::Jump(5.0),
        ),
        of(
            "Go to the start",
            vec![plain(Key::Home)],
            Command::GoToStart,
        ),
        of("Go to the end", vec![plain(Key::End)], Command::GoToEnd),
        of(
            "Select from the cursor on",
            vec![shift(Key::B)],
            Command::SelectFromHere,
        ),
        of(
            "Select up to the cursor",
            vec![shift(Key::E)],
            Command::SelectToHere,
        ),
        of(
            "Select no span of time (Esc)",
            vec![],
            Command::SelectSpan(None),
        ),
        of(
            "Repeat at the end",
            vec![plain(Key::L)],
            Command::ToggleLoop,
        )
        .also("loop"),
        of(
            "Set or remove a bookmark",
            vec![plain(Key::B)],
            Command::ToggleBookmark,
        ),
        of(
            "Previous bookmark",
            vec![plain(Key::OpenBracket)],
            Command::PreviousBookmark,
        ),
        of(
            "Next bookmark",
            vec![plain(Key::CloseBracket)],
            Command::NextBookmark,
        ),
    ];
    let labels = [
        "Speed 0.1×",
        "Speed 0.25×",
        "Speed 0.5×",
        "Speed 1×",
        "Speed 2×",
        "Speed 4×",
        "Speed 8×",
        "Speed 12×",
        "Speed 16×",
        "Speed 20×",
    ];
    for ((key, speed), label) in DIGIT_SPEEDS.into_iter().zip(labels) {
        let of = of(label, vec![plain(key)], Command::SetSpeed(speed));
        entries.push(of.also("playback faster slower slow motion"));
    }
    entries
}

fn view() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| entry(CommandGroup::View, label, shortcuts, command);
    vec![
        of(
            "Show the whole flight",
            vec![plain(Key::F)],
            Command::FitMap,
        )
        .also("zoom fit reset view overview")
        .under(BarMenu::View),
        of(
            "Follow the aircraft",
            vec![plain(Key::A)],
            Command::ToggleFollow,
        )
        .also("centre center track"),
        of(
            "Turn the map with the track",
            vec![plain(Key::T)],
            Command::ToggleTrackUp,
        )
        .also("rotate heading north up")
        .under(BarMenu::View),
        of(
            "Show or hide the side column",
            vec![plain(Key::V)],
            Command::ToggleSide,
        )
        .also("panel hide sidebar")
        .under(BarMenu::View),
        of(
            "Show or hide the plots",
            vec![plain(Key::G)],
            Command::TogglePlots,
        )
        .also("charts graphs curves hide")
        .under(BarMenu::View),
        of("Reset view", vec![], Command::ResetView)
            .also("layout panels default restore map")
            .under(BarMenu::View),
        of(
            "Show Replay",
            vec![shift(Key::R)],
            Command::ShowWorkspace(Workspace::Replay),
        ),
        of(
            "Show Plan",
            vec![shift(Key::P)],
            Command::ShowWorkspace(Workspace::Plan),
        ),
        of("Dark or light", vec![], Command::ToggleTheme)
            .also("theme mode colours colors night day")
            .under(BarMenu::View),
        of(
            "Metric or aviation units",
            vec![plain(Key::U)],
            Command::ToggleUnits,
        )
        .also("feet knots metres miles imperial")
        .under(BarMenu::View),
        of(
            "Find a command",
            vec![control(Key::K), plain(Key::P)],
            Command::TogglePalette,
        )
        .also("search palette")
        .under(BarMenu::Help),
        of(
            "Show all shortcuts",
            vec![plain(Key::Questionmark), shift(Key::Questionmark)],
            Command::ToggleHelp,
        )
        .also("help keyboard keys manual")
        .under(BarMenu::Help),
        of("Show the notices again", vec![], Command::ToggleNotices)
            .also("messages errors warnings history log")
            .under(BarMenu::Help),
    ]
}

fn edit() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| entry(CommandGroup::Edit, label, shortcuts, command);
    vec![
        of(
            "Draw a landmark",
            vec![plain(Key::N)],
            Command::TogglePickTool,
        )
        .also("add mark box new"),
        of(
            "Delete the landmark",
            vec![],
            Command::DeleteSelectedLandmark,
        )
        .also("remove erase"),
        of("Undo", vec![control(Key::Z)], Command::Undo).also("back revert"),
        of(
            "Redo",
            vec![
                KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
                control(Key::Y),
            ],
            Command::Redo,
        )
        .also("again repeat"),
        of("Select nothing", vec![], Command::SelectLandmark(None)),
        of(
            "Fly again over these landmarks",
            vec![plain(Key::R)],
            Command::FlyAgain,
        ),
    ]
}

fn document() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| entry(CommandGroup::Document, label, shortcuts, command);
    vec![
        of(
            "Filter settings",
            vec![plain(Key::S)],
            Command::ToggleSettings,
        )
        .also("kalman estimator noise gate ukf ekf particles aids generic landmarks options preferences")
        .under(BarMenu::Settings),
        of(
            "Open a flight, map, mission, route or run…",
            vec![control(Key::O)],
            Command::Open,
        )
        .also("load file import log bin ulog geotiff kml photo picture georeference place orthophoto elevation dem")
        .under(BarMenu::Open),
        of("Stop computing", vec![], Command::CancelJob).also("cancel abort"),
        of("Open the built-in demo", vec![], Command::OpenDemo)
            .also("example sample home")
            .under(BarMenu::Open),
    ]
}
