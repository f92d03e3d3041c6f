//! The line that people lay over the ground, and what it measures.

use std::f64::consts::TAU;

use pilotage_core::frames::{GroundPoint, LocalFrame};

use crate::units::Units;

/// State of the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum LineStage {
    /// Clicks add points.
    #[default]
    Drawing,
    /// It has come to its end.
    Ended,
    /// It leads back to its first point.
    Closed,
}

/// Line over the ground.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Line {
    /// Its points, in the world of the map.
    pub(super) points: Vec<GroundPoint>,
    pub(super) stage: LineStage,
}

/// Leg of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MeasuredLeg {
    /// Length over the ground, metres.
    pub(super) length: f64,
    /// Course at its first point, radians clockwise from true north, from the map's north where that is unknown.
    pub(super) course: f64,
}

/// Measures of a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measures {
    pub(super) legs: Vec<MeasuredLeg>,
    /// Length of all legs, metres.
    pub(super) length: f64,
    /// Area that a closed line goes round, square metres.
    pub(super) area: Option<f64>,
}

impl MeasuredLeg {
    /// Leg between two points of a world with that frame, or of one that has no place on the globe.
    pub(super) fn between(
        frame: Option<&LocalFrame>,
        from: &GroundPoint,
        to: &GroundPoint,
    ) -> Self {
        let (length, course) = frame.map_or_else(
            || {
                let way = to.to_vector() - from.to_vector();
                (way.norm(), way.y.atan2(way.x).rem_euclid(TAU))
            },
            |frame| frame.distance_and_course(from, to),
        );
        Self { length, course }
    }

    /// Length and course in words.
    pub(super) fn words(&self, units: Units) -> String {
        // What rounds to a whole turn is north.
        let course = self.course.to_degrees().round() % 360.0;
        format!("{}, {course:03.0}°", units.way(self.length))
    }
}

impl Line {
    /// Does what a click asks for, at a place or on one of its own points.
    pub(super) fn click(&mut self, place: GroundPoint, own: Option<usize>) {
        let count = self.points.len();
        let is_drawing = self.stage == LineStage::Drawing;
        match own {
            Some(0) if count > 2 => self.close(),
            // So the second click of two that are one ends the line.
            Some(point) if point + 1 == count => self.end(),
            Some(_) => {}
            None if is_drawing => self.points.push(place),
            None => {
                *self = Self {
                    points: vec![place],
                    stage: LineStage::Drawing,
                }
            }
        }
    }

    /// Ends the line at its last point, if it has a leg.
    pub(super) fn end(&mut self) {
        if self.stage == LineStage::Drawing && self.points.len() > 1 {
            self.stage = LineStage::Ended;
        }
    }

    /// Whether it can be closed.
    pub(super) fn can_close(&self) -> bool {
        self.points.len() > 2 && self.stage != LineStage::Closed
    }

    /// Leads it back to its first point, if there is an area in between.
    pub(super) fn close(&mut self) {
        if self.can_close() {
            self.stage = LineStage::Closed;
        }
    }

    /// Takes its last point back, of a closed one its last leg; whether there was one.
    pub(super) fn take_back(&mut self) -> bool {
        let had_points = !self.points.is_empty();
        if self.stage != LineStage::Closed {
            self.points.pop();
        }
        self.stage = LineStage::Drawing;
        had_points
    }

    /// First and second point of every leg.
    pub(super) fn ends(&self) -> impl Iterator<Item = [GroundPoint; 2]> {
        let pairs = self.points.windows(2).map(|pair| [pair[0], pair[1]]);
        let closed = self.points.last().zip(self.points.first());
        let closed = closed.filter(|_| self.stage == LineStage::Closed);
        pairs.chain(closed.map(|(last, first)| [*last, *first]))
    }

    /// Its measures in a world with that frame, or in one that has no place on the globe.
    pub(super) fn measures(&self, frame: Option<&LocalFrame>) -> Measures {
        let legs = self
            .ends()
            .map(|[from, to]| MeasuredLeg::between(frame, &from, &to));
        let legs: Vec<MeasuredLeg> = legs.collect();
        let area = || match frame {
            Some(frame) => frame.area(&self.points),
            None => {
                0.5 * self
                    .ends()
                    .map(|[a, b]| a.north * b.east - a.east * b.north)
                    .sum::<f64>()
                    .abs()
            }
        };
        Measures {
            // The sum of none is -0.
            length: legs.iter().map(|leg| leg.length).sum::<f64>() + 0.0,
            area: (self.stage == LineStage::Closed).then(area),
            legs,
        }
    }
}

impl Measures {
    /// Every leg, the sum of all and the area, each in words.
    pub(super) fn rows(&self, units: Units) -> Vec<String> {
        let legs = self.legs.iter().enumerate();
        let legs = legs.map(|(index, leg)| format!("Leg {}: {}", index + 1, leg.words(units)));
        let whole = if self.area.is_some() {
            "Perimeter"
        } else {
            "Length"
        };
        let whole = format!("{whole}: {}", units.way(self.length));
        let whole = (!self.legs.is_empty()).then_some(whole);
        let area = self.area.map(|area| format!("Area: {}", units.area(area)));
        legs.chain(whole).chain(area).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 2]; 3] = [[0.0, 0.0], [30.0, 0.0], [30.0, 40.0]];

    fn drawn() -> Line {
        let mut line = Line::default();
        for [north, east] in CORNERS {
            line.click(GroundPoint::new(north, east), None);
        }
        line
    }

    #[test]
    fn a_second_click_at_the_last_point_ends_the_line_and_adds_none() {
        let mut line = drawn();
        line.click(line.points[2], Some(2));
        assert_eq!((line.points.len(), line.stage), (3, LineStage::Ended));
        let mut first = Line::default();
        first.click(GroundPoint::default(), None);
        first.click(GroundPoint::default(), Some(0));
        assert_eq!((first.points.len(), first.stage), (1, LineStage::Drawing));
        line.click(GroundPoint::new(5.0, 5.0), None);
        assert_eq!((line.points.len(), line.stage), (1, LineStage::Drawing));
    }

    #[test]
    fn a_click_at_the_first_point_closes_it_and_taking_back_opens_it_again() {
        let mut line = drawn();
        assert_eq!(line.measures(None).area, None);
        line.click(GroundPoint::default(), Some(0));
        let measures = line.measures(None);
        // A right triangle of 30 m and 40 m.
        assert_eq!((measures.length, measures.area), (120.0, Some(600.0)));
        let rows = measures.rows(Units::Metric);
        let closing = "Leg 3: 50.0 m, 233°".to_owned();
        assert_eq!(
            rows[2..],
            [closing, "Perimeter: 120.0 m".into(), "Area: 600 m²".into()]
        );
        line.take_back();
        assert_eq!((line.points.len(), line.stage), (3, LineStage::Drawing));
        line.take_back();
        assert_eq!(line.points.len(), 2);
    }

    #[test]
    fn what_rounds_to_a_whole_turn_is_north() {
        let to = GroundPoint::new(1000.0, -1.0);
        let leg = MeasuredLeg::between(None, &GroundPoint::default(), &to);
        assert_eq!(leg.words(Units::Aviation), "3281 ft, 000°");
    }
}
