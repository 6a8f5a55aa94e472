//! `tf echo`.

use std::time::Duration;

use periplus_geometry::DVec3;
use periplus_os::{Stopwatch, sleep};
use periplus_tf::ResolvedTransform;
use serde_json::json;

use super::listen::Frames;
use crate::failure::endless;
use crate::{Outcome, Session};

/// Polling period for transforms.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Period of messages while waiting.
const WAIT_REPORT_PERIOD: Duration = Duration::from_secs(1);

/// Options of `tf echo`.
#[derive(Clone, Debug, PartialEq)]
pub struct TfEchoOptions {
    /// Reference frame.
    pub source: String,
    /// Frame whose pose is printed.
    pub target: String,
    /// Period of the output.
    pub period: Duration,
    /// Exit after the first.
    pub once: bool,
}

/// Prints the pose of a frame in another periodically, as soon as it is available.
///
/// As with `tf2_echo`, the first frame is the reference frame of the second.
///
/// Source: `tf2_ros/src/tf2_echo.cpp`.
///
/// # Errors
/// When the output cannot be written.
pub fn echo(session: &mut Session<'_>, echo: &TfEchoOptions) -> Outcome {
    endless(run(session, echo))
}

fn run(session: &mut Session<'_>, echo: &TfEchoOptions) -> Outcome {
    let mut frames = Frames::open(session)?;
    let clock = Stopwatch::start();
    let (mut due, mut complain) = (Duration::ZERO, WAIT_REPORT_PERIOD);
    loop {
        frames.hear(session);
        let now = clock.elapsed();
        if now >= due {
            match frames.survey.buffer.lookup(&echo.source, &echo.target, 0) {
                Ok(found) => {
                    show(session, &found)?;
                    if echo.once {
                        return Ok(());
                    }
                    due = now + echo.period;
                    complain = now + WAIT_REPORT_PERIOD;
                }
                Err(error) if now >= complain => {
                    session.say(&format!(
                        "Waiting for transform {} ->  {}: {error}",
                        echo.source, echo.target
                    ));
                    complain = now + WAIT_REPORT_PERIOD;
                }
                Err(_) => {}
            }
        }
        session.check_interrupted()?;
        sleep(POLL_PERIOD);
    }
}

fn show(session: &mut Session<'_>, found: &ResolvedTransform) -> Outcome {
    let pose = found.target_from_source;
    let (shift, turn, rpy) = (pose.translation, pose.rotation, pose.rpy());
    if session.json {
        return session.put(&json!({
            "time_ns": found.time_ns,
            "translation": shift.to_array(),
            "rotation_xyzw": turn.to_array(),
            "rpy_rad": [rpy.roll, rpy.pitch, rpy.yaw],
        }));
    }
    let degrees = [rpy.roll, rpy.pitch, rpy.yaw].map(f64::to_degrees);
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turn * axis);
    let out = &mut session.out;
    let (seconds, rest) =
        (found.time_ns.div_euclid(1_000_000_000), found.time_ns.rem_euclid(1_000_000_000));
    writeln!(out, "At time {seconds}.{rest:09}")?;
    writeln!(out, "- Translation: [{:.3}, {:.3}, {:.3}]", shift.x, shift.y, shift.z)?;
    writeln!(
        out,
        "- Rotation: in Quaternion [{:.3}, {:.3}, {:.3}, {:.3}]",
        turn.x, turn.y, turn.z, turn.w
    )?;
    let [roll, pitch, yaw] = [rpy.roll, rpy.pitch, rpy.yaw];
    writeln!(out, "- Rotation: in RPY (radian) [{roll:.3}, {pitch:.3}, {yaw:.3}]")?;
    let [roll, pitch, yaw] = degrees;
    writeln!(out, "- Rotation: in RPY (degree) [{roll:.3}, {pitch:.3}, {yaw:.3}]")?;
    writeln!(out, "- Matrix:")?;
    for row in 0..3 {
        let [x, y, z] = columns.map(|column| column[row]);
        writeln!(out, " {x:6.3} {y:6.3} {z:6.3} {:6.3}", shift[row])?;
    }
    writeln!(out, " {:6.3} {:6.3} {:6.3} {:6.3}", 0.0, 0.0, 0.0, 1.0)?;
    out.flush()?;
    Ok(())
}
