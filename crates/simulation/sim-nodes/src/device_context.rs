//! Inputs for building a device.

use std::sync::Arc;

use periplus_graph::Graph;
use periplus_physics::{LinkId, ModelId, PhysicsWorld};
use periplus_plugin_specs::PluginSite;
use periplus_scene as scene;
use periplus_sensors::Quirks;

use crate::{BuildingFloor, ParameterFiles};

/// Environment of a device: graph, world, model and run options.
#[derive(Clone, Copy)]
pub struct DeviceContext<'a> {
    /// Graph to publish and subscribe on.
    pub graph: &'a Graph,
    /// Physics world.
    pub world: &'a PhysicsWorld,
    /// World description.
    pub scene: &'a scene::World,
    /// Outermost model of the description.
    pub root: &'a scene::Model,
    /// Id of that model in `world`.
    pub model: ModelId,
    /// Name of the model in this run; several robots can come from one file.
    pub model_name: &'a str,
    /// Namespace of relative names; `/` is none.
    pub namespace: &'a str,
    /// True to put absolute names into the namespace, too.
    pub is_confined: bool,
    /// Remappings `from:=to` of every node of the model.
    pub remaps: &'a [String],
    /// Seed of all noise.
    pub seed: u64,
    /// Deviations of Gazebo to reproduce.
    pub quirks: Quirks,
    /// True if the beams of a lidar are measured one after the other while the robot moves.
    pub rolling_scans: bool,
    /// Start time \[ns\].
    pub start_ns: i64,
    /// True if joint states are published when no plugin does.
    pub publishes_joint_states: bool,
    /// True if controllers of `ros2_control` start without a spawner.
    pub starts_controllers: bool,
    /// True if `/tf` of Gazebo's plugins is that of ROS; false where the bridges of a launch file leave it out.
    pub bridges_transforms: bool,
    /// Floors of the building, the lowest first.
    pub floors: &'a [BuildingFloor],
    /// Parameter files of controllers.
    pub parameter_files: &'a Arc<dyn ParameterFiles>,
}

impl DeviceContext<'_> {
    /// Returns the name of a link scoped in the outermost model: `arm::hand` for the link `hand` of
    /// a nested model `arm`.
    #[must_use]
    pub fn scoped(&self, site: &PluginSite<'_>, name: &str) -> String {
        let inner = site.context.model.map(|model| scope_of(self.root, model)).unwrap_or_default();
        format!("{inner}{name}")
    }

    /// Returns a link by its name relative to a plugin's model.
    #[must_use]
    pub fn link(&self, site: &PluginSite<'_>, name: &str) -> Option<LinkId> {
        self.world.find_link(self.model, &self.scoped(site, name))
    }
}

/// Returns `a::b::` for a model `b` inside `a` inside the outermost; empty for the outermost itself.
fn scope_of(root: &scene::Model, model: &scene::Model) -> String {
    fn find(around: &scene::Model, model: &scene::Model, scope: &str) -> Option<String> {
        if std::ptr::eq(around, model) {
            return Some(scope.to_owned());
        }
        around
            .models
            .iter()
            .find_map(|inner| find(inner, model, &format!("{scope}{}::", inner.name)))
    }
    find(root, model, "").unwrap_or_default()
}
