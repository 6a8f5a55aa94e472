//! Commands by the number of threads.

use periplus_controllers::Controller;
use periplus_costmap::Nav2Release;
use periplus_geometry::Twist2;
use periplus_params::ParamValue;

use crate::world::{Robot, World, controller, drive, straight};

/// Drives with a number of threads, past a change of a parameter and a reset; returns the bits of the commands.
fn commands(release: Nav2Release, threads: usize) -> Vec<[u64; 2]> {
    let world = World::new(&[[1.0, -0.3, 1.2, 0.1]]);
    let large = [("batch_size", "1000"), ("regenerate_noises", "true")];
    let mut controller = controller(release, &large);
    controller.set_threads(threads);
    let plan = straight([0.0, 0.0], [3.0, 0.0]);
    let mut robot = Robot::default();
    let mut all = Vec::new();
    for part in 0..3 {
        match part {
            1 => controller.set_parameter("vx_std", ParamValue::Number(0.3)).unwrap(),
            2 => controller.reset(),
            _ => {}
        }
        let drive = drive(&world, &mut controller, robot, &plan, 8).unwrap();
        let bits = |it: &Twist2| [it.vx_m_s.to_bits(), it.wz_rad_s.to_bits()];
        all.extend(drive.commands.iter().map(bits));
        robot = drive.robot;
    }
    all
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    for release in Nav2Release::ALL {
        let one = commands(release, 1);
        for threads in [2, 8] {
            assert_eq!(commands(release, threads), one, "{release}, {threads} threads");
        }
    }
}
