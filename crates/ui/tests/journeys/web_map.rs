use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::raster::Raster;
use pilotage_jobs::{DescribeMapOrder, FileContent, Job, JobEvent, MapSource, ProvideOrder};

use pilotage_ui::host::Download;

use super::support::{Ahead, Rig, rig};

fn is_open(rig: &Rig) -> bool {
    rig.state()["web_map"]["open"] == true
}

fn type_into(rig: &mut Rig, field: &str, text: &str) {
    rig.harness.get_by_label(field).focus();
    rig.frames(2);
    rig.harness.event(Event::Text(text.to_owned()));
    rig.frames(2);
}

/// Opens the map at an address by the dialog.
fn open(rig: &mut Rig, address: &str) {
    rig.frames(8);
    rig.menu("Open", "Map from the web: tiles, GeoTIFF, PMTiles…");
    rig.frames(6);
    type_into(rig, "Address", address);
    if rig.harness.query_by_label("Attribution").is_some() {
        type_into(rig, "Attribution", "© someone");
    }
    rig.harness.get_by_label("Open the map").click();
    rig.frames(6);
}

#[test]
fn the_dialog_of_web_maps_opens_by_its_key_and_escape_closes_it_before_anything_else() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    let at = |share: f32| track.left_center() + egui::vec2(share * track.width(), 0.0);
    rig.drag_with(Modifiers::SHIFT, at(0.3), at(0.6));
    rig.key_with(Modifiers::SHIFT, Key::M);
    assert!(is_open(&rig));
    let selected = rig.state()["selected"].clone();
    assert!(selected.is_array(), "a span is selected");
    rig.key(Key::Escape);
    assert!(!is_open(&rig));
    assert_eq!(rig.state()["selected"], selected);
    rig.key(Key::Escape);
    assert!(rig.state()["selected"].is_null());
}

#[test]
fn tiles_of_the_web_become_the_map() {
    let mut rig = rig();
    open(&mut rig, "https://example.org/{z}/{x}/{y}.png");
    assert!(!is_open(&rig));
    let is_of_web = |(_, job): &(_, Job)| {
        matches!(job, Job::DescribeMap(DescribeMapOrder(MapSource::Web(map)))
            if map.template.attribution == "© someone")
    };
    assert!(rig.host().jobs.iter().any(is_of_web));
}

#[test]
fn tiles_of_the_web_that_did_not_come_are_asked_for_again_after_a_while() {
    let mut rig = rig();
    rig.host().left =
        Some(|job| matches!(job, Job::Tile(order) if matches!(order.map, MapSource::Web(_))));
    open(&mut rig, "https://example.org/{z}/{x}/{y}.png");
    rig.frames(4);
    let asked = |rig: &mut Rig| -> Vec<_> {
        let windows = rig.host().jobs.iter().filter_map(|(id, job)| match job {
            Job::Tile(order) if matches!(order.map, MapSource::Web(_)) => Some((*id, order.window)),
            _ => None,
        });
        windows.collect()
    };
    let mut answered = 0;
    while answered < asked(&mut rig).len() {
        for (id, window) in asked(&mut rig).split_off(answered) {
            let pixels = Raster::filled(window.width, window.height, [0; 4]);
            let tile = JobEvent::Tile {
                window,
                pixels,
                whole: false,
            };
            (rig.host().events).extend([(id, tile), (id, JobEvent::Finished)]);
            answered += 1;
        }
        rig.frames(4);
    }
    let window = asked(&mut rig)[0].1;
    let times = |rig: &mut Rig| asked(rig).iter().filter(|it| it.1 == window).count();
    // At once it is in vain, and no work is begun that would make anything of it ready.
    assert!(times(&mut rig) <= 2);
    let is_of_web = |(_, job): &(_, Job)| matches!(job, Job::PrepareMap(order) if matches!(order.0, MapSource::Web(_)));
    assert!(!rig.host().jobs.iter().any(is_of_web));
    let before = times(&mut rig);
    rig.host().now += 10_000.0;
    rig.frames(6);
    assert_eq!(times(&mut rig), before + 1);
}

#[test]
fn a_file_at_an_address_is_opened_as_if_it_were_chosen() {
    let mut rig = rig();
    open(&mut rig, "https://example.org/maps/area.tif?key=1");
    let is_given = |(_, job): &(_, Job)| {
        let Job::Provide(ProvideOrder { files, .. }) = job else {
            return false;
        };
        let [(path, FileContent::Address(address))] = files.as_slice() else {
            return false;
        };
        path == "https://example.org/maps/area.tif" && address.ends_with("?key=1")
    };
    let jobs = &rig.host().jobs;
    assert!(jobs.iter().any(is_given));
    assert!(jobs.iter().any(|(_, job)| matches!(job, Job::Open(_))));
}

/// Opens the dialog, and chooses a public service by the beginning of its row.
fn choose(rig: &mut Rig, row: &str) {
    if !is_open(rig) {
        rig.key_with(Modifiers::SHIFT, Key::M);
        rig.frames(4);
    }
    rig.harness.get_by_label_contains(row).click();
    rig.frames(4);
}

#[test]
fn no_service_is_asked_for_anything_before_its_map_is_opened() {
    let mut rig = rig();
    rig.settle();
    let jobs = rig.host().jobs.len();
    for row in [
        "USGS imagery: ",
        "USGS topo: ",
        "SWISSIMAGE: ",
        "basemap.at Orthofoto: ",
        "Sentinel-2 cloudless 2016: ",
        "OpenStreetMap: ",
    ] {
        choose(&mut rig, row);
    }
    rig.settle();
    assert_eq!(rig.host().jobs.len(), jobs);
    assert!(rig.host().downloaded.is_empty());
    rig.harness.get_by_label("Open the map").click();
    rig.frames(6);
    let is_of_service = |(_, job): &(_, Job)| {
        matches!(job, Job::DescribeMap(DescribeMapOrder(MapSource::Web(map)))
            if map.template.address.starts_with("https://tile.openstreetmap.org/")
                && map.template.attribution == "© OpenStreetMap contributors"
                && map.template.most_zoom == 19)
    };
    let jobs = &rig.host().jobs[jobs..];
    assert!(jobs.iter().any(is_of_service));
}

#[test]
fn areas_are_downloaded_where_the_terms_allow_it_alone() {
    let mut rig = rig();
    for (row, is_offered) in [("USGS imagery: ", true), ("OpenStreetMap: ", false)] {
        choose(&mut rig, row);
        rig.harness.get_by_label("Open the map").click();
        rig.settle();
        rig.key_with(Modifiers::SHIFT, Key::M);
        rig.frames(4);
        let button = rig.harness.query_by_label("Download what is in sight");
        assert_eq!(button.is_some(), is_offered, "{row}");
        let why = rig
            .harness
            .query_by_label_contains("may not be downloaded by the area");
        assert_eq!(why.is_some(), !is_offered, "{row}");
    }
}

#[test]
fn of_a_map_of_the_web_no_boxes_at_random_are_asked_that_nobody_looks_at() {
    let is_of_boxes = |(_, job): &(_, Job)| matches!(job, Job::Untested(_));
    let mut rig = rig();
    rig.host().ahead = Ahead::Done;
    open(&mut rig, "https://example.org/{z}/{x}/{y}.png");
    rig.open_tab("Plan");
    for _ in 0..4 {
        rig.settle();
    }
    assert_eq!(rig.state()["workspace"], "Plan");
    assert!(!rig.host().jobs.iter().any(is_of_boxes));
    // Of the map that comes with the program they are.
    let mut rig = super::support::rig();
    rig.host().ahead = Ahead::Done;
    rig.open_tab("Plan");
    rig.settle();
    assert!(rig.host().jobs.iter().any(is_of_boxes));
}

#[test]
fn a_download_without_room_says_so_and_one_that_was_stopped_how_far_it_came() {
    let mut rig = rig();
    choose(&mut rig, "USGS imagery: ");
    rig.harness.get_by_label("Open the map").click();
    rig.settle();
    rig.key_with(Modifiers::SHIFT, Key::M);
    rig.frames(4);
    rig.harness
        .get_by_label("Download what is in sight")
        .click();
    rig.host().download = Some(Download {
        done: 12,
        all: 40,
        failed: 3,
        over: true,
        is_full: true,
    });
    rig.frames(6);
    let toasts = rig.state()["toasts"].to_string();
    let told = "has no room for more than 9 of 40 tiles";
    assert!(toasts.contains(told), "{toasts}");
    let row = "The last download brought 9 of 40 tiles.";
    assert!(rig.harness.query_by_label(row).is_some());
}
