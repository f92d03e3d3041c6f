//! Files about places that are far from the mission.

/// Farthest from the mission's origin that a file may lie, metres: beyond, the plane on which a
/// mission is planned is no longer the ground.
pub const FARTHEST: f64 = 100e3;

/// Complaint about a file from farther away.
pub fn too_far(name: &str) -> String {
    format!(
        "{name}: it lies over {:.0} km from the map that is open. Open a map of that place first, \
         or drop both together",
        FARTHEST / 1e3
    )
}
