//! Nominal values of a robot, from its file.

use periplus_calibration::DifferentialDrive;
use periplus_geometry::Pose2;
use periplus_loader::{LoadedFile, load};
use periplus_scene::{Joint, JointKind, Model, Shape};

use super::CalibrateOptions;
use crate::error::CliError;
use crate::options::split;
use crate::terminal::{self, with_setting};

/// Minimum part of a wheel's axis along y.
const MIN_AXIS_Y: f64 = 0.9;

/// Nominal values of a robot with two driven wheels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NominalRobot {
    pub(super) left_joint: String,
    pub(super) right_joint: String,
    pub(super) drive: DifferentialDrive,
    /// Point between the wheels.
    pub(super) base_from_axle: Pose2,
}

/// Reads the robot's file.
pub(super) fn nominal_robot(options: &CalibrateOptions) -> Result<NominalRobot, CliError> {
    let (files, arguments) = split(&options.robot);
    let [file] = &files[..] else {
        return Err(CliError::usage("name one file with `--robot`"));
    };
    with_setting(&options.search.resource_path, arguments, |setting| {
        let loaded = load(file, setting);
        if loaded.diagnostics.has_errors() {
            terminal::findings(&mut anstream::stderr().lock(), &loaded)?;
        }
        nominal_of(&loaded, options)
            .map_err(|why| CliError::failed(format!("{}: {why}", file.display())))
    })
}

/// Nominal values of the first model of a loaded file.
pub(super) fn nominal_of(
    loaded: &LoadedFile,
    options: &CalibrateOptions,
) -> Result<NominalRobot, String> {
    let model = loaded.scene.as_ref().and_then(|scene| scene.models.first());
    of_model(model.ok_or("it has no robot")?, options)
}

/// A wheel of a model.
struct Wheel<'a> {
    joint: &'a Joint,
    /// Position in the model \[m\].
    x_m: f64,
    y_m: f64,
    radius_m: Option<f64>,
}

fn of_model(model: &Model, options: &CalibrateOptions) -> Result<NominalRobot, String> {
    let wheel = |name: &str| {
        let joint = model.joint(name).ok_or_else(|| format!("there is no joint `{name}`"))?;
        wheel(model, joint).ok_or_else(|| format!("the joint `{name}` has no link"))
    };
    let (left, right) = match (&options.left_joint, &options.right_joint) {
        (Some(left), Some(right)) => (wheel(left)?, wheel(right)?),
        _ => two_wheels(model)?,
    };
    let wheel_distance_m = left.y_m - right.y_m;
    if wheel_distance_m <= 0.0 {
        return Err(format!(
            "`{}` is not to the left of `{}`; exchange `--left-joint` and `--right-joint`",
            left.joint.name, right.joint.name
        ));
    }
    let radius_m = |wheel: &Wheel<'_>| {
        options.wheel_radius.or(wheel.radius_m).ok_or_else(|| {
            format!(
                "the wheel of `{}` is no cylinder and no sphere; give its radius with `--wheel-radius`",
                wheel.joint.name
            )
        })
    };
    Ok(NominalRobot {
        drive: DifferentialDrive {
            left_radius_m: radius_m(&left)?,
            right_radius_m: radius_m(&right)?,
            wheel_distance_m,
        },
        base_from_axle: Pose2::new(0.5 * (left.x_m + right.x_m), 0.5 * (left.y_m + right.y_m), 0.0),
        left_joint: left.joint.name.clone(),
        right_joint: right.joint.name.clone(),
    })
}

/// The two wheels of a model: continuous joints about y with a round link, one on each side.
fn two_wheels(model: &Model) -> Result<(Wheel<'_>, Wheel<'_>), String> {
    let is_wheel = |joint: &&Joint| {
        let axis = joint.axis.as_ref().zip(model.link(&joint.child)).map(|(axis, link)| {
            (link.model_from_link * joint.child_from_joint).rotation * axis.direction_in_joint
        });
        joint.kind == JointKind::Continuous && axis.is_some_and(|it| it.y.abs() > MIN_AXIS_Y)
    };
    let wheels = model.joints.iter().filter(is_wheel).filter_map(|joint| wheel(model, joint));
    let mut wheels: Vec<Wheel<'_>> = wheels.collect();
    wheels.sort_by(|a, b| b.y_m.total_cmp(&a.y_m));
    let names: Vec<&str> = wheels.iter().map(|it| it.joint.name.as_str()).collect();
    let names = names.join("`, `");
    match <[Wheel<'_>; 2]>::try_from(wheels) {
        Ok([left, right]) => Ok((left, right)),
        Err(others) => Err(format!(
            "{} joints may be driven wheels{}; name two with `--left-joint` and `--right-joint`",
            others.len(),
            if names.is_empty() { String::new() } else { format!(": `{names}`") }
        )),
    }
}

fn wheel<'a>(model: &'a Model, joint: &'a Joint) -> Option<Wheel<'a>> {
    let link = model.link(&joint.child)?;
    let at = (link.model_from_link * joint.child_from_joint).translation;
    let collisions = link.collisions.iter().map(|it| &it.shape);
    let shapes = collisions.chain(link.visuals.iter().map(|it| &it.shape));
    let radius = |shape: &Shape| match shape {
        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(*radius_m),
        _ => None,
    };
    let radius_m = shapes.filter_map(radius).next();
    Some(Wheel { joint, x_m: at.x, y_m: at.y, radius_m })
}
