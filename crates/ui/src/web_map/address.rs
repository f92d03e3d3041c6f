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

/// Checks that the page can ask for what an address names, as `index.html` has the browser allow it: by https, and by
/// http of this machine and of the page's `own` server; the error says in words why not.
pub(super) fn check(address: &str, own: &str) -> Result<(), String> {
    let Some((scheme, _)) = address.split_once("://") else {
        return Err("an address begins with https://".to_owned());
    };
    let scheme = scheme.to_ascii_lowercase();
    let host = host_of(address).unwrap_or_default();
    let server = host.rsplit('@').next().unwrap_or_default();
    let (name, port) = match server.rsplit_once(':') {
        Some((name, port)) if !port.ends_with(']') => (name, port),
        _ => (server, ""),
    };
    if name.is_empty() || name.contains(char::is_whitespace) {
        return Err(format!("\"{name}\" is no name of a server"));
    }
    if !port.is_empty() && port.parse::<u16>().is_err() {
        return Err(format!("{port}: a port is a number up to 65535"));
    }
    let is_near = ["localhost", "127.0.0.1"].contains(&name) || own == format!("{scheme}://{host}");
    if scheme == "https" || scheme == "http" && is_near {
        return Ok(());
    }
    Err(format!(
        "this page may ask {name} by https:// alone; by http:// it may ask this machine (localhost)"
    ))
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

    #[test]
    fn an_address_that_the_page_may_not_ask_for_is_refused_with_the_reason() {
        let own = "http://192.168.1.5:8000";
        let refused = |address| check(address, own).unwrap_err();
        for address in [
            "https://example.org/{z}/{x}/{y}.png",
            "https://{s}.example.org:8443/map.tif",
            "https://[2001:db8::1]/map.tif",
            "http://localhost:8080/map.tif",
            "http://127.0.0.1/map.tif",
            "http://192.168.1.5:8000/map.tif",
        ] {
            assert_eq!(check(address, own), Ok(()), "{address}");
        }
        assert!(refused("http://192.168.1.5:8080/map.tif").contains("192.168.1.5 by https"));
        assert!(refused("ftp://example.org/map.tif").contains("https"));
        assert!(refused("example.org/map.tif").contains("begins with https://"));
        assert!(refused("https://example.org:99999/map.tif").contains("up to 65535"));
        assert!(refused("https://exa mple.org/map.tif").contains("no name"));
        assert!(refused("https:///map.tif").contains("no name"));
    }
}
