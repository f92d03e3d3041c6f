//! A log of any size.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use pilotage_tests::logs::dataflash::{DataflashValue, DataflashWriter, Form, real, whole};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Bytes after which the log goes to disk.
const PIECE: usize = 1 << 20;

/// A kind of message: number, name, letters, columns, units, multipliers; in how many of a hundred steps
/// of a loop at 400 Hz it is written, and for how many instances.
type Kind = (
    u8,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    u32,
    u8,
);

/// Kinds of messages that a plane writes, at the rates of a log of everything.
const KINDS: [Kind; 14] = [
    (
        10,
        "IMU",
        "QBffffffIIfBBHH",
        "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz",
        "s#EEEooo--O--zz",
        "F-000000-----00",
        50,
        3,
    ),
    (
        11,
        "ATT",
        "QffffffB",
        "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw,AEKF",
        "sddddhh-",
        "F000000-",
        25,
        1,
    ),
    (
        12,
        "RATE",
        "Qffffffffffff",
        "TimeUS,RDes,R,ROut,PDes,P,POut,YDes,Y,YOut,ADes,A,AOut",
        "skk-kk-kk-oo-",
        "F?????????BB-",
        25,
        1,
    ),
    (
        13,
        "XKF1",
        "QBccCfffffffccce",
        "TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD,dPD,PN,PE,PD,GX,GY,GZ,OH",
        "s#ddhnnnnmmmkkkm",
        "F-BBB0000000BBBB",
        10,
        2,
    ),
    (
        14,
        "XKF2",
        "QBccccchhhhhhfff",
        "TimeUS,C,AX,AY,AZ,VWN,VWE,MN,ME,MD,MX,MY,MZ,IDX,IDY,IS",
        "s#---nnGGGGGG---",
        "F----BBCCCCCC---",
        10,
        2,
    ),
    (
        15,
        "XKF4",
        "QBcccccfffHBIHb",
        "TimeUS,C,SV,SP,SH,SM,SVT,errRP,OFN,OFE,FS,TS,SS,GPS,PI",
        "s#------mm-----",
        "F-------??-----",
        10,
        2,
    ),
    (
        16,
        "VIBE",
        "QBfffI",
        "TimeUS,IMU,VibeX,VibeY,VibeZ,Clip",
        "s#ooo-",
        "F-000-",
        10,
        3,
    ),
    (
        17,
        "RCIN",
        "QHHHHHHHHHHHHHH",
        RC,
        "sYYYYYYYYYYYYYY",
        "F--------------",
        10,
        1,
    ),
    (
        18,
        "RCOU",
        "QHHHHHHHHHHHHHH",
        RC,
        "sYYYYYYYYYYYYYY",
        "F--------------",
        10,
        1,
    ),
    (
        19,
        "CTUN",
        "Qccccffffff",
        "TimeUS,NavRoll,Roll,NavPitch,Pitch,ThO,RdO,ThD,As,AsT,SAs",
        "sdddd---nnn",
        "FBBBB---000",
        10,
        1,
    ),
    (
        20,
        "MAG",
        "QBhhhhhhhhhBI",
        "TimeUS,I,MagX,MagY,MagZ,OfsX,OfsY,OfsZ,MOX,MOY,MOZ,Health,S",
        "s#GGGGGGGGG-s",
        "F-CCCCCCCCC-F",
        3,
        2,
    ),
    (
        21,
        "BARO",
        "QBfffcfIffB",
        "TimeUS,I,Alt,AltAMSL,Press,Temp,CRt,SMS,Offset,GndTemp,H",
        "s#mmPOnsmO-",
        "F-00000C?0-",
        3,
        2,
    ),
    (
        22,
        "GPS",
        "QBBIHBcLLeffffB",
        "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U",
        "s#-s-S-DUmnhnh-",
        "F--C-0BGGB000--",
        2,
        2,
    ),
    (
        23,
        "BAT",
        "QBfffffcfB",
        "TimeUS,Inst,Volt,VoltR,Curr,CurrTot,EnrgTot,Temp,Res,RemPct",
        "s#vvAaXOw%",
        "F-000C?000",
        2,
        1,
    ),
];

const RC: &str = "TimeUS,C1,C2,C3,C4,C5,C6,C7,C8,C9,C10,C11,C12,C13,C14";

const UNITS: [(char, &str); 22] = [
    ('-', ""),
    ('#', "instance"),
    ('s', "s"),
    ('d', "deg"),
    ('h', "degheading"),
    ('k', "deg/s"),
    ('D', "deglatitude"),
    ('U', "deglongitude"),
    ('E', "rad/s"),
    ('m', "m"),
    ('n', "m/s"),
    ('o', "m/s/s"),
    ('O', "degC"),
    ('P', "Pa"),
    ('G', "Gauss"),
    ('S', "satellites"),
    ('Y', "us"),
    ('z', "Hz"),
    ('v', "V"),
    ('A', "A"),
    ('a', "Ah"),
    ('%', "%"),
];

const MULTIPLIERS: [(char, f64); 8] = [
    ('-', 0.0),
    ('?', 1.0),
    ('0', 1.0),
    ('A', 0.1),
    ('B', 0.01),
    ('C', 0.001),
    ('F', 1e-6),
    ('G', 1e-7),
];

/// Streams a log of about `megabytes` to `path`.
pub fn write(path: &Path, megabytes: u64) -> Result<(), Box<dyn std::error::Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut file = BufWriter::new(File::create(path)?);
    let mut writer = DataflashWriter::new(Form::Binary);
    for (number, name, letters, columns, ..) in KINDS {
        writer.announce(number, name, letters, columns);
    }
    writer.tables(1_000_000, &UNITS, &MULTIPLIERS);
    for (number, _, _, _, units, multipliers, ..) in KINDS {
        writer.labels(1_000_000, number, units, multipliers);
    }
    let (mut step, mut written, mut rows) = (0_u64, 0_u64, 0_u64);
    while written < megabytes * 1_000_000 {
        for (number, _, letters, _, units, _, percent, instances) in KINDS {
            let phase = (step + u64::from(number)) % 100;
            if phase * u64::from(percent) % 100 >= u64::from(percent) {
                continue;
            }
            let has_instances = units.contains('#');
            for instance in 0..instances {
                let time = 1_000_000 + 2500 * step + u64::from(instance);
                let values = values(
                    letters,
                    time,
                    has_instances.then_some(instance),
                    &mut random,
                );
                writer.row(number, &values);
                rows += 1;
            }
        }
        step += 1;
        if writer.bytes.len() > PIECE {
            written += writer.bytes.len() as u64;
            file.write_all(&writer.bytes)?;
            writer.bytes.clear();
        }
    }
    file.flush()?;
    println!(
        "{rows} messages, {:.0} MB, {:.0} s of flight",
        written as f64 / 1e6,
        step as f64 / 400.0
    );
    Ok(())
}

/// A row: time, instance where there are several, and numbers that fit.
fn values(
    letters: &str,
    time: u64,
    instance: Option<u8>,
    random: &mut ChaCha8Rng,
) -> Vec<DataflashValue> {
    let number = |(i, letter): (usize, char)| match (letter, instance) {
        ('Q', _) => whole(time),
        ('B', Some(instance)) if i == 1 => whole(instance),
        ('f', _) => real(random.random_range(-50.0..50.0_f64)),
        ('B' | 'b', _) => whole(random.random_range(0..100_u8)),
        ('c' | 'C' | 'h' | 'H', _) => whole(random.random_range(0..2200_u16)),
        _ => whole(random.random_range(0..100_000_000_u32)),
    };
    letters.chars().enumerate().map(number).collect()
}
