//! Heights of elevation models against rasterio and `SciPy`, and what they count from against PROJ.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::MemoryBytes;
use pilotage_core::imagery::terrain::{Dem, HeightDatum, Terrain};
use pilotage_tests::data::shared;
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    directory: PathBuf,
    raw: Option<PathBuf>,
}

#[derive(Deserialize)]
struct Model {
    name: String,
    path: PathBuf,
    datum: String,
    posts: usize,
    heights: Vec<(f64, f64, Option<f64>)>,
}

#[test]
fn heights_of_every_model_are_those_of_rasterio_between_posts_and_at_posts() {
    let question = Question {
        directory: PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("terrain"),
        raw: shared("dem/jacksboro_344x403_i16le.raw"),
    };
    let Some(models) = ask::<_, Vec<Model>>("rasterio_terrain.py", &question) else {
        return;
    };
    for model in &models {
        let bytes = std::fs::read(&model.path).unwrap();
        let source = Arc::new(MemoryBytes::new(model.name.clone(), bytes));
        let dem = Dem::open(source, None, None).unwrap_or_else(|error| panic!("{error}"));
        let (mut furthest, mut unknown): (f64, usize) = (0.0, 0);
        for &(latitude, longitude, theirs) in &model.heights {
            let place = Geodetic::from_degrees(latitude, longitude, 0.0);
            let ground = dem.frame().ground_from_geodetic(&place);
            match (dem.height_at(&ground), theirs) {
                (Some(ours), Some(theirs)) => furthest = furthest.max((ours - theirs).abs()),
                (None, None) => unknown += 1,
                (ours, theirs) => panic!("{}: {ours:?}, not {theirs:?}", model.name),
            }
        }
        println!(
            "{}: {} places, {unknown} of them unknown, furthest {furthest:.1e} m, above {}",
            model.name,
            model.heights.len(),
            dem.datum().name()
        );
        assert!(furthest < 1e-3, "{}: {furthest} m", model.name);
        match dem.datum() {
            HeightDatum::NotStated => assert_eq!(model.datum, "", "{}", model.name),
            HeightDatum::Ellipsoid => assert_eq!(model.datum, "WGS 84", "{}", model.name),
            HeightDatum::MeanSeaLevel(ours) => {
                assert!(model.datum.starts_with(ours), "{ours}, {}", model.datum);
            }
        }
        if model.posts > 0 {
            let kind = std::path::Path::new(&model.name).extension();
            assert_eq!(kind, Some("hgt".as_ref()), "{}", model.name);
            assert!(unknown > 20, "no voids met");
        }
    }
    let sizes: Vec<_> = models.iter().map(|m| m.posts).collect();
    assert!(sizes.contains(&(1201 * 1201)) && sizes.contains(&(3601 * 3601)));
}
