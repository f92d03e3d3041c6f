//! Pictures that a table names, with the times of its rows.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_base::files::{FileSet, find, folder_of};
use pilotage_base::text::by_count;
use pilotage_flight::CameraFile;
use pilotage_raster::camera::{CameraModel, UNSTATED_MOUNT_DEVIATION};
use pilotage_raster::raster::decode_picture;

use super::ColumnMap;
use super::bodies::tells_pitch_of_camera;
use super::header::parts;
use crate::folder::{ChannelFile, CsvTable, FramesFile};

/// Endings of pictures.
pub(super) const ENDINGS: [&str; 3] = [".jpg", ".jpeg", ".png"];
/// Field of view across that is assumed of a camera that nobody describes, degrees.
const ACROSS: f64 = 60.0;

/// The pictures that a column of one of the tables names, each row one, and a camera of their size; `None` if no column
/// does.
pub(super) fn named(
    files: &Arc<dyn FileSet>,
    maps: &[ColumnMap],
    tables: &BTreeMap<String, Arc<CsvTable>>,
    channels: &[ChannelFile],
) -> Option<((FramesFile, CameraFile), String)> {
    maps.iter().find_map(|map| {
        let table = tables.get(&map.file)?;
        let time = channels.iter().find(|c| c.file == map.file)?.time.clone();
        map.columns.iter().find_map(|column| {
            let names = table.texts(&column.name).ok()?;
            let is_picture = |name: &&str| {
                let name = name.to_lowercase();
                ENDINGS.iter().any(|ending| name.ends_with(ending))
            };
            let first = *names.first().filter(|_| names.iter().all(is_picture))?;
            let (path, bytes) = find(files.as_ref(), &[folder_of(&map.file)], first).ok()?;
            let picture = decode_picture(&bytes).ok()?;
            let frames = FramesFile {
                file: map.file.clone(),
                name: column.name.clone(),
                time: time.clone(),
                directory: folder_of(&path).to_owned(),
                stored_turn_deg: BTreeMap::new(),
            };
            let mount_deviation = if tells_pitch_of_camera(&map.columns) {
                0.0
            } else {
                UNSTATED_MOUNT_DEVIATION
            };
            let camera = CameraFile::of(&CameraModel {
                mount_deviation,
                ..CameraModel::pinhole(picture.width(), picture.height(), ACROSS.to_radians())
            });
            let note = format!(
                "{} names {} {}; the camera is assumed to look straight down, to within 10° if nothing tells its \
                 angles, and to see {ACROSS:.0}° across",
                column.name,
                names.len(),
                by_count(names.len(), "picture", "pictures")
            );
            Some(((frames, camera), note))
        })
    })
}

/// Takes the roll and the pitch out of `channels` that are told beside a gimbal's: a maker that names angles those of the
/// flight has others for the camera, which does not turn with the aircraft. Says so, if there were any.
pub(super) fn without_those_of_flight(channels: &mut Vec<ChannelFile>) -> Option<String> {
    let mut names = Vec::new();
    channels.retain(|channel| {
        let column = channel.value.as_ref().map(|value| &value.column);
        let is_tilt = ["roll", "pitch"].contains(&channel.name.as_str());
        let of_flight = column.filter(|column| {
            is_tilt && parts(column, "").words.first().map(String::as_str) == Some("flight")
        });
        names.extend(of_flight.cloned());
        of_flight.is_none()
    });
    (!names.is_empty()).then(|| {
        format!(
            "{} are the aircraft's, not those of its camera, whose gimbal's angles nothing tells: it counts as level",
            names.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use pilotage_base::files::MemoryFiles;
    use pilotage_flight::ChannelName;
    use pilotage_raster::raster::{Picture, encode_png};

    use super::super::{flight_of_tables, guess_table};
    use super::*;
    use crate::folder::FlightFolder;

    /// The flight of `rows` rows of a table with the header `names`: each a picture, five seconds after the row before and
    /// 1e-4 degrees north of it at longitude 8, with the other cells that `rest` says of it.
    fn flight_of(names: &str, rows: i32, rest: impl Fn(i32) -> String) -> FlightFolder {
        let picture = encode_png(&Picture::filled(8, 6, [7; 3])).expect("a small picture");
        let mut table = format!("{names}\n");
        let mut files = MemoryFiles::default();
        for i in 0..rows {
            let latitude = 47.0 + 1e-4 * f64::from(i);
            let (time, rest) = (5 * i, rest(i));
            writeln!(table, "p{i}.png,{time},{latitude:.6},8.0,{rest}").expect("it is a text");
            files.0.insert(format!("p{i}.png"), picture.clone());
        }
        let bytes = table.into_bytes();
        files.0.insert("t.csv".to_owned(), bytes.clone());
        let files: Arc<dyn FileSet> = Arc::new(files);
        let maps = [guess_table("t.csv", &bytes).expect("a table")];
        flight_of_tables(&files, &maps).expect("a flight")
    }

    #[test]
    fn a_camera_turns_with_the_aircraft_unless_its_table_names_angles_of_the_flight() {
        for (heading, roll, pitch, (has_tilt, is_known)) in [
            ("heading_deg", "roll_deg", "pitch_deg", (true, false)),
            (
                "flight_yaw_deg",
                "flight_roll_deg",
                "flight_pitch_deg",
                (false, false),
            ),
            (
                "FlightYawDegree",
                "FlightRollDegree",
                "FlightPitchDegree",
                (false, false),
            ),
            (
                "gimbal_yaw_deg",
                "gimbal_roll_deg",
                "gimbal_pitch_deg",
                (true, true),
            ),
        ] {
            let names = format!("file,time_s,lat,lon,height_agl_m,{heading},{roll},{pitch}");
            let folder = flight_of(&names, 8, |i| {
                let (roll, pitch) = (3.5 + f64::from(i % 3), -4.5 + f64::from(i % 2));
                format!("120,1.{i},{roll},{pitch}")
            });
            let flight = &folder.flight;
            for name in [ChannelName::Roll, ChannelName::Pitch] {
                assert_eq!(flight.channel(name).is_some(), has_tilt, "{roll}: {name:?}");
            }
            assert!(flight.channel(ChannelName::Heading).is_some(), "{heading}");
            let told = folder.notes.iter().any(|note| note.starts_with(roll));
            assert_eq!(told, !has_tilt, "{:?}", folder.notes);
            let known = flight.camera.mount_deviation == 0.0;
            assert_eq!(known, is_known, "{pitch}");
        }
    }

    #[test]
    fn a_gimbal_that_looks_aslant_is_asked_about() {
        for (pitch, is_asked) in [(-30.0, true), (4.0, false), (-88.0, false)] {
            // It nods as a nose does that climbs and sinks, and the other way round.
            for sign in [1.0, -1.0] {
                let row = |i: i32| {
                    let t = f64::from(i);
                    format!(
                        "{t},{:.6},8.0,{:.2},10,{:.2},0\n",
                        47.0 + 1.8e-4 * t,
                        100.0 + 20.0 * (t / 9.0).sin(),
                        pitch + sign * 6.0 * (t / 9.0).cos()
                    )
                };
                let rows: String = (0..120).map(row).collect();
                let names =
                    "time_s,lat,lon,rel_alt_m,gimbal_yaw_deg,gimbal_pitch_deg,gimbal_roll_deg";
                let map = guess_table("t.csv", format!("{names}\n{rows}").as_bytes()).unwrap();
                let asked = map
                    .questions
                    .iter()
                    .any(|it| it.contains("from the horizon"));
                assert_eq!(asked, is_asked, "{pitch}: {:?}", map.questions);
                let column = map
                    .columns
                    .iter()
                    .find(|c| c.name == "gimbal_pitch_deg")
                    .unwrap();
                let offset = if pitch < -45.0 { 90.0 } else { 0.0 };
                assert_eq!(
                    (column.scale, column.offset),
                    (1.0, offset),
                    "{pitch} {sign}"
                );
            }
        }
    }

    #[test]
    fn a_gimbal_counts_from_the_horizon_and_rolls_about_its_view() {
        // Few rows tell no units, many do; tenths of degrees, as aircraft write them, and radians.
        for (rows, unit, degree) in [
            (6, "deg", 1.0),
            (40, "deg", 1.0),
            (40, "rad", 0.017_453_292_5),
        ] {
            // Roll, pitch, yaw of the gimbal; heading and pitch of the camera that looks down, as for photos.
            for (gimbal, heading, pitch) in [
                ([0.0, -90.0, 10.0], 10.0, 0.0),
                ([180.0, -90.0, -170.0], 10.0, 0.0),
                ([0.0, -60.0, 30.0], 30.0, 30.0),
            ] {
                let [roll, tilt, yaw] = gimbal.map(|angle| angle * degree);
                let names = format!(
                    "file,time_s,lat,lon,rel_alt_m,gimbal_yaw_{unit},gimbal_pitch_{unit},gimbal_roll_{unit}"
                );
                let folder = flight_of(&names, rows, |_| format!("100,{yaw},{tilt},{roll}"));
                let last = |name| folder.flight.channel(name).unwrap().values.last().copied();
                let near = |name, expected: f64| {
                    let found = last(name).unwrap().to_degrees();
                    assert!(
                        (found - expected).abs() < 1e-4,
                        "{rows} {unit} {gimbal:?} {name:?}: {found}"
                    );
                };
                near(ChannelName::Heading, heading);
                near(ChannelName::Pitch, pitch);
                near(ChannelName::Roll, 0.0);
                let is_told = |note: &String| note.contains("counted from the horizon");
                assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
                assert!(folder.flight.camera.mount_deviation == 0.0);
            }
        }
    }
}
