//! Controllers, checkers and path handlers of the server.

use periplus_controllers::{
    Controller, GoalChecker, ParameterRefusal, PathHandler, PluginSetup, ProgressChecker,
    controller_classes, create_controller, create_goal_checker, create_path_handler,
};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::ParameterRejection;
use periplus_params::{ParamValue, ParamValues};

use crate::navigation_plugins::{CreatePlugin, PluginClasses, with_colons};
use crate::server_plugins::{PluginEntry, ServerParameters, changed};

const DEFAULT_CONTROLLERS: [(&str, &str); 1] = [("FollowPath", "dwb_core::DWBLocalPlanner")];
const DEFAULT_GOAL_CHECKERS: [(&str, &str); 1] =
    [("goal_checker", "nav2_controller::SimpleGoalChecker")];
const DEFAULT_PROGRESS_CHECKERS: [(&str, &str); 1] =
    [("progress_checker", "nav2_controller::SimpleProgressChecker")];
const DEFAULT_PATH_HANDLERS: [(&str, &str); 1] =
    [("PathHandler", "nav2_controller::FeasiblePathHandler")];

/// A controller.
pub(super) struct ControllerSlot {
    pub(super) id: String,
    pub(super) controller: Box<dyn Controller>,
    /// Path handler with the rules of the controller; none if the server's one is used.
    pub(super) own_handler: Option<PathHandler>,
}

/// Plugins of the server.
#[derive(Default)]
pub(super) struct ControllerPlugins {
    pub(super) controllers: Vec<ControllerSlot>,
    pub(super) goal_checkers: Vec<(String, Box<dyn GoalChecker>)>,
    pub(super) progress_checkers: Vec<(String, ProgressChecker)>,
    pub(super) path_handlers: Vec<(String, PathHandler)>,
}

/// A plugin.
#[derive(Clone, Copy)]
enum PluginIndex {
    Controller(usize),
    GoalChecker(usize),
    ProgressChecker(usize),
    PathHandler(usize),
}

/// Group of parameters of a plugin.
struct PluginGroup {
    plugin: PluginIndex,
    /// Name of the group in the parameters of the node.
    name: String,
    /// Name of the group within that of the plugin, with a dot at its end; empty for its own parameters.
    inner: String,
    values: ParamValues,
}

/// Reads the plugins. Unknown classes are failures.
pub(super) fn plugins(
    server: &mut ServerParameters<'_, '_>,
    classes: &ControllerClasses,
    release: Nav2Release,
    frequency_hz: f64,
) -> ControllerPlugins {
    if release == Nav2Release::Humble
        && let Some(only) = server.node.text("progress_checker_plugin")
    {
        server.node.set("progress_checker_plugins", ParamValue::Texts(vec![only]));
    }
    let setup = |entry: &PluginEntry<'_>| PluginEntrySetup {
        id: entry.id.clone(),
        class: entry.class.clone(),
        release,
        period_s: 1.0 / frequency_hz,
    };
    let mut plugins = ControllerPlugins::default();
    for entry in server.plugins("progress_checker_plugins", &DEFAULT_PROGRESS_CHECKERS) {
        let about = setup(&entry);
        let made = server
            .reading(|found| ProgressChecker::create(&about.class, &about.setup(&entry), found));
        plugins.progress_checkers.extend(made.map(|made| (about.id, made)));
    }
    for entry in server.plugins("goal_checker_plugins", &DEFAULT_GOAL_CHECKERS) {
        let about = setup(&entry);
        let made =
            server.reading(|found| create_goal_checker(&about.class, &about.setup(&entry), found));
        plugins.goal_checkers.extend(made.map(|made| (about.id, made)));
    }
    for entry in server.plugins("path_handler_plugins", &DEFAULT_PATH_HANDLERS) {
        let about = setup(&entry);
        let made =
            server.reading(|found| create_path_handler(&about.class, &about.setup(&entry), found));
        plugins.path_handlers.extend(made.map(|made| (about.id, made)));
    }
    for entry in server.plugins("controller_plugins", &DEFAULT_CONTROLLERS) {
        let about = setup(&entry);
        let made = match classes.find(&about.class) {
            Some(create) => server.create(&about.setup(&entry), &about.class, create),
            None => server.reading(|found| nav2_controller(&about, &entry, classes, found)),
        };
        plugins.controllers.extend(made.map(|controller| {
            let own_handler = controller.path_rules().map(PathHandler::new);
            ControllerSlot { id: about.id, controller, own_handler }
        }));
    }
    plugins
}

/// Registered classes of controllers.
type ControllerClasses = PluginClasses<CreatePlugin<dyn Controller>>;

/// Creates a controller of Nav2. The error about an unknown class names the registered ones, too.
fn nav2_controller(
    about: &PluginEntrySetup,
    entry: &PluginEntry<'_>,
    classes: &ControllerClasses,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let class = with_colons(&about.class);
    let is_known = controller_classes().any(|known| known == class);
    let mut found = Diagnostics::new();
    let made = create_controller(&about.class, &about.setup(entry), &mut found);
    for finding in found.iter().cloned() {
        diagnostics.push(if is_known { finding } else { classes.advise(&about.class, finding) });
    }
    made
}

struct PluginEntrySetup {
    id: String,
    class: String,
    release: Nav2Release,
    period_s: f64,
}

impl PluginEntrySetup {
    fn setup<'a>(&'a self, entry: &PluginEntry<'a>) -> PluginSetup<'a> {
        PluginSetup {
            name: &self.id,
            release: self.release,
            control_period_s: self.period_s,
            given: entry.given.clone(),
            neighbours: Vec::new(),
            class_origin: entry.class_origin,
        }
    }
}

impl ControllerPlugins {
    fn groups(&self) -> Vec<PluginGroup> {
        let mut groups = Vec::new();
        let mut add = |plugin, id: &str, group: &str, values: &ParamValues| {
            let (name, inner) = match group {
                "" => (id.to_owned(), String::new()),
                group => (format!("{id}.{group}"), format!("{group}.")),
            };
            groups.push(PluginGroup { plugin, name, inner, values: values.clone() });
        };
        for (index, slot) in self.controllers.iter().enumerate() {
            for group in slot.controller.parameters() {
                add(PluginIndex::Controller(index), &slot.id, &group.group, group.values);
            }
        }
        for (index, (id, checker)) in self.goal_checkers.iter().enumerate() {
            add(PluginIndex::GoalChecker(index), id, "", checker.parameters());
        }
        for (index, (id, checker)) in self.progress_checkers.iter().enumerate() {
            add(PluginIndex::ProgressChecker(index), id, "", checker.parameters());
        }
        for (index, (id, handler)) in self.path_handlers.iter().enumerate() {
            if let Some(values) = handler.parameters() {
                add(PluginIndex::PathHandler(index), id, "", values);
            }
        }
        groups
    }

    /// Adds the parameters of all plugins to those of the node.
    pub(super) fn add_groups(&self, values: &mut ParamValues) {
        for group in self.groups() {
            // A controller may have two tables in one group; requests can change the first.
            if values.group(&group.name).is_none() {
                values.add_group(group.name, group.values);
            }
        }
    }

    /// Applies the parameters that differ from the current ones; either all or none.
    pub(super) fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        let groups = self.groups();
        let known = groups.iter().map(|group| (group.name.as_str(), &group.values));
        let changes = changed(all, known);
        let mut done: Vec<(PluginIndex, String, Option<ParamValue>)> = Vec::new();
        for (index, name, value) in changes {
            let group = &groups[index];
            let old = group.values.get(&name);
            let name = format!("{}{name}", group.inner);
            if let Err(error) = self.change_one(group.plugin, &name, value) {
                for (plugin, name, old) in done.into_iter().rev() {
                    if let Some(old) = old {
                        // It was accepted before.
                        let _ = self.change_one(plugin, &name, old);
                    }
                }
                let text = format!("`{}`: {error}", group.name);
                return Err(ParameterRejection::new(text));
            }
            done.push((group.plugin, name, old));
        }
        for slot in &mut self.controllers {
            if let (Some(handler), Some(rules)) =
                (&mut slot.own_handler, slot.controller.path_rules())
            {
                handler.set_rules(rules);
            }
        }
        Ok(())
    }

    fn change_one(
        &mut self,
        plugin: PluginIndex,
        name: &str,
        value: ParamValue,
    ) -> Result<(), ParameterRefusal> {
        let change = match plugin {
            PluginIndex::Controller(index) => {
                self.controllers[index].controller.change_parameter(name, value)
            }
            PluginIndex::GoalChecker(index) => {
                self.goal_checkers[index].1.change_parameter(name, value)
            }
            PluginIndex::ProgressChecker(index) => {
                self.progress_checkers[index].1.change_parameter(name, value)
            }
            PluginIndex::PathHandler(index) => {
                self.path_handlers[index].1.change_parameter(name, value)
            }
        };
        change.map(|_| ())
    }

    /// Forgets the state of the motion.
    pub(super) fn reset_controllers(&mut self) {
        self.controllers.iter_mut().for_each(|slot| slot.controller.reset());
    }

    pub(super) fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        for slot in &mut self.controllers {
            slot.controller.set_speed_limit(limit, is_percentage);
        }
    }
}
