//! `pilotage classes` as a user calls it.

use pilotage_core::raster::{Picture, encode_png};

use super::folder::Folder;

#[test]
fn folders_of_tiles_are_learned_by_their_words_and_told() {
    let folder = Folder::new("class_words");
    for (name, period) in [("ploughed", 5_usize), ("orchard", 12)] {
        for part in ["learned", "others"] {
            std::fs::create_dir_all(folder.0.join(part).join(name)).unwrap();
            for number in 0..5 {
                let shift = number + 3 * part.len() % 7;
                let picture = Picture::from_fn(56, 56, |x, y| {
                    let noise = ((x * 7919 + y * 104_729 + shift * 31) % 23) as u8;
                    let is_dot = (x + shift) % period < period / 2
                        && (period < 10 || (y + shift) % period < period / 2);
                    let value = if is_dot { 60 } else { 150 } + noise;
                    [value, value, value / 2]
                });
                let bytes = encode_png(&picture).unwrap();
                folder.write(&format!("{part}/{name}/{number}.png"), bytes);
            }
        }
    }
    let train = "classes train --by words learned --out map.words".split(' ');
    folder.run(&train.collect::<Vec<_>>()).unwrap();
    let judge = "classes judge --by words others --weights map.words".split(' ');
    let told = folder.run(&judge.collect::<Vec<_>>()).unwrap();
    assert!(told.contains("right 1.0000 of 10 tiles"), "{told}");
    let without = "classes train --by words --out map.words".split(' ');
    let refused = folder.run(&without.collect::<Vec<_>>()).unwrap_err();
    assert!(refused.contains("FOLDER"), "{refused}");
}

#[test]
fn the_countries_that_weights_are_judged_by_are_not_learned_from() {
    let folder = Folder::new("class_seed");
    let train =
        "classes train --seed 0 --countries 1 --tiles 1 --rounds 1 --out map.weights".split(' ');
    let refused = folder.run(&train.collect::<Vec<_>>()).unwrap_err();
    assert!(refused.contains("--seed"), "{refused}");
}
