//! World plugins that define names of services.

use periplus_diagnostics::Diagnostics;
use periplus_plugin_specs::{
    InterpretedPlugin, PluginContext, PluginParent, interpret, library_id,
};
use periplus_scene::World;

/// A plugin such as `gazebo_ros_state` or `gazebo_ros_properties`: a node with a namespace and
/// remappings.
#[derive(Clone, Debug)]
pub(super) struct StatePlugin(InterpretedPlugin);

impl StatePlugin {
    /// Returns the plugins of a library, such as `gazebo_ros_state`.
    pub(super) fn of(scene: &World, library: &str) -> Vec<Self> {
        let context = PluginContext {
            place: PluginParent::World,
            world: Some(scene),
            ..PluginContext::NOWHERE
        };
        // Problems of plugins were reported when the world was read.
        let mut told = Diagnostics::new();
        let ours = scene.plugins.iter().filter(|plugin| library_id(&plugin.filename) == library);
        ours.filter_map(|plugin| interpret(plugin, &context, &mut told)).map(Self).collect()
    }

    /// Returns the full name of a topic or service of its node.
    pub(super) fn resolve(&self, name: &str) -> String {
        self.0.ros.resolve(name)
    }

    /// Returns the publishing period \[ns\]; 0 is after each step.
    #[expect(clippy::cast_possible_truncation, reason = "a period is short; a long one saturates")]
    pub(super) fn period_ns(&self) -> i64 {
        let rate_hz = self.0.values.number("update_rate").unwrap_or_default();
        if rate_hz > 0.0 { (1e9 / rate_hz).round() as i64 } else { 0 }
    }
}
