//! Commands of planning, as the table of all commands has them.

use egui::Key;

use super::{FindCommand, HeatCommand, PlanCommand, Purpose, RehearseCommand, TrainCommand};
use crate::command::Command;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, control, entry, plain, shift};

/// Rows of the table of all commands.
pub fn commands() -> Vec<CommandEntry> {
    let mut entries = routes();
    entries.extend(landmarks());
    entries.extend(trainings());
    entries.extend(ground());
    let print = entry(
        CommandGroup::Document,
        "Print the mission brief",
        vec![control(Key::P)],
        Command::from(PlanCommand::PrintBrief),
    );
    entries.push(print.also("paper pdf briefing").under(BarMenu::Save));
    entries
}

fn routes() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::Plan, label, shortcuts, Command::from(command))
    };
    vec![
        of(
            "Draw a route, or finish it",
            vec![plain(Key::W)],
            PlanCommand::ToggleDraw,
        )
        .also("new path mission waypoints track"),
        of(
            "Way-point in the middle of the map",
            vec![plain(Key::I)],
            PlanCommand::AddWayPoint(None),
        )
        .also("waypoint add"),
        of(
            "Fly the route the other way",
            vec![plain(Key::X)],
            PlanCommand::Reverse,
        )
        .also("reverse turn round"),
        of(
            "Split the route at the way-point",
            vec![plain(Key::C)],
            PlanCommand::Split,
        )
        .also("waypoint cut"),
        of(
            "Take off at the start of the route, or fly past it",
            vec![],
            PlanCommand::ToggleTakeOff,
        )
        .also("takeoff launch"),
        of(
            "Return to the start at the end of the route, or not",
            vec![],
            PlanCommand::ToggleReturn,
        )
        .also("rtl home launch back"),
        of(
            "Land at the last way-point, or fly past it",
            vec![],
            PlanCommand::ToggleLanding,
        )
        .also("landing touch down"),
        of("Survey an area", vec![], PlanCommand::Mark(Purpose::Survey))
            .also("lawnmower grid pattern scan"),
        of(
            "Fly a corridor along the route",
            vec![],
            PlanCommand::CorridorAlong,
        ),
        of(
            "Show the heights of the route, or its uncertainty",
            vec![plain(Key::E)],
            PlanCommand::ToggleProfile,
        )
        .also("elevation terrain profile altitude"),
        of(
            "Delete the way-point",
            vec![],
            PlanCommand::DeleteWayPoint(None),
        ),
        of(
            "Rehearse the route: fly it in the simulation",
            vec![],
            PlanCommand::Rehearse(RehearseCommand::Start),
        )
        .also("simulate my sitl test trial"),
        of(
            "Watch the worst flight of the rehearsal",
            vec![],
            PlanCommand::Rehearse(RehearseCommand::Watch(None)),
        ),
        of(
            "Stop the rehearsal",
            vec![],
            PlanCommand::Rehearse(RehearseCommand::Stop),
        ),
        of("Duplicate the route", vec![], PlanCommand::DuplicateRoute),
        of("Delete the route", vec![], PlanCommand::DeleteRoute),
        of(
            "Plan the route of this flight",
            vec![],
            PlanCommand::TakeFlightRoute,
        ),
    ]
}

fn landmarks() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::Plan, label, shortcuts, Command::from(command))
    };
    vec![
        of(
            "Test how well the landmark is found",
            vec![plain(Key::D)],
            PlanCommand::AssessSelected,
        )
        .also("measure check recognise"),
        of(
            "Test all landmarks",
            vec![shift(Key::D)],
            PlanCommand::AssessAll,
        )
        .also("measure check recognise"),
        of("Stop testing", vec![], PlanCommand::StopAssessing),
        of(
            "Draw the outline of a landmark",
            vec![shift(Key::N)],
            PlanCommand::Mark(Purpose::Outline),
        ),
        of(
            "Mark a landmark as a point",
            vec![],
            PlanCommand::Mark(Purpose::Point),
        ),
        of(
            "Set the reference point of the landmark",
            vec![],
            PlanCommand::Mark(Purpose::Reference),
        ),
        of(
            "Duplicate the landmark",
            vec![control(Key::D)],
            PlanCommand::DuplicateLandmark,
        ),
    ]
}

fn trainings() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        let command = Command::from(PlanCommand::Train(command));
        entry(CommandGroup::Plan, label, shortcuts, command)
    };
    vec![
        of(
            "Train a detector for the landmark",
            vec![plain(Key::J)],
            TrainCommand::Selected,
        ),
        of(
            "Train detectors for all landmarks",
            vec![shift(Key::J)],
            TrainCommand::All,
        ),
        of(
            "Pause all trainings of detectors",
            vec![],
            TrainCommand::Pause(None),
        ),
        of(
            "Resume all trainings of detectors",
            vec![],
            TrainCommand::Resume(None),
        ),
        of(
            "Cancel all trainings of detectors",
            vec![],
            TrainCommand::Cancel(None),
        ),
    ]
}

fn ground() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::Plan, label, shortcuts, Command::from(command))
    };
    vec![
        of(
            "Show or hide where a fix would be had",
            vec![plain(Key::H)],
            PlanCommand::Heat(HeatCommand::Toggle),
        )
        .also("heat map heatmap coverage probability"),
        of(
            "Show blind areas",
            vec![shift(Key::H)],
            PlanCommand::Heat(HeatCommand::ToggleBlind),
        ),
        of(
            "Find a route: choose A and B",
            vec![shift(Key::F)],
            PlanCommand::Find(FindCommand::Begin),
        )
        .also("path planning avoid safest"),
        of(
            "Find the route from A to B",
            vec![],
            PlanCommand::Find(FindCommand::Start),
        ),
        of(
            "Mark a rally point",
            vec![shift(Key::I)],
            PlanCommand::Mark(Purpose::Rally),
        )
        .also("emergency landing alternate safe divert"),
        of(
            "Draw a no-fly area",
            vec![shift(Key::A)],
            PlanCommand::Mark(Purpose::NoFlyArea),
        )
        .also("geofence fence keep out forbidden restricted airspace zone"),
        of(
            "Cut a hole in a no-fly area",
            vec![],
            PlanCommand::Mark(Purpose::Hole),
        )
        .also("allowed part inside geofence inclusion opening"),
    ]
}
