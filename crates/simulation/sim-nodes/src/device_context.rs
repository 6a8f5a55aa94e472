//! What a device is told when it is made.

use periplus_graph::Graph;
use periplus_physics::{LinkId, ModelId, World};
use periplus_plugin_specs::Site;
use periplus_scene as scene;
use periplus_sensors::Quirks;

/// Where a device stands and what it may use.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// Where it publishes and listens.
    pub graph: &'a Graph,
    /// What moves.
    pub world: &'a World,
    /// The world as the file has it.
    pub scene: &'a scene::World,
    /// The outermost model, as the file has it.
    pub root: &'a scene::Model,
    /// The same model in `world`.
    pub model: ModelId,
    /// What the model is called here; several robots may come from one file.
    pub model_name: &'a str,
    /// Namespace put before every relative name; `/` is none.
    pub namespace: &'a str,
    /// `from:=to` for every node of the model.
    pub remaps: &'a [String],
    /// Seed of all noise.
    pub seed: u64,
    /// Which oddities of Gazebo are wanted.
    pub quirks: Quirks,
    /// Whether beams of a lidar are measured one after the other while the robot moves.
    pub rolling_scans: bool,
    /// The time at which it begins \[ns\].
    pub start_ns: i64,
    /// Whether the joints of a robot are told where no plugin does so.
    pub tells_joints: bool,
}

impl Setting<'_> {
    /// The name of a link in the outermost model, scoped: `arm::hand` for the link `hand` of a
    /// model `arm` inside.
    #[must_use]
    pub fn scoped(&self, site: &Site<'_>, name: &str) -> String {
        let inner = site.context.model.map(|model| scope_of(self.root, model)).unwrap_or_default();
        format!("{inner}{name}")
    }

    /// A link by its name as seen from where a plugin stands.
    #[must_use]
    pub fn link(&self, site: &Site<'_>, name: &str) -> Option<LinkId> {
        self.world.find_link(self.model, &self.scoped(site, name))
    }
}

/// `a::b::` for a model `b` inside `a` inside the outermost; nothing for the outermost itself.
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
