//! Heights of way-points that are not called altitudes.

use super::csv_columns::{CsvColumn, CsvRole, column_of, parted};
use pilotage_base::frames::AltitudeFrame;

/// Names of heights that are altitudes to fly at where no column is called an altitude, with what they count from.
const FLOWN_HEIGHTS: [(Option<AltitudeFrame>, &[&str]); 4] = [
    (
        Some(AltitudeFrame::AboveTakeOff),
        &[
            "relalt",
            "rel alt",
            "rel altitude",
            "rel height",
            "relative alt",
            "relative altitude",
            "relative height",
            "height above takeoff",
            "height above take off",
            "height above home",
            "altitude above takeoff",
            "altitude above take off",
            "altitude above home",
        ],
    ),
    (
        Some(AltitudeFrame::AboveGround),
        &[
            "agl",
            "height above ground",
            "height above ground level",
            "height above terrain",
            "altitude above ground",
            "altitude above ground level",
            "altitude above terrain",
        ],
    ),
    (
        Some(AltitudeFrame::Amsl),
        &[
            "amsl",
            "msl",
            "height above sea level",
            "height above mean sea level",
            "altitude above sea level",
            "altitude above mean sea level",
            "height asl",
            "alt asl",
            "altitude asl",
        ],
    ),
    (
        None,
        &[
            "height",
            "flight height",
            "flying height",
            "flight altitude",
            "flying altitude",
            "target altitude",
        ],
    ),
];

/// The column of that name as an altitude to fly at, if it may be one.
pub(super) fn flown_height(name: &str) -> Option<CsvColumn> {
    let known = |name: &str| {
        let mut names = FLOWN_HEIGHTS.iter();
        let found = names.find(|(_, names)| names.contains(&name));
        found.map(|(frame, _)| (CsvRole::Altitude, *frame))
    };
    [name, &parted(name)]
        .into_iter()
        .map(|words| column_of(name, words, &known))
        .find(|column| column.role.is_some())
}

#[cfg(test)]
mod tests {
    use super::super::read_any;
    use super::*;

    #[test]
    fn way_points_fly_at_their_heights_whatever_these_are_called() {
        let fly = |names: &str, cells: &str| {
            let table = format!("waypoint,latitude,longitude,{names}\n1,-33.851,18.421,{cells}\n");
            let read = read_any("a.csv", table.as_bytes(), None).unwrap();
            let altitude = read.routes[0].way_points[0].altitude;
            let is_assumed = read.notes.iter().any(|note| note.contains("altitude"));
            (altitude.metres, altitude.frame, is_assumed)
        };
        let (above, ground, sea) = (
            AltitudeFrame::AboveTakeOff,
            AltitudeFrame::AboveGround,
            AltitudeFrame::Amsl,
        );
        for (names, frame, is_assumed) in [
            ("RelAlt", above, false),
            ("relative_altitude", above, false),
            ("height_above_takeoff(m)", above, false),
            ("Altitude above home [m]", above, false),
            ("agl", ground, false),
            ("Height AGL (m)", ground, false),
            ("AMSL (m)", sea, false),
            ("Flight Height (m)", above, true),
            ("height", above, true),
        ] {
            assert_eq!(fly(names, "164"), (164.0, frame, is_assumed), "{names}");
        }
        assert_eq!(fly("Height AGL (ft)", "1000"), (304.8, ground, false));
        assert_eq!(fly("height,altitude", "3,50"), (50.0, above, true));
        // Units in the cells.
        assert_eq!(fly("altitude", "1000 ft").0, 304.8);
        assert_eq!(fly("altitude [ft]", "50m").0, 50.0);
        let named = "name,latitude,longitude,height agl\nTower,-33.85,18.42,30\n";
        let read = read_any("a.csv", named.as_bytes(), None).unwrap();
        assert_eq!(read.landmarks.len(), 1);
        let wrong = read_any("a.csv", b"latitude,longitude,altitude\n47,8,50 s\n", None);
        assert!(
            wrong
                .map(|_| ())
                .unwrap_err()
                .to_string()
                .contains("`50 s` is no number")
        );
    }
}
