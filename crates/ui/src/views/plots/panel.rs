//! The panels: which curves each shows, in which colours, with which axis.

use egui::{Color32, Painter, Pos2, Shape, Stroke, vec2};

use super::super::chart::ChartAxes;
use super::super::parts;
use super::super::picking::RECENT;
use super::draw::{self, TimeCurve};
use super::series::{AidColumn, FrameColumn, InnovationColumn, RunSeries, SeriesTable, StepColumn};
use crate::tokens::Tokens;
use crate::units::Units;

/// Kind of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PanelKind {
    /// Estimate minus truth along one axis with ±3σ.
    PositionError,
    /// Distance from the truth, of the estimate and of dead reckoning alone.
    Distance,
    /// Component of the wind beside the truth with ±σ.
    Wind,
    /// NIS of the corrections with its bounds.
    Nis,
    /// Innovations of single landmarks with ±σ.
    Innovations,
}

impl PanelKind {
    /// Every panel, from top to bottom.
    pub const ALL: [Self; 5] = [
        Self::PositionError,
        Self::Distance,
        Self::Wind,
        Self::Nis,
        Self::Innovations,
    ];

    /// Heading; `is_recorded` is a flight of which no truth is known but what a receiver said.
    pub fn title(self, is_recorded: bool) -> &'static str {
        match self {
            Self::PositionError => "Position error",
            Self::Distance if is_recorded => "Distance from recorded track",
            Self::Distance => "Distance from truth",
            Self::Wind => "Wind",
            Self::Nis => "NIS",
            Self::Innovations => "Innovations",
        }
    }

    /// Names of the two choices of the panel, short and long.
    pub fn choices(self) -> [(&'static str, &'static str); 2] {
        match self {
            Self::PositionError | Self::Wind => [("north", "north"), ("east", "east")],
            Self::Distance | Self::Nis => {
                [("linear", "linear scale"), ("log", "logarithmic scale")]
            }
            Self::Innovations => [
                ("right", "right in the picture"),
                ("down", "down in the picture"),
            ],
        }
    }

    /// Index of the choice that is made at first.
    pub fn first_choice(self) -> usize {
        usize::from(self == Self::Nis)
    }

    /// Factor from SI, and the unit on screen.
    pub fn unit(self, units: Units) -> (f64, &'static str) {
        match self {
            Self::PositionError | Self::Distance => units.length(),
            Self::Wind => units.speed(),
            Self::Nis => (1.0, ""),
            Self::Innovations => (1.0, "px"),
        }
    }

    /// Whether y is drawn by its logarithm under that choice.
    pub fn logarithmic(self, choice: usize) -> bool {
        matches!(self, Self::Distance | Self::Nis) && choice == 1
    }

    /// Layers of the panel in the units on screen.
    pub fn layers<'a>(
        self,
        choice: usize,
        series: &'a RunSeries,
        ghost: &'a RunSeries,
        tokens: &Tokens,
        factor: f64,
    ) -> Vec<PlotLayer<'a>> {
        let steps = |column: StepColumn| Self::curve(&series.steps, column as usize, factor);
        let old = |column: StepColumn| Self::curve(&ghost.steps, column as usize, factor);
        let north = choice == 0;
        let pick = |a: StepColumn, b: StepColumn| if north { a } else { b };
        match self {
            Self::PositionError => {
                let error = pick(StepColumn::NorthError, StepColumn::EastError);
                let sigma = pick(StepColumn::NorthSigma, StepColumn::EastSigma);
                let three = |sign: f64| TimeCurve {
                    factor: 3.0 * sign * factor,
                    ..steps(sigma)
                };
                vec![
                    PlotLayer::band("±3σ", three(-1.0), three(1.0), tokens.dead_reckoning),
                    PlotLayer::line("before", old(error), tokens.ghost),
                    PlotLayer::line("error", steps(error), tokens.corrected),
                ]
            }
            Self::Distance => vec![
                PlotLayer::dashed(
                    "dead reckoning alone",
                    steps(StepColumn::DeadReckoning),
                    tokens.unaided,
                ),
                PlotLayer::line("before", old(StepColumn::Distance), tokens.ghost),
                PlotLayer::line("estimate", steps(StepColumn::Distance), tokens.corrected),
            ],
            Self::Wind => {
                let wind = pick(StepColumn::WindNorth, StepColumn::WindEast);
                vec![
                    PlotLayer::band(
                        "±σ",
                        steps(pick(StepColumn::WindNorthLow, StepColumn::WindEastLow)),
                        steps(pick(StepColumn::WindNorthHigh, StepColumn::WindEastHigh)),
                        tokens.dead_reckoning,
                    ),
                    PlotLayer::line("before", old(wind), tokens.ghost),
                    PlotLayer::line(
                        "truth",
                        steps(pick(StepColumn::TrueWindNorth, StepColumn::TrueWindEast)),
                        tokens.truth,
                    ),
                    PlotLayer::line("estimate", steps(wind), tokens.corrected),
                ]
            }
            Self::Nis => Self::nis(series, tokens),
            Self::Innovations => {
                let (value, sigma) = if north {
                    (InnovationColumn::Right, InnovationColumn::RightSigma)
                } else {
                    (InnovationColumn::Down, InnovationColumn::DownSigma)
                };
                let one = |sign: f64| Self::curve(&series.accepted, sigma as usize, sign);
                vec![
                    PlotLayer::band("±σ", one(-1.0), one(1.0), tokens.dead_reckoning),
                    PlotLayer::crosses(
                        "refused",
                        Self::curve(&series.refused, value as usize, 1.0),
                        tokens.refused,
                    ),
                    PlotLayer::dots(
                        "used",
                        Self::curve(&series.accepted, value as usize, 1.0),
                        tokens.observed,
                    ),
                ]
            }
        }
    }

    /// NIS of pictures and of each aid, over the bounds that each has by its own degrees of freedom.
    fn nis<'a>(series: &'a RunSeries, tokens: &Tokens) -> Vec<PlotLayer<'a>> {
        let of = |column: FrameColumn| Self::curve(&series.frames, column as usize, 1.0);
        let bounds = if series.aids.is_empty() {
            "95 % bounds"
        } else {
            "pictures, 95 %"
        };
        let (low, high) = (of(FrameColumn::Low), of(FrameColumn::High));
        let mut layers = vec![PlotLayer::band(bounds, low, high, tokens.truth)];
        let mut dots = vec![PlotLayer::dots(
            "NIS",
            of(FrameColumn::Nis),
            tokens.observed,
        )];
        let colors = [
            tokens.corrected,
            tokens.accent,
            tokens.advice,
            tokens.road,
            tokens.dead_reckoning,
        ];
        for (readings, color) in series.aids.iter().zip(colors.into_iter().cycle()) {
            let label = &readings.label;
            let of = |column: AidColumn| Self::curve(&readings.table, column as usize, 1.0);
            let (low, high) = (of(AidColumn::Low), of(AidColumn::High));
            layers.push(PlotLayer::band(format!("{label}, 95 %"), low, high, color));
            dots.push(PlotLayer::dots(label, of(AidColumn::Used), color));
            let refused = of(AidColumn::Refused);
            let name = format!("{label}, refused");
            dots.push(PlotLayer::crosses(name, refused, tokens.refused));
        }
        layers.extend(dots);
        layers
    }

    fn curve(table: &SeriesTable, column: usize, factor: f64) -> TimeCurve<'_> {
        TimeCurve {
            times: &table.times,
            values: table.column(column),
            factor,
        }
    }

    /// Least and greatest value of the y axis so that every layer shows, rounded outwards.
    pub fn y_range(
        self,
        layers: &[PlotLayer<'_>],
        axes: &ChartAxes,
        logarithmic: bool,
    ) -> (f64, f64) {
        let extent = layers
            .iter()
            .filter(|l| !(self == Self::Innovations && l.style == Style::Crosses))
            .flat_map(|l| [Some(&l.curve), l.upper.as_ref()])
            .flatten()
            .filter_map(|c| c.extent(axes))
            .fold(None, |all: Option<(f64, f64)>, e| {
                let (low, high) = all.unwrap_or(e);
                Some((low.min(e.0), high.max(e.1)))
            });
        let Some((low, high)) = extent else {
            return if logarithmic {
                (0.1, 10.0)
            } else {
                (-1.0, 1.0)
            };
        };
        if logarithmic {
            let low = low.max(high * 1e-4).max(1e-3);
            return (
                10_f64.powf((low.log10() * 2.0).floor() * 0.5),
                10_f64.powf((high.max(low * 1.1).log10() * 2.0).ceil() * 0.5),
            );
        }
        let (low, high) = match self {
            Self::Distance | Self::Nis => (0.0, high),
            Self::PositionError | Self::Innovations => {
                let most = low.abs().max(high.abs());
                (-most, most)
            }
            Self::Wind => (low, high),
        };
        let span = (high - low).max(1e-6);
        let step = super::super::chart::ticks(0.0, span, 8)
            .get(1)
            .copied()
            .unwrap_or(span);
        let top = (high / step).ceil() * step;
        let bottom = (low / step).floor() * step;
        (bottom, if top > bottom { top } else { bottom + step })
    }
}

/// Style in which a layer is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    Line,
    Dashed,
    Band,
    Dots,
    Crosses,
}

/// Curve or band of a panel, with its name in the legend.
pub(crate) struct PlotLayer<'a> {
    pub name: String,
    pub curve: TimeCurve<'a>,
    /// Upper edge of a band.
    pub upper: Option<TimeCurve<'a>>,
    pub color: Color32,
    pub style: Style,
}

impl<'a> PlotLayer<'a> {
    fn new(name: impl Into<String>, curve: TimeCurve<'a>, color: Color32, style: Style) -> Self {
        Self {
            name: name.into(),
            curve,
            upper: None,
            color,
            style,
        }
    }

    fn line(name: impl Into<String>, curve: TimeCurve<'a>, color: Color32) -> Self {
        Self::new(name, curve, color, Style::Line)
    }

    fn dashed(name: impl Into<String>, curve: TimeCurve<'a>, color: Color32) -> Self {
        Self::new(name, curve, color, Style::Dashed)
    }

    fn dots(name: impl Into<String>, curve: TimeCurve<'a>, color: Color32) -> Self {
        Self::new(name, curve, color, Style::Dots)
    }

    fn crosses(name: impl Into<String>, curve: TimeCurve<'a>, color: Color32) -> Self {
        Self::new(name, curve, color, Style::Crosses)
    }

    fn band(
        name: impl Into<String>,
        low: TimeCurve<'a>,
        high: TimeCurve<'a>,
        color: Color32,
    ) -> Self {
        Self {
            upper: Some(high),
            ..Self::new(name, low, color, Style::Band)
        }
    }

    /// Whether there is anything to draw in the visible time.
    pub fn is_visible(&self, axes: &ChartAxes) -> bool {
        self.curve.extent(axes).is_some()
    }

    /// Draws the layer.
    pub fn draw(&self, shapes: &mut Vec<Shape>, axes: &ChartAxes) {
        let stroke = Stroke::new(1.5, self.color);
        match (self.style, &self.upper) {
            (Style::Band, Some(upper)) => {
                let color = self.color.gamma_multiply(0.22);
                draw::band(shapes, axes, &self.curve, upper, color);
            }
            (Style::Dashed, _) => draw::dashed(shapes, axes, &self.curve, stroke),
            (Style::Dots, _) => draw::marks(axes, &self.curve, |at| {
                shapes.push(Shape::circle_filled(at, 2.0, self.color));
            }),
            (Style::Crosses, _) => draw::marks(axes, &self.curve, |at| {
                let stroke = Stroke::new(1.25, self.color);
                let (down, up) = (vec2(3.0, 3.0), vec2(3.0, -3.0));
                shapes.push(Shape::line_segment([at - down, at + down], stroke));
                shapes.push(Shape::line_segment([at - up, at + up], stroke));
            }),
            _ => draw::line(shapes, axes, &self.curve, stroke),
        }
    }

    /// Draws a sample of the layer for the legend, `width` points wide around `at`.
    pub fn draw_sample(&self, painter: &Painter, at: Pos2, width: f32) {
        let half = vec2(0.5 * width, 0.0);
        match self.style {
            Style::Line => {
                painter.line_segment([at - half, at + half], Stroke::new(2.0, self.color));
            }
            Style::Dashed => {
                let stroke = Stroke::new(2.0, self.color);
                painter.extend(Shape::dashed_line(
                    &[at - half, at + half],
                    stroke,
                    4.0,
                    2.0,
                ));
            }
            Style::Band => {
                let rect = egui::Rect::from_center_size(at, vec2(width, 0.7 * width));
                painter.rect_filled(rect, 1.0, self.color.gamma_multiply(0.35));
            }
            Style::Dots => {
                painter.circle_filled(at, 2.5, self.color);
            }
            Style::Crosses => parts::cross(painter, at, 3.0, Stroke::new(1.5, self.color)),
        }
    }

    /// The layer's value at `time` (the upper edge of a band), in the units on screen; `None` where the last is long past.
    pub fn value_at(&self, time: f64) -> Option<f64> {
        let curve = self.upper.as_ref().unwrap_or(&self.curve);
        let index = curve
            .times
            .partition_point(|t| *t <= time + 1e-9)
            .checked_sub(1)
            .filter(|index| time - curve.times[*index] < RECENT)?;
        Some(f64::from(curve.values.get(index)?) * curve.factor)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::fixture::Fixture;
    use super::*;

    #[test]
    fn a_legend_does_not_tell_the_nis_of_a_picture_that_is_long_past() {
        let fixture = Fixture::new();
        let mut series = RunSeries::default();
        series.update(Some(&fixture.run), Some(&fixture.flight));
        let gap = series
            .gaps
            .iter()
            .max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        let begin = gap.unwrap().0;
        let layers = PanelKind::Nis.layers(1, &series, &series, &Tokens::dark(), 1.0);
        for layer in &layers {
            assert!(layer.value_at(begin + 2.9).is_some(), "{}", layer.name);
            assert_eq!(layer.value_at(begin + 3.1), None, "{}", layer.name);
        }
    }
}
