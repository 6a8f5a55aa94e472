//! The services of Nav2, and those of ROS 1.

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Actor, GraphError, Level, Node};
use periplus_msgs::nav_msgs::{SetMap, SetMapResponse};
use periplus_msgs::nav2_msgs::{SetInitialPose, SetInitialPoseResponse};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};

use crate::amcl::node::State;

pub(crate) fn serve(actor: &mut Actor<State>) -> Result<(), GraphError> {
    // The second is its name in ROS 1.
    for name in ["reinitialize_global_localization", "global_localization"] {
        actor.serve::<Empty>(name, |state, _, io| {
            state.spread(io.node());
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
        let is_taken = state.take_map(&request.map, io.node());
        let success = is_taken && state.set_pose(&request.initial_pose, io.node());
        SetMapResponse { success }
    })
}

impl State {
    fn spread(&mut self, node: &Node) {
        let Some(amcl) = self.running(node) else { return };
        match amcl.spread() {
            Ok(()) => node.log(Level::Info, "the robot may be anywhere: particles are everywhere"),
            Err(why) => self.told.tell(&why, node),
        }
    }

    fn request_update(&mut self, node: &Node) {
        if let Some(amcl) = self.running(node) {
            amcl.request_update();
        }
    }

    /// The filter, unless the node is not active, which is told.
    fn running(&mut self, node: &Node) -> Option<&mut periplus_localization::Amcl> {
        if self.is_active {
            return self.amcl.as_mut();
        }
        let inactive =
            Diagnostic::warning("not-active", "somebody asks, but the node is not active")
                .help("configure and activate it first");
        self.told.tell(&inactive, node);
        None
    }
}
