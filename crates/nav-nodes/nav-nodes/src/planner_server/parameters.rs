//! Parameters of the planner server.

use std::path::Path;

use periplus_controllers::PluginSetup;
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Origin};
use periplus_params::{ParamValues, Table, params};
use periplus_planners::{Lattice, Planner, PlannerKind, SmacHybridPlanner};
use periplus_resources::Host;

use crate::navigation_plugins::{CreatePlugin, PluginClasses};
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

/// Parameter of the State Lattice planner.
const LATTICE_FILE: &str = "lattice_filepath";

/// Planners of the default list.
const DEFAULT_PLANNERS: [(&str, &str); 1] = [("GridBased", "nav2_navfn_planner::NavfnPlanner")];

/// Parameters of a planner that declares none.
static UNDECLARED: Table =
    Table { name: "planner", doc: "A planner without declared parameters.", parameters: &[] };

/// Origin of a planner.
enum PlannerSource {
    /// A planner of Nav2, which is created when the server is configured.
    BuiltIn(PlannerKind),
    /// The State Lattice planner with the motions of its file.
    Lattice(Box<Lattice>),
    /// A registered class. Its planner is created once, and kept here while the server is not configured.
    Registered(Option<Box<dyn Planner>>),
}

/// Planner with its parameters; it exists while the server is configured.
pub(super) struct PlannerSlot {
    pub(super) id: String,
    source: PlannerSource,
    pub(super) values: ParamValues,
    pub(super) planner: Option<Box<dyn Planner>>,
}

impl PlannerSlot {
    pub(super) fn configure(&mut self, release: Nav2Release) {
        match &mut self.source {
            PlannerSource::BuiltIn(kind) => {
                self.planner = Some(kind.build(self.values.clone(), release));
            }
            PlannerSource::Lattice(lattice) => {
                let lattice = Lattice::clone(lattice);
                let planner = SmacHybridPlanner::with_lattice(self.values.clone(), lattice);
                self.planner = Some(Box::new(planner));
            }
            PlannerSource::Registered(kept) => {
                self.planner = kept.take().or(self.planner.take());
                self.update_parameters();
            }
        }
    }

    /// Passes values to a registered planner that were set while it was not in use.
    fn update_parameters(&mut self) {
        let Some(planner) = &mut self.planner else { return };
        for name in self.values.names() {
            let Some(value) = self.values.get(&name) else { continue };
            let known = planner.parameters().and_then(|values| values.get(&name));
            if known.as_ref() != Some(&value) {
                // A parameter that is read once keeps its value.
                let _ = planner.set_parameter(&name, &value);
            }
        }
    }

    pub(super) fn cleanup(&mut self) {
        match &mut self.source {
            PlannerSource::BuiltIn(_) | PlannerSource::Lattice(_) => self.planner = None,
            PlannerSource::Registered(kept) => *kept = self.planner.take().or(kept.take()),
        }
    }
}

/// Registered classes of planners.
type PlannerClasses = PluginClasses<CreatePlugin<dyn Planner>>;

/// Reads the planners. Unknown classes are failures.
pub(super) fn planners(
    server: &mut ServerParameters<'_, '_>,
    classes: &PlannerClasses,
    files: &dyn Host,
    release: Nav2Release,
) -> Vec<PlannerSlot> {
    let entries = server.plugins("planner_plugins", &DEFAULT_PLANNERS);
    let mut slots = Vec::new();
    for entry in entries {
        slots.extend(planner(server, entry, (classes, files), release));
    }
    slots
}

fn planner(
    server: &mut ServerParameters<'_, '_>,
    entry: PluginEntry<'_>,
    (classes, files): (&PlannerClasses, &dyn Host),
    release: Nav2Release,
) -> Option<PlannerSlot> {
    let PluginEntry { id, class, class_origin, given } = entry;
    if let Some(create) = classes.find(&class) {
        let setup = PluginSetup { release, given, ..PluginSetup::new(&id) }.at(class_origin);
        let planner = server.create(&setup, &class, create)?;
        let values = planner.parameters().cloned();
        let values = values.unwrap_or_else(|| ParamValues::defaults(&UNDECLARED));
        let source = PlannerSource::Registered(Some(planner));
        return Some(PlannerSlot { id, source, values, planner: None });
    }
    let kind = match PlannerKind::of_class(&class) {
        Ok(kind) => kind,
        Err(error) => {
            let message = format!("`{id}.plugin`: {error}");
            let error = Diagnostic::error("unknown-plugin", message).at(class_origin);
            server.fail(classes.advise(&class, error));
            return None;
        }
    };
    let values = given.read(kind.table(), &[], server.diagnostics);
    let mut source = PlannerSource::BuiltIn(kind);
    let path = if kind == PlannerKind::SmacLattice { values.text(LATTICE_FILE) } else { None };
    if let Some(path) = path.filter(|path| !path.trim().is_empty()) {
        let lattice = lattice(server, &id, (&path, values.origin(LATTICE_FILE)), files)?;
        source = PlannerSource::Lattice(Box::new(lattice));
    }
    Some(PlannerSlot { id, source, values, planner: None })
}

/// Reads the lattice file of a planner; a file that cannot be used is a failure.
fn lattice(
    server: &mut ServerParameters<'_, '_>,
    id: &str,
    (path, origin): (&str, Origin),
    files: &dyn Host,
) -> Option<Lattice> {
    let read = || -> Result<Lattice, String> {
        let bytes = files.read(Path::new(path.trim())).map_err(|error| error.to_string())?;
        let text = String::from_utf8(bytes).map_err(|_| "it is not a text file".to_owned())?;
        Lattice::read_json(&text).map_err(|error| error.to_string())
    };
    let found = read();
    if let Err(why) = &found {
        let message = format!("`{id}.{LATTICE_FILE}`: {path} cannot be used: {why}");
        let help = "give the path of a file of nav2_smac_planner's `lattice_primitives`, or leave it out for a car \
                    with a turning radius of 0.5 m on cells of 0.05 m";
        let error = Diagnostic::error("lattice-file", message).at(origin);
        server.fail(error.help(help));
    }
    found.ok()
}
