//! Plugins of a world that ask for its services under names of their own.

use periplus_diagnostics::Diagnostics;
use periplus_plugin_specs::{Context, Interpreted, Place, interpret, library_id};
use periplus_scene::World;

/// `gazebo_ros_state` and `gazebo_ros_properties` have a node, with a namespace and remappings.
#[derive(Clone, Debug)]
pub(super) struct StatePlugin(Interpreted);

impl StatePlugin {
    /// Those of a library, such as `gazebo_ros_state`.
    pub(super) fn of(scene: &World, library: &str) -> Vec<Self> {
        let context = Context { place: Place::World, world: Some(scene), ..Context::NOWHERE };
        // What is wrong with them was told when the world was read.
        let mut told = Diagnostics::new();
        let ours = scene.plugins.iter().filter(|plugin| library_id(&plugin.filename) == library);
        ours.filter_map(|plugin| interpret(plugin, &context, &mut told)).map(Self).collect()
    }

    /// The full name of a topic or service of its node.
    pub(super) fn resolve(&self, name: &str) -> String {
        self.0.ros.resolve(name)
    }

    /// How often it publishes \[ns\]; 0 is after each step.
    #[expect(clippy::cast_possible_truncation, reason = "a period is short; a long one saturates")]
    pub(super) fn period_ns(&self) -> i64 {
        let rate_hz = self.0.values.number("update_rate").unwrap_or_default();
        if rate_hz > 0.0 { (1e9 / rate_hz).round() as i64 } else { 0 }
    }
}
