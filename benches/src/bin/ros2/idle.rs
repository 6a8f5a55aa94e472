//! CPU of programs that have nothing to do, before and after service calls by rclpy.

use std::fmt::Write as _;
use std::time::Duration;

use crate::Setup;
use crate::process::{Running, command, median};

/// Calls between the two measurements.
const CALLS: u32 = 100;

const PATIENCE: Duration = Duration::from_secs(60);

/// Measures a map server and a simulation; returns a table in Markdown.
pub(crate) fn measure(setup: &Setup) -> Result<String, String> {
    let (window, windows) =
        if setup.is_quick { (Duration::from_secs(2), 1) } else { (Duration::from_secs(10), 3) };
    let map = map(setup)?;
    let programs: [(&str, Vec<&str>); 2] = [
        ("`map serve`", vec!["map", "serve", &map]),
        (
            "`sim`, a robot at rest at real time",
            vec![
                "sim",
                "worlds/closed_room.world",
                "--robot",
                "robots/kbot/urdf/kbot.urdf.xacro",
                "--ros2",
                "loopback",
                "--quiet",
            ],
        ),
    ];
    let mut table = format!(
        "| program | core before | core after {CALLS} calls | difference | calls answered | slowest \
         call \\[ms\\] |\n|---|---|---|---|---|---|\n"
    );
    for ((name, words), domain_id) in programs.iter().zip(201..) {
        eprintln!("idle: {name}");
        let mut run = command(&setup.periplus, domain_id, words);
        let server = Running::start(run.current_dir(&setup.root))?;
        // Loading has ended when the services are discovered.
        output_of_list(setup, domain_id)?;
        std::thread::sleep(Duration::from_secs(3));
        let share = || -> f64 {
            let shares: Vec<f64> = (0..windows).map(|_| server.core_share(window)).collect();
            median(&shares)
        };
        let before = share();
        let script = setup.script.to_string_lossy();
        let words = [&*script, "call", &CALLS.to_string()];
        let caller = Running::start(&mut command(&setup.python, domain_id, &words))?;
        let called = caller.expect("called", PATIENCE)?;
        drop(caller);
        let after = share();
        let (answered, slowest_ms) = called.split_once(' ').unwrap_or((&called, ""));
        let slowest_ms: f64 = slowest_ms.parse().unwrap_or(f64::NAN);
        let _ = writeln!(
            table,
            "| {name} | {:.2} % | {:.2} % | {:+.2} % | {answered} of {CALLS} | {slowest_ms:.1} |",
            before * 100.0,
            after * 100.0,
            (after - before) * 100.0,
        );
    }
    Ok(table)
}

fn output_of_list(setup: &Setup, domain_id: u32) -> Result<(), String> {
    let mut list = command(&setup.periplus, domain_id, &["node", "list"]);
    crate::process::output(&mut list).map(drop)
}

/// A small map.
fn map(setup: &Setup) -> Result<String, String> {
    let yaml = "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    let path = setup.folder.join("map.yaml");
    let write = |name: &str, text: &str| {
        let path = setup.folder.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    write("map.pgm", "P2 2 2 255 0 254 254 0 ")?;
    write("map.yaml", yaml)?;
    Ok(path.to_string_lossy().into_owned())
}
