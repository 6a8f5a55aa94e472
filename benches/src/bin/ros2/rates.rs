//! Rates, losses and ages of sensor messages at an rclpy subscriber.

use std::fmt::Write as _;
use std::time::Duration;

use crate::Setup;
use crate::process::{Running, command, quantile};

/// Messages of one size at one rate.
struct Load {
    name: &'static str,
    kind: &'static str,
    size: u32,
    rate_hz: u32,
}

const LOADS: [Load; 10] = [
    Load { name: "scan of 360 rays", kind: "scan", size: 360, rate_hz: 10 },
    Load { name: "scan of 360 rays", kind: "scan", size: 360, rate_hz: 40 },
    Load { name: "scan of 1,440 rays", kind: "scan", size: 1440, rate_hz: 10 },
    Load { name: "scan of 1,440 rays", kind: "scan", size: 1440, rate_hz: 40 },
    Load { name: "camera_info", kind: "camera_info", size: 640, rate_hz: 30 },
    Load { name: "image of 640 x 480, rgb8", kind: "image", size: 640, rate_hz: 15 },
    Load { name: "image of 640 x 480, rgb8", kind: "image", size: 640, rate_hz: 30 },
    Load { name: "cloud of 1 MB", kind: "cloud", size: 1_000_000, rate_hz: 10 },
    Load { name: "cloud of 4 MB", kind: "cloud", size: 4_000_000, rate_hz: 10 },
    Load { name: "cloud of 9.8 MB", kind: "cloud", size: 9_830_400, rate_hz: 10 },
];

/// Programs that publish; the subscriber is always rclpy.
const PUBLISHERS: [&str; 2] = ["Periplus", "rclpy"];

/// Time for programs to start, find each other and end.
const PATIENCE: Duration = Duration::from_secs(30);

/// Messages in flight have this long to arrive.
const DRAIN: Duration = Duration::from_millis(1500);

/// Runs all loads; returns a table in Markdown.
pub(crate) fn measure(setup: &Setup) -> Result<String, String> {
    let seconds = if setup.is_quick { 2 } else { 10 };
    let mut table = String::from(
        "| message | asked \\[Hz\\] | QoS | publisher | published \\[Hz\\] | received \\[Hz\\] | lost | age \
         p50, p99 \\[ms\\] | core of the publisher |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut domain_id = 130;
    for load in &LOADS {
        for reliability in ["best_effort", "reliable"] {
            for publisher in PUBLISHERS {
                domain_id = 130 + (domain_id - 129) % 60;
                eprintln!("{} at {} Hz, {reliability}, {publisher}", load.name, load.rate_hz);
                let result = one(setup, load, reliability, publisher, seconds, domain_id);
                let figures = result.unwrap_or_else(|why| format!("{why} | | | |"));
                let _ = writeln!(
                    table,
                    "| {} | {} | {} | {publisher} | {figures} |",
                    load.name,
                    load.rate_hz,
                    reliability.replace('_', " "),
                );
            }
        }
    }
    Ok(table)
}

/// Figures of one run, as cells of the table.
fn one(
    setup: &Setup,
    load: &Load,
    reliability: &str,
    publisher: &str,
    seconds: u32,
    domain_id: u32,
) -> Result<String, String> {
    let script = setup.script.to_string_lossy().into_owned();
    let words = [&script, "sub", load.kind, "/measured", reliability];
    let mut subscriber = Running::start(&mut command(&setup.python, domain_id, &words))?;
    subscriber.expect("ready", PATIENCE)?;
    let (size, rate) = (load.size.to_string(), load.rate_hz.to_string());
    let (count, domain) = ((load.rate_hz * seconds).to_string(), domain_id.to_string());
    let source = if publisher == "rclpy" {
        let words = [&script, "pub", load.kind, &size, reliability, &rate, &count];
        Running::start(&mut command(&setup.python, domain_id, &words))?
    } else {
        let words = ["pub", &domain, load.kind, &size, reliability, &rate, &count];
        Running::start(&mut command(&setup.own, domain_id, &words))?
    };
    source.expect("begin", PATIENCE)?;
    let cpu_s = source.cpu_s();
    let done = source.expect("done", PATIENCE + Duration::from_secs(seconds.into()))?;
    let cpu_s = source.cpu_s() - cpu_s;
    std::thread::sleep(DRAIN);
    subscriber.close_input();
    let numbers = |line: &str| -> Vec<f64> {
        line.split(' ').map(|word| word.parse().unwrap_or(f64::NAN)).collect()
    };
    let done = numbers(&done);
    let got = subscriber
        .expect("got", PATIENCE)
        .map_err(|_| "the subscriber does not return from rcl_take".to_owned())?;
    let got = numbers(&got);
    let ([sent, published_s], [_, unique, received_s, ages_ms @ ..]) = (&*done, &*got) else {
        return Err("a program printed no figures".to_owned());
    };
    let rate_hz = |count: f64, span_s: f64| if count > 1.0 { (count - 1.0) / span_s } else { 0.0 };
    let ages = if ages_ms.is_empty() {
        "none".to_owned()
    } else {
        format!("{:.2}, {:.2}", quantile(ages_ms, 0.5), quantile(ages_ms, 0.99))
    };
    Ok(format!(
        "{:.1} | {:.1} | {} of {sent} | {ages} | {:.1} %",
        rate_hz(*sent, *published_s),
        rate_hz(*unique, *received_s),
        sent - unique,
        cpu_s / published_s * 100.0,
    ))
}
