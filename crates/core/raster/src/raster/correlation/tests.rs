//! All engines against the definition, and against OpenCV.

use proptest::prelude::*;

use super::search::{NumeratorEngine, SearchSpectrum};
use super::template::Template;
use crate::raster::simd::Instructions;
use crate::raster::{Gray, Raster};

const ENGINES: [NumeratorEngine; 3] = [
    NumeratorEngine::Direct(Instructions::Best),
    NumeratorEngine::Direct(Instructions::Scalar),
    NumeratorEngine::Fourier,
];

/// Noise with some structure, 0 to 255, reproducible.
fn texture(width: usize, height: usize, seed: u32) -> Gray {
    let mut state = seed.wrapping_mul(2_654_435_761) | 1;
    Gray::from_fn(width, height, |x, y| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (state >> 24) as f32;
        let wave = 64.0 * ((x as f32 * 0.3).sin() + (y as f32 * 0.2).cos()) + 128.0;
        (0.5 * noise + 0.5 * wave).round()
    })
}

/// The coefficient by its definition, in double precision.
fn definition(search: &Gray, patch: &Gray, mask: &Raster<bool>, x: usize, y: usize) -> f64 {
    let pairs: Vec<(f64, f64)> = (0..patch.height())
        .flat_map(|j| (0..patch.width()).map(move |i| (i, j)))
        .filter(|&(i, j)| mask.get(i, j))
        .map(|(i, j)| {
            (
                f64::from(patch.get(i, j)),
                f64::from(search.get(x + i, y + j)),
            )
        })
        .collect();
    let n = pairs.len() as f64;
    let (mt, ms) = pairs
        .iter()
        .fold((0.0, 0.0), |(a, b), (t, s)| (a + t / n, b + s / n));
    let (ts, tt, ss) = pairs.iter().fold((0.0, 0.0, 0.0), |(ts, tt, ss), (t, s)| {
        (
            ts + (t - mt) * (s - ms),
            tt + (t - mt).powi(2),
            ss + (s - ms).powi(2),
        )
    });
    if ss < 1e-3 {
        0.0
    } else {
        ts / (tt * ss).sqrt()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn every_engine_computes_the_correlation_coefficient(
        width in 8usize..60,
        height in 8usize..40,
        // Smaller patches have windows without any variance to speak of; detectors use eight or more.
        patch_width in 6usize..24,
        patch_height in 6usize..24,
        seed in any::<u32>(),
        masked in any::<bool>(),
    ) {
        let search = texture(width, height, seed);
        let patch = texture(patch_width.min(width), patch_height.min(height), seed ^ 0x55);
        let mask = Raster::from_fn(patch.width(), patch.height(), |i, j| {
            !masked || (i + 2 * j) % 5 != 0
        });
        let template = Template::masked(&patch, &mask);
        prop_assume!(template.is_some());
        let template = template.unwrap();
        let prepared = SearchSpectrum::new(&search);
        for engine in ENGINES {
            let surface = prepared.correlate_by(&template, Some(engine));
            prop_assert_eq!(surface.width(), width - patch.width() + 1);
            prop_assert_eq!(surface.height(), height - patch.height() + 1);
            for y in 0..surface.height() {
                for x in 0..surface.width() {
                    let expected = definition(&search, &patch, &mask, x, y);
                    let got = f64::from(surface.get(x, y));
                    // Rounding of single precision, divided by the root of a window's variance: a
                    // window of a few pixels may have hardly any.
                    let taps = mask.pixels().iter().filter(|m| **m).count() as f64;
                    let tolerance = 3e-5 + 1e-3 / taps;
                    prop_assert!((got - expected).abs() < tolerance, "{engine:?} {got} {expected}");
                }
            }
        }
    }

    #[test]
    fn a_part_of_the_surface_is_what_the_whole_has_there(
        left in 0usize..50, top in 0usize..50, width in 1usize..30, height in 1usize..30,
    ) {
        let search = texture(80, 70, 7);
        let template = Template::new(&search.crop(31, 22, 16, 12).unwrap()).unwrap();
        let whole = template.correlate(&search);
        let part = template.correlate_at(&search, left..left + width, top..top + height);
        prop_assert_eq!(part.width(), width.min(whole.width() - left));
        prop_assert_eq!(part.height(), height.min(whole.height() - top));
        for y in 0..part.height() {
            for x in 0..part.width() {
                prop_assert!((part.get(x, y) - whole.get(left + x, top + y)).abs() < 2e-5);
            }
        }
    }
}

#[test]
fn a_patch_is_found_where_it_was_cut_out() {
    let search = texture(120, 90, 3);
    let template = Template::new(&search.crop(57, 33, 20, 25).unwrap()).unwrap();
    let peak = crate::raster::highest_peak(&template.correlate(&search)).unwrap();
    assert_eq!(peak.sample, (57, 33));
    assert!((peak.value - 1.0).abs() < 0.02, "{peak:?}");
}

#[test]
fn a_large_picture_searched_in_tiles_gives_the_same_surface() {
    let search = texture(700, 500, 11);
    let template = Template::new(&search.crop(401, 222, 48, 40).unwrap()).unwrap();
    assert_ne!(super::cost::tile(700, 500, 48, 40), (700, 500));
    let tiled = template.correlate(&search);
    let whole = SearchSpectrum::new(&search).correlate(&template);
    let furthest = tiled
        .pixels()
        .iter()
        .zip(whole.pixels())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max);
    assert!(furthest < 2e-5, "{furthest}");
}

#[test]
fn flat_templates_are_refused_and_flat_windows_score_nothing() {
    assert!(Template::new(&Gray::filled(8, 8, 93.0)).is_none());
    assert!(Template::new(&Gray::filled(0, 0, 0.0)).is_none());
    let template = Template::new(&texture(8, 8, 1)).unwrap();
    for level in [0.0, 0.1, 255.0] {
        let mut search = Gray::filled(40, 30, level);
        search.set(39, 29, 2.0);
        for engine in ENGINES {
            let surface = SearchSpectrum::new(&search).correlate_by(&template, Some(engine));
            assert!(
                surface
                    .crop(0, 0, 32, 22)
                    .unwrap()
                    .pixels()
                    .iter()
                    .all(|&v| v == 0.0)
            );
        }
    }
}

#[test]
fn brightness_and_contrast_do_not_change_the_score() {
    let search = texture(64, 64, 5);
    let template = Template::new(&search.crop(20, 20, 24, 24).unwrap()).unwrap();
    let dimmed = template.correlate(&search.map(|v| 0.3 * v + 40.0));
    for (a, b) in template
        .correlate(&search)
        .pixels()
        .iter()
        .zip(dimmed.pixels())
    {
        assert!((a - b).abs() < 2e-5);
    }
}

#[test]
fn a_template_larger_than_the_picture_gives_an_empty_surface() {
    let template = Template::new(&texture(20, 8, 1)).unwrap();
    assert!(template.correlate(&texture(19, 50, 1)).is_empty());
    assert!(
        template
            .correlate_at(&texture(19, 50, 1), 0..5, 0..5)
            .is_empty()
    );
}

#[derive(serde::Deserialize)]
struct Case {
    map: String,
    templ: String,
    method: String,
    shape: (usize, usize),
    min: f64,
    max: f64,
    maxloc: (usize, usize),
    samples: Vec<(usize, usize, f64)>,
}

#[derive(serde::Deserialize)]
struct Vectors {
    #[serde(rename = "matchTemplate")]
    cases: Vec<Case>,
}

#[test]
fn the_surface_is_that_of_opencv() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../../shared/data/opencv_ncc"
    );
    let Ok(text) = std::fs::read_to_string(format!("{folder}/expected_opencv_4.14.json")) else {
        println!("skipped: no shared data");
        return;
    };
    let vectors: Vectors = serde_json::from_str(&text).unwrap();
    let read = |name: &str| {
        let bytes = std::fs::read(format!("{folder}/{name}")).unwrap();
        let picture = image::load_from_memory(&bytes).unwrap().to_luma8();
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let pixels = picture.into_raw().into_iter().map(f32::from).collect();
        Gray::from_pixels(width, height, pixels).unwrap()
    };
    let mut furthest: f64 = 0.0;
    let mut compared = 0;
    for case in vectors
        .cases
        .iter()
        .filter(|c| c.method == "TM_CCOEFF_NORMED")
    {
        let (map, patch) = (read(&case.map), read(&case.templ));
        let surface = Template::new(&patch).unwrap().correlate(&map);
        assert_eq!(
            (surface.height(), surface.width()),
            case.shape,
            "{}",
            case.templ
        );
        for &(x, y, expected) in &case.samples {
            let got = f64::from(surface.get(x, y));
            furthest = furthest.max((got - expected).abs());
            assert!(
                (got - expected).abs() < 1e-4,
                "{} {x} {y}: {got} {expected}",
                case.templ
            );
        }
        let peak = crate::raster::highest_peak(&surface).unwrap();
        assert_eq!(peak.sample, case.maxloc, "{} {}", case.map, case.templ);
        let (low, high) = surface
            .pixels()
            .iter()
            .fold((f32::MAX, f32::MIN), |(low, high), &v| {
                (low.min(v), high.max(v))
            });
        furthest = furthest.max((f64::from(high) - case.max).abs());
        assert!((f64::from(high) - case.max).abs() < 1e-4, "{}", case.templ);
        assert!((f64::from(low) - case.min).abs() < 1e-4, "{}", case.templ);
        compared += 1;
    }
    assert_eq!(compared, vectors.cases.len() / 4);
    println!("{compared} surfaces, furthest {furthest:.1e}");
}
