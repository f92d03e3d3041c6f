//! A run as a file: a short header with a version, then the run in postcard.

use super::Run;

/// The first bytes of every run file; the last is the version.
const HEADER: &[u8] = b"PILOTAGE RUN 6\n";
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
    let Some(body) = bytes.strip_prefix(HEADER) else {
        return Err(RunFileError::OtherVersion { file });
    };
    postcard::from_bytes(body).map_err(|e| RunFileError::Damaged {
        file,
        cause: e.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run() -> Run {
        Run {
            name: "a run".into(),
            settings: pilotage_mission::settings::NavigatorSettings::default(),
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
