//! Names of columns that are axes of a grid in metres.

/// Names of eastings, and of northings.
pub(super) const EASTINGS: [&str; 8] = [
    "easting",
    "east",
    "e",
    "x",
    "utm easting",
    "utm east",
    "utm e",
    "utm x",
];
pub(super) const NORTHINGS: [&str; 8] = [
    "northing",
    "north",
    "n",
    "y",
    "utm northing",
    "utm north",
    "utm n",
    "utm y",
];

/// The name of a column in small letters, without its unit.
pub(super) fn plain_name(name: &str) -> String {
    let name = name.to_lowercase().replace(['_', '-'], " ");
    let name = name.split(['(', '[']).next().unwrap_or("");
    name.trim().to_owned()
}

/// Whether a column so called may have eastings or northings.
pub(super) fn is_grid_axis(name: &str) -> bool {
    let name = plain_name(name);
    [EASTINGS, NORTHINGS]
        .iter()
        .flatten()
        .any(|axis| *axis == name)
}

/// The columns of these names that are easting and northing by them, `X` and `Y` aside.
pub(super) fn easting_and_northing(names: &[String]) -> Option<[&str; 2]> {
    let find = |axes: &[&str], short: &str| {
        let is_axis = |name: &&String| {
            let plain = plain_name(name);
            plain != short && axes.contains(&plain.as_str())
        };
        names.iter().find(is_axis).map(String::as_str)
    };
    Some([find(&EASTINGS, "x")?, find(&NORTHINGS, "y")?])
}

#[cfg(test)]
mod tests {
    use super::super::read_any;

    #[test]
    fn metres_of_a_system_that_nothing_names_are_asked_about() {
        for names in [
            "Point,E,N,H",
            "Name,Easting,Northing,Height",
            "id,UTM_E (m),UTM_N (m),z",
        ] {
            let table = format!("{names}\nA,391234.56,5432100.12,120.5\n");
            let read = read_any("a.csv", table.as_bytes(), None);
            let told = read.map(|_| ()).unwrap_err().to_string();
            assert!(
                told.contains("line 1") && told.contains("EPSG:32632"),
                "{told}"
            );
        }
        let read = read_any("a.csv", b"Name,Speed,N\nA,1,2\n", None);
        let told = read.map(|_| ()).unwrap_err().to_string();
        assert!(!told.contains("EPSG"), "{told}");
    }

    #[test]
    fn dots_between_thousands_are_none_of_decimals() {
        let table = "Name;Latitude;Longitude;Altitude\nA;-33,8501;18,4201;1.119,5\nB;-33,8511;18,4211;1.120\nC;-33,8521;18,4221;999\n";
        let read = read_any("a.csv", table.as_bytes(), None).unwrap();
        let heights: Vec<f64> = (read.routes[0].way_points.iter())
            .map(|way_point| way_point.altitude.metres)
            .collect();
        assert_eq!(heights, [1119.5, 1120.0, 999.0]);
        // Points before decimals between semicolons.
        let table = "Name;Latitude;Longitude;Altitude\nA;-33.8501;18.4201;1.119\nB;-33.8511;18.4211;1.120\n";
        let read = read_any("a.csv", table.as_bytes(), None).unwrap();
        assert_eq!(read.routes[0].way_points[1].altitude.metres, 1.12);
    }

    #[test]
    fn letters_behind_the_angles_of_loggers_turn_them() {
        let table = "INDEX,TAG,DATE,TIME,LATITUDE N/S,LONGITUDE E/W,HEIGHT\n1,C,240501,100000,33.850100S,018.420100E,101\n\
                     2,C,240501,100001,33.850200S,000.420100W,102\n";
        let read = read_any("a.csv", table.as_bytes(), None).unwrap();
        let place = read
            .frame
            .geodetic_from_ground(&read.routes[0].way_points[1].position);
        assert!((place.latitude.to_degrees() + 33.8502).abs() < 1e-9);
        assert!((place.longitude.to_degrees() + 0.4201).abs() < 1e-9);
    }
}
