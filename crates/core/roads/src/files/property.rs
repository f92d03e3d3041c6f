//! Properties by which lines of GeoJSON tell of roads.

/// Property of a line of GeoJSON with the class of a road, by the names of OpenStreetMap.
pub const HIGHWAY: &str = "highway";

/// Property of such a line with the width of the road, metres.
pub const WIDTH: &str = "width_m";
