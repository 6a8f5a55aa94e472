//! Numbers of a robot's document that a calibration determines.

use std::collections::BTreeSet;

use periplus_calibration::Estimated;
use periplus_geometry::Pose2;
use periplus_xml::{Document, Element};

use super::edit::{Elements, Place, Target};
use super::report::Report;

/// Elements of a drive's plugin, lower-case without underscores, for the distance of its wheels.
const DISTANCE_NAMES: [&str; 3] = ["wheelseparation", "wheelbase", "trackwidth"];

/// Maximum difference of a position to that of the wheel in the model \[m\].
const MAX_POSITION_DIFFERENCE_M: f64 = 1e-6;

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
    imu(&elements, report, &mut found);
    found
}

/// Noise of an IMU: the standard deviation of a sample is the density times the root of the rate.
fn imu(elements: &Elements<'_>, report: &Report, found: &mut Targets) {
    let Some(imu) = &report.imu else { return };
    let is_imu = |it: &usize| elements.all[*it].0.value("type") == Some("imu");
    let sensors: Vec<usize> = elements.named("sensor").filter(is_imu).collect();
    let [sensor] = sensors[..] else {
        found
            .missing
            .push(format!("{} IMUs; noise and bias of the IMU are not written", sensors.len()));
        return;
    };
    let kinds = [("angular_velocity", imu.gyroscope), ("linear_acceleration", imu.accelerometer)];
    for (kind, noises) in kinds {
        let group =
            elements.inside(sensor).into_iter().find(|it| elements.all[*it].0.local_name() == kind);
        let (Some(noises), Some(group)) = (noises, group) else { continue };
        for (axis, noise) in ["x", "y", "z"].into_iter().zip(noises) {
            let root = imu.rate_hz.sqrt();
            let std = Estimated {
                value: noise.noise_density.value * root,
                standard_error: noise.noise_density.standard_error * root,
            };
            for (name, value) in [("stddev", std), ("bias_mean", noise.bias)] {
                let place = child_of(elements, group, axis)
                    .and_then(|it| child_of(elements, it, "noise"))
                    .and_then(|it| child_of(elements, it, name))
                    .map(|element| Place { element, attribute: None, word: 0 });
                let name = format!("{kind} {axis} {name}");
                push(found, &name, place, value.value, value.standard_error);
            }
        }
    }
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
        // The positions across change by half of the difference of the distance. The nominal distance is that of the
        // positions in the file.
        let shift_m = half * (distance.value - nominal.drive.wheel_distance_m);
        let expected_m = middle_m + half * nominal.drive.wheel_distance_m;
        let mut is_found = false;
        for place in positions(elements, joint, link) {
            let Some(current_m) = number(elements, &place) else { continue };
            if (current_m - expected_m).abs() < MAX_POSITION_DIFFERENCE_M {
                is_found = true;
                let error_m = 0.5 * distance.standard_error;
                push(found, "wheel_distance", Some(place), current_m + shift_m, error_m);
            }
        }
        if !is_found {
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

/// Numbers for the position of a wheel across: of the joint's origin in URDF; in SDF of the link, or, where it has no
/// pose, of the joint and of all in the link.
fn positions(elements: &Elements<'_>, joint: usize, link: usize) -> Vec<Place> {
    if let Some(element) = child_of(elements, joint, "origin") {
        return vec![Place { element, attribute: Some("xyz".to_owned()), word: 1 }];
    }
    let in_text = |element| Place { element, attribute: None, word: 1 };
    if let Some(element) = child_of(elements, link, "pose") {
        return vec![in_text(element)];
    }
    let inside = elements.inside(link).into_iter().chain(elements.inside(joint));
    inside.filter(|it| elements.all[*it].0.local_name() == "pose").map(in_text).collect()
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
    if let Some(bias) = report.range_bias {
        let mean = elements.inside(sensor).into_iter().find(|it| {
            let parent = elements.all[*it].1.map(|it| elements.all[it].0.local_name());
            elements.all[*it].0.local_name() == "mean" && parent == Some("noise")
        });
        let place = mean.map(|element| Place { element, attribute: None, word: 0 });
        push(found, "range_bias", place, bias.value, bias.standard_error);
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
    let variance = libm::pow(a.standard_error, 2.0) + libm::pow(b.standard_error, 2.0);
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

/// Location of a number in an attribute (URDF) or a child (SDF).
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

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use clap::Parser;
    use periplus_calibration::{
        CalibrationError, DriveCalibration, ImuCalibration, ImuNoise, LidarNoise, PredictionError,
    };

    use super::*;
    use crate::calibrate::edit::{Outcome, OutcomeKind, expand_texts, plan};
    use crate::calibrate::robot::nominal_of;
    use crate::calibrate::{CalibrateOptions, split};
    use crate::terminal::with_setting;

    #[derive(Parser)]
    struct Options {
        #[command(flatten)]
        options: CalibrateOptions,
    }

    /// Values of a calibration relative to a robot's file.
    const RADIUS_RATIO: f64 = 1.02;
    const DISTANCE_RATIO: f64 = 0.97;
    const MOUNT_SHIFT_M: f64 = 0.013;
    const MOUNT_TURN_RAD: f64 = 0.04;
    const RANGE_STD_M: f64 = 0.0234;

    /// Plans the edits of a robot and returns the outcomes, with the wheels and the document after the edits.
    fn edit(robot: &str, joints: Option<[&str; 2]>) -> Option<(Vec<Outcome>, [f64; 3], String)> {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../..").join(robot);
        if !path.exists() {
            eprintln!("SKIPPED: no {}", path.display());
            return None;
        }
        let path = path.display().to_string();
        let mut words = vec!["calibrate", "drive.mcap", "--robot", &path];
        if let Some([left, right]) = joints {
            words.extend(["--left-joint", left, "--right-joint", right]);
        }
        let Options { options } = Options::parse_from(words);
        let (files, arguments) = split(&options.robot);
        with_setting(&[], arguments, |context| {
            let loaded = periplus_loader::load(&files[0], context);
            let document = loaded.document.as_ref()?;
            let nominal = nominal_of(&loaded, &options).unwrap();
            let at = |value: f64| Estimated { value, standard_error: 1e-5 };
            let drive = nominal.drive;
            let base_from_scanner = Pose2::new(0.02, 0.0, 0.0);
            let axle = nominal.base_from_axle.inverse() * base_from_scanner;
            let found = DriveCalibration {
                left_radius_m: at(RADIUS_RATIO * drive.left_radius_m),
                right_radius_m: at(RADIUS_RATIO * drive.right_radius_m),
                wheel_distance_m: at(DISTANCE_RATIO * drive.wheel_distance_m),
                scanner_x_m: at(axle.x_m + MOUNT_SHIFT_M),
                scanner_y_m: at(axle.y_m - MOUNT_SHIFT_M),
                scanner_yaw_rad: at(axle.yaw_rad + MOUNT_TURN_RAD),
                delay_s: at(0.0),
                residuals: Vec::new(),
                rejected_count: 0,
            };
            let lidar =
                LidarNoise { std_m: at(RANGE_STD_M), dropout_ratio: at(0.0), window_count: 1000 };
            let report = Report {
                nominal,
                base_from_scanner,
                found,
                lidar: Some(lidar),
                range_bias: None,
                imu: Some(still_imu()),
                second_half: Err(PredictionError::Calibration(CalibrationError::TooFew(0))),
                outcomes: Vec::new(),
                missing: Vec::new(),
            };
            let targets = targets(document, &report);
            let plan = plan(
                &files[0],
                context,
                document,
                &loaded.sources,
                &targets.targets,
                &targets.owned,
            );
            // Only numbers change: the lines stay.
            for (before, after) in plan.texts.values() {
                assert_eq!(before.lines().count(), after.lines().count());
            }
            let texts = plan.texts.iter().map(|(path, it)| (path.clone(), it.1.clone()));
            let after = expand_texts(&files[0], context, texts.collect());
            assert!(!after.diagnostics.has_errors());
            let edited = nominal_of(&after, &options).unwrap().drive;
            let ratios = [
                edited.left_radius_m / drive.left_radius_m,
                edited.right_radius_m / drive.right_radius_m,
                edited.wheel_distance_m / drive.wheel_distance_m,
            ];
            let text = periplus_xml::write_document(after.document.as_ref()?);
            Some((plan.outcomes, ratios, text))
        })
    }

    /// Noise of 0.00003 rad/s/Hz½ at 100 Hz, so 0.0003 rad/s, of the gyroscope.
    fn still_imu() -> ImuCalibration {
        let at = |value: f64| Estimated { value, standard_error: 1e-7 };
        let noise = ImuNoise {
            bias: at(0.0012),
            noise_density: at(3e-5),
            bias_instability: None,
            random_walk: None,
        };
        ImuCalibration {
            rate_hz: 100.0,
            rest_s: 60.0,
            gyroscope: Some([noise; 3]),
            accelerometer: None,
            scale_ratio: None,
            delay_s: None,
            missing: Vec::new(),
        }
    }

    fn names(outcomes: &[Outcome], is_edited: bool) -> BTreeSet<&str> {
        let kind = |it: &&Outcome| matches!(it.kind, OutcomeKind::Edited(None)) == is_edited;
        outcomes.iter().filter(kind).map(|it| it.name.as_str()).collect()
    }

    /// Every number is written as it is.
    #[test]
    fn numbers_of_a_model_are_edited() {
        let file = "../shared/corpus/turtlebot3_simulations/turtlebot3_gazebo/models/turtlebot3_burger/model.sdf";
        let Some((outcomes, ratios, text)) =
            edit(file, Some(["wheel_left_joint", "wheel_right_joint"]))
        else {
            return;
        };
        assert_eq!(names(&outcomes, false), BTreeSet::new(), "{outcomes:#?}");
        for (ratio, expected) in
            ratios.into_iter().zip([RADIUS_RATIO, RADIUS_RATIO, DISTANCE_RATIO])
        {
            assert!((ratio - expected).abs() < 1e-4, "{ratios:?}");
        }
        assert!(text.contains("<wheel_separation>0.1552</wheel_separation>"), "{text}");
        assert!(text.contains("<wheel_radius>0.03366</wheel_radius>"));
        assert!(text.contains("<stddev>0.0234</stddev>"));
        assert_eq!(text.matches("<stddev>0.0003</stddev>").count(), 3);
        // Turned and moved in the frame of the robot: -0.032 + 0.013 and 0 - 0.013.
        assert!(text.contains("<pose>-0.019 -0.013 0.171 0 0 0.04</pose>"));
    }

    /// The separation of the drive is the default of an argument, the mount a parameter of a macro. The radius is that
    /// of the caster too.
    #[test]
    fn numbers_of_arguments_and_macro_calls_are_edited() {
        let (outcomes, _, text) = edit("robots/sam_bot/urdf/sam_bot.urdf.xacro", None).unwrap();
        let edited = names(&outcomes, true);
        for name in [
            "plugin wheel_separation",
            "range_noise_std",
            "scanner_x",
            "scanner_y",
            "wheel_distance",
        ] {
            assert!(edited.contains(name), "{name}: {outcomes:#?}");
        }
        assert!(text.contains("<wheel_separation>0.3492</wheel_separation>"), "{text}");
        assert!(text.contains("0.013 -0.013 0.12"));
        // A parameter of a macro for each axis.
        assert_eq!(text.matches("<bias_mean>0.0012</bias_mean>").count(), 3);
        let manual: Vec<&Outcome> =
            outcomes.iter().filter(|it| it.name == "left_wheel_radius").collect();
        assert!(
            matches!(&manual[0].kind, OutcomeKind::Manual(why) if why.contains("0.102")),
            "{manual:?}"
        );
        assert!(manual[0].location.contains("chassis.xacro"), "{manual:?}");
    }

    /// The gap between deck and wheel is of the wheels alone; the deck is not.
    #[test]
    fn the_number_that_nothing_else_uses_is_edited() {
        let (outcomes, ratios, text) = edit(
            "robots/kbot/urdf/kbot.urdf.xacro",
            Some(["left_wheel_joint", "right_wheel_joint"]),
        )
        .unwrap();
        assert!(names(&outcomes, true).contains("wheel_distance"), "{outcomes:#?}");
        assert!((ratios[2] - DISTANCE_RATIO).abs() < 1e-4, "{ratios:?}");
        assert!(text.contains("<wheelSeparation>0.16878</wheelSeparation>"), "{text}");
    }
}
