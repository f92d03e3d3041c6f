//! A flight with more camera pictures than the page keeps.

use egui::{Key, Vec2};
use pilotage_jobs::Job;

use super::support::{Rig, ScriptedHost, rig_on};

/// Indices of the frames whose pictures were asked for once more.
fn fetched(rig: &mut Rig) -> Vec<usize> {
    let of = |(_, job): &(u64, Job)| match job {
        Job::FramePicture(order) => Some(order.index),
        _ => None,
    };
    rig.host().jobs.iter().filter_map(of).collect()
}

#[test]
fn a_picture_that_was_let_go_of_is_fetched_again_where_people_look_and_only_there() {
    let host = ScriptedHost {
        padding: 2 << 20,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.settle();
    assert_eq!(rig.state()["pictures"], 120, "all were told");
    assert_eq!(fetched(&mut rig), [0; 0], "those at the cursor are here");
    rig.key(Key::End);
    rig.settle();
    let asked = fetched(&mut rig);
    assert!(asked.contains(&119), "{asked:?}");
    assert!(asked.iter().all(|index| *index >= 118), "{asked:?}");
    let drawn = rig.state()["drawn"]["camera"].clone();
    let (cursor, content) = (drawn["cursor"].as_f64(), drawn["content"].as_f64());
    assert!(
        cursor
            .zip(content)
            .is_some_and(|(a, b)| (a - b).abs() < 0.6),
        "{drawn}"
    );
    rig.settle();
    assert_eq!(
        fetched(&mut rig),
        asked,
        "nothing is fetched twice while nobody moves"
    );
    // Back to the beginning, which is gone by now or still here: either way it is shown.
    rig.key(Key::Home);
    rig.settle();
    let drawn = rig.state()["drawn"]["camera"].clone();
    assert!(
        drawn["content"].as_f64().is_some_and(|time| time < 1.0),
        "{drawn}"
    );
}
