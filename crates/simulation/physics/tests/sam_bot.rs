//! The repository's own robot, read from its files and driven by the plugin's law.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use std::f64::consts::TAU;
use std::path::Path;

use common::*;
use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_physics::drives::{ClassicDiffDrive, ClassicDrive, Odometry, WheelPair, true_twist};
use periplus_physics::{JointCommand, Kinematic, PhysicsWorld, Twist};
use periplus_resources::Resolver;
use periplus_scene::{Collision, DVec3, Link, Model, Pose, Shape};

fn sam_bot() -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let host = Machine;
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: root.clone(),
        arguments: vec![("drive_wheel_separation".into(), "0.36".into())],
        open_meshes: false,
    };
    let loaded = load(&root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro"), &setting);
    assert!(!loaded.diagnostics.has_errors());
    loaded.scene.unwrap().models.remove(0)
}

/// The robot on a plane, its plugin updated at 100 Hz.
struct Drive {
    world: PhysicsWorld,
    plugin: ClassicDrive,
    law: ClassicDiffDrive,
    joints: [periplus_physics::JointId; 2],
    base: periplus_physics::LinkId,
}

impl Drive {
    fn start() -> Self {
        let mut world = flat_world();
        let model = put(&mut world, &sam_bot(), Pose::from_xyz(0.0, 0.0, 0.15));
        let joint = |name: &str| world.find_joint(model, name).unwrap();
        let joints = [joint("drivewhl_l_joint"), joint("drivewhl_r_joint")];
        let base = world.find_link(model, "base_link").unwrap();
        let law = ClassicDiffDrive {
            pairs: vec![WheelPair { separation_m: 0.36, diameter_m: 0.2 }],
            max_wheel_acceleration_m_s2: 1.0,
            max_wheel_torque_n_m: 20.0,
            ..ClassicDiffDrive::default()
        };
        let mut drive = Self { world, plugin: ClassicDrive::default(), law, joints, base };
        drive.go(Twist::default(), 1.0);
        drive.plugin.odometry = Odometry::default();
        drive
    }

    fn go(&mut self, twist: Twist, time_s: f64) {
        for _ in 0..(time_s * 100.0).round() as usize {
            let now = self.joints.map(|joint| self.world.axis_state(joint).unwrap().velocity);
            let wanted = self.plugin.update(&self.law, twist, &[now], 0.01);
            for (joint, target) in self.joints.into_iter().zip(wanted[0]) {
                let max_effort = self.law.max_wheel_torque_n_m;
                self.world.command(joint, JointCommand::Velocity { target, max_effort });
            }
            run(&mut self.world, 0.01);
        }
    }

    fn pose(&self) -> Pose {
        self.world.link_state(self.base).unwrap().world_from_link
    }
}

#[test]
fn a_minute_straight_at_half_a_metre_per_second_then_a_minute_at_rest() {
    let mut drive = Drive::start();
    let start = drive.pose();
    drive.go(Twist { x_m_s: 0.5, ..Twist::default() }, 60.0);
    let way = start.inverse() * drive.pose();
    let state = drive.world.link_state(drive.base).unwrap();
    let seen = true_twist(state.world_from_link, state.linear_m_s, state.angular_rad_s);
    println!("sam_bot straight: {:?}, odometry {:?}", way.translation, drive.plugin.odometry.pose);
    // Half a second of acceleration costs 0.125 m.
    assert!((way.translation.x - 29.875).abs() < 0.15, "{way:?}");
    assert!(way.translation.y.abs() < 0.005 * way.translation.x, "{way:?}");
    assert!((seen.x_m_s - 0.5).abs() < 0.005, "{seen:?}");
    // Encoders see the wheels, not their slip.
    let encoder = drive.plugin.odometry.pose;
    assert!((encoder.x_m - way.translation.x).abs() < 0.005 * way.translation.x, "{encoder:?}");
    // And it stands still again: far under a millimetre in a minute.
    drive.go(Twist::default(), 2.0);
    let stopped = drive.pose();
    drive.go(Twist::default(), 60.0);
    let (metres, _) = stopped.distance_to(drive.pose());
    println!("sam_bot creeps {metres} m in a minute");
    assert!(metres < 1e-4, "{metres}");
}

#[test]
fn ten_turns_in_place() {
    let mut drive = Drive::start();
    let (mut yaw, mut before) = (0.0, drive.pose().rpy().yaw);
    let encoder_before = drive.plugin.odometry.pose.yaw_rad;
    let time_s = 10.0 * TAU;
    for _ in 0..(time_s * 10.0) as usize {
        drive.go(Twist { yaw_rad_s: 1.0, ..Twist::default() }, 0.1);
        let now = drive.pose().rpy().yaw;
        yaw += libm::remainder(now - before, TAU);
        before = now;
    }
    let encoder = drive.plugin.odometry.pose.yaw_rad - encoder_before;
    println!("sam_bot in place: {yaw}, encoders {encoder}");
    // Within a hundredth of the command, ramp and slip included.
    assert!((yaw - time_s).abs() < 0.01 * time_s, "{yaw}");
    assert!((yaw - encoder).abs() < 0.01 * encoder, "{yaw} {encoder}");
}

#[test]
fn it_stops_at_a_wall_and_climbs_a_centimetre() {
    let block = |x: f64, z: f64, size_m: DVec3| {
        let link = Link {
            collisions: vec![Collision::new("block", Shape::Box { size_m })],
            ..Link::new("block")
        };
        (Model { is_static: true, ..model("block", vec![link], vec![]) }, Pose::from_xyz(x, 0.0, z))
    };
    let forward = Twist { x_m_s: 0.5, ..Twist::default() };
    let mut drive = Drive::start();
    let (wall, pose) = block(2.1, 0.5, DVec3::new(0.2, 6.0, 1.0));
    put(&mut drive.world, &wall, pose);
    drive.go(forward, 8.0);
    for _ in 0..20 {
        drive.go(forward, 0.1);
        let DVec3 { x, y, .. } = drive.pose().translation;
        println!("sam_bot at the wall: {x} {y} {}", drive.pose().rpy().pitch);
        // The front of the camera is 0.2225 m ahead of the robot's middle.
        assert!((x - 1.7775).abs() < 0.003 && y.abs() < 0.01, "{x} {y}");
    }
    let mut drive = Drive::start();
    let (step, pose) = block(2.0, 0.005, DVec3::new(2.0, 6.0, 0.01));
    put(&mut drive.world, &step, pose);
    drive.go(forward, 4.5);
    let DVec3 { x, z, .. } = drive.pose().translation;
    println!("sam_bot on the step: {x} {z}");
    assert!(x > 1.8 && (z - 0.16).abs() < 0.003, "{x} {z}");
}

#[test]
fn an_arc_agrees_with_the_exact_one() {
    let mut drive = Drive::start();
    drive.law.max_wheel_acceleration_m_s2 = 0.0;
    let start = drive.pose();
    let twist = Twist { x_m_s: 0.4, y_m_s: 0.0, yaw_rad_s: 0.4 };
    drive.go(twist, 5.0);
    let way = start.inverse() * drive.pose();
    // The robot turns about the middle of its axle, 0.12 m behind the body's centre.
    let arc = Kinematic::default().advanced(twist, 5.0).pose();
    let expected = Pose::from_xyz(-0.12, 0.0, 0.0) * arc * Pose::from_xyz(0.12, 0.0, 0.0);
    let (metres, radians) = way.distance_to(expected);
    println!("sam_bot arc: {metres} m, {radians} rad off after 2 m");
    assert!(metres < 0.03 && radians < 0.03, "{metres} {radians}");
}
