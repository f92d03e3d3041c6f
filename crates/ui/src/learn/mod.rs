//! Learn: a guided tour over the run on screen, with a telling moment at every stop.

mod advice;
mod candidates;
mod command;
mod ellipse_outline;
mod feature;
mod figure;
mod found;
mod gap;
mod lesson;
mod lessons;
mod moment;
#[cfg(test)]
mod pictures;
mod sigma_points;
#[cfg(test)]
mod tests;
mod tour;
mod trial;
mod unscented;

pub use feature::LearnFeature;
