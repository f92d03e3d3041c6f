//! Purpose of places that are marked on the map.

/// Distance within which a click is on the last corner again, points.
pub const AGAIN: f32 = 4.0;

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
}

impl Purpose {
    /// Whether one click is all.
    pub fn is_point(self) -> bool {
        matches!(self, Self::Point | Self::Reference | Self::Rally)
    }

    /// Advice on what to do, in words on the map.
    pub(super) fn advice(self, corners: usize) -> &'static str {
        match (self, corners) {
            (Self::Point, _) => "Click on the landmark",
            (Self::Reference, _) => "Click on the point that is measured",
            (Self::Rally, _) => "Click where the aircraft may land when it cannot go on",
            (Self::Survey, 0..3) => "Click the corners of the area one after the other",
            (Self::Outline, 0..3) => "Click its corners one after the other",
            (Self::Outline | Self::Survey, _) => {
                "Enter or a double click ends it, Backspace takes a corner back"
            }
        }
    }
}
