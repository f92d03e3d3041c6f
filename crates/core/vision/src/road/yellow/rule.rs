//! The rule that makes roads of yellow paint.

use pilotage_raster::raster::{Raster, Rgba};

use super::blobs::{blobs, dilated};
use super::colour::hue_saturation_value;
use super::hough::{HoughAccumulator, LineSegment};
use crate::road::seen::{RoadPoint, RoadsSeen, SeenCrossing, along, outward};

/// Pixels between the points that stand for a line.
const STEP: f64 = 4.0;
/// Lines of which the longest are taken.
const LINES: usize = 8;

/// The limits of the rule; the default is `DeAngelo` 2016, eq. (2) and the text below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YellowLineRule {
    /// Hues of yellow, shares of the circle.
    pub hue: [f32; 2],
    /// Saturations of yellow.
    pub saturation: [f32; 2],
    /// Values of yellow.
    pub value: [f32; 2],
    /// Side of the square of the dilation, pixels.
    pub dilation: usize,
    /// Least major axis of a blob, pixels.
    pub major_axis: f64,
    /// Least and greatest minor axis of a blob, pixels.
    pub minor_axis: [f64; 2],
    /// Longest gap in a line, pixels.
    pub gap: f64,
    /// Shortest line, pixels.
    pub shortest: f64,
    /// Cosine of the angle above which two lines do not intersect.
    pub cosine: f64,
}

impl Default for YellowLineRule {
    fn default() -> Self {
        Self {
            hue: [0.099, 0.215],
            saturation: [0.060, 1.0],
            value: [0.730, 1.0],
            dilation: 5,
            major_axis: 350.0,
            minor_axis: [1.0, 45.0],
            gap: 20.0,
            shortest: 40.0,
            cosine: 0.8,
        }
    }
}

/// The outcome of the rule for one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct YellowLines {
    /// Dilated yellow pixels in long thin blobs.
    pub mask: Raster<bool>,
    /// Up to two lines that are not parallel, the longest first.
    pub lines: Vec<LineSegment>,
    /// Their intersection, if the angle between them is large enough, pixels.
    pub intersection: Option<[f64; 2]>,
}

impl YellowLineRule {
    /// Whether a pixel has the colour of the paint (eq. 2).
    pub fn is_yellow(&self, [red, green, blue, coverage]: Rgba) -> bool {
        let colour = hue_saturation_value([red, green, blue]);
        let within = |value: f32, [low, high]: [f32; 2]| (low..=high).contains(&value);
        coverage > 0
            && within(colour.hue, self.hue)
            && within(colour.saturation, self.saturation)
            && within(colour.value, self.value)
    }

    /// The yellow lines of a picture.
    pub fn lines(&self, picture: &Raster<Rgba>) -> YellowLines {
        let yellow = dilated(&picture.map(|pixel| self.is_yellow(pixel)), self.dilation);
        let mut mask = Raster::filled(picture.width(), picture.height(), false);
        for blob in blobs(&yellow) {
            let [least, greatest] = self.minor_axis;
            if blob.major_axis >= self.major_axis && (least..=greatest).contains(&blob.minor_axis) {
                for [x, y] in blob.pixels {
                    mask.set(x as usize, y as usize, true);
                }
            }
        }
        let table = HoughAccumulator::new(&mask);
        let mut all: Vec<LineSegment> = (table.peaks(LINES).iter())
            .flat_map(|peak| table.segments(peak, self.gap, self.shortest))
            .collect();
        all.sort_by(|a, b| b.length().total_cmp(&a.length()));
        let mut lines: Vec<LineSegment> = all.first().copied().into_iter().collect();
        let crossing = |first: &LineSegment| {
            let mut others = all.iter().skip(1);
            others.find(|l| l.cosine(first) < self.cosine).copied()
        };
        lines.extend(all.first().and_then(crossing));
        let intersection = match lines.as_slice() {
            [a, b] => a.intersection(b),
            _ => None,
        };
        YellowLines {
            mask,
            lines,
            intersection,
        }
    }
}

impl YellowLines {
    /// The lines as roads: points every four pixels, as wide as the paint, and the intersection.
    pub fn roads(&self) -> RoadsSeen {
        let mut roads = RoadsSeen::default();
        for line in &self.lines {
            let ([x, y], length) = (line.vector(), line.length());
            let steps = (length / STEP).floor() as usize;
            for step in 0..=steps {
                let share = step as f64 * STEP / length;
                let pixel = [line.from[0] + share * x, line.from[1] + share * y];
                roads.points.push(RoadPoint {
                    pixel,
                    direction: along(x, y),
                    width: self.width_at(pixel, [-y / length, x / length]),
                    probability: 1.0,
                });
            }
        }
        if let Some(pixel) = self.intersection {
            let ends = self.lines.iter().flat_map(|line| [line.from, line.to]);
            let away = ends.map(|end| [end[0] - pixel[0], end[1] - pixel[1]]);
            // A line that ends there leaves in one direction only.
            let arms = away.filter(|[x, y]| x.hypot(*y) > 2.0 * STEP);
            let mut directions: Vec<f64> = arms.map(|[x, y]| outward(x, y)).collect();
            directions.sort_by(f64::total_cmp);
            directions.dedup_by(|a, b| (*a - *b).abs() < 0.1);
            roads.crossings.push(SeenCrossing {
                pixel,
                directions,
                probability: 1.0,
            });
        }
        roads
    }

    /// Pixels of the mask across a place, along the unit vector (x, y).
    fn width_at(&self, [px, py]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
        let is_set = |step: f64| {
            let (column, row) = ((px + step * x).floor(), (py + step * y).floor());
            let inside = column >= 0.0
                && row >= 0.0
                && column < self.mask.width() as f64
                && row < self.mask.height() as f64;
            inside && self.mask.get(column as usize, row as usize)
        };
        let most = self.mask.width() + self.mask.height();
        let reach = |sign: f64| (1..most).take_while(|&i| is_set(sign * i as f64)).count();
        (1 + reach(1.0) + reach(-1.0)) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const PAINT: Rgba = [255, 170, 6, 255];
    const TAR: Rgba = [90, 90, 92, 255];

    #[test]
    fn traffic_yellow_passes_and_tar_grass_and_nothing_do_not() {
        let rule = YellowLineRule::default();
        assert!(rule.is_yellow(PAINT));
        for other in [
            TAR,
            [60, 110, 40, 255],
            [255, 255, 255, 255],
            [255, 170, 6, 0],
        ] {
            assert!(!rule.is_yellow(other), "{other:?}");
        }
    }

    /// Paint down column 300 and along row 200, 3 px wide, 5 px with what the dilation adds on either side.
    #[test]
    fn two_painted_lines_make_two_roads_and_a_crossing() {
        let picture = Raster::from_fn(640, 480, |x, y| {
            let painted = (299..=301).contains(&x) || (199..=201).contains(&y);
            if painted { PAINT } else { TAR }
        });
        // Both lines are one blob; its minor axis is that of a cross.
        let rule = YellowLineRule {
            minor_axis: [1.0, 1000.0],
            ..YellowLineRule::default()
        };
        let found = rule.lines(&picture);
        let [x, y] = found.intersection.expect("they cross");
        // All rows of the paint have equal votes.
        assert!(
            (x - 300.5).abs() <= 3.5 && (y - 200.5).abs() <= 3.5,
            "{x} {y}"
        );
        let roads = found.roads();
        let across = roads
            .points
            .iter()
            .filter(|p| (p.direction - FRAC_PI_2).abs() < 0.02);
        assert!(across.count() > 150);
        assert!(roads.points.iter().any(|p| (p.width - 7.0).abs() < 0.1));
        assert_eq!(roads.crossings[0].directions.len(), 4);
    }

    #[test]
    fn a_yellow_field_is_no_road() {
        let picture = Raster::from_fn(640, 480, |x, y| {
            let field = (100..500).contains(&x) && (100..400).contains(&y);
            if field { PAINT } else { TAR }
        });
        let found = YellowLineRule::default().lines(&picture);
        assert!(found.lines.is_empty() && found.intersection.is_none());
        assert_eq!(found.roads(), RoadsSeen::default());
    }

    #[test]
    fn one_line_crosses_nothing() {
        let picture = Raster::from_fn(640, 300, |x, y| {
            let painted = (y as f64 - 0.3 * x as f64 - 40.0).abs() < 2.0;
            if painted { PAINT } else { TAR }
        });
        let found = YellowLineRule::default().lines(&picture);
        assert_eq!((found.lines.len(), found.intersection), (1, None));
        // It falls by 0.3 per pixel to the right.
        let direction = found.roads().points[0].direction;
        assert!(
            (direction - (FRAC_PI_2 + 0.3_f64.atan())).abs() < 0.02,
            "{direction}"
        );
    }
}
