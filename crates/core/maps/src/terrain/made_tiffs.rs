//! `GeoTIFF` files of elevation models, made here for tests: one uncompressed strip.

/// Longitude and latitude of the north-west corner, degrees.
pub(super) const CORNER: (f64, f64) = (8.0, 47.0);
/// Side of a pixel, degrees.
pub(super) const STEP: f64 = 0.001;

/// A file of `width` × `height` pixels.
#[derive(Clone)]
pub(super) struct Made {
    pub width: u16,
    pub height: u16,
    /// Bits of a sample.
    pub bits: u16,
    /// 1 whole, 2 with a sign, 3 real.
    pub format: u16,
    /// Samples of a pixel.
    pub samples: u16,
    /// 1 grey, 2 colours.
    pub photometric: u16,
    /// All samples, least significant byte first.
    pub bytes: Vec<u8>,
    /// Keys after those of WGS 84: number and value.
    pub keys: Vec<(u16, u16)>,
    /// Tag, type and values as bytes.
    pub more: Vec<(u16, u16, Vec<u8>)>,
    /// Minor revision of the keys: 0 of `GeoTIFF` 1.0, 1 of 1.1.
    pub minor: u16,
    /// Third numbers of the pixel's size, of the tie in the picture and on the ground.
    pub third: [f64; 3],
    /// Code of the geographic system.
    pub geographic: u16,
}

impl Made {
    /// Four by four posts of one band, all with the sample of `bytes`.
    pub fn level(bits: u16, format: u16, sample: &[u8]) -> Self {
        Self {
            width: 4,
            height: 4,
            bits,
            format,
            samples: 1,
            photometric: 1,
            bytes: sample.repeat(16),
            keys: Vec::new(),
            more: Vec::new(),
            minor: 0,
            third: [0.0; 3],
            geographic: 4326,
        }
    }

    /// The same with the metadata of GDAL: name, index of the band, role, value.
    pub fn with_items(mut self, items: &[(&str, usize, &str, &str)]) -> Self {
        let items = items.iter().map(|(name, band, role, value)| {
            format!("<Item name=\"{name}\" sample=\"{band}\" role=\"{role}\">{value}</Item>\n")
        });
        let text = format!(
            "<GDALMetadata>\n<Item name=\"AREA\">9</Item>\n{}</GDALMetadata>\n\0",
            items.collect::<String>()
        );
        self.more.push((42_112, 2, text.into_bytes()));
        self
    }

    /// The file.
    pub fn write(&self) -> Vec<u8> {
        let shorts = |v: &[u16]| {
            (
                3,
                v.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>(),
            )
        };
        let doubles = |v: &[f64]| (12, v.iter().flat_map(|v| v.to_le_bytes()).collect());
        let long = |v: usize| (4, (v as u32).to_le_bytes().to_vec());
        let mut out = b"II\x2a\0\0\0\0\0".to_vec();
        out.extend(&self.bytes);
        let count = 3 + self.keys.len() as u16;
        let mut keys = vec![1, 1, self.minor, count, 1024, 0, 1, 2, 1025, 0, 1, 1];
        keys.extend([2048, 0, 1, self.geographic]);
        keys.extend(
            self.keys
                .iter()
                .flat_map(|(key, value)| [*key, 0, 1, *value]),
        );
        let [size, sample, height] = self.third;
        let tie = [0.0, 0.0, sample, CORNER.0, CORNER.1, height];
        let mut tags: Vec<(u16, (u16, Vec<u8>))> = vec![
            (256, shorts(&[self.width])),
            (257, shorts(&[self.height])),
            (258, shorts(&vec![self.bits; usize::from(self.samples)])),
            (259, shorts(&[1])),
            (262, shorts(&[self.photometric])),
            (273, long(8)),
            (277, shorts(&[self.samples])),
            (278, shorts(&[self.height])),
            (279, long(self.bytes.len())),
            (339, shorts(&vec![self.format; usize::from(self.samples)])),
            (33_550, doubles(&[STEP, STEP, size])),
            (33_922, doubles(&tie)),
            (34_735, shorts(&keys)),
        ];
        let more = self.more.iter().cloned();
        tags.extend(more.map(|(tag, kind, values)| (tag, (kind, values))));
        tags.sort_by_key(|(tag, _)| *tag);
        let mut entries = (tags.len() as u16).to_le_bytes().to_vec();
        for (tag, (kind, mut values)) in tags {
            let size = [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8][usize::from(kind)];
            entries.extend(tag.to_le_bytes());
            entries.extend(kind.to_le_bytes());
            entries.extend(((values.len() / size) as u32).to_le_bytes());
            if values.len() <= 4 {
                values.resize(4, 0);
                entries.extend(values);
            } else {
                entries.extend((out.len() as u32).to_le_bytes());
                out.extend(values);
            }
        }
        let directory = out.len() as u32;
        out[4..8].copy_from_slice(&directory.to_le_bytes());
        out.extend(entries);
        out.extend([0; 4]);
        out
    }
}
