use egui::vec2;
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::host::OpenedFile;

use super::support::{ScriptedHost, rig, rig_on};

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
