//! What others may do to the world.

use periplus_graph::{Calls, GraphError, Node, NodeSettings};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};

use crate::Simulation;

/// The services of the world. They are looked at between steps.
pub struct Services {
    pause: Calls<Empty>,
    unpause: Calls<Empty>,
    reset_simulation: Calls<Empty>,
    reset_world: Calls<Empty>,
    is_paused: bool,
}

impl Services {
    /// Offers them on the graph of a simulation, under the names that `gazebo_ros` gives them.
    ///
    /// # Errors
    /// When a node of the world's name is there.
    pub fn new(simulation: &Simulation) -> Result<Self, GraphError> {
        let node: Node = simulation.graph().node(NodeSettings::new("gazebo"))?;
        Ok(Self {
            pause: node.server("/pause_physics")?,
            unpause: node.server("/unpause_physics")?,
            reset_simulation: node.server("/reset_simulation")?,
            reset_world: node.server("/reset_world")?,
            is_paused: false,
        })
    }

    /// Stops time, or lets it go on.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.is_paused = is_paused;
    }

    /// Whether time goes on.
    #[must_use]
    pub fn may_step(&self) -> bool {
        !self.is_paused
    }

    /// Does what was asked since the last time.
    pub fn serve(&mut self, simulation: &mut Simulation) {
        while let Some(call) = self.pause.take() {
            self.is_paused = true;
            call.answer(EmptyResponse::default());
        }
        while let Some(call) = self.unpause.take() {
            self.is_paused = false;
            call.answer(EmptyResponse::default());
        }
        while let Some(call) = self.reset_simulation.take() {
            simulation.reset();
            call.answer(EmptyResponse::default());
        }
        while let Some(call) = self.reset_world.take() {
            simulation.reset_models();
            call.answer(EmptyResponse::default());
        }
    }
}
