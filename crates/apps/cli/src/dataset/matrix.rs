//! Matrices of calibration files.

use periplus_geometry::{DVec3, Pose, Rpy};

/// Optical frame in the frame of a camera or lidar: z forward, x to the right, y down (REP 103).
pub(super) fn forward_from_optical() -> Pose {
    let quarter_rad = std::f64::consts::FRAC_PI_2;
    Pose::from_xyz_rpy([0.0; 3], Rpy { roll: -quarter_rad, pitch: 0.0, yaw: -quarter_rad })
}

/// Returns the upper three rows of a transform, row by row.
pub(super) fn rows(pose: Pose) -> [f64; 12] {
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| pose.rotation * axis);
    let at = pose.translation;
    let mut rows = [0.0; 12];
    for row in 0..3 {
        for (column, axis) in columns.iter().enumerate() {
            // A turn by 90° has exact zeros.
            rows[row * 4 + column] = if axis[row].abs() < 1e-15 { 0.0 } else { axis[row] };
        }
        rows[row * 4 + 3] = at[row];
    }
    rows
}

/// Writes numbers as the files of KITTI do.
pub(super) fn line(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(|number| format!("{number:.12e}")).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point 3 m ahead, 1 m left and 2 m up is at x = -1, y = -2, z = 3 of the optical frame.
    #[test]
    fn the_optical_frame_looks_along_z() {
        let rows = rows(forward_from_optical().inverse());
        let point = [3.0, 1.0, 2.0];
        let turned = [0, 1, 2].map(|row| (0..3).map(|k| rows[row * 4 + k] * point[k]).sum::<f64>());
        for (seen, expected) in turned.into_iter().zip([-1.0, -2.0, 3.0]) {
            assert!((seen - expected).abs() < 1e-12, "{turned:?}");
        }
    }
}
