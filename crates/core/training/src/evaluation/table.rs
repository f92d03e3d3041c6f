//! An evaluation as one long table.

use std::fmt::Write;

use super::{AtThreshold, By, CurveKind, Evaluation, Rate};

/// Places at which the probability of a score is written.
const SCORES: usize = 41;

struct EvaluationTable {
    text: String,
}

impl EvaluationTable {
    /// A row; what is `None` stays empty.
    fn row(&mut self, curve: &str, x: Option<f64>, y: [Option<f64>; 3], threshold: Option<f64>) {
        let cell = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
        let [y, low, high] = y.map(cell);
        let (x, threshold) = (cell(x), cell(threshold));
        // Writing to a text never fails.
        let _ = writeln!(self.text, "{curve},{x},{y},{low},{high},{threshold}");
    }

    fn rate(&mut self, curve: &str, x: Option<f64>, rate: &Rate, threshold: f64) {
        let y = [rate.share(), Some(rate.low), Some(rate.high)];
        self.row(curve, x, y, Some(threshold));
    }

    fn at_threshold(&mut self, name: &str, at: &AtThreshold, allowed: f64, threshold: f64) {
        let row = |what: &str| format!("{name}_{what}");
        self.rate(&row("found"), Some(allowed), &at.found, threshold);
        self.rate(&row("deceived"), Some(allowed), &at.deceived, threshold);
        let y = [Some(at.false_alarms), None, None];
        let false_alarms = row("false_alarms_per_picture");
        self.row(&false_alarms, Some(allowed), y, Some(threshold));
    }
}

impl Evaluation {
    /// Every figure as comma-separated values: `curve,x,y,low,high,threshold`. Shares run from 0 to 1;
    /// what else has a unit says it in the name of its curve.
    pub fn csv(&self) -> String {
        let mut table = EvaluationTable {
            text: "curve,x,y,low,high,threshold\n".to_owned(),
        };
        for kind in CurveKind::ALL {
            for point in &self.curve(kind).points {
                let y = [point.y, point.low, point.high].map(Some);
                table.row(kind.key(), Some(point.x), y, Some(point.threshold));
            }
        }
        let whole = |value: f64| [Some(value), None, None];
        let precision = &self.average_precision;
        let y = [precision.value, precision.low, precision.high].map(Some);
        table.row("average_precision", None, y, None);
        let operating = &self.operating;
        let (allowed, threshold) = (operating.allowed, operating.threshold);
        let y = [
            operating.detection.value,
            operating.detection.low,
            operating.detection.high,
        ];
        table.row(
            "detection_at_allowed_false_alarms",
            Some(allowed),
            y.map(Some),
            Some(threshold),
        );
        table.at_threshold("here", &operating.here, allowed, threshold);
        if let Some(held_out) = &operating.held_out {
            table.at_threshold("held_out", held_out, allowed, threshold);
        }
        for broken in &self.breakdowns {
            for bin in &broken.bins {
                let key = broken.by.key();
                let x = Some(bin.middle());
                table.rate(&format!("found_by_{key}"), x, &bin.found, threshold);
                table.rate(&format!("deceived_by_{key}"), x, &bin.deceived, threshold);
            }
        }
        if let Some(calibration) = &self.calibration {
            for bin in &calibration.reliability {
                let y = [bin.right.share(), Some(bin.right.low), Some(bin.right.high)];
                table.row("right_by_stated_probability", Some(bin.stated), y, None);
            }
            table.row("brier_score", None, whole(calibration.brier), None);
            for (name, loss) in ["logistic", "isotonic"].iter().zip(calibration.log_losses) {
                table.row(&format!("log_loss_{name}_nats"), None, whole(loss), None);
            }
            for score in self.scores(SCORES) {
                let y = whole(calibration.at(score));
                table.row("probability_by_score", Some(score), y, None);
            }
        }
        if let Some(covariance) = &self.covariance {
            let c = &covariance.covariance;
            let figures = [
                ("bias_north_m", covariance.bias[0]),
                ("bias_east_m", covariance.bias[1]),
                ("variance_north_m2", c[(0, 0)]),
                ("covariance_north_east_m2", c[(0, 1)]),
                ("variance_east_m2", c[(1, 1)]),
                ("inside_ellipse_of_95_percent", covariance.inside_95),
            ];
            for (name, value) in figures {
                table.row(name, None, whole(value), Some(threshold));
            }
            for group in &covariance.by_score.0 {
                table.row(
                    "covariance_scale_by_score",
                    Some(group.score),
                    whole(group.scale),
                    None,
                );
            }
        }
        table.text
    }

    /// Scores from the least to the greatest of the curves' thresholds, evenly.
    pub(super) fn scores(&self, count: usize) -> Vec<f64> {
        let thresholds = || self.froc.points.iter().map(|p| p.threshold);
        let low = thresholds().fold(f64::INFINITY, f64::min);
        let high = thresholds().fold(f64::NEG_INFINITY, f64::max);
        if low > high {
            return Vec::new();
        }
        let step = (high - low) / (count - 1) as f64;
        (0..count).map(|i| low + step * i as f64).collect()
    }
}

impl CurveKind {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Roc => "roc",
            Self::Froc => "froc",
            Self::PrecisionRecall => "precision_recall",
        }
    }
}

impl By {
    /// Name in files, with the unit.
    pub fn key(self) -> &'static str {
        match self {
            Self::Height => "height_m",
            Self::Tilt => "tilt_deg",
            Self::HeadingError => "heading_error_deg",
            Self::Day => "day",
            Self::Source => "real_frame",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::EvaluationSettings;
    use super::super::sample::SyntheticDetector;
    use super::*;

    #[test]
    fn the_table_has_six_columns_and_every_curve() {
        let looks = SyntheticDetector::USUAL.looks(8, 40, 2);
        let settings = EvaluationSettings {
            replicates: 50,
            ..EvaluationSettings::default()
        };
        let evaluation = Evaluation::of(&looks, &settings).unwrap();
        let csv = evaluation.csv();
        assert!(csv.starts_with("curve,x,y,low,high,threshold\n"));
        let rows: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
        assert!(rows.iter().all(|row| row.len() == 6));
        let count = |curve: &str| rows.iter().filter(|row| row[0] == curve).count();
        assert_eq!(count("roc"), evaluation.roc.points.len());
        assert_eq!(count("found_by_day"), 8);
        assert_eq!(count("right_by_stated_probability"), 10);
        assert_eq!(count("variance_north_m2"), 1);
        assert_eq!(count("held_out_found"), 1);
        for row in &rows[1..] {
            let numbers = row[1..].iter().filter(|cell| !cell.is_empty());
            for cell in numbers {
                assert!(cell.parse::<f64>().is_ok_and(f64::is_finite), "{row:?}");
            }
        }
    }
}
