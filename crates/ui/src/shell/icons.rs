//! Icons of one set, drawn with strokes on a grid of 16 × 16.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2};

/// Subject of an icon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// The aircraft of the wordmark.
    Aircraft,
    /// Play.
    Play,
    /// Pause.
    Pause,
    /// Step back by a frame.
    StepBack,
    /// Step on by a frame.
    StepForward,
    /// Repeat.
    Loop,
    /// A bookmark.
    Bookmark,
    /// Add, zoom in.
    Plus,
    /// Zoom out.
    Minus,
    /// Show everything.
    Fit,
    /// Keep the aircraft in the middle.
    Follow,
    /// Turn of the map.
    Compass,
    /// Draw a landmark.
    Pick,
    /// Undo.
    Undo,
    /// Redo.
    Redo,
    /// Delete.
    Trash,
    /// Open a file.
    Open,
    /// Save a file.
    Save,
    /// Settings.
    Settings,
    /// Measure.
    Ruler,
    /// Roads.
    Road,
    /// All commands.
    Search,
    /// Help.
    Help,
    /// Close.
    Close,
    /// Open to the right.
    Right,
    /// Open downwards.
    Down,
    /// Visible.
    Eye,
    /// Hidden.
    EyeOff,
    /// Trouble.
    Warning,
    /// The same for all of a stack.
    Layers,
    /// Make a second one of the same.
    Duplicate,
    /// Label what is in pictures.
    Tag,
    /// Files for other programs.
    Export,
    /// Draw a route.
    Path,
    /// Split a route.
    Split,
    /// The other way round.
    Reverse,
    /// A place to be set.
    Target,
    /// A notice.
    Info,
    /// Lessons.
    Learn,
    /// No signal.
    NoSignal,
    /// Panels of the window.
    Side,
    /// Everything else.
    More,
}

impl Icon {
    /// Open lines on the grid; the first two numbers of each are a point, and so on.
    fn lines(self) -> &'static [&'static [f32]] {
        match self {
            Self::StepBack => &[&[4.0, 3.5, 4.0, 12.5], &[12.0, 3.5, 6.5, 8.0, 12.0, 12.5]],
            Self::StepForward => &[&[12.0, 3.5, 12.0, 12.5], &[4.0, 3.5, 9.5, 8.0, 4.0, 12.5]],
            Self::Loop => &[
                &[3.0, 7.5, 3.0, 5.0, 5.0, 4.0, 13.0, 4.0],
                &[10.8, 1.8, 13.0, 4.0, 10.8, 6.2],
                &[13.0, 8.5, 13.0, 11.0, 11.0, 12.0, 3.0, 12.0],
                &[5.2, 9.8, 3.0, 12.0, 5.2, 14.2],
            ],
            Self::Bookmark => &[&[
                4.5, 2.5, 11.5, 2.5, 11.5, 13.5, 8.0, 10.5, 4.5, 13.5, 4.5, 2.5,
            ]],
            Self::Plus => &[&[8.0, 3.0, 8.0, 13.0], &[3.0, 8.0, 13.0, 8.0]],
            Self::Minus => &[&[3.0, 8.0, 13.0, 8.0]],
            Self::Fit => &[
                &[2.5, 6.0, 2.5, 2.5, 6.0, 2.5],
                &[10.0, 2.5, 13.5, 2.5, 13.5, 6.0],
                &[13.5, 10.0, 13.5, 13.5, 10.0, 13.5],
                &[6.0, 13.5, 2.5, 13.5, 2.5, 10.0],
            ],
            Self::Follow => &[
                &[8.0, 1.5, 8.0, 4.5],
                &[8.0, 11.5, 8.0, 14.5],
                &[1.5, 8.0, 4.5, 8.0],
                &[11.5, 8.0, 14.5, 8.0],
            ],
            Self::Pick => &[
                &[2.5, 2.5, 10.5, 2.5, 10.5, 10.5, 2.5, 10.5, 2.5, 2.5],
                &[12.0, 9.0, 12.0, 15.0],
                &[9.0, 12.0, 15.0, 12.0],
            ],
            Self::Undo => &[
                &[6.0, 2.5, 2.5, 6.0, 6.0, 9.5],
                &[
                    2.5, 6.0, 10.0, 6.0, 13.0, 8.0, 13.0, 11.0, 10.0, 13.0, 6.0, 13.0,
                ],
            ],
            Self::Redo => &[
                &[10.0, 2.5, 13.5, 6.0, 10.0, 9.5],
                &[
                    13.5, 6.0, 6.0, 6.0, 3.0, 8.0, 3.0, 11.0, 6.0, 13.0, 10.0, 13.0,
                ],
            ],
            Self::Trash => &[
                &[2.5, 4.5, 13.5, 4.5],
                &[6.0, 4.5, 6.5, 2.5, 9.5, 2.5, 10.0, 4.5],
                &[4.0, 4.5, 4.8, 13.5, 11.2, 13.5, 12.0, 4.5],
                &[6.8, 7.0, 6.8, 11.0],
                &[9.2, 7.0, 9.2, 11.0],
            ],
            Self::Open => &[
                &[
                    2.0, 12.5, 2.0, 3.5, 6.0, 3.5, 7.5, 5.5, 13.0, 5.5, 13.0, 7.5,
                ],
                &[2.0, 12.5, 4.5, 7.5, 15.0, 7.5, 12.5, 12.5, 2.0, 12.5],
            ],
            _ => self.more_lines(),
        }
    }

    fn more_lines(self) -> &'static [&'static [f32]] {
        match self {
            Self::Save => &[
                &[8.0, 2.0, 8.0, 10.0],
                &[4.5, 6.8, 8.0, 10.3, 11.5, 6.8],
                &[2.5, 10.5, 2.5, 13.5, 13.5, 13.5, 13.5, 10.5],
            ],
            Self::Settings => &[
                &[2.0, 4.0, 8.0, 4.0],
                &[12.0, 4.0, 14.0, 4.0],
                &[2.0, 8.0, 4.0, 8.0],
                &[8.0, 8.0, 14.0, 8.0],
                &[2.0, 12.0, 9.0, 12.0],
                &[13.0, 12.0, 14.0, 12.0],
            ],
            Self::Ruler => &[
                &[1.5, 5.0, 14.5, 5.0, 14.5, 11.0, 1.5, 11.0, 1.5, 5.0],
                &[4.5, 5.0, 4.5, 8.0],
                &[8.0, 5.0, 8.0, 8.5],
                &[11.5, 5.0, 11.5, 8.0],
            ],
            Self::Road => &[
                &[2.5, 14.0, 6.0, 2.0],
                &[13.5, 14.0, 10.0, 2.0],
                &[8.0, 14.0, 8.0, 11.0],
                &[8.0, 8.5, 8.0, 6.5],
                &[8.0, 4.5, 8.0, 3.0],
            ],
            Self::Search => &[&[10.2, 10.2, 14.0, 14.0]],
            Self::Help => &[&[
                5.8, 6.2, 6.2, 4.6, 8.0, 3.8, 9.8, 4.6, 10.2, 6.2, 8.0, 8.2, 8.0, 9.6,
            ]],
            Self::Close => &[&[4.0, 4.0, 12.0, 12.0], &[12.0, 4.0, 4.0, 12.0]],
            Self::Right => &[&[6.0, 3.5, 10.5, 8.0, 6.0, 12.5]],
            Self::Down => &[&[3.5, 6.0, 8.0, 10.5, 12.5, 6.0]],
            Self::Eye | Self::EyeOff => &[&[
                1.5, 8.0, 4.5, 4.8, 8.0, 3.8, 11.5, 4.8, 14.5, 8.0, 11.5, 11.2, 8.0, 12.2, 4.5,
                11.2, 1.5, 8.0,
            ]],
            Self::Warning => &[
                &[8.0, 2.0, 14.5, 13.5, 1.5, 13.5, 8.0, 2.0],
                &[8.0, 6.2, 8.0, 9.8],
            ],
            Self::Layers => &[
                &[8.0, 2.0, 14.5, 5.5, 8.0, 9.0, 1.5, 5.5, 8.0, 2.0],
                &[1.5, 8.5, 8.0, 12.0, 14.5, 8.5],
                &[1.5, 11.0, 8.0, 14.5, 14.5, 11.0],
            ],
            Self::Side => &[
                &[1.5, 3.0, 14.5, 3.0, 14.5, 13.0, 1.5, 13.0, 1.5, 3.0],
                &[10.0, 3.0, 10.0, 13.0],
            ],
            _ => self.rarer_lines(),
        }
    }

    fn rarer_lines(self) -> &'static [&'static [f32]] {
        match self {
            Self::Duplicate => &[
                &[5.5, 5.5, 14.0, 5.5, 14.0, 14.0, 5.5, 14.0, 5.5, 5.5],
                &[3.5, 10.5, 2.0, 10.5, 2.0, 2.0, 10.5, 2.0, 10.5, 3.5],
            ],
            Self::Tag => &[&[2.0, 2.5, 8.0, 2.5, 14.2, 8.7, 8.7, 14.2, 2.0, 8.0, 2.0, 2.5]],
            Self::Export => &[
                &[8.0, 10.5, 8.0, 2.0],
                &[4.5, 5.5, 8.0, 2.0, 11.5, 5.5],
                &[
                    5.0, 7.5, 2.5, 7.5, 2.5, 14.0, 13.5, 14.0, 13.5, 7.5, 11.0, 7.5,
                ],
            ],
            Self::Path => &[&[3.0, 13.0, 5.5, 5.5, 10.5, 10.5, 13.0, 3.0]],
            Self::Split => &[
                &[8.0, 2.0, 8.0, 5.0],
                &[8.0, 6.5, 8.0, 9.5],
                &[8.0, 11.0, 8.0, 14.0],
                &[5.0, 5.5, 2.0, 8.0, 5.0, 10.5],
                &[11.0, 5.5, 14.0, 8.0, 11.0, 10.5],
            ],
            Self::Reverse => &[
                &[2.0, 5.5, 14.0, 5.5],
                &[10.5, 2.0, 14.0, 5.5],
                &[14.0, 10.5, 2.0, 10.5],
                &[5.5, 14.0, 2.0, 10.5],
            ],
            Self::Target => &[
                &[8.0, 1.5, 8.0, 6.0],
                &[8.0, 10.0, 8.0, 14.5],
                &[1.5, 8.0, 6.0, 8.0],
                &[10.0, 8.0, 14.5, 8.0],
            ],
            Self::Info => &[&[8.0, 7.4, 8.0, 11.6]],
            Self::Learn => &[
                &[8.0, 2.8, 15.0, 6.2, 8.0, 9.6, 1.0, 6.2, 8.0, 2.8],
                &[4.2, 8.0, 4.2, 11.2, 8.0, 13.2, 11.8, 11.2, 11.8, 8.0],
            ],
            Self::NoSignal => &[
                &[3.6, 10.6, 2.4, 8.0, 3.6, 5.4],
                &[12.4, 10.6, 13.6, 8.0, 12.4, 5.4],
                &[5.9, 9.4, 5.4, 8.0, 5.9, 6.6],
                &[10.1, 9.4, 10.6, 8.0, 10.1, 6.6],
                &[3.0, 14.0, 13.0, 2.0],
            ],
            _ => &[],
        }
    }

    /// Paints the icon in the middle of `rect`, 16 points wide.
    pub fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        self.paint_sized(painter, rect.center(), 16.0, color);
    }

    /// Paints the icon about `center`, `size` points wide.
    pub fn paint_sized(self, painter: &Painter, center: Pos2, size: f32, color: Color32) {
        let unit = size / 16.0;
        let at = |x: f32, y: f32| pos2(center.x + (x - 8.0) * unit, center.y + (y - 8.0) * unit);
        let polygon = |points: &[f32]| -> Vec<Pos2> {
            points.chunks_exact(2).map(|p| at(p[0], p[1])).collect()
        };
        let stroke = Stroke::new(1.4 * unit.max(0.8), color);
        for line in self.lines() {
            painter.add(Shape::line(polygon(line), stroke));
        }
        match self {
            Self::Aircraft => {
                for part in [
                    [8.0, 1.0, 9.2, 5.0, 9.0, 13.0, 7.0, 13.0, 6.8, 5.0],
                    [1.0, 9.2, 6.9, 5.6, 9.1, 5.6, 15.0, 9.2, 8.0, 8.2],
                    [5.0, 14.6, 7.2, 12.2, 8.8, 12.2, 11.0, 14.6, 8.0, 14.0],
                ] {
                    painter.add(Shape::convex_polygon(polygon(&part), color, Stroke::NONE));
                }
            }
            Self::Play => {
                let triangle = polygon(&[4.5, 2.5, 13.0, 8.0, 4.5, 13.5]);
                painter.add(Shape::convex_polygon(triangle, color, Stroke::NONE));
            }
            Self::Pause => {
                for x in [4.0, 9.5] {
                    let bar = Rect::from_min_max(at(x, 3.0), at(x + 2.5, 13.0));
                    painter.rect_filled(bar, 1.0, color);
                }
            }
            Self::Follow => {
                painter.circle_stroke(center, 4.0 * unit, stroke);
                painter.circle_filled(center, 1.5 * unit, color);
            }
            Self::Compass => {
                painter.circle_stroke(center, 6.4 * unit, stroke);
                let needle = polygon(&[8.0, 3.4, 10.0, 8.0, 6.0, 8.0]);
                painter.add(Shape::convex_polygon(needle, color, Stroke::NONE));
                painter.add(Shape::line(
                    polygon(&[6.0, 8.0, 8.0, 12.6, 10.0, 8.0]),
                    stroke,
                ));
            }
            Self::Settings => {
                for (x, y) in [(10.0, 4.0), (6.0, 8.0), (11.0, 12.0)] {
                    painter.circle_stroke(at(x, y), 1.9 * unit, stroke);
                }
            }
            Self::Search => {
                painter.circle_stroke(at(6.8, 6.8), 4.6 * unit, stroke);
            }
            Self::Help => {
                painter.circle_stroke(center, 6.8 * unit, stroke);
                painter.circle_filled(at(8.0, 12.0), 0.9 * unit, color);
            }
            Self::Info => {
                painter.circle_stroke(center, 6.8 * unit, stroke);
                painter.circle_filled(at(8.0, 4.8), 0.9 * unit, color);
            }
            Self::Tag => {
                painter.circle_filled(at(5.2, 5.6), 1.2 * unit, color);
            }
            Self::Path => {
                for (x, y) in [(3.0, 13.0), (5.5, 5.5), (10.5, 10.5), (13.0, 3.0)] {
                    painter.circle_filled(at(x, y), 1.7 * unit, color);
                }
            }
            Self::Eye => {
                painter.circle_filled(center, 2.0 * unit, color);
            }
            Self::EyeOff => {
                painter.line_segment([at(3.0, 13.5), at(13.0, 2.5)], stroke);
            }
            Self::Warning => {
                painter.circle_filled(at(8.0, 11.8), 0.9 * unit, color);
            }
            Self::More => {
                for x in [3.0, 8.0, 13.0] {
                    painter.circle_filled(at(x, 8.0), 1.4 * unit, color);
                }
            }
            _ => {}
        }
    }
}
