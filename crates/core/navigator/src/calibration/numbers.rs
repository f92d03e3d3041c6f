//! The numbers of an estimate as people read them.

use pilotage_mission::settings::CameraAdjustment;

use super::{CameraToLog, Estimated};

/// A number of a camera beside its log, in the unit that people read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraNumber {
    /// Name for people.
    pub name: &'static str,
    /// Its unit: s, µs/s, °, % or m.
    pub unit: &'static str,
    /// All of it that is to be changed of the flight as it was opened.
    pub value: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Whether the flight tells it.
    pub is_told: bool,
}

/// The numbers of an estimate: of the whole `change` of the flight as it was opened, as well known as `told`, which was
/// estimated last, and of satellite navigation.
pub fn camera_numbers(change: &CameraAdjustment, told: &CameraToLog) -> [CameraNumber; 8] {
    let number = |name, unit, value: f64, factor: f64, of: &Estimated| CameraNumber {
        name,
        unit,
        value: factor * value,
        deviation: factor * of.deviation,
        is_told: of.is_told,
    };
    let degree = 1_f64.to_degrees();
    let angle = |name, value, of| number(name, "°", value, degree, of);
    let bias = |name, of: &Estimated| number(name, "m", of.value, 1.0, of);
    [
        number("Time offset", "s", change.offset, 1.0, &told.offset),
        number("Clock drift", "µs/s", change.drift, 1e6, &told.drift),
        angle("Mount roll", change.roll, &told.roll),
        angle("Mount pitch", change.pitch, &told.pitch),
        angle("Mount yaw", change.yaw, &told.yaw),
        CameraNumber {
            value: change.focal_percent(),
            deviation: 100.0 * change.log_focal.exp() * told.log_focal.deviation,
            ..number("Focal length", "%", 0.0, 1.0, &told.log_focal)
        },
        bias("GPS bias north", &told.bias[0]),
        bias("GPS bias east", &told.bias[1]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_degrees_and_the_focal_length_a_percentage_of_it() {
        let some = |value, deviation| Estimated {
            value,
            deviation,
            is_told: true,
        };
        let told = CameraToLog {
            offset: some(-0.1, 0.2),
            drift: some(0.0, 1e-6),
            middle: 10.0,
            roll: some(0.01, 0.001),
            pitch: some(0.0, 0.001),
            yaw: some(0.0, 0.001),
            log_focal: some(0.0, 0.01),
            bias: [some(1.5, 0.5), some(-2.0, 0.5)],
            frames: 9,
            place_deviation: [3.0, 1.0],
        };
        let change = CameraAdjustment {
            roll: 1_f64.to_radians(),
            log_focal: 1.5_f64.ln(),
            ..CameraAdjustment::none(10.0)
        };
        let numbers = camera_numbers(&change, &told);
        let of = |name| numbers.iter().find(|number| number.name == name).unwrap();
        assert!((of("Mount roll").value - 1.0).abs() < 1e-9);
        let focal = of("Focal length");
        assert!((focal.value - 50.0).abs() < 1e-9 && (focal.deviation - 1.5).abs() < 1e-9);
        assert_eq!(
            (of("GPS bias east").value, of("GPS bias east").unit),
            (-2.0, "m")
        );
        assert_eq!(of("Time offset").deviation, 0.2);
    }
}
