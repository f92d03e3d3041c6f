//! Names beside landmarks, out of the way of panels, of lines, of other landmarks and of each other.

use egui::{Align2, Color32, Painter, Pos2, Rect, Vec2, vec2};
use pilotage_core::sorting::sort;

use super::symbols::{halo_rect, paint_halo_text};
use crate::tokens::Tokens;

/// Rank of the name of a landmark that is not looked for.
pub const POSSIBLE: u8 = 3;

/// A name to be written beside a landmark.
#[derive(Clone, Debug, PartialEq)]
pub struct LandmarkLabel {
    /// The smaller the sooner it gets a place; 0 always gets one.
    pub rank: u8,
    /// Part of the screen on which the landmark is drawn.
    pub around: Rect,
    /// Its topmost corner.
    pub top: Pos2,
    /// The name.
    pub text: String,
    /// Colour of the name.
    pub color: Color32,
}

/// Parts of the screen that names must not cover, and lines that they must not cross, by their ends.
pub type BusyScreen<'a> = (&'a [Rect], &'a [[Pos2; 2]]);

/// Size that no name is smaller than, points: where that has no place, no name has, and none is laid out.
const LEAST: Vec2 = vec2(3.0, 9.0);

/// All on which the places of names depend.
#[derive(Clone, Debug, PartialEq)]
struct LabelQuestion {
    screen: Rect,
    labels: Vec<LandmarkLabel>,
    covered: Vec<Rect>,
    lines: Vec<[Pos2; 2]>,
}

/// Names on the map where nothing else is, placed anew only once names, view or what covers the map change.
#[derive(Debug, Default)]
pub struct PlacedLabels {
    of: Option<LabelQuestion>,
    /// Names that have a place, by their number, with the place.
    placed: Vec<(usize, Pos2, Align2)>,
    /// Number of names that were laid out so far to know their size.
    laid_out: usize,
}

impl PlacedLabels {
    /// Writes each name beside its landmark where nothing else is; names without a place are left out.
    pub fn paint(
        &mut self,
        painter: &Painter,
        screen: Rect,
        labels: Vec<LandmarkLabel>,
        (covered, lines): BusyScreen<'_>,
        tokens: &Tokens,
    ) {
        let is_known = self.of.as_ref().is_some_and(|of| {
            of.screen == screen && of.labels == labels && of.covered == covered && of.lines == lines
        });
        if !is_known {
            let of = LabelQuestion {
                screen,
                labels,
                covered: covered.to_vec(),
                lines: lines.to_vec(),
            };
            self.placed = of.answer(&mut |label| {
                self.laid_out += 1;
                let text = label.text.clone();
                let galley = painter.layout_no_wrap(text, tokens.small(), label.color);
                galley.size()
            });
            self.of = Some(of);
        }
        let Some(of) = &self.of else { return };
        for (number, at, align) in &self.placed {
            let label = &of.labels[*number];
            let font = tokens.small();
            paint_halo_text(painter, *at, *align, &label.text, font, label.color);
        }
    }
}

impl LabelQuestion {
    /// Places of the names that have one, in the order of their ranks; `size` lays a name out.
    fn answer(&self, size: &mut dyn FnMut(&LandmarkLabel) -> Vec2) -> Vec<(usize, Pos2, Align2)> {
        let screen = self.screen;
        let mut taken = ScreenCells::new(screen);
        self.covered.iter().for_each(|it| taken.add(*it, *it));
        let mut boxes = ScreenCells::new(screen);
        for label in &self.labels {
            boxes.add(label.around, label.around);
        }
        let mut lines = ScreenCells::new(screen);
        for line in &self.lines {
            lines.add_where(Rect::from_two_pos(line[0], line[1]), *line, |cell| {
                is_crossed(cell, *line)
            });
        }
        let mut order: Vec<usize> = (0..self.labels.len()).collect();
        sort(&mut order, &|a, b| {
            let rank = |number: &usize| self.labels[*number].rank;
            rank(a).cmp(&rank(b))
        });
        let mut placed = Vec::new();
        for number in order {
            let label = &self.labels[number];
            let free = |rect: Rect| {
                screen.contains_rect(rect) && !taken.any(rect, |it| it.intersects(rect))
            };
            let clear = |rect: Rect| {
                let is_other = |it: &Rect| *it != label.around && it.intersects(rect);
                !lines.any(rect, |line| is_crossed(rect, *line)) && !boxes.any(rect, is_other)
            };
            if place(label, LEAST, &free, &clear).is_none() {
                continue;
            }
            let size = size(label);
            if let Some((at, align)) = place(label, size, &free, &clear) {
                let written = halo_rect(align.anchor_size(at, size));
                placed.push((number, at, align));
                taken.add(written, written);
            }
        }
        placed
    }
}

/// Side of the cells by which things on the screen are found, points.
const CELL: f32 = 64.0;

/// Things on the screen, by the cells that they touch.
struct ScreenCells<T> {
    screen: Rect,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<T>>,
}

impl<T: Copy> ScreenCells<T> {
    fn new(screen: Rect) -> Self {
        let count = |length: f32| (length / CELL).clamp(0.0, 1000.0) as usize + 1;
        let (columns, rows) = (count(screen.width()), count(screen.height()));
        Self {
            screen,
            columns,
            rows,
            cells: vec![Vec::new(); columns * rows],
        }
    }

    /// Columns and rows of the cells that a rectangle touches; what lies beyond the screen is in those at its rim.
    fn range(&self, rect: Rect) -> [std::ops::RangeInclusive<usize>; 2] {
        let cell = |length: f32, count: usize| ((length / CELL).max(0.0) as usize).min(count - 1);
        let (min, max) = (rect.min - self.screen.min, rect.max - self.screen.min);
        [
            cell(min.x, self.columns)..=cell(max.x, self.columns),
            cell(min.y, self.rows)..=cell(max.y, self.rows),
        ]
    }

    fn add(&mut self, rect: Rect, thing: T) {
        self.add_where(rect, thing, |_| true);
    }

    /// Adds a thing to those of the cells in a rectangle that it touches. Cells at the rim reach beyond the screen.
    fn add_where(&mut self, rect: Rect, thing: T, touches: impl Fn(Rect) -> bool) {
        let [columns, rows] = self.range(rect);
        for row in rows {
            for column in columns.clone() {
                let corner = self.screen.min + CELL * vec2(column as f32, row as f32);
                if touches(Rect::from_min_size(corner, vec2(CELL, CELL))) {
                    self.cells[row * self.columns + column].push(thing);
                }
            }
        }
    }

    /// Whether something in the cells that a rectangle touches is so.
    fn any(&self, rect: Rect, is_so: impl Fn(&T) -> bool) -> bool {
        let [columns, rows] = self.range(rect);
        rows.into_iter().any(|row| {
            let row = &self.cells[row * self.columns..][..self.columns];
            row[columns.clone()].iter().flatten().any(&is_so)
        })
    }
}

/// Place of a name of that size: the first that is free and clear of lines and other landmarks. What is about the
/// flight just now may lie over a line, and the selected one over anything.
fn place(
    label: &LandmarkLabel,
    size: Vec2,
    is_free: &dyn Fn(Rect) -> bool,
    is_clear: &dyn Fn(Rect) -> bool,
) -> Option<(Pos2, Align2)> {
    let places = places(label);
    let rect = |(at, align): &(Pos2, Align2)| align.anchor_size(*at, size).expand(4.0);
    let mut free = places.iter().filter(|place| is_free(rect(place)));
    let first = free.clone().next();
    let clear = free.find(|place| is_clear(rect(place)));
    let next_best = first.filter(|_| label.rank < POSSIBLE);
    let last = (label.rank == 0).then_some(&places[0]);
    clear.or(next_best).or(last).copied()
}

/// Whether a line leads through a rectangle, by the part of it that lies between each pair of edges.
fn is_crossed(rect: Rect, [from, to]: [Pos2; 2]) -> bool {
    let way = to - from;
    let (mut begin, mut end) = (0.0_f32, 1.0_f32);
    for (at, step, low, high) in [
        (from.x, way.x, rect.left(), rect.right()),
        (from.y, way.y, rect.top(), rect.bottom()),
    ] {
        if step.abs() < 1e-6 {
            if at < low || at > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - at) / step, (high - at) / step);
        (begin, end) = (begin.max(a.min(b)), end.min(a.max(b)));
    }
    begin <= end
}

/// Places for a name, the best first: above, below, at either side, beyond a corner.
fn places(label: &LandmarkLabel) -> [(Pos2, Align2); 8] {
    let around = label.around;
    let away = vec2(4.0, 4.0);
    [
        (label.top + vec2(0.0, -5.0), Align2::CENTER_BOTTOM),
        (around.center_bottom() + vec2(0.0, 5.0), Align2::CENTER_TOP),
        (around.right_center() + vec2(8.0, 0.0), Align2::LEFT_CENTER),
        (around.left_center() - vec2(8.0, 0.0), Align2::RIGHT_CENTER),
        (
            around.right_top() + vec2(away.x, -away.y),
            Align2::LEFT_BOTTOM,
        ),
        (around.left_top() - away, Align2::RIGHT_BOTTOM),
        (around.right_bottom() + away, Align2::LEFT_TOP),
        (
            around.left_bottom() + vec2(-away.x, away.y),
            Align2::RIGHT_TOP,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn label(rank: u8) -> LandmarkLabel {
        let around = Rect::from_center_size(pos2(200.0, 200.0), vec2(30.0, 30.0));
        LandmarkLabel {
            rank,
            around,
            top: around.center_top(),
            text: "church".to_owned(),
            color: Color32::WHITE,
        }
    }

    fn placed(rank: u8, taken: &[Rect], lines: &[[Pos2; 2]]) -> Option<Align2> {
        let free = |rect: Rect| taken.iter().all(|it| !it.intersects(rect));
        let clear = |rect: Rect| !lines.iter().any(|line| is_crossed(rect, *line));
        place(&label(rank), vec2(60.0, 12.0), &free, &clear).map(|(_, align)| align)
    }

    #[test]
    fn a_name_keeps_off_lines_and_is_left_out_where_none_of_its_places_is_clear() {
        assert_eq!(placed(POSSIBLE, &[], &[]), Some(Align2::CENTER_BOTTOM));
        let above = [pos2(0.0, 175.0), pos2(400.0, 175.0)];
        assert_eq!(placed(POSSIBLE, &[], &[above]), Some(Align2::CENTER_TOP));
        let rows = (0..8).map(|row| 150.0 + 14.0 * row as f32);
        let rows: Vec<[Pos2; 2]> = rows.map(|y| [pos2(0.0, y), pos2(400.0, y)]).collect();
        assert_eq!(placed(POSSIBLE, &[], &rows), None);
        assert_eq!(placed(1, &[], &rows), Some(Align2::CENTER_BOTTOM));
        let everything = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 400.0));
        assert_eq!(placed(1, &[everything], &[]), None);
        assert_eq!(placed(0, &[everything], &[]), Some(Align2::CENTER_BOTTOM));
    }

    /// Names of boxes that lie close, and lines between them, on a screen of 1000 by 700 points.
    fn crowd(count: usize) -> LabelQuestion {
        let at = |number: usize, by: f32, length: f32| (number as f32 * by).rem_euclid(length);
        let labels = (0..count).map(|number| {
            let middle = pos2(
                at(number, 617.3, 1040.0) - 20.0,
                at(number, 271.7, 740.0) - 20.0,
            );
            let around = Rect::from_center_size(middle, vec2(6.0, 6.0));
            LandmarkLabel {
                rank: [POSSIBLE, POSSIBLE, 2, 1, POSSIBLE][number % 5],
                around,
                top: around.center_top(),
                text: format!("Landmark {number}"),
                color: Color32::WHITE,
            }
        });
        let line = |number: usize| {
            [
                pos2(at(number, 331.0, 1000.0), -50.0),
                pos2(900.0, at(number, 97.0, 700.0)),
            ]
        };
        LabelQuestion {
            screen: Rect::from_min_size(pos2(0.0, 0.0), vec2(1000.0, 700.0)),
            labels: labels.collect(),
            covered: vec![Rect::from_min_size(pos2(16.0, 16.0), vec2(300.0, 60.0))],
            lines: (0..5).map(line).collect(),
        }
    }

    /// The size of names of so many letters, about.
    fn size_of(label: &LandmarkLabel) -> Vec2 {
        vec2(6.0 * label.text.len() as f32, 14.0)
    }

    #[test]
    fn names_are_placed_as_if_each_was_held_against_all_others() {
        let of = crowd(400);
        let mut order: Vec<usize> = (0..of.labels.len()).collect();
        order.sort_by_key(|number| of.labels[*number].rank);
        let mut taken = of.covered.clone();
        let mut wanted = Vec::new();
        for number in order {
            let label = &of.labels[number];
            let free = |rect: Rect| {
                of.screen.contains_rect(rect) && taken.iter().all(|it| !it.intersects(rect))
            };
            let is_other = |it: &&LandmarkLabel| it.around != label.around;
            let others = || of.labels.iter().filter(is_other);
            let clear = |rect: Rect| {
                !of.lines.iter().any(|line| is_crossed(rect, *line))
                    && !others().any(|it| it.around.intersects(rect))
            };
            if let Some((at, align)) = place(label, size_of(label), &free, &clear) {
                taken.push(halo_rect(align.anchor_size(at, size_of(label))));
                wanted.push((number, at, align));
            }
        }
        assert!(wanted.len() > 20, "{}", wanted.len());
        assert_eq!(of.answer(&mut size_of), wanted);
    }

    #[test]
    fn ten_thousand_names_are_placed_once_and_few_of_them_are_laid_out() {
        let context = egui::Context::default();
        let mut names = PlacedLabels::default();
        let mut of = crowd(10_000);
        let counts = [0.0_f32, 0.0, 0.0, 3.0, 3.0].map(|moved| {
            if moved > 0.0 {
                of = crowd(10_000);
                of.labels.iter_mut().for_each(|it| it.around.min.x -= moved);
            }
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                let busy = (&of.covered[..], &of.lines[..]);
                let labels = of.labels.clone();
                names.paint(ui.painter(), of.screen, labels, busy, &Tokens::dark());
            });
            output.textures_delta.clear();
            names.laid_out
        });
        assert!(counts[0] > 0 && counts[0] < 6_000, "{counts:?}");
        assert_eq!(counts[0], counts[2], "nothing changed");
        assert!(
            counts[3] > counts[2] && counts[4] == counts[3],
            "{counts:?}"
        );
    }

    #[test]
    fn a_line_crosses_a_rectangle_that_it_enters_and_no_other() {
        let rect = Rect::from_min_max(pos2(10.0, 10.0), pos2(20.0, 20.0));
        let crossed = |a: (f32, f32), b: (f32, f32)| is_crossed(rect, [a.into(), b.into()]);
        assert!(crossed((0.0, 0.0), (30.0, 30.0)));
        assert!(crossed((15.0, 0.0), (15.0, 30.0)));
        assert!(crossed((12.0, 12.0), (13.0, 13.0)), "it lies inside");
        assert!(!crossed((0.0, 0.0), (9.0, 9.0)), "it ends before");
        assert!(!crossed((0.0, 25.0), (30.0, 25.0)));
        assert!(!crossed((0.0, 15.0), (15.0, 30.0)), "it passes the corner");
    }
}
