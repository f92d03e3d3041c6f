//! Findings on a camera beside its log, in words.

use super::{CameraToLog, Estimated};
use pilotage_flight::{Finding, Severity};

/// Standard deviations from which a number is said to differ from zero.
const SURELY: f64 = 3.0;

fn is_off(number: &Estimated) -> bool {
    number.is_told && number.value.abs() > SURELY * number.deviation
}

fn finding(severity: Severity, title: String, text: String) -> Finding {
    Finding {
        severity,
        title,
        text,
        span: None,
    }
}

fn warning(title: String, text: String) -> Finding {
    finding(Severity::Warning, title, text)
}

/// Findings on the camera, in words: the lag between pictures and log first, also where there is none, then
/// whatever differs from what the flight states by more than three standard deviations. Nothing of what the
/// flight does not tell.
pub fn camera_findings(told: &CameraToLog) -> Vec<Finding> {
    let lag = told.offset.is_told.then(|| of_lag(told));
    let drift = is_off(&told.drift).then(|| {
        let Estimated {
            value, deviation, ..
        } = told.drift;
        let way = if value > 0.0 { "slow" } else { "fast" };
        warning(
            format!("The camera's clock is {way}"),
            format!(
                "It loses {:.0} ± {:.0} µs a second against the log.",
                1e6 * value,
                1e6 * deviation
            ),
        )
    });
    let angles = [
        ("roll", told.roll),
        ("pitch", told.pitch),
        ("yaw", told.yaw),
    ];
    let mount = angles.into_iter().filter(|(_, angle)| is_off(angle));
    let mount = mount.map(|(name, angle)| {
        let [degrees, deviation] = [angle.value, angle.deviation].map(f64::to_degrees);
        warning(
            format!("The camera is mounted {:.1}° off in {name}", degrees.abs()),
            format!("To add to the {name} of its mount: {degrees:.1} ± {deviation:.1}°."),
        )
    });
    let focal = is_off(&told.log_focal).then(|| {
        let percent = told.adjustment().focal_percent();
        let deviation = 100.0 * told.log_focal.deviation;
        let way = if percent > 0.0 { "longer" } else { "shorter" };
        warning(
            format!(
                "The lens is {:.1} % {way} than the flight states",
                percent.abs()
            ),
            format!("The focal length changes by {percent:.1} ± {deviation:.1} %."),
        )
    });
    lag.into_iter()
        .chain(drift)
        .chain(mount)
        .chain(focal)
        .collect()
}

fn of_lag(told: &CameraToLog) -> Finding {
    let Estimated {
        value, deviation, ..
    } = told.offset;
    let seconds = (100.0 * value).round() / 100.0 + 0.0;
    let text = format!(
        "{seconds:.2} ± {deviation:.2} s to add to the times of the pictures, by {} of them laid on the map against \
         satellite navigation, attitude and height.",
        told.frames
    );
    if is_off(&told.offset) {
        let way = if value < 0.0 { "late" } else { "early" };
        let title = format!("Pictures are stamped {:.2} s too {way}", value.abs());
        return warning(title, text);
    }
    let title = "No lag between pictures and log".to_owned();
    finding(Severity::Note, title, text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64, deviation: f64) -> Estimated {
        Estimated {
            value,
            deviation,
            is_told: true,
        }
    }

    fn told(offset: Estimated, pitch: Estimated) -> CameraToLog {
        let untold = Estimated {
            is_told: false,
            ..number(9.0, 0.1)
        };
        CameraToLog {
            offset,
            drift: untold,
            middle: 0.0,
            roll: untold,
            pitch,
            yaw: untold,
            log_focal: untold,
            bias: [untold; 2],
            frames: 18,
            place_deviation: [2.6, 0.4],
        }
    }

    #[test]
    fn a_lag_is_told_with_its_side_and_nothing_that_the_flight_does_not_tell() {
        let found = camera_findings(&told(number(-0.66, 0.14), number(0.01, 0.02)));
        let titles: Vec<&str> = found.iter().map(|f| f.title.as_str()).collect();
        assert_eq!(titles, ["Pictures are stamped 0.66 s too late"]);
        assert_eq!(found[0].severity, Severity::Warning);
        assert!(found[0].text.starts_with("-0.66 ± 0.14 s"));
        let found = camera_findings(&told(number(0.4, 0.1), number(-0.1, 0.02)));
        assert_eq!(found[0].title, "Pictures are stamped 0.40 s too early");
        assert_eq!(found[1].title, "The camera is mounted 5.7° off in pitch");
    }

    #[test]
    fn no_lag_is_worth_a_note() {
        let found = camera_findings(&told(number(0.1, 0.1), number(0.0, 0.02)));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].severity, Severity::Note);
        let found = camera_findings(&told(number(-1e-9, 0.1), number(0.0, 0.02)));
        assert!(found[0].text.starts_with("0.00 ± 0.10 s"), "{found:?}");
        let mut unknown = told(number(0.1, 0.1), number(0.0, 0.02));
        unknown.offset.is_told = false;
        assert!(camera_findings(&unknown).is_empty());
    }
}
