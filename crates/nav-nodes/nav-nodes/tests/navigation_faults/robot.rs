//! Robot that moves as it is commanded, with a lidar, in a world of walls.

use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{Mailbox, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::Twist;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;

use crate::common::{quaternion, transforms};

/// Time step of the motion \[ns\].
pub(crate) const STEP_NS: i64 = 10_000_000;
/// Period of the scans \[ns\].
const SCAN_PERIOD_NS: i64 = 100_000_000;
/// Maximum range of the lidar \[m\].
const MAX_RANGE_M: f32 = 3.5;
/// Number of rays of the lidar.
const RAY_COUNT: u16 = 90;

/// Inputs and outputs that can fail.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Faults {
    /// The wheels turn, and the robot stays where it is.
    pub(crate) is_stuck: bool,
    /// No transforms.
    pub(crate) has_no_tf: bool,
    /// No scans.
    pub(crate) has_no_scan: bool,
}

pub(crate) struct Robot {
    pub(crate) pose: Pose2,
    /// Last command; the robot obeys it until the next one.
    pub(crate) command: Twist2,
    pub(crate) faults: Faults,
    is_wall: fn(f64, f64) -> bool,
    /// True once the robot was in a wall.
    pub(crate) has_collided: bool,
    commands: Mailbox<Twist>,
    tf: Publisher<TFMessage>,
    odometry: Publisher<Odometry>,
    scans: Publisher<LaserScan>,
}

impl Robot {
    pub(crate) fn new(node: &Node, pose: Pose2, is_wall: fn(f64, f64) -> bool) -> Self {
        Self {
            pose,
            command: Twist2::ZERO,
            faults: Faults::default(),
            is_wall,
            has_collided: false,
            commands: node.mailbox("/cmd_vel", Qos::reliable(100)).unwrap(),
            tf: node.publisher("/tf", Qos::reliable(100)).unwrap(),
            odometry: node.publisher("/odom", Qos::reliable(10)).unwrap(),
            scans: node.publisher("/scan", Qos::best_effort(10)).unwrap(),
        }
    }

    /// Moves for one step up to a time \[ns\], and publishes what the robot measures then.
    pub(crate) fn step(&mut self, now_ns: i64) {
        for twist in self.commands.drain() {
            self.command = Twist2::new(twist.linear.x, twist.linear.y, twist.angular.z);
            assert!(self.command.is_finite(), "{:?}", self.command);
        }
        if !self.faults.is_stuck {
            let step_s = STEP_NS as f64 * 1e-9;
            let Twist2 { vx_m_s, wz_rad_s, .. } = self.command;
            self.pose = self.pose * Pose2::new(vx_m_s * step_s, 0.0, wz_rad_s * step_s);
        }
        self.has_collided |= (self.is_wall)(self.pose.x_m, self.pose.y_m);
        if !self.faults.has_no_tf {
            self.tf.publish(transforms(now_ns, self.pose));
        }
        let mut odometry = Odometry { header: Header::at(now_ns, "odom"), ..Odometry::default() };
        odometry.child_frame_id = "base_link".to_owned();
        odometry.pose.pose.position.x = self.pose.x_m;
        odometry.pose.pose.position.y = self.pose.y_m;
        odometry.pose.pose.orientation = quaternion(self.pose.yaw_rad);
        odometry.twist.twist.linear.x = self.command.vx_m_s;
        odometry.twist.twist.angular.z = self.command.wz_rad_s;
        self.odometry.publish(odometry);
        if !self.faults.has_no_scan && now_ns % SCAN_PERIOD_NS == 0 {
            self.scans.publish(self.scan(now_ns));
        }
    }

    fn scan(&self, now_ns: i64) -> LaserScan {
        let increment = std::f32::consts::TAU / f32::from(RAY_COUNT);
        let range = |ray: u16| {
            let yaw_rad = self.pose.yaw_rad + f64::from(increment * f32::from(ray));
            let (cos, sin) = (libm::cos(yaw_rad), libm::sin(yaw_rad));
            let distances = (0..(MAX_RANGE_M * 50.0) as u16).map(|step| f64::from(step) * 0.02);
            let mut hits = distances.filter(|distance| {
                (self.is_wall)(self.pose.x_m + distance * cos, self.pose.y_m + distance * sin)
            });
            hits.next().map_or(f32::INFINITY, |distance| distance as f32)
        };
        LaserScan {
            header: Header::at(now_ns, "base_link"),
            angle_min: 0.0,
            angle_max: increment * f32::from(RAY_COUNT - 1),
            angle_increment: increment,
            range_min: 0.05,
            range_max: MAX_RANGE_M,
            ranges: (0..RAY_COUNT).map(range).collect(),
            ..LaserScan::default()
        }
    }
}
