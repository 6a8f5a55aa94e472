//! Measures a scan of a room with a pillar, as a lidar without noise does.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::f64::consts::TAU;

use periplus::geometry::{DVec3, Pose};
use periplus::raycast::{Filter, Ray, RaycastShape, RaycastWorld, Tags};

/// Rays of a revolution.
const RAY_COUNT: u32 = 360;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = RaycastWorld::builder();
    // Four walls, 0.2 m thick, around 6 m by 4 m.
    for (x_m, y_m, size_m) in [
        (3.1, 0.0, [0.2, 4.4, 2.0]),
        (-3.1, 0.0, [0.2, 4.4, 2.0]),
        (0.0, 2.1, [6.4, 0.2, 2.0]),
        (0.0, -2.1, [6.4, 0.2, 2.0]),
    ] {
        let wall = RaycastShape::Box { size_m: size_m.into() };
        builder.add_shape(&wall, &Pose::from_xyz(x_m, y_m, 1.0), Tags::default())?;
    }
    let pillar = RaycastShape::Cylinder { radius_m: 0.2, length_m: 2.0 };
    let pillar = builder.add_shape(&pillar, &Pose::from_xyz(1.2, 0.0, 1.0), Tags::default())?;
    let world = builder.build(1)?;

    let lidar = DVec3::new(0.0, 0.0, 0.5);
    let direction = |index: u32| {
        let (sine, cosine) = libm::sincos(TAU * f64::from(index) / f64::from(RAY_COUNT));
        DVec3::new(cosine, sine, 0.0)
    };
    let hits: Vec<_> = (0..RAY_COUNT)
        .map(|index| world.cast(&Ray::new(lidar, direction(index)), Filter::default()))
        .collect::<Option<_>>()
        .ok_or("a ray left the closed room")?;

    let on_pillar = hits.iter().filter(|hit| hit.instance == pillar).count();
    println!("front {:.3} m, left {:.3} m", hits[0].distance_m, hits[90].distance_m);
    println!("{on_pillar} of {RAY_COUNT} rays hit the pillar");
    assert!((hits[0].distance_m - 1.0).abs() < 1e-12, "the pillar is 1 m ahead");
    assert!((hits[90].distance_m - 2.0).abs() < 1e-12, "the left wall is 2 m away");
    // The pillar spans 2 asin(0.2 / 1.2), 19.2 degrees.
    assert_eq!(on_pillar, 19);
    Ok(())
}
