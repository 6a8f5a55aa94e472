//! Parameters of the planner server.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostic;
use periplus_params::{ParamValues, params};
use periplus_planners::{Planner, PlannerKind};

use crate::server_plugins::{PluginEntry, ServerParameters};

params! {
    /// The planner server.
    #[table(PLANNER_SERVER, "planner_server")]
    pub struct PlannerServerParams {
        /// Names of the planners.
        #[param("planner_plugins")]
        planner_plugins: Vec<String> = "GridBased",
        /// Rate of plans below which a warning is logged; 0 for none.
        #[param("expected_planner_frequency", unit("Hz"))]
        expected_planner_frequency_hz: f64 = 1,
        /// Maximum time that a plan waits for a current costmap; 0 for none (Humble waits without a limit).
        #[param("costmap_update_timeout", unit("s"))]
        costmap_update_timeout_s: f64 = 1,
        /// Returns the path up to the last goal that can be reached (main).
        #[param("allow_partial_planning")]
        allow_partial_planning: bool = false,
        /// Time for which results are kept.
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 10,
    }
}

/// Planners of the default list.
const DEFAULT_PLANNERS: [(&str, &str); 1] = [("GridBased", "nav2_navfn_planner::NavfnPlanner")];

/// Planner with its parameters; it exists while the server is configured.
pub(super) struct PlannerSlot {
    pub(super) id: String,
    kind: PlannerKind,
    pub(super) values: ParamValues,
    pub(super) planner: Option<Box<dyn Planner>>,
}

impl PlannerSlot {
    pub(super) fn configure(&mut self, release: Nav2Release) {
        self.planner = Some(self.kind.build(self.values.clone(), release));
    }
}

/// Reads the planners. Unknown classes are failures.
pub(super) fn planners(server: &mut ServerParameters<'_, '_>) -> Vec<PlannerSlot> {
    let entries = server.plugins("planner_plugins", &DEFAULT_PLANNERS);
    entries.into_iter().filter_map(|entry| planner(server, entry)).collect()
}

fn planner(server: &mut ServerParameters<'_, '_>, entry: PluginEntry<'_>) -> Option<PlannerSlot> {
    let PluginEntry { id, class, class_origin, given } = entry;
    let kind = match PlannerKind::of_class(&class) {
        Ok(kind) => kind,
        Err(error) => {
            let message = format!("`{id}.plugin`: {error}");
            server.fail(Diagnostic::error("unknown-plugin", message).at(class_origin));
            return None;
        }
    };
    let values = given.read(kind.table(), &[], server.diagnostics);
    Some(PlannerSlot { id, kind, values, planner: None })
}
