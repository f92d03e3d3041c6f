//! Reading of one photo.

use super::exif::{self, Exif, ExifDirectory};
use super::head::{HeadSearch, head};
use super::place::{PhotoPlace, PhotoPlaceSource};
use super::png::{self, png_head};
use super::xmp::Xmp;
use crate::cells::{Moment, date_and_time, has_zone};
use pilotage_base::angle_text::degrees_of_text;
use pilotage_base::bytes::ByteSource;
use pilotage_base::frames::units::EARTH_RADIUS;
use pilotage_base::frames::{Attitude, wrap_pi};

/// Bytes that mostly hold the head of a photo, and those that always do.
const HEAD: u64 = 1 << 17;
const LONGEST_HEAD: u64 = 1 << 24;
/// Longest TIFF that is read: its tags may stand at its end.
const LONGEST_TIFF: u64 = 1 << 28;

/// Places that one photo tells twice and that lie farther apart are told, metres.
const APART: f64 = 100.0;

/// Metadata of a photo.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Photo {
    /// Name of its file.
    pub name: String,
    /// Length of its file, bytes.
    pub bytes: u64,
    /// Width in pixels, as stored.
    pub width: usize,
    /// Height in pixels, as stored.
    pub height: usize,
    /// Maker and model of the camera, or empty.
    pub camera: String,
    /// Whole seconds since 1970 and a fraction at which it was taken, by the clock of the camera.
    pub taken: Option<(i64, f64)>,
    /// Whether that clock says how far it is from UTC, and that is heeded.
    pub is_utc: bool,
    /// Place at which it was taken.
    pub place: Option<PhotoPlace>,
    /// Source of that place.
    pub placed_by: PhotoPlaceSource,
    /// Height above take-off, metres.
    pub height_above_take_off: Option<f64>,
    /// Attitude of the camera: pitch 0 looks level, -π/2 straight down; the roll is about the view.
    pub gimbal: Option<Attitude>,
    /// Whether the roll of the gimbal is about the picture's top instead, as in `Pix4D`'s properties.
    pub is_roll_about_top: bool,
    /// Whether the angles of the gimbal are there and all zero, which some firmware writes whatever they are: then
    /// they do not count.
    pub is_gimbal_blank: bool,
    /// Attitude of the aircraft.
    pub aircraft: Option<Attitude>,
    /// Direction in which it was taken, radians clockwise from true north.
    pub direction: Option<f64>,
    /// Focal length, metres.
    pub focal_length: Option<f64>,
    /// Focal length that would show as much on film of 36 by 24 mm, metres.
    pub focal_length_35: Option<f64>,
    /// Distance between neighbouring pixels on the sensor, metres.
    pub pixel_pitch: Option<f64>,
    /// Focal length as calibrated by the maker, pixels of the stored picture.
    pub calibrated_focal: Option<f64>,
    /// Turn of the stored picture for people, as EXIF counts it: 1 not at all, 3 half round, 6 a quarter clockwise, 8
    /// a quarter the other way, the even ones between also mirrored.
    pub orientation: u8,
    /// Doubts about its place, in words: a hemisphere that is not named, another datum.
    pub doubts: Vec<String>,
    /// The program that saved it again after it was taken, where one did: it may have turned the picture.
    pub saved_again_by: Option<String>,
}

/// Why a file is no photo.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PhotoError {
    /// It cannot be read.
    #[error("{file}: {cause}")]
    Read {
        /// File.
        file: String,
        /// Why, in words.
        cause: String,
    },
    /// It is no JPEG, PNG or TIFF.
    #[error("{file}: it is neither a JPEG nor a PNG or TIFF picture")]
    NoJpeg {
        /// File.
        file: String,
    },
    /// It does not say how large its picture is.
    #[error("{file}: its picture is missing or cut off")]
    NoPicture {
        /// File.
        file: String,
    },
}

/// Reads what a photo says of itself; of its picture nothing but its size.
pub fn read_photo(source: &dyn ByteSource) -> Result<Photo, PhotoError> {
    let file = || source.name().to_owned();
    let length = source.length();
    let fetch = |count: u64| {
        let bytes = source.read(0, count.min(length) as usize);
        bytes.map_err(|cause| PhotoError::Read {
            file: file(),
            cause,
        })
    };
    let mut bytes = fetch(HEAD)?;
    if bytes.starts_with(b"II*\0") || bytes.starts_with(b"MM\0*") {
        let found = of_tiff(file(), &fetch(LONGEST_TIFF)?);
        return Ok(Photo {
            bytes: length,
            ..found?
        });
    }
    if bytes.starts_with(png::SIGNATURE) {
        let head = png_head(source).map_err(|cause| PhotoError::Read {
            file: file(),
            cause,
        })?;
        let size = head.size;
        let size = size.ok_or_else(|| PhotoError::NoPicture { file: file() })?;
        return Ok(Photo {
            bytes: length,
            ..photo(file(), size, &Exif::read(&head.exif), &Xmp::read(&head.xmp))
        });
    }
    if matches!(head(&bytes), HeadSearch::Part(_)) && length > HEAD {
        bytes = fetch(LONGEST_HEAD)?;
    }
    match head(&bytes) {
        HeadSearch::None => Err(PhotoError::NoJpeg { file: file() }),
        HeadSearch::Whole(head) | HeadSearch::Part(head) => {
            let (width, height) = head
                .size
                .ok_or_else(|| PhotoError::NoPicture { file: file() })?;
            let exif = Exif::read(head.exif.unwrap_or_default());
            let xmp = Xmp::read(head.xmp.unwrap_or_default());
            Ok(Photo {
                bytes: length,
                ..photo(file(), (width, height), &exif, &xmp)
            })
        }
    }
}

/// Metadata of a TIFF: its tags are those that a JPEG has in its EXIF.
fn of_tiff(file: String, bytes: &[u8]) -> Result<Photo, PhotoError> {
    let exif = Exif::read(bytes);
    let side = |tag| exif.image.whole(tag).filter(|side| *side > 0);
    let size = side(exif::WIDTH).zip(side(exif::HEIGHT));
    let Some((width, height)) = size else {
        return Err(PhotoError::NoPicture { file });
    };
    let xmp = Xmp::read(exif.image.bytes(exif::XMP).unwrap_or_default());
    Ok(photo(file, (width as usize, height as usize), &exif, &xmp))
}

fn photo(name: String, (width, height): (usize, usize), exif: &Exif, xmp: &Xmp) -> Photo {
    let image = &exif.image;
    let words = [exif::MAKE, exif::MODEL].map(|tag| image.text(tag).unwrap_or_default());
    let [make, model] = words;
    // Some models begin with the name of their maker.
    let camera = if model.starts_with(&make) {
        model
    } else {
        format!("{make} {model}")
    };
    let (taken, is_utc) = match taken(exif) {
        (None, _) => taken_of_xmp(xmp),
        of_exif => of_exif,
    };
    let dji = |name: &str| xmp.number(&[&format!("drone-dji:{name}")]);
    let millimetres = |value: f64| value / 1e3;
    let [x, y] = ["X", "Y"].map(|axis| positive(dji(&format!("CalibratedOpticalCenter{axis}"))));
    let reduction = reduction(&exif.photo, (width, height), x.zip(y));
    let (gimbal, is_roll_about_top) = gimbal(xmp);
    let aircraft = aircraft(xmp);
    let is_zero = |a: &Attitude| [a.roll, a.pitch, a.yaw].iter().all(|angle| *angle == 0.0);
    let is_gimbal_blank =
        gimbal.as_ref().is_some_and(is_zero) && !aircraft.as_ref().is_none_or(is_zero);
    Photo {
        name,
        bytes: 0,
        width,
        height,
        camera: camera.trim().to_owned(),
        taken,
        is_utc,
        place: place(&exif.gps, xmp),
        placed_by: PhotoPlaceSource::Photo,
        height_above_take_off: xmp.number(&HEIGHTS),
        gimbal: gimbal.filter(|_| !is_gimbal_blank),
        is_roll_about_top,
        is_gimbal_blank,
        aircraft,
        direction: direction(&exif.gps),
        focal_length: positive(exif.photo.real(exif::FOCAL_LENGTH)).map(millimetres),
        focal_length_35: positive(exif.photo.real(exif::FOCAL_LENGTH_35)).map(millimetres),
        pixel_pitch: pixel_pitch(&exif.photo).map(|pitch| pitch / reduction),
        calibrated_focal: positive(dji("CalibratedFocalLength")).map(|focal| focal * reduction),
        orientation: image
            .whole(exif::ORIENTATION)
            .filter(|o| (1..=8).contains(o))
            .unwrap_or(1) as u8,
        doubts: doubts(&exif.gps, xmp),
        saved_again_by: saved_again(exif),
    }
}

fn positive(value: Option<f64>) -> Option<f64> {
    value.filter(|value| *value > 0.0)
}

/// When a photo was taken, and whether that is UTC. What changed it later may have set its third clock, and hardly the time
/// of the satellites.
fn taken(exif: &Exif) -> (Option<(i64, f64)>, bool) {
    let [original, digitized, changed] = [
        (
            &exif.photo,
            exif::DATE_TIME_ORIGINAL,
            exif::SUB_SECONDS_ORIGINAL,
            exif::OFFSET_TIME_ORIGINAL,
        ),
        (
            &exif.photo,
            exif::DATE_TIME_DIGITIZED,
            exif::SUB_SECONDS_DIGITIZED,
            exif::OFFSET_TIME_DIGITIZED,
        ),
        (
            &exif.image,
            exif::DATE_TIME,
            exif::SUB_SECONDS,
            exif::OFFSET_TIME,
        ),
    ];
    let told = |(directory, moment, fraction, offset): (&ExifDirectory, u16, u16, u16)| {
        let text = directory.text(moment)?;
        let digits = exif
            .photo
            .text(fraction)
            .filter(|f| f.bytes().all(|b| b.is_ascii_digit()));
        let text = digits.map_or(text.clone(), |digits| format!("{text}.{digits}"));
        let offset = exif.photo.text(offset);
        let with_offset = offset.and_then(|offset| date_and_time(&format!("{text}{offset}")));
        let is_utc = with_offset.is_some();
        match with_offset.or_else(|| date_and_time(&text))? {
            Moment::Absolute(whole, part) => Some(((whole, part), is_utc)),
            Moment::Relative(_) => None,
        }
    };
    let found = told(original)
        .or_else(|| told(digitized))
        .or_else(|| Some((satellite_time(exif)?, true)))
        .or_else(|| told(changed));
    found.map_or((None, false), |(time, is_utc)| (Some(time), is_utc))
}

/// Coordinated universal time of the receiver: whole seconds since 1970 and the rest.
fn satellite_time(exif: &Exif) -> Option<(i64, f64)> {
    let date = exif.gps.text(exif::GPS_DATE)?;
    let &[hours, minutes, seconds] = exif.gps.reals(exif::GPS_TIME).as_slice() else {
        return None;
    };
    let Moment::Absolute(day, _) = date_and_time(&format!("{date} 00:00:00"))? else {
        return None;
    };
    let seconds = hours * 3600.0 + minutes * 60.0 + seconds;
    (0.0..=86_401.0)
        .contains(&seconds)
        .then(|| (day + seconds.floor() as i64, seconds.fract()))
}

/// Degrees, minutes and seconds together, radians; negative where `reference` says so. `None` where one is no number, but
/// for those behind a fraction, which are none.
fn angle(gps: &ExifDirectory, tag: u16, reference: u16, negative: &str) -> Option<f64> {
    let mut parts = gps.reals(tag);
    parts.truncate(3);
    let last = parts.iter().rposition(|part| part.is_finite())?;
    if parts[last].fract() != 0.0 {
        parts.truncate(last + 1);
    }
    let parts = parts.iter().zip([1.0, 60.0, 3600.0]);
    let degrees: f64 = parts.map(|(part, of_degree)| part / of_degree).sum();
    if !degrees.is_finite() {
        return None;
    }
    let letter = gps
        .text(reference)
        .map(|letter| letter.trim().to_uppercase());
    let sign = if letter.is_some_and(|letter| letter.starts_with(negative)) {
        -1.0
    } else {
        1.0
    };
    Some(sign * degrees.to_radians())
}

/// Whether EXIF says nothing of a hemisphere.
fn lacks_letter(gps: &ExifDirectory, reference: u16) -> bool {
    gps.text(reference)
        .is_none_or(|letter| letter.trim().is_empty())
}

fn place(gps: &ExifDirectory, xmp: &Xmp) -> Option<PhotoPlace> {
    let by_xmp = place_of_xmp(xmp);
    // Where EXIF names no hemisphere, XMP of the same photo may.
    let signed = |value: f64, reference: u16, own: Option<f64>| match own {
        Some(own) if lacks_letter(gps, reference) => value.copysign(own),
        _ => value,
    };
    let latitude = angle(gps, exif::LATITUDE, exif::LATITUDE_REF, "S")
        .map(|it| signed(it, exif::LATITUDE_REF, by_xmp.map(|(latitude, _)| latitude)));
    let longitude = angle(gps, exif::LONGITUDE, exif::LONGITUDE_REF, "W").map(|it| {
        signed(
            it,
            exif::LONGITUDE_REF,
            by_xmp.map(|(_, longitude)| longitude),
        )
    });
    let of_exif = latitude.zip(longitude);
    let is_place = |(latitude, longitude): &(f64, f64)| {
        latitude.abs() <= std::f64::consts::FRAC_PI_2
            && longitude.abs() <= std::f64::consts::PI
            && (*latitude, *longitude) != (0.0, 0.0)
    };
    let (latitude, longitude) = of_exif.filter(is_place).or_else(|| place_of_xmp(xmp))?;
    let is_on_globe = is_place(&(latitude, longitude));
    let below = matches!(gps.whole(exif::ALTITUDE_REF), Some(1 | 3));
    let altitude = gps.real(exif::ALTITUDE).map(|a| if below { -a } else { a });
    let altitude = altitude.or_else(|| altitude_of_xmp(xmp));
    is_on_globe.then_some(PhotoPlace {
        latitude,
        longitude,
        altitude,
    })
}

/// Names of WGS 84 and of the datums that are within a few metres of it, in capitals, without what is no letter or digit.
const NEAR_WGS_84: [&str; 19] = [
    "WGS84",
    "WGS1984",
    "GCSWGS1984",
    "WORLDGEODETICSYSTEM1984",
    "EPSG4326",
    "EPSG4979",
    "CGCS2000",
    "ETRS89",
    "ETRS1989",
    "EPSG4258",
    "ITRF",
    "JGD2000",
    "JGD2011",
    "GDA94",
    "GDA2020",
    "NAD83",
    "NAD1983",
    "NZGD2000",
    "SIRGAS2000",
];

/// Whether a datum is WGS 84 or equals it within a few metres; that of no name is taken for it.
fn is_near_wgs_84(datum: &str) -> bool {
    let plain: String = datum.chars().filter(char::is_ascii_alphanumeric).collect();
    let plain = plain.to_uppercase();
    // Behind the name may stand a realization: WGS 84 (G1762), ITRF2014.
    plain.is_empty() || NEAR_WGS_84.iter().any(|near| plain.starts_with(near))
}

/// Doubts about the place of a photo, in words.
fn doubts(gps: &ExifDirectory, xmp: &Xmp) -> Vec<String> {
    let mut doubts = Vec::new();
    // EXIF 3.0 has 2 and 3 for heights above and below the ellipsoid; DJI says it of receivers with corrections.
    let is_of_ellipsoid = matches!(gps.whole(exif::ALTITUDE_REF), Some(2 | 3))
        || xmp
            .text("drone-dji:AltitudeType")
            .is_some_and(|it| it == "RtkAlt");
    if is_of_ellipsoid {
        doubts.push(
            "the height is above the ellipsoid of WGS 84, which lies up to 107 m from sea level"
                .to_owned(),
        );
    }
    let has_own = place(gps, &Xmp::default()).is_some();
    let Some(of_exif) = place(gps, xmp).filter(|_| has_own) else {
        let angles = [exif::LATITUDE, exif::LONGITUDE].map(|tag| gps.reals(tag));
        if angles.concat().iter().any(|part| part.is_nan()) {
            doubts.push("a number of its place in EXIF is over zero: it is left out".to_owned());
        }
        return doubts;
    };
    let by_xmp = place_of_xmp(xmp).map_or("", |_| ", as XMP says");
    for (tag, name, angle, meant) in [
        (
            exif::LATITUDE_REF,
            "GPSLatitudeRef",
            of_exif.latitude,
            ["north", "south"],
        ),
        (
            exif::LONGITUDE_REF,
            "GPSLongitudeRef",
            of_exif.longitude,
            ["east", "west"],
        ),
    ] {
        if lacks_letter(gps, tag) {
            let meant = meant[usize::from(angle < 0.0)];
            doubts.push(format!("{name} is missing, and {meant} is taken{by_xmp}"));
        }
    }
    let datum = gps.text(exif::MAP_DATUM).unwrap_or_default();
    if !is_near_wgs_84(&datum) {
        doubts.push(format!(
            "GPSMapDatum says {}, and WGS 84 is taken: places may be hundreds of metres off",
            datum.trim()
        ));
    }
    if gps
        .text(exif::GPS_STATUS)
        .is_some_and(|it| it.trim() == "V")
    {
        doubts.push(
            "GPSStatus says that the receiver had lost its fix, and its last place is taken"
                .to_owned(),
        );
    }
    if let Some((latitude, longitude)) = place_of_xmp(xmp) {
        let north = EARTH_RADIUS * (latitude - of_exif.latitude);
        let east = EARTH_RADIUS * wrap_pi(longitude - of_exif.longitude) * latitude.cos();
        if north.hypot(east) > APART {
            doubts.push(format!(
                "EXIF and XMP tell places more than {APART:.0} m apart, and that of EXIF is taken"
            ));
        }
    }
    doubts
}

/// Heights above take-off, and altitudes, as makers call them.
const HEIGHTS: [&str; 3] = [
    "drone-dji:RelativeAltitude",
    "drone-skydio:RelativeAltitude",
    "Camera:AboveGroundAltitude",
];
const ALTITUDES: [&str; 2] = [
    "drone-dji:AbsoluteAltitude",
    "drone-skydio:AbsoluteAltitude",
];

/// Altitude by XMP, metres; Adobe writes its sign into a property of its own.
fn altitude_of_xmp(xmp: &Xmp) -> Option<f64> {
    let of_adobe = || {
        let metres = xmp.number(&["exif:GPSAltitude"])?;
        let is_below = xmp.number(&["exif:GPSAltitudeRef"]) == Some(1.0);
        Some(if is_below { -metres } else { metres })
    };
    xmp.number(&ALTITUDES).or_else(of_adobe)
}

/// When a photo was taken by XMP, and whether that is UTC.
fn taken_of_xmp(xmp: &Xmp) -> (Option<(i64, f64)>, bool) {
    let names = [
        "exif:DateTimeOriginal",
        "photoshop:DateCreated",
        "xmp:CreateDate",
    ];
    let times = names.iter().filter_map(|name| xmp.text(name));
    let found = times
        .into_iter()
        .find_map(|text| match date_and_time(text)? {
            Moment::Absolute(whole, part) => Some((Some((whole, part)), has_zone(text))),
            Moment::Relative(_) => None,
        });
    found.unwrap_or((None, false))
}

/// Latitude and longitude at which a photo was taken by XMP, radians: as its maker writes it, or as Adobe
/// does (`47,30.125N`).
fn place_of_xmp(xmp: &Xmp) -> Option<(f64, f64)> {
    let maker = [
        // Written so by older firmware.
        (
            "drone-dji:GpsLatitude",
            ["drone-dji:GpsLongitude", "drone-dji:GpsLongtitude"],
        ),
        ("drone-dji:Latitude", ["drone-dji:Longitude"; 2]),
        ("drone-skydio:Latitude", ["drone-skydio:Longitude"; 2]),
        ("drone-parrot:GPSLatitude", ["drone-parrot:GPSLongitude"; 2]),
    ];
    let of_maker = maker
        .iter()
        .find_map(|(latitude, longitude)| xmp.number(&[latitude]).zip(xmp.number(longitude)));
    let of_adobe = || {
        let angle = |name| xmp.text(name).and_then(adobe_angle);
        angle("exif:GPSLatitude").zip(angle("exif:GPSLongitude"))
    };
    let (latitude, longitude) = of_maker.or_else(of_adobe)?;
    Some((latitude.to_radians(), longitude.to_radians()))
}

/// Degrees of `47,30.125N` or `8,15,30W`, as XMP has them: degrees, minutes, seconds, hemisphere.
fn adobe_angle(text: &str) -> Option<f64> {
    degrees_of_text(&text.replace(',', " "))
}

/// An attitude of three properties in degrees; a roll that is not told is none.
fn attitude(xmp: &Xmp, [roll, pitch, yaw]: [&str; 3]) -> Option<Attitude> {
    let angle = |name: &str| xmp.number(&[name]).map(f64::to_radians);
    Some(Attitude {
        roll: angle(roll).unwrap_or(0.0),
        pitch: angle(pitch)?,
        yaw: angle(yaw)?,
    })
}

/// The attitude of the camera, as its maker writes it, pitch 0 level; else as `Pix4D`'s properties have it, and whether it
/// is theirs.
fn gimbal(xmp: &Xmp) -> (Option<Attitude>, bool) {
    let makers = [
        [
            "drone-dji:GimbalRollDegree",
            "drone-dji:GimbalPitchDegree",
            "drone-dji:GimbalYawDegree",
        ],
        [
            "drone-parrot:CameraRollDegree",
            "drone-parrot:CameraPitchDegree",
            "drone-parrot:CameraYawDegree",
        ],
        [
            "drone-skydio:CameraOrientationNED:Roll",
            "drone-skydio:CameraOrientationNED:Pitch",
            "drone-skydio:CameraOrientationNED:Yaw",
        ],
    ];
    match makers.into_iter().find_map(|names| attitude(xmp, names)) {
        Some(of_maker) => (Some(of_maker), false),
        None => (camera_attitude(xmp), true),
    }
}

/// The attitude of the aircraft, as its maker writes it.
fn aircraft(xmp: &Xmp) -> Option<Attitude> {
    let makers = [
        [
            "drone-dji:FlightRollDegree",
            "drone-dji:FlightPitchDegree",
            "drone-dji:FlightYawDegree",
        ],
        [
            "drone-parrot:DroneRollDegree",
            "drone-parrot:DronePitchDegree",
            "drone-parrot:DroneYawDegree",
        ],
    ];
    makers.into_iter().find_map(|names| attitude(xmp, names))
}

/// The attitude as `Pix4D`'s properties have it, which other makers use: pitch 0 looks straight down.
fn camera_attitude(xmp: &Xmp) -> Option<Attitude> {
    let pix4d = attitude(xmp, ["Camera:Roll", "Camera:Pitch", "Camera:Yaw"])?;
    Some(Attitude {
        pitch: pix4d.pitch - std::f64::consts::FRAC_PI_2,
        ..pix4d
    })
}

fn direction(gps: &ExifDirectory) -> Option<f64> {
    // Directions from magnetic north are of no use without knowing how far that is from true north.
    let is_true = gps
        .text(exif::DIRECTION_REF)
        .is_none_or(|r| r.starts_with('T'));
    gps.real(exif::DIRECTION)
        .filter(|_| is_true)
        .map(f64::to_radians)
}

/// Distance between pixels of the picture as it was taken.
fn pixel_pitch(photo: &ExifDirectory) -> Option<f64> {
    let per_unit = positive(photo.real(exif::FOCAL_PLANE_X))?;
    let unit = match photo.whole(exif::FOCAL_PLANE_UNIT).unwrap_or(2) {
        2 => 0.0254,
        3 => 0.01,
        4 => 0.001,
        5 => 1e-6,
        _ => return None,
    };
    Some(unit / per_unit)
}

/// Size of the stored picture over that of the one that was taken, which programs that make photos smaller leave in EXIF, or
/// the maker's calibration tells by the picture's middle. One of another shape was cut out, and its pixels are as they were.
fn reduction(
    photo: &ExifDirectory,
    (width, height): (usize, usize),
    calibrated_middle: Option<(f64, f64)>,
) -> f64 {
    let side = |tag| photo.whole(tag).filter(|side| *side > 0);
    let (long, short) = (width.max(height) as f64, width.min(height) as f64);
    let by_exif = match [exif::PIXEL_WIDTH, exif::PIXEL_HEIGHT].map(side) {
        [Some(taken), None] => width as f64 / taken as f64,
        [Some(one), Some(other)] => {
            let (taken_long, taken_short) = (one.max(other) as f64, one.min(other) as f64);
            let by_long = long / taken_long;
            let is_alike = (short - by_long * taken_short).abs() <= 1.0;
            if is_alike { by_long } else { 1.0 }
        }
        [None, _] => 1.0,
    };
    // Lenses sit a few hundredths of the sides beside the middle: less is none.
    let is_smaller = |it: &f64| !(0.9..1.1).contains(it);
    let by_middle = calibrated_middle.and_then(|(x, y)| {
        let [by_x, by_y] = [width as f64 / (2.0 * x), height as f64 / (2.0 * y)];
        (is_smaller(&by_x) && !is_smaller(&(by_x / by_y))).then_some(by_x)
    });
    match by_middle {
        Some(by_middle) if !is_smaller(&by_exif) => by_middle,
        _ => by_exif,
    }
}

/// The program that changed a photo later than it was taken.
fn saved_again(exif: &Exif) -> Option<String> {
    let changed = exif.image.text(exif::DATE_TIME)?;
    let taken = exif.photo.text(exif::DATE_TIME_ORIGINAL)?;
    if changed == taken {
        return None;
    }
    Some(
        exif.image
            .text(exif::SOFTWARE)
            .unwrap_or_else(|| "a program without a name".to_owned()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_adobe_have_their_minutes_behind_commas() {
        assert_eq!(adobe_angle("47,30.0N"), Some(47.5));
        assert_eq!(adobe_angle("8,15,36W"), Some(-8.26));
        assert_eq!(adobe_angle("47.5"), None);
    }

    #[test]
    fn datums_that_equal_wgs_84_are_no_doubt() {
        for near in [
            "WGS-84",
            "World Geodetic System 1984",
            "EPSG:4326",
            "wgs 84 (G1762)",
            "ETRS89",
            "JGD2011",
            "GDA2020",
            "NAD83(2011)",
            "ITRF2014",
            "",
        ] {
            assert!(is_near_wgs_84(near), "{near}");
        }
        for far in [
            "TOKYO",
            "NAD27",
            "WGS 72",
            "ED50",
            "EPSG:4301",
            "Pulkovo 1942",
        ] {
            assert!(!is_near_wgs_84(far), "{far}");
        }
    }

    #[test]
    fn xmp_alone_tells_depth_and_time() {
        let xmp = Xmp::read(
            br#"<x:xmpmeta xmlns:x="adobe:ns:meta/" xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
            xmlns:exif="http://ns.adobe.com/exif/1.0/" xmlns:q="http://ns.adobe.com/xap/1.0/"><rdf:RDF><rdf:Description
            exif:GPSAltitude="4000/10" exif:GPSAltitudeRef="1" q:CreateDate="2024-05-13T12:00:00.5+02:00"/></rdf:RDF></x:xmpmeta>"#,
        );
        assert_eq!(altitude_of_xmp(&xmp), Some(-400.0));
        // date -u -d '2024-05-13 10:00:00' +%s
        assert_eq!(taken_of_xmp(&xmp), (Some((1_715_594_400, 0.5)), true));
    }
}
