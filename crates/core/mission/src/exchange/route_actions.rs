//! Actions of routes in formats that have lines alone.

use crate::mission::{Route, WayPointAction};

/// That other programs see no more of routes than their lines, where there is more.
pub(super) fn unseen(routes: &[Route]) -> Option<String> {
    let acts = |route: &Route| {
        route.returns || (route.way_points.iter()).any(|w| w.action != WayPointAction::FlyBy)
    };
    routes.iter().any(acts).then(|| {
        "other programs see the line of the route, and neither take-off, circles, waiting, landing nor return"
            .to_owned()
    })
}
