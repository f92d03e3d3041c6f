//! The road network: fixed curves, named for people.

use super::labels::SceneKind;
use super::plan::{Plan, leg_one};
use super::shape::{Outline, Slab, Spot, smooth_curve, spot};
use super::things::RoadClass::{Main, Street, Track};
use super::things::{Ground, Road, RoadClass};

fn road(plan: &mut Plan, name: &'static str, class: RoadClass, controls: &[Spot]) {
    let half_width = match class {
        Main => 3.6,
        RoadClass::Stream => 1.7,
        Street => 2.9,
        Track => 1.35,
    };
    plan.roads.push(Road {
        class,
        curve: smooth_curve(controls, 5.0),
        half_width,
        name: Some(name),
        village: name.ends_with("Street"),
    });
}

/// The roundabout where the main roads meet.
fn roundabout(plan: &mut Plan) {
    let center = spot(428.0, 617.0);
    let ring = |radius: f32, ground| (Outline::Disc(center, radius), ground);
    for (outline, ground) in [
        ring(24.0, Ground::Grass),
        ring(17.9, Ground::Asphalt),
        ring(9.3, Ground::Paving),
        ring(8.2, Ground::Lawn),
        ring(3.0, Ground::Beds),
    ] {
        plan.lay(outline, ground, spot(1.0, 0.0), 0.1, None);
    }
    let circle = (0..=28)
        .map(|i| {
            let angle = i as f32 * std::f32::consts::TAU / 28.0;
            center + Spot::heading(angle) * 13.7
        })
        .collect();
    plan.roads.push(Road {
        class: Street,
        curve: circle,
        half_width: 4.3,
        name: Some("roundabout"),
        village: false,
    });
    let site = Slab::new(center, 0.0, 52.0, 52.0);
    plan.reserved.push(site);
    let outline = Outline::Disc(center, 18.5).corners();
    plan.announce("roundabout", SceneKind::Place, outline, &site);
}

/// Pedestrian crossings: road, metres along it.
const CROSSINGS: [(&str, f32); 9] = [
    ("High Street", 300.0),
    ("High Street", 452.0),
    ("High Street", 640.0),
    ("Back Street", 320.0),
    ("Back Street", 520.0),
    ("School Street", 32.0),
    ("Market Street", 250.0),
    ("Market Street", 140.0),
    ("Church Street", 150.0),
];

/// Paints the crossings of the village streets.
fn crossings(plan: &mut Plan) {
    for (name, along) in CROSSINGS {
        let Some(road) = plan.roads.iter().find(|r| r.name == Some(name)) else {
            continue;
        };
        if let Some((place, axis)) = super::settlement::station(&road.curve, along) {
            let half_width = road.half_width;
            let slab = Slab {
                center: place,
                axis: axis.right(),
                half_along: half_width - 0.25,
                half_across: 1.7,
            };
            plan.lay_slab(slab, Ground::Zebra, 0.0);
        }
    }
}

/// Lays all roads.
pub(super) fn build(plan: &mut Plan) {
    roundabout(plan);
    let s = spot;
    // The straight piece from (-40, 230) to (-720, -450) runs under the second leg.
    road(
        plan,
        "South Road",
        Main,
        &[
            s(-1300.0, -780.0),
            s(-1010.0, -690.0),
            s(-830.0, -560.0),
            s(-720.0, -450.0),
            s(-380.0, -110.0),
            s(-40.0, 230.0),
            s(150.0, 420.0),
            s(300.0, 520.0),
            s(415.5, 606.5),
        ],
    );
    road(
        plan,
        "North Road",
        Main,
        &[
            s(442.0, 628.0),
            s(620.0, 720.0),
            s(820.0, 740.0),
            s(1020.0, 860.0),
            s(1300.0, 900.0),
        ],
    );
    road(
        plan,
        "East Road",
        Main,
        &[
            s(418.0, 634.0),
            s(350.0, 800.0),
            s(380.0, 980.0),
            s(300.0, 1300.0),
        ],
    );
    road(
        plan,
        "West Road",
        Main,
        &[
            s(437.5, 603.0),
            s(480.0, 480.0),
            s(470.0, 340.0),
            s(640.0, 0.0),
            s(650.0, -340.0),
            s(590.0, -700.0),
            s(700.0, -1300.0),
        ],
    );
    road(
        plan,
        "Mill Lane",
        Street,
        &[
            s(650.0, -340.0),
            s(520.0, -470.0),
            s(400.0, -560.0),
            s(200.0, -620.0),
            s(-100.0, -760.0),
            s(-480.0, -820.0),
            s(-760.0, -700.0),
            s(-900.0, -620.0),
        ],
    );
    road(
        plan,
        "Quarry Lane",
        Street,
        &[
            s(-720.0, -450.0),
            s(-760.0, -240.0),
            s(-690.0, 60.0),
            s(-620.0, 300.0),
            s(-640.0, 700.0),
            s(-540.0, 1300.0),
        ],
    );
    road(
        plan,
        "Orchard Lane",
        Street,
        &[
            s(-620.0, 300.0),
            s(-420.0, 420.0),
            s(-240.0, 520.0),
            s(-20.0, 500.0),
            s(150.0, 420.0),
        ],
    );
    let l = leg_one;
    road(
        plan,
        "High Street",
        Street,
        &[
            s(520.0, -470.0),
            l(-20.0, 66.0),
            l(100.0, 52.0),
            l(217.0, 47.0),
            l(330.0, 54.0),
            l(450.0, 49.0),
            l(600.0, 51.0),
            l(771.0, 47.0),
        ],
    );
    road(
        plan,
        "Back Street",
        Street,
        &[
            l(100.0, 52.0),
            l(112.0, -10.0),
            l(150.0, -52.0),
            l(300.0, -48.0),
            l(420.0, -54.0),
            l(600.0, -50.0),
            l(771.0, -58.0),
        ],
    );
    for (name, along, from, to) in [
        ("Church Street", 257.0, 190.0, -48.0),
        ("School Street", 335.0, 54.0, -170.0),
        ("Market Street", 488.0, 230.0, -210.0),
        ("Tank Street", 645.0, 51.0, -50.0),
    ] {
        road(
            plan,
            name,
            Street,
            &[
                l(along, from),
                l(along - 2.0, 0.5 * (from + to)),
                l(along, to),
            ],
        );
    }
    road(
        plan,
        "Low Street",
        Street,
        &[
            l(257.0, 190.0),
            l(340.0, 150.0),
            l(488.0, 142.0),
            l(600.0, 150.0),
            l(645.0, 51.0),
        ],
    );
    road(
        plan,
        "Upper Street",
        Street,
        &[
            l(335.0, -170.0),
            l(400.0, -150.0),
            l(488.0, -146.0),
            l(560.0, -140.0),
            l(600.0, -50.0),
        ],
    );
    road(
        plan,
        "Track Street",
        Street,
        &[
            l(488.0, -210.0),
            s(300.0, 170.0),
            s(420.0, 250.0),
            s(520.0, 290.0),
        ],
    );
    for (name, controls) in [
        (
            "north track",
            vec![
                s(650.0, -340.0),
                s(760.0, -320.0),
                s(900.0, -420.0),
                s(1050.0, -380.0),
                s(1300.0, -460.0),
            ],
        ),
        (
            "wood track",
            vec![
                s(-480.0, -820.0),
                s(-420.0, -950.0),
                s(-300.0, -1050.0),
                s(-320.0, -1300.0),
            ],
        ),
        (
            "mill track",
            vec![
                s(-100.0, -760.0),
                s(-160.0, -600.0),
                s(-120.0, -450.0),
                s(-200.0, -330.0),
                s(-300.0, -240.0),
            ],
        ),
        (
            "quarry track",
            vec![s(-640.0, 540.0), s(-700.0, 560.0), s(-760.0, 600.0)],
        ),
        (
            "south track",
            vec![
                s(-690.0, 60.0),
                s(-820.0, 90.0),
                s(-960.0, 20.0),
                s(-1300.0, 80.0),
            ],
        ),
        (
            "east track",
            vec![
                s(-240.0, 520.0),
                s(-220.0, 700.0),
                s(-120.0, 820.0),
                s(-160.0, 1000.0),
                s(-60.0, 1300.0),
            ],
        ),
        (
            "pond track",
            vec![
                s(150.0, 420.0),
                s(80.0, 560.0),
                s(120.0, 700.0),
                s(60.0, 860.0),
                s(140.0, 1000.0),
            ],
        ),
        (
            "hill track",
            vec![
                s(820.0, 740.0),
                s(860.0, 560.0),
                s(820.0, 380.0),
                s(900.0, 160.0),
                s(860.0, -60.0),
                s(900.0, -420.0),
            ],
        ),
    ] {
        road(plan, name, Track, &controls);
    }
    crossings(plan);
}
