//! Flown tracks as files.

use crate::exchange::{FlownPoint, FlownTrack, FlownValues, Format, write_flown};
use pilotage_base::frames::Geodetic;

fn track() -> FlownTrack {
    let point = |i: u32| FlownPoint {
        time: 0.25 * f64::from(i),
        place: Geodetic::from_degrees(47.0 + 1e-4 * f64::from(i), 8.0, 500.5 + f64::from(i)),
        value: (i != 2).then_some(f64::from(i)),
    };
    FlownTrack {
        name: "a & b".to_owned(),
        utc_at_zero: Some(1_400_408_431.0),
        has_height: true,
        values: Some(FlownValues {
            name: "ATT.Roll".to_owned(),
            unit: "deg".to_owned(),
        }),
        points: (0..5).map(point).collect(),
    }
}

fn text(format: Format, track: &FlownTrack) -> String {
    let written = write_flown(format, track).unwrap();
    String::from_utf8(written.bytes).unwrap()
}

#[test]
fn a_table_has_a_row_for_every_place() {
    let text = text(Format::Csv, &track());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "time_s,utc,latitude_deg,longitude_deg,altitude_m,ATT.Roll [deg]"
    );
    assert_eq!(lines[2], "0.25,2014-05-18T10:20:31.250Z,47.0001,8,501.5,1");
    assert!(lines[3].ends_with(",502.5,"), "{}", lines[3]);
    assert_eq!(lines.len(), 6);
}

#[test]
fn a_line_of_kml_has_the_colour_of_its_values() {
    let text = text(Format::Kml, &track());
    assert_eq!(text.matches("<when>").count(), 5);
    assert_eq!(text.matches("<gx:coord>").count(), 5);
    assert!(text.contains("<gx:value></gx:value>") && text.contains("a &amp; b"));
    // From 0, 1, nothing, 3 on to the last.
    let styles: Vec<&str> = text.split("<styleUrl>#").skip(2).collect();
    let names = styles.iter().map(|s| s.split('<').next().unwrap());
    assert_eq!(
        names.collect::<Vec<_>>(),
        ["step0", "step2", "none", "step6"]
    );
}

#[test]
fn what_is_not_known_is_told_and_not_made_up() {
    let mut track = track();
    track.utc_at_zero = None;
    track.has_height = false;
    let gpx = text(Format::Gpx, &track);
    assert!(!gpx.contains("<time>") && !gpx.contains("<ele>"));
    let notes = write_flown(Format::Gpx, &track).unwrap().notes;
    assert!(notes[0].contains("the date is not known"), "{notes:?}");
    assert!(text(Format::Kml, &track).contains("clampToGround"));
    assert!(!text(Format::GeoJson, &track).contains("500.5"));
    let cause = write_flown(Format::Plan, &track).unwrap_err();
    assert!(cause.to_string().contains("cannot hold a flown track"));
    track.points.clear();
    assert!(write_flown(Format::Kml, &track).is_err());
}
