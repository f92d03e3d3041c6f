//! Where the pixels of a picture lie on the ground, there and back.

use nalgebra::{Matrix2, Point2};

use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_base::georeference::{Georeference, GeoreferenceError, GroundFromPixel};

/// Points along each side of a picture from which its extent is taken.
const POINTS_PER_SIDE: usize = 32;

/// A map between the pixels of a picture (centres at half integers) and the ground.
#[derive(Clone, Debug)]
pub struct Placement {
    kind: Kind,
    /// Size of the picture, pixels.
    size: (usize, usize),
    /// The same map made affine around the middle of the picture.
    affine: GroundFromPixel,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Affine by nature; with the inverse of its matrix.
    Affine(GroundFromPixel, Matrix2<f64>),
    /// Through a reference system on the globe.
    Globe(Georeference, LocalFrame),
}

impl Placement {
    /// A picture of the given size under an affine map; `None` if that does not span an area.
    pub fn affine(map: GroundFromPixel, width: usize, height: usize) -> Option<Self> {
        Some(Self {
            kind: Kind::Affine(map, map.matrix.try_inverse()?),
            size: (width, height),
            affine: map,
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
            kind: Kind::Globe(georeference, frame),
            size: (width, height),
            affine,
        })
    }

    /// Size of the picture, pixels.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }

    /// The world frame, if the picture has a place on the globe.
    pub fn frame(&self) -> Option<&LocalFrame> {
        match &self.kind {
            Kind::Globe(Georeference::Metres(_), _) | Kind::Affine(..) => None,
            Kind::Globe(_, frame) => Some(frame),
        }
    }

    /// The affine map that fits the middle of the picture.
    pub fn middle(&self) -> &GroundFromPixel {
        &self.affine
    }

    /// Ground point of a pixel.
    pub fn ground_at(&self, pixel: &Point2<f64>) -> GroundPoint {
        match &self.kind {
            Kind::Affine(map, _) => map.ground_at(pixel),
            Kind::Globe(georeference, frame) => georeference.ground_at(frame, pixel.x, pixel.y),
        }
    }

    /// Pixel of a ground point, also beyond the picture's edges; `None` where the picture's
    /// reference system does not reach.
    pub fn pixel_at(&self, ground: &GroundPoint) -> Option<Point2<f64>> {
        match &self.kind {
            Kind::Affine(map, inverse) => {
                Some(Point2::from(inverse * (ground.to_vector() - map.corner)))
            }
            Kind::Globe(georeference, frame) => georeference.pixel_at(frame, ground),
        }
    }

    /// Ground sample distance in the middle of the picture, metres per pixel.
    pub fn gsd(&self) -> f64 {
        self.affine.gsd()
    }

    /// The ground that the picture covers.
    pub fn bounds(&self) -> GroundRect {
        let (width, height) = (self.size.0 as f64, self.size.1 as f64);
        let sides = (0..=POINTS_PER_SIDE).flat_map(|i| {
            let along = i as f64 / POINTS_PER_SIDE as f64;
            let (x, y) = (along * width, along * height);
            [(x, 0.0), (x, height), (0.0, y), (width, y)]
        });
        let points = sides
            .map(|(x, y)| self.ground_at(&Point2::new(x, y)))
            .filter(|p| p.north.is_finite() && p.east.is_finite());
        GroundRect::around(points).unwrap_or(GroundRect::centered(GroundPoint::default(), 0.0, 0.0))
    }
}
