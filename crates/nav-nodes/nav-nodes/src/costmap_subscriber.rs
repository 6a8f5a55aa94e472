//! Costmap and footprint of another node, received as messages.
//!
//! Source: `nav2_costmap_2d/costmap_subscriber.cpp`, `footprint_subscriber.cpp` and
//! `costmap_topic_collision_checker.cpp`.

use periplus_costmap::{Costmap, Footprint};
use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_grid::GridInfo;
use periplus_motion::behaviors::{is_motion_free, is_pose_free};
use periplus_msgs::geometry_msgs::PolygonStamped;
use periplus_msgs::nav2_msgs;

use crate::costmap_2d::frames::Listener;
use crate::costmap_2d::messages::pose2;

/// Queue depth of grids.
const GRID_DEPTH: usize = 3;

/// Queue depth of updates.
const UPDATE_DEPTH: usize = 50;

/// Costmap that another node publishes, kept up to date.
pub(crate) struct CostmapSubscriber {
    topic: String,
    grids: Mailbox<nav2_msgs::Costmap>,
    updates: Mailbox<nav2_msgs::CostmapUpdate>,
    latest: Option<(String, Costmap)>,
}

impl CostmapSubscriber {
    /// Subscribes to a topic of `nav2_msgs/Costmap` and its updates.
    pub(crate) fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        Ok(Self {
            topic: topic.to_owned(),
            grids: node.mailbox(topic, Qos::latched(GRID_DEPTH))?,
            updates: node.mailbox(&format!("{topic}_updates"), Qos::latched(UPDATE_DEPTH))?,
            latest: None,
        })
    }

    /// Processes received messages; returns mistakes in them.
    pub(crate) fn receive(&mut self) -> Result<(), String> {
        let mut result = Ok(());
        let mut grid_ns = None;
        if let Some(message) = self.grids.latest() {
            match read_costmap(&message) {
                Ok(costmap) => {
                    grid_ns = Some(message.header.stamp.ns());
                    self.latest = Some((message.header.frame_id.clone(), costmap));
                }
                Err(why) => result = Err(format!("a costmap on `{}` {why}", self.topic)),
            }
        }
        for update in self.updates.drain() {
            let Some((_, costmap)) = &mut self.latest else { break };
            // A grid contains the updates before it.
            if grid_ns.is_none_or(|grid_ns| grid_ns < update.header.stamp.ns())
                && let Err(why) = apply_update(costmap, &update)
            {
                result = Err(format!("an update of `{}` {why}", self.topic));
            }
        }
        result
    }

    /// Frame and costs; none before the first grid.
    pub(crate) fn latest(&self) -> Option<&(String, Costmap)> {
        self.latest.as_ref()
    }
}

/// Converts a costmap.
pub(crate) fn read_costmap(message: &nav2_msgs::Costmap) -> Result<Costmap, String> {
    let meta = &message.metadata;
    let (width, height) = (meta.size_x as usize, meta.size_y as usize);
    // As the costmap publishes it: seven digits of a resolution in single precision.
    let resolution_m: f64 = meta.resolution.to_string().parse().unwrap_or(0.0);
    let info = GridInfo::new(resolution_m, width, height, pose2(&meta.origin))
        .map_err(|error| format!("is malformed: {error}"))?;
    let count = message.data.len();
    if count != width * height {
        return Err(format!("has {count} cells and should have {width} x {height}"));
    }
    let mut costmap = Costmap::new(info, 0);
    costmap.costs_mut().copy_from_slice(&message.data);
    Ok(costmap)
}

fn apply_update(costmap: &mut Costmap, update: &nav2_msgs::CostmapUpdate) -> Result<(), String> {
    let (width, height) = (costmap.info().width, costmap.info().height);
    let (x, y) = (update.x as usize, update.y as usize);
    let (columns, rows) = (update.size_x as usize, update.size_y as usize);
    let fits = x.checked_add(columns).is_some_and(|end| end <= width)
        && y.checked_add(rows).is_some_and(|end| end <= height)
        && columns.checked_mul(rows) == Some(update.data.len());
    if !fits {
        return Err(format!(
            "with {columns} x {rows} cells at ({x}, {y}) does not fit in {width} x {height} cells"
        ));
    }
    if columns == 0 {
        return Ok(());
    }
    for (row, costs) in update.data.chunks_exact(columns).enumerate() {
        let start = (y + row) * width + x;
        costmap.costs_mut()[start..start + columns].copy_from_slice(costs);
    }
    Ok(())
}

/// Footprint that a costmap publishes, in the base frame.
pub(crate) struct FootprintSubscriber {
    polygons: Mailbox<PolygonStamped>,
    waiting: Option<std::sync::Arc<PolygonStamped>>,
    latest: Option<Footprint>,
}

impl FootprintSubscriber {
    /// Subscribes to a topic of outlines of the robot at its pose.
    pub(crate) fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        let polygons = node.mailbox(topic, Qos::reliable(1))?;
        Ok(Self { polygons, waiting: None, latest: None })
    }

    /// Processes received outlines. Each waits for the pose of the robot at its time.
    pub(crate) fn receive(&mut self, tf: &Listener, base_frame: &str) {
        if let Some(polygon) = self.polygons.latest() {
            self.waiting = Some(polygon);
        }
        let Some(polygon) = &self.waiting else { return };
        let frame = &polygon.header.frame_id;
        let corners = polygon.polygon.points.iter().map(|it| [f64::from(it.x), f64::from(it.y)]);
        let frame_from_base = if frame == base_frame {
            Pose2::IDENTITY
        } else {
            let stamp_ns = polygon.header.stamp.ns();
            // The pose of its time may be about to arrive.
            let found = tf.at(frame, base_frame, stamp_ns).or_else(|_| tf.at(frame, base_frame, 0));
            let Ok((pose, _)) = found else { return };
            Pose2::from(pose)
        };
        let base_from_frame = frame_from_base.inverse();
        let place = |[x, y]: [f64; 2]| {
            let (x, y) = base_from_frame.transform_point(x, y);
            [x, y]
        };
        self.latest = Some(Footprint::new(corners.map(place).collect()));
        self.waiting = None;
    }

    /// The newest footprint.
    pub(crate) fn latest(&self) -> Option<&Footprint> {
        self.latest.as_ref()
    }
}

/// Checks poses of the robot on a costmap of another node.
pub(crate) struct CollisionChecker {
    costmap: CostmapSubscriber,
    footprint: FootprintSubscriber,
}

impl CollisionChecker {
    /// Subscribes to a costmap and a footprint.
    pub(crate) fn new(node: &Node, costmap: &str, footprint: &str) -> Result<Self, GraphError> {
        Ok(Self {
            costmap: CostmapSubscriber::new(node, costmap)?,
            footprint: FootprintSubscriber::new(node, footprint)?,
        })
    }

    /// Processes received messages; returns mistakes in them.
    pub(crate) fn receive(&mut self, tf: &Listener, base_frame: &str) -> Result<(), String> {
        self.footprint.receive(tf, base_frame);
        self.costmap.receive()
    }

    /// Returns the check of poses in a frame.
    ///
    /// # Errors
    /// The reason why poses cannot be checked. They then count as occupied.
    pub(crate) fn check<'a>(
        &'a self,
        tf: &Listener,
        frame: &str,
    ) -> Result<impl Fn(Pose2) -> bool + use<'a>, String> {
        let (costmap, footprint, costmap_from_frame) = self.inputs(tf, frame)?;
        Ok(move |pose| is_pose_free(costmap, footprint, costmap_from_frame * pose))
    }

    /// Returns true if the robot collides nowhere on a motion over poses in a frame, from the one at which it is.
    ///
    /// # Errors
    /// The reason why poses cannot be checked. They then count as occupied.
    pub(crate) fn is_motion_free(
        &self,
        tf: &Listener,
        frame: &str,
        poses: impl IntoIterator<Item = Pose2>,
    ) -> Result<bool, String> {
        let (costmap, footprint, costmap_from_frame) = self.inputs(tf, frame)?;
        let poses: Vec<Pose2> = poses.into_iter().map(|pose| costmap_from_frame * pose).collect();
        Ok(is_motion_free(costmap, footprint, &poses))
    }

    /// Costmap, footprint, and the pose of a frame in that of the costmap.
    fn inputs(&self, tf: &Listener, frame: &str) -> Result<(&Costmap, &Footprint, Pose2), String> {
        let Some((costmap_frame, costmap)) = self.costmap.latest() else {
            return Err(format!("no costmap was received on `{}`", self.costmap.topic));
        };
        let Some(footprint) = self.footprint.latest() else {
            let topic = self.footprint.polygons.topic();
            return Err(format!("no footprint was received on `{topic}`, or without transform"));
        };
        let costmap_from_frame = if costmap_frame == frame {
            Pose2::IDENTITY
        } else {
            let found = tf.at(costmap_frame, frame, 0);
            Pose2::from(found.map_err(|why| why.to_string())?.0)
        };
        Ok((costmap, footprint, costmap_from_frame))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(width: u32, height: u32, data: Vec<u8>) -> nav2_msgs::Costmap {
        let mut message = nav2_msgs::Costmap { data, ..nav2_msgs::Costmap::default() };
        message.metadata.resolution = 0.05;
        (message.metadata.size_x, message.metadata.size_y) = (width, height);
        message
    }

    #[test]
    fn costmaps_are_read_and_updated() {
        let mut costmap = read_costmap(&message(3, 2, vec![0; 6])).unwrap();
        assert_eq!(costmap.resolution_m(), 0.05);
        let (x, y, size_x, size_y) = (1, 0, 2, 2);
        let data = vec![1, 2, 3, 4];
        let header = Default::default();
        let update = nav2_msgs::CostmapUpdate { header, x, y, size_x, size_y, data };
        apply_update(&mut costmap, &update).unwrap();
        assert_eq!(costmap.costs(), [0, 1, 2, 0, 3, 4]);
        let beyond = nav2_msgs::CostmapUpdate { x: 2, ..update.clone() };
        assert!(apply_update(&mut costmap, &beyond).unwrap_err().contains("does not fit"));
        let short = nav2_msgs::CostmapUpdate { data: vec![1], ..update };
        assert!(apply_update(&mut costmap, &short).is_err());
        let malformed = read_costmap(&message(3, 2, vec![0; 5])).unwrap_err();
        assert_eq!(malformed, "has 5 cells and should have 3 x 2");
    }
}
