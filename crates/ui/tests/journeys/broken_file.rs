use egui::vec2;
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::host::OpenedFile;

use super::log::eastward;
use super::support::{Rig, ScriptedHost, rig, rig_on};

#[test]
fn a_broken_file_is_refused_and_nothing_is_lost() {
    let mut rig = rig();
    let before = rig.state();
    rig.host().opening_fails = Some("flight.json, line 3: expected a number.".into());
    let broken = OpenedFile {
        path: "trip/flight.json".into(),
        content: b"{".to_vec().into(),
    };
    rig.host().opened.push(vec![broken]);
    rig.frames(4);
    let after = rig.state();
    let text = after["toasts"][0]["text"].as_str().unwrap_or_default();
    assert!(text.contains("line 3"), "{text}");
    assert!(
        after["toasts"][0]["title"]
            .as_str()
            .unwrap_or_default()
            .contains("flight.json")
    );
    for kept in ["run_steps", "landmarks", "flight", "time"] {
        assert_eq!(before[kept], after[kept], "{kept}");
    }
}

#[test]
fn what_is_said_of_it_lies_over_the_map_and_never_over_a_panel() {
    for size in [vec2(1440.0, 900.0), vec2(1280.0, 720.0), vec2(390.0, 844.0)] {
        let mut rig = rig_on(ScriptedHost::default(), size);
        rig.host().opening_fails = Some("flight.json, line 3: expected a number.".into());
        let broken = OpenedFile {
            path: "trip/flight.json".into(),
            content: b"{".to_vec().into(),
        };
        rig.host().opened.push(vec![broken]);
        rig.frames(4);
        for workspace in ["Replay", "Plan", "Learn"] {
            rig.open_tab(workspace);
            rig.frames(2);
            let map = rig.rect("/map/rect");
            let close = rig.harness.get_by_label("Dismiss notice").rect();
            let title = rig.harness.get_by_label_contains("not opened").rect();
            assert!(
                map.contains_rect(close),
                "{workspace}: {close:?} in {map:?}"
            );
            assert!(
                map.contains_rect(title),
                "{workspace}: {title:?} in {map:?}"
            );
        }
    }
}

#[test]
fn what_the_browser_could_not_read_is_told_alone_and_beside_what_opens() {
    let title = "No frame was taken of DJI_0001.MP4";
    let text = "This browser cannot decode it.";
    let film = || (title.to_owned(), text.to_owned());
    let is_told = |rig: &Rig| {
        let state = rig.state();
        let mut toasts = state["toasts"].as_array().expect("toasts").iter();
        toasts.any(|it| it["title"] == title && it["text"] == text && it["trouble"] == true)
    };
    let mut alone = rig();
    alone.host().troubles.push(film());
    alone.frames(2);
    assert!(is_told(&alone));

    // A flight of files takes earlier trouble off the screen, and not what was told of its own film.
    let mut beside = rig();
    beside.host().really_open = true;
    let log = OpenedFile {
        path: "east.log".into(),
        content: eastward().into(),
    };
    beside.host().opened.push(vec![log]);
    beside.host().troubles.push(film());
    beside.settle();
    assert_eq!(beside.state()["log"]["file"], "east.log");
    assert!(is_told(&beside));
}
