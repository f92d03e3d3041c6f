//! A field is plotted against another one; plots are saved as a drawing and as a picture.

use egui_kittest::kittest::Queryable as _;

use super::log::{panels, rig_with_a_log};
use super::support::Rig;

/// Plots roll and pitch, the third panel, against what is called so.
fn against(rig: &mut Rig, search: &str, name: &str) {
    rig.harness
        .get_by_label("Plot 3, over time: change")
        .click();
    rig.frames(3);
    rig.harness
        .get_by_label("Search fields to plot against")
        .focus();
    rig.frames(2);
    rig.harness
        .get_by_label("Search fields to plot against")
        .type_text(search);
    rig.frames(3);
    rig.harness.get_by_label(name).click();
    rig.settle();
}

#[test]
fn a_panel_is_plotted_against_a_field_and_over_time_again() {
    let mut rig = rig_with_a_log();
    against(&mut rig, "ground", "Against Ground speed");
    assert_eq!(rig.state()["log"]["against"][2], "Ground speed");
    assert_eq!(panels(&rig)[2], ["Roll", "Pitch"]);
    rig.harness
        .get_by_label("Plot of Roll, Pitch against Ground speed");
    rig.harness
        .get_by_label("Join the points of plot 3")
        .click();
    rig.frames(3);
    rig.harness
        .get_by_label("Plot 3, against Ground speed: change")
        .click();
    rig.frames(3);
    rig.harness.get_by_label("Over time").click();
    rig.frames(3);
    assert!(rig.state()["log"]["against"][2].is_null());
}

#[test]
fn a_click_on_a_point_moves_the_time_cursor_to_its_time() {
    let mut rig = rig_with_a_log();
    against(&mut rig, "gps.al", "Against GPS.Alt");
    let plot = rig
        .harness
        .get_by_label("Plot of Roll, Pitch against GPS.Alt")
        .rect();
    // The height grows with time: what is far to the right is late.
    let (x, mut y) = (plot.left() + 0.9 * plot.width(), plot.top() + 8.0);
    // A flight plays by itself once it is there.
    if rig.state()["playing"] == true {
        rig.key(egui::Key::Space);
        rig.frames(2);
    }
    let before = rig.state()["time"].clone();
    while rig.state()["time"] == before && y < plot.bottom() {
        let at = egui::pos2(x, y);
        rig.harness.hover_at(at);
        rig.harness.drag_at(at);
        rig.harness.drop_at(at);
        rig.frames(3);
        y += 12.0;
    }
    let time = rig.state()["time"].as_f64().expect("a time");
    assert!((24.0..30.95).contains(&time), "{time}");
}

#[test]
fn the_plots_are_saved_as_a_drawing_with_names_and_units() {
    let mut rig = rig_with_a_log();
    against(&mut rig, "ground", "Against Ground speed");
    rig.harness.get_by_label("Save the plots").click();
    rig.frames(3);
    rig.harness.get_by_label("Save the plots as SVG").click();
    rig.frames(3);
    let (name, bytes) = rig.host().saved.last().expect("a file").clone();
    assert_eq!(name, "east-1s-31s.svg");
    let text = String::from_utf8(bytes).expect("text");
    assert!(text.starts_with("<svg "), "{text}");
    for wanted in [
        ">Ground speed, m/s<",
        ">Roll, °<",
        ">Pitch, °<",
        ">time, s<",
        "<path d=\"M",
        "east.log",
    ] {
        assert!(text.contains(wanted), "{wanted} is not in it");
    }
}

#[test]
fn the_plots_are_saved_as_a_picture_twice_as_fine() {
    let mut rig = rig_with_a_log();
    rig.harness.get_by_label("Save the plots").click();
    rig.frames(3);
    rig.harness.get_by_label("Save the plots as PNG").click();
    rig.frames(3);
    let (name, svg, [width, height]) = rig.host().pictures.last().expect("a picture").clone();
    assert_eq!(name, "east-1s-31s.png");
    let wanted = format!("width=\"{}\"", width / 2);
    assert!(svg.contains(&wanted), "{wanted} of {svg:.200}");
    assert!(height > 200);
}
