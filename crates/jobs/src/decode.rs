//! Camera pictures decoded.

use std::sync::Arc;

use pilotage_core::raster::decode_picture;
use serde::{Deserialize, Serialize};

use super::messages::whole_bytes;
use super::order::{Order, Role, Urgency};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Camera picture whose pixels are asked for: event `Picture`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DecodeOrder {
    /// JPEG or PNG bytes.
    #[serde(with = "whole_bytes")]
    pub encoded: Arc<[u8]>,
}

impl Order for DecodeOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> Role {
        Role::Questions
    }

    fn is_small(&self) -> bool {
        true
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| decode(&self.encoded, emit))
    }
}

/// Says the pixels of an encoded picture.
fn decode(encoded: &[u8], emit: &mut dyn FnMut(JobEvent)) -> Result<(), String> {
    let picture = decode_picture(encoded).map_err(|cause| cause.to_string())?;
    let opaque = |[r, g, b]: &[u8; 3]| [*r, *g, *b, u8::MAX];
    emit(JobEvent::Picture {
        width: picture.width(),
        pixels: picture.pixels().iter().flat_map(opaque).collect(),
    });
    Ok(())
}
