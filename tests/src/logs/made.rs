//! Whole small logs, made from a seed.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::dataflash::{DataflashValue, DataflashWriter, Form, real, text, whole};

/// The units of `ArduPilot` that are used here.
const UNITS: [(char, &str); 14] = [
    ('-', ""),
    ('?', "UNKNOWN"),
    ('#', "instance"),
    ('s', "s"),
    ('d', "deg"),
    ('D', "deglatitude"),
    ('U', "deglongitude"),
    ('h', "degheading"),
    ('E', "rad/s"),
    ('m', "m"),
    ('n', "m/s"),
    ('o', "m/s/s"),
    ('v', "V"),
    ('i', "A.s"),
];

/// Its multipliers; real logs have them in single precision.
const MULTIPLIERS: [(char, f32); 13] = [
    ('-', 0.0),
    ('?', 1.0),
    ('2', 1e2),
    ('1', 1e1),
    ('0', 1e0),
    ('A', 1e-1),
    ('B', 1e-2),
    ('C', 1e-3),
    ('D', 1e-4),
    ('F', 1e-6),
    ('G', 1e-7),
    ('!', 3.6),
    ('/', 3600.0),
];

const PARAMETER: u8 = 64;
const MESSAGE: u8 = 65;
const MODE: u8 = 66;
const RECEIVER: u8 = 67;
const INERTIAL: u8 = 68;
const BATTERY: u8 = 69;
const MISSION: u8 = 70;
const PIECE: u8 = 71;
const NAMED: u8 = 72;
const NUMBERS: u8 = 73;
const SCALED: u8 = 74;
const ARRAY: u8 = 75;
const HEIGHT: u8 = 76;

/// Announces every kind of message of [`modern`]: number, name, letters, columns, units, multipliers.
fn announce(writer: &mut DataflashWriter, time: u64) {
    type Kind = (
        u8,
        &'static str,
        &'static str,
        &'static str,
        &'static str,
        &'static str,
    );
    let kinds: [Kind; 13] = [
        (
            PARAMETER,
            "PARM",
            "QNff",
            "TimeUS,Name,Value,Default",
            "s---",
            "F---",
        ),
        (MESSAGE, "MSG", "QZ", "TimeUS,Message", "s-", "F-"),
        (
            MODE,
            "MODE",
            "QMBB",
            "TimeUS,Mode,ModeNum,Rsn",
            "s---",
            "F---",
        ),
        (
            RECEIVER,
            "GPS",
            "QBBIHBcLLeffffB",
            "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U",
            "s#-s-S-DUmnhnh-",
            "F--C-0BGGB000--",
        ),
        (
            INERTIAL,
            "IMU",
            "QBffffffIIfBBHH",
            "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz",
            "s#EEEooo--O--zz",
            "F-000000-----00",
        ),
        (
            BATTERY,
            "BAT",
            "QBfhHi",
            "TimeUS,Inst,Volt,Curr,CurrTot,EnrgTot",
            "s#vv?i",
            "F-0A/!",
        ),
        (
            MISSION,
            "CMD",
            "QHHHffffLLfB",
            "TimeUS,CTot,CNum,CId,Prm1,Prm2,Prm3,Prm4,Lat,Lng,Alt,Frame",
            "s-------DUm-",
            "F-------GG0-",
        ),
        (
            PIECE,
            "FILE",
            "NIBZ",
            "FileName,Offset,Length,Data",
            "----",
            "----",
        ),
        (NAMED, "NVF", "QNf", "TimeUS,Name,Value", "s#-", "F-0"),
        (
            NUMBERS,
            "LETN",
            "QbBhHiIqfdgM",
            "TimeUS,b,B,h,H,i,I,q,f,d,g,M",
            "smmmmmmmmmm-",
            "FABCD12BAB0-",
        ),
        (
            SCALED,
            "LETS",
            "QcCeELnNZ",
            "TimeUS,c,C,e,E,L,n,N,Z",
            "sdddmD---",
            "FBBBCG---",
        ),
        (ARRAY, "ISBD", "QHa", "TimeUS,N,x", "s-o", "F-B"),
        (HEIGHT, "BARO", "QBf", "TimeUS,I,Alt", "s#m", "F-0"),
    ];
    for (number, name, letters, columns, ..) in kinds {
        writer.announce(number, name, letters, columns);
    }
    let multipliers = MULTIPLIERS.map(|(letter, factor)| (letter, f64::from(factor)));
    writer.tables(time, &UNITS, &multipliers);
    for (number, .., units, multipliers) in kinds {
        writer.labels(time, number, units, multipliers);
    }
}

/// A log with every letter, units, multipliers and instances; after its announcements `rows` rows of
/// sensors.
pub fn modern(form: Form, seed: u64, rows: usize) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut writer = DataflashWriter::new(form);
    let mut time = 4_000_000_u64;
    announce(&mut writer, time);
    let mut next = || {
        time += 1250;
        whole(time)
    };
    beginning(&mut writer, &mut next);
    letters(&mut writer, &mut next, &mut random);
    for i in 0..rows {
        sensor(i, &mut writer, next(), &mut random);
    }
    writer.row(MODE, &[next(), whole(11), whole(11), whole(3)]);
    writer.bytes
}

/// Latitude and longitude of the first fix, ten-millionths of a degree.
const PLACE: [i32; 2] = [-379_596_764, 1_447_648_038];

/// Parameters, words, a mission and a piece of a file.
fn beginning(writer: &mut DataflashWriter, next: &mut impl FnMut() -> DataflashValue) {
    for (name, value) in [("ARSPD_RATIO", 1.75), ("SYSID_THISMAV", 7.0)] {
        let values = [next(), text(name), real(value), real(f64::NAN)];
        writer.row(PARAMETER, &values);
    }
    writer.row(MODE, &[next(), whole(16), whole(16), whole(1)]);
    for said in ["ArduPlane V4.5.7 (0123abcd)", "a, b and °C"] {
        writer.row(MESSAGE, &[next(), text(said)]);
    }
    for i in 0..3 {
        let [latitude, longitude] = PLACE.map(|p| whole(p + 1000 * i));
        let order = [next(), whole(3), whole(i), whole(16)];
        let parameters = [0.0, 1.5, -2.0, 0.0].map(real);
        let goal = [latitude, longitude, real(100.5), whole(3)];
        writer.row(MISSION, &[order, parameters, goal].concat());
    }
    let name = text("@SYS/uarts.txt");
    writer.row(PIECE, &[name, whole(0), whole(9), text("UARTV1 OK")]);
}

/// A row of one of the sensors in turn.
fn sensor(i: usize, writer: &mut DataflashWriter, time: DataflashValue, random: &mut ChaCha8Rng) {
    let mut some = |size: f64| real(size * (random.random::<f64>() - 0.5));
    let instance = whole((i % 3) as u32);
    match i % 7 {
        0..3 => {
            let motion = [2.0, 2.0, 2.0, 20.0, 20.0, 20.0].map(&mut some);
            let health = [whole(1), whole(1), whole(1000), whole(1000)];
            let errors = [whole(0), whole(0), some(60.0)];
            let start = [time, instance];
            writer.row(INERTIAL, &[&start[..], &motion, &errors, &health].concat());
        }
        3 => writer.row(HEIGHT, &[time, instance, some(200.0)]),
        4 => {
            let name = ["rpm", "load", "a b"][i / 7 % 3];
            writer.row(NAMED, &[time, text(name), some(9.0)]);
        }
        5 => {
            let start = [time, instance, some(24.0)];
            let charge = [whole(i as i16 - 9), whole(i as u16), whole(-(i as i32))];
            writer.row(BATTERY, &[start, charge].concat());
        }
        _ => {
            let start = [time, whole((i / 7 % 2) as u32), whole(3)];
            let date = [whole(200_000 + 200 * i as u32), whole(2250)];
            let fix = [whole(14), whole(85)];
            let place = PLACE.map(|p| whole(p + i as i32));
            let motion = [30.0, 360.0, 2.0, 90.0].map(&mut some);
            let end = [whole(1)];
            let height = [whole(12_345 + i as i32)];
            let row = [&start[..], &date, &fix, &place, &height, &motion, &end].concat();
            writer.row(RECEIVER, &row);
        }
    }
}

/// Rows of every letter: smallest, largest and drawn values.
fn letters(
    writer: &mut DataflashWriter,
    next: &mut impl FnMut() -> DataflashValue,
    random: &mut ChaCha8Rng,
) {
    let mut words = vec![0, u64::MAX, 1 << 63 | 1 << 31 | 1 << 15 | 1 << 7];
    words.extend((0..8).map(|_| random.random::<u64>()));
    for word in words {
        let signed = [
            whole(word as i8),
            whole(word as u8),
            whole(word as i16),
            whole(word as u16),
            whole(word as i32),
            whole(word as u32),
            whole(word as i64),
        ];
        let reals = [
            real(f32::from_bits(word as u32)),
            real(f64::from_bits(word)),
            DataflashValue::Half(word as u16),
            whole((word % 27) as u8),
        ];
        writer.row(NUMBERS, &[&[next()], &signed[..], &reals].concat());
        let [_, _, c, upper_c, e, upper_e, _] = signed;
        let texts = [
            text("full"),
            text("sixteen letters."),
            text(&format!("text {word}")),
        ];
        let scaled = [c, upper_c, e.clone(), upper_e, e];
        writer.row(SCALED, &[&[next()], &scaled[..], &texts].concat());
        let array = std::array::from_fn(|i| (word >> i) as i16);
        writer.row(
            ARRAY,
            &[next(), whole(word as u16), DataflashValue::Array(array)],
        );
    }
}

/// A log as `ArduPlane` wrote it in 2013: milliseconds, no units, no instances.
pub fn of_2013(form: Form, rows: u32) -> Vec<u8> {
    let mut writer = DataflashWriter::new(form);
    let columns = "Status,TimeMS,Week,NSats,HDop,Lat,Lng,RelAlt,Alt,Spd,GCrs,VZ,T";
    writer.announce(130, "GPS", "BIHBcLLeeEefI", columns);
    writer.announce(1, "ATT", "IccCCC", "TimeMS,Roll,Pitch,Yaw,ErrorRP,ErrorYaw");
    writer.announce(3, "IMU", "Iffffff", "TimeMS,GyrX,GyrY,GyrZ,AccX,AccY,AccZ");
    writer.announce(4, "MODE", "IMB", "TimeMS,Mode,ModeNum");
    writer.announce(129, "PARM", "Nf", "Name,Value");
    writer.announce(134, "MSG", "Z", "Message");
    writer.row(134, &[text("ArduPlane V2.76 (1d6a22f3)")]);
    writer.row(129, &[text("ARSPD_RATIO"), real(1.994)]);
    writer.row(4, &[whole(13_177), whole(0), whole(0)]);
    for i in 0..rows {
        let time = 13_178 + 20 * i;
        let angle = (100.0 * (0.1 * f64::from(i)).sin()) as i32;
        let attitude = [angle, -angle, 19_880 - angle, 0, 12].map(whole);
        writer.row(1, &[&[whole(time)], &attitude[..]].concat());
        let rates = [0.001, -0.0004, 2e-6, 0.76, -0.06, -9.58].map(real);
        writer.row(3, &[&[whole(time)], &rates[..]].concat());
        if i % 10 == 5 {
            let place = [-379_596_764 + angle, 1_447_648_038, 5, 1578];
            let start = [
                whole(3),
                whole(511_214_500 + 20 * i),
                whole(1768),
                whole(7),
                whole(199),
            ];
            let motion = [whole(203), whole(27_885), real(2.98), whole(time + 3)];
            writer.row(130, &[&start[..], &place.map(whole), &motion].concat());
        }
    }
    writer.row(4, &[whole(49_281), whole(11), whole(11)]);
    writer.bytes
}
