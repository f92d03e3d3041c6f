//! Systems of longitude, latitude and height above an ellipsoid.

/// EPSG codes of systems of longitude and latitude, and those of the systems with heights on the same datum, from the EPSG
/// dataset by way of pyproj. Frames of the earth from ITRF94 on and the realizations of WGS 84 are WGS 84 to a decimetre.
const FLAT: &[(u32, &[u32])] = &[
    (3824, &[3823]),
    (4081, &[4080]),
    (4148, &[4941]),
    (4152, &[4957]),
    (4167, &[4959]),
    (4171, &[4965, 7042]),
    (4173, &[4943]),
    (4180, &[4935]),
    (4190, &[4961]),
    (
        4258,
        &[
            4937, 7915, 7917, 7919, 7921, 7923, 7925, 7927, 7929, 7931, 8399, 8403, 10_570,
        ],
    ),
    (4283, &[4939]),
    (4312, &[9267]),
    (
        4326,
        &[
            4979, 7657, 7659, 7661, 7663, 7665, 7816, 7906, 7907, 7908, 7909, 7910, 7911, 7912,
            9754, 9989, 10_605,
        ],
    ),
    (4490, &[4480]),
    (4612, &[4947]),
    (4617, &[4955, 8235, 8239, 8244, 8248, 8251, 8254, 10_413]),
    (4619, &[4977]),
    (4659, &[4945]),
    (4661, &[4949]),
    (4669, &[4951]),
    (4674, &[4989]),
    (4686, &[4997]),
    (4737, &[4927]),
    (4742, &[4921]),
    (4759, &[4893]),
    (4761, &[4889]),
    (4765, &[4883]),
    (5252, &[5251]),
    (5324, &[5323]),
    (5340, &[5342]),
    (5365, &[5364]),
    (5886, &[5885]),
    (6318, &[6319]),
    (6365, &[6364]),
    (6668, &[6667]),
    (6706, &[6705]),
    (7844, &[7843]),
    (9702, &[9701]),
    (9777, &[9776, 9778]),
    (9782, &[9781, 9783]),
];

/// Code of the longitude and latitude of a system that has heights above the ellipsoid as well; `None` of all others.
pub(crate) fn flat_code(code: u32) -> Option<u32> {
    let found = FLAT.iter().find(|(_, solid)| solid.contains(&code));
    found.map(|(flat, _)| *flat)
}

#[cfg(test)]
mod tests {
    use super::super::datums;
    use super::*;

    #[test]
    fn systems_with_heights_have_the_datum_of_those_without() {
        for (solid, flat) in [
            (4979, 4326),
            (4937, 4258),
            (7912, 4326),
            (6319, 6318),
            (9267, 4312),
        ] {
            assert_eq!(flat_code(solid), Some(flat));
            assert_eq!(datums::by_code(solid), datums::by_code(flat));
        }
        assert!(
            FLAT.iter()
                .all(|(flat, _)| datums::by_code(*flat).is_some())
        );
        assert_eq!(flat_code(4326), None);
    }
}
