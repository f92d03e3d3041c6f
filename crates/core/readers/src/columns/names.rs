//! Meanings of the names of columns.

use pilotage_base::sorting::sort;
use std::collections::HashMap;
use std::sync::LazyLock;

use super::ColumnRole;
use pilotage_flight::ChannelName;

/// Words that a column may be called by, what it is then, how surely, and the sign of its values.
struct Rule {
    role: ColumnRole,
    sign: f64,
    confidence: f64,
    /// Names, their words apart; several between bars.
    names: &'static str,
}

const fn rule(role: ColumnRole, confidence: f64, names: &'static str) -> Rule {
    Rule {
        role,
        sign: 1.0,
        confidence,
        names,
    }
}

const fn turned(role: ColumnRole, confidence: f64, names: &'static str) -> Rule {
    Rule {
        role,
        sign: -1.0,
        confidence,
        names,
    }
}

use ColumnRole::{
    Channel, Course, Latitude, Longitude, SpeedOverGround, Time, WindFrom, WindSpeed,
};

const RULES: &[Rule] = &[
    rule(
        Time,
        0.95,
        "time|timestamp|time stamp|datetime|date time|log time|utc time|gps time|unix time|gps unix time|timpstemp|t|t s|t ms|t us|t ns|t sec|elapsed|elapsed time",
    ),
    rule(
        Time,
        0.8,
        "tow|gps tow|itow|gps itow|time of week|time of day|tod|utc|clock|seconds|secs|sec|millis|milliseconds|micros|s|ms|us|flight time|boot time|time boot|date",
    ),
    // `Clock:offsetTime` of DatCon: seconds since the start, beside ticks of 4.5 MHz.
    rule(Time, 0.95, OFFSET_TIME),
    rule(
        Latitude,
        0.98,
        "latitude|lat|gps lat|gps latitude|gps coord 0",
    ),
    // Beside it stands the geocentric one, up to 21 km off.
    rule(
        Latitude,
        0.99,
        "latitude geodetic|geodetic latitude|lat geod|geod lat",
    ),
    rule(
        Longitude,
        0.98,
        "longitude|lon|lng|long|gps lon|gps lng|gps longitude|gps coord 1",
    ),
    rule(
        SpeedOverGround,
        0.9,
        "ground speed|groundspeed|gnd spd|gnd speed|speed over ground|sog|gspd|gs|g spd|gps speed|gps spd|vtrue ktgs|g speed",
    ),
    rule(SpeedOverGround, 0.5, "spd|speed|velocity|kts"),
    rule(
        Course,
        0.9,
        "course|cog|ground course|course over ground|gcrs|crs|track|trk|ground track|gps course|gps track|track angle|head mot|hpath",
    ),
    rule(Course, 0.95, "track by variation"),
    rule(Course, 0.6, "direction|location orientation"),
    rule(
        Channel(ChannelName::Airspeed),
        0.95,
        "airspeed|air speed|tas|true airspeed|true air speed|arspd|aspd|vtas|vtrue ktas",
    ),
    rule(
        Channel(ChannelName::EquivalentAirspeed),
        0.9,
        "ias|cas|eas|indicated airspeed|calibrated airspeed|equivalent airspeed|indicated air speed|veas|vias|vind kias",
    ),
    rule(
        Channel(ChannelName::Heading),
        0.95,
        "heading|yaw|hdg|true heading|psi|yaw angle|heading angle|bearing|hding true|yaw360",
    ),
    rule(
        Channel(ChannelName::Heading),
        0.98,
        "true heading by variation",
    ),
    rule(
        Channel(ChannelName::Heading),
        0.7,
        "azimuth|compass|mag heading|magnetic heading|gimbal yaw|flight yaw",
    ),
    rule(
        Channel(ChannelName::Roll),
        0.95,
        "roll|roll angle|bank|bank angle|phi",
    ),
    rule(
        Channel(ChannelName::Pitch),
        0.95,
        "pitch|ptch|pitch angle|theta",
    ),
    rule(
        Channel(ChannelName::HeightAboveGround),
        0.9,
        "height above ground|agl|alt agl|altitude agl|height agl|altitude above ground|rangefinder|range finder|sonar|lidar",
    ),
    rule(
        Channel(ChannelName::HeightAboveGround),
        0.7,
        "rel alt|alt rel|altitude rel|height rel|relative alt|relative altitude|altitude relative|height above takeoff|height above take off|height|dist bottom",
    ),
    turned(
        Channel(ChannelName::HeightAboveGround),
        0.6,
        "down|position down|down position|pos d|pd|z down",
    ),
    rule(
        Channel(ChannelName::BarometricHeight),
        0.9,
        "baro alt|baro altitude|baro height|barometric altitude|barometric height|baro|pressure altitude|press alt|baroaltitude|alt baro|bmp alt|bmp altitude|bme alt|bme altitude",
    ),
    rule(
        Channel(ChannelName::GpsHeight),
        0.9,
        "gps alt|gps altitude|gps height|alt msl|altitude msl|amsl|alt amsl|msl|height msl|altitude amsl|g alt|galt|geoaltitude|geo altitude|alt geom|geometric altitude|h sl|altitude above sea level|height above sea level|elevation above sea level|altitude above mean sea level|height above mean sea level|altitude asl|alt asl|height asl|asl",
    ),
    rule(
        Channel(ChannelName::GpsHeight),
        0.6,
        "alt|altitude|hgt|h|elevation|elev|alt hae|altitude hae|height hae|hae|feet|abs alt|absolute altitude|ellipsoid height|ellipsoidal height|h ell|height ell|height ellipsoid|altitude ellipsoid|alt ellipsoid|height above ellipsoid",
    ),
    rule(
        Channel(ChannelName::GpsNorth),
        0.8,
        "gps north|north|position north|pos n|pn|x north|north position|n baseline",
    ),
    rule(
        Channel(ChannelName::GpsEast),
        0.8,
        "gps east|east|position east|pos e|pe|y east|east position|e baseline",
    ),
    rule(
        Channel(ChannelName::GpsVelocityNorth),
        0.9,
        "velocity north|vel n|vel ned n|velocity n|vn|north velocity|vel north|gps velocity north|v n|v north|speed north",
    ),
    rule(
        Channel(ChannelName::GpsVelocityEast),
        0.9,
        "velocity east|vel e|vel ned e|velocity e|ve|east velocity|vel east|gps velocity east|v e|v east|speed east",
    ),
    rule(
        Channel(ChannelName::GpsVelocityDown),
        0.9,
        "velocity down|vel d|vel ned d|velocity d|vd|down velocity|vel down|gps velocity down|sink rate|v d|v down|speed down",
    ),
    rule(
        Channel(ChannelName::GpsVelocityDown),
        0.6,
        "vz|v z|vel z|velocity z",
    ),
    turned(
        Channel(ChannelName::GpsVelocityDown),
        0.8,
        "climb|climb rate|rocd|vertical speed|vspeed|vario|vspd|v spd|vel u|velocity up|vel up|roc|v up|vu",
    ),
    rule(
        Channel(ChannelName::RollRate),
        0.9,
        "roll rate|p|gyr x|gyro x|gyros x|rollspeed|roll speed|angular velocity x|omega x|wx|xgyro|rate x|gx|w x|phi dot",
    ),
    rule(
        Channel(ChannelName::PitchRate),
        0.9,
        "pitch rate|q|gyr y|gyro y|gyros y|pitchspeed|pitch speed|angular velocity y|omega y|wy|ygyro|rate y|gy|w y",
    ),
    rule(
        Channel(ChannelName::YawRate),
        0.9,
        "yaw rate|r|gyr z|gyro z|gyros z|yawspeed|yaw speed|angular velocity z|omega z|wz|zgyro|rate z|gz|w z|turn rate",
    ),
    rule(
        Channel(ChannelName::AccelerationForward),
        0.9,
        "acc x|accel x|acceleration x|accelerometer x|linear acceleration x|ax|xacc|a x|acceleration forward|accx",
    ),
    rule(
        Channel(ChannelName::AccelerationRight),
        0.9,
        "acc y|accel y|acceleration y|accelerometer y|linear acceleration y|ay|yacc|a y|acceleration right|accy",
    ),
    rule(
        Channel(ChannelName::AccelerationDown),
        0.9,
        "acc z|accel z|acceleration z|accelerometer z|linear acceleration z|az|zacc|a z|acceleration down|accz",
    ),
    rule(
        Channel(ChannelName::WindNorth),
        0.9,
        "wind north|wind n|wind v north|wn|vwn|wind velocity north|wind vel n|windspeed north|wind speed north",
    ),
    rule(
        Channel(ChannelName::WindEast),
        0.9,
        "wind east|wind e|wind v east|we|vwe|wind velocity east|wind vel e|windspeed east|wind speed east",
    ),
    rule(
        WindSpeed,
        0.9,
        "wind speed|wind spd|windspeed|wind strength|wind velocity|wspd|wind magnitude",
    ),
    rule(
        WindFrom,
        0.9,
        "wind direction|wind dir|wind from|wind bearing|wind angle|wdir|wind heading|winddir|wind course|wind azimuth|wind to",
    ),
    rule(Time, 0.9, "unix|epoch|posix"),
    // German, French and Spanish: who writes decimal commas writes names of their own, too.
    rule(
        Time,
        0.9,
        "zeit|uhrzeit|zeitstempel|heure|horodatage|temps|hora|tiempo|fecha",
    ),
    rule(Latitude, 0.9, "breite|breitengrad|latitud"),
    rule(
        Longitude,
        0.9,
        "länge|laenge|längengrad|laengengrad|longitud",
    ),
    rule(
        SpeedOverGround,
        0.9,
        "geschwindigkeit über grund|gps geschwindigkeit|gps geschw|vitesse sol|vitesse gps|velocidad gps|velocidad suelo",
    ),
    rule(SpeedOverGround, 0.5, "geschwindigkeit|vitesse|velocidad"),
    rule(Course, 0.8, "kurs|rumbo|flugrichtung|kurs über grund"),
    rule(Course, 0.6, "route"),
    rule(Channel(ChannelName::Heading), 0.5, "cap"),
    rule(
        Channel(ChannelName::Heading),
        0.9,
        "gierwinkel|steuerkurs|lacet",
    ),
    rule(
        Channel(ChannelName::Roll),
        0.9,
        "rollwinkel|querneigung|roulis|alabeo",
    ),
    rule(
        Channel(ChannelName::Pitch),
        0.9,
        "nickwinkel|längsneigung|tangage|cabeceo",
    ),
    rule(
        Channel(ChannelName::Airspeed),
        0.9,
        "fluggeschwindigkeit|vitesse air|velocidad aire",
    ),
    turned(
        Channel(ChannelName::GpsVelocityDown),
        0.8,
        "steigen|steigrate|steiggeschwindigkeit|vitesse verticale|velocidad vertical",
    ),
    rule(
        Channel(ChannelName::HeightAboveGround),
        0.9,
        "höhe über grund|höhe ü grund|hoehe ueber grund|hauteur sol|altura sobre el suelo",
    ),
    rule(Channel(ChannelName::HeightAboveGround), 0.7, "hauteur"),
    rule(
        Channel(ChannelName::GpsHeight),
        0.9,
        "gps höhe|gps hoehe|höhe gps|höhe über nn|höhe ü nn|höhe über meer|altitude gps|gps altitud|altitud gps",
    ),
    rule(
        Channel(ChannelName::GpsHeight),
        0.6,
        "höhe|hoehe|altitud|altura",
    ),
];

/// Names of a time that counts from the start of a log.
const OFFSET_TIME: &str = "offset time|clock offset time";

/// Words with which a column is about something else than what was measured.
const OTHERWISE: [&str; 44] = [
    "geocentric",
    "gc",
    "desired",
    "des",
    "target",
    "setpoint",
    "sp",
    "cmd",
    "command",
    "commanded",
    "demanded",
    "dem",
    "ref",
    "reference",
    "error",
    "err",
    "std",
    "stddev",
    "sigma",
    "var",
    "variance",
    "cov",
    "accuracy",
    "bias",
    "offset",
    "min",
    "max",
    "trim",
    "home",
    "count",
    "status",
    "nav",
    "covariance",
    "setpoints",
    "errors",
    "innov",
    "innovation",
    "residual",
    "goal",
    "estimator",
    "limits",
    "delta",
    "diff",
    "difference",
];

/// Meaning that a name may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NameGuess {
    pub role: ColumnRole,
    /// -1 where values count the other way.
    pub sign: f64,
    /// Confidence, 0 to 1.
    pub confidence: f64,
}

/// The rules by the names they know, and how many words the longest of these has.
struct Lexicon {
    rules_of: HashMap<&'static str, Vec<usize>>,
    longest: usize,
}

static LEXICON: LazyLock<Lexicon> = LazyLock::new(|| {
    let mut rules_of: HashMap<&'static str, Vec<usize>> = HashMap::new();
    for (index, rule) in RULES.iter().enumerate() {
        for name in rule.names.split('|') {
            rules_of.entry(name).or_default().push(index);
        }
    }
    let words = |name: &&str| name.split(' ').count();
    let longest = rules_of.keys().map(words).max().unwrap_or(0);
    Lexicon { rules_of, longest }
});

/// Whether words say that a column is about something else than what was measured.
pub(super) fn is_otherwise(words: &[String]) -> bool {
    let plain = |word: &String| {
        word.trim_end_matches(|c: char| c.is_ascii_digit())
            .to_owned()
    };
    let mut words = words.iter().map(plain);
    words.any(|word| OTHERWISE.contains(&word.as_str()))
}

/// Everything that a name of these words may mean, the likeliest first.
pub(super) fn meanings(words: &[String]) -> Vec<NameGuess> {
    let is_of_camera = |word: &String| ["gimbal", "camera", "mount"].contains(&word.as_str());
    let is_from_start = OFFSET_TIME.split('|').any(|name| name == words.join(" "));
    let doubt = if is_otherwise(words) && !is_from_start {
        0.3
    } else if words.iter().any(is_of_camera) {
        0.75
    } else {
        1.0
    };
    let shares = shares(words);
    let mut found: Vec<NameGuess> = RULES
        .iter()
        .zip(shares)
        .filter(|&(_, share)| share > 0.0)
        .map(|(rule, share)| NameGuess {
            role: rule.role,
            sign: rule.sign,
            confidence: rule.confidence * doubt * (0.5 + 0.5 * share),
        })
        .collect();
    sort(&mut found, &|a, b| b.confidence.total_cmp(&a.confidence));
    let mut seen = Vec::new();
    found.retain(|guess| {
        let is_new = !seen.contains(&guess.role);
        seen.push(guess.role);
        is_new
    });
    found
}

/// The share of the letters of `words` that each rule's longest name among them has, whose words have to stand
/// together; 0 where there is none. Single letters have to be all there is.
fn shares(words: &[String]) -> [f64; RULES.len()] {
    let letters = |words: &[String]| words.iter().map(String::len).sum::<usize>();
    let all = letters(words) as f64;
    let mut shares = [0.0_f64; RULES.len()];
    for count in 1..=LEXICON.longest.min(words.len()) {
        for window in words.windows(count) {
            let is_enough = count > 1 || count == words.len() || letters(window) > 2;
            let Some(rules) = LEXICON.rules_of.get(window.join(" ").as_str()) else {
                continue;
            };
            for &rule in rules.iter().filter(|_| is_enough) {
                shares[rule] = shares[rule].max(letters(window) as f64 / all);
            }
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    fn best(words: &str) -> Option<ColumnRole> {
        let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
        meanings(&words).first().map(|guess| guess.role)
    }

    #[test]
    fn the_longest_name_says_what_a_column_is() {
        assert_eq!(best("roll"), Some(Channel(ChannelName::Roll)));
        assert_eq!(best("imu roll rate"), Some(Channel(ChannelName::RollRate)));
        assert_eq!(best("gps ground speed"), Some(SpeedOverGround));
        assert_eq!(best("true airspeed"), Some(Channel(ChannelName::Airspeed)));
        assert_eq!(
            best("indicated airspeed"),
            Some(Channel(ChannelName::EquivalentAirspeed))
        );
        assert_eq!(
            best("rel alt"),
            Some(Channel(ChannelName::HeightAboveGround))
        );
        assert_eq!(best("gps alt"), Some(Channel(ChannelName::GpsHeight)));
        assert_eq!(
            best("velocity north"),
            Some(Channel(ChannelName::GpsVelocityNorth))
        );
        assert_eq!(best("p"), Some(Channel(ChannelName::RollRate)));
        assert_eq!(best("servo p"), None);
        assert_eq!(best("battery voltage"), None);
    }

    #[test]
    fn what_was_wanted_is_less_likely_than_what_was_measured() {
        let confidence = |words: &str| {
            let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
            meanings(&words)[0].confidence
        };
        assert!(confidence("des roll") < 0.5 * confidence("roll"));
        assert!(confidence("att roll") < confidence("roll"));
    }
}
