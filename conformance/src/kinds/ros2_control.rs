//! Controllers of `ros2_control`: odometry and wheel commands of drives.

use periplus_ros2_control::{
    DiffDriveGeometry, DiffDriveOdometry, MecanumGeometry, PlanarTwist, SteeringGeometry,
    SteeringKind, tricycle_command,
};
use serde_json::json;

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, numbers};

/// Poses and mean velocities of a differential drive from wheel angles.
pub(super) fn check_odometry(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let number = |name: &str| given.get(name)?.number();
    let radius_m = number("wheel_radius")?;
    let geometry = DiffDriveGeometry {
        separation_m: number("wheel_separation")? * number("wheel_separation_multiplier")?,
        left_radius_m: radius_m * number("left_wheel_radius_multiplier")?,
        right_radius_m: radius_m * number("right_wheel_radius_multiplier")?,
    };
    let window = given.get("velocity_rolling_window_size")?.count()?;
    let mut odometry = DiffDriveOdometry::new(geometry, window);
    let samples = given.get("samples")?.each(|sample| {
        let angles_rad = [sample.get("left")?.number()?, sample.get("right")?.number()?];
        Ok((angles_rad, sample.get("dt")?.number()?))
    })?;
    let states: Vec<[f64; 5]> = samples
        .into_iter()
        .map(|(angles_rad, dt_s)| {
            odometry.update(angles_rad, dt_s);
            let (pose, twist) = (odometry.pose, odometry.twist);
            [pose.x_m, pose.y_m, pose.heading_rad, twist.x_m_s, twist.yaw_rad_s]
        })
        .collect();
    differences.compare_members(&[(&["states"], json!(states))], &case.expect());
    Ok(())
}

/// Wheel speeds and steering angles of a velocity, in the order of the controller's joints.
pub(super) fn check_commands(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let number = |name: &str| given.get(name)?.number();
    let (radius_m, track_m) = (number("wheel_radius")?, number("track")?);
    let wheelbase_m = number("wheelbase")?;
    let sum_of_projections_m = number("sum_of_projections")?;
    let [x_m_s, y_m_s, yaw_rad_s] = given.get("twist")?.array()?;
    let twist = PlanarTwist { x_m_s, y_m_s, yaw_rad_s };
    let controller = given.get("controller")?;
    let steered = |kind: SteeringKind| {
        let geometry = SteeringGeometry {
            kind,
            wheelbase_m,
            traction_radius_m: radius_m,
            traction_track_m: track_m,
            steering_track_m: track_m,
        };
        let commands = geometry.commands(twist, None, false);
        (commands.traction_rad_s, commands.steering_rad)
    };
    let (traction, steering) = match controller.text()? {
        "diff_drive_controller" => {
            let geometry = DiffDriveGeometry {
                separation_m: track_m,
                left_radius_m: radius_m,
                right_radius_m: radius_m,
            };
            (geometry.wheel_speeds(twist).to_vec(), Vec::new())
        }
        "mecanum_drive_controller" => {
            let centre_from_base = [0.0; 3];
            let geometry = MecanumGeometry { radius_m, sum_of_projections_m, centre_from_base };
            (geometry.wheel_speeds(twist).to_vec(), Vec::new())
        }
        "tricycle_controller" => {
            let command = tricycle_command(twist, wheelbase_m, radius_m);
            (vec![command.traction_rad_s], vec![command.steering_rad])
        }
        "bicycle_steering_controller" => steered(SteeringKind::Bicycle),
        "tricycle_steering_controller" => steered(SteeringKind::Tricycle),
        "ackermann_steering_controller" => steered(SteeringKind::Ackermann),
        _ => return Err(unknown(&controller)),
    };
    differences.compare_members(
        &[(&["traction"], numbers(traction)), (&["steering"], numbers(steering))],
        &case.expect(),
    );
    Ok(())
}

fn unknown(controller: &CaseReader<'_>) -> Unreadable {
    controller.unreadable(
        "`diff_drive_controller`, `mecanum_drive_controller`, `tricycle_controller` or a \
         steering controller",
    )
}
