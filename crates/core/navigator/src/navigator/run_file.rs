//! A run as a file: a short header with a version, then the run in postcard.

use super::Run;
use super::run_files_before::{
    HEADER_6, HEADER_7, HEADER_8, HEADER_9, RunOfVersion6, RunOfVersion7, RunOfVersion8,
    RunOfVersion9,
};

/// The first bytes of every run file; the last are the version.
const HEADER: &[u8] = b"PILOTAGE RUN 10\n";
const MARK: &[u8] = b"PILOTAGE RUN ";

/// Why bytes are not a run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RunFileError {
    /// The header is missing.
    #[error("{file}: this is not a saved run; save one with “Save the run” and open that")]
    NotARun {
        /// Name of the file.
        file: String,
    },
    /// The header names another version.
    #[error("{file}: saved by another version of this program; make the run again and save it")]
    OtherVersion {
        /// Name of the file.
        file: String,
    },
    /// The contents are damaged.
    #[error("{file}: damaged after the header ({cause}); copy the file again from its source")]
    Damaged {
        /// Name of the file.
        file: String,
        /// Message of the decoder.
        cause: String,
    },
    /// The run cannot be written.
    #[error("the run cannot be written: {cause}")]
    Unwritable {
        /// Message of the encoder.
        cause: String,
    },
}

/// The bytes of a run file.
///
/// ```
/// # use std::sync::Arc;
/// # use pilotage_base::frames::GroundPoint;
/// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
/// # use pilotage_raster::camera::CameraModel;
/// # use pilotage_mission::settings::NavigatorSettings;
/// # use pilotage_raster::imagery::Blank;
/// use pilotage_navigator::navigator::{KnownGround, Navigator, decode_run, encode_run};
/// # let channel = |name, mean: f64, by: f64| Channel {
/// #     name,
/// #     times: (0..=50).map(|i| 0.2 * f64::from(i)).collect(),
/// #     values: (0..=50).map(|i| if i % 2 == 0 { mean + by } else { mean - by }).collect(),
/// # };
/// # let flight = Flight {
/// #     name: "eastward".to_owned(),
/// #     frame_on_globe: None,
/// #     camera: CameraModel::pinhole(640, 480, 1.0),
/// #     ground_down: 0.0,
/// #     channels: vec![
/// #         channel(ChannelName::Airspeed, 20.0, 0.1),
/// #         channel(ChannelName::Heading, 90_f64.to_radians(), 0.001),
/// #     ],
/// #     frames: Vec::new(),
/// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 3.0 },
/// #     truth: None,
/// # };
/// # let settings = NavigatorSettings::default();
/// # let navigator = Navigator::new(Arc::new(flight), &KnownGround::new(Arc::new(Blank)), &settings)?;
///
/// let run = navigator.run_head();
/// let bytes = encode_run(&run)?;
/// assert_eq!(decode_run("a.run", &bytes)?, run);
/// assert!(decode_run("a.run", b"something else").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn encode_run(run: &Run) -> Result<Vec<u8>, RunFileError> {
    postcard::to_extend(run, HEADER.to_vec()).map_err(|e| RunFileError::Unwritable {
        cause: e.to_string(),
    })
}

/// The run in the bytes of a file called `file`.
pub fn decode_run(file: &str, bytes: &[u8]) -> Result<Run, RunFileError> {
    let file = file.to_owned();
    if !bytes.starts_with(MARK) {
        return Err(RunFileError::NotARun { file });
    }
    let read = if let Some(body) = bytes.strip_prefix(HEADER) {
        postcard::from_bytes(body)
    } else if let Some(body) = bytes.strip_prefix(HEADER_9) {
        postcard::from_bytes::<RunOfVersion9>(body).map(Run::from)
    } else if let Some(body) = bytes.strip_prefix(HEADER_8) {
        postcard::from_bytes::<RunOfVersion8>(body).map(Run::from)
    } else if let Some(body) = bytes.strip_prefix(HEADER_7) {
        postcard::from_bytes::<RunOfVersion7>(body).map(Run::from)
    } else if let Some(body) = bytes.strip_prefix(HEADER_6) {
        postcard::from_bytes::<RunOfVersion6>(body).map(Run::from)
    } else {
        return Err(RunFileError::OtherVersion { file });
    };
    read.map_err(|e| RunFileError::Damaged {
        file,
        cause: e.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigator::step_for_tests::step_at;
    use pilotage_mission::settings::{ChosenAid, NavigatorSettings};

    fn run() -> Run {
        Run {
            name: "a run".into(),
            settings: NavigatorSettings::default(),
            landmarks: Vec::new(),
            state_names: vec![("north".into(), "m".into())],
            steps: Vec::new(),
        }
    }

    #[test]
    fn a_run_survives_its_file() {
        let bytes = encode_run(&run()).expect("writes");
        assert_eq!(decode_run("a.run", &bytes).expect("reads"), run());
    }

    /// Bytes of settings without the last `count` numbers of the sensors, which are zero.
    fn settings_before(settings: &NavigatorSettings, count: usize) -> Vec<u8> {
        let mut marked = settings.clone();
        marked.sensors.height_bias = 1.234_567e300;
        let mark = marked.sensors.height_bias.to_le_bytes();
        let bytes = postcard::to_stdvec(&marked).expect("writes");
        let place = bytes.windows(mark.len()).position(|bytes| bytes == mark);
        let end = place.expect("it is in the bytes") + mark.len();
        [&bytes[..end - count * mark.len()], &bytes[end..]].concat()
    }

    /// `bytes` without the last `count`, which are empty lists and switches that are off.
    fn without_last(count: usize, mut bytes: Vec<u8>) -> Vec<u8> {
        let last = bytes.split_off(bytes.len() - count);
        assert!(last.iter().all(|byte| *byte == 0), "each is a zero");
        bytes
    }

    #[test]
    fn runs_of_the_versions_before_open() {
        let mut run = run();
        run.steps = vec![step_at(0.5), step_at(1.0)];
        let step_bytes = |step| postcard::to_stdvec(step).expect("writes");
        let file = |header: &[u8], settings: Vec<u8>, steps: Vec<u8>| {
            let name = postcard::to_stdvec(&run.name).expect("writes");
            let lists = postcard::to_stdvec(&(&run.landmarks, &run.state_names)).expect("writes");
            let count = [run.steps.len() as u8];
            [header, &name, &settings, &lists, &count, &steps].concat()
        };
        let sixth = file(
            HEADER_6,
            without_last(2, settings_before(&run.settings, 4)),
            run.steps
                .iter()
                .flat_map(|step| without_last(2, step_bytes(step)))
                .collect(),
        );
        assert_eq!(decode_run("old.run", &sixth).expect("reads"), run);
        let mut aided = run.clone();
        aided.settings.aids = vec![ChosenAid::usual("gps-position").with("noise", 3.0)];
        aided.settings.estimates_height = true;
        let steps = run.steps.iter();
        let steps: Vec<u8> = steps
            .flat_map(|step| without_last(1, step_bytes(step)))
            .collect();
        let seventh = file(HEADER_7, settings_before(&aided.settings, 4), steps.clone());
        assert_eq!(decode_run("newer.run", &seventh).expect("reads"), aided);
        aided.settings.sensors.ground = 0.11;
        let settings = settings_before(&aided.settings, 3);
        let eighth = file(HEADER_8, settings.clone(), steps);
        assert_eq!(decode_run("newer.run", &eighth).expect("reads"), aided);
        let steps = run.steps.iter().flat_map(step_bytes).collect();
        let ninth = file(HEADER_9, settings, steps);
        assert_eq!(decode_run("newest.run", &ninth).expect("reads"), aided);
    }

    #[test]
    fn a_cut_file_is_named_as_damaged() {
        let bytes = encode_run(&run()).expect("writes");
        let cut = decode_run("a.run", &bytes[..bytes.len() - 3]);
        assert!(matches!(cut, Err(RunFileError::Damaged { file, .. }) if file == "a.run"));
    }

    #[test]
    fn another_file_is_not_taken_for_a_run() {
        let answer = decode_run("photo.png", b"\x89PNG");
        assert!(matches!(answer, Err(RunFileError::NotARun { .. })));
    }
}
