//! Services of Nav2 and ROS 1.

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Actor, GraphError, Level, Node};
use periplus_msgs::nav_msgs::{SetMap, SetMapResponse};
use periplus_msgs::nav2_msgs::{SetInitialPose, SetInitialPoseResponse};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};

use crate::amcl::node::AmclNode;

pub(crate) fn serve(actor: &mut Actor<AmclNode>) -> Result<(), GraphError> {
    // The second name is that of ROS 1.
    for name in ["reinitialize_global_localization", "global_localization"] {
        actor.serve::<Empty>(name, |state, _, io| {
            state.reinitialize_global_localization(io.node());
            EmptyResponse::default()
        })?;
    }
    actor.serve::<Empty>("request_nomotion_update", |state, _, io| {
        state.request_update(io.node());
        EmptyResponse::default()
    })?;
    actor.serve::<SetInitialPose>("set_initial_pose", |state, request, io| {
        state.set_pose(&request.pose, io.node());
        SetInitialPoseResponse::default()
    })?;
    actor.serve::<SetMap>("set_map", |state, request, io| {
        let is_set = state.set_map(&request.map, io.node());
        let success = is_set && state.set_pose(&request.initial_pose, io.node());
        SetMapResponse { success }
    })
}

impl AmclNode {
    fn reinitialize_global_localization(&mut self, node: &Node) {
        let Some(amcl) = self.active_filter(node) else { return };
        match amcl.distribute_uniformly() {
            Ok(()) => node.log(
                Level::Info,
                "global localization: particles are distributed over the whole map",
            ),
            Err(why) => self.log.report(&why, node),
        }
    }

    fn request_update(&mut self, node: &Node) {
        if let Some(amcl) = self.active_filter(node) {
            amcl.request_update();
        }
    }

    /// Returns the filter, or logs that the node is not active.
    fn active_filter(&mut self, node: &Node) -> Option<&mut periplus_localization::Amcl> {
        if node.is_active() {
            return self.amcl.as_mut();
        }
        let inactive =
            Diagnostic::warning("not-active", "a service was called, but the node is not active")
                .help("configure and activate it first");
        self.log.report(&inactive, node);
        None
    }
}
