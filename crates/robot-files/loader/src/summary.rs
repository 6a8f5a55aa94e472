//! Short description of a scene.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_scene::{Model, Scene, Sensor, SensorKind, World};
use serde::Serialize;

/// Summary of a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Worlds.
    pub worlds: Vec<WorldSummary>,
    /// Models outside any world.
    pub models: Vec<ModelSummary>,
}

/// Summary of a world.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct WorldSummary {
    /// Its name.
    pub name: String,
    /// Its models.
    pub models: Vec<ModelSummary>,
    /// Names of its lights.
    pub lights: Vec<String>,
    /// Names of its actors.
    pub actors: Vec<String>,
    /// Libraries of its plugins.
    pub plugins: Vec<String>,
    /// Physics step size [s].
    pub step_s: f64,
}

/// Summary of a model, nested models included.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ModelSummary {
    /// Its name.
    pub name: String,
    /// True if it never moves.
    pub is_static: bool,
    /// Number of links.
    pub links: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of frames, those of merged links included.
    pub frames: usize,
    /// Number of collisions.
    pub collisions: usize,
    /// Number of visuals.
    pub visuals: usize,
    /// Mass of all links [kg].
    pub mass_kg: f64,
    /// Its sensors.
    pub sensors: Vec<SensorSummary>,
    /// Libraries of its plugins.
    pub plugins: Vec<String>,
}

/// Summary of a sensor.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SensorSummary {
    /// Its name.
    pub name: String,
    /// Link that it is attached to.
    pub link: String,
    /// Its type as written.
    #[serde(rename = "type")]
    pub type_name: String,
    /// Update rate [Hz].
    pub update_rate_hz: f64,
    /// Main settings as text.
    pub detail: String,
}

/// Summarises a scene.
#[must_use]
pub fn summarise(scene: &Scene) -> Summary {
    Summary {
        worlds: scene.worlds.iter().map(world).collect(),
        models: scene.models.iter().map(model).collect(),
    }
}

fn world(world: &World) -> WorldSummary {
    WorldSummary {
        name: world.name.clone(),
        models: world.models.iter().map(model).collect(),
        lights: world.lights.iter().map(|light| light.name.clone()).collect(),
        actors: world.actors.iter().map(|actor| actor.name.clone()).collect(),
        plugins: world.plugins.iter().map(|plugin| plugin.filename.clone()).collect(),
        step_s: world.physics.first().map_or(0.001, |physics| physics.max_step_size_s),
    }
}

fn model(model: &Model) -> ModelSummary {
    let mut summary = ModelSummary {
        name: model.name.clone(),
        is_static: model.is_static,
        ..ModelSummary::default()
    };
    add(model, &mut summary);
    summary
}

fn add(model: &Model, summary: &mut ModelSummary) {
    summary.links += model.links.len();
    summary.joints += model.joints.len();
    summary.frames += model.frames.len();
    summary.plugins.extend(model.plugins.iter().map(|plugin| plugin.filename.clone()));
    for link in &model.links {
        summary.collisions += link.collisions.len();
        summary.visuals += link.visuals.len();
        summary.mass_kg += link.inertial.mass_kg;
        for sensor in &link.sensors {
            summary.plugins.extend(sensor.plugins.iter().map(|plugin| plugin.filename.clone()));
            summary.sensors.push(sensor_summary(sensor, &link.name));
        }
    }
    for joint in &model.joints {
        let link = joint.child.as_str();
        summary.sensors.extend(joint.sensors.iter().map(|sensor| sensor_summary(sensor, link)));
    }
    for inner in &model.models {
        add(inner, summary);
    }
}

fn sensor_summary(sensor: &Sensor, link: &str) -> SensorSummary {
    SensorSummary {
        name: sensor.name.clone(),
        link: link.to_owned(),
        type_name: sensor.type_name.clone(),
        update_rate_hz: sensor.update_rate_hz,
        detail: detail(&sensor.kind),
    }
}

fn detail(kind: &SensorKind) -> String {
    match kind {
        SensorKind::Lidar(lidar) => {
            let (across, up) = (&lidar.horizontal, &lidar.vertical);
            let degrees = (across.max_angle_rad - across.min_angle_rad).to_degrees();
            let rows = if up.samples > 1 { format!("{}x", up.samples) } else { String::new() };
            let sigma = lidar.noise.stddev;
            let noise = if sigma > 0.0 { format!(", sigma {sigma} m") } else { String::new() };
            format!(
                "{rows}{} beams over {degrees:.0} deg, {} to {} m{noise}",
                across.samples, lidar.range_min_m, lidar.range_max_m
            )
        }
        SensorKind::Camera(camera) => format!(
            "{}x{}, {:.0} deg, {} to {} m",
            camera.width,
            camera.height,
            camera.horizontal_fov_rad.to_degrees(),
            camera.near_m,
            camera.far_m
        ),
        SensorKind::Radar(radar) => format!(
            "{:.0} deg, {} to {} m, cells of {} m and {:.1} deg",
            radar.horizontal_fov_rad.to_degrees(),
            radar.range_min_m,
            radar.range_max_m,
            radar.range_resolution_m,
            radar.azimuth_resolution_rad.to_degrees()
        ),
        SensorKind::Contact { collisions, .. } => format!("on {}", collisions.join(", ")),
        _ => String::new(),
    }
}

/// Name as shown; a very long one is truncated.
fn shown(name: &str) -> Cow<'_, str> {
    const MAX_NAME_BYTES: usize = 80;
    match name.char_indices().nth(MAX_NAME_BYTES) {
        Some((cut, _)) => format!("{}...", &name[..cut]).into(),
        None => name.into(),
    }
}

/// Comma-separated names; repeated ones are counted.
fn list(names: &[String]) -> String {
    let mut counted: Vec<(&str, usize)> = Vec::new();
    for name in names {
        match counted.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => counted.push((name, 1)),
        }
    }
    let words = counted.into_iter().map(|(name, count)| match count {
        1 => shown(name).into_owned(),
        _ => format!("{} ({count})", shown(name)),
    });
    words.collect::<Vec<_>>().join(", ")
}

/// Writes a summary as an indented list.
#[must_use]
pub fn describe(summary: &Summary) -> String {
    let mut out = String::new();
    for world in &summary.worlds {
        let _ = writeln!(
            out,
            "  world {}: {}, {}{}, step {} s",
            shown(&world.name),
            count(world.models.len(), "model"),
            count(world.lights.len(), "light"),
            if world.actors.is_empty() {
                String::new()
            } else {
                format!(", {}", count(world.actors.len(), "actor"))
            },
            world.step_s
        );
        if !world.plugins.is_empty() {
            let _ = writeln!(out, "    plugins {}", list(&world.plugins));
        }
        // A warehouse may have a hundred pallets: equal models share a line.
        let mut alike: BTreeMap<String, (usize, Vec<Cow<'_, str>>, String)> = BTreeMap::new();
        for (index, model) in world.models.iter().enumerate() {
            let mut anonymous = model.clone();
            anonymous.name = String::new();
            let text = describe_model(&anonymous, "    ");
            let entry = alike.entry(text.clone()).or_insert((index, Vec::new(), text));
            entry.1.push(shown(&model.name));
        }
        let mut groups: Vec<_> = alike.into_values().collect();
        groups.sort_by_key(|(index, ..)| *index);
        for (_, names, text) in groups {
            let names = match names.as_slice() {
                [first, _, _, .., last] => format!("{first} ... {last} ({})", names.len()),
                few => few.join(", "),
            };
            out.push_str(&text.replacen("model ", &format!("model {names}"), 1));
        }
    }
    for model in &summary.models {
        out.push_str(&describe_model(model, "  "));
    }
    out
}

fn describe_model(model: &ModelSummary, indent: &str) -> String {
    let mut out = String::new();
    let mut parts = vec![count(model.links, "link")];
    if model.joints > 0 {
        parts.push(count(model.joints, "joint"));
    }
    if model.frames > 0 {
        parts.push(count(model.frames, "frame"));
    }
    parts.push(if model.is_static {
        "static".to_owned()
    } else {
        format!("{} kg", (model.mass_kg * 1e3).round() / 1e3)
    });
    let _ = writeln!(out, "{indent}model {}: {}", shown(&model.name), parts.join(", "));
    for sensor in &model.sensors {
        let rate = if sensor.update_rate_hz > 0.0 {
            format!(" at {} Hz", sensor.update_rate_hz)
        } else {
            String::new()
        };
        let detail =
            if sensor.detail.is_empty() { String::new() } else { format!(": {}", sensor.detail) };
        let _ = writeln!(
            out,
            "{indent}  {} {} on {}{rate}{detail}",
            shown(&sensor.type_name),
            shown(&sensor.name),
            shown(&sensor.link)
        );
    }
    if !model.plugins.is_empty() {
        let _ = writeln!(out, "{indent}  plugins {}", list(&model.plugins));
    }
    out
}

fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}
