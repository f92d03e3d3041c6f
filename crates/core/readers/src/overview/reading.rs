//! Findings of the reading of the file.

use super::super::interpret::{RoleSeries, estimated_places};
use super::super::log::Log;
use super::{Finding, Severity};
use pilotage_base::text::by_count;

/// Findings of the reading of the file.
pub fn of_reading(log: &Log, found: &[RoleSeries]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let report = &log.report;
    if !report.is_clean() {
        let bytes = report.bytes.max(1);
        let share = 100.0 * report.skipped_bytes as f64 / bytes as f64;
        let first = report.skipped.first();
        let place = first.map_or_else(String::new, |s| {
            format!(" The first at byte {}: {}.", s.offset, s.cause)
        });
        findings.push(Finding {
            severity: if share > 1.0 {
                Severity::Warning
            } else {
                Severity::Note
            },
            title: "Part of the file is unreadable".to_owned(),
            text: format!(
                "{} {} skipped, {share:.2} % of the file.{place}",
                report.skipped_bytes,
                match (report.skipped_bytes, report.skipped_places) {
                    (1, _) => "byte was".to_owned(),
                    (_, 1) => "bytes in 1 place were".to_owned(),
                    (_, places) => format!("bytes in {places} places were"),
                }
            ),
            span: None,
        });
    }
    findings.extend(report.remarks.iter().map(|remark| {
        // What nothing in the file tells, a person can.
        let is_question = remark.contains("? ") || remark.ends_with('?');
        let (severity, title) = if is_question {
            (Severity::Warning, "A question about the file")
        } else {
            (Severity::Note, "About the file")
        };
        Finding {
            severity,
            title: title.to_owned(),
            text: remark.clone(),
            span: None,
        }
    }));
    findings.extend(estimated_places(found).map(|source| Finding {
        severity: Severity::Note,
        title: "No satellite receiver tells a place".to_owned(),
        text: format!(
            "The track is the autopilot's own estimate ({source}): nothing here tells how far off it is, and GPS outages \
             cannot be cut."
        ),
        span: None,
    }));
    findings.extend(
        together(found, |series| series.out_of_order).map(|(sources, of)| Finding {
            severity: Severity::Warning,
            title: format!("Times of {sources} go back or stand still"),
            text: format!(
                "{} of {} samples {} left out for it.",
                of.out_of_order,
                of.times.len() + of.out_of_order,
                by_count(of.out_of_order, "was", "were")
            ),
            span: None,
        }),
    );
    findings.extend(
        together(found, |series| series.implausible).map(|(sources, of)| Finding {
            severity: Severity::Note,
            title: format!("{sources} holds values that cannot be"),
            text: format!(
                "{} {} left out.",
                of.implausible,
                by_count(
                    of.implausible,
                    "sample is no number or beyond anything that flies, and was",
                    "samples are no number or beyond anything that flies, and were"
                )
            ),
            span: None,
        }),
    );
    findings
}

/// The series of which some samples were left out, those of one topic with as many together: their sources in words and
/// the first of them.
fn together(
    found: &[RoleSeries],
    count: fn(&RoleSeries) -> usize,
) -> impl Iterator<Item = (String, &RoleSeries)> {
    let mut groups: Vec<Vec<&RoleSeries>> = Vec::new();
    for series in found.iter().filter(|series| count(series) > 0) {
        let is_like = |group: &&mut Vec<&RoleSeries>| {
            topic(group[0]) == topic(series) && count(group[0]) == count(series)
        };
        match groups.iter_mut().find(is_like) {
            Some(group) => group.push(series),
            None => groups.push(vec![series]),
        }
    }
    groups.into_iter().map(|group| match group.as_slice() {
        [one] => (one.source.clone(), *one),
        several => (topic(several[0]).to_owned(), several[0]),
    })
}

/// The topic of a series' source.
fn topic(series: &RoleSeries) -> &str {
    series
        .source
        .rsplit_once('.')
        .map_or(&series.source, |(topic, _)| topic)
}
