//! Camera info.

use periplus_msgs::sensor_msgs::CameraInfo;
use periplus_msgs::std_msgs::Header;
use periplus_scene::Camera;
use periplus_sensors::{CameraCalibration, Pinhole};

use super::super::port::{Convention, SensorPort};

/// Returns the calibration of a camera of a Classic plugin: given parameters have priority over
/// values derived from the image. In ROS 1 a 0 counts as not given.
pub(super) fn calibration(
    port: &SensorPort,
    pinhole: &Pinhole,
    camera: &Camera,
) -> CameraCalibration {
    let given = |ros2: &str, ros1: &str| match port.convention {
        Convention::Ros1 => port.given(ros1).filter(|value| *value != 0.0),
        _ => port.given(ros2),
    };
    let fallback = CameraCalibration::of_classic(pinhole, camera);
    let focal_px = given("focal_length", "focalLength").unwrap_or(pinhole.focal_px);
    let middle =
        [given("cx", "Cx").unwrap_or(fallback.k[2]), given("cy", "Cy").unwrap_or(fallback.k[5])];
    let mut made = CameraCalibration::new(focal_px, middle, camera);
    if port.convention == Convention::Ros1 && !port.flag("autoDistortion") {
        let names =
            ["distortionK1", "distortionK2", "distortionT1", "distortionT2", "distortionK3"];
        made.d = names.map(|name| port.number(name));
    }
    let set = |place: &mut f64, value: Option<f64>| {
        if let Some(value) = value {
            *place = value;
        }
    };
    set(&mut made.p[0], given("P_fx", ""));
    set(&mut made.p[5], given("P_fy", ""));
    set(&mut made.p[2], given("P_cx", "CxPrime"));
    set(&mut made.p[6], given("P_cy", ""));
    let baseline_m = given("hack_baseline", "hackBaseline").unwrap_or_default();
    if baseline_m != 0.0 {
        made = made.with_baseline(baseline_m);
    }
    set(&mut made.p[3], given("Tx", ""));
    set(&mut made.p[7], given("Ty", ""));
    if let Ok(turn) = <[f64; 9]>::try_from(port.numbers("rectification_matrix")) {
        made.r = turn;
    }
    made
}

pub(super) fn message(
    header: Header,
    pinhole: &Pinhole,
    numbers: &CameraCalibration,
) -> CameraInfo {
    CameraInfo {
        header,
        height: pinhole.height,
        width: pinhole.width,
        distortion_model: "plumb_bob".into(),
        d: numbers.d.to_vec(),
        k: numbers.k,
        r: numbers.r,
        p: numbers.p,
        ..CameraInfo::default()
    }
}
