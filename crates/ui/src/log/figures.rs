//! Figures of fields over a span of time, as far as they have come.

use std::collections::BTreeMap;

use pilotage_core::flight::SpanStatistics;

use pilotage_jobs::SeriesName;

/// Figures of a field; none where it has no number, or why there is no such field.
pub type FieldFigures = Result<Option<SpanStatistics>, String>;

/// Figures of fields over a span of time, as far as they have come.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpanFigures {
    /// From when to when, seconds in the log's time base.
    pub span: (f64, f64),
    /// By field.
    pub fields: BTreeMap<SeriesName, FieldFigures>,
}
