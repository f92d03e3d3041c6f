//! Scene that a panel is drawn from, and parts that panels over time and against a field share.

use egui::{Color32, Response};

use super::{OpenLog, PlottedSeries};
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, TimeCurve};
use pilotage_jobs::SeriesName;

/// Share of its height that a panel leaves free above and below its curves.
pub(super) const MARGIN: f64 = 0.06;

/// Scene that a panel is drawn from.
pub(super) struct PanelScene<'a> {
    pub log: &'a OpenLog,
    pub number: usize,
    pub is_active: bool,
    /// Height of the heading and of the curves, points.
    pub size: (f32, f32),
    pub span: (f64, f64),
    pub hover: Option<f64>,
    pub modes: &'a [(f64, f64, String)],
}

/// The stretches of time in which a mode lasted, with its name.
pub(super) fn mode_bands(log: &OpenLog, whole: (f64, f64)) -> Vec<(f64, f64, String)> {
    let modes = log.outline.as_ref().map_or(&[][..], |o| &o.modes);
    let ends = modes.iter().skip(1).map(|m| m.time).chain([whole.1]);
    let bands = modes.iter().zip(ends);
    bands
        .map(|(mode, end)| (mode.time, end, mode.mode.clone()))
        .collect()
}

/// Colours of the fields of a panel, in order, over and over.
pub(super) fn colour(tokens: &Tokens, index: usize) -> Color32 {
    let colours = [
        tokens.dead_reckoning,
        tokens.accent,
        tokens.truth,
        tokens.corrected,
        tokens.unaided,
        tokens.observed,
    ];
    colours[index % colours.len()]
}

/// Axes of the curves in a panel, with their times; the values are not known yet.
pub(super) fn axes(response: &Response, tokens: &Tokens, span: (f64, f64)) -> ChartAxes {
    ChartAxes {
        rect: TimeAxis::curves_rect(response.rect, tokens),
        x: span,
        y: (0.0, 1.0),
        log: false,
    }
}

pub(super) fn curve(series: &PlottedSeries) -> TimeCurve<'_> {
    TimeCurve {
        times: &series.times,
        values: series.values(),
        factor: 1.0,
    }
}

/// Least and greatest value that are to be seen over `axes`' time, with room above and below; `None` if there is
/// none.
pub(super) fn y_range<'a>(
    series: impl Iterator<Item = &'a PlottedSeries>,
    axes: &ChartAxes,
) -> Option<(f64, f64)> {
    let extents = series.filter_map(|series| {
        let (low, high) = curve(series).extent(axes)?;
        Some((low + series.base, high + series.base))
    });
    let (low, high) = extents.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
    Some(wider(low, high))
}

/// A range of values with room around it.
pub(super) fn wider(low: f64, high: f64) -> (f64, f64) {
    let margin = (MARGIN * (high - low)).max(1e-9 * high.abs()).max(1e-12);
    (low - margin, high + margin)
}

/// Why there is nothing to see of fields.
pub(super) fn nothing<'a>(
    log: &'a OpenLog,
    fields: impl Iterator<Item = &'a SeriesName>,
) -> &'a str {
    for found in fields.map(|field| log.series.get(field)) {
        match found {
            // What is read by and by may have it yet.
            Some(series) if log.is_read() && series.lacks.is_some() => {
                return series.lacks.as_deref().unwrap_or_default();
            }
            Some(series) if series.is_whole() && series.lacks.is_none() => {}
            _ => return "Fetching …",
        }
    }
    "Nothing in this stretch of time."
}
