//! A road of a map followed from place to place.

use std::sync::Arc;

use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::Gray;

use super::network::RoadNetwork;
use super::probability::{COARSEST_SEEN, RoadProbability, SEEN_GSD, probability_by};
use super::trace::RoadTrace;

/// Pixels along the side of the tiles that are looked at one by one.
const TILE: usize = 512;
/// Pixels around a tile that are looked at with it: the network sees some 45 m around.
const AROUND: usize = 96;
/// Longest way that is looked for: that much of the straight one, and so many metres.
const DETOUR: (f64, f64) = (1.5, 60.0);

/// Reason why no road was followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotFollowed {
    /// The places lie too far apart; the distance, metres.
    #[error("the places are {0:.0} m apart, and a road is followed for {farthest:.0} m at most; put a point in between", farthest = RoadFollowing::FARTHEST)]
    Far(f64),
    /// Pixels of the map are too coarse for roads; their size, metres.
    #[error("a pixel of the map shows {0:.1} m, and roads are seen up to {COARSEST_SEEN} m")]
    Coarse(f64),
    /// The map has no picture there.
    #[error("the map has no picture there")]
    NoPicture,
    /// No road joins the places; the share of the best way that is expected to lie on one.
    #[error("no road is seen that joins the places: {:.0} % of the best way look like one", 100.0 * .0)]
    NoRoad(f64),
}

/// Road that was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadOnGround {
    /// Places from the one end to the other, some 3 m apart, in the frame of the map.
    pub course: Vec<GroundPoint>,
    /// Median width, metres, where a road is seen.
    pub width: Option<f64>,
    /// Length of the longest stretch on which none is seen, metres.
    pub gap: f64,
}

/// Ground around two places, looked at for the road that joins them, piece by piece.
pub struct RoadFollowing {
    map: Arc<dyn Imagery>,
    network: RoadNetwork,
    ends: [GroundPoint; 2],
    window: Window,
    probability: Gray,
    has_picture: bool,
    /// Columns and rows at which the tiles begin that are left.
    left: Vec<(usize, usize)>,
    tiles: usize,
    trace: Option<RoadTrace>,
}

impl RoadFollowing {
    /// Greatest distance between the places, metres.
    pub const FARTHEST: f64 = 1_000.0;

    /// The ground that is looked at for a road between places; of one that is too long, as little of it as of none.
    ///
    /// It is that of all ways of at most one and a half times the straight one and 60 m: an ellipse around both places.
    pub fn window(ends: [GroundPoint; 2]) -> Window {
        let [from, to] = ends;
        let apart = from.distance(&to);
        let longest = if apart <= Self::FARTHEST {
            longest(ends)
        } else {
            apart
        };
        // Half the axes of the ellipse, and how far it reaches from its middle in each direction.
        let across = longest * longest - apart * apart;
        let reach = |along: f64| 0.5 * (across.max(0.0) + along * along).sqrt();
        let (north, east) = (reach(to.north - from.north), reach(to.east - from.east));
        let middle = GroundPoint::new(0.5 * (from.north + to.north), 0.5 * (from.east + to.east));
        let rect = GroundRect::centered(middle, 2.0 * north, 2.0 * east);
        Window::covering(&rect.grown(SEEN_GSD * AROUND as f64), SEEN_GSD)
    }

    /// Nothing looked at yet.
    ///
    /// # Errors
    /// If the places are too far apart, or the pixels of the map too coarse.
    pub fn new(map: Arc<dyn Imagery>, ends: [GroundPoint; 2]) -> Result<Self, NotFollowed> {
        let apart = ends[0].distance(&ends[1]);
        if apart > Self::FARTHEST {
            return Err(NotFollowed::Far(apart));
        }
        let gsd = map.native_gsd();
        if gsd > COARSEST_SEEN {
            return Err(NotFollowed::Coarse(gsd));
        }
        let window = Self::window(ends);
        // The margin is looked at with the tiles at the rim, and no place of its own.
        let begins = |size: usize| (AROUND..size.saturating_sub(AROUND)).step_by(TILE);
        let tiles =
            begins(window.height).flat_map(|row| begins(window.width).map(move |c| (c, row)));
        let left: Vec<(usize, usize)> = tiles
            .filter(|(column, row)| is_within(&window, (*column, *row), ends))
            .collect();
        Ok(Self {
            map,
            network: RoadNetwork::built_in(),
            ends,
            probability: Gray::filled(window.width, window.height, 0.0),
            window,
            has_picture: false,
            tiles: left.len(),
            left,
            trace: None,
        })
    }

    /// Pieces of the ground that are looked at, and those in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.tiles - self.left.len(), self.tiles)
    }

    /// Does the next piece of the work; whether there is more.
    pub fn advance(&mut self) -> bool {
        if let Some(begin) = self.left.pop() {
            self.look_at(begin);
            return true;
        }
        if let Some(trace) = &mut self.trace {
            return trace.advance();
        }
        let seen = RoadProbability {
            probability: std::mem::replace(&mut self.probability, Gray::filled(1, 1, 0.0)),
            scale: [1.0, 1.0],
        };
        let [from, to] = self.ends.map(|end| {
            let (x, y) = self.window.pixel_at(&end);
            [x, y]
        });
        let longest = longest(self.ends) / SEEN_GSD;
        self.trace = RoadTrace::new(seen, from, to, longest);
        self.trace.is_some()
    }

    /// Takes the probability of road of a tile.
    fn look_at(&mut self, (column, row): (usize, usize)) {
        let whole = self.window;
        let end = |begin: usize, size: usize| (begin + TILE + AROUND).min(size);
        let (left, top) = (column - AROUND, row - AROUND);
        let window = Window {
            north_edge: whole.north_edge - top as f64 * whole.gsd,
            west_edge: whole.west_edge + left as f64 * whole.gsd,
            gsd: whole.gsd,
            width: end(column, whole.width) - left,
            height: end(row, whole.height) - top,
        };
        let picture = self.map.window(&window);
        if picture.pixels().iter().all(|pixel| pixel[3] == 0) {
            return;
        }
        self.has_picture = true;
        let seen = probability_by(&self.network, &picture, whole.gsd).probability;
        for y in AROUND..(AROUND + TILE).min(window.height) {
            let from = &seen.row(y)[AROUND..(AROUND + TILE).min(window.width)];
            self.probability.row_mut(top + y)[column..column + from.len()].copy_from_slice(from);
        }
    }

    /// The road, once nothing is left to do. An end that is free to move and lies on it is put into its middle.
    ///
    /// # Errors
    /// If there is no picture, or no road that joins the places.
    pub fn road(self, is_free: [bool; 2]) -> Result<RoadOnGround, NotFollowed> {
        if !self.has_picture {
            return Err(NotFollowed::NoPicture);
        }
        let traced = self.trace.map(|trace| trace.traced(is_free));
        let traced = traced.ok_or(NotFollowed::NoPicture)?;
        // Rather a road than none, by what its pixels look like.
        if !traced.is_road() {
            return Err(NotFollowed::NoRoad(traced.on_road));
        }
        let place = |[x, y]: &[f64; 2]| self.window.ground_at(*x, *y);
        let mut course: Vec<GroundPoint> = traced.line.iter().map(place).collect();
        // Ends that stay are the very ones.
        let last = course.len() - 1;
        for (at, end) in [(0, self.ends[0]), (last, self.ends[1])] {
            if course[at].distance(&end) < 1e-6 {
                course[at] = end;
            }
        }
        Ok(RoadOnGround {
            course,
            width: traced.width.map(|width| width * SEEN_GSD),
            gap: traced.gap * SEEN_GSD,
        })
    }
}

/// Longest way that is looked for between places, metres.
fn longest([from, to]: [GroundPoint; 2]) -> f64 {
    DETOUR.0 * from.distance(&to) + DETOUR.1
}

/// Whether a way that is not too long passes the tile that begins at a column and row.
fn is_within(window: &Window, (column, row): (usize, usize), ends: [GroundPoint; 2]) -> bool {
    let half = 0.5 * TILE as f64;
    let middle = window.ground_at(column as f64 + half, row as f64 + half);
    // Each of the two distances is less by half a diagonal at most somewhere in the tile.
    let diagonal = 2.0 * half * std::f64::consts::SQRT_2 * window.gsd;
    middle.distance(&ends[0]) + middle.distance(&ends[1]) <= longest(ends) + diagonal
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::imagery::Blank;
    use pilotage_raster::raster::{Raster, Rgba};

    /// Lawn with a pale road of 7 m on a circle of 300 m around the origin, to the east of 350 m no picture.
    struct Ring;

    impl Imagery for Ring {
        fn name(&self) -> &'static str {
            "ring"
        }

        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 1e4, 700.0)
        }

        fn native_gsd(&self) -> f64 {
            0.3
        }

        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |x, y| {
                let place = window.ground_at(x as f64 + 0.5, y as f64 + 0.5);
                let grain = ((x * 7919 + y * 104_729 + x * y) % 13) as u8;
                if place.east > 350.0 {
                    [0; 4]
                } else if (place.distance(&GroundPoint::default()) - 300.0).abs() < 3.5 {
                    [128 + grain, 127 + grain, 126 + grain, 255]
                } else {
                    [72 + grain, 98 + grain, 58 + grain, 255]
                }
            })
        }
    }

    fn followed(
        map: Arc<dyn Imagery>,
        ends: [GroundPoint; 2],
    ) -> Result<RoadOnGround, NotFollowed> {
        let mut following = RoadFollowing::new(map, ends)?;
        while following.advance() {}
        following.road([true, false])
    }

    #[test]
    fn a_bent_road_is_followed_over_many_tiles_in_its_middle_with_its_width() {
        let ends = [GroundPoint::new(302.0, 0.0), GroundPoint::new(0.0, 300.0)];
        let tiles = RoadFollowing::new(Arc::new(Ring), ends).map(|it| it.progress().1);
        assert!(tiles.is_ok_and(|count| count >= 4), "{tiles:?}");
        let road = followed(Arc::new(Ring), ends).expect("a road");
        assert!(road.course.len() > 100, "{}", road.course.len());
        let off = |place: &GroundPoint| (place.distance(&GroundPoint::default()) - 300.0).abs();
        let mut offs: Vec<f64> = road.course.iter().map(off).collect();
        offs.sort_unstable_by(f64::total_cmp);
        let (median, most) = (offs[offs.len() / 2], offs[offs.len() - 1]);
        assert!(median < 0.3 && most < 1.5, "{median} m, {most} m");
        assert_eq!(road.course.last(), Some(&ends[1]));
        let width = road.width.expect("seen");
        assert!((width - 7.0).abs() < 1.5, "{width} m");
        assert!(road.gap < 1.0, "{}", road.gap);
    }

    #[test]
    fn what_is_not_followed_is_told_in_words() {
        let at = GroundPoint::new;
        let why =
            |map: Arc<dyn Imagery>, from, to| followed(map, [from, to]).map_err(|e| e.to_string());
        let lawn = why(Arc::new(Ring), at(0.0, 0.0), at(0.0, 120.0)).unwrap_err();
        assert!(
            lawn.starts_with("no road is seen that joins the places: "),
            "{lawn}"
        );
        let nothing = why(Arc::new(Ring), at(0.0, 700.0), at(0.0, 800.0));
        assert_eq!(nothing, Err("the map has no picture there".to_owned()));
        let far = why(Arc::new(Ring), at(0.0, 0.0), at(1234.0, 0.0));
        let words = "the places are 1234 m apart, and a road is followed for 1000 m at most; put a point in between";
        assert_eq!(far, Err(words.to_owned()));
        assert!(why(Arc::new(Blank), at(0.0, 0.0), at(10.0, 0.0)).is_err());
    }

    #[test]
    fn the_window_holds_all_ways_that_are_not_too_long_and_little_of_a_leg_that_is() {
        let ends = [GroundPoint::new(0.0, 0.0), GroundPoint::new(300.0, 400.0)];
        let rect = RoadFollowing::window(ends)
            .rect()
            .grown(-SEEN_GSD * AROUND as f64);
        let longest = longest(ends);
        for step in 0..720 {
            // By the angle around the middle: the farthest place of the ellipse there.
            let angle = f64::from(step) * 0.5_f64.to_radians();
            let place = |r: f64| GroundPoint::new(150.0 + r * angle.cos(), 200.0 + r * angle.sin());
            let over = |p: GroundPoint| p.distance(&ends[0]) + p.distance(&ends[1]);
            let (mut near, mut far) = (0.0, 1000.0);
            for _ in 0..50 {
                let r = 0.5 * (near + far);
                if over(place(r)) <= longest {
                    near = r;
                } else {
                    far = r;
                }
            }
            assert!(rect.grown(1e-6).contains(&place(near)), "{step}");
        }
        let far = RoadFollowing::window([ends[0], GroundPoint::new(0.0, 9000.0)]);
        assert!(far.height < 2 * AROUND + 10, "{far:?}");
    }
}
