//! Public services of tiles that may be looked at in a program like this without a key. None is asked for anything
//! before people open its map.

use super::address::host_of;

/// Public service of tiles.
#[derive(Debug)]
pub(super) struct WebService {
    /// Name for people.
    pub name: &'static str,
    /// Area that it covers.
    pub area: &'static str,
    /// Kind of map, and how fine.
    pub shows: &'static str,
    /// Template of its addresses.
    pub address: &'static str,
    /// Attribution that it asks for.
    pub attribution: &'static str,
    /// Deepest zoom that it has.
    pub finest: u8,
    /// Terms of use in a sentence or two.
    pub terms: &'static str,
    /// Whether the terms allow areas to be downloaded.
    pub is_downloadable: bool,
}

/// Every service. Their own pages have the last word on terms.
pub(super) const SERVICES: [WebService; 6] = [
    WebService {
        name: "USGS imagery",
        area: "United States",
        shows: "pictures from the air, about 2 m",
        address: "https://basemap.nationalmap.gov/arcgis/rest/services/USGSImageryOnly/MapServer/tile/{z}/{y}/{x}",
        attribution: "USGS The National Map",
        finest: 16,
        terms: "Public domain.",
        is_downloadable: true,
    },
    WebService {
        name: "USGS topo",
        area: "United States",
        shows: "drawn, with contours",
        address: "https://basemap.nationalmap.gov/arcgis/rest/services/USGSTopo/MapServer/tile/{z}/{y}/{x}",
        attribution: "USGS The National Map",
        finest: 16,
        terms: "Public domain.",
        is_downloadable: true,
    },
    WebService {
        name: "SWISSIMAGE",
        area: "Switzerland",
        shows: "pictures from the air, 0.1 to 0.25 m",
        address: "https://wmts.geo.admin.ch/1.0.0/ch.swisstopo.swissimage/default/current/3857/{z}/{x}/{y}.jpeg",
        attribution: "© swisstopo",
        finest: 20,
        terms: "Free within fair use. For use without a network swisstopo has the same pictures as GeoTIFF files, \
                which open here.",
        is_downloadable: false,
    },
    WebService {
        name: "basemap.at Orthofoto",
        area: "Austria",
        shows: "pictures from the air, about 0.3 m",
        address: "https://mapsneu.wien.gv.at/basemap/bmaporthofoto30cm/normal/google3857/{z}/{y}/{x}.jpeg",
        attribution: "Datenquelle: basemap.at",
        finest: 19,
        terms: "Open data, CC BY 4.0.",
        is_downloadable: true,
    },
    WebService {
        name: "Sentinel-2 cloudless 2016",
        area: "the world",
        shows: "pictures from space, 10 m",
        address: "https://tiles.maps.eox.at/wmts/1.0.0/s2cloudless_3857/default/g/{z}/{y}/{x}.jpg",
        attribution: "Sentinel-2 cloudless - https://s2maps.eu by EOX IT Services GmbH (Contains modified Copernicus \
                      Sentinel data 2016 & 2017)",
        finest: 14,
        terms: "The pictures are CC BY 4.0; EOX offers its server for looking, and areas as files.",
        is_downloadable: false,
    },
    WebService {
        name: "OpenStreetMap",
        area: "the world",
        shows: "drawn: streets, paths, buildings; nothing that a camera sees",
        address: "https://tile.openstreetmap.org/{z}/{x}/{y}.png",
        attribution: "© OpenStreetMap contributors",
        finest: 19,
        terms: "Data under the ODbL. The tile usage policy allows looking, and forbids downloads for use without a \
                network.",
        is_downloadable: false,
    },
];

/// The service whose server an address names, as far as terms go: those of a server hold for all that it has.
pub(super) fn service_at(address: &str) -> Option<&'static WebService> {
    let host = host_of(address)?;
    SERVICES.iter().find(|service| {
        let own = host_of(service.address).unwrap_or_default();
        let front = host.strip_suffix(own);
        front.is_some_and(|front| front.is_empty() || front.ends_with('.'))
    })
}

#[cfg(test)]
mod tests {
    use pilotage_core::imagery::web_tiles::TileTemplate;

    use super::*;

    #[test]
    fn every_service_has_a_template_that_can_be_opened_and_says_what_it_is() {
        for service in &SERVICES {
            let template = TileTemplate {
                name: service.name.to_owned(),
                address: service.address.to_owned(),
                attribution: service.attribution.to_owned(),
                least_zoom: 0,
                most_zoom: service.finest,
                side: 256,
            };
            assert!(template.checked().is_ok(), "{}", service.name);
            assert!(service.address.starts_with("https://"), "{}", service.name);
            let words = [service.area, service.shows, service.attribution];
            assert!(words.iter().all(|it| !it.is_empty()), "{}", service.name);
            assert!(service.terms.ends_with('.'), "{}", service.name);
        }
    }

    #[test]
    fn terms_hold_for_whatever_is_asked_of_a_server() {
        let of = |address| service_at(address).map(|service| service.name);
        let typed = "https://a.tile.openstreetmap.org/{z}/{x}/{y}.png";
        assert_eq!(of(typed), Some("OpenStreetMap"));
        assert_eq!(of("http://nottile.openstreetmap.org/{z}"), None);
        assert_eq!(of("https://example.org/tile.openstreetmap.org/{z}"), None);
        assert_eq!(of(""), None);
    }
}
