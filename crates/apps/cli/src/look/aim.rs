//! Pose of the camera.

use std::f64::consts::{FRAC_PI_2, PI};

use clap::ValueEnum;
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_sim::BoundingBox;

use crate::run_options::finite_numbers;

/// Horizontal field of view of all pictures \[rad\].
pub(super) const HORIZONTAL_FOV_RAD: f64 = 1.0;

/// Least radius of what a picture shows \[m\].
const MIN_RADIUS_M: f64 = 0.01;

/// Direction from which a picture is taken. A robot looks along x: its front is on the side of +x.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum View {
    /// From the front left corner, above
    Corner,
    /// From the front
    Front,
    /// From behind
    Back,
    /// From the left side
    Left,
    /// From the right side
    Right,
    /// From above, x up in the picture
    Top,
}

impl View {
    /// Pitch (down is positive) and yaw of the camera \[rad\].
    fn direction(self) -> (f64, f64) {
        match self {
            Self::Corner => (0.55, PI + 0.7),
            Self::Front => (0.0, PI),
            Self::Back => (0.0, 0.0),
            Self::Left => (0.0, -FRAC_PI_2),
            Self::Right => (0.0, FRAC_PI_2),
            Self::Top => (FRAC_PI_2, 0.0),
        }
    }
}

/// A point of the world \[m\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point(pub(super) DVec3);

pub(super) fn point(word: &str) -> Result<Point, String> {
    match finite_numbers(word).as_deref() {
        Some(&[x, y, z]) => Ok(Point(DVec3::new(x, y, z))),
        _ => Err("expected X,Y,Z in metres, such as 2,-1,0.5".to_owned()),
    }
}

/// Pose of a camera with this view that has the whole bounds in its picture. `aspect` is height by width.
pub(super) fn whole(bounds: &BoundingBox, view: View, aspect: f64) -> Pose {
    let (pitch, yaw) = view.direction();
    let rotation = Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch, yaw }).rotation;
    let half_m = (bounds.high_m - bounds.low_m) / 2.0;
    let across = libm::tan(HORIZONTAL_FOV_RAD / 2.0);
    let slopes = [across, across * aspect];
    // The camera is far enough if each corner is inside both angles of view: with a corner at (x, y, z) in its frame
    // about the centre of the bounds, at the distance d: |y| <= (d + x) tan, so d >= |y| / tan - x.
    let distance_m = (0..8)
        .map(|corner| {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let position = half_m * DVec3::new(sign(0), sign(1), sign(2));
            let seen = rotation.inverse() * position;
            (seen.y.abs() / slopes[0]).max(seen.z.abs() / slopes[1]) - seen.x
        })
        .fold(MIN_RADIUS_M, f64::max);
    // A margin of a tenth.
    let back_m = rotation * DVec3::new(-1.1 * distance_m, 0.0, 0.0);
    Pose { translation: bounds.centre_m() + back_m, rotation }
}

/// Pose of a camera at a point that has another in the centre of its picture; `None` if they are equal.
pub(super) fn at(from_m: DVec3, to_m: DVec3) -> Option<Pose> {
    let along = to_m - from_m;
    if along.length() < 1e-9 {
        return None;
    }
    let yaw = libm::atan2(along.y, along.x);
    let pitch = -libm::atan2(along.z, libm::hypot(along.x, along.y));
    Some(Pose::from_xyz_rpy(from_m.to_array(), Rpy { roll: 0.0, pitch, yaw }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of 2 m about (0, 0, 1).
    const CUBE: BoundingBox =
        BoundingBox { low_m: DVec3::new(-1.0, -1.0, 0.0), high_m: DVec3::new(1.0, 1.0, 2.0) };

    #[test]
    fn the_front_of_a_cube_fills_the_picture() {
        let camera = whole(&CUBE, View::Front, 1.0);
        // The near face, at x = 1, is 2 m wide and has to be 1 / tan(0.5) away: 1.83 m, with a margin of a tenth of
        // the whole distance.
        let expected_m = 1.1 * (1.0 + 1.0 / libm::tan(0.5_f64));
        assert!((camera.translation - DVec3::new(expected_m, 0.0, 1.0)).length() < 1e-9);
        let ahead = camera.rotation * DVec3::X;
        assert!((ahead - DVec3::NEG_X).length() < 1e-9, "{ahead}");
    }

    #[test]
    fn every_corner_is_in_the_picture_from_all_views() {
        for view in View::value_variants() {
            let camera = whole(&CUBE, *view, 0.5);
            for corner in 0..8 {
                let pick = |axis: usize| {
                    if corner >> axis & 1 == 0 { CUBE.low_m[axis] } else { CUBE.high_m[axis] }
                };
                let position = DVec3::new(pick(0), pick(1), pick(2));
                let seen = camera.rotation.inverse() * (position - camera.translation);
                assert!(
                    seen.x > 0.0 && seen.y.abs() < libm::tan(0.5_f64) * seen.x,
                    "{view:?}: {seen}"
                );
                assert!(seen.z.abs() < 0.5 * libm::tan(0.5_f64) * seen.x, "{view:?}: {seen}");
            }
        }
    }

    #[test]
    fn a_camera_looks_down_at_a_point_below_it() {
        let camera = at(DVec3::new(0.0, 0.0, 3.0), DVec3::new(3.0, 0.0, 0.0)).unwrap();
        let ahead = camera.rotation * DVec3::X;
        assert!((ahead - DVec3::new(0.5_f64.sqrt(), 0.0, -0.5_f64.sqrt())).length() < 1e-9);
        assert!(at(DVec3::ONE, DVec3::ONE).is_none());
    }

    #[test]
    fn three_numbers_are_a_point() {
        assert_eq!(point("1,-2,0.5").unwrap().0, DVec3::new(1.0, -2.0, 0.5));
        assert!(["1,2", "1,2,x", "1,2,3,4", "1,2,inf", ""].iter().all(|word| point(word).is_err()));
    }
}
