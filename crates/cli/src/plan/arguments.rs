//! Arguments of `pilotage plan`, of which a plan is made.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use pilotage_core::plan::{Aim, BudgetOf, Proposal};
use pilotage_jobs::{FindOrder, FixesFrom, PredictionOrder, RouteWishes};

use super::source::SourceArguments;
use crate::numbers::{above_zero, count, one_or_more, zero_or_more};

/// Measurements beside those that a prediction needs.
#[derive(Args)]
pub struct MeasureArguments {
    /// Measure from which heights and with which tilts each landmark is found.
    #[arg(long)]
    pub envelope: bool,
    /// Tell how often boxes at random are found on the map, which is what a landmark is worth that nobody tested.
    #[arg(long)]
    pub untested: bool,
}

/// Arguments of `pilotage plan`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub source: SourceArguments,
    /// Propose that many landmarks from the map, beside those that the mission has.
    #[arg(long, value_name = "N", value_parser = count)]
    pub suggest: Option<usize>,
    /// Propose from the map alone: the landmarks that the mission has are left out.
    #[arg(long, requires = "suggest")]
    pub only_suggested: bool,
    /// Side of the proposed boxes, metres; a third of the picture's shorter side on the ground if
    /// it is not stated.
    #[arg(long, value_parser = above_zero)]
    pub side: Option<f64>,
    /// Standard deviation of the position per axis, metres, when proposed landmarks are looked for:
    /// how far around them look-alikes count.
    #[arg(long, default_value_t = Proposal::POSITION, value_parser = zero_or_more)]
    pub position: f64,
    /// Predict the uncertainty along the route.
    #[arg(long)]
    pub predict: bool,
    /// Way-points instead of the scenario's: metres north and east, "0,0;400,300".
    #[arg(long, requires = "scenario", allow_hyphen_values = true)]
    pub route: Option<String>,
    /// A random route of that seed over the scenery instead of the scenario's, in a wind of which only
    /// is known what the filter is told to expect.
    #[arg(long, requires = "scenario", conflicts_with = "route")]
    pub random_route: Option<u64>,
    #[command(flatten)]
    pub find: FindArguments,
    /// Fly the plan with seeds A..B, B left out, over the generated scenery on another day, and compare
    /// the errors with the prediction.
    #[arg(long, requires_all = ["scenario", "predict"], value_name = "A..B")]
    pub fly: Option<String>,
    /// Fly without pictures: landmarks are found as often and as well as is expected of them.
    #[arg(long, requires = "fly")]
    pub as_stated: bool,
    /// Fly about that many passes over places of every quality on days that were not rehearsed, and
    /// compare how often they are found with what was said.
    #[arg(long, requires = "scenario", value_name = "PASSES", value_parser = count)]
    pub calibrate: Option<usize>,
    /// File for the reliability diagram, SVG.
    #[arg(long, requires = "calibrate")]
    pub diagram: Option<PathBuf>,
    #[command(flatten)]
    pub measure: MeasureArguments,
    /// Standard deviation of the position (longer axis) that is accepted, metres.
    #[arg(long, default_value_t = PredictionOrder::LIMIT, value_parser = above_zero)]
    pub limit: f64,
    /// Seed of rehearsal days and worlds, in place of those that everybody takes, so that the same plan has the same
    /// figures.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Write the mission, with the proposed landmarks beside its own and the found route as its first.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Write the results as JSON.
    #[arg(long)]
    pub summary: Option<PathBuf>,
}

/// Places that the route shall lead over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Over {
    /// The landmarks of the mission.
    #[default]
    Landmarks,
    /// Whatever places of the map would serve as landmarks.
    Map,
}

/// Cost that the budget is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Of {
    /// The time in the wind.
    #[default]
    Time,
    /// The length.
    Length,
}

/// Uncertainty that is to be least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Least {
    /// The worst uncertainty on the way.
    #[default]
    Worst,
    /// The mean uncertainty over the way.
    Mean,
}

/// Arguments to find a route.
#[derive(Args)]
pub struct FindArguments {
    /// Find a route between two places, metres north and east, over ground where a fix will be had; it
    /// takes the place of the route.
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_hyphen_values = true)]
    pub find: Option<Vec<String>>,
    /// Greatest cost of the found route over that of the shortest.
    #[arg(long, default_value_t = FindOrder::BUDGET, value_parser = one_or_more)]
    pub budget: f64,
    /// Kind of cost that the budget is about.
    #[arg(long, default_value = "time")]
    pub budget_of: Of,
    /// Uncertainty that is to be least.
    #[arg(long, default_value = "worst")]
    pub least: Least,
    /// Places that the route shall lead over.
    #[arg(long, default_value = "landmarks")]
    pub over: Over,
    /// Distance that is kept from the no-fly areas of the mission, metres.
    #[arg(long, default_value_t = FindOrder::CLEARANCE, value_parser = zero_or_more)]
    pub clearance: f64,
    /// Height that a found route keeps above the ground of the elevation model, metres.
    #[arg(long, default_value_t = FindOrder::GROUND_CLEARANCE, value_parser = zero_or_more)]
    pub ground_clearance: f64,
}

impl FindArguments {
    /// Wishes that the arguments state.
    pub fn wishes(&self) -> RouteWishes {
        RouteWishes {
            budget: self.budget,
            budget_of: match self.budget_of {
                Of::Time => BudgetOf::Time,
                Of::Length => BudgetOf::Length,
            },
            aim: match self.least {
                Least::Worst => Aim::Worst,
                Least::Mean => Aim::Mean,
            },
            over: match self.over {
                Over::Landmarks => FixesFrom::Landmarks,
                Over::Map => FixesFrom::Map,
            },
            clearance: self.clearance,
            ground_clearance: self.ground_clearance,
        }
    }
}
