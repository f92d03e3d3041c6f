//! Choice of the body that the attitude is of: a table may have the angles of an aircraft beside those of the gimbal
//! of its camera.

use pilotage_flight::ChannelName;

use super::header::parts;
use super::settle::give_up;
use super::{ColumnRole, MappedColumn};

/// Words by which a column is about the camera.
const CAMERA: [&str; 5] = ["gimbal", "camera", "cam", "mount", "payload"];
const ANGLES: [ChannelName; 3] = [ChannelName::Heading, ChannelName::Roll, ChannelName::Pitch];

/// Whether a column is about the camera rather than the aircraft.
pub(super) fn is_of_camera(column: &MappedColumn) -> bool {
    let words = parts(&column.name, "").words;
    words.iter().any(|word| CAMERA.contains(&word.as_str()))
}

fn is_angle(column: &MappedColumn) -> bool {
    ANGLES
        .iter()
        .any(|name| column.role == ColumnRole::Channel(*name))
}

/// Whether the pitch that is read is that of the camera itself.
pub(super) fn tells_pitch_of_camera(columns: &[MappedColumn]) -> bool {
    let is_pitch = |column: &MappedColumn| column.role == ColumnRole::Channel(ChannelName::Pitch);
    columns
        .iter()
        .any(|column| is_pitch(column) && is_of_camera(column))
}

/// Leaves heading, roll and pitch to one body, so that no attitude is put together of two: to the one that has a heading,
/// then to the one with more of the three, then to the aircraft. Returns which it is, in a sentence, where there are both.
pub(super) fn of_one_body(columns: &mut [MappedColumn]) -> Option<String> {
    let names = |of_camera: bool| -> Vec<String> {
        let angles = columns.iter().filter(|column| is_angle(column));
        let angles = angles.filter(|column| is_of_camera(column) == of_camera);
        angles.map(|column| column.name.clone()).collect()
    };
    let (aircraft, camera) = (names(false), names(true));
    if aircraft.is_empty() || camera.is_empty() {
        return None;
    }
    let worth = |of_camera: bool| {
        let has = |name: &&ChannelName| {
            let is_it = |column: &MappedColumn| {
                column.role == ColumnRole::Channel(**name) && is_of_camera(column) == of_camera
            };
            columns.iter().any(is_it)
        };
        (has(&&ANGLES[0]), ANGLES.iter().filter(has).count())
    };
    let takes_camera = worth(true) > worth(false);
    for column in columns.iter_mut() {
        if is_angle(column) && is_of_camera(column) != takes_camera {
            let body = if takes_camera {
                "the camera"
            } else {
                "the aircraft"
            };
            give_up(
                column,
                format!("heading, roll and pitch are those of {body}"),
            );
        }
    }
    let (taken, left, body, other) = if takes_camera {
        (camera, aircraft, "camera's gimbal", "aircraft")
    } else {
        (aircraft, camera, "aircraft", "camera's gimbal")
    };
    Some(format!(
        "the attitude is that of the {body} ({}); that of the {other} ({}) is kept as a series of its own",
        taken.join(", "),
        left.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::super::guess_table;
    use super::*;

    fn roles(header: &str) -> (Vec<(String, bool)>, Vec<String>) {
        let count = header.split(',').count() - 1;
        let row = |i: usize| {
            let cells = (0..count).map(|k| format!("{:.1}", 20.0 + ((i * (k + 1)) % 9) as f64));
            format!(
                "{:.1},{}\n",
                0.1 * i as f64,
                cells.collect::<Vec<_>>().join(",")
            )
        };
        let rows: String = (0..60).map(row).collect();
        let map = guess_table("a.csv", format!("{header}\n{rows}").as_bytes()).unwrap();
        let columns = map
            .columns
            .iter()
            .map(|column| (column.name.clone(), is_angle(column)));
        (columns.collect(), map.findings)
    }

    fn taken(header: &str) -> Vec<String> {
        let columns = roles(header).0.into_iter();
        columns
            .filter(|(_, is_angle)| *is_angle)
            .map(|(name, _)| name)
            .collect()
    }

    #[test]
    fn an_attitude_is_of_one_body_and_which_is_told() {
        let header = "time(s),compass_heading(degrees),pitch(degrees),roll(degrees),gimbal_heading(degrees),gimbal_pitch(degrees)";
        assert_eq!(
            taken(header),
            [
                "compass_heading(degrees)",
                "pitch(degrees)",
                "roll(degrees)"
            ]
        );
        let told = roles(header).1;
        assert!(
            told.iter()
                .any(|told| told.contains("that of the aircraft")),
            "{told:?}"
        );
    }

    #[test]
    fn a_heading_of_the_gimbal_alone_is_not_put_to_the_aircrafts_roll_and_pitch() {
        let header =
            "time(s),pitch(degrees),roll(degrees),gimbal_heading(degrees),gimbal_pitch(degrees)";
        assert_eq!(
            taken(header),
            ["gimbal_heading(degrees)", "gimbal_pitch(degrees)"]
        );
        let header = "time(s),pitch(degrees),roll(degrees),gimbal_heading(degrees)";
        assert_eq!(taken(header), ["gimbal_heading(degrees)"]);
    }

    #[test]
    fn one_body_needs_no_word() {
        let header = "time(s),heading(degrees),pitch(degrees),roll(degrees)";
        assert!(roles(header).1.is_empty());
    }
}
