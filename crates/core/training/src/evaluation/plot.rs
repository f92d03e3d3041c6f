//! The plots of an evaluation, for whoever draws them.

use serde::{Deserialize, Serialize};

use super::{By, Evaluation, Rate};

/// Scores at which the probability is drawn.
const SCORES: usize = 81;

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotAxis {
    /// Quantity of the axis, with the unit.
    pub label: String,
    /// Value at the left or lower end.
    pub low: f64,
    /// Value at the right or upper end.
    pub high: f64,
    /// Whether it is drawn by its logarithm; lesser values then lie at the lower end.
    pub logarithmic: bool,
    /// Places that have words instead of numbers; empty for an axis of numbers.
    pub words: Vec<(f64, String)>,
}

/// Style in which a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SeriesStyle {
    /// A line with its interval as a band.
    Line,
    /// The same, level from each point to the next.
    Steps,
    /// Dots with their intervals as bars.
    Dots,
}

/// A point with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotPoint {
    /// Along the x axis.
    pub x: f64,
    /// Along the y axis.
    pub y: f64,
    /// Lower end of the interval of y.
    pub low: f64,
    /// Upper end of the interval of y.
    pub high: f64,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotSeries {
    /// Name of the points.
    pub name: String,
    /// Style in which the points are drawn.
    pub style: SeriesStyle,
    /// The points, x ascending.
    pub points: Vec<PlotPoint>,
}

/// Plot of at most two series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Name in files.
    pub key: String,
    /// Title of the plot.
    pub title: String,
    /// The axis to the right.
    pub x: PlotAxis,
    /// The axis upwards.
    pub y: PlotAxis,
    /// Series that are drawn: at most two.
    pub series: Vec<PlotSeries>,
    /// A dashed line from corner to corner, where x and y are to be equal.
    pub diagonal: bool,
    /// A dashed line at that x, with words.
    pub limit: Option<(f64, String)>,
}

impl Plot {
    /// Whether the words of the limit have more room below the first series than above it.
    pub fn limit_below(&self) -> bool {
        let at = self.limit.as_ref().map_or(f64::NAN, |limit| limit.0);
        let before = |p: &&PlotPoint| p.x <= at;
        let points = self.series.first().map(|s| s.points.iter());
        let last = points.and_then(|points| points.take_while(before).last());
        last.is_some_and(|p| self.y.fraction(p.y) > 0.5)
    }
}

impl PlotSeries {
    /// The points that lines run through: those of steps with their corners.
    pub fn corners(&self) -> Vec<PlotPoint> {
        if self.style != SeriesStyle::Steps {
            return self.points.clone();
        }
        let mut corners: Vec<PlotPoint> = Vec::with_capacity(2 * self.points.len());
        for point in &self.points {
            if let Some(last) = corners.last().copied() {
                corners.push(PlotPoint { x: point.x, ..last });
            }
            corners.push(*point);
        }
        corners
    }
}

impl PlotAxis {
    fn new(label: &str, low: f64, high: f64) -> Self {
        Self {
            label: label.to_owned(),
            low,
            high,
            logarithmic: false,
            words: Vec::new(),
        }
    }

    /// Place of a value between the ends, 0 to 1.
    pub fn fraction(&self, value: f64) -> f64 {
        let scale = |v: f64| if self.logarithmic { v.ln() } else { v };
        let value = value.clamp(self.low, self.high);
        (scale(value) - scale(self.low)) / (scale(self.high) - scale(self.low))
    }

    /// At most about `most` places with their labels.
    pub fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        if !self.words.is_empty() {
            let stride = self.words.len().div_ceil(most.max(1));
            return self.words.iter().step_by(stride).cloned().collect();
        }
        if self.logarithmic {
            let first = (self.low.log10() - 1e-9).ceil() as i32;
            let last = (self.high.log10() + 1e-9).floor() as i32;
            let tick = |e: i32| 10_f64.powi(e);
            return (first..=last)
                .map(|e| (tick(e), tick(e).to_string()))
                .collect();
        }
        let raw = (self.high - self.low) / most.max(1) as f64;
        let power = 10_f64.powf(raw.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * power);
        let step = steps.into_iter().find(|s| *s >= 0.999 * raw).unwrap_or(raw);
        let decimals = (-(step * 1.000_001).log10().floor()).max(0.0) as usize;
        let first = (self.low / step - 1e-6).ceil() as i64;
        let last = (self.high / step + 1e-6).floor() as i64;
        let label = |v: f64| format!("{:.decimals$}", v + 0.0).replace('-', "−");
        (first..=last)
            .map(|i| (i as f64 * step, label(i as f64 * step)))
            .collect()
    }
}

const DETECTION: &str = "found, % of pictures with the landmark";

impl Evaluation {
    /// All plots, in the order in which they are read.
    pub fn plots(&self) -> Vec<Plot> {
        let mut plots = vec![self.trade(), self.precision()];
        plots.extend(By::ALL.into_iter().filter_map(|by| self.broken_down(by)));
        plots.extend(self.reliability());
        plots.extend(self.probability());
        plots
    }

    /// Detections against false alarms: both characteristics.
    fn trade(&self) -> Plot {
        let series = |name: &str, curve: &super::Curve| PlotSeries {
            name: name.to_owned(),
            style: SeriesStyle::Steps,
            points: (curve.points.iter())
                .map(|p| percent(p.x, p.y, p.low, p.high))
                .collect(),
        };
        let series = vec![
            series("ROC: share of pictures with a false alarm", &self.roc),
            series("FROC: false alarms per picture", &self.froc),
        ];
        // From where one look makes a difference, at least a decade below what is allowed.
        let least = (1.0 / self.looks as f64).min(0.1 * self.operating.allowed.max(1e-6));
        let most = self.froc.points.last().map_or(1.0, |p| p.x.max(1.0));
        Plot {
            key: "false_alarms".to_owned(),
            title: "Detections against false alarms".to_owned(),
            x: PlotAxis {
                logarithmic: true,
                ..PlotAxis::new(
                    "false alarms per picture, or share of pictures with one",
                    10_f64.powf(least.log10().floor()),
                    10_f64.powf((most.log10() - 1e-9).ceil()),
                )
            },
            y: from_below(DETECTION, &series),
            series,
            diagonal: false,
            limit: Some((
                self.operating.allowed,
                format!("allowed: {}", self.operating.allowed),
            )),
        }
    }

    fn precision(&self) -> Plot {
        let points = self.precision_recall.points.iter();
        let series = vec![PlotSeries {
            name: format!("average precision {:.3}", self.average_precision.value),
            style: SeriesStyle::Line,
            points: points
                .map(|p| percent(100.0 * p.x, p.y, p.low, p.high))
                .collect(),
        }];
        Plot {
            key: "precision_recall".to_owned(),
            title: "Precision against recall".to_owned(),
            x: PlotAxis::new(DETECTION, 0.0, 100.0),
            y: from_below("right, % of marks", &series),
            series,
            diagonal: false,
            limit: None,
        }
    }

    /// Detections against a circumstance; `None` where all looks have the same.
    fn broken_down(&self, by: By) -> Option<Plot> {
        let broken = self.breakdowns.iter().find(|b| b.by == by)?;
        let (first, last) = (broken.bins.first()?, broken.bins.last()?);
        if broken.bins.len() < 2 {
            return None;
        }
        let series = |name: &str, of: &dyn Fn(&super::CircumstanceBin) -> Rate| PlotSeries {
            name: name.to_owned(),
            style: SeriesStyle::Dots,
            points: (broken.bins.iter())
                .filter_map(|bin| {
                    let rate = of(bin);
                    Some(percent(bin.middle(), rate.share()?, rate.low, rate.high))
                })
                .collect(),
        };
        let series = vec![series("found", &|bin| bin.found)];
        let label = match by.unit() {
            "" => by.name().to_owned(),
            "deg" => format!("{}, °", by.name()),
            unit => format!("{}, {unit}", by.name()),
        };
        let margin = if by.counts() { 0.5 } else { 0.0 };
        let words = match by {
            By::Source => vec![(0.0, "render".to_owned()), (1.0, "real frame".to_owned())],
            By::Day => (broken.bins.iter())
                .map(|bin| (bin.low, format!("{:.0}", bin.low)))
                .collect(),
            _ => Vec::new(),
        };
        Some(Plot {
            key: by.key().to_owned(),
            title: format!(
                "Detections by {} at {} false alarms per picture",
                by.name(),
                self.operating.allowed
            ),
            x: PlotAxis {
                words,
                ..PlotAxis::new(&label, first.low - margin, last.high + margin)
            },
            y: from_below(DETECTION, &series),
            series,
            diagonal: false,
            limit: None,
        })
    }

    fn reliability(&self) -> Option<Plot> {
        let calibration = self.calibration.as_ref()?;
        let points = calibration.reliability.iter().filter_map(|bin| {
            let right = &bin.right;
            Some(percent(
                100.0 * bin.stated,
                right.share()?,
                right.low,
                right.high,
            ))
        });
        Some(Plot {
            key: "reliability".to_owned(),
            title: "Probabilities on days left out".to_owned(),
            x: PlotAxis::new("stated probability of being right, %", 0.0, 100.0),
            y: PlotAxis::new("right, % of marks", 0.0, 100.0),
            series: vec![PlotSeries {
                name: format!("Brier score {:.4}", calibration.brier),
                style: SeriesStyle::Dots,
                points: points.collect(),
            }],
            diagonal: true,
            limit: None,
        })
    }

    fn probability(&self) -> Option<Plot> {
        let calibration = self.calibration.as_ref()?;
        let scores = self.scores(SCORES);
        let (first, last) = (*scores.first()?, *scores.last()?);
        if last <= first {
            return None;
        }
        let points = scores.iter().map(|&score| {
            let p = calibration.at(score);
            percent(score, p, p, p)
        });
        Some(Plot {
            key: "score".to_owned(),
            title: "What a score means".to_owned(),
            x: PlotAxis::new("score", first, last),
            y: PlotAxis::new("probability of being right, %", 0.0, 100.0),
            series: vec![PlotSeries {
                name: "probability".to_owned(),
                style: SeriesStyle::Line,
                points: points.collect(),
            }],
            diagonal: false,
            limit: Some((
                self.operating.threshold,
                format!("threshold {:.3}", self.operating.threshold),
            )),
        })
    }
}

/// A share and its interval as percent.
fn percent(x: f64, y: f64, low: f64, high: f64) -> PlotPoint {
    PlotPoint {
        x,
        y: 100.0 * y,
        low: 100.0 * low,
        high: 100.0 * high,
    }
}

/// An axis of percent up to 100, from where all intervals are shown.
fn from_below(label: &str, series: &[PlotSeries]) -> PlotAxis {
    let points = series.iter().flat_map(|s| &s.points);
    let least = points.map(|p| p.low).fold(100.0, f64::min);
    let begins = [90.0, 80.0, 50.0].into_iter().find(|begin| least >= *begin);
    PlotAxis::new(label, begins.unwrap_or(0.0), 100.0)
}

#[cfg(test)]
mod tests {
    use super::super::EvaluationSettings;
    use super::super::sample::SyntheticDetector;
    use super::*;

    fn axis(low: f64, high: f64) -> PlotAxis {
        PlotAxis::new("x", low, high)
    }

    #[test]
    fn ticks_are_round_and_lie_within_the_axis() {
        let labels = |axis: &PlotAxis, most| -> Vec<String> {
            axis.ticks(most).into_iter().map(|t| t.1).collect()
        };
        assert_eq!(
            labels(&axis(0.0, 100.0), 5),
            ["0", "20", "40", "60", "80", "100"]
        );
        assert_eq!(
            labels(&axis(-1.0, 1.0), 4),
            ["−1.0", "−0.5", "0.0", "0.5", "1.0"]
        );
        let mut decades = axis(0.001, 1.0);
        decades.logarithmic = true;
        assert_eq!(labels(&decades, 4), ["0.001", "0.01", "0.1", "1"]);
        assert!((decades.fraction(0.01) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(decades.fraction(0.0), 0.0);
    }

    #[test]
    fn every_plot_holds_its_points_between_its_axes() {
        let looks = SyntheticDetector::USUAL.looks(8, 40, 2);
        let settings = EvaluationSettings {
            replicates: 50,
            ..EvaluationSettings::default()
        };
        let plots = Evaluation::of(&looks, &settings).unwrap().plots();
        let keys: Vec<_> = plots.iter().map(|p| p.key.as_str()).collect();
        assert_eq!(keys.len(), 9, "{keys:?}");
        for plot in &plots {
            assert!(plot.x.ticks(6).len() >= 2 && plot.y.ticks(6).len() >= 2);
            for point in plot.series.iter().flat_map(|s| &s.points) {
                assert!(
                    point.low <= point.y && point.y <= point.high,
                    "{}",
                    plot.key
                );
                assert!(
                    (plot.y.low..=plot.y.high).contains(&point.low),
                    "{}",
                    plot.key
                );
                assert!(point.x <= plot.x.high, "{}", plot.key);
            }
        }
    }
}
