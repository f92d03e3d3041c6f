//! File that an address means, and the form in which it is sent.

use std::path::{Path, PathBuf};

/// The file below `dist` that an address means, if there is one. Never one outside of it.
pub fn file_meant(url: &str, dist: &Path) -> Option<PathBuf> {
    let relative = relative_path(url.split(['?', '#']).next()?)?;
    let mut place = dist.join(relative);
    if place.is_dir() {
        place.push("index.html");
    }
    // Followed to its end, so that a link cannot lead out either.
    let real = place.canonicalize().ok()?;
    (real.starts_with(dist) && real.is_file()).then_some(real)
}

/// An address' path as a relative path of plain names, or `None` for anything else.
fn relative_path(path: &str) -> Option<PathBuf> {
    let decoded = percent_decoded(path)?;
    let mut relative = PathBuf::new();
    for name in decoded.split('/').filter(|name| !name.is_empty()) {
        let is_plain = !name.starts_with('.') && !name.contains(['\\', ':', '\0']);
        if !is_plain {
            return None;
        }
        relative.push(name);
    }
    Some(relative)
}

/// `%41` becomes `A`, once; `None` for broken escapes and for what is not UTF-8.
fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = text.bytes();
    let mut decoded = Vec::with_capacity(text.len());
    while let Some(byte) = bytes.next() {
        if byte == b'%' {
            let digit = |byte: u8| char::from(byte).to_digit(16);
            let value = digit(bytes.next()?)? * 16 + digit(bytes.next()?)?;
            decoded.push(u8::try_from(value).ok()?);
        } else {
            decoded.push(byte);
        }
    }
    String::from_utf8(decoded).ok()
}

/// The smallest stored form of `file` that the browser accepts, with the name of its encoding.
pub fn stored_form(file: &Path, accepted: &str) -> (PathBuf, Option<&'static str>) {
    let accepts = |name: &str| {
        accepted.split(',').any(|entry| {
            let mut parts = entry.split(';').map(str::trim);
            parts.next() == Some(name) && !parts.any(|part| matches!(part, "q=0" | "q=0.0"))
        })
    };
    for (encoding, ending) in [("br", "br"), ("gzip", "gz")] {
        let mut name = file.as_os_str().to_owned();
        name.push(format!(".{ending}"));
        let stored = PathBuf::from(name);
        if accepts(encoding) && stored.is_file() {
            return (stored, Some(encoding));
        }
    }
    (file.to_owned(), None)
}

/// The media type that goes with a file's ending.
pub fn media_type(file: &Path) -> &'static str {
    match file
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or_default()
    {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "txt" | "md" => "text/plain; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "geojson" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "ico" => "image/x-icon",
        "zip" => "application/zip",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_becomes_a_relative_path() {
        assert_eq!(relative_path("/pkg/a.js"), Some(PathBuf::from("pkg/a.js")));
        assert_eq!(relative_path("/"), Some(PathBuf::new()));
        assert_eq!(relative_path("/a%20b.txt"), Some(PathBuf::from("a b.txt")));
    }

    #[test]
    fn no_address_leads_out_of_the_page() {
        let tricks = [
            "/../secret",
            "/%2e%2e/secret",
            "/a/..%2fsecret",
            "/..\\secret",
            "/%5c..%5csecret",
            "/.git/config",
            "/C:/secret",
            "/%00",
            "/%zz",
            "/%f",
            "/%ff",
        ];
        for trick in tricks {
            assert_eq!(relative_path(trick), None, "{trick}");
        }
        // Decoded once only: this is a file with a strange name, not a way up.
        assert_eq!(relative_path("/%252e%252e"), Some(PathBuf::from("%2e%2e")));
    }

    #[test]
    fn only_files_below_the_page_are_found() {
        let own = Path::new(env!("CARGO_MANIFEST_DIR"))
            .canonicalize()
            .unwrap();
        assert_eq!(
            file_meant("/Cargo.toml?x=1", &own),
            Some(own.join("Cargo.toml"))
        );
        assert_eq!(
            file_meant("//Cargo.toml", &own),
            Some(own.join("Cargo.toml"))
        );
        assert_eq!(file_meant("/../Cargo.toml", &own), None);
        assert_eq!(file_meant("/missing.js", &own), None);
    }

    #[test]
    fn an_encoding_that_is_refused_is_not_sent() {
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        assert_eq!(stored_form(&own, "br, gzip"), (own.clone(), None));
    }

    #[test]
    fn modules_and_scripts_have_the_types_that_browsers_insist_on() {
        assert_eq!(media_type(Path::new("a_bg.wasm")), "application/wasm");
        assert_eq!(
            media_type(Path::new("a.js")),
            "text/javascript; charset=utf-8"
        );
    }
}
