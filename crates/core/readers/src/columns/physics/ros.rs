//! Evidence that tells the axes of ROS from others.

/// Mean cosine between heading and course from which on an aircraft is one that flies where it looks.
pub(super) const AHEAD: f64 = 0.7;

/// Whether columns are called as ROS writes them to tables.
pub(in crate::columns) fn is_of_ros(names: &str) -> bool {
    let names = names.to_lowercase();
    [
        "orientation.",
        "field.",
        "angular_velocity.",
        "linear_acceleration.",
        "twist.",
        "pose.",
        // Trajectories of TUM, and the truth of EuRoC.
        "txtytz",
        "p_rs_r",
    ]
    .iter()
    .any(|word| names.contains(word))
}
