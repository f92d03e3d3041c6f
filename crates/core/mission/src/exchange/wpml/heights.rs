//! Heights of a route as both files state them.

use super::super::ExchangeError;
use super::super::air_altitudes::altitudes_in_the_air;
use super::name::NAME;
use super::{EXECUTED, UNDULATION};
use crate::mission::{Route, WayPoint, globe};
use pilotage_base::frames::{AltitudeFrame, LocalFrame};

/// Farthest from its place that a way-point counts as left there, metres.
const UNMOVED: f64 = 0.01;
/// Note on heights above the ground that the file does not give above the ellipsoid.
const FOLLOWED: &str = "the heights are above the ground, which of DJI's aircraft only the Mavic 3 Enterprise series follows in \
     flight";

/// Heights in metres, and the modes, in the words of both files, that say from where they count.
pub(super) struct WpmlHeights {
    /// `None` where the template cannot state them.
    pub drawn_mode: Option<&'static str>,
    pub drawn: Vec<f64>,
    pub flown_mode: &'static str,
    pub flown: Vec<f64>,
    /// Note on what flies them.
    pub note: Option<&'static str>,
}

/// The heights of a route, which in a file of DJI all count from the same.
pub(super) fn heights(route: &Route, frame: &LocalFrame) -> Result<WpmlHeights, ExchangeError> {
    let cannot_hold = |what: &str, advice| ExchangeError::CannotHold {
        format: NAME,
        what: what.to_owned(),
        advice,
    };
    let way_points = &route.way_points;
    // It lands by itself: nothing is flown to on the ground.
    let altitudes = altitudes_in_the_air(route);
    let Some(first) = altitudes.first() else {
        return Err(cannot_hold("a route without way-points", "draw it first"));
    };
    if altitudes.iter().any(|a| a.frame != first.frame) {
        return Err(cannot_hold(
            "heights of several kinds in one mission",
            "let all of them count from take-off, or all from the ground",
        ));
    }
    let metres: Vec<f64> = altitudes.iter().map(|a| a.metres).collect();
    if metres.iter().any(|m| !m.is_finite()) {
        return Err(cannot_hold(
            "a height that is no number",
            "give the way-point a height",
        ));
    }
    Ok(match first.frame {
        AltitudeFrame::AboveTakeOff => WpmlHeights {
            drawn_mode: Some("relativeToStartPoint"),
            drawn: metres.clone(),
            flown_mode: "relativeToStartPoint",
            flown: metres,
            note: None,
        },
        AltitudeFrame::AboveGround => {
            let both = way_points.iter().zip(&metres);
            let executed: Option<Vec<f64>> = both
                .map(|(w, metres)| executed(w, *metres, frame))
                .collect();
            WpmlHeights {
                // Following the ground is no mode of templates of way-points.
                drawn_mode: Some("aboveGroundLevel"),
                note: executed.is_none().then_some(FOLLOWED),
                flown_mode: match executed {
                    Some(_) => "WGS84",
                    None => "realTimeFollowSurface",
                },
                flown: executed.unwrap_or_else(|| metres.clone()),
                drawn: metres,
            }
        }
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
                note: None,
            }
        }
    })
}

/// Height above the ellipsoid at which a file flew a way-point that has the same place and height above ground still.
fn executed(way_point: &WayPoint, metres: f64, frame: &LocalFrame) -> Option<f64> {
    let kept = way_point.properties.get(EXECUTED)?;
    let [height, latitude, longitude, above_ground]: [f64; 4] = serde_json::from_str(kept).ok()?;
    let place = globe::ground(frame, longitude, latitude);
    let is_same =
        place.distance(&way_point.position) < UNMOVED && above_ground.total_cmp(&metres).is_eq();
    is_same.then_some(height)
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
