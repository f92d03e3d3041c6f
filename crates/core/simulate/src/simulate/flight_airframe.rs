//! A small fixed-wing aircraft as a point mass in coordinated flight.

use nalgebra::{Vector2, Vector3};

use pilotage_base::frames::units::{GRAVITY, feet};
use pilotage_base::frames::{Attitude, wrap_pi};

/// Performance of an aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Airframe {
    /// Airspeed held in cruise, m/s.
    pub cruise: f64,
    /// Time constant with which the airspeed returns to its command, seconds.
    pub airspeed_lag: f64,
    /// Greatest bank, radians.
    pub bank_limit: f64,
    /// Greatest roll rate, rad/s.
    pub roll_rate_limit: f64,
    /// Time constant of the bank towards its command, seconds.
    pub roll_lag: f64,
    /// Time constant of the height hold, seconds.
    pub height_lag: f64,
    /// Time constant of the climb rate, seconds.
    pub climb_lag: f64,
    /// Greatest climb and sink rate, m/s.
    pub climb_limit: f64,
    /// Angle of attack in level cruise, radians.
    pub angle_of_attack: f64,
}

impl Airframe {
    /// The Sig Kadet Senior of the thesis: 61.9 ft/s follow from its leg times of 40 s in calm air
    /// and 55 s against 10 kt; the rest is typical of a slow trainer.
    ///
    /// ```
    /// use pilotage_simulate::simulate::Airframe;
    ///
    /// // 61.9 ft/s.
    /// assert!((Airframe::sig_kadet_senior().cruise - 61.9 * 0.3048).abs() < 0.01);
    /// ```
    pub fn sig_kadet_senior() -> Self {
        Self {
            cruise: feet(61.9),
            airspeed_lag: 2.5,
            bank_limit: 30.0_f64.to_radians(),
            roll_rate_limit: 45.0_f64.to_radians(),
            roll_lag: 0.4,
            height_lag: 3.0,
            climb_lag: 0.8,
            climb_limit: 2.0,
            angle_of_attack: 2.0_f64.to_radians(),
        }
    }
}

/// Command to the aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirframeCommand {
    /// Bank, radians, right wing down positive.
    pub bank: f64,
    /// Airspeed, m/s.
    pub airspeed: f64,
    /// Height above the origin's level, metres.
    pub height: f64,
}

/// The true state of the aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AircraftState {
    /// Position in world NED, metres.
    pub position: Vector3<f64>,
    /// True airspeed, m/s.
    pub airspeed: f64,
    /// Heading, radians clockwise from north; no sideslip.
    pub heading: f64,
    /// Bank, radians, right wing down positive.
    pub bank: f64,
    /// Climb rate relative to the air, m/s, up positive.
    pub climb: f64,
    /// Gust (along, across to the right, down), m/s.
    pub gust: Vector3<f64>,
}

impl AircraftState {
    /// Level cruise at `position` (north, east), `height` metres up, in the direction `heading`.
    pub fn cruising(
        airframe: &Airframe,
        position: Vector2<f64>,
        height: f64,
        heading: f64,
    ) -> Self {
        Self {
            position: Vector3::new(position.x, position.y, -height),
            airspeed: airframe.cruise,
            heading,
            bank: 0.0,
            climb: 0.0,
            gust: Vector3::zeros(),
        }
    }

    /// Velocity of the air at the aircraft (north, east, down) for a mean wind (north, east), m/s.
    pub fn air_velocity(&self, wind: &Vector2<f64>) -> Vector3<f64> {
        let (sin, cos) = self.heading.sin_cos();
        Vector3::new(
            wind.x + cos * self.gust.x - sin * self.gust.y,
            wind.y + sin * self.gust.x + cos * self.gust.y,
            self.gust.z,
        )
    }

    /// Velocity over the ground (north, east, down), m/s: through the air plus that of the air.
    ///
    /// ```
    /// use nalgebra::{Vector2, Vector3};
    /// use pilotage_simulate::simulate::{AircraftState, Airframe};
    ///
    /// // Heading east at 18.87 m/s in air that moves north by 5 m/s.
    /// let airframe = Airframe::sig_kadet_senior();
    /// let state = AircraftState::cruising(&airframe, Vector2::zeros(), 100.0, 90_f64.to_radians());
    /// let velocity = state.ground_velocity(&Vector2::new(5.0, 0.0));
    /// assert!((velocity - Vector3::new(5.0, airframe.cruise, 0.0)).norm() < 1e-9);
    /// ```
    pub fn ground_velocity(&self, wind: &Vector2<f64>) -> Vector3<f64> {
        let climb = self.climb.clamp(-0.9 * self.airspeed, 0.9 * self.airspeed);
        let level = (self.airspeed * self.airspeed - climb * climb).sqrt();
        let (sin, cos) = self.heading.sin_cos();
        Vector3::new(level * cos, level * sin, -climb) + self.air_velocity(wind)
    }

    /// Attitude of the body: the nose stands above the path by the angle of attack, which grows
    /// with the load factor of the turn, 1/cos φ.
    pub fn attitude(&self, airframe: &Airframe) -> Attitude {
        let load = 1.0 / self.bank.cos();
        let path_angle = (self.climb / self.airspeed).clamp(-1.0, 1.0).asin();
        Attitude {
            roll: self.bank,
            pitch: path_angle + airframe.angle_of_attack * load,
            yaw: wrap_pi(self.heading),
        }
    }

    /// Goes on by `dt` seconds into a new gust.
    ///
    /// Heading by the coordinated turn, ψ' = g tan φ / V. The aircraft has inertia along its path: a
    /// gust from ahead first shows in the airspeed, which then returns to its command. Across the
    /// path and vertically it drifts with the air.
    pub fn step(
        &mut self,
        airframe: &Airframe,
        command: &AirframeCommand,
        wind: &Vector2<f64>,
        gust: Vector3<f64>,
        dt: f64,
    ) {
        let before = self.ground_velocity(wind);

        let wanted_bank = command
            .bank
            .clamp(-airframe.bank_limit, airframe.bank_limit);
        let roll_rate = ((wanted_bank - self.bank) / airframe.roll_lag)
            .clamp(-airframe.roll_rate_limit, airframe.roll_rate_limit);
        self.bank += roll_rate * dt;

        let turn_rate = GRAVITY * self.bank.tan() / self.airspeed;
        self.heading = wrap_pi(self.heading + turn_rate * dt);

        self.airspeed += (command.airspeed - self.airspeed) * (dt / airframe.airspeed_lag)
            - (gust.x - self.gust.x);
        self.airspeed = self.airspeed.max(0.5 * airframe.cruise);

        let height = -self.position.z;
        let wanted_climb = ((command.height - height) / airframe.height_lag)
            .clamp(-airframe.climb_limit, airframe.climb_limit);
        self.climb += (wanted_climb - self.climb) * (dt / airframe.climb_lag);

        self.gust = gust;
        self.position += 0.5 * dt * (before + self.ground_velocity(wind));
    }
}
