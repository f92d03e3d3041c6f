//! The page's file of places is made from the pinned package.

use pilotage_core::gazetteer::Gazetteer;
use pilotage_tests::{
    data::repository,
    oracle::{ask, bytes_of_hex},
};

#[test]
fn the_file_of_places_is_what_its_script_makes_of_the_pinned_package() {
    let Some(made) = ask::<_, String>("places_file.py", &()) else {
        return;
    };
    let made = bytes_of_hex(&made);
    assert!(Gazetteer::from_bytes(&made).is_some());
    let stored = std::fs::read(repository().join("www/places.bin")).expect("a file of the page");
    assert!(
        made == stored,
        "{} bytes, {} stored",
        made.len(),
        stored.len()
    );
}
