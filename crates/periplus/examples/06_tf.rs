//! Looks up transforms with the rules of tf2: chains of frames, interpolation, and errors that name
//! the cause.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use periplus::geometry::{Pose, Rpy};
use periplus::tf::{Buffer, StampedTransform, TransformKind};

const SECOND_NS: i64 = 1_000_000_000;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut buffer = Buffer::default();
    let forward = |stamp_ns, x_m| {
        StampedTransform::new("odom", "base_link", stamp_ns, Pose::from_xyz(x_m, 0.0, 0.0))
    };
    buffer.set(&forward(SECOND_NS, 1.0), "wheel odometry", TransformKind::Moving)?;
    buffer.set(&forward(2 * SECOND_NS, 2.0), "wheel odometry", TransformKind::Moving)?;
    // The camera is 0.1 m ahead and looks to the left.
    let left = Rpy { roll: 0.0, pitch: 0.0, yaw: FRAC_PI_2 };
    let base_from_camera = Pose::from_xyz_rpy([0.1, 0.0, 0.0], left);
    let camera = StampedTransform::new("base_link", "camera", 0, base_from_camera);
    buffer.set(&camera, "robot_state_publisher", TransformKind::Fixed)?;

    // Between two samples, through two edges: a point 1 m in front of the camera.
    let found = buffer.lookup("odom", "camera", SECOND_NS + SECOND_NS / 2)?;
    let point = found.target_from_source.transform_point(periplus::geometry::DVec3::X);
    println!("the point is at {:.3}, {:.3} in odom", point.x, point.y);
    assert!((point.x - 1.6).abs() < 1e-12 && (point.y - 1.0).abs() < 1e-12, "{point}");

    let late = buffer.lookup("odom", "camera", 3 * SECOND_NS).err().ok_or("a future transform")?;
    println!("{late}");
    assert!(late.to_string().contains("extrapolation into the future"), "{late}");
    Ok(())
}
