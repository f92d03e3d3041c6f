//! Purpose of places that are marked on the map.

/// Distance within which a click is on the last corner again, points.
pub const AGAIN: f32 = 4.0;
/// Distance within which a click on the first corner closes an outline, points.
pub const CLOSING: f32 = 12.0;
/// Fewest corners of an outline.
pub const FEWEST: usize = 3;

/// Purpose of the marked places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The outline of a new landmark.
    Outline,
    /// A new landmark of which only a point is known.
    Point,
    /// The reference point of the selected landmark.
    Reference,
    /// The area of a survey.
    Survey,
    /// A new rally point.
    Rally,
    /// A new area that must not be flown over.
    NoFlyArea,
    /// A new hole in such an area.
    Hole,
}

impl Purpose {
    /// Whether one click is all.
    pub fn is_point(self) -> bool {
        matches!(self, Self::Point | Self::Reference | Self::Rally)
    }

    /// Whether it is about an area that must not be flown over.
    pub fn is_about_no_fly(self) -> bool {
        matches!(self, Self::NoFlyArea | Self::Hole)
    }

    /// Advice on what to do, in words on the map.
    pub(super) fn advice(self, corners: usize) -> &'static str {
        match (self, corners) {
            (Self::Point, _) => "Click on the landmark",
            (Self::Reference, _) => "Click on the point that is measured",
            (Self::Rally, _) => "Click where the aircraft may land when it cannot go on",
            (Self::Survey, 0..3) => "Click the corners of the area one after the other",
            (Self::Outline, 0..3) => "Click its corners one after the other",
            (Self::NoFlyArea, 0..3) => "Click the corners of the area that must not be flown over",
            (Self::Hole, 0..3) => "Click the corners of the part in which one may fly",
            (Self::Outline | Self::Survey | Self::NoFlyArea | Self::Hole, _) => {
                "Enter or a click on the first corner closes it, Backspace takes a corner back"
            }
        }
    }
}
