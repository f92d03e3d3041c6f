//! Small simulations behind lessons: what several of them share.

mod bell;
mod drawn_ground;
mod looked_flight;
mod normal_draws;
mod normal_numbers;
mod picture;
mod route_belief;
mod symptoms;
mod thesis_view;
mod watched_flight;

pub use bell::bell;
pub use drawn_ground::{DrawnDay, DrawnGround, House, pictured};
pub use looked_flight::{CRUISE, LookedFlight, LookedStep, START, noiseless_airplane};
pub use normal_draws::NormalDraws;
pub use normal_numbers::normal_numbers;
pub use picture::{draw_box, draw_picture};
pub use route_belief::{RouteBelief, SPEED};
pub use symptoms::draw_symptoms;
pub use thesis_view::{AIRCRAFT, HEIGHT, LANDMARK, pose_at, seen_from};
pub use watched_flight::{
    AIRSPEED, FlownMoment, LOOK, Look, SEED, WatchedFlight, WatchedRun, Way, gate_of_looks,
};
