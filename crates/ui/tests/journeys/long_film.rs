//! A flight with many camera pictures: they come where people look, and only there.

use egui::{Key, Vec2};
use pilotage_jobs::Job;

use super::support::{Rig, ScriptedHost, rig_on};

/// Indices of the frames whose pictures were asked for.
fn asked(rig: &mut Rig) -> Vec<usize> {
    let of = |(_, job): &(u64, Job)| match job {
        Job::FramePicture(order) => Some(order.index),
        _ => None,
    };
    rig.host().jobs.iter().filter_map(of).collect()
}

/// Distance in time between the cursor and what the camera view draws, seconds.
fn behind(rig: &Rig) -> f64 {
    let drawn = rig.state()["drawn"]["camera"].clone();
    let (cursor, content) = (drawn["cursor"].as_f64(), drawn["content"].as_f64());
    let pair = cursor.zip(content).unwrap_or_else(|| panic!("{drawn}"));
    (pair.0 - pair.1).abs()
}

#[test]
fn a_picture_is_asked_for_where_people_look_once_and_nowhere_else() {
    let mut rig = rig_on(ScriptedHost::default(), Vec2::new(1440.0, 900.0));
    rig.settle();
    assert_eq!(rig.state()["pictures"], 120, "all were told");
    let first = asked(&mut rig);
    assert!(first.iter().all(|index| *index < 4), "{first:?}");
    rig.key(Key::End);
    rig.settle();
    let new: Vec<usize> = asked(&mut rig).split_off(first.len());
    assert!(new.contains(&119), "{new:?}");
    assert!(new.iter().all(|index| *index >= 116), "{new:?}");
    assert!(behind(&rig) < 0.6);
    let all = asked(&mut rig);
    rig.settle();
    assert_eq!(asked(&mut rig), all, "nothing while nobody moves");
    rig.key(Key::Home);
    rig.settle();
    assert!(behind(&rig) < 1.0);
    assert_eq!(asked(&mut rig), all, "those at the beginning are here");
}
