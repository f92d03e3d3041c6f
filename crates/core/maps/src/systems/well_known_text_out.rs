//! A reference system as well-known text of the first version, in the words that GDAL and ESRI share.

use pilotage_base::frames::{OtherSystem, ProjectionMethod, SystemNumbers};

use crate::systems::{datums, units};

/// The text of `system`, which people call `name`.
pub(super) fn write(system: &OtherSystem, name: &str) -> String {
    let numbers = system.numbers;
    let globe = globe(numbers);
    let code = system
        .code
        .map(|code| format!(r#",AUTHORITY["EPSG","{code}"]"#));
    let code = code.unwrap_or_default();
    if numbers.method == ProjectionMethod::Geographic {
        let open = globe.trim_end_matches(']');
        // The last bracket but one closes the unit.
        return format!("{open}]{code}]");
    }
    let unit = numbers.unit;
    let length = |metres: f64| rounded(metres / unit, 1e7);
    let parameters: Vec<(&str, f64)> = [
        ("latitude_of_origin", degrees(numbers.latitude_0)),
        ("central_meridian", degrees(numbers.longitude_0)),
        ("scale_factor", numbers.scale),
        ("standard_parallel_1", degrees(numbers.parallels[0])),
        ("standard_parallel_2", degrees(numbers.parallels[1])),
        ("pseudo_standard_parallel_1", degrees(numbers.parallels[0])),
        (
            "azimuth",
            if numbers.method == ProjectionMethod::Krovak {
                30.288_139_752_777_8
            } else {
                90.0
            },
        ),
        ("rectified_grid_angle", 90.0),
        ("false_easting", length(numbers.offset[0])),
        ("false_northing", length(numbers.offset[1])),
    ]
    .into_iter()
    .filter(|(name, _)| belongs(numbers.method, numbers.parallels, name))
    .collect();
    let is_centred = matches!(
        numbers.method,
        ProjectionMethod::Albers
            | ProjectionMethod::LambertAzimuthal
            | ProjectionMethod::SwissOblique
            | ProjectionMethod::Krovak
    );
    let parameters: Vec<String> = parameters
        .into_iter()
        .map(|(name, value)| {
            let name = match name {
                "latitude_of_origin" if is_centred => "latitude_of_center",
                "central_meridian" if is_centred => "longitude_of_center",
                other => other,
            };
            format!(r#"PARAMETER["{name}",{value}]"#)
        })
        .collect();
    let axes = if numbers.method == ProjectionMethod::Krovak {
        r#",AXIS["Easting",EAST],AXIS["Northing",NORTH]"#
    } else {
        ""
    };
    let unit_name = match unit {
        1.0 => "metre",
        units::FOOT => "foot",
        units::SURVEY_FOOT => "US survey foot",
        _ => "unit",
    };
    format!(
        r#"PROJCS["{name}",{globe},PROJECTION["{}"],{},UNIT["{unit_name}",{unit}]{axes}{code}]"#,
        projection(numbers.method, numbers.parallels),
        parameters.join(","),
    )
}

/// The system of longitude and latitude.
fn globe(numbers: &SystemNumbers) -> String {
    let datum = &numbers.datum;
    let ellipsoid = &datum.ellipsoid;
    let inverse = match ellipsoid.flattening {
        0.0 => 0.0,
        flattening => 1.0 / flattening,
    };
    let is_shifted = datum.shift != [0.0; 7] || datum.accuracy.is_nan();
    let shift = datums::in_seconds(datum.shift).map(|v| rounded(v, 1e9).to_string());
    let shift = if is_shifted {
        format!(",TOWGS84[{}]", shift.join(","))
    } else {
        String::new()
    };
    let is_geographic = numbers.method == ProjectionMethod::Geographic;
    let angle = if is_geographic {
        numbers.unit
    } else {
        1.0_f64.to_radians()
    };
    format!(
        r#"GEOGCS["{0}",DATUM["{0}",SPHEROID["{0}",{1},{2}]{shift}],PRIMEM["{3}",{4}],UNIT["{5}",{angle}]]"#,
        datum.name,
        ellipsoid.semi_major,
        rounded(inverse, 1e10),
        if numbers.prime_meridian == 0.0 {
            "Greenwich"
        } else {
            "Other"
        },
        rounded(numbers.prime_meridian / angle, 1e12),
        if degrees(angle) == 1.0 {
            "degree"
        } else {
            "angle"
        },
    )
}

fn degrees(radians: f64) -> f64 {
    rounded(radians.to_degrees(), 1e12)
}

fn rounded(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit
}

fn projection(method: ProjectionMethod, parallels: [f64; 2]) -> &'static str {
    match method {
        ProjectionMethod::Geographic => "",
        ProjectionMethod::TransverseMercator => "Transverse_Mercator",
        ProjectionMethod::Mercator => "Mercator_1SP",
        ProjectionMethod::LambertConformal if parallels[0] == parallels[1] => {
            "Lambert_Conformal_Conic_1SP"
        }
        ProjectionMethod::LambertConformal => "Lambert_Conformal_Conic_2SP",
        ProjectionMethod::Albers => "Albers_Conic_Equal_Area",
        ProjectionMethod::LambertAzimuthal => "Lambert_Azimuthal_Equal_Area",
        ProjectionMethod::PolarStereographic => "Polar_Stereographic",
        ProjectionMethod::ObliqueStereographic => "Oblique_Stereographic",
        ProjectionMethod::SwissOblique => "Hotine_Oblique_Mercator_Azimuth_Center",
        ProjectionMethod::Krovak => "Krovak",
    }
}

/// Whether a projection has that parameter.
fn belongs(method: ProjectionMethod, parallels: [f64; 2], parameter: &str) -> bool {
    let is_cone = match method {
        ProjectionMethod::LambertConformal => parallels[0] != parallels[1],
        ProjectionMethod::Albers => true,
        _ => false,
    };
    match parameter {
        "standard_parallel_1" | "standard_parallel_2" => is_cone,
        "scale_factor" => !is_cone && method != ProjectionMethod::LambertAzimuthal,
        "rectified_grid_angle" => method == ProjectionMethod::SwissOblique,
        "azimuth" => matches!(
            method,
            ProjectionMethod::SwissOblique | ProjectionMethod::Krovak
        ),
        "pseudo_standard_parallel_1" => method == ProjectionMethod::Krovak,
        _ => true,
    }
}
