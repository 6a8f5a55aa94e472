//! Simulates a robot from its URDF: kbot drives straight for two seconds.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::path::Path;

use periplus::graph::{NodeSettings, Qos};
use periplus::loader::LoadContext;
use periplus::msgs::geometry_msgs::Twist;
use periplus::msgs::nav_msgs::Odometry;
use periplus::os::Machine;
use periplus::resources::Resolver;
use periplus::sim::{Options, RobotPlacement, Simulation, compose};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let resolver = Resolver::new(&Machine, &[repository.join("robots"), repository.join("worlds")]);
    let context = LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: repository.clone(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let file = repository.join("robots/kbot/urdf/kbot.urdf.xacro");
    let robot = RobotPlacement { file, ..RobotPlacement::default() };
    let world = repository.join("worlds/closed_room.world");
    let mut composition = compose(&world, &[robot], &context);
    assert!(!composition.has_errors(), "see `composition.files` for the findings");

    // Drives and sensors of the robot are nodes on the graph of the simulation.
    let mut simulation = Simulation::new(&mut composition, Default::default(), Options::default());
    let driver = simulation.graph().node(NodeSettings::new("driver"))?;
    let commands = driver.publisher("/kbot/base_controller/cmd_vel", Qos::reliable(1))?;
    let odometry = driver.mailbox::<Odometry>("/kbot/base_controller/odom", Qos::reliable(1))?;
    let mut twist = Twist::default();
    twist.linear.x = 0.4;
    commands.publish(twist);
    while simulation.time_ns() < 2_000_000_000 {
        simulation.step()?;
    }

    let measured = odometry.latest().ok_or("the drive published no odometry")?;
    let truth = simulation.robot_pose().ok_or("the world has no robot")?;
    let x_m = measured.pose.pose.position.x;
    println!("after 2 s: odometry {x_m:.3} m, truth {:.3} m", truth.translation.x);
    // 2 s at 0.4 m/s, less the acceleration of 1 m/s^2.
    assert!((x_m - 0.72).abs() < 0.03, "{x_m} m");
    assert!((truth.translation.x - x_m).abs() < 0.02, "{} m", truth.translation.x);
    Ok(())
}
