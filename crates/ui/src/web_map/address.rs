//! Addresses of the web: of a file or of tiles, and of which server.

/// Whether an address is that of one file, not of tiles.
pub(super) fn is_file(address: &str) -> bool {
    let path = address
        .split(['?', '#'])
        .next()
        .unwrap_or_default()
        .to_ascii_lowercase();
    [".tif", ".tiff", ".pmtiles"]
        .iter()
        .any(|ending| path.trim().ends_with(ending))
}

/// The server that an address names.
pub(super) fn host_of(address: &str) -> Option<&str> {
    let rest = address.trim().split_once("://")?.1;
    rest.split(['/', '?'])
        .next()
        .filter(|host| !host.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_one_of_tiles_or_of_a_file() {
        assert!(is_file("https://example.org/a/map.TIF?key=1"));
        assert!(is_file("http://example.org/map.pmtiles"));
        assert!(!is_file("https://example.org/{z}/{x}/{y}.png"));
        assert_eq!(
            host_of("https://a.example.org:8080/x"),
            Some("a.example.org:8080")
        );
    }
}
