//! Following a path of straight legs over the ground.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use nalgebra::Vector2;

use pilotage_base::frames::units::GRAVITY;
use pilotage_base::frames::{GroundPoint, wrap_pi};

/// Settings of the guidance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidanceSettings {
    /// Period of the response to a cross-track error, seconds.
    pub period: f64,
    /// Damping of that response.
    pub damping: f64,
    /// Greatest bank that is commanded, radians.
    pub bank_limit: f64,
    /// Bank with which a turn onto the next leg is planned, radians; below the limit, so that the
    /// guidance keeps some authority.
    pub planned_bank: f64,
    /// Time that rolling into the turn costs, seconds.
    pub roll_in: f64,
}

impl GuidanceSettings {
    /// The usual settings for banks up to `bank_limit`, radians; turns are planned a little below it.
    pub fn within(bank_limit: f64) -> Self {
        let usual = Self::default();
        Self {
            bank_limit,
            planned_bank: usual.planned_bank * (bank_limit / usual.bank_limit),
            ..usual
        }
    }
}

impl Default for GuidanceSettings {
    fn default() -> Self {
        Self {
            period: 9.0,
            damping: 0.8,
            bank_limit: 30.0_f64.to_radians(),
            planned_bank: 29.0_f64.to_radians(),
            roll_in: 0.5,
        }
    }
}

/// Follows a polyline of way-points over the ground; turns begin before the way-point so that they
/// end on the next leg (fly-by).
///
/// Lateral guidance after Park, Deyst and How, "A new nonlinear guidance logic for trajectory
/// tracking" (2004), in the form for straight legs that `ArduPilot` uses: acceleration
/// a = K V² / L₁ · sin η, with L₁ = ζ T V / π, K = 4ζ², and η from the ground velocity to a point L₁
/// ahead on the leg. It works on ground velocity, so that the aircraft crabs into the wind by itself.
#[derive(Clone, Debug)]
pub struct PathFollower {
    settings: GuidanceSettings,
    way_points: Vec<Vector2<f64>>,
    leg: usize,
}

impl PathFollower {
    /// A follower at the start of the path; `None` for fewer than two different way-points.
    pub fn new(way_points: &[GroundPoint], settings: GuidanceSettings) -> Option<Self> {
        let mut points: Vec<Vector2<f64>> = way_points.iter().map(|p| p.to_vector()).collect();
        points.dedup_by(|b, a| (*b - *a).norm() < 1e-6);
        (points.len() >= 2).then_some(Self {
            settings,
            way_points: points,
            leg: 0,
        })
    }

    /// Direction of a leg (north, east), a unit vector.
    fn direction(&self, leg: usize) -> Vector2<f64> {
        (self.way_points[leg + 1] - self.way_points[leg]).normalize()
    }

    /// Course of the first leg, radians clockwise from north.
    pub fn initial_course(&self) -> f64 {
        let d = self.direction(0);
        d.y.atan2(d.x)
    }

    /// Start of the path (north, east), metres.
    pub fn start(&self) -> Vector2<f64> {
        self.way_points[0]
    }

    /// Index of the leg that is being followed.
    pub fn leg(&self) -> usize {
        self.leg
    }

    /// Share of the leg that is being followed that lies behind a position, 0 to 1.
    pub fn progress(&self, position: &Vector2<f64>) -> f64 {
        let leg = self.way_points[self.leg + 1] - self.way_points[self.leg];
        let behind = leg.dot(&(position - self.way_points[self.leg])) / leg.norm_squared();
        behind.clamp(0.0, 1.0)
    }

    /// Whether the end of the last leg is passed.
    pub fn finished(&self, position: &Vector2<f64>) -> bool {
        self.leg + 2 == self.way_points.len()
            && self
                .direction(self.leg)
                .dot(&(position - self.way_points[self.leg + 1]))
                >= 0.0
    }

    /// Commanded bank, radians, right wing down positive, for a position (north, east) and a ground
    /// velocity.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_simulate::simulate::{GuidanceSettings, PathFollower};
    ///
    /// // A leg towards the north, flown at 20 m/s.
    /// let leg = [GroundPoint::new(0.0, 0.0), GroundPoint::new(1000.0, 0.0)];
    /// let mut follower = PathFollower::new(&leg, GuidanceSettings::default()).ok_or("no leg")?;
    /// let northward = Vector2::new(20.0, 0.0);
    /// assert!(follower.bank(&Vector2::new(100.0, 0.0), &northward).abs() < 1e-12);
    /// // 30 m to the right of it, it turns left.
    /// assert!(follower.bank(&Vector2::new(100.0, 30.0), &northward) < -0.05);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn bank(&mut self, position: &Vector2<f64>, ground_velocity: &Vector2<f64>) -> f64 {
        let speed = ground_velocity.norm().max(1.0);
        self.advance(position, speed);
        let along = self.direction(self.leg);
        let right = Vector2::new(-along.y, along.x);
        let ahead = self.settings.damping * self.settings.period * speed / std::f64::consts::PI;
        let gain = 4.0 * self.settings.damping * self.settings.damping;
        // Positive to the right of the leg.
        let cross_track = right.dot(&(position - self.way_points[self.leg]));
        let to_leg = (cross_track / ahead)
            .clamp(-FRAC_1_SQRT_2, FRAC_1_SQRT_2)
            .asin();
        let drift = right.dot(ground_velocity).atan2(along.dot(ground_velocity));
        let eta = wrap_pi(drift + to_leg).clamp(-FRAC_PI_2, FRAC_PI_2);
        let acceleration = -gain * speed * speed / ahead * eta.sin();
        (acceleration / GRAVITY)
            .atan()
            .clamp(-self.settings.bank_limit, self.settings.bank_limit)
    }

    /// Goes on to the next leg where a turn of the planned bank would just end on it.
    fn advance(&mut self, position: &Vector2<f64>, speed: f64) {
        while self.leg + 2 < self.way_points.len() {
            let along = self.direction(self.leg);
            let next = self.direction(self.leg + 1);
            let turn = along.perp(&next).atan2(along.dot(&next)).abs();
            let radius = speed * speed / (GRAVITY * self.settings.planned_bank.tan());
            // A way-point where the path doubles back is flown up to, not anticipated.
            let lead = radius * (0.5 * turn.min(2.4)).tan() + speed * self.settings.roll_in;
            let remaining = along.dot(&(self.way_points[self.leg + 1] - position));
            if remaining > lead {
                break;
            }
            self.leg += 1;
        }
    }
}
