//! Straight lines among set pixels, by Hough's transform.

use pilotage_raster::raster::Raster;

/// Steps of the angle over half a turn: 1° each.
const ANGLES: usize = 180;

/// Votes of set pixels for the straight lines x cos a + y sin a = r: a in whole degrees, r rounded to pixels, x and y
/// counted in columns and rows.
#[derive(Clone, Debug)]
pub struct HoughAccumulator {
    /// Votes of an angle one after the other, r from `-reach` to `reach`.
    votes: Vec<u32>,
    reach: usize,
    directions: Vec<(f32, f32)>,
    /// Pixels that voted, (column, row).
    pixels: Vec<[u32; 2]>,
    sides: [usize; 2],
}

/// A line that many pixels lie on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HoughPeak {
    /// Angle of the line's normal, degrees from right towards down, 0 to 179.
    pub degrees: usize,
    /// Distance of the line from the middle of the top-left pixel along the normal, pixels.
    pub distance: isize,
    /// Pixels on it.
    pub votes: u32,
}

/// A straight piece from end to end, pixels (x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSegment {
    /// Either end.
    pub from: [f64; 2],
    /// The other.
    pub to: [f64; 2],
}

impl LineSegment {
    /// From end to end, pixels.
    pub fn length(&self) -> f64 {
        let [x, y] = self.vector();
        x.hypot(y)
    }

    /// The vector (x, y) from end to end.
    pub fn vector(&self) -> [f64; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    /// Cosine of the angle between two lines, 0 to 1; 1 where either is a point.
    pub fn cosine(&self, other: &Self) -> f64 {
        let ([ax, ay], [bx, by]) = (self.vector(), other.vector());
        let norm = self.length() * other.length();
        if norm > 0.0 {
            ((ax * bx + ay * by) / norm).abs()
        } else {
            1.0
        }
    }

    /// Intersection of the lines through both, be it beyond their ends; `None` if they are parallel.
    /// `DeAngelo` 2016, eqs (3) and (4): H = (a × b) × (c × d) in homogeneous coordinates.
    ///
    /// ```
    /// use pilotage_vision::road::yellow::LineSegment;
    ///
    /// let falling = LineSegment { from: [0.0, 0.0], to: [10.0, 10.0] };
    /// let rising = LineSegment { from: [0.0, 10.0], to: [10.0, 0.0] };
    /// assert_eq!(falling.intersection(&rising), Some([5.0, 5.0]));
    /// assert_eq!(falling.intersection(&falling), None);
    /// ```
    pub fn intersection(&self, other: &Self) -> Option<[f64; 2]> {
        let line = |s: &Self| cross([s.from[0], s.from[1], 1.0], [s.to[0], s.to[1], 1.0]);
        let [x, y, w] = cross(line(self), line(other));
        (w != 0.0).then(|| [x / w, y / w])
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

impl HoughAccumulator {
    /// The votes of all set pixels.
    pub fn new(mask: &Raster<bool>) -> Self {
        let mut pixels = Vec::new();
        for row in 0..mask.height() {
            let set = mask.row(row).iter().enumerate().filter(|(_, set)| **set);
            pixels.extend(set.map(|(column, _)| [column as u32, row as u32]));
        }
        let reach = mask.width() + mask.height();
        let directions: Vec<(f32, f32)> = (0..ANGLES)
            .map(|degrees| {
                let (sin, cos) = libm::sincos((degrees as f64).to_radians());
                (cos as f32, sin as f32)
            })
            .collect();
        let mut votes = vec![0; ANGLES * (2 * reach + 1)];
        for (of_angle, &direction) in votes.chunks_exact_mut(2 * reach + 1).zip(&directions) {
            for &pixel in &pixels {
                of_angle[(reach as isize + distance(pixel, direction)) as usize] += 1;
            }
        }
        Self {
            votes,
            reach,
            directions,
            pixels,
            sides: [mask.width(), mask.height()],
        }
    }

    /// Votes for a line.
    pub fn votes(&self, degrees: usize, distance: isize) -> u32 {
        self.votes[degrees * (2 * self.reach + 1) + (self.reach as isize + distance) as usize]
    }

    /// Up to `most` lines, those with most votes first, each with at least half of the votes of the first. Around each,
    /// lines within a fiftieth of the table's sides are passed over.
    pub fn peaks(&self, most: usize) -> Vec<HoughPeak> {
        let diagonal = (self.sides[0] as f64).hypot(self.sides[1] as f64);
        let near = (2.0 * diagonal / 100.0).ceil() as isize;
        let near_degrees = (ANGLES as f64 / 100.0).ceil() as isize;
        let mut left = self.votes.clone();
        let row_length = 2 * self.reach + 1;
        let mut found: Vec<HoughPeak> = Vec::new();
        while found.len() < most {
            let Some((at, &votes)) =
                (left.iter().enumerate()).max_by_key(|(at, v)| (**v, usize::MAX - at))
            else {
                break;
            };
            if votes == 0 || found.first().is_some_and(|first| 2 * votes < first.votes) {
                break;
            }
            let peak = HoughPeak {
                degrees: at / row_length,
                distance: (at % row_length) as isize - self.reach as isize,
                votes,
            };
            found.push(peak);
            for step in -near_degrees..=near_degrees {
                // Past half a turn a line comes back with its distance of the other sign.
                let degrees = peak.degrees as isize + step;
                let is_past = !(0..ANGLES as isize).contains(&degrees);
                let middle = if is_past {
                    -peak.distance
                } else {
                    peak.distance
                };
                let row = degrees.rem_euclid(ANGLES as isize) as usize * row_length;
                let reach = self.reach as isize;
                let (low, high) = ((middle - near).max(-reach), (middle + near).min(reach));
                if low <= high {
                    left[row + (low + reach) as usize..=row + (high + reach) as usize].fill(0);
                }
            }
        }
        found
    }

    /// Pieces of a line: its pixels, cut where more than `gap` pixels are missing; those of at least `shortest` pixels.
    pub fn segments(&self, peak: &HoughPeak, gap: f64, shortest: f64) -> Vec<LineSegment> {
        let direction = self.directions[peak.degrees];
        let on_line = |p: &&[u32; 2]| distance(**p, direction) == peak.distance;
        let (cos, sin) = (f64::from(direction.0), f64::from(direction.1));
        let place = |p: &[u32; 2]| -sin * f64::from(p[0]) + cos * f64::from(p[1]);
        let mut places: Vec<f64> = self.pixels.iter().filter(on_line).map(place).collect();
        places.sort_by(f64::total_cmp);
        let at = |along: f64| {
            // Columns and rows count from the middle of the first pixel.
            let r = peak.distance as f64;
            [r * cos - along * sin + 0.5, r * sin + along * cos + 0.5]
        };
        let mut segments = Vec::new();
        for piece in places.chunk_by(|a, b| b - a <= gap) {
            let segment = LineSegment {
                from: at(piece[0]),
                to: at(piece[piece.len() - 1]),
            };
            if segment.length() >= shortest {
                segments.push(segment);
            }
        }
        segments
    }
}

/// Distance along a direction, rounded to the even of two equally near.
fn distance([x, y]: [u32; 2], (cos, sin): (f32, f32)) -> isize {
    (x as f32 * cos + y as f32 * sin).round_ties_even() as isize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The set pixels of row 8 vote for 90° at distance 8; those of the falling diagonal for 135° at distance 0.
    #[test]
    fn lines_get_the_votes_of_their_pixels() {
        let mask = Raster::from_fn(60, 40, |x, y| y == 8 || (x == y && y > 12));
        let table = HoughAccumulator::new(&mask);
        assert_eq!(table.votes(90, 8), 60);
        assert_eq!(table.votes(135, 0), 28); // 27 of the diagonal, and (8, 8).
        let peaks = table.peaks(4);
        assert_eq!(
            peaks[0],
            HoughPeak {
                degrees: 90,
                distance: 8,
                votes: 60
            }
        );
        assert!(peaks.iter().all(|p| p.votes >= 30), "{peaks:?}");
    }

    #[test]
    fn a_line_is_cut_at_long_gaps() {
        let mask = Raster::from_fn(200, 9, |x, y| {
            y == 4 && (x < 50 || (60..110).contains(&x) || (140..170).contains(&x))
        });
        let table = HoughAccumulator::new(&mask);
        let segments = table.segments(&table.peaks(1)[0], 20.0, 40.0);
        assert_eq!(segments.len(), 1);
        let mut ends = [segments[0].from, segments[0].to];
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!((ends[0][0] - 0.5).abs() < 1e-4 && (ends[1][0] - 109.5).abs() < 1e-4);
        assert!((ends[0][1] - 4.5).abs() < 1e-4, "{ends:?}");
    }
}
