//! The tree of lines that cut the land into parcels, and where to begin in it.
//!
//! Most cells of the scenery lie on one side of each of the first lines: there the search begins below them, and looks
//! only at those that may be the nearest.

use super::grid::{cell_of, cells};
use super::shape::{Spot, spot};

/// A cutting line or a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) enum ParcelNode {
    /// `normal · p - offset`: negative goes to the first child, else to the second.
    Cut {
        normal: Spot,
        offset: f32,
        children: [u32; 2],
        track: bool,
    },
    Leaf(u32),
}

/// Location of a place among the parcels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Located {
    pub(super) parcel: u32,
    /// Distance to the parcel's nearest edge, metres.
    pub(super) edge: f32,
    /// Distance to the nearest cutting line that carries a track, metres.
    pub(super) track: f32,
    /// Unit vector along that nearest edge.
    pub(super) along: Spot,
}

impl Located {
    /// State of a search that passed nothing yet.
    const NOWHERE: Self = Self {
        parcel: 0,
        edge: 1e9,
        track: 1e9,
        along: spot(1.0, 0.0),
    };

    /// Passes a line at a distance.
    #[inline]
    fn pass(&mut self, normal: Spot, distance: f32, track: bool) {
        if distance < self.edge {
            self.edge = distance;
            self.along = normal;
        }
        if track {
            self.track = self.track.min(distance);
        }
    }
}

/// Node at which the search in a cell begins, and the first of the lines above it that are looked at.
#[derive(Clone, Copy, Debug)]
struct CellStart {
    node: u32,
    first_line: u32,
}

/// The tree, the root first.
#[derive(Clone, Debug)]
pub(super) struct ParcelTree {
    nodes: Vec<ParcelNode>,
    /// Starts of the cells, and an end behind them.
    starts: Vec<CellStart>,
    /// Numbers of nodes with lines, those of a cell one after the other.
    lines: Vec<u32>,
}

impl ParcelTree {
    pub(super) fn new(nodes: Vec<ParcelNode>) -> Self {
        let (mut starts, mut lines) = (Vec::new(), Vec::new());
        for (center, reach) in cells() {
            let first_line = lines.len() as u32;
            let node = begin(&nodes, center, reach, &mut lines);
            starts.push(CellStart { node, first_line });
        }
        starts.push(CellStart {
            node: 0,
            first_line: lines.len() as u32,
        });
        Self {
            nodes,
            starts,
            lines,
        }
    }

    /// The parcel at a place.
    #[inline]
    pub(super) fn locate(&self, p: Spot) -> Located {
        let mut located = Located::NOWHERE;
        let Some(cell) = cell_of(p) else {
            return self.descend(0, p, located);
        };
        let (start, next) = (self.starts[cell], self.starts[cell + 1]);
        for line in &self.lines[start.first_line as usize..next.first_line as usize] {
            if let ParcelNode::Cut {
                normal,
                offset,
                track,
                ..
            } = self.nodes[*line as usize]
            {
                located.pass(normal, (normal.dot(p) - offset).abs(), track);
            }
        }
        self.descend(start.node, p, located)
    }

    /// Goes down from a node, after what was passed above it.
    #[inline]
    fn descend(&self, mut number: u32, p: Spot, mut located: Located) -> Located {
        loop {
            match self.nodes[number as usize] {
                ParcelNode::Leaf(parcel) => {
                    located.parcel = parcel;
                    return located;
                }
                ParcelNode::Cut {
                    normal,
                    offset,
                    children,
                    track,
                } => {
                    let d = normal.dot(p) - offset;
                    located.pass(normal, d.abs(), track);
                    number = children[usize::from(d >= 0.0)];
                }
            }
        }
    }
}

/// The first node whose line passes within `reach` of a cell's centre, or a leaf; `lines` gets those above it that are
/// the nearest, or the nearest with a track, to some place of the cell.
fn begin(nodes: &[ParcelNode], center: Spot, reach: f32, lines: &mut Vec<u32>) -> u32 {
    let mut above: Vec<(u32, f32, bool)> = Vec::new();
    let mut number = 0;
    while let ParcelNode::Cut {
        normal,
        offset,
        children,
        track,
    } = nodes[number as usize]
    {
        let d = normal.dot(center) - offset;
        if d.abs() <= reach {
            break;
        }
        above.push((number, d.abs(), track));
        number = children[usize::from(d >= 0.0)];
    }
    let least = |tracks: bool| {
        let these = above.iter().filter(|(_, _, track)| *track || !tracks);
        these.map(|(_, d, _)| *d).fold(f32::INFINITY, f32::min)
    };
    let (edge, track) = (least(false) + 2.0 * reach, least(true) + 2.0 * reach);
    let may_be_nearest = |d: f32, is_track: bool| d <= edge || (is_track && d <= track);
    lines.extend(
        above
            .iter()
            .filter(|(_, d, is_track)| may_be_nearest(*d, *is_track))
            .map(|(number, _, _)| *number),
    );
    number
}

#[cfg(test)]
mod tests {
    use super::super::noise::Dice;
    use super::*;

    /// Cuts at random, a leaf after ten of them; the number of the first.
    fn cut(nodes: &mut Vec<ParcelNode>, depth: u32, dice: &mut Dice) -> u32 {
        let number = nodes.len() as u32;
        nodes.push(ParcelNode::Leaf(number));
        if depth < 10 {
            let normal = Spot::heading(dice.range(0.0, 6.3));
            let offset = dice.range(-900.0, 900.0);
            let track = dice.chance(0.2);
            let children = [cut(nodes, depth + 1, dice), cut(nodes, depth + 1, dice)];
            nodes[number as usize] = ParcelNode::Cut {
                normal,
                offset,
                children,
                track,
            };
        }
        number
    }

    #[test]
    fn a_search_that_begins_in_a_cell_finds_the_very_same_as_one_from_the_root() {
        for seed in 1..4 {
            let (mut nodes, mut dice) = (Vec::new(), Dice::new(seed, 1));
            cut(&mut nodes, 0, &mut dice);
            let tree = ParcelTree::new(nodes);
            let mut begun_below = 0;
            for _ in 0..200_000 {
                let p = spot(dice.range(-1210.0, 1210.0), dice.range(-1210.0, 1210.0));
                let expected = tree.descend(0, p, Located::NOWHERE);
                assert_eq!(tree.locate(p), expected, "{p:?}");
                begun_below += usize::from(cell_of(p).is_some_and(|c| tree.starts[c].node > 0));
            }
            assert!(begun_below > 150_000, "{begun_below}");
        }
    }
}
