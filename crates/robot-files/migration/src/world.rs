//! Worlds: systems that current Gazebo needs, built-in models, saved states.

use periplus_plugin_specs::library_id;
use periplus_scene::builtin_material;
use periplus_xml::{Element, write_element};

use crate::replacement::{leaf, system};

/// Systems for the sensors and services of a world: library, class.
const SYSTEMS: [(&str, &str); 6] = [
    ("physics", "Physics"),
    ("user-commands", "UserCommands"),
    ("scene-broadcaster", "SceneBroadcaster"),
    ("sensors", "Sensors"),
    ("imu", "Imu"),
    ("contact", "Contact"),
];

/// Systems for sensors that the world has only on request.
const OPTIONAL: [(&str, &str, &[&str]); 5] = [
    ("navsat", "NavSat", &["navsat", "gps"]),
    ("altimeter", "Altimeter", &["altimeter"]),
    ("magnetometer", "Magnetometer", &["magnetometer"]),
    ("forcetorque", "ForceTorque", &["force_torque"]),
    ("logical-camera", "LogicalCamera", &["logical_camera"]),
];

/// Systems that a world lacks.
pub(crate) fn missing_systems(world: &Element) -> Vec<Element> {
    let running: Vec<String> = world
        .named("plugin")
        .filter_map(|plugin| plugin.value("filename"))
        .map(library_id)
        .collect();
    let mut sensors = Vec::new();
    sensor_types(world, &mut sensors);
    let has_coordinates = world.child("spherical_coordinates").is_some();
    let needed = SYSTEMS.iter().map(|(library, class)| (*library, *class)).chain(
        OPTIONAL
            .iter()
            .filter(|(library, _, types)| {
                sensors.iter().any(|sensor| types.contains(&sensor.as_str()))
                    || *library == "navsat" && has_coordinates
            })
            .map(|(library, class, _)| (*library, *class)),
    );
    let lacking =
        needed.filter(|(library, _)| !running.contains(&format!("gz-sim-{library}-system")));
    lacking
        .map(|(library, class)| {
            let element = system(library, class);
            if library == "sensors" {
                element.with_child(leaf("render_engine", "ogre2"))
            } else {
                element
            }
        })
        .collect()
}

fn sensor_types(element: &Element, types: &mut Vec<String>) {
    for child in element.elements() {
        if child.name == "sensor" {
            types.extend(child.value("type").map(str::to_owned));
        }
        sensor_types(child, types);
    }
}

/// Name of a model of Gazebo Classic's database that is written into the world: it is in no folder of current Gazebo.
pub(crate) fn builtin_include(uri: &str) -> Option<&'static str> {
    match uri.trim().trim_end_matches('/') {
        "model://sun" => Some("sun"),
        "model://ground_plane" => Some("ground_plane"),
        _ => None,
    }
}

/// The light or floor that a built-in model consists of, with name and pose of its include.
pub(crate) fn builtin_element(model: &str, include: &Element) -> Element {
    let text = |name: &str| include.child(name).map(|child| child.text().into_owned());
    let name = text("name").unwrap_or_else(|| model.to_owned());
    let pose = text("pose");
    if model == "sun" {
        let attenuation = Element::new("attenuation")
            .with_child(leaf("range", "1000"))
            .with_child(leaf("constant", "0.9"))
            .with_child(leaf("linear", "0.01"))
            .with_child(leaf("quadratic", "0.001"));
        return Element::new("light")
            .with_attribute("name", name)
            .with_attribute("type", "directional")
            .with_child(leaf("cast_shadows", "true"))
            .with_child(leaf("pose", pose.unwrap_or_else(|| "0 0 10 0 0 0".to_owned())))
            .with_child(leaf("diffuse", "0.8 0.8 0.8 1"))
            .with_child(leaf("specular", "0.2 0.2 0.2 1"))
            .with_child(attenuation)
            .with_child(leaf("direction", "-0.5 0.1 -0.9"));
    }
    let plane = || {
        let plane = Element::new("plane")
            .with_child(leaf("normal", "0 0 1"))
            .with_child(leaf("size", "100 100"));
        Element::new("geometry").with_child(plane)
    };
    let friction = Element::new("ode").with_child(leaf("mu", "100")).with_child(leaf("mu2", "50"));
    let surface = Element::new("surface").with_child(Element::new("friction").with_child(friction));
    let mut material = Element::new("material");
    if let Some(grey) = builtin_material("Gazebo/Grey") {
        for (name, colour) in
            [("ambient", grey.ambient), ("diffuse", grey.diffuse), ("specular", grey.specular)]
        {
            if let Some(colour) = colour {
                let [r, g, b, a] = colour.0;
                material.push(leaf(name, format!("{r} {g} {b} {a}")));
            }
        }
    }
    let link = Element::new("link")
        .with_attribute("name", "link")
        .with_child(
            Element::new("collision")
                .with_attribute("name", "collision")
                .with_child(plane())
                .with_child(surface),
        )
        .with_child(
            Element::new("visual")
                .with_attribute("name", "visual")
                .with_child(leaf("cast_shadows", "false"))
                .with_child(plane())
                .with_child(material),
        );
    let mut floor = Element::new("model").with_attribute("name", name);
    floor.push(leaf("static", "true"));
    if let Some(pose) = pose {
        floor.push(leaf("pose", pose));
    }
    floor.with_child(link)
}

/// Text of elements, each line after the first behind an indentation.
pub(crate) fn written(elements: &[Element], indentation: &str) -> String {
    let text: String = elements.iter().map(write_element).collect();
    let mut out = String::new();
    for (number, line) in text.trim_end().lines().enumerate() {
        if number > 0 {
            out.push('\n');
            out.push_str(indentation);
        }
        out.push_str(line);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_gets_the_systems_that_it_lacks() {
        let sensor = Element::new("sensor").with_attribute("type", "altimeter");
        let physics =
            Element::new("plugin").with_attribute("filename", "libgz-sim-physics-system.so");
        let world = Element::new("world").with_child(physics).with_child(sensor);
        let systems = missing_systems(&world);
        let names: Vec<_> = systems.iter().filter_map(|system| system.value("filename")).collect();
        assert!(!names.contains(&"gz-sim-physics-system"), "{names:?}");
        assert!(names.contains(&"gz-sim-sensors-system"), "{names:?}");
        assert!(names.contains(&"gz-sim-altimeter-system"), "{names:?}");
        assert!(!names.contains(&"gz-sim-navsat-system"), "{names:?}");
    }

    #[test]
    fn a_floor_keeps_the_pose_of_its_include() {
        let include = Element::new("include").with_child(leaf("pose", "1 0 0 0 0 0"));
        let floor = builtin_element("ground_plane", &include);
        assert_eq!(floor.child("pose").unwrap().text(), "1 0 0 0 0 0");
        assert_eq!(floor.value("name"), Some("ground_plane"));
    }
}
