//! Programs that the checks need and a fresh machine may lack.

use crate::{
    failure::Failure,
    process::{on_path, program, run, succeeds},
};

/// Installs Debian packages if this machine has them and lets us. Where that fails it has said why; whoever needs them
/// looks for them and names what is missing.
pub fn debian_packages(packages: &[&str]) {
    if let Err(failure) = installed(packages) {
        eprintln!("{failure}");
    }
}

fn installed(packages: &[&str]) -> Result<(), Failure> {
    if on_path(&["apt-get"]).is_none() {
        return Ok(());
    }
    let is_root = crate::process::capture(program("id").arg("-u"), "id is part of every system")
        .is_ok_and(|output| output.stdout.trim_ascii() == b"0");
    let with_sudo = !is_root && succeeds(program("sudo").args(["-n", "true"]));
    if !is_root && !with_sudo {
        return Ok(());
    }
    let apt = |arguments: &[&str]| {
        let mut command = if is_root {
            program("apt-get")
        } else {
            let mut sudo = program("sudo");
            sudo.args(["-n", "DEBIAN_FRONTEND=noninteractive", "apt-get"]);
            sudo
        };
        command
            .env("DEBIAN_FRONTEND", "noninteractive")
            .args(arguments);
        run(&mut command, "apt-get was found a moment ago")
    };
    println!("installing {} …", packages.join(", "));
    apt(&["update", "-q"])?;
    apt(&[
        &["install", "-q", "-y", "--no-install-recommends"],
        packages,
    ]
    .concat())?;
    Ok(())
}
