//! The same table from this program built for WebAssembly, run by Node.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Runs a WASI program with the arguments after its name; every folder is where it is outside.
const SCRIPT: &str = r"
const { WASI } = require('node:wasi');
const [program, ...rest] = process.argv.slice(1);
const wasi = new WASI({ version: 'preview1', args: ['pilotage', ...rest], preopens: { '/': '/' }, returnOnExit: true });
const module = new WebAssembly.Module(require('node:fs').readFileSync(program));
process.exitCode = wasi.start(new WebAssembly.Instance(module, wasi.getImportObject()));
";

/// Milliseconds of each cascade below `folder` over `picture`, by name.
pub fn times(
    node: &str,
    program: &Path,
    folder: &Path,
    picture: &Path,
) -> Result<BTreeMap<String, f64>, Box<dyn std::error::Error>> {
    let out = Command::new(node)
        .args(["--no-warnings", "-e", SCRIPT])
        .arg(program.canonicalize()?)
        .args(["bench", "--cascades"])
        .arg(folder.canonicalize()?)
        .arg("--picture")
        .arg(picture.canonicalize()?)
        .output()?;
    if !out.status.success() {
        return Err(String::from_utf8_lossy(&out.stderr).into_owned().into());
    }
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    let row = |line: &str| {
        let mut words = line.split_whitespace();
        Some((words.next()?.to_owned(), words.next()?.parse().ok()?))
    };
    Ok(said.lines().skip(1).filter_map(row).collect())
}
