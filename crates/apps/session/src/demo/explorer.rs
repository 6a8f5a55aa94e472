//! Autonomous exploration, from topics alone as any other node.

use std::sync::Arc;

use periplus_exploration::{Mood, Settings};
use periplus_geometry::{Pose, Pose2};
use periplus_graph::{Graph, GraphError, Mailbox, NodeSettings, Publisher, Qos};
use periplus_grid::{Grid, GridInfo};
use periplus_msgs::geometry_msgs::{self, PoseStamped, Twist};
use periplus_msgs::nav_msgs::{OccupancyGrid, Path};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::TransformKind;
use periplus_tf_ros::Frames;

/// Period of velocity commands \[ns\].
const COMMAND_PERIOD_NS: i64 = 50_000_000;

/// Period of map updates \[ns\].
const MAP_PERIOD_NS: i64 = 1_000_000_000;

/// Half of the robot's width plus a margin \[m\].
const HALF_WIDTH_M: f64 = 0.24;

/// Node that drives the robot to unexplored space.
pub struct ExplorerNode {
    explorer: periplus_exploration::Explorer,
    frames: Frames,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    maps: Mailbox<OccupancyGrid>,
    scans: Mailbox<LaserScan>,
    commands: Publisher<Twist>,
    way: Publisher<Path>,
    map: Option<Arc<OccupancyGrid>>,
    ahead_m: f64,
    next_ns: i64,
    look_ns: i64,
    /// Estimated pose.
    pub map_from_base: Option<Pose2>,
    /// Estimated distance travelled \[m\].
    pub driven_m: f64,
}

impl ExplorerNode {
    pub(super) fn join(graph: &Graph) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("explorer"))?;
        Ok(Self {
            explorer: periplus_exploration::Explorer::new(Settings::default()),
            frames: Frames::default(),
            moving: node.mailbox("/tf", Qos::reliable(100))?,
            fixed: node.mailbox("/tf_static", Qos::latched(100))?,
            maps: node.mailbox("/map", Qos::latched(1))?,
            scans: node.mailbox("/scan", Qos::sensor_data())?,
            commands: node.publisher("/cmd_vel", Qos::reliable(1))?,
            way: node.publisher("/plan", Qos::reliable(1))?,
            map: None,
            ahead_m: 0.0,
            next_ns: 0,
            look_ns: 0,
            map_from_base: None,
            driven_m: 0.0,
        })
    }

    /// State of the exploration.
    #[must_use]
    pub fn mood(&self) -> Mood {
        self.explorer.mood()
    }

    /// Processes everything due at this time.
    pub(super) fn spin_once(&mut self, now_ns: i64) {
        if now_ns < self.next_ns {
            return;
        }
        self.next_ns = now_ns + COMMAND_PERIOD_NS;
        for message in self.fixed.drain() {
            self.frames.take(&message, TransformKind::Fixed);
        }
        for message in self.moving.drain() {
            self.frames.take(&message, TransformKind::Moving);
        }
        self.map = self.maps.latest().or(self.map.take());
        if let Some(scan) = self.scans.latest() {
            self.ahead_m = self.ahead(&scan).unwrap_or(self.ahead_m);
        }
        let Ok((pose, _)) = self.frames.at("map", "base_link", 0) else { return };
        let here = Pose2::from(pose);
        if let Some(before) = self.map_from_base.replace(here) {
            self.driven_m += libm::hypot(here.x_m - before.x_m, here.y_m - before.y_m);
        }
        if now_ns >= self.look_ns
            && let Some(map) = self.map.as_deref().and_then(grid_of)
        {
            self.look_ns = now_ns + MAP_PERIOD_NS;
            self.explorer.see(&map, here);
            self.tell_way(now_ns);
        }
        let velocity = self.explorer.drive(now_ns, here, self.ahead_m);
        let mut command = Twist::default();
        command.linear.x = velocity.forward_m_s;
        command.angular.z = velocity.left_rad_s;
        self.commands.publish(command);
    }

    /// Distance from the centre of the robot to the nearest obstacle ahead \[m\].
    fn ahead(&self, scan: &LaserScan) -> Option<f64> {
        let (pose, _) = self.frames.at("base_link", &scan.header.frame_id, 0).ok()?;
        let base_from_laser = Pose2::from(pose);
        let mut nearest_m = f64::from(scan.range_max);
        for (beam, range) in scan.ranges.iter().enumerate() {
            let angle = f64::from(scan.angle_min) + beam as f64 * f64::from(scan.angle_increment);
            if !(scan.range_min..=scan.range_max).contains(range) {
                continue;
            }
            let range = f64::from(*range);
            let (sine, cosine) = libm::sincos(angle);
            let (x, y) = base_from_laser.transform_point(range * cosine, range * sine);
            if x > 0.0 && y.abs() < HALF_WIDTH_M {
                nearest_m = nearest_m.min(x);
            }
        }
        Some(nearest_m)
    }

    fn tell_way(&self, now_ns: i64) {
        if !self.way.is_heard() {
            return;
        }
        let header = Header::at(now_ns, "map");
        let stamped = |[x, y]: &[f64; 2]| {
            let mut pose = geometry_msgs::Pose::default();
            (pose.position.x, pose.position.y) = (*x, *y);
            PoseStamped { header: header.clone(), pose }
        };
        let poses = self.explorer.way().iter().map(stamped).collect();
        self.way.publish(Path { header: header.clone(), poses });
    }
}

/// Map as cells; `None` if it is malformed.
fn grid_of(map: &OccupancyGrid) -> Option<periplus_grid::OccupancyGrid> {
    let (at, turned) = (&map.info.origin.position, &map.info.origin.orientation);
    let turned = periplus_geometry::DQuat::from_xyzw(turned.x, turned.y, turned.z, turned.w);
    let origin = Pose2::from(Pose::from_xyz_quaternion([at.x, at.y, 0.0], turned));
    let (width, height) = (map.info.width as usize, map.info.height as usize);
    let info = GridInfo::new(f64::from(map.info.resolution), width, height, origin).ok()?;
    Grid::from_cells(info, map.data.to_vec()).ok()
}
