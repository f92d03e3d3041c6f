//! Photos brought to the map that is open: which ones, over which ground.

use pilotage_core::flight::Flight;
use pilotage_core::flight::log::LogFormat;
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_jobs::{FlightSource, Job, MapInfo, MapSource};

use super::feature::PhotosFeature;
use super::state::Sought;
use crate::documents::{Documents, with_origin};
use crate::feature::{Feature as _, FeatureContext};
use crate::map::MapView;

/// Longest side of the ground all over which photos without a place are searched, metres; of larger maps it is what is
/// shown of them.
const LARGEST_SEARCHED: f64 = 1_500.0;
/// Largest distance from the map at which a flight of photos that is laid on it may begin, metres.
const BESIDE: f64 = 100.0;

impl PhotosFeature {
    /// The photos of the flight that is open, if nothing else is to be laid and it is one of photos.
    pub(super) fn seek_photos_of_flight(&mut self, context: &FeatureContext<'_>) {
        let documents = &*context.documents;
        let format = documents.flight.log.as_ref().and_then(|log| log.format);
        let is_of_photos = format == Some(LogFormat::Photos);
        let (FlightSource::Files(key), Some(flight)) =
            (&documents.flight.source, &documents.flight.measured)
        else {
            return;
        };
        if !is_of_photos || self.state.sought.is_some() {
            return;
        }
        let names = flight.frames.iter().map(|frame| frame.name.clone());
        if let Some(ground) = ground_searched(documents, context.map) {
            self.state.seek(Sought {
                key: key.clone(),
                names: names.collect(),
                map: documents.map.source.clone(),
                origin: documents.world_origin(),
                ground,
            });
        }
    }

    /// Has the photos sought on the map that is open now: another one may have been opened since.
    pub(super) fn seek_on_open_map(&mut self, context: &FeatureContext<'_>) {
        let documents = &*context.documents;
        let ground = ground_searched(documents, context.map);
        if let (Some(ground), Some(sought)) = (ground, &mut self.state.sought) {
            sought.map = documents.map.source.clone();
            sought.origin = documents.world_origin();
            sought.ground = ground;
        }
    }

    /// Lays the photos that were opened before there was a map of the ground, once there is one.
    pub(super) fn lay_awaiting(&mut self, context: &mut FeatureContext<'_>) {
        let has_map = || ground_searched(context.documents, context.map).is_some();
        if self.awaiting.is_some()
            && has_map()
            && let Some((key, names)) = self.awaiting.take()
        {
            self.lay_opened(key, names, context);
        }
    }

    /// Photos were opened over the map that is open: they are laid on it, or on the one that is opened next.
    pub(super) fn lay_opened(
        &mut self,
        key: String,
        names: Vec<String>,
        context: &mut FeatureContext<'_>,
    ) {
        let documents = &*context.documents;
        let ground = ground_searched(documents, context.map);
        let (Some(ground), Some(origin)) = (ground, documents.world_origin()) else {
            let title = "There is no map to lay the pictures on";
            let text = words_without_map(&names);
            context.trouble(title, text);
            self.awaiting = Some((key, names));
            return;
        };
        self.awaiting = None;
        let sought = Sought {
            key,
            names,
            map: documents.map.source.clone(),
            origin: Some(origin),
            ground,
        };
        self.show_and_lay(sought, context);
    }

    /// A flight of photos was opened: they are laid on the map that came with it, else on the open one, if that shows
    /// where they begin. What is known of a map that came with it is `info`, in the world of the flight.
    pub(super) fn lay_flight(
        &mut self,
        key: String,
        names: Vec<String>,
        flight: &Flight,
        info: Option<&MapInfo>,
        context: &mut FeatureContext<'_>,
    ) {
        let documents = &*context.documents;
        let map = match info {
            Some(_) => MapSource::Files(key.clone()),
            None => documents.map_under(flight.frame_on_globe),
        };
        let Some(world) = flight.frame_on_globe.filter(|_| map != MapSource::Nothing) else {
            return;
        };
        let (bounds, of_map) = match (info, &documents.map.info) {
            (Some(info), _) => (info.bounds, Some(world)),
            (None, Some(open)) => {
                let origin = documents.map.source.origin().or(open.origin);
                (open.bounds, origin.map(LocalFrame::new))
            }
            (None, None) => return,
        };
        let Some(of_map) = of_map else { return };
        let moved = |place: GroundPoint, from: &LocalFrame, to: &LocalFrame| {
            to.ground_from_geodetic(&from.geodetic_from_ground(&place))
        };
        let start = moved(flight.start.position, &world, &of_map);
        if !bounds.grown(BESIDE).contains(&start) {
            return;
        }
        let corners = [
            GroundPoint::new(bounds.south, bounds.west),
            GroundPoint::new(bounds.north, bounds.east),
        ];
        let ground = GroundRect::around(corners.map(|corner| moved(corner, &of_map, &world)));
        let Some(ground) = ground else { return };
        let sought = Sought {
            key,
            names,
            map: with_origin(map, Some(world)),
            origin: Some(world.origin),
            ground,
        };
        self.show_and_lay(sought, context);
    }

    fn show_and_lay(&mut self, sought: Sought, context: &mut FeatureContext<'_>) {
        self.stop(context);
        self.state.seek(sought);
        context.show();
        context.playback.playing = false;
        self.lay(context);
    }

    /// Lays all of them anew; of what came of them before, nothing is shown any more.
    pub(super) fn lay(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        self.stop_draping(context);
        if let Some(order) = self.state.begin() {
            self.laying = Some(context.start(Job::LayPhotos(Box::new(order))));
        }
    }
}

/// Ground over which photos of which no place is known are searched, if a map of photographed ground is open.
fn ground_searched(documents: &Documents, map: &MapView) -> Option<GroundRect> {
    let bounds = documents
        .map
        .info
        .as_ref()
        .filter(|_| documents.map.is_real())?
        .bounds;
    if bounds.width().max(bounds.height()) <= LARGEST_SEARCHED {
        return Some(bounds);
    }
    let (rect, view) = (map.rect()?, map.screen_from_world()?);
    let seen = view.visible(rect);
    let middle = seen.center();
    let largest = GroundRect::centered(middle, LARGEST_SEARCHED, LARGEST_SEARCHED);
    let part = largest.intersection(&seen)?.intersection(&bounds)?;
    (part.north > part.south && part.east > part.west).then_some(part)
}

/// Sentences for pictures that wait for a map.
fn words_without_map(names: &[String]) -> String {
    match names {
        [first, _, rest @ ..] => format!(
            "{first} and {} more wait for it: open a georeferenced map of their ground.",
            rest.len() + 1
        ),
        _ => format!(
            "{} does not say where it lies. Open a georeferenced map of its ground, and it is laid there; if it is such a \
             map itself, drop it together with its world file (.jgw, .pgw, .wld) or a georeference in JSON.",
            names.concat()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_wait_for_a_map_are_all_counted() {
        let words = |count: usize| {
            let names: Vec<String> = (0..count).map(|i| format!("{i}.jpg")).collect();
            words_without_map(&names)
        };
        assert!(words(1).starts_with("0.jpg does not say"));
        assert!(words(2).starts_with("0.jpg and 1 more wait"));
        assert!(words(75).starts_with("0.jpg and 74 more wait"));
    }
}
