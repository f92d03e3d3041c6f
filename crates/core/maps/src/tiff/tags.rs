//! The tags that are read.

/// Declares tags with their numbers and the names that messages use.
macro_rules! tags {
    ($($(#[$doc:meta])* $name:ident = $number:literal,)*) => {
        /// A tag of a TIFF directory.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u16)]
        pub enum Tag {
            $($(#[$doc])* $name = $number,)*
        }

        impl Tag {
            /// Name in the specification, with the number.
            pub fn name(self) -> String {
                let name = match self {
                    $(Self::$name => stringify!($name),)*
                };
                format!("tag {name} ({})", self as u16)
            }

            /// Whether anything is done with the tag of that number.
            pub fn is_read(number: u16) -> bool {
                [$($number,)*].contains(&number)
            }
        }
    };
}

tags! {
    /// Role of the image beside another: an overview or a mask.
    NewSubfileType = 254,
    /// Pixels from left to right.
    ImageWidth = 256,
    /// Pixels from top to bottom.
    ImageLength = 257,
    /// Bits of every sample.
    BitsPerSample = 258,
    /// Compression of the pixels.
    Compression = 259,
    /// Meaning of the samples.
    PhotometricInterpretation = 262,
    /// Order of bits in a byte.
    FillOrder = 266,
    /// Places of the strips.
    StripOffsets = 273,
    /// Samples of a pixel.
    SamplesPerPixel = 277,
    /// Rows in a strip.
    RowsPerStrip = 278,
    /// Bytes of the strips.
    StripByteCounts = 279,
    /// Order of the samples of a pixel: together, or apart.
    PlanarConfiguration = 284,
    /// Storage of pixels as differences.
    Predictor = 317,
    /// Colours of a palette.
    ColorMap = 320,
    /// Pixels across a tile.
    TileWidth = 322,
    /// Pixels down a tile.
    TileLength = 323,
    /// Places of the tiles.
    TileOffsets = 324,
    /// Bytes of the tiles.
    TileByteCounts = 325,
    /// Meaning of the samples beyond the colours.
    ExtraSamples = 338,
    /// Format of the samples: whole, signed or real.
    SampleFormat = 339,
    /// Quantization and Huffman tables that all JPEG tiles share.
    JPEGTables = 347,
    /// `GeoTIFF`: size of a pixel.
    ModelPixelScale = 33_550,
    /// `GeoTIFF`: pixels and their places.
    ModelTiepoint = 33_922,
    /// `GeoTIFF`: affine map from pixels to coordinates.
    ModelTransformation = 34_264,
    /// `GeoTIFF`: the reference system, as keys.
    GeoKeyDirectory = 34_735,
    /// `GeoTIFF`: real numbers of the keys.
    GeoDoubleParams = 34_736,
    /// `GeoTIFF`: texts of the keys.
    GeoAsciiParams = 34_737,
    /// GDAL: what is known about the file and its bands, as XML.
    GdalMetadata = 42_112,
    /// GDAL: the value of pixels without data, as text.
    GdalNoData = 42_113,
    /// Version of LERC and what its bytes are packed in.
    LercParameters = 50_674,
    /// Coefficients by which the camera of a satellite places the pixels.
    RpcCoefficients = 50_844,
}
