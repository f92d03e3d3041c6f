//! Sobol's points against those of `SciPy`.

use pilotage_study::SobolPoints;
use pilotage_tests::oracle::ask;

#[test]
fn points_of_sobol_are_those_of_scipy_in_every_dimension() {
    let (dimensions, count) = (SobolPoints::MOST_DIMENSIONS, 4096_u32);
    let Some(theirs) = ask::<_, Vec<Vec<u32>>>("scipy_sobol.py", &(dimensions, count)) else {
        return;
    };
    let points = SobolPoints::new(dimensions);
    assert_eq!(theirs.len(), count as usize);
    for (number, theirs) in (0..count).zip(&theirs) {
        // SciPy goes through them in the order of the Gray code.
        let number = number ^ number >> 1;
        let ours: Vec<u32> = (0..dimensions).map(|d| points.bits(number, d)).collect();
        assert_eq!(&ours, theirs, "point {number}");
    }
}
