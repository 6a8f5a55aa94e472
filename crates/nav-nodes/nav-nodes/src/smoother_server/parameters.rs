//! Parameters of the smoother server.

use periplus_diagnostics::Diagnostic;
use periplus_params::{ParamValues, params};
use periplus_planners::{Smoother, SmootherKind};

use crate::server_plugins::{PluginEntry, ServerParameters};

params! {
    /// The smoother server.
    #[table(SMOOTHER_SERVER, "smoother_server")]
    pub struct SmootherServerParams {
        /// Names of the smoothers.
        #[param("smoother_plugins")]
        smoother_plugins: Vec<String> = "simple_smoother",
        /// Topic of the costmap.
        #[param("costmap_topic")]
        costmap_topic: String = "global_costmap/costmap_raw",
        /// Topic of the footprint at the pose of the robot.
        #[param("footprint_topic")]
        footprint_topic: String = "global_costmap/published_footprint",
        /// Frame of the robot.
        #[param("robot_base_frame")]
        robot_base_frame: String = "base_link",
        /// Maximum age of transforms; unused, the newest ones are used.
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
        /// Time for which results are kept.
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 10,
    }
}

/// Smoothers of the default list.
const DEFAULT_SMOOTHERS: [(&str, &str); 1] = [("simple_smoother", "nav2_smoother::SimpleSmoother")];

/// Smoother with its parameters; it exists while the server is configured.
pub(super) struct SmootherSlot {
    pub(super) id: String,
    kind: SmootherKind,
    pub(super) values: ParamValues,
    pub(super) smoother: Option<Box<dyn Smoother>>,
}

impl SmootherSlot {
    pub(super) fn configure(&mut self) {
        self.smoother = Some(self.kind.build(self.values.clone()));
    }
}

/// Reads the smoothers. Unknown classes are failures.
pub(super) fn smoothers(server: &mut ServerParameters<'_, '_>) -> Vec<SmootherSlot> {
    let entries = server.plugins("smoother_plugins", &DEFAULT_SMOOTHERS);
    entries.into_iter().filter_map(|entry| smoother(server, entry)).collect()
}

fn smoother(server: &mut ServerParameters<'_, '_>, entry: PluginEntry<'_>) -> Option<SmootherSlot> {
    let PluginEntry { id, class, class_origin, given } = entry;
    match SmootherKind::of_class(&class) {
        Ok(kind) => {
            let values = given.read(kind.table(), &[], server.diagnostics);
            Some(SmootherSlot { id, kind, values, smoother: None })
        }
        Err(error) => {
            let message = format!("`{id}.plugin`: {error}");
            server.fail(Diagnostic::error("unknown-plugin", message).at(class_origin));
            None
        }
    }
}
