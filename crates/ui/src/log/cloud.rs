//! Many points on few pixels: each pixel is set once, however many of millions of points fall on it, and
//! the points are gone through a part in every frame.

use std::ops::Range;

use egui::{Color32, ColorImage, Painter, Pos2, Rect, TextureHandle, TextureOptions, pos2};

use super::pairs::{LastPair, Pairs};
use crate::views::chart::ChartAxes;

/// Points gone through in one frame: a few milliseconds.
const PER_FRAME: usize = 150_000;
/// Points of the first look at scattered ones.
const FIRST_LOOK: usize = 1 << 16;
/// Most cells between two joined points that are set one by one; beyond, the plot is crossed anyway.
const LONGEST: i64 = 4096;

/// Key of a cloud: everything that it depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CloudKey {
    pub revision: u64,
    pub axes: ChartAxes,
    pub span: (f64, f64),
    pub fields: Vec<pilotage_jobs::SeriesName>,
    pub joined: bool,
    pub is_dark: bool,
}

/// Order of the points: all of them in order, or scattered ones in rounds, each twice as dense.
#[derive(Clone, Debug, Default)]
struct PointOrder {
    range: Range<usize>,
    /// Distance of the points of this round.
    stride: usize,
    /// Place of the next point in the range.
    next: usize,
    /// Whether this is the first round, in which no point was seen before.
    is_first: bool,
}

impl PointOrder {
    fn new(range: Range<usize>, joined: bool) -> Self {
        let rounds = range.len().div_ceil(FIRST_LOOK).next_power_of_two();
        Self {
            range,
            stride: if joined { 1 } else { rounds },
            next: 0,
            is_first: true,
        }
    }

    /// The next point; `None` once all were gone through.
    fn step(&mut self) -> Option<usize> {
        loop {
            let at = self.range.start + self.next;
            if at < self.range.end {
                // Later rounds lie between the points of the rounds before.
                self.next += if self.is_first {
                    self.stride
                } else {
                    2 * self.stride
                };
                return Some(at);
            }
            if self.stride <= 1 {
                return None;
            }
            self.stride /= 2;
            self.next = self.stride;
            self.is_first = false;
        }
    }
}

/// The set pixels of a plot of one field against another.
#[derive(Default)]
pub(super) struct PixelCloud {
    key: Option<CloudKey>,
    /// Columns and rows.
    size: [usize; 2],
    /// By cell, row after row from the top: 0, or the number of a field from 1 on.
    cells: Vec<u8>,
    walks: Vec<PointOrder>,
    /// The last point of the field that is gone through, of joined ones.
    last: Option<(i64, i64)>,
    texture: Option<TextureHandle>,
}

impl PixelCloud {
    /// Goes on with the points of `fields`; begins anew where `key` is another. Whether there are more.
    pub fn follow(&mut self, key: &CloudKey, fields: &[Pairs<'_>]) -> bool {
        if self.key.as_ref() != Some(key) {
            let rect = key.axes.rect;
            self.size = [rect.width(), rect.height()].map(|side| side.ceil().max(1.0) as usize);
            self.cells = vec![0; self.size[0] * self.size[1]];
            let walk = |pairs: &Pairs<'_>| PointOrder::new(pairs.within(key.span), key.joined);
            self.walks = fields.iter().map(walk).collect();
            self.last = None;
            self.texture = None;
            self.key = Some(key.clone());
        }
        let mut left = PER_FRAME;
        for (number, pairs) in fields.iter().enumerate() {
            let Some(mut walk) = self.walks.get_mut(number).map(std::mem::take) else {
                continue;
            };
            let mut place = LastPair::default();
            let mut is_more = true;
            while left > 0 && is_more {
                left -= 1;
                match walk.step() {
                    Some(index) => self.add(pairs.at(index, &mut place), key, number),
                    None => is_more = false,
                }
            }
            if is_more {
                self.walks[number] = walk;
                self.texture = None;
                return true;
            }
            // Done: an empty walk is over at once in the next frames.
            self.last = None;
        }
        if left < PER_FRAME - fields.len() {
            self.texture = None;
        }
        false
    }

    fn add(&mut self, point: Option<(f64, f64)>, key: &CloudKey, number: usize) {
        let Some((x, y)) = point else {
            self.last = None;
            return;
        };
        let at = key.axes.at(x, y) - key.axes.rect.min;
        let cell = (at.x.floor() as i64, at.y.floor() as i64);
        let mark = number as u8 + 1;
        match self.last.filter(|_| key.joined) {
            Some(last) => self.join(last, cell, mark),
            None => {
                for (right, down) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    self.set(cell.0 + right, cell.1 + down, mark);
                }
            }
        }
        self.last = Some(cell);
    }

    fn set(&mut self, column: i64, row: i64, mark: u8) {
        let (Ok(column), Ok(row)) = (usize::try_from(column), usize::try_from(row)) else {
            return;
        };
        if column < self.size[0] && row < self.size[1] {
            self.cells[row * self.size[0] + column] = mark;
        }
    }

    /// Sets the cells from one to another.
    fn join(&mut self, from: (i64, i64), to: (i64, i64), mark: u8) {
        let (right, down) = (to.0 - from.0, to.1 - from.1);
        let steps = right.abs().max(down.abs()).clamp(1, LONGEST);
        for step in 1..=steps {
            let part = |whole: i64| (whole as f64 * step as f64 / steps as f64).round() as i64;
            self.set(from.0 + part(right), from.1 + part(down), mark);
        }
    }

    /// Shows the set cells, in the colours of the fields.
    pub fn paint(&mut self, painter: &Painter, colours: &[Color32]) {
        let Some(key) = &self.key else { return };
        let [width, height] = self.size;
        let rect = Rect::from_min_size(key.axes.rect.min, egui::vec2(width as f32, height as f32));
        let texture = self.texture.get_or_insert_with(|| {
            let colour = |mark: &u8| match mark {
                0 => Color32::TRANSPARENT,
                mark => colours[(usize::from(*mark) - 1).min(colours.len() - 1)],
            };
            let pixels = self.cells.iter().map(colour).collect();
            let image = ColorImage::new([width, height], pixels);
            let options = TextureOptions::NEAREST;
            painter
                .ctx()
                .load_texture("points of a plot", image, options)
        });
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(texture.id(), rect, whole, Color32::WHITE);
    }

    /// Rows of set cells of a field: left end and length, points.
    pub fn runs(&self, number: usize) -> Vec<(Pos2, f32)> {
        let Some(key) = &self.key else {
            return Vec::new();
        };
        let mark = number as u8 + 1;
        let mut runs = Vec::new();
        for (row, cells) in self.cells.chunks(self.size[0].max(1)).enumerate() {
            let mut column = 0;
            while column < cells.len() {
                let length = cells[column..].iter().take_while(|c| **c == mark).count();
                if length > 0 {
                    let corner = egui::vec2(column as f32, row as f32);
                    runs.push((key.axes.rect.min + corner, length as f32));
                }
                column += length.max(1);
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::super::pairs::tests::field;
    use super::*;

    fn key(joined: bool) -> CloudKey {
        CloudKey {
            revision: 0,
            axes: ChartAxes {
                rect: Rect::from_min_max(pos2(10.0, 20.0), pos2(110.0, 70.0)),
                x: (0.0, 100.0),
                y: (0.0, 50.0),
                log: false,
            },
            span: (0.0, 1e9),
            fields: Vec::new(),
            is_dark: true,
            joined,
        }
    }

    #[test]
    fn every_point_of_a_walk_comes_once() {
        for (count, joined) in [
            (0, false),
            (1, false),
            (1000, false),
            (300_001, false),
            (70_000, true),
        ] {
            let mut walk = PointOrder::new(5..5 + count, joined);
            let mut seen = vec![false; count];
            while let Some(at) = walk.step() {
                assert!(
                    !std::mem::replace(&mut seen[at - 5], true),
                    "{at} of {count}"
                );
            }
            assert!(seen.into_iter().all(|seen| seen), "{count}");
        }
    }

    #[test]
    fn a_spike_among_a_million_points_is_set_once_all_were_gone_through() {
        let count = 1_000_000;
        let times = || (0..count).map(f64::from);
        let x = field(times().map(|t| (t, t % 100.0)));
        let y = field(times().map(|t| (t, if t == 777_737.0 { 45.5 } else { 10.5 })));
        let pairs = [Pairs { x: &x, y: &y }];
        let mut cloud = PixelCloud::default();
        let mut frames = 1;
        while cloud.follow(&key(false), &pairs) {
            frames += 1;
            assert!(frames < 20);
        }
        // x = 37, y = 45.5 of 50 from the bottom: row 4 from the top.
        let runs = cloud.runs(0);
        assert!(runs.contains(&(pos2(47.0, 24.0), 2.0)), "{runs:?}");
        assert!(runs.contains(&(pos2(10.0, 59.0), 100.0)), "{runs:?}");
    }

    #[test]
    fn points_are_drawn_anew_in_the_colours_of_another_theme() {
        let x = field((0..4).map(|i| (f64::from(i), f64::from(i))));
        let pairs = [Pairs { x: &x, y: &x }];
        let mut cloud = PixelCloud::default();
        let context = egui::Context::default();
        let mut is_drawn = |is_dark: bool| {
            let key = CloudKey {
                is_dark,
                ..key(false)
            };
            cloud.follow(&key, &pairs);
            let is_kept = cloud.texture.is_some();
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                cloud.paint(ui.painter(), &[Color32::RED]);
            });
            output.textures_delta.clear();
            is_kept
        };
        assert_eq!([true, true, false].map(&mut is_drawn), [false, true, false]);
    }

    #[test]
    fn joined_points_leave_no_gap_and_missing_ones_do() {
        let values = [5.5, 25.5, f64::NAN, 45.5];
        let x = field((0..4).map(|i| (f64::from(i), 10.5 * f64::from(i))));
        let y = field((0..4).map(|i| (f64::from(i), values[i as usize])));
        let mut cloud = PixelCloud::default();
        assert!(!cloud.follow(&key(true), &[Pairs { x: &x, y: &y }]));
        let rows: Vec<f32> = cloud.runs(0).iter().map(|(at, _)| at.y).collect();
        // From 5.5 to 25.5 every row; a dot of two rows at 45.5.
        for row in 44..=64 {
            assert!(rows.contains(&(row as f32)), "{row} of {rows:?}");
        }
        assert!(rows.contains(&24.0) && !rows.contains(&35.0));
    }
}
