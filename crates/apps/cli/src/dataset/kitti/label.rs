//! Lines of KITTI's label files.

use periplus_geometry::{DVec3, Pose};
use periplus_sim::{DetectedObject, PixelBox, box_corners};

use crate::dataset::matrix::forward_from_optical;

/// Minimum share of visible pixels of an object that counts as fully visible.
const FULLY_VISIBLE_RATIO: f64 = 0.95;

/// Minimum share of visible pixels of an object that counts as partly occluded; below it is largely occluded.
const PARTLY_OCCLUDED_RATIO: f64 = 0.5;

/// Pinhole of a camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct CameraGeometry {
    /// Focal length \[px\].
    pub(super) focal_px: f64,
    /// Principal point from the corner of the image \[px\].
    pub(super) centre_px: [f64; 2],
    /// Width and height \[px\].
    pub(super) size_px: [f64; 2],
    /// Distance in front of which nothing is seen \[m\].
    pub(super) near_m: f64,
}

/// Returns the line of an object: type, truncated, occluded, alpha, box in the image, height, width and length, position
/// of the centre of the bottom in the optical frame, and rotation about its y axis.
pub(super) fn label_line(
    name: &str,
    detected: &DetectedObject,
    camera: &CameraGeometry,
    world_from_camera: Pose,
) -> String {
    let object = &detected.object;
    let optical_from_world = (world_from_camera * forward_from_optical()).inverse();
    let optical_from_box = optical_from_world * object.world_from_box;
    let size_m = object.size_m;
    let bottom_m = optical_from_box.transform_point(DVec3::new(0.0, 0.0, -size_m.z / 2.0));
    // The length is along x of the object, which the rotation turns from x of the camera towards -z.
    let ahead = optical_from_box.rotation * DVec3::X;
    let rotation_rad = libm::atan2(-ahead.z, ahead.x);
    let alpha_rad = wrap(rotation_rad - libm::atan2(bottom_m.x, bottom_m.z));
    let PixelBox { left_px, top_px, width_px, height_px } = detected.full.bounds;
    format!(
        "{} {:.2} {} {:.6} {left_px}.00 {top_px}.00 {}.00 {}.00 {:.6} {:.6} {:.6} {:.6} {:.6} {:.6} {:.6}",
        name.split_whitespace().collect::<Vec<_>>().join("_"),
        truncation(camera, optical_from_box, size_m),
        occlusion(detected),
        alpha_rad,
        left_px + width_px - 1,
        top_px + height_px - 1,
        size_m.z,
        size_m.y,
        size_m.x,
        bottom_m.x,
        bottom_m.y,
        bottom_m.z,
        rotation_rad,
    )
}

/// Returns KITTI's degree of occlusion: 0 fully visible, 1 partly, 2 largely occluded.
fn occlusion(detected: &DetectedObject) -> u8 {
    let visible = f64::from(detected.visible.pixel_count);
    let ratio = visible / f64::from(detected.full.pixel_count.max(1));
    if ratio >= FULLY_VISIBLE_RATIO {
        0
    } else if ratio >= PARTLY_OCCLUDED_RATIO {
        1
    } else {
        2
    }
}

/// Returns the share of the projected box of an object that is outside of the image.
fn truncation(camera: &CameraGeometry, optical_from_box: Pose, size_m: DVec3) -> f64 {
    let mut corners: Vec<DVec3> =
        box_corners(size_m).map(|corner| optical_from_box.transform_point(corner)).collect();
    let is_ahead = |corner: &DVec3| corner.z >= camera.near_m;
    if !corners.iter().all(is_ahead) {
        // The part of the box in front of the camera: where its edges and diagonals meet the near plane.
        let (ahead, behind): (Vec<DVec3>, Vec<DVec3>) = corners.into_iter().partition(is_ahead);
        let cut = |a: DVec3, b: DVec3| a + (b - a) * ((camera.near_m - a.z) / (b.z - a.z));
        corners = ahead.iter().flat_map(|&a| behind.iter().map(move |&b| cut(a, b))).collect();
        corners.extend(ahead);
    }
    let (mut low_px, mut high_px) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for corner in corners {
        let pixel = [
            camera.centre_px[0] + camera.focal_px * corner.x / corner.z,
            camera.centre_px[1] + camera.focal_px * corner.y / corner.z,
        ];
        for axis in 0..2 {
            low_px[axis] = low_px[axis].min(pixel[axis]);
            high_px[axis] = high_px[axis].max(pixel[axis]);
        }
    }
    let (mut area, mut inside) = (1.0, 1.0);
    for axis in 0..2 {
        area *= high_px[axis] - low_px[axis];
        let limit = camera.size_px[axis];
        inside *= high_px[axis].clamp(0.0, limit) - low_px[axis].clamp(0.0, limit);
    }
    if area > 0.0 { (1.0 - inside / area).clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns an angle in -π..π.
fn wrap(angle_rad: f64) -> f64 {
    angle_rad - std::f64::consts::TAU * (angle_rad / std::f64::consts::TAU).round()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;
    use periplus_sim::{LabelledObject, ObjectLabel, PixelRegion};

    use super::*;

    const CAMERA: CameraGeometry = CameraGeometry {
        focal_px: 100.0,
        centre_px: [100.0, 50.0],
        size_px: [200.0, 100.0],
        near_m: 0.1,
    };

    /// A car of 4 m by 2 m by 1.5 m with its centre here, the camera at the origin looking along x.
    fn line(x: f64, y: f64, yaw: f64, visible: u32) -> Vec<String> {
        let bounds = PixelBox { left_px: 10, top_px: 20, width_px: 30, height_px: 40 };
        let rpy = Rpy { roll: 0.0, pitch: 0.0, yaw };
        let detected = DetectedObject {
            object: LabelledObject {
                label: ObjectLabel { class: 1, instance: 1 },
                model: "car".into(),
                world_from_box: Pose::from_xyz_rpy([x, y, 0.0], rpy),
                size_m: DVec3::new(4.0, 2.0, 1.5),
            },
            visible: PixelRegion { bounds, pixel_count: visible },
            full: PixelRegion { bounds, pixel_count: 100 },
        };
        let line = label_line("big car", &detected, &CAMERA, Pose::IDENTITY);
        line.split(' ').map(str::to_owned).collect()
    }

    fn number(words: &[String], index: usize) -> f64 {
        words[index].parse().expect("a number")
    }

    /// Ahead and facing away from the camera, a car is turned by -90°; to the left, facing right, by 0.
    #[test]
    fn a_line_has_kittis_conventions() {
        let words = line(20.0, 0.0, 0.0, 100);
        assert_eq!(words.len(), 15);
        assert_eq!(words[0], "big_car");
        assert_eq!(words[1..3], ["0.00", "0"]);
        assert_eq!(words[4..8], ["10.00", "20.00", "39.00", "59.00"]);
        let expected = [1.5, 2.0, 4.0, 0.0, 0.75, 20.0, -std::f64::consts::FRAC_PI_2];
        for (index, expected) in (8..).zip(expected) {
            assert!((number(&words, index) - expected).abs() < 1e-6, "{words:?}");
        }
        let left = line(10.0, 10.0, -std::f64::consts::FRAC_PI_2, 100);
        assert!(number(&left, 14).abs() < 1e-6, "{left:?}");
        assert!((number(&left, 11) + 10.0).abs() < 1e-6, "{left:?}");
        // Seen at 45° to the left.
        assert!((number(&left, 3) - std::f64::consts::FRAC_PI_4).abs() < 1e-6, "{left:?}");
    }

    #[test]
    fn occlusion_has_three_degrees() {
        for (visible, degree) in [(100, "0"), (95, "0"), (94, "1"), (50, "1"), (49, "2"), (1, "2")]
        {
            assert_eq!(line(20.0, 0.0, 0.0, visible)[2], degree);
        }
    }

    /// Its centre is on the left edge of the image, 45° to the left: a third to two thirds are outside. Next to the
    /// camera most of it is.
    #[test]
    fn truncation_is_the_share_outside_of_the_image() {
        let edge = number(&line(20.0, 20.0, 0.0, 100), 1);
        assert!((0.33..0.67).contains(&edge), "{edge}");
        let beside = number(&line(1.0, 1.5, 0.0, 100), 1);
        assert!((0.8..=1.0).contains(&beside), "{beside}");
    }
}
