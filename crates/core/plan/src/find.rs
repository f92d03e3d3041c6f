//! Finding a route: from A to B over ground where a fix will be had.
//!
//! Sources of fixes, corners of no-fly areas and a coarse lattice are the nodes of a graph; its edges
//! are the straight ways between them that are allowed, each with what it does to the metres flown
//! without a fix (see `blind_way`). The least worst of them within a budget is found by bisection: for a
//! stated worst, the cheapest path that never exceeds it. The least mean is that of the cheapest paths
//! where every metre without a fix has a price.

use super::found::{FoundRoute, FoundRoutes};
use super::graph::{Aimed, Graph};
use super::question::{Aim, RouteQuestion};
use super::smooth::{polish, pull_tight};
use super::turns::fits;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_mission::settings::NavigatorSettings;

/// Most nodes taken from the field.
const MOST_SOURCES: usize = 260;
/// Least probability of a fix at a node.
const WORTH_A_VISIT: f64 = 0.15;
/// Nodes of the lattice on a side.
const LATTICE: usize = 12;
/// Steps of the bisection.
const STEPS: usize = 10;
/// Share of the worst at which the bisection ends.
const CLOSE: f64 = 0.02;
/// Share by which a route with fewer way-points may be worse.
const SIMPLER: f64 = 0.04;
/// Prices of a metre beside those without a fix, in worst metres of the shortest route.
const PRICES: [f64; 6] = [0.0, 0.03, 0.08, 0.2, 0.5, 1.0];

/// Why no route was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FindError {
    /// An end lies where one must not fly.
    #[error("{0} lies in a no-fly area, too near to one, or over ground that is too high")]
    EndForbidden(&'static str),
    /// There is no way.
    #[error(
        "no way leads from A to B: no-fly areas, high ground or the wind are in between; move an end, \
         lessen the clearance or fly higher"
    )]
    NoWay,
    /// Both ends are the same place.
    #[error("A and B are the same place")]
    SamePlace,
}

/// Standard deviation of the wind per axis that is left after a fix or two, m/s: the scenarios' filter
/// comes to half of that within a minute.
const WIND_AFTER_A_FIX: f64 = 0.5;

/// Factor by which the uncertainty grows faster before the first fix, for a filter with these settings.
///
/// ```
/// use pilotage_mission::settings::NavigatorSettings;
/// use pilotage_plan::growth_before_first_fix;
///
/// // A wind known to 4 m/s before, and to 0.5 m/s after a fix or two.
/// let settings = NavigatorSettings::default();
/// assert_eq!(settings.start.wind, 4.0);
/// assert_eq!(growth_before_first_fix(&settings), 8.0);
/// ```
pub fn growth_before_first_fix(settings: &NavigatorSettings) -> f64 {
    (settings.start.wind / WIND_AFTER_A_FIX).max(1.0)
}

impl RouteQuestion {
    /// Finds both routes.
    pub fn find(self) -> Result<FoundRoutes, FindError> {
        let mut search = RouteSearch::new(self)?;
        while search.advance() {}
        search.found()
    }

    /// Places of a lattice over the ground around both ends.
    fn lattice(&self) -> Vec<GroundPoint> {
        let far = self.from.distance(&self.to);
        let Some(around) = GroundRect::around([self.from, self.to]) else {
            return Vec::new();
        };
        let around = around.grown(0.45 * far);
        let at =
            |i: usize, low: f64, high: f64| low + (high - low) * (i as f64 + 0.5) / LATTICE as f64;
        (0..LATTICE * LATTICE)
            .map(|i| {
                GroundPoint::new(
                    at(i / LATTICE, around.south, around.north),
                    at(i % LATTICE, around.west, around.east),
                )
            })
            .collect()
    }

    /// Places where the field is greatest, none close to another.
    fn summits(&self, keep: impl Fn(&GroundPoint) -> bool) -> Vec<GroundPoint> {
        let field = &self.field;
        let mut cells: Vec<(f32, GroundPoint)> = (0..field.rows)
            .flat_map(|row| (0..field.columns).map(move |column| (row, column)))
            .map(|(row, column)| {
                let value = field.values[row * field.columns + column];
                (value, field.place(column, row))
            })
            .filter(|(value, place)| f64::from(*value) >= WORTH_A_VISIT && keep(place))
            .collect();
        cells.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut apart = 0.6 * self.pass;
        loop {
            let chosen = thinned(&cells, apart);
            if chosen.len() <= MOST_SOURCES {
                return chosen;
            }
            apart *= 1.4;
        }
    }
}

/// The best cells, none closer than `apart` to a better one.
fn thinned(cells: &[(f32, GroundPoint)], apart: f64) -> Vec<GroundPoint> {
    let mut taken: std::collections::HashMap<(i64, i64), Vec<GroundPoint>> =
        std::collections::HashMap::new();
    let mut chosen = Vec::new();
    for (_, place) in cells {
        let key = (
            (place.north / apart).floor() as i64,
            (place.east / apart).floor() as i64,
        );
        let close = (-1..=1).any(|n| {
            (-1..=1).any(|e| {
                let others = taken.get(&(key.0 + n, key.1 + e));
                others.is_some_and(|o| o.iter().any(|p| p.distance(place) < apart))
            })
        });
        if !close {
            taken.entry(key).or_default().push(*place);
            chosen.push(*place);
        }
    }
    chosen
}

/// Next step of the search.
enum SearchStage {
    /// Ways from the next node.
    Ways,
    /// Another step of the bisection, or another price.
    Solve(usize),
    Done,
}

/// A search under way, by pieces, so that the caller can show progress and stop.
pub struct RouteSearch {
    question: RouteQuestion,
    graph: Graph,
    stage: SearchStage,
    shortest: FoundRoute,
    /// Greatest cost.
    most: f64,
    /// Worst that was found to be possible, and the greatest that was found not to be.
    bracket: (f64, f64),
    best: Option<FoundRoute>,
}

impl RouteSearch {
    /// Prepares the search and finds the shortest route.
    pub fn new(question: RouteQuestion) -> Result<Self, FindError> {
        if question.from.distance(&question.to) < 1.0 {
            return Err(FindError::SamePlace);
        }
        for (end, name) in [(question.from, "A"), (question.to, "B")] {
            if question.forbids(&end) {
                return Err(FindError::EndForbidden(name));
            }
        }
        let corners = question.obstacles().corners(&question.turns);
        let lattice: Vec<GroundPoint> = question
            .lattice()
            .into_iter()
            .filter(|p| !question.forbids(p))
            .collect();
        let shortest = shortest(&question, &corners, &lattice).ok_or(FindError::NoWay)?;
        let most = question.budget.max(1.0) * question.cost(shortest.length, shortest.time);
        let in_reach = |p: &GroundPoint| {
            question.least_cost(&question.from, p) + question.least_cost(p, &question.to) <= most
        };
        let mut nodes = vec![question.from, question.to];
        nodes.extend(question.summits(|p| in_reach(p) && !question.forbids(p)));
        nodes.extend(corners.into_iter().chain(lattice).filter(in_reach));
        nodes.extend(&shortest.way_points[1..shortest.way_points.len() - 1]);
        Ok(Self {
            bracket: (shortest.worst_blind, 0.0),
            graph: Graph::new(nodes),
            question,
            stage: SearchStage::Ways,
            shortest,
            most,
            best: None,
        })
    }

    /// Progress of the search, 0 to 1.
    pub fn progress(&self) -> f32 {
        match self.stage {
            SearchStage::Ways => 0.6 * self.graph.progress(),
            SearchStage::Solve(step) => 0.6 + 0.4 * step as f32 / STEPS as f32,
            SearchStage::Done => 1.0,
        }
    }

    /// Does a piece of the work; false when all is done.
    pub fn advance(&mut self) -> bool {
        match self.stage {
            SearchStage::Ways => {
                if !self.graph.connect_next(&self.question, self.most) {
                    self.stage = SearchStage::Solve(0);
                }
            }
            SearchStage::Solve(step) => {
                let over = match self.question.aim {
                    Aim::Worst => self.bisect(step),
                    Aim::Mean => self.weigh(step),
                };
                self.stage = if over {
                    SearchStage::Done
                } else {
                    SearchStage::Solve(step + 1)
                };
            }
            SearchStage::Done => return false,
        }
        true
    }

    /// Routes that were found, with as few way-points as it takes.
    pub fn found(mut self) -> Result<FoundRoutes, FindError> {
        if let Some(best) = self.best.take() {
            let pulled = pull_tight(&self.question, &best, self.most, SIMPLER);
            let pulled = polish(&self.question, pulled, self.most);
            let better = self.question.aimed(&pulled) < self.question.aimed(&self.shortest);
            self.best = better.then_some(pulled);
        }
        Ok(FoundRoutes {
            surest: self.best.unwrap_or_else(|| self.shortest.clone()),
            shortest: self.shortest,
        })
    }

    fn bisect(&mut self, step: usize) -> bool {
        let (high, low) = self.bracket;
        let last = step + 1 >= STEPS || high - low <= CLOSE * high;
        // In the end the cheapest of those that are about as good.
        let limit = if last {
            (1.0 + CLOSE) * high
        } else {
            0.5 * (high + low)
        };
        let aimed = Aimed::Under(limit);
        let line = self.graph.solve(&self.question, aimed, self.most);
        match line.and_then(|line| self.question.judge(&line)) {
            Some(route) => {
                if !last {
                    self.bracket.0 = route.worst_blind.min(limit);
                }
                self.best = Some(route);
            }
            None => self.bracket.1 = limit,
        }
        last
    }

    fn weigh(&mut self, step: usize) -> bool {
        let price = PRICES[step.min(PRICES.len() - 1)] * self.shortest.worst_blind;
        let aimed = Aimed::Priced(price);
        let line = self.graph.solve(&self.question, aimed, self.most);
        if let Some(route) = line.and_then(|line| self.question.judge(&line))
            && self
                .best
                .as_ref()
                .is_none_or(|b| route.mean_blind < b.mean_blind)
        {
            self.best = Some(route);
        }
        step + 1 >= PRICES.len()
    }
}

/// The cheapest allowed route, over corners alone if that is possible.
fn shortest(
    question: &RouteQuestion,
    corners: &[GroundPoint],
    lattice: &[GroundPoint],
) -> Option<FoundRoute> {
    let straight = [question.from, question.to];
    if let Some(route) = question.judge(&straight) {
        return Some(route);
    }
    let over = |places: &[&[GroundPoint]]| {
        let mut graph = Graph::new([&straight[..], &places.concat()].concat());
        while graph.connect_next(question, f64::INFINITY) {}
        let line = graph.solve(question, Aimed::Under(f64::INFINITY), f64::INFINITY)?;
        question.judge(&line)
    };
    let by_corners = question.forbidden.is_none().then(|| over(&[corners]));
    let route = by_corners.flatten().or_else(|| over(&[corners, lattice]))?;
    if fits(&route.way_points, &question.turns).is_none() {
        return Some(route);
    }
    Some(pull_tight(question, &route, f64::INFINITY, f64::INFINITY))
}

#[cfg(test)]
#[path = "find_tests.rs"]
mod tests;
