//! Meanings of the columns of a table, guessed from their names.

use pilotage_base::frames::AltitudeFrame;
use pilotage_base::frames::units::{METRES_PER_FOOT, MPS_PER_KNOT};
use pilotage_base::hemisphere_in_name::hemispheres_in_names;

/// Meaning of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CsvRole {
    Latitude,
    Longitude,
    LatitudeMinutes,
    LatitudeSeconds,
    LongitudeMinutes,
    LongitudeSeconds,
    NorthSouth,
    EastWest,
    Altitude,
    Frame,
    Speed,
    Action,
    Radius,
    Turns,
    Seconds,
    Route,
    Id,
    Name,
    Height,
    Enabled,
    BoxNorth,
    BoxEast,
    OffsetNorth,
    OffsetEast,
}

/// Roles by what their columns are called, units and brackets aside; ours come first.
const NAMES: [(CsvRole, &[&str]); 20] = [
    // The German words for width and length alone are no places.
    (
        CsvRole::Latitude,
        &[
            "latitude",
            "lat",
            "gps latitude",
            "gpslatitude",
            "latitude/y", // Mission Planner, of photos
            "latitud",
            "latitudine",
            "breitengrad",
            "geographische breite",
            "geogr breite",
            "y/latitude", // Metashape, of places on the globe
        ],
    ),
    (
        CsvRole::Longitude,
        &[
            "longitude",
            "lon",
            "lng",
            "long",
            "gps longitude",
            "gpslongitude",
            "longitude/x",
            "longitud",
            "longitudine",
            "längengrad",
            "laengengrad",
            "geographische länge",
            "geogr länge",
            "x/longitude",
        ],
    ),
    (
        CsvRole::NorthSouth,
        &[
            "n/s",
            "ns",
            "lat n/s",
            "latitude n/s",
            "lat hemisphere",
            "latitude hemisphere",
            "lat ref",
            "latitude ref",
            "gps latitude ref",
            "gpslatituderef",
            "lat dir",
            "lat direction",
            "latitude direction",
            "lat ns",
            "latitude ns",
            "north south",
            "north/south",
        ],
    ),
    (
        CsvRole::EastWest,
        &[
            "e/w",
            "ew",
            "lon e/w",
            "longitude e/w",
            "lon hemisphere",
            "longitude hemisphere",
            "lon ref",
            "longitude ref",
            "gps longitude ref",
            "gpslongituderef",
            "lon dir",
            "lon direction",
            "longitude direction",
            "lon ew",
            "longitude ew",
            "east west",
            "east/west",
        ],
    ),
    (
        CsvRole::Altitude,
        &["altitude", "alt", "ele", "elevation", "z/altitude"],
    ),
    (
        CsvRole::Frame,
        &[
            "altitude frame",
            "alt frame",
            "frame",
            "altitude mode",
            "altitudemode",
            "altitude reference",
            "altitude ref",
            "alt reference",
            "alt ref",
        ],
    ),
    (
        CsvRole::Speed,
        &["speed", "airspeed", "ground speed", "groundspeed"],
    ),
    (CsvRole::Action, &["action"]),
    (CsvRole::Radius, &["radius", "loiter radius"]),
    (CsvRole::Turns, &["turns", "loiter turns"]),
    (
        CsvRole::Seconds,
        &["seconds", "loiter time", "hold time", "wait", "wait time"],
    ),
    (CsvRole::Route, &["route"]),
    (CsvRole::Id, &["id"]),
    (
        CsvRole::Name,
        &[
            "name",
            "title",
            "label",
            "point id",
            "point name",
            "point no",
            "pointid",
            "nombre",
            "nome",
            "nom",
            "bezeichnung",
        ],
    ),
    (CsvRole::Height, &["height", "height above ground"]),
    (CsvRole::Enabled, &["enabled"]),
    (CsvRole::BoxNorth, &["box north"]),
    (CsvRole::BoxEast, &["box east"]),
    (CsvRole::OffsetNorth, &["offset north"]),
    (CsvRole::OffsetEast, &["offset east"]),
];

impl CsvRole {
    /// Name of the role, for people.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::LatitudeMinutes => return "minutes of the latitude",
            Self::LatitudeSeconds => return "seconds of the latitude",
            Self::LongitudeMinutes => return "minutes of the longitude",
            Self::LongitudeSeconds => return "seconds of the longitude",
            _ => {}
        }
        NAMES
            .iter()
            .find(|(role, _)| *role == self)
            .and_then(|(_, names)| names.first())
            .unwrap_or(&"")
    }

    /// Units that the column may state; none for text.
    pub(super) fn units(self) -> &'static [Unit] {
        match self {
            Self::Latitude | Self::Longitude => &[Unit::Degree, Unit::TenMillionth],
            Self::Speed => &[
                Unit::MetrePerSecond,
                Unit::KilometrePerHour,
                Unit::Knot,
                Unit::MilePerHour,
            ],
            Self::Altitude
            | Self::Radius
            | Self::Height
            | Self::BoxNorth
            | Self::BoxEast
            | Self::OffsetNorth
            | Self::OffsetEast => &[Unit::Metre, Unit::Foot, Unit::Kilometre],
            _ => &[],
        }
    }
}

/// Unit of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Degree,
    /// Ten-millionth of a degree, as autopilots count places in whole numbers.
    TenMillionth,
    Metre,
    Foot,
    Kilometre,
    MetrePerSecond,
    KilometrePerHour,
    Knot,
    MilePerHour,
}

impl Unit {
    const ALL: [(Self, &'static [&'static str]); 9] = [
        (Self::Degree, &["deg", "degree", "degrees", "°"]),
        (Self::TenMillionth, &["e7", "1e7", "dege7", "deg*1e7"]),
        (Self::Metre, &["m", "metre", "metres", "meter", "meters"]),
        (Self::Foot, &["ft", "feet", "foot"]),
        (Self::Kilometre, &["km"]),
        (Self::MetrePerSecond, &["m/s", "mps", "ms"]),
        (Self::KilometrePerHour, &["km/h", "kmh", "kph"]),
        (Self::Knot, &["kt", "kts", "kn", "knots"]),
        (Self::MilePerHour, &["mph"]),
    ];

    pub(super) fn of(word: &str) -> Option<Self> {
        let found = Self::ALL.iter().find(|(_, words)| words.contains(&word));
        found.map(|(unit, _)| *unit)
    }

    /// Factor from a number in the unit to SI, or to degrees.
    pub(super) fn factor(self) -> f64 {
        match self {
            Self::Degree | Self::Metre | Self::MetrePerSecond => 1.0,
            Self::TenMillionth => 1e-7,
            Self::Foot => METRES_PER_FOOT,
            Self::Kilometre => 1000.0,
            Self::KilometrePerHour => 1.0 / 3.6,
            Self::Knot => MPS_PER_KNOT,
            Self::MilePerHour => 5280.0 * METRES_PER_FOOT / 3600.0,
        }
    }
}

/// A column of a table.
#[derive(Debug)]
pub(super) struct CsvColumn {
    /// Its name as it stands.
    pub name: String,
    /// Meaning of the column; `None` if it is not known.
    pub role: Option<CsvRole>,
    /// Unit that its name states.
    pub unit: Option<Unit>,
    /// Reference of altitudes, where its name states that.
    pub frame: Option<AltitudeFrame>,
    /// Letter of the hemisphere that its name states.
    pub hemisphere: Option<char>,
}

/// Meanings of the columns of those names, or in words the error of one.
pub(super) fn columns(names: &[String]) -> Result<Vec<CsvColumn>, String> {
    let mut taken = Vec::new();
    let is_of_little_navmap = LITTLE_NAVMAP
        .iter()
        .all(|name| names.contains(&(*name).to_owned()));
    let columns: Result<Vec<CsvColumn>, String> = names
        .iter()
        .zip(parts_of_angles(names))
        .zip(hemispheres_in_names(names))
        .map(|((name, part), hemisphere)| {
            let of_letter = hemisphere.map(|letter| match letter {
                'N' | 'S' => CsvRole::Latitude,
                _ => CsvRole::Longitude,
            });
            let mut column = match of_letter.or(part) {
                Some(role) => CsvColumn {
                    name: name.clone(),
                    role: Some(role),
                    unit: None,
                    frame: None,
                    hemisphere,
                },
                None => column(name),
            };
            if is_of_little_navmap && column.role == Some(CsvRole::Altitude) {
                column.unit = column.unit.or(Some(Unit::Foot));
            }
            if let Some(role) = column.role {
                if taken.contains(&role) {
                    // The first of several is meant.
                    column.role = None;
                } else {
                    taken.push(role);
                    if let Some(unit) = column.unit
                        && !role.units().contains(&unit)
                    {
                        return Err(format!("column `{name}`: a {} in {unit:?}", role.name()));
                    }
                }
            }
            Ok(column)
        })
        .collect();
    columns.map(|mut columns| {
        name_photos(&mut columns);
        leave_ground(&mut columns);
        columns
    })
}

/// Rows of photos are places that are called by their pictures, whose altitudes are no heights to fly at.
fn name_photos(columns: &mut [CsvColumn]) {
    let is_photo = |column: &CsvColumn| {
        let name = column.name.to_lowercase().replace([' ', '_', '#'], "");
        [
            "photoname",
            "imagename",
            "filename",
            "sourcefile",
            "photo",
            "image",
        ]
        .contains(&name.as_str())
    };
    let is_flown = |column: &CsvColumn| {
        use CsvRole::{Action, Frame, Name, Route, Speed};
        column
            .role
            .is_some_and(|role| [Action, Frame, Name, Route, Speed].contains(&role))
    };
    if columns.iter().any(is_flown) {
        return;
    }
    if let Some(at) = columns.iter().position(is_photo) {
        for column in columns.iter_mut() {
            column.role = column.role.filter(|role| *role != CsvRole::Altitude);
        }
        columns[at].role = Some(CsvRole::Name);
    }
}

/// Elevations of airports, beside their identities, are no altitudes to fly at.
fn leave_ground(columns: &mut [CsvColumn]) {
    let is_called = |column: &CsvColumn, words: &[&str]| {
        let name = column.name.to_lowercase().replace(' ', "_");
        words.iter().any(|word| name == *word)
    };
    let is_airport = |column: &CsvColumn| {
        is_called(column, &["ident", "icao", "icao_code", "iata", "iata_code"])
    };
    let is_flown = |column: &CsvColumn| {
        use CsvRole::{Action, Frame, Route, Speed};
        column
            .role
            .is_some_and(|role| [Action, Frame, Route, Speed].contains(&role))
    };
    if !columns.iter().any(is_airport) || columns.iter().any(is_flown) {
        return;
    }
    for column in columns.iter_mut() {
        let is_ground = column.name.to_lowercase().starts_with("elev");
        column.role = column
            .role
            .filter(|role| *role != CsvRole::Altitude || !is_ground);
    }
}

/// Columns of the user points of Little Navmap, whose elevations are feet.
const LITTLE_NAVMAP: [&str; 3] = ["Ident", "Magnetic Declination", "Visible From"];

/// Roles of the columns that hold the degrees, minutes or seconds of latitudes or longitudes alone; with a greatest value
/// beside it, `lat_min` is the least.
fn parts_of_angles(names: &[String]) -> Vec<Option<CsvRole>> {
    let ends = |name: &String| {
        let plain = parted(name).to_lowercase();
        let is_break = |c: char| c.is_whitespace() || "_-()[]{}.:".contains(c);
        let mut words: Vec<String> = plain
            .split(is_break)
            .filter(|word| !word.is_empty())
            .map(str::to_owned)
            .collect();
        if words.first().is_some_and(|word| word == "gps") {
            words.remove(0);
        }
        // `lat_dec_min`: minutes with decimals.
        words.retain(|word| !["dec", "decimal"].contains(&word.as_str()));
        match &words[..] {
            [of] => (of.clone(), String::new()),
            [of, last] => (of.clone(), last.clone()),
            _ => (String::new(), String::new()),
        }
    };
    let all: Vec<(String, String)> = names.iter().map(ends).collect();
    let has = |of: &str, ends: &[&str]| {
        all.iter()
            .any(|(other, end)| other == of && ends.contains(&end.as_str()))
    };
    let role = |(of, last): &(String, String)| {
        let is_latitude = ["lat", "latitude"].contains(&of.as_str());
        let is_longitude = ["lon", "lng", "long", "longitude"].contains(&of.as_str());
        if !is_latitude && !is_longitude || has(of, &["max"]) {
            return None;
        }
        let degrees = ["d", "dd", "deg", "degs", "degree", "degrees"];
        let minutes = ["min", "mins", "minute", "minutes"];
        let seconds = ["sec", "secs", "second", "seconds"];
        // A letter alone says that only beside the degrees.
        let is_parted = has(of, &degrees);
        // Whole angles beside the parts of the same say all by themselves.
        let is_whole = has(of, &[""]) || has(other_name(of), &[""]);
        if is_parted && is_whole {
            return None;
        }
        let is = |words: &[&str], short: [&str; 2]| {
            words.contains(&last.as_str()) || is_parted && short.contains(&last.as_str())
        };
        let (is_minutes, is_seconds) = (is(&minutes, ["m", "mm"]), is(&seconds, ["s", "ss"]));
        let is_degrees = ["d", "dd"].contains(&last.as_str());
        match (is_minutes, is_seconds, is_latitude) {
            (true, _, true) => Some(CsvRole::LatitudeMinutes),
            (true, _, false) => Some(CsvRole::LongitudeMinutes),
            (_, true, true) => Some(CsvRole::LatitudeSeconds),
            (_, true, false) => Some(CsvRole::LongitudeSeconds),
            (_, _, true) if is_degrees => Some(CsvRole::Latitude),
            (_, _, false) if is_degrees => Some(CsvRole::Longitude),
            _ => None,
        }
    };
    all.iter().map(role).collect()
}

/// The longer or shorter name of the same angle.
fn other_name(of: &str) -> &'static str {
    match of {
        "lat" => "latitude",
        "latitude" => "lat",
        "longitude" => "lon",
        _ => "longitude",
    }
}

/// A name with blanks before the capitals at which its words begin: `AltitudeAGL`, `GPSLatitude`.
pub(super) fn parted(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let is = |at: usize, of: fn(char) -> bool| letters.get(at).is_some_and(|c| of(*c));
    let mut text = String::with_capacity(name.len() + 4);
    for (at, letter) in letters.iter().enumerate() {
        let is_begin = at > 0
            && letter.is_uppercase()
            && (is(at - 1, char::is_lowercase)
                || is(at - 1, char::is_uppercase) && is(at + 1, char::is_lowercase));
        if is_begin {
            text.push(' ');
        }
        text.push(*letter);
    }
    text
}

/// The meaning of a column by its name as it stands, else by the words that its capitals part.
fn column(name: &str) -> CsvColumn {
    let known = |name: &str| {
        let mut names = NAMES.iter();
        let found = names.find(|(_, names)| names.contains(&name));
        found.map(|(role, _)| (*role, None))
    };
    let whole = column_of(name, name, &known);
    if whole.role.is_some() {
        return whole;
    }
    column_of(name, &parted(name), &known)
}

/// Role of a column by its name, and what heights count from that are called so.
type KnownName = (CsvRole, Option<AltitudeFrame>);

/// The column of that name by its words, of which `known` says the role and what heights so called count from.
pub(super) fn column_of(
    name: &str,
    words: &str,
    known: &dyn Fn(&str) -> Option<KnownName>,
) -> CsvColumn {
    let plain = words.to_lowercase();
    let is_break = |c: char| c.is_whitespace() || "_-()[]{}:,.".contains(c);
    let mut words: Vec<&str> = plain.split(is_break).filter(|w| !w.is_empty()).collect();
    let (mut unit, mut frame) = (None, None);
    loop {
        if let Some((role, told)) = known(&words.join(" ")) {
            frame = frame.or(told);
            // An elevation counts from mean sea level, whatever stands beside it.
            if words
                .first()
                .is_some_and(|word| ["ele", "elevation", "z/altitude"].contains(word))
            {
                frame = frame.or(Some(AltitudeFrame::Amsl));
            }
            return CsvColumn {
                name: name.to_owned(),
                role: Some(role),
                unit,
                frame,
                hemisphere: None,
            };
        }
        let last = words.pop();
        match last {
            Some("amsl" | "msl") => frame = Some(AltitudeFrame::Amsl),
            Some("agl") => frame = Some(AltitudeFrame::AboveGround),
            Some("rel" | "relative") => frame = Some(AltitudeFrame::AboveTakeOff),
            Some(word) if unit.is_none() && Unit::of(word).is_some() => unit = Unit::of(word),
            // `[1e7 deg]`
            Some("1e7" | "e7") if unit == Some(Unit::Degree) => unit = Some(Unit::TenMillionth),
            // `[decimal degrees]`
            Some("decimal") if unit == Some(Unit::Degree) => {}
            _ => {
                return CsvColumn {
                    name: name.to_owned(),
                    role: None,
                    unit: None,
                    frame: None,
                    hemisphere: None,
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elevations_of_little_navmap_are_feet() {
        let unit = |names: &str| {
            let names: Vec<String> = names.split(',').map(str::to_owned).collect();
            let columns = columns(&names).unwrap();
            columns
                .into_iter()
                .find(|c| c.name == "Elevation")
                .unwrap()
                .unit
        };
        let names =
            "Name,Ident,Latitude,Longitude,Elevation,Magnetic Declination,Tags,Visible From";
        assert_eq!(unit(names), Some(Unit::Foot));
        assert_eq!(unit("Name,Ident,Latitude,Longitude,Elevation"), None);
    }

    #[test]
    fn columns_are_known_in_the_spellings_that_people_use() {
        let of = |name: &str| {
            let column = column(name);
            (column.role, column.unit, column.frame)
        };
        assert_eq!(of("Lat"), (Some(CsvRole::Latitude), None, None));
        assert_eq!(
            of("Longitude (°)"),
            (Some(CsvRole::Longitude), Some(Unit::Degree), None)
        );
        assert_eq!(
            of("ALT_AGL_ft"),
            (
                Some(CsvRole::Altitude),
                Some(Unit::Foot),
                Some(AltitudeFrame::AboveGround)
            )
        );
        assert_eq!(
            of("speed [km/h]"),
            (Some(CsvRole::Speed), Some(Unit::KilometrePerHour), None)
        );
        assert_eq!(of("altitude_frame"), (Some(CsvRole::Frame), None, None));
        assert_eq!(of("Elevation").2, Some(AltitudeFrame::Amsl));
        assert_eq!(of("elevation agl").2, Some(AltitudeFrame::AboveGround));
        // UgCS and EXIF part words by capitals.
        let agl = Some(AltitudeFrame::AboveGround);
        assert_eq!(of("AltitudeAGL"), (Some(CsvRole::Altitude), None, agl));
        assert_eq!(of("AltitudeAMSL").2, Some(AltitudeFrame::Amsl));
        assert_eq!(of("GPSLatitude").0, Some(CsvRole::Latitude));
        assert_eq!(of("GPSLongitudeRef").0, Some(CsvRole::EastWest));
        assert_eq!(of("lat_ns").0, Some(CsvRole::NorthSouth));
        assert_eq!(of("east_west").0, Some(CsvRole::EastWest));
        assert_eq!(of("colour").0, None);
        assert_eq!(of("m").0, None);
    }

    #[test]
    fn minutes_and_seconds_may_stand_in_columns_of_their_own() {
        let roles = |names: &[&str]| -> Vec<Option<CsvRole>> {
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            let columns = columns(&names).unwrap();
            columns.iter().map(|column| column.role).collect()
        };
        let parts = [
            Some(CsvRole::Latitude),
            Some(CsvRole::LatitudeMinutes),
            Some(CsvRole::LatitudeSeconds),
        ];
        assert_eq!(roles(&["lat_deg", "lat_min", "lat_sec"]), parts);
        assert_eq!(roles(&["LatD", "LatM", "LatS"]), parts);
        assert_eq!(
            roles(&["Latitude Degrees", "Latitude Minutes", "Latitude Seconds"]),
            parts
        );
        let apart = roles(&["lon_dd", "lon_mm", "hold_min", "long_name"]);
        let longitude = [Some(CsvRole::Longitude), Some(CsvRole::LongitudeMinutes)];
        assert_eq!(apart[..2], longitude);
        for names in [
            ["lat", "lon", "lat_min", "lat_max"],
            ["lat", "lon", "long_pause_sec", "name"],
        ] {
            let roles = roles(&names);
            assert!(
                !roles.contains(&Some(CsvRole::LatitudeMinutes)),
                "{names:?}"
            );
            assert!(
                !roles.contains(&Some(CsvRole::LongitudeSeconds)),
                "{names:?}"
            );
        }
    }

    #[test]
    fn a_unit_that_does_not_fit_is_refused() {
        let error = columns(&["speed_ft".to_owned()]).unwrap_err();
        assert!(error.contains("speed_ft"), "{error}");
    }
}
