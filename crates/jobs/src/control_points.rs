//! Control points of a picture out of a file of the QGIS georeferencer, in any reference system.

use pilotage_core::frames::ReferenceSystem;
use pilotage_core::imagery::georeferencer::{in_metres, in_utm_zone, read_points_in};
use pilotage_core::imagery::systems;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, ReadControlPoints, RunningJob, WorkerState};

impl ReadControlPoints {
    /// The points in a file's text, in the plane that the file names, or in the UTM zone around points in degrees.
    /// `named` is the system that people know better than the file, `otherwise` the one of a file that names none, and
    /// `remedy` what to do where nobody knows it.
    ///
    /// # Errors
    /// Text that is no such file, without a point, of an unknown system, or with a place that its system does not reach:
    /// in words, with the file.
    pub fn read(
        file: &str,
        text: &str,
        named: Option<ReferenceSystem>,
        otherwise: Option<ReferenceSystem>,
        remedy: &str,
    ) -> Result<Self, String> {
        let (points, system) = read_points_in(text, named, |name| systems::by_name(name).ok())
            .map_err(|cause| format!("{file}: {cause}"))?;
        let system = system.or(otherwise).ok_or_else(|| {
            format!(
                "{file}: the file does not say of which reference system its points are; {remedy}"
            )
        })?;
        if points.is_empty() {
            return Err(format!("{file}: there are no points in it"));
        }
        let (points, plane) = in_metres(&points, system).ok_or_else(|| outside(file, &system))?;
        Ok(Self {
            file: file.to_owned(),
            points,
            plane,
            notes: system.note_on(file).into_iter().collect(),
        })
    }

    /// The same in a plane of WGS 84, the only ones that messages can hold: the UTM zone around the points in place of
    /// any other system.
    fn in_message(mut self) -> Result<Self, String> {
        if let ReferenceSystem::Other(_) = self.plane {
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
    pub otherwise: Option<ReferenceSystem>,
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
            let remedy = "pick or type one point first";
            let read = ReadControlPoints::read(file, &text, None, self.otherwise, remedy)?;
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
        let rows = format!("{ROWS}1,2,3,-4,1\n");
        let read = |text: &str, otherwise| {
            ReadControlPoints::read("a.points", text, None, otherwise, "name it")
        };
        let cause = read(&rows, None).unwrap_err();
        assert!(
            cause.starts_with("a.points: ") && cause.ends_with("; name it"),
            "{cause}"
        );
        let zone = ReferenceSystem::from_epsg(32_617);
        assert_eq!(read(&rows, zone).unwrap().plane.epsg(), Some(32_617));
        let cause = read(ROWS, zone).unwrap_err();
        assert!(cause.ends_with("no points in it"), "{cause}");
        let read = read(&rows, Some(ReferenceSystem::Geographic));
        let zone = read.map(|it| it.plane.epsg());
        assert_eq!(zone, Ok(Some(32_631)), "degrees are brought to metres");
    }
}
