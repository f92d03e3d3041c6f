//! `pilotage bench`: our kernels beside OpenCV's and FilterPy's, in one run.

mod cascades;
mod in_wasm;

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use pilotage_core::filter::{UnscentedSettings, reference_flight, reference_loop};
use pilotage_core::raster::{Gray, Template};

use crate::CommandResult;

/// Arguments of `pilotage bench`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Python with OpenCV and FilterPy; without it only our own times are printed.
    #[arg(long, env = "PILOTAGE_PYTHON")]
    python: Option<String>,
    /// Instead: every cascade (.xml) in the folders below this one, over the picture.
    #[arg(long, requires = "picture")]
    cascades: Option<PathBuf>,
    /// Picture that the cascades are shown.
    #[arg(long)]
    picture: Option<PathBuf>,
    /// This program built for `wasm32-wasip1`, to time the cascades in WebAssembly as well.
    #[arg(long, requires = "cascades")]
    wasm: Option<PathBuf>,
    /// Program that runs the WebAssembly.
    #[arg(long, default_value = "node")]
    node: String,
}

/// (search side, template side), pixels, as the navigator uses them.
const SIZES: [(usize, usize); 7] = [
    (48, 28),
    (72, 32),
    (96, 32),
    (128, 48),
    (160, 64),
    (200, 64),
    (256, 64),
];

/// Median of the times of `work`, microseconds.
fn median_us(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = Vec::new();
    let begun = Instant::now();
    while times.len() < 9 || (begun.elapsed().as_secs_f64() < 0.3 && times.len() < 2000) {
        let start = Instant::now();
        work();
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn scene(side: usize) -> Gray {
    Gray::from_fn(side, side, |c, r| {
        let (x, y) = (c as f32, r as f32);
        let hash = (c.wrapping_mul(2_654_435_761) ^ r.wrapping_mul(40_503)) % 61;
        120.0 + 40.0 * (0.13 * x).sin() + 30.0 * (0.21 * y + 0.05 * x).cos() + hash as f32
    })
}

const SCRIPT: &str = r"
import sys, time, numpy as np
def med(f):
    t=[]; b=time.perf_counter()
    while len(t)<9 or (time.perf_counter()-b<0.3 and len(t)<2000):
        s=time.perf_counter(); f(); t.append((time.perf_counter()-s)*1e6)
    return sorted(t)[len(t)//2]
try:
    import cv2; cv2.setNumThreads(1)
    for p in sys.argv[1].split(','):
        n,m=map(int,p.split('x')); y,x=np.mgrid[0:n,0:n].astype(np.float32)
        a=(120+40*np.sin(.13*x)+30*np.cos(.21*y+.05*x)+np.random.rand(n,n)*60).astype(np.float32)
        t=a[5:5+m,5:5+m].copy()
        print('ncc',n,m,med(lambda: cv2.matchTemplate(a,t,cv2.TM_CCOEFF_NORMED)))
except ImportError: pass
try:
    from filterpy.kalman import UnscentedKalmanFilter as U, MerweScaledSigmaPoints as S
    v,h,dt,f=19.,.7,.5,554.
    def fx(x,dt): return np.array([x[0]+(v*np.cos(h)+x[2])*dt,x[1]+(v*np.sin(h)+x[3])*dt,x[2],x[3]])
    def hx(x): return np.array([f*(10-x[1])/120+320,240-f*(20-x[0])/120])
    u=U(4,2,dt,hx,fx,S(4,1.,2.,0.)); u.P*=10; u.Q*=.1; u.R*=4
    def go():
        u.x=np.zeros(4); u.P=np.eye(4)*10; u.predict(); u.update(np.array([360.,150.]))
    print('ukf',0,0,med(go))
except ImportError: pass
";

/// Prints the table.
pub fn run(arguments: &Arguments) -> CommandResult {
    if let (Some(folder), Some(picture)) = (&arguments.cascades, &arguments.picture) {
        let wasm = arguments.wasm.as_deref();
        let wasm = wasm.map(|program| in_wasm::times(&arguments.node, program, folder, picture));
        return cascades::run(
            folder,
            picture,
            arguments.python.as_deref(),
            wasm.transpose()?.as_ref(),
        );
    }
    let mut theirs: Vec<(String, f64)> = Vec::new();
    if let Some(python) = &arguments.python {
        let sizes: Vec<String> = SIZES.iter().map(|(n, m)| format!("{n}x{m}")).collect();
        let out = Command::new(python)
            .args(["-c", SCRIPT, &sizes.join(",")])
            .output()?;
        if !out.status.success() {
            return Err(String::from_utf8_lossy(&out.stderr).into_owned().into());
        }
        for line in String::from_utf8_lossy(&out.stdout).lines() {
            let fields: Vec<&str> = line.split_whitespace().collect();
            if let [kind, n, m, time] = fields[..] {
                theirs.push((format!("{kind} {n} {m}"), time.parse()?));
            }
        }
    }
    let peer = |key: &str| theirs.iter().find(|(k, _)| k == key).map(|(_, time)| *time);
    println!(
        "{:44} {:>11} {:>11} {:>8}",
        "", "ours, µs", "theirs, µs", "ratio"
    );
    let row = |name: &str, ours: f64, theirs: Option<f64>| match theirs {
        Some(theirs) => println!("{name:44} {ours:11.2} {theirs:11.2} {:8.2}", theirs / ours),
        None => println!("{name:44} {ours:11.2} {:>11} {:>8}", "–", "–"),
    };
    for (n, m) in SIZES {
        let search = scene(n);
        let patch = search.crop(5, 5, m, m).ok_or("the template does not fit")?;
        let template = Template::new(&patch).ok_or("the template is flat")?;
        let ours = median_us(|| {
            std::hint::black_box(template.correlate(std::hint::black_box(&search)));
        });
        let name = format!("correlation, {n}×{n} search, {m}×{m} template");
        row(&name, ours, peer(&format!("ncc {n} {m}")));
    }
    let steps = 2000;
    let flight = reference_flight(200);
    let settings = UnscentedSettings::default();
    reference_loop(&flight, steps, settings)?;
    let ours = median_us(|| {
        let belief = reference_loop(std::hint::black_box(&flight), steps, settings);
        std::hint::black_box(&belief);
    }) / f64::from(u32::try_from(steps)?);
    row(
        "UKF predict + correct, n = 4, one landmark",
        ours,
        peer("ukf 0 0"),
    );
    Ok(())
}
