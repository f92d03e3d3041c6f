//! A map made into a table of generic landmarks, some tiles in a piece.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::Imagery;
use pilotage_core::reference::seeing::ReferenceMapping;
use pilotage_core::reference::{GenericLandmark, ReferenceTable};
use pilotage_jobs::{JobEvent, ReferenceMapOrder, Share, ShareOrder};

use super::piecework::{Piecework, PieceworkOutcome, order_each};
use crate::maps::{MAP_CACHE, open_map};
use crate::notes::told;
use crate::workers::Lent;

/// Tiles in a piece: some half a square kilometre of map.
const TILES: usize = 4;

/// The table to be made.
pub struct TableOfMap {
    map: Arc<dyn Imagery>,
    frame: Option<LocalFrame>,
    tiles: usize,
    read: Vec<PathBuf>,
}

impl TableOfMap {
    /// That of the map in a file.
    pub fn open(map: &Path) -> Result<Self, Box<dyn std::error::Error>> {
        let opened = open_map(map, None, MAP_CACHE)?;
        let (read, frame) = (opened.read.clone(), opened.frame);
        let map = told(opened);
        Ok(Self {
            tiles: ReferenceMapping::tiles(&map.bounds()),
            map,
            read,
            frame,
        })
    }
}

impl Piecework for TableOfMap {
    fn pieces(&self) -> u64 {
        self.tiles.div_ceil(TILES) as u64
    }

    fn read(&self) -> &[PathBuf] {
        &self.read
    }

    fn carry_out(
        &self,
        wanted: &[u64],
        threads: usize,
        keep: &mut dyn FnMut(u64, Vec<u8>) -> Result<(), String>,
    ) -> Result<(), String> {
        let lent = Lent::default().with_map(Lent::map_of_file(), Arc::clone(&self.map));
        let order = |piece: u64| {
            let share = Share {
                part: piece as usize,
                of: self.pieces() as usize,
            };
            ShareOrder(Box::new(ReferenceMapOrder(Lent::map_of_file())), share)
        };
        let of = |event: JobEvent| match event {
            JobEvent::Figures(bytes) => Some(Ok(bytes)),
            _ => None,
        };
        order_each(wanted, (&order, &of), (threads, &lent), keep)
    }

    fn conclude(
        &self,
        pieces: Vec<Vec<u8>>,
    ) -> Result<PieceworkOutcome, Box<dyn std::error::Error>> {
        let mut found: Vec<GenericLandmark> = Vec::new();
        for piece in pieces {
            found.extend(JobEvent::Figures(piece).read_figures::<Vec<GenericLandmark>>()?);
        }
        let table = ReferenceTable::new(found, Vec::new());
        let table = table.on_globe(self.frame.map(|frame| frame.origin));
        let bytes = table.to_bytes();
        let words = format!(
            "{} landmarks of {} tiles, {} bytes\n",
            table.landmarks().len(),
            self.tiles,
            bytes.len()
        );
        Ok(PieceworkOutcome {
            name: "landmarks.table",
            bytes,
            words,
        })
    }
}
