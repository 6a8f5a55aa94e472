//! Subscriptions of filters: masks, and the path of speed filters.

use periplus_costmap::LayeredCostmap;
use periplus_costmap::filters::{FilterInfo, FilterKind, FilterMask, SpeedFilter};
use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Mailbox, Qos};
use periplus_msgs::{nav_msgs, nav2_msgs};

use super::{Place, Scene};
use crate::costmap_2d::messages::map;

/// Mask of a filter, on the topic that its filter info names.
pub(super) struct FilterPort {
    filter: String,
    info: Mailbox<nav2_msgs::CostmapFilterInfo>,
    mask: Option<Mailbox<nav_msgs::OccupancyGrid>>,
    has_mask: bool,
}

impl FilterPort {
    pub(super) fn new(place: &Place<'_>, filter: &str, topic: &str) -> Result<Self, GraphError> {
        let info = place.node.mailbox(&place.resolve(topic), Qos::latched(1))?;
        Ok(Self { filter: filter.to_owned(), info, mask: None, has_mask: false })
    }

    /// Returns the filter and the topic for which it waits.
    pub(super) fn waits_for(&self) -> Option<(&str, &str)> {
        let topic = match &self.mask {
            None => self.info.topic(),
            Some(mask) => mask.topic(),
        };
        (!self.has_mask).then_some((self.filter.as_str(), topic))
    }

    pub(super) fn take(
        &mut self,
        costmap: &mut LayeredCostmap,
        place: &Place<'_>,
        complaints: &mut Vec<Diagnostic>,
    ) {
        let mut complain = |what: String| {
            let what = format!("filter `{}`: {what}", self.filter);
            complaints.push(Diagnostic::error("filter-info", what));
        };
        let Some(filter) = costmap.find_mut(&self.filter).and_then(|layer| layer.masked()) else {
            return;
        };
        if let Some(info) = self.info.latest() {
            match FilterKind::from_number(info.r#type) {
                Some(kind) => {
                    let (base, multiplier) = (info.base.into(), info.multiplier.into());
                    filter.set_info(FilterInfo { kind, base, multiplier });
                    let topic = place.resolve(&info.filter_mask_topic);
                    match place.node.mailbox(&topic, Qos::latched(3)) {
                        Ok(mask) => self.mask = Some(mask),
                        Err(error) => complain(error.to_string()),
                    }
                }
                None => complain(format!("type {} is not known", info.r#type)),
            }
        }
        let Some(message) = self.mask.as_ref().and_then(Mailbox::latest) else { return };
        match map(&message) {
            Ok(grid) => {
                filter.set_mask(FilterMask { grid, frame: message.header.frame_id.clone() });
                self.has_mask = true;
            }
            Err(why) => complain(format!("the mask is refused: {why}")),
        }
    }
}

/// Path and speed of the robot, for limits ahead on the path.
pub(super) struct SpeedPort {
    filter: String,
    path: Mailbox<nav_msgs::Path>,
    odometry: Mailbox<nav_msgs::Odometry>,
}

impl SpeedPort {
    pub(super) fn new(
        place: &Place<'_>,
        filter: &str,
        path: &str,
        odometry: &str,
    ) -> Result<Self, GraphError> {
        Ok(Self {
            filter: filter.to_owned(),
            path: place.node.mailbox(&place.resolve(path), Qos::reliable(1))?,
            odometry: place.node.mailbox(&place.resolve(odometry), Qos::best_effort(1))?,
        })
    }

    pub(super) fn take(&self, costmap: &mut LayeredCostmap, scene: &Scene<'_>) {
        let Some(filter) = costmap.find_as::<SpeedFilter>(&self.filter) else { return };
        if let Some(odometry) = self.odometry.latest() {
            let velocity = &odometry.twist.twist.linear;
            filter.set_speed(libm::hypot(velocity.x, velocity.y));
        }
        let Some(path) = self.path.latest() else { return };
        // A path in an unknown frame is not usable.
        let global_from_path = scene.tf.at(scene.global_frame, &path.header.frame_id, 0);
        let Ok((global_from_path, _)) = global_from_path else {
            filter.set_path(Vec::new());
            return;
        };
        let global_from_path = Pose2::from(global_from_path);
        let place = |point: &periplus_msgs::geometry_msgs::PoseStamped| {
            let at = &point.pose.position;
            let placed = global_from_path * Pose2::new(at.x, at.y, 0.0);
            [placed.x_m, placed.y_m]
        };
        filter.set_path(path.poses.iter().map(place).collect());
    }
}
