//! Places of pictures as a table beside them tells them: those of `Pix4D`, Metashape, `OpenDroneMap`, `senseFly`, Wingtra, Emlid,
//! the marks of DJI (`.MRK`), and anybody's with a column of their names.

use super::ExchangeError;
use super::csv_bare::named;
use super::csv_columns::Unit;
use super::csv_read::OpenedTable;
use super::csv_table::CsvRow;
use super::decoded_text::decoded;
use crate::mission::found::LonLat;

/// A picture of which a table tells the place.
#[derive(Clone, Debug, PartialEq)]
pub struct TabledPicture {
    /// Its name as the table has it: perhaps behind folders, or without its ending.
    pub name: String,
    /// Longitude and latitude on WGS 84, degrees.
    pub place: LonLat,
    /// Altitude above sea level, or what the table takes for it, metres.
    pub altitude: Option<f64>,
    /// Height above take-off, metres.
    pub height_above_take_off: Option<f64>,
    /// Heading clockwise from north, pitch and roll, radians.
    pub angles: [Option<f64>; 3],
}

/// Pictures of which a table tells the places.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TabledPictures {
    /// Every one, in the order of the rows; those without a place are left out.
    pub pictures: Vec<TabledPicture>,
    /// Sentences on what was assumed.
    pub notes: Vec<String>,
}

/// Names of columns in small letters, without seams and units: altitudes, heights above take-off, and angles.
const ALTITUDES: [&str; 16] = [
    "altitude",
    "alt",
    "z",
    "zaltitude",
    "height",
    "h",
    "elevation",
    "ele",
    "ellipsoidalheight",
    "ellh",
    "gpsaltitude",
    "gpsalt",
    "absalt",
    "absolutealtitude",
    "altitudemsl",
    "altitudeamsl",
];
const HEIGHTS: [&str; 9] = [
    "relalt",
    "altrel",
    "relativealtitude",
    "altituderelative",
    "relativeheight",
    "relheight",
    "heightabovetakeoff",
    "altitudeabovetakeoff",
    "relativealt",
];
const ANGLES: [&[&str]; 3] = [
    &[
        "yaw",
        "heading",
        "hdg",
        "gimbalyaw",
        "gimbalyawdegree",
        "camerayaw",
        "direction",
        "gpsimgdirection",
    ],
    &["pitch", "gimbalpitch", "gimbalpitchdegree", "camerapitch"],
    &["roll", "gimbalroll", "gimbalrolldegree", "cameraroll"],
];
/// Words of units of angles behind their names.
const DEGREES: [&str; 3] = ["deg", "degree", "degrees"];
const RADIANS: [&str; 2] = ["rad", "radians"];

/// The pictures of which a table tells the places, `is_picture` saying whether a cell is the name of one: the column with most
/// of them has the names. Of DJI's marks (`.MRK`) the names are `mark 1`, `mark 2` ….
///
/// ```
/// use pilotage_mission::exchange::placed_pictures;
///
/// let table = b"Label;Lat;Lon;Alt;Yaw\nA.JPG;47,1;8,5;520;90\nhall;0;0;0;0\n";
/// let found = placed_pictures("a.csv", table, &|name| name.ends_with(".JPG"))?;
/// let [picture] = &found.pictures[..] else { panic!() };
/// assert_eq!((picture.place, picture.altitude), ((8.5, 47.1), Some(520.0)));
/// assert_eq!(picture.angles[0].map(f64::to_degrees), Some(90.0));
/// # Ok::<(), pilotage_mission::exchange::ExchangeError>(())
/// ```
///
/// # Errors
/// A table that has no columns of places, or is none.
pub fn placed_pictures(
    file: &str,
    bytes: &[u8],
    is_picture: &dyn Fn(&str) -> bool,
) -> Result<TabledPictures, ExchangeError> {
    let mut notes = Vec::new();
    let content = decoded(bytes, &mut notes);
    let given = named(&content).map_err(|cause| ExchangeError::File {
        file: file.to_owned(),
        cause: format!("line 1: {cause}"),
    })?;
    let mut opened = match &given {
        Some(table) => OpenedTable::of(file, &table.text, table.added)?,
        None => OpenedTable::of(file, &content, 0)?,
    };
    notes.extend(given.iter().flat_map(|table| table.notes.clone()));
    notes.extend(opened.find_places()?);
    let OpenedTable { table, records, .. } = opened;
    let count = |column: usize| {
        let cells = records.iter().filter_map(|(_, row)| row.get(column));
        cells.filter(|cell| is_picture(cell)).count()
    };
    let counted = (0..table.columns.len()).map(|column| (count(column), column));
    // Of equals the first.
    let most = counted.max_by_key(|(count, column)| (*count, usize::MAX - column));
    let Some((_, of_names)) = most.filter(|(count, _)| *count > 0) else {
        return Ok(TabledPictures::default());
    };
    let plain: Vec<(String, f64)> = (table.columns.iter())
        .map(|column| plain(&column.name))
        .collect();
    let find = |names: &[&str]| {
        names
            .iter()
            .find_map(|name| plain.iter().position(|(own, _)| own == name))
    };
    let unit = |column: usize| table.columns[column].unit.map_or(1.0, Unit::factor);
    let (altitude, height) = (find(&ALTITUDES), find(&HEIGHTS));
    let angles = ANGLES.map(find);
    let pictures = records.into_iter().filter_map(|(line, record)| {
        let row = CsvRow {
            table: &table,
            line,
            record,
        };
        let name = row.record.get(of_names).filter(|name| is_picture(name))?;
        let number = |column: Option<usize>| {
            let number = row.with_point(row.record.get(column?)?).parse::<f64>();
            number.ok().filter(|number| number.is_finite())
        };
        let metres = |column: Option<usize>| Some(number(column)? * unit(column?));
        Some(TabledPicture {
            name: name.to_owned(),
            place: row.place().ok().filter(|place| *place != (0.0, 0.0))?,
            altitude: metres(altitude),
            height_above_take_off: metres(height),
            angles: angles.map(|column| Some(number(column)? * plain[column?].1)),
        })
    });
    Ok(TabledPictures {
        pictures: pictures.collect(),
        notes,
    })
}

/// A name in small letters without seams and units, and the radians of its unit as an angle.
fn plain(name: &str) -> (String, f64) {
    let name = name.to_lowercase();
    let words = name.split(|c: char| !c.is_alphanumeric());
    let mut words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let is_unit = |word: &str| {
        DEGREES.contains(&word)
            || RADIANS.contains(&word)
            || Unit::of(word).is_some()
            || ["decimal", "above"].contains(&word)
    };
    let is_radians = words.iter().any(|word| RADIANS.contains(word));
    while words.len() > 1 && words.last().is_some_and(|word| is_unit(word)) {
        words.pop();
    }
    let unit = if is_radians { 1.0 } else { 1_f64.to_radians() };
    (words.concat(), unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(table: &str) -> TabledPictures {
        placed_pictures("a.csv", table.as_bytes(), &|name| name.contains("DSC")).unwrap()
    }

    #[test]
    fn tables_of_all_makers_tell_the_same_places() {
        let tables = [
            // Pix4D, without names and with them.
            "DSC 1.JPG,47.1234567,8.7654321,520.5\n",
            "imagename,latitude,longitude,altitude\nDSC 1.JPG,47.1234567,8.7654321,520.5\n",
            // Metashape: tabs, decimal commas, quotation marks, no ending.
            "#Label\tX/Longitude\tY/Latitude\tZ/Altitude\n\"DSC 1\"\t8,7654321\t47,1234567\t520,5\n",
            "#Label X/Longitude Y/Latitude Z/Altitude\n\"DSC 1\" 8.7654321  47.1234567 520.5\n",
            "#Label,X/Longitude,Y/Latitude,Z/Altitude\n\"DSC, 1.JPG\",8.7654321,47.1234567,520.5\n",
            "# WGS 84\n#Label;X/Longitude;Y/Latitude;Z/Altitude\nDSC1;8,7654321;47,1234567;520,5\nDSC2;;;\n",
            // OpenDroneMap.
            "EPSG:4326\nDSC1.JPG 8.7654321 47.1234567 520.5\n",
            // Wingtra, Emlid, an absolute path.
            "image name,latitude [decimal degrees],longitude [decimal degrees],altitude [meter]\nDSC1,47.1234567,8.7654321,520.5\n",
            "Name,Latitude,Longitude,Ellipsoidal height,Samples\nDSC1,47.1234567,8.7654321,520.5,5\n",
            "file;lat;lon;alt_ft\nC:\\flight\\DSC1.JPG;47,1234567;8,7654321;1707,6771654\n",
        ];
        for table in tables {
            let found = read(table);
            let [picture] = &found.pictures[..] else {
                panic!("{table}: {found:?}");
            };
            assert!(
                (picture.place.0 - 8.765_432_1).abs() < 1e-12,
                "{table}: {picture:?}"
            );
            assert!(
                (picture.place.1 - 47.123_456_7).abs() < 1e-12,
                "{table}: {picture:?}"
            );
            let altitude = picture.altitude.unwrap();
            assert!((altitude - 520.5).abs() < 1e-6, "{table}: {picture:?}");
            assert_eq!(picture.height_above_take_off, None, "{table}");
        }
    }

    #[test]
    fn angles_are_known_by_their_names_and_units() {
        for table in [
            "# image,latitude,longitude,altitude,roll,pitch,yaw\nDSC1,47.1,8.5,520,1,2,30\n",
            "Filename,Latitude,Longitude,rel_alt_m,Yaw [deg],Pitch [deg],Roll [deg]\nDSC1,47.1,8.5,40,30,2,1\n",
            "file,lat,lon,GimbalYawDegree,GimbalPitchDegree,GimbalRollDegree\nDSC1,47.1,8.5,30,2,1\n",
            "file,lat,lon,yaw_rad,pitch_rad,roll_rad\nDSC1,47.1,8.5,0.5235987756,0.0349065850,0.0174532925\n",
        ] {
            let found = read(table).pictures[0].angles;
            for (angle, right) in found.into_iter().zip([30.0, 2.0, 1.0]) {
                let degrees = angle.unwrap().to_degrees();
                assert!((degrees - right).abs() < 1e-7, "{table}: {degrees}");
            }
        }
        let rel = read("Filename,Latitude,Longitude,rel_alt_m\nDSC1,47.1,8.5,40\n");
        assert_eq!(rel.pictures[0].height_above_take_off, Some(40.0));
        assert_eq!(rel.pictures[0].altitude, None);
        // Angles of photogrammetry turn otherwise.
        let omega = read("file,lat,lon,omega,phi,kappa\nDSC1,47.1,8.5,1,2,3\n");
        assert_eq!(omega.pictures[0].angles, [None; 3]);
    }
}
