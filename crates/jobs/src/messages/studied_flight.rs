//! A flight of a study that is looked at by itself.

use pilotage_study::StudyFlight;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Flight of a study, flown once more: the same to the bit. It has no pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudiedFlight {
    /// Name of the study.
    pub study: String,
    /// Number of the run in the study.
    pub run: u64,
    /// The flight, packed wherever it goes: nothing else of the page reads or writes its settings.
    #[serde(serialize_with = "pack", deserialize_with = "unpack")]
    pub flight: StudyFlight,
}

fn pack<S: Serializer>(flight: &StudyFlight, to: S) -> Result<S::Ok, S::Error> {
    let bytes = postcard::to_stdvec(flight).map_err(S::Error::custom)?;
    bytes.serialize(to)
}

fn unpack<'d, D: Deserializer<'d>>(from: D) -> Result<StudyFlight, D::Error> {
    let bytes = Vec::<u8>::deserialize(from)?;
    postcard::from_bytes(&bytes).map_err(D::Error::custom)
}
