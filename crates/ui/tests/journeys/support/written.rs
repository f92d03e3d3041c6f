//! A small flight that is written into files: all of its numbers are the same on every machine.

use nalgebra::{Point3, Vector2};
use pilotage_core::camera::CameraModel;
use pilotage_core::flight::files::ZipSink;
use pilotage_core::flight::{
    Channel, ChannelName, Flight, Frame, FrameError, FrameSource, FrameTruth, StartFix, Truth,
    TruthState, write_flight,
};
use pilotage_core::frames::{Attitude, Geodetic, GroundPoint, LocalFrame};
use pilotage_core::raster::Picture;

/// Pictures of one grey each.
struct Greys;

/// The grey of a frame.
pub fn grey(index: usize) -> [u8; 3] {
    [60 * index as u8; 3]
}

impl FrameSource for Greys {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        Ok(Picture::filled(4, 3, grey(index)))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::RgbImage::from_pixel(4, 3, image::Rgb(grey(index)))
            .write_to(&mut bytes, image::ImageFormat::Png)
            .expect("memory can be written to");
        Ok(bytes.into_inner())
    }
}

fn channels(times: &[f64]) -> Vec<Channel> {
    let channel = |name, value: &dyn Fn(f64) -> f64| Channel {
        name,
        values: times.iter().map(|t| value(*t)).collect(),
        times: times.to_vec(),
    };
    vec![
        channel(ChannelName::Airspeed, &|t| 18.0 + t / 3.0),
        channel(ChannelName::Heading, &|t| 0.3 + t / 7.0),
        Channel {
            name: ChannelName::GpsNorth,
            times: vec![0.0, 1.0 / 3.0],
            values: vec![1e-7, -4.2],
        },
    ]
}

fn truth(times: &[f64]) -> Truth {
    let state = |time: &f64| TruthState {
        time: *time,
        position: Point3::new(18.0 * time, 0.1, -100.0 / 3.0),
        attitude: Some(Attitude::level(0.3 + time / 7.0)),
        wind: (*time < 1.0).then(|| Vector2::new(3.0, -1.0 / 3.0)),
    };
    let frame = |index: i32| FrameTruth {
        position: Point3::new(f64::from(index) / 9.0, 2.0, -33.0),
        camera_attitude: (index != 2).then(|| Attitude::level(0.1)),
    };
    Truth {
        states: times.iter().map(state).collect(),
        frames: (0..3).map(frame).collect(),
    }
}

/// The flight, with three frames.
pub fn flight() -> Flight {
    let times: Vec<f64> = (0..30).map(|i| f64::from(i) / 20.0).collect();
    let frame = |index: i32| Frame {
        time: 0.5 * f64::from(index),
        name: format!("a {index}.png"),
        stored_turn: if index == 1 {
            std::f64::consts::PI
        } else {
            0.0
        },
    };
    Flight {
        name: "Stored, \"once\"".to_owned(),
        frame_on_globe: Some(LocalFrame::new(Geodetic::from_degrees(45.0, -30.0, 12.0))),
        camera: CameraModel::of_focal(640, 480, 500.0),
        ground_down: 0.25,
        channels: channels(&times),
        frames: (0..3).map(frame).collect(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::new(1.0 / 7.0, -3.0),
            standard_deviation: 3.0,
        },
        truth: Some(truth(&times)),
    }
}

/// The flight as a zip of its folder.
pub fn zip() -> Vec<u8> {
    let mut sink = ZipSink::default();
    write_flight(&flight(), Some(&mut Greys), &mut sink, &mut |_, _| true).expect("memory");
    sink.finish().expect("memory")
}
