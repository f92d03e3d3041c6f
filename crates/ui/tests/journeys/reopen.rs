use egui::Vec2;
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect};
use pilotage_jobs::{
    FlightSource, FlyOrder, Job, MapInfo, MapSource, OpenedFiles, ProvideOrder, TileOrder,
};
use pilotage_ui::documents::{SESSION_KEY, Session, UNREAD_KEY};
use pilotage_ui::host::OpenedFile;

use super::plan::draw;
use super::support::flight::flight;
use super::support::{Rig, ScriptedHost, rig, rig_on};

/// Files of a flight.
pub fn files(bytes: usize) -> Vec<OpenedFile> {
    let file = |path: &str| OpenedFile {
        path: path.into(),
        content: vec![7; bytes].into(),
    };
    vec![file("trip/flight.json"), file("trip/wind.csv")]
}

/// The app after files with a flight in them were dropped on it.
fn rig_with_a_flight(bytes: usize) -> Rig {
    let mut rig = rig();
    rig.host().opens = Some(OpenedFiles {
        flight: Some(flight()),
        ..nothing()
    });
    rig.host().opened.push(files(bytes));
    rig.frames(6);
    rig.settle();
    rig
}

/// Files in which nothing was found.
pub fn nothing() -> OpenedFiles {
    OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: None,
        unplaced: None,
        photos: Vec::new(),
        mission: None,
        run: None,
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    }
}

/// The app after a map was opened over which a mission is planned.
fn rig_with_a_map() -> Rig {
    let mut rig = rig();
    rig.open_tab("Plan");
    rig.host().opens = Some(OpenedFiles {
        map: Some(MapInfo {
            name: "area.png".into(),
            bounds: GroundRect::centered(GroundPoint::default(), 2000.0, 2000.0),
            native_gsd: 0.5,
            is_coarse_cheap: true,
            origin: Some(Geodetic::from_degrees(46.857, -92.076, 0.0)),
            attribution: None,
        }),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "area.png".into(),
        content: vec![7; 100].into(),
    }]);
    rig.frames(6);
    rig.settle();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig
}

/// The mission that is stored for the next visit.
fn stored_routes(rig: &mut Rig) -> usize {
    let bytes = rig.host().stored.get(SESSION_KEY).cloned();
    let session = bytes.and_then(|bytes| Session::decode(&bytes));
    let mission = session.and_then(|session| session.mission);
    mission.map_or(0, |mission| mission.routes.len())
}

fn first_toast(rig: &Rig) -> String {
    rig.state()["toasts"][0].to_string()
}

fn reloaded(rig: &mut Rig) -> Rig {
    let stored = rig.host().stored.clone();
    let host = ScriptedHost {
        stored,
        ..ScriptedHost::default()
    };
    rig_on(host, Vec2::new(1440.0, 900.0))
}

fn flies_files(rig: &mut Rig) -> bool {
    let last = rig.host().last_flight().cloned();
    matches!(
        last,
        Some((
            _,
            Job::Fly(FlyOrder {
                flight: FlightSource::Files(_),
                ..
            })
        ))
    )
}

#[test]
fn an_opened_flight_is_there_again_after_a_reload() {
    let mut rig = rig_with_a_flight(100);
    assert!(flies_files(&mut rig));
    let mut again = reloaded(&mut rig);
    assert!(flies_files(&mut again));
    let provided = again.host().jobs.iter().find_map(|(_, job)| match job {
        Job::Provide(ProvideOrder { files, .. }) => Some(files.clone()),
        _ => None,
    });
    let wanted: Vec<_> = files(100)
        .into_iter()
        .map(|f| (f.path, f.content))
        .collect();
    assert_eq!(provided, Some(wanted));
}

#[test]
fn a_flight_of_which_a_file_is_missing_gives_way_to_the_demo_with_a_word() {
    let mut rig = rig_with_a_flight(100);
    rig.host()
        .stored
        .retain(|key, _| !key.starts_with("file 1"));
    let mut again = reloaded(&mut rig);
    assert!(!flies_files(&mut again));
    let told = first_toast(&again);
    assert!(
        told.contains("last visit") && told.contains("the flight"),
        "{told}"
    );
}

#[test]
fn a_mission_stays_when_its_map_was_not_kept_and_survives_the_next_save() {
    let mut rig = rig_with_a_map();
    assert_eq!(stored_routes(&mut rig), 1);
    rig.host().stored.retain(|key, _| !key.starts_with("file "));
    let mut again = reloaded(&mut rig);
    let told = first_toast(&again);
    assert!(
        told.contains("the map") && told.contains("Your mission is here"),
        "{told}"
    );
    assert_eq!(
        again.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(1)
    );
    // The next edit stores the session anew.
    draw(&mut again, &[(60.0, -200.0), (60.0, 200.0)]);
    assert_eq!(stored_routes(&mut again), 2);
    // The map opens again over the plan, under a key of its own.
    again.host().opens = rig.host().opens.clone();
    again.host().opened.push(vec![OpenedFile {
        path: "area.png".into(),
        content: vec![7; 100].into(),
    }]);
    again.frames(6);
    again.settle();
    let shown = again
        .host()
        .jobs
        .iter()
        .rev()
        .find_map(|(_, job)| match job {
            Job::Tile(TileOrder { map, .. }) => Some(map.clone()),
            _ => None,
        });
    let key = shown.as_ref().and_then(MapSource::key).map(str::to_owned);
    assert_eq!(key.as_deref(), Some("opened-2"));
    assert_eq!(stored_routes(&mut again), 2);
}

#[test]
fn an_elevation_model_that_was_not_kept_goes_alone() {
    let mut rig = rig_with_a_map();
    let terrain = pilotage_ui::documents::TERRAIN_KEY;
    rig.host()
        .stored
        .insert(terrain.into(), b"opened-9".to_vec());
    let again = reloaded(&mut rig);
    let told = first_toast(&again);
    assert!(
        told.contains("the elevation model.") && !told.contains("the map"),
        "{told}"
    );
    assert_eq!(
        again.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(1)
    );
}

#[test]
fn what_was_told_of_one_file_does_not_stand_over_the_next() {
    let mut rig = rig_with_a_map();
    for (name, before) in [("second.png", "area.png"), ("third.png", "second.png")] {
        rig.host().opened.push(vec![OpenedFile {
            path: name.into(),
            content: vec![7; 100].into(),
        }]);
        rig.frames(6);
        let told = rig.state()["toasts"].to_string();
        assert!(told.contains(name) && !told.contains(before), "{told}");
    }
}

#[test]
fn opened_files_that_were_refused_are_named_and_stored_again() {
    let mut rig = rig_with_a_map();
    let key = "file 0 of opened-1".to_owned();
    rig.host().stored.remove(&key);
    rig.host().refused = vec![key.clone()];
    rig.frames(2);
    assert!(
        first_toast(&rig).contains("no room for area.png"),
        "{}",
        first_toast(&rig)
    );
    assert!(!rig.host().stored.contains_key(&key));
    for _ in 0..4 {
        rig.settle();
    }
    assert!(rig.host().stored.contains_key(&key));
}

#[test]
fn files_that_are_too_many_are_not_kept_and_the_user_is_told() {
    let mut rig = rig_with_a_flight(40 << 20);
    assert!(!rig.host().stored.keys().any(|key| key.starts_with("file")));
    let told = rig.state()["toasts"].to_string();
    assert!(told.contains("64 MB"), "{told}");
}

#[test]
fn an_edit_is_stored_at_once_when_the_page_is_left_while_files_are_still_being_kept() {
    let mut rig = rig();
    rig.host().opens = Some(OpenedFiles {
        flight: Some(flight()),
        ..nothing()
    });
    let file = |number| OpenedFile {
        path: format!("trip/{number}.csv"),
        content: vec![7; 1 << 20].into(),
    };
    rig.host().opened.push((0..60).map(file).collect());
    rig.frames(3);
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.frames(2);
    let is_whole = |rig: &mut Rig| rig.host().stored.keys().any(|key| key.starts_with("files"));
    let egui = rig.harness.ctx.clone();
    assert!(!is_whole(&mut rig), "the files are still being kept");
    let page = rig.harness.state_mut();
    let app = page.app.as_mut().expect("drawn once");
    app.store_now(&egui, &mut page.host);
    let bytes = rig.host().stored.get(SESSION_KEY).cloned();
    let session = bytes.and_then(|bytes| Session::decode(&bytes));
    let mission = session.and_then(|session| session.mission);
    let chapel = mission.map(|it| it.landmarks[1].enabled);
    assert_eq!(chapel, Some(false));
}

#[test]
fn files_of_a_flight_that_was_replaced_are_thrown_away() {
    let mut rig = rig_with_a_flight(100);
    assert!(rig.host().stored.keys().any(|key| key.starts_with("file")));
    rig.harness.state_mut().host.opens = None;
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
    rig.harness.event(egui::Event::Text("built-in demo".into()));
    rig.key(egui::Key::Enter);
    rig.settle();
    rig.settle();
    assert!(!rig.host().stored.keys().any(|key| key.starts_with("file")));
}

#[test]
fn an_opened_flight_lies_within_the_map() {
    let rig = rig_with_a_flight(100);
    let state = rig.state();
    assert_eq!(state["map"]["follow"], false);
    let rect = rig.rect("/map/rect");
    let scale = state["map"]["metres_per_point"].as_f64().expect("a scale");
    let east = state["map"]["center"][1].as_f64().expect("a centre");
    // The flight goes from 400 m west to 560 m east.
    let half = 0.5 * f64::from(rect.width()) * scale;
    assert!(
        east - half < -400.0 && east + half > 560.0,
        "{east} ± {half}"
    );
}

#[test]
fn a_document_of_a_later_version_is_kept_aside_and_taken_once_it_can_be_read() {
    let mut rig = rig_with_a_map();
    let mut later = rig.host().stored[SESSION_KEY].clone();
    let own = later.clone();
    later[0] = 9;
    rig.host().stored.insert(SESSION_KEY.into(), later.clone());
    let mut again = reloaded(&mut rig);
    let told = first_toast(&again);
    assert!(
        told.contains("cannot be read") && told.contains("kept aside"),
        "{told}"
    );
    assert_eq!(again.host().stored.get(UNREAD_KEY), Some(&later));
    // An update brings what reads it.
    again.host().stored.insert(UNREAD_KEY.into(), own);
    again.host().stored.remove(SESSION_KEY);
    let mut updated = reloaded(&mut again);
    updated.settle();
    assert_eq!(
        updated.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(1)
    );
    assert!(!updated.host().stored.contains_key(UNREAD_KEY));
    assert_eq!(stored_routes(&mut updated), 1);
}
