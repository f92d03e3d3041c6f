//! Placement of the pixels of a picture on the ground, there and back.

use nalgebra::{Matrix2, Point2, Vector2};

use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_base::georeference::{Georeference, GeoreferenceError, GroundFromPixel};

/// Points along each side of a picture from which its extent is taken.
const POINTS_PER_SIDE: usize = 32;
/// Farthest from the world's origin that a map of the world is used, metres.
const REACH: f64 = 5e6;
/// Ground of a picture that lies nowhere near: none.
const NOTHING: GroundRect = GroundRect {
    south: 0.0,
    north: 0.0,
    west: 0.0,
    east: 0.0,
};

/// A map between the pixels of a picture (centres at half integers) and the ground.
#[derive(Clone, Debug)]
pub struct Placement {
    kind: PlacementKind,
    /// Size of the picture, pixels.
    size: (usize, usize),
    /// The same map made affine around the middle of the picture.
    affine: GroundFromPixel,
    /// Pixels of once around the Earth.
    turn: Option<Vector2<f64>>,
}

#[derive(Clone, Debug)]
enum PlacementKind {
    /// Affine by nature; with the inverse of its matrix.
    Affine(GroundFromPixel, Matrix2<f64>),
    /// Through a reference system on the globe.
    Globe(Georeference, LocalFrame),
}

impl Placement {
    /// A picture of the given size under an affine map; `None` if that does not span an area.
    pub fn affine(map: GroundFromPixel, width: usize, height: usize) -> Option<Self> {
        Some(Self {
            kind: PlacementKind::Affine(map, map.matrix.try_inverse()?),
            size: (width, height),
            affine: map,
            turn: None,
        })
    }

    /// A picture of the given size where its georeference puts it, in the world frame `frame`;
    /// exact, however large the picture.
    pub fn on_globe(
        georeference: Georeference,
        frame: LocalFrame,
        width: usize,
        height: usize,
    ) -> Result<Self, GeoreferenceError> {
        let affine = georeference.in_world(&frame, width, height)?;
        Ok(Self {
            kind: PlacementKind::Globe(georeference, frame),
            size: (width, height),
            affine,
            turn: georeference.turn(),
        })
    }

    /// The georeference by the picture's side file or its own keys, if it has a place on the globe.
    pub fn georeference(&self) -> Option<&Georeference> {
        match &self.kind {
            PlacementKind::Globe(georeference, _) => Some(georeference),
            PlacementKind::Affine(..) => None,
        }
    }

    /// Size of the picture, pixels.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }

    /// The world frame, if the picture has a place on the globe.
    pub fn frame(&self) -> Option<&LocalFrame> {
        match &self.kind {
            PlacementKind::Globe(Georeference::Metres(_), _) | PlacementKind::Affine(..) => None,
            PlacementKind::Globe(_, frame) => Some(frame),
        }
    }

    /// The affine map that fits the middle of the picture.
    pub fn middle(&self) -> &GroundFromPixel {
        &self.affine
    }

    /// Ground point of a pixel.
    pub fn ground_at(&self, pixel: &Point2<f64>) -> GroundPoint {
        match &self.kind {
            PlacementKind::Affine(map, _) => map.ground_at(pixel),
            PlacementKind::Globe(georeference, frame) => {
                georeference.ground_at(frame, pixel.x, pixel.y)
            }
        }
    }

    /// Pixel of a ground point, also beyond the picture's edges; `None` where the picture's
    /// reference system does not reach.
    pub fn pixel_at(&self, ground: &GroundPoint) -> Option<Point2<f64>> {
        match &self.kind {
            PlacementKind::Affine(map, inverse) => {
                Some(Point2::from(inverse * (ground.to_vector() - map.corner)))
            }
            PlacementKind::Globe(georeference, frame) => {
                georeference.pixel_near(frame, ground, &self.middle_pixel())
            }
        }
    }

    /// Place on the globe of a pixel, if the picture has any; also where the plane of the world does not
    /// reach.
    pub fn place_at(&self, pixel: &Point2<f64>) -> Option<Geodetic> {
        match &self.kind {
            PlacementKind::Affine(..) => None,
            PlacementKind::Globe(georeference, _) => georeference.place_at(pixel.x, pixel.y),
        }
    }

    /// Pixels of once around the Earth, where coordinates count along parallels: pixels so far apart are
    /// the same place.
    pub fn turn(&self) -> Option<&Vector2<f64>> {
        self.turn.as_ref()
    }

    /// The middle of the picture, pixels.
    pub fn middle_pixel(&self) -> Point2<f64> {
        Point2::new(0.5 * self.size.0 as f64, 0.5 * self.size.1 as f64)
    }

    /// Ground sample distance in the middle of the picture, metres per pixel.
    pub fn gsd(&self) -> f64 {
        self.affine.gsd()
    }

    /// The ground that the picture covers; of one that reaches farther than 5,000 km from the world's
    /// origin, as maps of the world do, the part within.
    pub fn bounds(&self) -> GroundRect {
        let (width, height) = (self.size.0 as f64, self.size.1 as f64);
        let along = |i: usize| i as f64 / POINTS_PER_SIDE as f64;
        let sides = (0..=POINTS_PER_SIDE).flat_map(|i| {
            let (x, y) = (along(i) * width, along(i) * height);
            [(x, 0.0), (x, height), (0.0, y), (width, y)]
        });
        let points: Vec<GroundPoint> = sides
            .map(|(x, y)| self.ground_at(&Point2::new(x, y)))
            .collect();
        let reach = GroundRect::centered(GroundPoint::default(), 2.0 * REACH, 2.0 * REACH);
        if self.frame().is_none() || points.iter().all(|p| reach.contains(p)) {
            let points = points
                .into_iter()
                .filter(|p| p.north.is_finite() && p.east.is_finite());
            return GroundRect::around(points).unwrap_or(NOTHING);
        }
        // What of a grid over that part lies on the picture.
        let grid = (0..=POINTS_PER_SIDE).flat_map(|i| (0..=POINTS_PER_SIDE).map(move |j| (i, j)));
        let inside = grid.filter_map(|(i, j)| {
            let ground = GroundPoint::new(
                reach.south + along(i) * reach.height(),
                reach.west + along(j) * reach.width(),
            );
            let pixel = self.pixel_at(&ground)?;
            let is_inside = (0.0..=width).contains(&pixel.x) && (0.0..=height).contains(&pixel.y);
            is_inside.then_some(ground)
        });
        let near = points.iter().filter(|p| reach.contains(p)).copied();
        GroundRect::around(inside.chain(near)).unwrap_or(NOTHING)
    }
}
