//! Checks of wheel separation and diameter against the model.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_scene::{DVec3, Model, Shape};

use crate::{Family, InterpretedPlugin, PluginSite};

/// Tolerated relative difference between a plugin's value and the model's.
const TOLERANCE_RATIO: f64 = 0.2;

/// Maximum number of pairs of wheels that are checked.
const MAX_WHEEL_PAIRS: usize = 16;

pub(super) fn check(
    site: &PluginSite<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) {
    if plugin.known.id == "gazebo_ros_diff_drive" && plugin.known.family == Family::ClassicRos2 {
        check_pairs(site, plugin, diagnostics);
    }
    let Some(names) = Parameters::of(plugin.known.id, plugin.known.family) else { return };
    let Some(model) = site.context.model else { return };
    let (left, right) = (plugin.values.all(names.left), plugin.values.all(names.right));
    for index in 0..left.len().min(right.len()).min(MAX_WHEEL_PAIRS) {
        let wheel = |all: &[(periplus_params::ParamValue, Origin)]| match &all[index].0 {
            periplus_params::ParamValue::Text(joint) => Wheel::of(model, joint),
            _ => None,
        };
        let (Some(left), Some(right)) = (wheel(&left), wheel(&right)) else { continue };
        // Some models shift the joints of an axle and some shift the wheels; it is a contradiction only if
        // neither matches.
        let by_wheels = separation(&names, index, between(&left, &right, |w| w.centre_in_model_m));
        let by_joints = separation(&names, index, between(&left, &right, |w| w.joint_in_model_m));
        if let Some(finding) = contradiction(plugin, site, by_wheels)
            && contradiction(plugin, site, by_joints).is_some()
        {
            diagnostics.push(finding);
        }
        if let Some(radius_m) = left.radius_m {
            let (what, measured_m) = if names.size_is_radius {
                ("radius", radius_m)
            } else {
                ("diameter", 2.0 * radius_m)
            };
            let truth = format!("the {what} of the wheel is {} m", short(measured_m));
            let claim = Claim { parameter: names.size, index, measured_m, truth };
            if let Some(finding) = contradiction(plugin, site, claim) {
                diagnostics.push(finding);
            }
        }
        // Current Gazebo drives all wheels of a side with the same speed and uses the first for the
        // odometry.
        if plugin.known.family == Family::Gz {
            break;
        }
    }
}

/// Names of a drive's parameters.
struct Parameters {
    left: &'static str,
    right: &'static str,
    separation: &'static str,
    size: &'static str,
    size_is_radius: bool,
}

impl Parameters {
    fn of(id: &str, family: Family) -> Option<Self> {
        let (left, right, separation, size, size_is_radius) = match (id, family) {
            ("gazebo_ros_diff_drive", Family::ClassicRos2) => {
                ("left_joint", "right_joint", "wheel_separation", "wheel_diameter", false)
            }
            ("gazebo_ros_diff_drive", _) => {
                ("leftJoint", "rightJoint", "wheelSeparation", "wheelDiameter", false)
            }
            ("gazebo_ros_skid_steer_drive", _) => {
                ("leftFrontJoint", "rightFrontJoint", "wheelSeparation", "wheelDiameter", false)
            }
            ("gz-sim-diff-drive-system", _) => {
                ("left_joint", "right_joint", "wheel_separation", "wheel_radius", true)
            }
            ("gz-sim-mecanum-drive-system", _) => {
                ("front_left_joint", "front_right_joint", "wheel_separation", "wheel_radius", true)
            }
            _ => return None,
        };
        Some(Self { left, right, separation, size, size_is_radius })
    }
}

struct Wheel {
    centre_in_model_m: DVec3,
    joint_in_model_m: DVec3,
    axle_in_model: Option<DVec3>,
    radius_m: Option<f64>,
}

impl Wheel {
    fn of(model: &Model, joint: &str) -> Option<Self> {
        let joint = model.joint(joint)?;
        let link = model.link(&joint.child)?;
        let model_from_joint = link.model_from_link * joint.child_from_joint;
        let axle_in_model =
            joint.axis.as_ref().map(|axis| model_from_joint.rotation * axis.direction_in_joint);
        let (centre_in_model_m, radius_m) = match &link.collisions[..] {
            [collision] => {
                let model_from_collision = link.model_from_link * collision.link_from_collision;
                let radius_m = match collision.shape {
                    Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(radius_m),
                    _ => None,
                };
                (model_from_collision.translation, radius_m)
            }
            _ => (model_from_joint.translation, None),
        };
        Some(Self {
            centre_in_model_m,
            joint_in_model_m: model_from_joint.translation,
            axle_in_model,
            radius_m,
        })
    }
}

/// Distance of two wheels along the axle of the first [m].
fn between(left: &Wheel, right: &Wheel, place: impl Fn(&Wheel) -> DVec3) -> f64 {
    let between_m = place(right) - place(left);
    left.axle_in_model.map_or(between_m.length(), |axle| between_m.dot(axle).abs())
}

fn separation(names: &Parameters, index: usize, measured_m: f64) -> Claim {
    let truth = format!("the wheels are {} m apart", short(measured_m));
    Claim { parameter: names.separation, index, measured_m, truth }
}

/// Expected value of a parameter.
struct Claim {
    parameter: &'static str,
    index: usize,
    measured_m: f64,
    truth: String,
}

fn contradiction(
    plugin: &InterpretedPlugin,
    site: &PluginSite<'_>,
    claim: Claim,
) -> Option<Diagnostic> {
    let Claim { parameter, index, measured_m, truth } = claim;
    let numbers = plugin.values.numbers(parameter);
    let written_m = *numbers.get(index).or(numbers.first())?;
    let off = (written_m - measured_m).abs();
    // Wheels at the same position are a model without geometry, not a contradiction.
    if !measured_m.is_finite() || measured_m < 1e-3 || off <= TOLERANCE_RATIO * measured_m {
        return None;
    }
    let given = plugin.values.is_given(parameter);
    let verb = if given { "is" } else { "defaults to" };
    let place = plugin.values.all(parameter).get(index).map(|(_, origin)| *origin);
    let origin = place.filter(|_| given).unwrap_or(site.plugin.origin);
    let message = format!("`{parameter}` {verb} {written_m} m, but in the model {truth}");
    Some(Diagnostic::hint("wheel-geometry", message).at(origin).note(
        "odometry and rotations have the same relative error, unless it is tuned against slip",
    ))
}

fn short(metres: f64) -> f64 {
    (metres * 1e4).round() / 1e4
}

/// The plugin does not start if the numbers differ.
fn check_pairs(site: &PluginSite<'_>, plugin: &InterpretedPlugin, diagnostics: &mut Diagnostics) {
    let pairs = plugin.values.integer("num_wheel_pairs").unwrap_or(1);
    for side in ["left_joint", "right_joint"] {
        let count = plugin.values.texts(side).len();
        if plugin.values.is_given(side) && i64::try_from(count) != Ok(pairs) {
            let message =
                format!("`num_wheel_pairs` is {pairs}, but `{side}` is given {count} times");
            diagnostics.push(
                Diagnostic::error("wheel-pairs", message)
                    .at(plugin.values.origin(side))
                    .related(site.plugin.origin, "the plugin does not start"),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    const WHEELS: &str = "<link name='l'><pose>0 0.2 0</pose><radius>0.1</radius></link>
<link name='r'><pose>0 -0.2 0</pose><radius>0.1</radius></link>
<joint name='lj'><child>l</child></joint><joint name='rj'><child>r</child></joint>";

    #[test]
    fn wheels_are_measured() {
        check(
            &format!(
                "<model name='m'>{WHEELS}
<plugin name='p' filename='libgazebo_ros_diff_drive.so'>
  <left_joint>lj</left_joint>
  <right_joint>rj</right_joint>
  <wheel_separation>0.3</wheel_separation>
</plugin></model>"
            ),
            expect![[r#"
                hint[wheel-geometry]: `wheel_separation` is 0.3 m, but in the model the wheels are 0.4 m apart
                 --> test.sdf:7:21
                  |
                7 |   <wheel_separation>0.3</wheel_separation>
                  |                     ^^^
                  |
                  = note: odometry and rotations have the same relative error, unless it is tuned against slip
                hint[wheel-geometry]: `wheel_diameter` defaults to 0.15 m, but in the model the diameter of the wheel is 0.2 m
                 --> test.sdf:4:1
                  |
                4 | <plugin name='p' filename='libgazebo_ros_diff_drive.so'>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: odometry and rotations have the same relative error, unless it is tuned against slip
            "#]],
        );
    }

    #[test]
    fn a_radius_is_not_a_diameter() {
        check(
            &format!(
                "<model name='m'>{WHEELS}
<plugin name='gz::sim::systems::DiffDrive' filename='gz-sim-diff-drive-system'>
  <left_joint>lj</left_joint>
  <right_joint>rj</right_joint>
  <wheel_separation>0.41</wheel_separation>
  <wheel_radius>0.2</wheel_radius>
</plugin></model>"
            ),
            expect![[r#"
                hint[wheel-geometry]: `wheel_radius` is 0.2 m, but in the model the radius of the wheel is 0.1 m
                 --> test.sdf:8:17
                  |
                8 |   <wheel_radius>0.2</wheel_radius>
                  |                 ^^^
                  |
                  = note: odometry and rotations have the same relative error, unless it is tuned against slip
            "#]],
        );
    }

    #[test]
    fn pairs_are_counted() {
        check(
            "<model name='m'><plugin name='p' filename='libgazebo_ros_diff_drive.so'>
  <left_joint>a</left_joint>
  <left_joint>b</left_joint>
  <right_joint>c</right_joint>
</plugin></model>",
            expect![[r#"
                error[wheel-pairs]: `num_wheel_pairs` is 1, but `left_joint` is given 2 times
                 --> test.sdf:2:15
                  |
                1 | <model name='m'><plugin name='p' filename='libgazebo_ros_diff_drive.so'>
                  |                 -------------------------------------------------------- the plugin does not start
                2 |   <left_joint>a</left_joint>
                  |               ^
            "#]],
        );
    }
}
