//! No-fly areas that the selected route leads over or near, found anew when route, areas or prediction change.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{Mission, NoFlyZone};
use pilotage_core::plan::{FlownWay, Incursion, ReachedZone, reached_zones};

use super::forecast::Forecast;

/// Legs over no-fly areas, and stretches on which the corridor reaches into them.
#[derive(Debug, Default)]
pub struct IncursionCheck {
    /// Areas that were looked at.
    zones: Vec<NoFlyZone>,
    places: Vec<GroundPoint>,
    prediction: u64,
    /// Legs of the route over areas.
    pub legs: Vec<Incursion>,
    /// Stretches of the predicted path.
    pub reached: Vec<ReachedZone>,
    /// Route and areas about which people were told before an export.
    told: Option<(Vec<GroundPoint>, Vec<NoFlyZone>)>,
}

impl IncursionCheck {
    /// Looks at the way along the route anew, if anything changed.
    pub fn keep_to(&mut self, mission: &Mission, way: FlownWay, forecast: &Forecast) {
        let is_same = self.zones == mission.no_fly
            && self.prediction == forecast.number()
            && way.places == self.places;
        if is_same {
            return;
        }
        self.zones.clone_from(&mission.no_fly);
        self.prediction = forecast.number();
        self.legs = way.incursions(&self.zones);
        self.places = way.places;
        let samples = forecast.shown().map_or(&[][..], |s| &s.prediction.samples);
        self.reached = reached_zones(samples, &self.zones);
    }

    /// Whether people were told of this route and these areas. What the corridor reaches changes with every prediction,
    /// of which nobody is to be asked anew.
    pub fn was_told(&self) -> bool {
        let told = self.told.as_ref();
        told.is_some_and(|(places, zones)| *places == self.places && *zones == self.zones)
    }

    /// Notes that people were told.
    pub fn tell(&mut self) {
        self.told = Some((self.places.clone(), self.zones.clone()));
    }

    /// Name of an area that was looked at.
    pub fn name(&self, zone: usize) -> &str {
        &self.zones[zone].name
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::documents::empty_mission;
    use pilotage_core::frames::{Geodetic, LocalFrame};
    use pilotage_core::mission::{Route, USUAL_ALTITUDE, WayPoint};
    use pilotage_core::plan::RouteGround;

    fn way_of(route: &Route) -> FlownWay {
        let ground = RouteGround {
            height_at: &|_| 0.0,
            take_off: 0.0,
            is_level: true,
        };
        let frame = LocalFrame::new(Geodetic::from_degrees(46.0, -92.0, 0.0));
        FlownWay::along(route, &frame, &ground, 0.5)
    }

    #[test]
    fn a_route_is_looked_at_again_when_it_or_an_area_changes() {
        let mut mission = empty_mission();
        let at = |north, east| GroundPoint::new(north, east);
        let way = [at(50.0, -50.0), at(50.0, 150.0)];
        let mut route = Route {
            way_points: way.map(|p| WayPoint::new(p, USUAL_ALTITUDE)).to_vec(),
            ..Route::default()
        };
        let mut check = IncursionCheck::default();
        let forecast = Forecast::default();
        check.keep_to(&mission, way_of(&route), &forecast);
        assert!(check.legs.is_empty());
        mission.no_fly.push(NoFlyZone {
            name: "Village".to_owned(),
            corners: vec![
                at(0.0, 0.0),
                at(0.0, 100.0),
                at(100.0, 100.0),
                at(100.0, 0.0),
            ],
            ..NoFlyZone::default()
        });
        check.keep_to(&mission, way_of(&route), &forecast);
        assert_eq!(
            (check.legs.len(), check.name(check.legs[0].zone)),
            (1, "Village")
        );
        assert!(!check.was_told());
        check.tell();
        check.prediction += 1; // as if another prediction had come
        check.keep_to(&mission, way_of(&route), &forecast);
        assert!(check.was_told(), "one is told once of a route");
        route.way_points[1].position.east = -10.0;
        check.keep_to(&mission, way_of(&route), &forecast);
        assert!(check.legs.is_empty());
    }
}
