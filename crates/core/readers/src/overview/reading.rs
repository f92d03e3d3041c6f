//! What the reading of the file found.

use super::super::interpret::RoleSeries;
use super::super::log::Log;
use super::{Finding, Severity};

/// What the reading of the file found.
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
                "{} bytes in {} places were skipped, {share:.2} % of the file.{place}",
                report.skipped_bytes, report.skipped_places
            ),
            span: None,
        });
    }
    findings.extend(report.remarks.iter().map(|remark| Finding {
        severity: Severity::Note,
        title: "About the file".to_owned(),
        text: remark.clone(),
        span: None,
    }));
    for series in found {
        if series.out_of_order > 0 {
            findings.push(Finding {
                severity: Severity::Warning,
                title: format!("Times of {} go back or stand still", series.source),
                text: format!(
                    "{} of {} samples were left out for it.",
                    series.out_of_order,
                    series.times.len() + series.out_of_order
                ),
                span: None,
            });
        }
        if series.implausible > 0 {
            findings.push(Finding {
                severity: Severity::Note,
                title: format!("{} holds values that cannot be", series.source),
                text: format!(
                    "{} samples are no number or beyond anything that flies, and were left out.",
                    series.implausible
                ),
                span: None,
            });
        }
    }
    findings
}
