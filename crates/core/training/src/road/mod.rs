//! The network that sees roads, trained: pictures with their roads, gradients, steps.

mod augment;
mod drawn;
mod example;
mod gradient;
mod painter;
mod scenery_roads;
mod simd;
mod step;

pub use augment::{changed, turned};
pub use drawn::{drawn_over, drawn_roads};
pub use example::{RoadExample, RoadTruth};
pub use gradient::{LossGradient, loss_gradient};
pub use scenery_roads::scenery_roads;
pub use step::{GradientSteps, first_weights};
