//! Airspeeds that are none: without a healthy sensor `ArduPilot` sends the receiver's ground speed in their place.

use super::super::{Log, Topic, TopicName};

/// `MAV_AUTOPILOT` of `ArduPilot`.
const ARDUPILOT: f64 = 3.0;
/// Message that has the same airspeed, of links by satellite.
const BY_SATELLITE: &str = "HIGH_LATENCY2";
/// Speed over ground from which on a row tells the two apart, m/s.
const MOVING: f64 = 1.0;
/// Difference of two numbers that are the same one, m/s: a receiver's is rounded to 0.01.
const SAME: f64 = 0.02;
/// Share of the rows that have to be the same, and the fewest of them.
const MOST: f64 = 0.95;
const FEWEST: usize = 20;

/// Marks the airspeed of `VFR_HUD` as not measured where it is the receiver's ground speed, and says so: as
/// `GCS_MAVLINK::vfr_hud_airspeed` of `ArduPilot` returns it without a healthy sensor. Of vehicles with `AIRSPEED` messages,
/// which come of a sensor, nothing is marked.
pub(super) fn mark_ground_speed(log: &mut Log) {
    let huds = log.topics.iter().filter(|t| {
        // The message by satellite has its airspeed from the same function.
        t.name.name == "VFR_HUD" || t.name.name == BY_SATELLITE
    });
    let marked: Vec<TopicName> = huds
        .filter(|hud| is_ground_speed(log, hud))
        .map(|hud| hud.name.clone())
        .collect();
    for topic in &marked {
        log.report.remark(format!(
            "{topic}.airspeed is the receiver's ground speed, which ArduPilot sends where no airspeed sensor works: it is no \
             airspeed"
        ));
        let by_satellite = TopicName {
            name: BY_SATELLITE.to_owned(),
            ..topic.clone()
        };
        let others = Some(by_satellite).filter(|other| !marked.contains(other));
        for topic in others.into_iter().chain([topic.clone()]) {
            log.not_measured.push((topic, "airspeed".to_owned()));
        }
    }
}

/// Whether the airspeeds of a topic are the ground speeds that the receiver of the same vehicle has before or behind them, or
/// between both; where the log has no messages of the receiver, those of the same messages.
fn is_ground_speed(log: &Log, hud: &Topic) -> bool {
    let beside = |name: &str| {
        log.topic(&TopicName {
            name: name.to_owned(),
            instance: hud.name.instance,
        })
    };
    let autopilots = beside("HEARTBEAT").and_then(|topic| topic.values("autopilot"));
    let is_ardupilot = autopilots.is_some_and(|all| all.contains(&ARDUPILOT));
    if !is_ardupilot || beside("AIRSPEED").is_some_and(|topic| !topic.is_empty()) {
        return false;
    }
    let (Some(airspeeds), Some(own)) = (hud.values("airspeed"), hud.values("groundspeed")) else {
        return false;
    };
    let receiver = beside("GPS_RAW_INT").filter(|gps| !gps.is_empty());
    let receiver = receiver.and_then(|gps| Some((&gps.times, gps.values("vel")?)));
    if receiver.is_some() && hud.name.name == BY_SATELLITE {
        // Its fifths of m/s are too coarse for that; `VFR_HUD` tells.
        return false;
    }
    let (mut moving, mut same) = (0_usize, 0_usize);
    for ((time, airspeed), own) in hud.times.iter().zip(airspeeds).zip(own) {
        let (least, most) = match &receiver {
            Some((times, speeds)) => {
                let after = times.partition_point(|t| t <= time);
                let Some(before) = after.checked_sub(1).and_then(|at| speeds.get(at)) else {
                    continue;
                };
                let next = speeds.get(after).unwrap_or(before);
                (before.min(*next), before.max(*next))
            }
            None => (own, own),
        };
        if least > MOVING {
            moving += 1;
            same += usize::from((least - SAME..=most + SAME).contains(&airspeed));
        }
    }
    moving >= FEWEST && same as f64 >= MOST * moving as f64
}
