//! The repository's own robot, read from its files and driven by the plugin's law.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use std::f64::consts::TAU;
use std::path::Path;

use common::*;
use periplus_dynamics::drives::{ClassicDiffDrive, ClassicDrive, Odometry, WheelPair, truth};
use periplus_dynamics::{Command, Kinematic, Twist, World};
use periplus_formats::{Setting, load};
use periplus_host::Machine;
use periplus_resources::Resolver;
use periplus_scene::{Model, Pose};

fn sam_bot() -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let host = Machine;
    let resolver = Resolver::new(&host, &[]);
    let setting = Setting {
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
    world: World,
    plugin: ClassicDrive,
    law: ClassicDiffDrive,
    joints: [periplus_dynamics::JointId; 2],
    base: periplus_dynamics::LinkId,
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
                self.world.command(joint, Command::Velocity { target, max_effort });
            }
            run(&mut self.world, 0.01);
        }
    }

    fn pose(&self) -> Pose {
        self.world.link_state(self.base).unwrap().world_from_link
    }
}

#[test]
fn ten_seconds_straight_at_half_a_metre_per_second() {
    let mut drive = Drive::start();
    let start = drive.pose();
    drive.go(Twist { x_m_s: 0.5, ..Twist::default() }, 10.0);
    let way = start.inverse() * drive.pose();
    let state = drive.world.link_state(drive.base).unwrap();
    let seen = truth(state.world_from_link, state.linear_m_s, state.angular_rad_s);
    println!("sam_bot straight: {:?}, odometry {:?}", way.translation, drive.plugin.odometry.pose);
    // Half a second of acceleration costs 0.125 m.
    assert!((way.translation.x - 4.87).abs() < 0.05, "{way:?}");
    assert!(way.translation.y.abs() < 0.005 * 4.87, "{way:?}");
    assert!((seen.x_m_s - 0.5).abs() < 0.005, "{seen:?}");
    // Encoders see the wheels, not their slip.
    let encoder = drive.plugin.odometry.pose;
    assert!((encoder.x_m - way.translation.x).abs() < 0.01 * way.translation.x, "{encoder:?}");
    // And it stands still again.
    drive.go(Twist::default(), 2.0);
    let stopped = drive.pose();
    drive.go(Twist::default(), 6.0);
    let (metres, _) = stopped.distance_to(drive.pose());
    println!("sam_bot creeps {metres} m in 6 s");
    assert!(metres < 1e-4, "{metres}");
}

#[test]
fn two_turns_in_place() {
    let mut drive = Drive::start();
    let (mut yaw, mut before) = (0.0, drive.pose().rpy().yaw);
    let encoder_before = drive.plugin.odometry.pose.yaw_rad;
    for _ in 0..(2.0 * TAU * 10.0) as usize {
        drive.go(Twist { yaw_rad_s: 1.0, ..Twist::default() }, 0.1);
        let now = drive.pose().rpy().yaw;
        yaw += libm::remainder(now - before, TAU);
        before = now;
    }
    let encoder = drive.plugin.odometry.pose.yaw_rad - encoder_before;
    println!("sam_bot in place: {yaw}, encoders {encoder}");
    assert!((yaw - encoder).abs() < 0.01 * encoder, "{yaw} {encoder}");
    assert!((encoder - 12.5).abs() < 0.2, "{encoder}");
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
    let arc = Kinematic::default().moved(twist, 5.0).pose();
    let expected = Pose::from_xyz(-0.12, 0.0, 0.0) * arc * Pose::from_xyz(0.12, 0.0, 0.0);
    let (metres, radians) = way.distance_to(expected);
    println!("sam_bot arc: {metres} m, {radians} rad off after 2 m");
    assert!(metres < 0.03 && radians < 0.03, "{metres} {radians}");
}
