//! Plugins of other authors: planners, controllers, behaviors and tree nodes by the names of their classes.
//!
//! A class is registered in [`NavigationPlugins`], which [`crate::navigation::NavigationSetup`] passes to the servers.
//! A parameter file then uses it as one of Nav2: `plugin: "my_package::StraightLine"`, or `my_package/StraightLine`.
//! The parameters beside `plugin` are in the [`PluginSetup`] from which the plugin is created.
//!
//! ```
//! use periplus_costmap::CostmapView;
//! use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
//! use periplus_params::ParamValue;
//! use periplus_planners::{ParameterRejected, PlanError, PlanRequest, PlannedPath, Planner};
//!
//! /// Path without regard to obstacles.
//! struct Direct;
//!
//! impl Planner for Direct {
//!     fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
//!         Ok(PlannedPath { poses: vec![request.start, request.goal], ..PlannedPath::default() })
//!     }
//!
//!     fn set_parameter(&mut self, name: &str, _: &ParamValue) -> Result<(), ParameterRejected> {
//!         Err(ParameterRejected::Unknown(name.to_owned(), None))
//!     }
//! }
//!
//! let plugins = NavigationPlugins::new()
//!     .planner("my_package::Direct", |_setup, _diagnostics| Some(Box::new(Direct)));
//! assert!(plugins.has("my_package/Direct"));
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use periplus_behavior_tree::NodeRegistry;
use periplus_controllers::{Controller, PluginSetup};
use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_planners::Planner;

use crate::behavior_server::{BehaviorAction, BehaviorPlugin};

/// Function that creates a plugin from its name and parameters; none after an error that it has reported.
pub type CreatePlugin<P> =
    dyn Fn(&PluginSetup<'_>, &mut Diagnostics) -> Option<Box<P>> + Send + Sync;

/// Behaviors of a class: the action that they serve, and the function that creates one.
type BehaviorClass = (BehaviorAction, Box<CreatePlugin<dyn BehaviorPlugin>>);

/// Function that registers tree nodes.
type RegisterNodes = dyn Fn(&mut NodeRegistry) + Send + Sync;

/// Plugins that the servers of navigation use beside their own ones. A class with the name of one of Nav2 replaces it.
#[derive(Clone, Default)]
pub struct NavigationPlugins {
    pub(crate) planners: PluginClasses<CreatePlugin<dyn Planner>>,
    pub(crate) controllers: PluginClasses<CreatePlugin<dyn Controller>>,
    pub(crate) behaviors: PluginClasses<BehaviorClass>,
    tree_nodes: Vec<Arc<RegisterNodes>>,
}

impl NavigationPlugins {
    /// Returns an empty registry.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a class of planners, `package::Class` or `package/Class`.
    #[must_use]
    pub fn planner(
        mut self,
        class: &str,
        create: impl Fn(&PluginSetup<'_>, &mut Diagnostics) -> Option<Box<dyn Planner>>
        + Send
        + Sync
        + 'static,
    ) -> Self {
        self.planners.add(class, Arc::new(create));
        self
    }

    /// Adds a class of controllers.
    #[must_use]
    pub fn controller(
        mut self,
        class: &str,
        create: impl Fn(&PluginSetup<'_>, &mut Diagnostics) -> Option<Box<dyn Controller>>
        + Send
        + Sync
        + 'static,
    ) -> Self {
        self.controllers.add(class, Arc::new(create));
        self
    }

    /// Adds a class of behaviors that serve an action.
    #[must_use]
    pub fn behavior(
        mut self,
        class: &str,
        action: BehaviorAction,
        create: impl Fn(&PluginSetup<'_>, &mut Diagnostics) -> Option<Box<dyn BehaviorPlugin>>
        + Send
        + Sync
        + 'static,
    ) -> Self {
        self.behaviors.add(class, Arc::new((action, Box::new(create))));
        self
    }

    /// Adds tree nodes: a function that registers them for `bt_navigator`, after those of Nav2. A node with the name of
    /// one of Nav2 replaces it.
    #[must_use]
    pub fn tree_nodes(
        mut self,
        register: impl Fn(&mut NodeRegistry) + Send + Sync + 'static,
    ) -> Self {
        self.tree_nodes.push(Arc::new(register));
        self
    }

    /// Returns true if a planner, controller or behavior of the class is registered.
    #[must_use]
    pub fn has(&self, class: &str) -> bool {
        self.planners.find(class).is_some()
            || self.controllers.find(class).is_some()
            || self.behaviors.find(class).is_some()
    }

    /// Registers all tree nodes.
    pub(crate) fn register_nodes(&self, registry: &mut NodeRegistry) {
        self.tree_nodes.iter().for_each(|register| register(registry));
    }
}

impl fmt::Debug for NavigationPlugins {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NavigationPlugins")
            .field("planners", &self.planners.names())
            .field("controllers", &self.controllers.names())
            .field("behaviors", &self.behaviors.names())
            .finish_non_exhaustive()
    }
}

/// Classes of one type of plugin.
pub(crate) struct PluginClasses<F: ?Sized>(BTreeMap<String, Arc<F>>);

impl<F: ?Sized> Clone for PluginClasses<F> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<F: ?Sized> Default for PluginClasses<F> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

/// Class in the form `package::Class`.
pub(crate) fn with_colons(class: &str) -> String {
    class.trim().replace('/', "::")
}

impl<F: ?Sized> PluginClasses<F> {
    pub(crate) fn add(&mut self, class: &str, create: Arc<F>) {
        self.0.insert(with_colons(class), create);
    }

    pub(crate) fn find(&self, class: &str) -> Option<&F> {
        self.0.get(&with_colons(class)).map(|create| &**create)
    }

    pub(crate) fn names(&self) -> Vec<&str> {
        self.0.keys().map(String::as_str).collect()
    }

    /// Adds the registered classes to the error about an unknown one, with the most similar of them.
    pub(crate) fn advise(&self, class: &str, error: Diagnostic) -> Diagnostic {
        if self.0.is_empty() {
            return error;
        }
        let names = self.names();
        let written = with_colons(class);
        let last = |name: &str| name.rsplit("::").next().map(str::to_owned);
        let same = names.iter().copied().find(|name| last(name) == last(&written));
        let near = same.or_else(|| closest(&written, names.iter().copied()));
        let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
        error.help(format!("this program has registered `{}`{near}", names.join("`, `")))
    }
}

/// Error of a class that has created no plugin, and has reported no reason.
pub(crate) fn not_created(setup: &PluginSetup<'_>, class: &str) -> Diagnostic {
    let text = format!("`{}`: the class `{class}` has created no plugin", setup.name);
    Diagnostic::error("no-plugin", text).at(setup.class_origin)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(class: &str, expected: &[&str]) {
        let mut classes: PluginClasses<str> = PluginClasses::default();
        for class in ["my_package/StraightLine", "other::Spiral"] {
            classes.add(class, Arc::from(""));
        }
        let error = classes.advise(class, Diagnostic::error("unknown-plugin", ""));
        assert_eq!(error.help, expected, "{class}");
        assert_eq!(classes.find(class).is_some(), class.ends_with("package/StraightLine "));
    }

    #[test]
    fn an_unknown_class_is_answered_with_the_registered_ones() {
        let known = "this program has registered `my_package::StraightLine`, `other::Spiral`";
        check(
            "my_package/StraightLine ",
            &[&format!("{known}; did you mean `my_package::StraightLine`?")],
        );
        check("StraightLine", &[&format!("{known}; did you mean `my_package::StraightLine`?")]);
        check("other/Spirale", &[&format!("{known}; did you mean `other::Spiral`?")]);
        check("quite_different/Thing", &[known]);
        let none: PluginClasses<str> = PluginClasses::default();
        assert!(none.advise("x", Diagnostic::error("unknown-plugin", "")).help.is_empty());
    }
}
