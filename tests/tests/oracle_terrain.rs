//! Heights of elevation models against rasterio and `SciPy`.

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
    heights: Vec<(f64, f64, Option<f64>)>,
}

#[test]
fn heights_at_a_thousand_places_of_every_model_are_those_of_rasterio() {
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
            "{}: {} places, {unknown} of them unknown, furthest {furthest:.1e} m",
            model.name,
            model.heights.len()
        );
        assert!(furthest < 1e-3, "{}: {furthest} m", model.name);
        assert_eq!(*dem.datum(), HeightDatum::NotStated);
    }
}
