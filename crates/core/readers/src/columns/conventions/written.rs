//! The conventions that a flight is written in.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write;

use pilotage_flight::ChannelName;

use super::flown::FlownMoment;

const GRAVITY: f64 = 9.806_65;

macro_rules! choices {
    ($($name:ident: $($case:ident)+;)+) => {
        $(
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub enum $name { #[default] $($case),+ }
            impl $name { pub const ALL: &'static [Self] = &[$(Self::$case),+]; }
        )+
    };
}

choices! {
    Time: Seconds Milliseconds Microseconds Nanoseconds Epoch EpochNanoseconds;
    Place: Degrees TenMillionths Radians Metres;
    Angle: Degrees Radians Tenths Hundredths;
    Speed: Metres Centimetres Knots Kilometres Millimetres;
    Velocity: Named Course Ned Enu Indexed None Body BodyUp;
    Attitude: Euler RosEuler Quaternion RosQuaternion QuaternionByNumber RosQuaternionByNumber Prefixed None;
    Heading: Round Half;
    Rates: Radians Degrees Milliradians;
    Axes: Down Up Pulling;
    Force: Metres Gravity Milligravity;
    Length: Metres Feet Centimetres Millimetres;
    Wind: To From FromDirection ToDirection None;
    Names: Plain Prefixed Anonymous Ros;
}

/// A channel and its value at a moment.
pub type Expected = (ChannelName, fn(&FlownMoment) -> f64);

/// A value in a unit and axes of each.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choices {
    pub time: Time,
    pub place: Place,
    pub velocity: Velocity,
    pub speed: Speed,
    pub course: Angle,
    pub course_header: Option<&'static str>,
    pub attitude: Attitude,
    pub angle: Angle,
    pub heading: Heading,
    pub rates: Rates,
    pub axes: Axes,
    pub force: Force,
    pub inertial: Names,
    pub has_inertial: Option<bool>,
    pub height: Length,
    pub airspeed: Option<Speed>,
    pub wind: Wind,
}

fn angle(unit: Angle, value: f64) -> f64 {
    match unit {
        Angle::Degrees => value.to_degrees(),
        Angle::Radians => value,
        Angle::Tenths => (value.to_degrees() * 10.0 * 100.0).round() / 100.0,
        Angle::Hundredths => (value.to_degrees() * 100.0).round(),
    }
}

fn speed(unit: Speed, value: f64) -> f64 {
    match unit {
        Speed::Metres => value,
        Speed::Centimetres => value * 100.0,
        Speed::Knots => value * 3600.0 / 1852.0,
        Speed::Kilometres => value * 3.6,
        Speed::Millimetres => value * 1000.0,
    }
}

/// A small generator of choices.
struct ChoiceGenerator(u64);

impl ChoiceGenerator {
    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        all[(self.0 >> 33) as usize % all.len()]
    }
}

impl Choices {
    /// Everything in the first of its conventions, with all columns.
    fn base() -> Self {
        Self {
            airspeed: Some(Speed::Metres),
            has_inertial: Some(true),
            ..Self::default()
        }
    }

    /// Every convention by itself.
    pub fn one_by_one() -> Vec<Self> {
        let base = Self::base();
        let mut all = vec![base];
        macro_rules! vary {
            ($($field:ident: $kind:ident),+) => {
                $(all.extend($kind::ALL.iter().map(|case| Self { $field: *case, ..base }));)+
            };
        }
        vary!(
            time: Time, place: Place, velocity: Velocity, attitude: Attitude, angle: Angle, heading: Heading, rates: Rates,
            axes: Axes, force: Force, inertial: Names, height: Length, wind: Wind
        );
        let airspeeds = Speed::ALL.iter();
        all.extend(airspeeds.map(|unit| Self {
            airspeed: Some(*unit),
            ..base
        }));
        for velocity in [
            Velocity::Named,
            Velocity::Course,
            Velocity::Ned,
            Velocity::Enu,
            Velocity::Indexed,
        ] {
            let speeds = Speed::ALL.iter();
            all.extend(speeds.map(|speed| Self {
                speed: *speed,
                velocity,
                ..base
            }));
        }
        let courses = Angle::ALL.iter();
        all.extend(courses.map(|course| Self {
            course: *course,
            velocity: Velocity::Course,
            ..base
        }));
        let angles = Angle::ALL.iter();
        all.extend(angles.map(|angle| Self {
            angle: *angle,
            attitude: Attitude::RosEuler,
            ..base
        }));
        all
    }

    /// Conventions thrown together; with some groups of columns missing, if `is_sparse`.
    pub fn mixed(count: usize, is_sparse: bool) -> Vec<Self> {
        let mut dice = ChoiceGenerator(if is_sparse { 77 } else { 5 });
        let mut one = || {
            let mut choices = Self {
                time: dice.of(Time::ALL),
                place: dice.of(&Place::ALL[..3]),
                velocity: dice.of(&Velocity::ALL[..6]),
                speed: dice.of(Speed::ALL),
                course: dice.of(Angle::ALL),
                course_header: None,
                attitude: dice.of(&Attitude::ALL[..7]),
                angle: dice.of(Angle::ALL),
                heading: dice.of(Heading::ALL),
                rates: dice.of(Rates::ALL),
                axes: dice.of(Axes::ALL),
                force: dice.of(Force::ALL),
                inertial: dice.of(Names::ALL),
                has_inertial: Some(true),
                height: dice.of(Length::ALL),
                airspeed: Some(dice.of(Speed::ALL)),
                wind: dice.of(Wind::ALL),
            };
            if is_sparse {
                choices.has_inertial = Some(dice.of(&[true, false]));
                choices.airspeed = dice.of(&[None, choices.airspeed]);
                choices.attitude = dice.of(&[choices.attitude, choices.attitude, Attitude::None]);
                choices.velocity = dice.of(&[choices.velocity, Velocity::None]);
                choices.wind = dice.of(&[choices.wind, Wind::None]);
            }
            choices
        };
        (0..count).map(|_| one()).collect()
    }

    /// The channels that a table of these conventions has, and their values.
    pub fn expected(&self) -> Vec<Expected> {
        use ChannelName as Name;
        let mut all: Vec<Expected> = vec![(Name::GpsHeight, |m| m.height)];
        all.push((Name::GpsNorth, |m| m.north));
        all.push((Name::GpsEast, |m| m.east));
        if self.velocity != Velocity::None {
            all.push((Name::GpsVelocityNorth, |m| m.velocity.x));
            all.push((Name::GpsVelocityEast, |m| m.velocity.y));
            if self.velocity != Velocity::Course {
                all.push((Name::GpsVelocityDown, |m| m.velocity.z));
            }
        }
        if self.attitude != Attitude::None {
            all.push((Name::Roll, |m| m.roll));
            all.push((Name::Pitch, |m| m.pitch));
            all.push((Name::Heading, |m| m.heading));
        }
        if self.has_inertial == Some(true) {
            all.push((Name::RollRate, |m| m.rates.x));
            all.push((Name::PitchRate, |m| m.rates.y));
            all.push((Name::YawRate, |m| m.rates.z));
            all.push((Name::AccelerationForward, |m| m.acceleration.x));
            all.push((Name::AccelerationRight, |m| m.acceleration.y));
            all.push((Name::AccelerationDown, |m| m.acceleration.z));
        }
        if self.airspeed.is_some() {
            all.push((Name::Airspeed, |m| m.airspeed));
        }
        if self.wind != Wind::None {
            all.push((Name::WindNorth, |m| m.wind[0]));
            all.push((Name::WindEast, |m| m.wind[1]));
        }
        all
    }

    fn row(&self, m: &FlownMoment) -> Vec<(String, f64)> {
        let mut cells: Vec<(String, f64)> = Vec::new();
        let mut put = |name: &str, value: f64| cells.push((name.to_owned(), value));
        let time = m.time;
        match self.time {
            Time::Seconds => put("time", time),
            Time::Milliseconds => put("time", (time * 1e3).round()),
            Time::Microseconds => put("timestamp", (time * 1e6).round() + 5e6),
            Time::Nanoseconds => put("time", (time * 1e9).round()),
            Time::Epoch => put("time", time + 1.7e9),
            Time::EpochNanoseconds => put("%time", 1.7e18 + (time * 1e9).round()),
        }
        let (lat, lon) = (m.latitude(), m.longitude());
        match self.place {
            Place::Degrees => {
                put("lat", lat.to_degrees());
                put("lon", lon.to_degrees());
            }
            Place::TenMillionths => {
                put("Latitude", (lat.to_degrees() * 1e7).round());
                put("Longitude", (lon.to_degrees() * 1e7).round());
            }
            Place::Radians => {
                put("gps_lat", lat);
                put("gps_lon", lon);
            }
            Place::Metres => {
                put("north", m.north);
                put("east", m.east);
            }
        }
        let height = match self.height {
            Length::Metres => m.height,
            Length::Feet => m.height / 0.3048,
            Length::Centimetres => m.height * 100.0,
            Length::Millimetres => m.height * 1000.0,
        };
        put("alt", height);
        for (name, value) in self.velocities(m) {
            put(name, value);
        }
        let mut three = |names: [&str; 3], values: [f64; 3]| {
            for (name, value) in names.into_iter().zip(values) {
                put(name, value);
            }
        };
        match self.attitude {
            Attitude::Euler | Attitude::Prefixed | Attitude::RosEuler => {
                let (pitch, yaw) = match self.attitude {
                    Attitude::RosEuler => (-m.pitch, FRAC_PI_2 - m.heading),
                    _ => (m.pitch, m.heading),
                };
                let yaw = match self.heading {
                    Heading::Round => yaw.rem_euclid(TAU),
                    Heading::Half => (yaw + PI).rem_euclid(TAU) - PI,
                };
                let names = match self.attitude {
                    Attitude::Prefixed => ["ATT_Roll", "ATT_Pitch", "ATT_Yaw"],
                    _ => ["roll", "pitch", "yaw"],
                };
                three(names, [m.roll, pitch, yaw].map(|a| angle(self.angle, a)));
            }
            Attitude::Quaternion | Attitude::QuaternionByNumber => {
                let [w, x, y, z] = m.quaternion(false);
                if self.attitude == Attitude::Quaternion {
                    three(["qw", "qx", "qy"], [w, x, y]);
                    put("qz", z);
                } else {
                    three(["q[0]", "q[1]", "q[2]"], [w, x, y]);
                    put("q[3]", z);
                }
            }
            Attitude::RosQuaternion | Attitude::RosQuaternionByNumber => {
                let [w, x, y, z] = m.quaternion(true);
                if self.attitude == Attitude::RosQuaternion {
                    three(
                        [
                            "pose.orientation.x",
                            "pose.orientation.y",
                            "pose.orientation.z",
                        ],
                        [x, y, z],
                    );
                    put("pose.orientation.w", w);
                } else {
                    three(["quat_1", "quat_2", "quat_3"], [x, y, z]);
                    put("quat_4", w);
                }
            }
            Attitude::None => {}
        }
        if self.has_inertial == Some(true) {
            self.inertial(m, &mut cells);
        }
        self.slow(m, &mut cells);
        cells
    }

    /// Velocity over ground.
    fn velocities(&self, m: &FlownMoment) -> Vec<(&'static str, f64)> {
        let v = [m.velocity.x, m.velocity.y, m.velocity.z].map(|v| speed(self.speed, v));
        let three =
            |names: [&'static str; 3], values: [f64; 3]| names.into_iter().zip(values).collect();
        match self.velocity {
            Velocity::Named => three(["vn", "ve", "vd"], v),
            Velocity::Ned => three(["vx", "vy", "vz"], v),
            Velocity::Enu => three(["vel_x", "vel_y", "vel_z"], [v[1], v[0], -v[2]]),
            Velocity::Indexed => three(["velocity[0]", "velocity[1]", "velocity[2]"], v),
            Velocity::Body | Velocity::BodyUp => {
                let along = m.along_body().map(|v| speed(self.speed, v));
                let up = if self.velocity == Velocity::BodyUp {
                    -1.0
                } else {
                    1.0
                };
                let along = [along.x, up * along.y, up * along.z];
                three(["body_vel_x", "body_vel_y", "body_vel_z"], along)
            }
            Velocity::Course | Velocity::None => Vec::new(),
        }
    }

    /// Gyros and accelerometers.
    fn inertial(&self, m: &FlownMoment, cells: &mut Vec<(String, f64)>) {
        let (is_up, pulls) = match self.axes {
            Axes::Down => (false, 1.0),
            Axes::Up => (true, 1.0),
            Axes::Pulling => (false, -1.0),
        };
        let turned = |v: nalgebra::Vector3<f64>| {
            if is_up {
                [v.x, -v.y, -v.z]
            } else {
                [v.x, v.y, v.z]
            }
        };
        let rates = turned(m.rates).map(|rate| match self.rates {
            Rates::Radians => rate,
            Rates::Degrees => rate.to_degrees(),
            Rates::Milliradians => rate * 1000.0,
        });
        let forces = turned(m.acceleration * pulls).map(|force| match self.force {
            Force::Metres => force,
            Force::Gravity => force / GRAVITY,
            Force::Milligravity => force / GRAVITY * 1000.0,
        });
        let (gyro, acc) = match self.inertial {
            Names::Plain => (["gyro_x", "gyro_y", "gyro_z"], ["acc_x", "acc_y", "acc_z"]),
            Names::Prefixed => (
                ["IMU_GyrX", "IMU_GyrY", "IMU_GyrZ"],
                ["IMU_AccX", "IMU_AccY", "IMU_AccZ"],
            ),
            Names::Anonymous => (["u0", "u1", "u2"], ["s_0", "s_1", "s_2"]),
            Names::Ros => (
                [
                    "field.angular_velocity.x",
                    "field.angular_velocity.y",
                    "field.angular_velocity.z",
                ],
                [
                    "field.linear_acceleration.x",
                    "field.linear_acceleration.y",
                    "field.linear_acceleration.z",
                ],
            ),
        };
        let named = gyro
            .into_iter()
            .zip(rates)
            .chain(acc.into_iter().zip(forces));
        cells.extend(named.map(|(name, value)| (name.to_owned(), value)));
    }

    /// Course, airspeed and wind.
    fn slow(&self, m: &FlownMoment, cells: &mut Vec<(String, f64)>) {
        let mut put = |name: &str, value: f64| cells.push((name.to_owned(), value));
        if self.velocity == Velocity::Course || self.course_header.is_some() {
            let course = m.velocity.y.atan2(m.velocity.x).rem_euclid(TAU);
            put("ground_speed", speed(self.speed, m.velocity.xy().norm()));
            put(
                self.course_header.unwrap_or("course"),
                angle(self.course, course),
            );
        }
        if let Some(unit) = self.airspeed {
            put("airspeed", speed(unit, m.airspeed));
        }
        let unit = self.airspeed.unwrap_or_default();
        let [north, east] = m.wind;
        let strength = speed(unit, north.hypot(east));
        let to = east.atan2(north);
        match self.wind {
            Wind::To => {
                put("wind_n", speed(unit, north));
                put("wind_e", speed(unit, east));
            }
            Wind::From => {
                put("wind_n", speed(unit, -north));
                put("wind_e", speed(unit, -east));
            }
            Wind::FromDirection => {
                put("wind_speed", strength);
                put("wind_dir", (to + PI).rem_euclid(TAU).to_degrees());
            }
            Wind::ToDirection => {
                put("wind_speed", strength);
                put("wind_dir", to.rem_euclid(TAU).to_degrees());
            }
            Wind::None => {}
        }
    }
}

/// The table of a flight in these conventions.
pub fn table(flown: &[FlownMoment], choices: &Choices) -> String {
    let mut text = String::new();
    for (index, moment) in flown.iter().enumerate() {
        let cells = choices.row(moment);
        if index == 0 {
            let names: Vec<&str> = cells.iter().map(|(name, _)| name.as_str()).collect();
            writeln!(text, "{}", names.join(",")).unwrap();
        }
        let numbers: Vec<String> = cells
            .iter()
            .map(|(name, value)| {
                let is_place =
                    name.to_lowercase().contains("lat") || name.to_lowercase().contains("lon");
                if name.starts_with('q') || is_place && value.abs() < 100.0 {
                    format!("{value:.9}")
                } else if value.abs() > 1e15 {
                    format!("{value:.0}")
                } else {
                    format!("{value:.5}")
                }
            })
            .collect();
        writeln!(text, "{}", numbers.join(",")).unwrap();
    }
    text
}
