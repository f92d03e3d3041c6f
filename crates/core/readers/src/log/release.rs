//! Releases of autopilots in words.

/// A release of PX4 or `ArduPilot` in words (`v1.14.3 (beta)`), from its number: one byte each of major,
/// minor, patch and kind, the kinds in steps of 64 from what is being developed to what is official.
pub(super) fn release(number: u32) -> String {
    let [kind, patch, minor, major] = number.to_le_bytes();
    let kind = match kind {
        0..64 => " (development)",
        64..128 => " (alpha)",
        128..192 => " (beta)",
        192..255 => " (release candidate)",
        255 => "",
    };
    format!("v{major}.{minor}.{patch}{kind}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_byte_tells_how_ripe_it_is() {
        assert_eq!(release(0x010e_03ff), "v1.14.3");
        assert_eq!(release(0x0405_00c0), "v4.5.0 (release candidate)");
        assert_eq!(release(0x0101_0000), "v1.1.0 (development)");
    }
}
