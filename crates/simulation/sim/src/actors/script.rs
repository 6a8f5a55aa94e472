//! Reading of `<script>`.

use periplus_crowds::{ActorScript, ActorTrajectory, Waypoint};
use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{Pose, Rpy, parse_number, parse_numbers};
use periplus_scene::Actor;
use periplus_xml::Element;

/// Reads the script of an actor: its trajectories in the order of the file. Waypoints that cannot be read are reported
/// and left out.
pub(crate) fn read(actor: &Actor, findings: &mut Diagnostics) -> ActorScript {
    let mut script = ActorScript { trajectories: Vec::new(), is_loop: true, delay_start_s: 0.0 };
    let Some(element) = actor.extra.iter().find(|element| element.local_name() == "script") else {
        return script;
    };
    script.is_loop = flag(element, "loop", findings);
    if let Some(delay) = element.child("delay_start") {
        let delay_s = number(delay, "seconds", findings).unwrap_or(0.0);
        script.delay_start_s = delay_s.max(0.0);
    }
    for trajectory in element.named("trajectory") {
        let points = trajectory.named("waypoint").filter_map(|it| waypoint(it, findings));
        let points: Vec<Waypoint> = points.collect();
        let tension = trajectory.attribute("tension").map_or(0.0, |attribute| {
            parse_number(&attribute.value).unwrap_or_else(|| {
                findings.push(wrong(attribute.origin, "`tension` is not a number from 0 to 1"));
                0.0
            })
        });
        script.trajectories.extend(ActorTrajectory::new(points, tension));
    }
    if !flag(element, "auto_start", findings) {
        findings.push(
            Diagnostic::warning(
                "actor-not-started",
                format!("the actor `{}` stays at its first waypoint", actor.name),
            )
            .at(element.origin)
            .note("<auto_start> is false, and nothing starts the script later"),
        );
        script.delay_start_s = f64::MAX;
    }
    script
}

fn waypoint(element: &Element, findings: &mut Diagnostics) -> Option<Waypoint> {
    let (Some(time), Some(pose)) = (element.child("time"), element.child("pose")) else {
        findings.push(wrong(element.origin, "a waypoint needs a <time> and a <pose>"));
        return None;
    };
    let time_s = number(time, "seconds", findings)?;
    let text = pose.text();
    let numbers = parse_numbers(&text).ok();
    let Some([x, y, z, roll, pitch, yaw]) = numbers.and_then(|it| <[f64; 6]>::try_from(it).ok())
    else {
        findings.push(wrong(pose.text_origin(), "a pose is six numbers: x y z roll pitch yaw"));
        return None;
    };
    let is_degrees = matches!(pose.value("degrees"), Some("true" | "1"));
    let scale = if is_degrees { std::f64::consts::PI / 180.0 } else { 1.0 };
    let rpy = Rpy { roll: roll * scale, pitch: pitch * scale, yaw: yaw * scale };
    Some(Waypoint { time_s, pose: Pose::from_xyz_rpy([x, y, z], rpy) })
}

fn number(element: &Element, unit: &str, findings: &mut Diagnostics) -> Option<f64> {
    let value = parse_number(element.text().trim()).filter(|value| value.is_finite());
    if value.is_none() {
        let message = format!("<{}> is not a number in {unit}", element.local_name());
        findings.push(wrong(element.text_origin(), message));
    }
    value
}

/// Flag with the default true.
fn flag(script: &Element, name: &str, findings: &mut Diagnostics) -> bool {
    let Some(element) = script.child(name) else { return true };
    match element.text().trim().to_ascii_lowercase().as_str() {
        "true" | "1" => true,
        "false" | "0" => false,
        _ => {
            let message = format!("<{name}> is not `true` or `false`");
            findings.push(wrong(element.text_origin(), message));
            true
        }
    }
}

fn wrong(origin: Origin, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error("actor-script", message).at(origin)
}
