//! Control points of a picture out of a file of the QGIS georeferencer, in any reference system.

use pilotage_core::frames::{Geodetic, LocalFrame, ReferenceSystem};
use pilotage_core::imagery::georeferencer::{ControlPoint, in_metres, in_utm_zone, read_points_in};
use pilotage_core::imagery::systems;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, ReadControlPoints, RunningJob, WorkerState};

/// Farthest from the place where a picture is thought to be that points without a system are believed, metres.
const LIKELY: f64 = 300_000.0;

/// System that points are in where their file names none: degrees where the numbers may be such, else this.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PresumedSystem {
    /// The system, which is not of degrees.
    pub system: ReferenceSystem,
    /// Place near which they are thought to lie; points far from it are not taken.
    pub near: Geodetic,
}

impl PresumedSystem {
    /// The system of these points, if they may be in one; at least one.
    fn of(&self, points: &[ControlPoint]) -> Option<ReferenceSystem> {
        let are_degrees = |p: &ControlPoint| p.place.x.abs() <= 360.0 && p.place.y.abs() <= 90.0;
        if points.iter().all(are_degrees) {
            return Some(ReferenceSystem::Geographic);
        }
        let frame = LocalFrame::new(self.near);
        let is_near = |p: &ControlPoint| {
            let place = self.system.geodetic(p.place.x, p.place.y);
            place.is_some_and(|place| {
                let ground = frame.ground_from_geodetic(&place);
                ground.north.hypot(ground.east) < LIKELY
            })
        };
        points.iter().all(is_near).then_some(self.system)
    }
}

impl ReadControlPoints {
    /// The points in a file's text, in the plane that the file names, or in the UTM zone around points in degrees.
    /// `named` is the system that people know better than the file, `otherwise` the one of a file that names none, which
    /// is a note, and `remedy` what to do where nobody knows it.
    ///
    /// # Errors
    /// Text that is no such file, without a point, of an unknown system, or with a place that its system does not reach:
    /// in words, with the file.
    pub fn read(
        file: &str,
        text: &str,
        named: Option<ReferenceSystem>,
        otherwise: Option<&PresumedSystem>,
        remedy: &str,
    ) -> Result<Self, String> {
        let (points, system) = read_points_in(text, named, |name| systems::by_name(name).ok())
            .map_err(|cause| format!("{file}: {cause}"))?;
        if points.is_empty() {
            return Err(format!("{file}: there are no points in it"));
        }
        let presumed = || otherwise.and_then(|otherwise| otherwise.of(&points));
        let taken = system.or_else(presumed).ok_or_else(|| {
            format!(
                "{file}: the file does not say of which reference system its points are; {remedy}"
            )
        })?;
        let presumption = system.is_none().then(|| {
            let name = taken.name();
            format!("{file}: it names no reference system; its numbers were taken for {name}.")
        });
        let (points, plane) = in_metres(&points, taken).ok_or_else(|| outside(file, &taken))?;
        Ok(Self {
            file: file.to_owned(),
            points,
            plane,
            notes: taken.note_on(file).into_iter().chain(presumption).collect(),
        })
    }

    /// The same in metres of the ground: the UTM zone around the points in place of any other system. Messages hold no
    /// other than those of WGS 84, and a metre of Web Mercator is half of one at 60° north.
    fn in_message(mut self) -> Result<Self, String> {
        if let ReferenceSystem::Other(_) | ReferenceSystem::WebMercator = self.plane {
            let stated = self.plane;
            let moved = in_utm_zone(&self.points, stated);
            (self.points, self.plane) = moved.ok_or_else(|| outside(&self.file, &stated))?;
            self.notes.push(format!(
                "{}: its points, in {}, were brought to {}.",
                self.file,
                stated.name(),
                self.plane.name()
            ));
        }
        Ok(self)
    }
}

/// Complaint about a point.
fn outside(file: &str, system: &ReferenceSystem) -> String {
    format!(
        "{file}: a point lies where {} does not reach",
        system.name()
    )
}

/// File of control points to read: event `ControlPoints`, or `Failed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadControlPointsOrder {
    /// Key of the files.
    pub key: String,
    /// The file among them.
    pub file: String,
    /// The system of the points where the file names none.
    pub otherwise: Option<PresumedSystem>,
}

impl Order for ReadControlPointsOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let files = worker.files(&self.key)?;
            let file = &self.file;
            let bytes = files.read(file);
            let bytes = bytes.ok_or_else(|| format!("{file} is not among the files"))?;
            let text = String::from_utf8_lossy(&bytes);
            let remedy = "pick or type one point near them first, or begin the file with a line like #CRS: EPSG:32617";
            let otherwise = self.otherwise.as_ref();
            let read = ReadControlPoints::read(file, &text, None, otherwise, remedy)?;
            emit(JobEvent::ControlPoints(Box::new(read.in_message()?)));
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::Geodetic;

    const ROWS: &str = "mapX,mapY,sourceX,sourceY,enable\n";

    /// Two places on the ground of Gauss-Krüger's zone 3, 100 m from each other, and the same in degrees of WGS 84 as pyproj
    /// brings them there by EPSG:1777.
    #[test]
    fn points_of_another_datum_reach_the_page_where_they_lie() {
        let text = format!(
            "#CRS: EPSG:31467\n{ROWS}3512345.6,5412345.6,10,-20,1\n3512445.6,5412345.6,110,-20,1\n"
        );
        let read = ReadControlPoints::read("a.points", &text, None, None, "").unwrap();
        assert_eq!(read.plane.epsg(), Some(31467));
        assert_eq!(read.notes.len(), 1, "{:?}", read.notes);
        let sent = read.in_message().unwrap();
        assert_eq!(sent.plane.epsg(), Some(32632));
        let back: ReadControlPoints =
            postcard::from_bytes(&postcard::to_allocvec(&sent).unwrap()).unwrap();
        assert_eq!(back, sent);
        let expected = [
            (48.848_432_84, 9.167_180_682),
            (48.848_430_847, 9.168_543_192),
        ];
        for (point, (latitude, longitude)) in sent.points.iter().zip(expected) {
            let at = sent.plane.geodetic(point.place.x, point.place.y).unwrap();
            let there = Geodetic::from_degrees(latitude, longitude, 0.0);
            assert!(
                (at.latitude - there.latitude).abs() * 6.4e6 < 0.01,
                "{at:?}"
            );
            assert!(
                (at.longitude - there.longitude).abs() * 4.3e6 < 0.01,
                "{at:?}"
            );
        }
        assert!(sent.notes[1].contains("brought to WGS 84, UTM zone 32N"));
    }

    #[test]
    fn files_without_a_system_or_a_point_say_what_to_do() {
        let rows = format!("{ROWS}500010,5190020,3,-4,1\n");
        let near = |latitude| PresumedSystem {
            system: ReferenceSystem::from_epsg(32_615).unwrap(),
            near: Geodetic::from_degrees(latitude, -92.0, 0.0),
        };
        let read = |text: &str, otherwise: Option<&PresumedSystem>| {
            ReadControlPoints::read("a.points", text, None, otherwise, "name it")
        };
        let cause = read(&rows, None).unwrap_err();
        assert!(
            cause.starts_with("a.points: ") && cause.ends_with("; name it"),
            "{cause}"
        );
        let found = read(&rows, Some(&near(46.9))).unwrap();
        assert_eq!(found.plane.epsg(), Some(32_615));
        assert!(found.notes[0].ends_with("were taken for WGS 84, UTM zone 15N."));
        // Some other numbers, which that zone puts into another country.
        let cause = read(&rows, Some(&near(40.0))).unwrap_err();
        assert!(cause.ends_with("; name it"), "{cause}");
        let cause = read(ROWS, Some(&near(46.9))).unwrap_err();
        assert!(cause.ends_with("no points in it"), "{cause}");
        let degrees = format!("{ROWS}8.500,47.250,10,-10,1\n");
        let found = read(&degrees, Some(&near(46.9))).unwrap();
        assert_eq!(
            found.plane.epsg(),
            Some(32_632),
            "degrees are brought to metres"
        );
        assert!(found.notes[0].ends_with("were taken for WGS 84, longitude and latitude."));
        let named = ReadControlPoints::read(
            "a.points",
            &degrees,
            Some(ReferenceSystem::Geographic),
            None,
            "",
        );
        assert_eq!(named.unwrap().notes.len(), 0);
    }

    /// Two places of a street at 60° north, 100 units of Web Mercator from each other: 50 m on the ground.
    #[test]
    fn points_over_web_mercator_reach_the_page_in_metres_of_the_ground() {
        let text = format!(
            "#CRS: EPSG:3857\n{ROWS}1200000,8399737.89,10,-20,1\n1200100,8399737.89,110,-20,1\n"
        );
        let read = ReadControlPoints::read("a.points", &text, None, None, "").unwrap();
        assert_eq!(read.plane.epsg(), Some(3857));
        let sent = read.in_message().unwrap();
        assert_eq!(sent.plane.epsg(), Some(32_632));
        let apart = (sent.points[1].place - sent.points[0].place).norm();
        // cos 60° = 0.5, 0.25 % more on the ellipsoid, 0.04 % less in the zone.
        assert!((apart - 50.1).abs() < 0.05, "{apart}");
    }
}
