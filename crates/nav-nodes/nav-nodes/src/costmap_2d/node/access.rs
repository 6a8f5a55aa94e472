//! Access of a server to the costmap that it owns.

use periplus_costmap::tables::CostmapParams;
use periplus_costmap::{CostmapView, Nav2Release};
use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_msgs::geometry_msgs::PoseStamped;

use super::{CostmapNode, robot};
use crate::costmap_2d::messages::pose2;

impl CostmapNode {
    /// Release of Nav2 whose behaviour is used, and the one whose message types are used.
    #[must_use]
    pub fn releases(&self) -> (Nav2Release, Nav2Release) {
        (self.config.compat, self.config.forms)
    }

    /// Parameters of the node.
    #[must_use]
    pub fn params(&self) -> &CostmapParams {
        &self.params
    }

    /// Read access for planners and controllers; none until it is configured.
    #[must_use]
    pub fn view(&self) -> Option<CostmapView<'_>> {
        let footprint = self.params.footprint.trim();
        let is_circular = footprint.is_empty() || footprint == "[]";
        Some(self.costmap.as_ref()?.view(is_circular))
    }

    /// Returns the current pose of the robot in the global frame.
    ///
    /// # Errors
    /// When a transform is missing or older than `transform_tolerance`, with advice.
    pub fn robot_pose(&mut self, now_ns: i64) -> Result<Pose2, Box<Diagnostic>> {
        self.tf.listen();
        robot(&self.tf, &self.params, &self.config.node, now_ns)
    }

    /// Transforms a pose of a frame at a time \[ns\], 0 for the newest, to the global frame. If there is no
    /// transform of that time, the newest one is used while it is not older than `transform_tolerance`.
    ///
    /// # Errors
    /// The reason why there is no transform.
    pub(crate) fn global_pose_of(
        &mut self,
        frame: &str,
        pose: Pose2,
        time_ns: i64,
    ) -> Result<Pose2, String> {
        self.tf.listen();
        let global = &self.params.global_frame;
        if frame == global {
            return Ok(pose);
        }
        let found = self.tf.at(global, frame, time_ns).or_else(|error| {
            let newest = self.tf.at(global, frame, 0)?;
            let is_near = (time_ns - newest.1) as f64 <= self.params.transform_tolerance_s * 1e9;
            if is_near { Ok(newest) } else { Err(error) }
        });
        match found {
            Ok((global_from_frame, _)) => Ok(Pose2::from(global_from_frame) * pose),
            Err(why) => Err(format!("there is no transform from `{frame}` to `{global}`: {why}")),
        }
    }

    /// Returns a warning if the inflation ends before the corners of the footprint. Planners and controllers
    /// then keep too little distance, because cells near a corner are free.
    #[must_use]
    pub fn footprint_advice(&self) -> Option<Diagnostic> {
        let view = self.view().filter(|view| !view.is_circular)?;
        let (inflation, corner_m) = (view.inflation?, view.footprint.circumscribed_radius_m);
        if inflation.radius_m >= corner_m {
            return None;
        }
        let message = format!(
            "the inflation radius of {:.2} m is smaller than the circumscribed radius of the footprint, {corner_m:.2} m",
            inflation.radius_m
        );
        let help =
            format!("set `inflation_radius` of the inflation layer to at least {corner_m:.2}");
        Some(Diagnostic::warning("small-inflation", message).help(help))
    }

    /// Returns the reason why the costs are not up to date; none if they are.
    #[must_use]
    pub fn delay(&self, now_ns: i64) -> Option<String> {
        let Some(costmap) = &self.costmap else {
            return Some("the costmap is not configured".to_owned());
        };
        let late: Vec<String> = costmap
            .all()
            .filter(|layer| layer.is_enabled() && !layer.is_current(now_ns))
            .map(|layer| format!("`{}`", layer.name()))
            .collect();
        if !late.is_empty() {
            return Some(format!("these layers have no current data: {}", late.join(", ")));
        }
        if !costmap.is_initialized() {
            return Some("the costmap has not been updated yet".to_owned());
        }
        (!costmap.is_current(now_ns)).then(|| "the costmap is not current".to_owned())
    }

    /// Transforms a pose message to the global frame; see [`Self::global_pose_of`].
    ///
    /// # Errors
    /// As [`Self::global_pose_of`].
    pub(crate) fn global_pose(&mut self, pose: &PoseStamped) -> Result<Pose2, String> {
        self.global_pose_of(&pose.header.frame_id, pose2(&pose.pose), pose.header.stamp.ns())
    }
}
