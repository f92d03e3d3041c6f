use pilotage_ui::host::OpenedFile;

use super::support::rig;

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
