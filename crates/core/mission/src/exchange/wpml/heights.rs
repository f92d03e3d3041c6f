//! Heights of a route as both files state them.

use super::super::ExchangeError;
use super::UNDULATION;
use super::name::NAME;
use crate::mission::{Route, WayPoint, WayPointAction};
use pilotage_base::frames::AltitudeFrame;

/// Heights in metres, and the modes, in the words of both files, that say from where they count.
pub(super) struct WpmlHeights {
    /// `None` where the template cannot state them.
    pub drawn_mode: Option<&'static str>,
    pub drawn: Vec<f64>,
    pub flown_mode: &'static str,
    pub flown: Vec<f64>,
}

/// The heights of a route, which in a file of DJI all count from the same.
pub(super) fn heights(route: &Route) -> Result<WpmlHeights, ExchangeError> {
    let cannot_hold = |what: &str, advice| ExchangeError::CannotHold {
        format: NAME,
        what: what.to_owned(),
        advice,
    };
    let way_points = &route.way_points;
    let Some(first) = way_points.first() else {
        return Err(cannot_hold("a route without way-points", "draw it first"));
    };
    let frame = first.altitude.frame;
    let mut metres: Vec<f64> = way_points.iter().map(|w| w.altitude.metres).collect();
    // It lands by itself: nothing is flown to on the ground.
    let lands = way_points
        .last()
        .is_some_and(|w| w.action == WayPointAction::Land);
    let flown = if lands && metres.len() > 1 {
        let before = metres[metres.len() - 2];
        if let Some(last) = metres.last_mut() {
            *last = before;
        }
        &way_points[..metres.len() - 1]
    } else {
        way_points
    };
    if flown.iter().any(|w| w.altitude.frame != frame) {
        return Err(cannot_hold(
            "heights of several kinds in one mission",
            "let all of them count from take-off, or all from the ground",
        ));
    }
    if metres.iter().any(|m| !m.is_finite()) {
        return Err(cannot_hold(
            "a height that is no number",
            "give the way-point a height",
        ));
    }
    let same = |mode| WpmlHeights {
        drawn_mode: Some(mode),
        drawn: metres.clone(),
        flown_mode: mode,
        flown: metres.clone(),
    };
    Ok(match frame {
        AltitudeFrame::AboveTakeOff => same("relativeToStartPoint"),
        AltitudeFrame::AboveGround => same("realTimeFollowSurface"),
        AltitudeFrame::Amsl => {
            let undulations = undulations(way_points).ok_or_else(|| {
                cannot_hold(
                    "altitudes above mean sea level: its aircraft fly heights above the ellipsoid, and where \
                     the geoid lies is not known",
                    "let the altitudes count from take-off",
                )
            })?;
            let is_known = undulations.iter().all(Option::is_some);
            let flown = metres.iter().zip(&undulations);
            WpmlHeights {
                drawn_mode: is_known.then_some("EGM96"),
                flown: flown.map(|(m, n)| m + n.unwrap_or(0.0)).collect(),
                flown_mode: "WGS84",
                drawn: metres,
            }
        }
    })
}

/// Undulations that a file stated, of way-points that are new those of their neighbours; an inner `None`
/// where altitudes are above the ellipsoid. `None` if no way-point has one.
fn undulations(way_points: &[WayPoint]) -> Option<Vec<Option<f64>>> {
    let own = |w: &WayPoint| -> Option<Option<f64>> {
        serde_json::from_str(w.properties.get(UNDULATION)?).ok()
    };
    let mut last = way_points.iter().find_map(own)?;
    Some(
        way_points
            .iter()
            .map(|w| {
                last = own(w).unwrap_or(last);
                last
            })
            .collect(),
    )
}
