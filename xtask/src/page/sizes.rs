//! The sizes of the page, as it is stored and as it travels.

use std::{fs, path::Path};

use super::{MODULE, WORKER_MODULE, compress::beside, files};
use crate::failure::Failure;

/// What the page's program may weigh with brotli, in bytes.
const MODULE_BAR: u64 = 1_600_000;

/// Prints a table of the files of `dist`; fails if the page's program is over its bar.
pub fn print(dist: &Path) -> Result<(), Failure> {
    println!(
        "{:<28}{:>12}{:>12}{:>12}",
        "file", "bytes", "gzip", "brotli"
    );
    let mut sums = [0; 3];
    for file in files::below(dist)? {
        let ending = file.extension().and_then(|ending| ending.to_str());
        if matches!(ending, Some("br" | "gz")) {
            continue;
        }
        let place = dist.join(&file);
        let raw = size(&place)?;
        let gzip = size(&beside(&place, "gz")).unwrap_or(raw);
        let brotli = size(&beside(&place, "br")).unwrap_or(raw);
        println!(
            "{:<28}{raw:>12}{gzip:>12}{brotli:>12}",
            files::address(&file)
        );
        for (sum, one) in sums.iter_mut().zip([raw, gzip, brotli]) {
            *sum += one;
        }
    }
    println!(
        "{:<28}{:>12}{:>12}{:>12}",
        "together", sums[0], sums[1], sums[2]
    );
    let [module, workers] = [MODULE, WORKER_MODULE]
        .map(|name| size(&dist.join("pkg").join(format!("{name}_bg.wasm.br"))));
    let (module, workers) = (module?, workers?);
    if module > MODULE_BAR {
        return Err(Failure::Check(format!(
            "the page's program has {module} bytes with brotli, over the bar of {MODULE_BAR}; look for what \
             came in lately: a library, a font, code made for many types"
        )));
    }
    println!("\nthe page's program with brotli: {module} bytes, within the bar of {MODULE_BAR}");
    println!("the workers' program with brotli: {workers} bytes");
    Ok(())
}

fn size(place: &Path) -> Result<u64, Failure> {
    Ok(fs::metadata(place).map_err(Failure::file(place))?.len())
}
