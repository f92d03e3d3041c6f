//! The points of a picture, how they are fitted, and what can be taken back.

use nalgebra::Point2;
use pilotage_core::frames::{Geodetic, LocalFrame, ReferenceSystem};
use pilotage_core::imagery::georeferencer::{
    ControlPoint, FitError, TransformFit, TransformKind, fit, write_points,
};
use pilotage_core::imagery::{Georeference, WorldFile};

use super::canvas::PictureCanvas;
use pilotage_jobs::{MapInfo, MapSource};

/// A place with a name, of which a file told.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPlace {
    /// Name for people.
    pub name: String,
    /// Place on the globe.
    pub at: Geodetic,
}

/// A point on its way: what is known of it so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pending {
    /// Place in the picture, pixels.
    pub pixel: Option<Point2<f64>>,
    /// Place on the ground, in the plane.
    pub place: Option<Point2<f64>>,
}

/// The points and the plane that they are in, as they once were.
type Snapshot = (Vec<ControlPoint>, Option<ReferenceSystem>);

/// A picture being put on the ground.
pub struct Georeferencer {
    /// Key of the files that the picture is among.
    pub key: String,
    /// The picture.
    pub name: String,
    /// Its size, pixels, once known.
    pub size: Option<(f64, f64)>,
    /// View of the picture.
    pub canvas: PictureCanvas,
    /// The world frame that the map is shown in.
    pub frame: Option<LocalFrame>,
    /// The system in whose plane the points are.
    pub system: Option<ReferenceSystem>,
    /// The points.
    pub points: Vec<ControlPoint>,
    /// Kind of transform that is fitted to the picture.
    pub kind: TransformKind,
    /// The point being picked.
    pub pending: Pending,
    /// The point under the pointer, or chosen in the table.
    pub chosen: Option<usize>,
    /// Typed coordinates.
    pub typed: String,
    /// Error in the typed coordinates, in words.
    pub typed_wrong: Option<String>,
    /// Places of a file that can be chosen.
    pub places: Vec<NamedPlace>,
    /// The point that is dragged on the map.
    pub on_map: Option<usize>,
    past: Vec<Snapshot>,
    future: Vec<Snapshot>,
    fitted: Result<TransformFit, FitError>,
}

impl Georeferencer {
    /// No point yet.
    pub fn new(key: &str, name: &str, origin: Option<Geodetic>) -> Self {
        let kind = TransformKind::Affine;
        Self {
            key: key.to_owned(),
            name: name.to_owned(),
            size: None,
            canvas: PictureCanvas::default(),
            frame: origin.map(LocalFrame::new),
            system: origin.map(|origin| ReferenceSystem::utm_around(&origin)),
            points: Vec::new(),
            kind,
            pending: Pending::default(),
            chosen: None,
            typed: String::new(),
            typed_wrong: None,
            places: Vec::new(),
            on_map: None,
            past: Vec::new(),
            future: Vec::new(),
            fitted: fit(&[], kind),
        }
    }

    /// The picture as a map of its own, on which a pixel is a metre and the first row lies in the north.
    pub fn bare(&self) -> MapSource {
        MapSource::Picture {
            key: self.key.clone(),
            name: self.name.clone(),
            origin: None,
            place: Georeference::Metres(WorldFile::of_pixels()),
        }
    }

    /// Takes what is known of the picture.
    pub fn describe(&mut self, info: &MapInfo) {
        self.size = Some((info.bounds.width(), info.bounds.height()));
        self.canvas.know(info.clone());
    }

    /// The fit, or why there is none.
    pub fn fitted(&self) -> &Result<TransformFit, FitError> {
        &self.fitted
    }

    /// Whether the points are so few that any fit goes through all of them, and no error tells anything.
    pub fn is_exact(&self) -> bool {
        self.fitted.as_ref().is_ok_and(|fit| fit.is_exact)
    }

    /// Takes a place for the point being picked.
    pub fn pick_place(&mut self, place: Point2<f64>) {
        self.pending.place = Some(place);
        self.complete();
    }

    /// Takes a pixel for the point being picked.
    pub fn pick_pixel(&mut self, pixel: Point2<f64>) {
        self.pending.pixel = Some(pixel);
        self.complete();
    }

    fn complete(&mut self) {
        let Pending {
            pixel: Some(pixel),
            place: Some(place),
        } = self.pending
        else {
            return;
        };
        self.pending = Pending::default();
        self.typed.clear();
        self.typed_wrong = None;
        self.edit(|points| {
            points.push(ControlPoint {
                pixel,
                place,
                enabled: true,
            });
        });
        self.chosen = Some(self.points.len() - 1);
    }

    /// Changes the points, one undo step.
    pub fn edit(&mut self, change: impl FnOnce(&mut Vec<ControlPoint>)) {
        self.remember();
        change(&mut self.points);
        self.fit();
    }

    /// Makes an undo step of the points as they are; a drag begins.
    pub fn remember(&mut self) {
        self.past.push((self.points.clone(), self.system));
        self.future.clear();
    }

    /// Moves a point without an undo step: a drag goes on.
    pub fn drag(&mut self, index: usize, pixel: Option<Point2<f64>>, place: Option<Point2<f64>>) {
        if let Some(point) = self.points.get_mut(index) {
            point.pixel = pixel.unwrap_or(point.pixel);
            point.place = place.unwrap_or(point.place);
            self.fit();
        }
    }

    /// Fits with another kind of transform.
    pub fn set_kind(&mut self, kind: TransformKind) {
        self.kind = kind;
        self.fit();
    }

    fn fit(&mut self) {
        self.fitted = fit(&self.points, self.kind);
    }

    /// Undo steps and redo steps.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }

    /// Takes the last change back; of a half-picked point first that.
    pub fn undo(&mut self) {
        if self.pending != Pending::default() {
            self.pending = Pending::default();
        } else if let Some(before) = self.past.pop() {
            let now = self.swap(before);
            self.future.push(now);
        }
        self.chosen = None;
    }

    /// Makes the change taken back again.
    pub fn redo(&mut self) {
        if let Some(after) = self.future.pop() {
            let now = self.swap(after);
            self.past.push(now);
        }
        self.chosen = None;
    }

    fn swap(&mut self, (points, system): Snapshot) -> Snapshot {
        let now = (std::mem::replace(&mut self.points, points), self.system);
        self.change_plane(system.or(self.system));
        self.fit();
        now
    }

    /// Takes another plane; a place that waits for its pixel is the same one in that, if it reaches so far.
    pub(super) fn change_plane(&mut self, plane: Option<ReferenceSystem>) {
        let before = std::mem::replace(&mut self.system, plane);
        if before != plane {
            let carried = |place: Point2<f64>| {
                let at = before?.geodetic(place.x, place.y)?;
                let (x, y) = plane?.coordinates(&at)?;
                Some(Point2::new(x, y))
            };
            self.pending.place = self.pending.place.and_then(carried);
        }
    }

    /// Takes the points of a file in place of those there are, one undo step.
    pub fn take_points(&mut self, points: Vec<ControlPoint>, plane: ReferenceSystem) {
        self.remember();
        self.change_plane(Some(plane));
        let middle = points.first();
        let middle = middle.and_then(|point| plane.geodetic(point.place.x, point.place.y));
        self.frame = self.frame.or(middle.map(LocalFrame::new));
        self.points = points;
        self.fit();
    }

    /// Whether it has the name and the size of another picture, as far as they are known.
    pub fn looks_like(&self, other: &Self) -> bool {
        self.name == other.name && self.size.is_some() && self.size == other.size
    }

    /// Whether points were picked in it, or taken back.
    pub fn has_begun(&self) -> bool {
        self.pending != Pending::default() || self.depth() != (0, 0)
    }

    /// Takes the points, and the kind of fit, that the picture had when it was left, one undo step.
    pub fn take_up(&mut self, before: Self) {
        self.kind = before.kind;
        if let Some(plane) = before.system {
            self.take_points(before.points, plane);
        }
    }

    /// The points as QGIS writes them.
    pub fn points_file(&self) -> String {
        write_points(&self.points, self.system, self.fitted.as_ref().ok())
    }

    /// Name of a file that belongs to the picture.
    pub fn file_beside(&self, ending: &str) -> String {
        let name = self.name.rsplit('/').next().unwrap_or_default();
        let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
        format!("{stem}.{ending}")
    }

    /// The world file's name: by the picture's ending, as other programs look for it.
    pub fn world_file_name(&self) -> String {
        let lower = self.name.to_ascii_lowercase();
        let ending = match lower.rsplit('.').next() {
            Some("jpg" | "jpeg") => "jgw",
            Some("tif" | "tiff") => "tfw",
            Some("png") => "pgw",
            _ => "wld",
        };
        self.file_beside(ending)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::GroundPoint;
    use pilotage_jobs::ReadControlPoints;

    fn picked() -> Georeferencer {
        let origin = Geodetic::from_degrees(46.857, -92.076, 0.0);
        let mut it = Georeferencer::new("opened-1", "maps/area.JPG", Some(origin));
        it.size = Some((400.0, 300.0));
        for (x, y) in [(10.0, 10.0), (390.0, 20.0), (200.0, 280.0)] {
            it.pick_pixel(Point2::new(x, y));
            it.pick_place(Point2::new(570_000.0 + 0.5 * x, 5_190_000.0 - 0.5 * y));
        }
        it
    }

    #[test]
    fn a_point_is_there_once_it_is_known_on_both_sides_and_goes_again_by_undo() {
        let mut it = picked();
        assert_eq!(it.points.len(), 3);
        assert!(
            it.fitted()
                .as_ref()
                .is_ok_and(|fit| fit.rms_in_plane < 1e-6)
        );
        it.pick_pixel(Point2::new(5.0, 5.0));
        assert_eq!(it.points.len(), 3);
        it.undo();
        assert_eq!((it.points.len(), it.pending), (3, Pending::default()));
        it.undo();
        assert_eq!(it.points.len(), 2);
        assert!(
            it.fitted().is_err(),
            "an affine transform takes three points"
        );
        it.redo();
        assert_eq!(it.points.len(), 3);
        assert!(it.fitted().is_ok());
    }

    #[test]
    fn points_that_any_fit_goes_through_check_nothing() {
        let mut it = picked();
        assert!(it.is_exact(), "three points of an affine transform");
        it.set_kind(TransformKind::Similarity);
        assert!(!it.is_exact());
        it.edit(|points| points[0].enabled = false);
        assert!(it.is_exact(), "two points of a similarity are left");
    }

    #[test]
    fn points_survive_their_file() {
        let it = picked();
        let mut other = Georeferencer::new("opened-2", "b.png", None);
        let read = ReadControlPoints::read("a.points", &it.points_file(), None, None, "").unwrap();
        other.take_points(read.points, read.plane);
        assert_eq!(other.points.len(), 3);
        assert_eq!(other.system, it.system);
        for (a, b) in it.points.iter().zip(&other.points) {
            assert!((a.place - b.place).norm() < 1e-9 && (a.pixel - b.pixel).norm() < 1e-9);
        }
        assert_eq!(it.world_file_name(), "area.jgw");
    }

    #[test]
    fn a_place_that_waits_for_its_pixel_stays_where_it_is_when_points_of_another_zone_come() {
        let it = picked();
        let read = ReadControlPoints::read("a.points", &it.points_file(), None, None, "").unwrap();
        let mut it = Georeferencer::new("opened-1", "b.png", None);
        // 89.9° W: in zone 16, while the file's points are of zone 15.
        let at = Geodetic::from_degrees(46.857, -89.9, 0.0);
        it.pick_globe(&at);
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_616));
        it.take_points(read.points, read.plane);
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_615));
        let place = it.pending.place.unwrap();
        // By pyproj: EPSG:4326 to EPSG:32615.
        assert!(
            (place - Point2::new(736_300.004, 5_193_939.758)).norm() < 0.01,
            "{place}"
        );
        it.pick_pixel(Point2::new(50.0, 60.0));
        assert_eq!(it.points.len(), 4);
        it.undo();
        it.undo();
        it.pick_globe(&at);
        it.redo();
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_615));
        assert!((it.pending.place.unwrap() - place).norm() < 1e-6);
    }

    #[test]
    fn the_first_typed_place_decides_on_the_plane_where_nothing_is_open() {
        let mut it = Georeferencer::new("opened-1", "area.png", None);
        it.pick_globe(&Geodetic::from_degrees(-33.9, 151.2, 0.0));
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_756));
        assert!(it.pending.place.is_some());
    }

    #[test]
    fn the_map_and_the_plane_agree_there_and_back() {
        let it = picked();
        let ground = GroundPoint::new(123.0, -45.0);
        let place = it.place_of(&ground).unwrap();
        assert!(it.ground_of(&place).unwrap().distance(&ground) < 1e-6);
    }
}
