//! Numbers of a robot's document that a calibration determines.

use std::collections::BTreeSet;

use periplus_calibration::Estimated;
use periplus_geometry::Pose2;
use periplus_xml::{Document, Element};

use super::edit::{Elements, Place, Target};
use super::report::Report;

/// Elements of a drive's plugin, lower-case without underscores, for the distance of its wheels.
const DISTANCE_NAMES: [&str; 3] = ["wheelseparation", "wheelbase", "trackwidth"];

/// Types of planar scanners.
const SCANNER_TYPES: [&str; 5] = ["ray", "gpu_ray", "lidar", "gpu_lidar", "gpu_ray_sensor"];

/// Targets, with elements that belong to the wheels and what has no number in the document.
#[derive(Default)]
pub(super) struct Targets {
    pub(super) targets: Vec<Target>,
    pub(super) owned: BTreeSet<usize>,
    pub(super) missing: Vec<String>,
}

/// Returns the numbers of the wheels, the scanner's mount and noise in a robot's expanded document.
pub(super) fn targets(document: &Document, report: &Report) -> Targets {
    let elements = Elements::of(document);
    let mut found = Targets::default();
    wheels(&elements, report, &mut found);
    scanner(&elements, report, &mut found);
    found
}

fn wheels(elements: &Elements<'_>, report: &Report, found: &mut Targets) {
    let (calibration, nominal) = (&report.found, &report.nominal);
    let distance = calibration.wheel_distance_m;
    let sides = [
        (&nominal.left_joint, calibration.left_radius_m, 0.5, "left_wheel_radius"),
        (&nominal.right_joint, calibration.right_radius_m, -0.5, "right_wheel_radius"),
    ];
    let middle_m = nominal.base_from_axle.y_m;
    for (joint_name, radius, half, name) in sides {
        let joint = elements
            .named("joint")
            .filter(|it| elements.all[*it].0.value("name") == Some(joint_name))
            .find(|it| elements.all[*it].0.child("child").is_some());
        let Some(joint) = joint else { continue };
        let child = elements.all[joint].0.child("child");
        let link_name = child
            .and_then(|it| it.value("link").map(str::to_owned))
            .or_else(|| child.map(|it| it.text().trim().to_owned()));
        let link = elements.named("link").find(|it| {
            link_name.is_some() && elements.all[*it].0.value("name") == link_name.as_deref()
        });
        found.owned.insert(joint);
        let Some(link) = link else { continue };
        found.owned.insert(link);
        for shape in elements.inside(link) {
            let element = elements.all[shape].0;
            if ["cylinder", "sphere"].contains(&element.local_name()) {
                let place = number_of(elements, shape, "radius", 0);
                push(found, name, place, radius.value, radius.standard_error);
            }
        }
        // The position across, by half of the difference of the distance, in a parent that is not turned.
        let origin = child_of(elements, joint, "origin").map(|it| (it, Some("xyz")));
        let pose = || child_of(elements, link, "pose").map(|it| (it, None));
        let Some((origin, attribute)) = origin.or_else(pose) else { continue };
        let place = Place { element: origin, attribute: attribute.map(str::to_owned), word: 1 };
        let error_m = 0.5 * distance.standard_error;
        // The nominal distance is that of the positions in the file.
        let shift_m = half * (distance.value - nominal.drive.wheel_distance_m);
        if let Some(current_m) = number(elements, &place)
            && (current_m - middle_m - half * nominal.drive.wheel_distance_m).abs() < 1e-3
        {
            push(found, "wheel_distance", Some(place), current_m + shift_m, error_m);
        } else {
            found.missing.push(format!(
                "joint `{joint_name}`: its position is not along y of the base; move the wheel by {shift_m:.5} m to the \
                 left of the robot"
            ));
        }
    }
    let radius = mean(calibration.left_radius_m, calibration.right_radius_m);
    let twice =
        Estimated { value: 2.0 * radius.value, standard_error: 2.0 * radius.standard_error };
    let mut has_plugin = false;
    for plugin in elements.named("plugin") {
        let element = elements.all[plugin].0;
        if !names_joint(element, &nominal.left_joint) {
            continue;
        }
        for child in elements.inside(plugin) {
            let name = plain(elements.all[child].0.local_name());
            let (name, value) = match name.as_str() {
                "wheelradius" => ("plugin wheel_radius", radius),
                "wheeldiameter" => ("plugin wheel_diameter", twice),
                it if DISTANCE_NAMES.contains(&it) => ("plugin wheel_separation", distance),
                _ => continue,
            };
            has_plugin = true;
            let place = Place { element: child, attribute: None, word: 0 };
            push(found, name, Some(place), value.value, value.standard_error);
        }
    }
    if !has_plugin {
        found.missing.push(format!(
            "no plugin with `{}` has a wheel separation; of a `diff_drive_controller`, write wheel_separation: {:.5} and \
             wheel_radius: {:.5} into its parameters",
            nominal.left_joint, distance.value, radius.value
        ));
    }
}

fn scanner(elements: &Elements<'_>, report: &Report, found: &mut Targets) {
    let is_scanner = |it: &usize| {
        elements.all[*it].0.value("type").is_some_and(|it| SCANNER_TYPES.contains(&it))
    };
    let sensors: Vec<usize> = elements.named("sensor").filter(is_scanner).collect();
    let [sensor] = sensors[..] else {
        found.missing.push(format!(
            "{} planar scanners; mount and noise of the scanner are not written",
            sensors.len()
        ));
        return;
    };
    match &report.lidar {
        Some(lidar) => {
            let noise = elements.inside(sensor).into_iter().find(|it| {
                let parent = elements.all[*it].1.map(|it| elements.all[it].0.local_name());
                elements.all[*it].0.local_name() == "stddev" && parent == Some("noise")
            });
            match noise {
                Some(element) => {
                    let place = Place { element, attribute: None, word: 0 };
                    let std_m = lidar.std_m;
                    push(found, "range_noise_std", Some(place), std_m.value, std_m.standard_error);
                }
                None => found.missing.push(format!(
                    "the scanner has no noise; write <noise><type>gaussian</type><mean>0</mean><stddev>{:.5}</stddev>\
                     </noise> into it",
                    lidar.std_m.value
                )),
            }
        }
        None => found.missing.push("the noise of the scanner is not known".to_owned()),
    }
    mount(elements, report, sensor, found);
}

/// Position and heading of the scanner: those of the joint of its link, or of the sensor in an SDF.
fn mount(elements: &Elements<'_>, report: &Report, sensor: usize, found: &mut Targets) {
    let parent = elements.all[sensor].1;
    let link = parent.and_then(|it| elements.all[it].0.value("reference")).map(str::to_owned);
    let places = match link {
        Some(link) => {
            let joint = elements.named("joint").find(|it| {
                let child = elements.all[*it].0.child("child");
                child.and_then(|it| it.value("link")) == Some(link.as_str())
            });
            joint.and_then(|it| child_of(elements, it, "origin")).map(|origin| {
                let at = |name: &str, word| Place {
                    element: origin,
                    attribute: Some(name.to_owned()),
                    word,
                };
                [at("xyz", 0), at("xyz", 1), at("rpy", 2)]
            })
        }
        None => {
            let pose = child_of(elements, sensor, "pose")
                .or_else(|| parent.and_then(|it| child_of(elements, it, "pose")));
            pose.map(|element| [0, 1, 5].map(|word| Place { element, attribute: None, word }))
        }
    };
    let base_from_scanner = report.base_from_found_scanner();
    let Some(places) = places else {
        found.missing.push(format!(
            "no origin of the scanner: write x {:.5} m, y {:.5} m, yaw {:.5} rad in the base frame",
            base_from_scanner.x_m, base_from_scanner.y_m, base_from_scanner.yaw_rad
        ));
        return;
    };
    let current = places.clone().map(|it| number(elements, &it));
    let [Some(x_m), Some(y_m), yaw_rad] = current else { return };
    // The parent of the joint may be another link than the base: the recording has the whole chain.
    let parent_from_scanner = Pose2::new(x_m, y_m, yaw_rad.unwrap_or(0.0));
    let base_from_parent = report.base_from_scanner * parent_from_scanner.inverse();
    let wanted = (base_from_parent.inverse() * base_from_scanner).normalized();
    let calibration = &report.found;
    let values = [
        ("scanner_x", wanted.x_m, calibration.scanner_x_m),
        ("scanner_y", wanted.y_m, calibration.scanner_y_m),
        ("scanner_yaw", wanted.yaw_rad, calibration.scanner_yaw_rad),
    ];
    for ((place, (name, value, estimated)), current) in places.into_iter().zip(values).zip(current)
    {
        if current.is_some() {
            push(found, name, Some(place), value, estimated.standard_error);
        } else if value.abs() > 2.0 * estimated.standard_error {
            found.missing.push(format!(
                "the origin of the scanner has no rpy; write rpy=\"0 0 {value:.5}\" into it"
            ));
        }
    }
}

fn push(found: &mut Targets, name: &str, place: Option<Place>, value: f64, standard_error: f64) {
    found.targets.extend(place.map(|place| Target {
        name: name.to_owned(),
        place,
        value,
        standard_error,
    }));
}

/// Weighted mean of two values.
fn mean(a: Estimated, b: Estimated) -> Estimated {
    let variance = a.standard_error.powi(2) + b.standard_error.powi(2);
    Estimated { value: 0.5 * (a.value + b.value), standard_error: 0.5 * variance.sqrt() }
}

/// Name of an element without case and underscores.
fn plain(name: &str) -> String {
    name.to_ascii_lowercase().replace('_', "")
}

fn names_joint(element: &Element, joint: &str) -> bool {
    let has = |it: &Element| it.text().split([' ', ',', '\n']).any(|it| it.trim() == joint);
    has(element) || element.elements().any(|it| names_joint(it, joint))
}

/// Number of the first child with a name.
fn child_of(elements: &Elements<'_>, number: usize, name: &str) -> Option<usize> {
    (number..elements.all.len())
        .find(|it| elements.all[*it].1 == Some(number) && elements.all[*it].0.local_name() == name)
}

/// Place of a number in an attribute (URDF) or a child (SDF).
fn number_of(elements: &Elements<'_>, number: usize, name: &str, word: usize) -> Option<Place> {
    if elements.all[number].0.attribute(name).is_some() {
        return Some(Place { element: number, attribute: Some(name.to_owned()), word });
    }
    child_of(elements, number, name).map(|element| Place { element, attribute: None, word })
}

fn number(elements: &Elements<'_>, place: &Place) -> Option<f64> {
    let element = elements.all.get(place.element)?.0;
    let text = match &place.attribute {
        Some(name) => element.value(name)?.to_owned(),
        None => element.text().into_owned(),
    };
    text.split_whitespace().nth(place.word)?.parse().ok()
}
