//! Nav2's costmaps around a simulated robot, configured by a file that was written for Nav2.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a test at the edge")]

#[path = "costmaps/tutorial.rs"]
mod tutorial;

use periplus_costmap::cost;

use periplus_msgs::gazebo_msgs::{DeleteEntity, DeleteEntityRequest};
use periplus_sim::PhysicsMode;

use tutorial::{LAYERS, Run};

/// The near face of the cube is 1 m ahead; the near side of the sphere at the height of the lidar is
/// 1.42 m - 0.44 m away, to the left and behind.
const CUBE: (f64, f64) = (1.025, -0.2);
const SPHERE: (f64, f64) = (-0.62, 0.76);

#[test]
fn the_cube_and_the_sphere_appear_inflate_and_go() {
    let mut run = Run::new(PhysicsMode::Rigid);
    run.go_on(4000);
    assert_eq!(run.largest(CUBE.0, CUBE.1), [cost::LETHAL; 2]);
    assert_eq!(run.largest(SPHERE.0, SPHERE.1), [cost::LETHAL; 2]);
    // 0.3 m in front of the cube costs fall with the distance; the robot itself stands free.
    for cost in run.costs(0.7, -0.2) {
        assert!((1..cost::INSCRIBED).contains(&cost), "{cost}");
    }
    assert_eq!(run.costs(0.0, 0.0), [cost::FREE; 2]);

    let gone =
        run.call::<DeleteEntity>("/delete_entity", DeleteEntityRequest { name: "cube".into() });
    assert!(gone.success, "{}", gone.status_message);
    run.go_on(3000);
    // The floor is open: beams through the removed cube have no hit. With this file they clear nothing, and
    // the costmaps report that.
    assert_eq!(run.largest(CUBE.0, CUBE.1), [cost::LETHAL; 2]);
    for (node, (_, layer)) in run.costmaps.iter().zip(LAYERS) {
        let wanted = format!("{layer}.scan.inf_is_valid");
        let advice = node.with(|node| node.status()).advice;
        assert!(advice.iter().any(|one| one.parameter == wanted), "{advice:?}");
    }
    // As the report advises, at runtime.
    run.let_infinite_ranges_clear();
    run.go_on(3000);
    assert_eq!(run.largest(CUBE.0, CUBE.1), [cost::FREE; 2]);
    assert_eq!(run.largest(SPHERE.0, SPHERE.1), [cost::LETHAL; 2], "the sphere is still there");
}
