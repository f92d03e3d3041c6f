//! Tiles of the web that a job needs.
//!
//! The page fetches (and its browser keeps) tiles; a worker gets them before the job that reads them.

use pilotage_core::frames::GroundRect;

use super::order::Reads;
use super::{Job, MapSource, WebMap};

/// Most tiles that are fetched for one job.
const MOST_PER_JOB: usize = 512;
impl WebMap {
    /// Addresses of the deepest tiles over areas that are not too many: of wide ones coarser tiles.
    fn finest_over(&self, areas: &[GroundRect]) -> Vec<String> {
        let count = |zoom| {
            let counts = areas.iter().map(|area| self.count_over(area, (zoom, zoom)));
            counts.sum::<u64>()
        };
        let (least, most) = self.zooms();
        let deepest = (least..=most)
            .rev()
            .find(|z| count(*z) <= MOST_PER_JOB as u64);
        let zoom = deepest.unwrap_or(least);
        let of = |area| self.addresses_over(area, (zoom, zoom));
        areas.iter().flat_map(of).collect()
    }
}

/// Addresses of the tiles of web maps that a job needs; none for other maps.
pub fn wanted_addresses(job: &Job) -> Vec<String> {
    let Some((MapSource::Web(map), reads)) = job.reads() else {
        return Vec::new();
    };
    let mut all = match reads {
        Reads::Windows(windows) => windows.iter().flat_map(|w| map.of_window(w)).collect(),
        Reads::Areas(areas) => map.finest_over(&areas),
    };
    all.sort_unstable();
    all.dedup();
    all.truncate(MOST_PER_JOB);
    all
}

#[cfg(test)]
mod tests {
    use pilotage_core::camera::CameraModel;
    use pilotage_core::frames::{Geodetic, GroundPoint};
    use pilotage_core::imagery::Imagery as _;
    use pilotage_core::imagery::web_tiles::TileTemplate;
    use pilotage_core::plan::FieldView;
    use pilotage_core::raster::{Picture, encode_png};

    use super::*;
    use crate::fetched_tiles::FetchedTiles;
    use crate::{
        BriefOrder, FieldFrom, FieldOrder, PlannedPath, PredictionOrder, RouteWishes, TileOrder,
    };
    use pilotage_core::imagery::Window;
    use pilotage_core::mission::Mission;

    fn map() -> WebMap {
        WebMap {
            template: TileTemplate {
                name: "Tiles".to_owned(),
                address: "http://127.0.0.1/{z}/{x}/{y}.png".to_owned(),
                attribution: "© whoever".to_owned(),
                least_zoom: 10,
                most_zoom: 17,
                side: 256,
            },
            origin: Geodetic::from_degrees(46.857, -92.076, 0.0),
        }
    }

    #[test]
    fn a_window_is_whole_once_the_tiles_that_its_job_wants_are_there() {
        let map = map();
        let window = Window::covering(
            &GroundRect::centered(GroundPoint::default(), 300.0, 400.0),
            1.0,
        );
        let job = Job::Tile(TileOrder {
            map: MapSource::Web(map.clone()),
            window,
        });
        let wanted = wanted_addresses(&job);
        assert!((4..30).contains(&wanted.len()), "{wanted:?}");
        assert!(wanted.iter().all(|a| a.starts_with("http://127.0.0.1/17/")));
        let fetched = FetchedTiles::default();
        let open = map.open(&fetched);
        assert!(open.window(&window).pixels().iter().all(|p| p[3] == 0));
        assert!(!open.window_so_far(&window).1);
        let tile = encode_png(&Picture::filled(256, 256, [10, 200, 30])).unwrap();
        for address in &wanted {
            fetched.keep(address, tile.clone().into());
        }
        assert!(
            open.window(&window)
                .pixels()
                .iter()
                .all(|p| *p == [10, 200, 30, 255])
        );
        assert!(open.window_so_far(&window).1);
        // Tiles that the server has not are not waited for.
        let without = FetchedTiles::default();
        for address in &wanted {
            without.keep(address, Vec::new().into());
        }
        let (nothing, is_whole) = map.open(&without).window_so_far(&window);
        assert!(is_whole && nothing.pixels().iter().all(|p| p[3] == 0));
    }

    #[test]
    fn a_route_over_what_the_map_offers_gets_the_files_or_the_tiles_of_that_map() {
        let order = |map: MapSource, from| {
            let camera = CameraModel::pinhole(640, 480, 0.8);
            let ends = (GroundPoint::default(), GroundPoint::new(900.0, 0.0));
            let mission = Mission::new("Any", Geodetic::from_degrees(46.857, -92.076, 0.0));
            let path = PlannedPath::level(vec![ends.0, ends.1], 100.0, camera.clone());
            let field = FieldOrder {
                map,
                region: GroundRect::centered(GroundPoint::default(), 4000.0, 4000.0),
                view: FieldView {
                    camera,
                    height: 100.0,
                    position: 10.0,
                    tilt: 0.0,
                },
                from,
            };
            let flight = PredictionOrder::along(path, &mission);
            let order = RouteWishes::default().order(ends, field, flight, Vec::new(), None);
            Job::Find(Box::new(order.unwrap()))
        };
        let of_map = || FieldFrom::Map {
            search_sigmas: 3.0,
            days: FieldFrom::FEW_DAYS,
        };
        let of_files = order(MapSource::Files("drop".to_owned()), of_map());
        assert_eq!(of_files.files(), ["drop"]);
        // Both ends and the ground around them: a square kilometre has tens of tiles 209 m wide (zoom 17 at 47° north).
        let wanted = wanted_addresses(&order(MapSource::Web(map()), of_map()));
        assert!(wanted.len() > 20, "{wanted:?}");
        let of_landmarks = FieldFrom::Landmarks(Vec::new());
        assert!(wanted_addresses(&order(MapSource::Web(map()), of_landmarks)).is_empty());
    }

    #[test]
    fn the_brief_and_the_field_of_the_map_get_their_tiles_and_a_wide_area_coarser_ones() {
        let source = MapSource::Web(map());
        let area = |side| GroundRect::centered(GroundPoint::default(), side, side);
        let brief = Job::Brief(BriefOrder {
            map: source.clone(),
            area: area(2000.0),
            boxes: vec![area(20.0)],
        });
        let zooms = |job: &Job| {
            let all = wanted_addresses(job);
            assert!(
                !all.is_empty() && all.len() <= MOST_PER_JOB,
                "{}",
                all.len()
            );
            let zoom = |a: &String| a.split('/').nth(3).map(str::to_owned);
            all.iter()
                .filter_map(zoom)
                .collect::<std::collections::BTreeSet<_>>()
        };
        assert!(zooms(&brief).contains("17"));
        let field = |from, side| {
            Job::Field(Box::new(FieldOrder {
                map: source.clone(),
                region: area(side),
                view: FieldView {
                    camera: CameraModel::pinhole(640, 480, 0.8),
                    height: 100.0,
                    position: 10.0,
                    tilt: 0.0,
                },
                from,
            }))
        };
        let of_map = || FieldFrom::Map {
            search_sigmas: 3.0,
            days: FieldFrom::FEW_DAYS,
        };
        assert_eq!(zooms(&field(of_map(), 2000.0)), ["17".to_owned()].into());
        assert_eq!(zooms(&field(of_map(), 20_000.0)), ["14".to_owned()].into());
        let of_landmarks = field(FieldFrom::Landmarks(Vec::new()), 2000.0);
        assert!(wanted_addresses(&of_landmarks).is_empty());
    }

    #[test]
    fn an_area_has_four_times_the_tiles_at_every_deeper_zoom() {
        let map = map();
        let area = GroundRect::centered(GroundPoint::default(), 3000.0, 3000.0);
        let all = map.addresses_over(&area, (12, 17));
        assert_eq!(all.len() as u64, map.count_over(&area, (12, 17)));
        let deep = map.count_over(&area, (17, 17)) as f64 / map.count_over(&area, (16, 16)) as f64;
        assert!((2.5..4.5).contains(&deep), "{deep}");
        assert!(all[0].contains("/12/") && all[all.len() - 1].contains("/17/"));
    }
}
