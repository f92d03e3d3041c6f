//! Words in the names of topics: of vehicles, of cameras, of what is wished.

/// Words of topics that say where the vehicle shall go.
const WISHED: [&str; 6] = ["setpoint", "target", "goal", "desired", "reference", "cmd"];
/// Words of topics of what the vehicle carries, whose axes are its own.
const GIMBAL: &str = "gimbal";
const CAMERA: &str = "camera";
/// Parts of words that are names of vehicles.
const VEHICLES: [&str; 8] = [
    "uav", "drone", "copter", "plane", "vehicle", "aircraft", "robot", "quad",
];
/// Programs of autopilots: the words before theirs are names of vehicles.
const AUTOPILOTS: [&str; 2] = ["mavros", "fmu"];

/// Thing that a topic tells of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TopicSubject {
    /// The vehicle.
    Vehicle,
    /// A camera on board.
    Camera,
    /// Something else: what is wished, a gimbal.
    Other,
}

/// The first word of a topic that has several, between slashes: `uav1` of `/uav1/gps/fix`; empty of others.
pub(crate) fn first_word(name: &str) -> &str {
    let words = name.trim_start_matches('/').split_once('/');
    words.map_or("", |(first, _)| first)
}

/// Whether a word is the name of a vehicle: `camera_drone`.
pub(super) fn names_vehicle(word: &str) -> bool {
    let word = word.to_lowercase();
    VEHICLES.iter().any(|vehicle| word.contains(vehicle))
}

/// Whether the word behind the first one is that of an autopilot's program.
pub(super) fn is_of_autopilot(name: &str) -> bool {
    let second = name.trim_start_matches('/').split('/').nth(1);
    second.is_some_and(|word| AUTOPILOTS.contains(&word))
}

/// Subject of a topic by its name.
pub(crate) fn subject(name: &str) -> TopicSubject {
    let parts: Vec<&str> = name.split('/').collect();
    let own = parts.iter().rposition(|part| AUTOPILOTS.contains(part));
    let parts = &parts[own.unwrap_or(0)..];
    let has = |parts: &[&str], wanted: &str| {
        let mut words = parts.iter().flat_map(|part| words(part));
        words.any(|word| is_word(word, wanted))
    };
    let of_camera = |part: &&str| {
        let last = words(part).last().unwrap_or_default();
        has(&[*part], CAMERA) && !names_vehicle(last)
    };
    if has(parts, GIMBAL) || WISHED.iter().any(|wished| has(parts, wished)) {
        TopicSubject::Other
    } else if parts.iter().any(of_camera) {
        TopicSubject::Camera
    } else {
        TopicSubject::Vehicle
    }
}

/// Words of a part of a topic's name.
fn words(part: &str) -> impl Iterator<Item = &str> {
    part.split(|letter: char| !letter.is_alphanumeric())
}

/// Whether a word is the wanted one: alone, of several, or with a number or another word behind it (`camera1`, `targetPose`).
fn is_word(word: &str, wanted: &str) -> bool {
    let Some((start, rest)) = word.split_at_checked(wanted.len()) else {
        return false;
    };
    let is_over = !rest.starts_with(|letter: char| letter.is_lowercase()) || rest == "s";
    start.eq_ignore_ascii_case(wanted) && is_over
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_topics_count_where_they_are_whole_and_no_vehicles() {
        for (name, expected) in [
            ("/mavros/setpoint_position/local", TopicSubject::Other),
            ("/mavros/setpoint_velocity/cmd_vel", TopicSubject::Other),
            ("/targetPose", TopicSubject::Other),
            ("/goals/pose", TopicSubject::Other),
            ("/gimbal/camera/imu", TopicSubject::Other),
            ("/fmu/out/vehicle_attitude_setpoint", TopicSubject::Other),
            ("/camera/imu", TopicSubject::Camera),
            ("/front_camera2/imu", TopicSubject::Camera),
            ("/camera_drone/mavros/imu/data", TopicSubject::Vehicle),
            ("/target/mavros/imu/data", TopicSubject::Vehicle),
            ("/camera_drone/imu", TopicSubject::Vehicle),
            ("/camera_drone/camera/imu", TopicSubject::Camera),
            ("/drone_camera/imu", TopicSubject::Camera),
            ("/drone_target/pose", TopicSubject::Other),
            ("/cameraman/imu", TopicSubject::Vehicle),
            ("/mavros/imu/data", TopicSubject::Vehicle),
        ] {
            assert_eq!(subject(name), expected, "{name}");
        }
    }
}
