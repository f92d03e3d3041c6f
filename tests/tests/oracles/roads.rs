//! The rule for yellow lines, step by step, against OpenCV.

use pilotage_core::raster::Raster;
use pilotage_core::road::yellow::{HoughAccumulator, YellowLineRule, blobs, dilated};
use pilotage_tests::oracle::{ask, hex_of_bytes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    width: usize,
    height: usize,
    pixels: String,
    hue: [f32; 2],
    saturation: [f32; 2],
    value: [f32; 2],
    dilation: usize,
    votes: u32,
}

#[derive(Deserialize)]
struct Answer {
    yellow: Vec<u8>,
    dilated: Vec<u8>,
    areas: Vec<usize>,
    lines: Vec<(f64, f64, u32)>,
}

#[test]
fn mask_blobs_and_votes_are_those_of_opencv() {
    let mut random = ChaCha8Rng::seed_from_u64(33538);
    let (width, height) = (160, 120);
    // Two lines of paint of many shades on a ground of any colour.
    let picture = Raster::from_fn(width, height, |x, y| {
        let (x, y) = (x as f64, y as f64);
        let painted = (y - 0.4 * x - 20.0).abs() < 1.2 || (x - 90.0 + 0.2 * y).abs() < 1.2;
        let mut any = |low: u8, high: u8| random.random_range(low..=high);
        if painted {
            [any(200, 255), any(140, 200), any(0, 60), 255]
        } else if any(0, 9) == 0 {
            [any(0, 255), any(0, 255), any(0, 255), 255]
        } else {
            [any(70, 120), any(70, 120), any(70, 120), 255]
        }
    });
    let rule = YellowLineRule::default();
    let colours: Vec<u8> = (picture.pixels().iter())
        .flat_map(|[r, g, b, _]| [*r, *g, *b])
        .collect();
    let question = Question {
        width,
        height,
        pixels: hex_of_bytes(&colours),
        hue: rule.hue,
        saturation: rule.saturation,
        value: rule.value,
        dilation: rule.dilation,
        votes: 60,
    };
    let Some(answer) = ask::<_, Answer>("opencv_lines.py", &question) else {
        return;
    };
    let bits =
        |mask: &Raster<bool>| -> Vec<u8> { mask.pixels().iter().map(|b| u8::from(*b)).collect() };
    let yellow = picture.map(|pixel| rule.is_yellow(pixel));
    assert_eq!(bits(&yellow), answer.yellow);
    let spread = dilated(&yellow, rule.dilation);
    assert_eq!(bits(&spread), answer.dilated);
    let mut areas: Vec<usize> = blobs(&spread).iter().map(|b| b.pixels.len()).collect();
    areas.sort_unstable();
    assert_eq!(areas, answer.areas);
    let table = HoughAccumulator::new(&spread);
    assert!(answer.lines.len() > 4, "{:?}", answer.lines);
    for &(distance, degrees, votes) in &answer.lines {
        let ours = table.votes(degrees.round() as usize, distance as isize);
        // Its angles are sums of a rounded degree: a pixel between two lines may go to the other.
        assert!(
            ours.abs_diff(votes) <= 2,
            "{distance} {degrees}: {ours} {votes}"
        );
    }
    let strongest = table.peaks(1)[0];
    let (distance, degrees, _) = answer.lines[0];
    assert_eq!(
        (strongest.distance as f64, strongest.degrees as f64),
        (distance, degrees.round())
    );
}
