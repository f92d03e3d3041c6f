use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::support::rig;

#[test]
fn a_command_is_found_by_its_letters_and_runs() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    assert_eq!(rig.state()["dialogs"]["palette"], true);
    rig.harness.event(egui::Event::Text("aviation".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    let state = rig.state();
    assert_eq!(state["units"], "Aviation");
    assert_eq!(state["dialogs"]["palette"], false);
}

#[test]
fn letters_and_enter_that_arrive_in_one_frame_run_what_they_name() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("aviation".into()));
    rig.key(Key::Enter);
    let state = rig.state();
    assert_eq!(state["units"], "Aviation");
    assert_eq!(state["dialogs"]["palette"], false);
}

#[test]
fn letters_typed_before_the_palette_is_on_screen_are_no_shortcuts() {
    let mut rig = rig();
    let before = rig.state()["loop"].clone();
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    rig.harness.key_press(Key::L);
    rig.frames(1);
    rig.harness.key_press(Key::L);
    rig.frames(2);
    let state = rig.state();
    assert_eq!(state["dialogs"]["palette"], true);
    assert_eq!(state["loop"], before);
}

#[test]
fn arrows_choose_in_the_palette_and_escape_closes_it() {
    let mut rig = rig();
    let before = rig.state();
    rig.key(Key::P);
    rig.key(Key::ArrowDown);
    rig.key(Key::ArrowDown);
    rig.key(Key::Escape);
    let state = rig.state();
    assert_eq!(state["dialogs"]["palette"], false);
    assert_eq!(state["time"], before["time"]);
}

#[test]
fn a_picture_is_georeferenced_by_whoever_searches_for_that_word() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("georeference photo".into()));
    rig.frames(2);
    let none = rig.harness.query_by_label_contains("No command found");
    assert!(none.is_none());
    let open = rig
        .harness
        .query_by_label_contains("Open a flight, map, mission");
    assert!(open.is_some());
}

#[test]
fn generic_landmarks_are_found_where_they_are_chosen_and_letters_from_anywhere_find_nothing() {
    for (words, found) in [
        ("generic landmark", "Filter settings"),
        ("qwerty", "No command found"),
    ] {
        let mut rig = rig();
        rig.key_with(Modifiers::COMMAND, Key::K);
        rig.harness.event(egui::Event::Text(words.into()));
        rig.frames(2);
        assert!(
            rig.harness.query_all_by_label_contains(found).count() > 0,
            "{words}"
        );
    }
}

#[test]
fn what_can_do_nothing_says_why_and_does_nothing() {
    for (words, label, reason) in [
        ("redo", "Redo", "Nothing to redo"),
        ("next bookmark", "Next bookmark", "No bookmark"),
        ("plot attitude", "Plot the attitude", "No log is open"),
        ("stop study", "Stop the study", "No study is under way"),
        (
            "delete point road",
            "Delete the point of the road",
            "No point of a road is selected",
        ),
    ] {
        let mut rig = rig();
        rig.key_with(Modifiers::COMMAND, Key::K);
        rig.harness.event(egui::Event::Text(words.into()));
        rig.frames(2);
        let row = format!("{label} ({reason})");
        assert!(rig.harness.query_by_label(&row).is_some(), "{row}");
        rig.key(Key::Enter);
        assert_eq!(rig.state()["dialogs"]["palette"], true, "{row}");
    }
}

#[test]
fn a_thing_is_drawn_before_its_files_are_and_found_by_the_words_of_others() {
    for (words, first, then) in [
        (
            "route",
            "Draw a route, or finish it",
            "Export the route as KML",
        ),
        ("road", "Draw and edit roads", "Delete the road"),
        ("geofence", "Draw a no-fly area", "Draw a no-fly area"),
        ("jamming", "Try a GPS outage", "Try a GPS outage"),
    ] {
        let mut rig = rig();
        rig.key_with(Modifiers::COMMAND, Key::K);
        rig.harness.event(egui::Event::Text(words.into()));
        rig.frames(2);
        let top = |label: &str| {
            let rows = rig.harness.query_all_by_label_contains(label);
            let mut tops = rows.map(|row| row.rect()).filter(|it| it.width() > 400.0);
            tops.next().map(|it| it.top())
        };
        assert!(top(first).is_some() && top(first) <= top(then), "{words}");
    }
}

#[test]
fn the_list_is_as_long_again_once_letters_are_taken_back() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    for words in ["speed", " 0.25"] {
        rig.harness.event(egui::Event::Text(words.into()));
        rig.frames(4);
    }
    for _ in 0..5 {
        rig.key(Key::Backspace);
    }
    rig.frames(4);
    rig.harness.get_by_label("Speed 4×").click();
    rig.frames(3);
    assert_eq!(
        rig.state()["speed"],
        4.0,
        "a row that has no room is not hit"
    );
}

/// The command that these letters find, chosen.
fn choose(rig: &mut super::support::Rig, letters: &str) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text(letters.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(3);
}

#[test]
fn the_selected_landmark_is_deleted_from_the_palette_and_none_where_none_is_selected() {
    let mut rig = rig();
    let count = |rig: &super::support::Rig| {
        let landmarks = rig.state()["landmarks"].clone();
        landmarks.as_array().map(Vec::len).expect("landmarks")
    };
    let before = count(&rig);
    assert!(before > 1);
    choose(&mut rig, "delete the landmark");
    assert_eq!(count(&rig), before, "none is selected");
    rig.key(Key::Escape);
    rig.key(Key::F);
    rig.frames(2);
    let barn = rig.state()["landmarks"][0].clone();
    let middle = |one: &str, other: &str| {
        let metres = |side: &str| barn[side].as_f64().expect("metres");
        0.5 * (metres(one) + metres(other))
    };
    super::plan::click(&mut rig, middle("north", "south"), middle("east", "west"));
    rig.frames(3);
    let selected = rig.state()["selection"].clone();
    assert!(selected.is_number(), "{selected}");
    choose(&mut rig, "delete the landmark");
    assert_eq!(count(&rig), before - 1);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(rig.state()["selection"], selected);
    assert_eq!(count(&rig), before);
}
