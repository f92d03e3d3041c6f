//! The list of towns, fetched when it is first needed.

use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::gazetteer::{FoundTown, Gazetteer};

use crate::host::Host;
use crate::map::{distance_over_ground, is_in_reach};

/// Name of the file among those of the page.
const FILE: &str = "places.bin";
/// Most towns that are offered at a time.
const MOST: usize = 8;

/// List of towns on its way.
#[derive(Debug, Default)]
pub(super) enum TownList {
    #[default]
    Unasked,
    Asked,
    Read(Box<Gazetteer>),
    Missing,
}

impl TownList {
    /// Fetches the list, unless it is there or on its way.
    pub(super) fn ask(&mut self, host: &mut dyn Host) {
        if matches!(self, Self::Unasked | Self::Missing) {
            host.fetch(FILE);
            *self = Self::Asked;
        }
    }

    /// Reads the list if it has come; whether it has.
    pub(super) fn take(&mut self, host: &mut dyn Host) -> bool {
        if !matches!(self, Self::Asked) {
            return false;
        }
        let bytes = host.fetched(FILE);
        if let Some(bytes) = &bytes {
            let read = Gazetteer::from_bytes(bytes);
            *self = read.map_or(Self::Missing, |read| Self::Read(Box::new(read)));
        }
        bytes.is_some()
    }

    /// Source of the list, or why it is not there, for people.
    pub(super) fn words(&self) -> &'static str {
        match self {
            Self::Read(_) => "Towns of more than 15,000 people: GeoNames, CC BY 4.0.",
            Self::Missing => "The list of towns cannot be loaded. Coordinates need none.",
            Self::Unasked | Self::Asked => "The list of towns is loading. Coordinates need none.",
        }
    }

    /// Whether the list is there.
    pub(super) fn are_read(&self) -> bool {
        matches!(self, Self::Read(_))
    }

    /// Towns whose names begin so: those in the open world first, the nearest to the middle of
    /// the map before the others.
    pub(super) fn find(&self, text: &str, world: Option<&OpenWorld>) -> Vec<FoundTown> {
        let Self::Read(gazetteer) = self else {
            return Vec::new();
        };
        gazetteer.find(text, MOST, &|place| {
            let world = world?;
            is_in_reach(&world.frame, place).then(|| world.distance(place))
        })
    }
}

/// Open world on the globe, with the place in the middle of the map.
pub(super) struct OpenWorld {
    pub(super) frame: LocalFrame,
    pub(super) middle: Geodetic,
}

impl OpenWorld {
    /// Distance of a place from the middle of the map over the ground, metres.
    pub(super) fn distance(&self, place: &Geodetic) -> f64 {
        distance_over_ground(&LocalFrame::new(self.middle), place)
    }
}
