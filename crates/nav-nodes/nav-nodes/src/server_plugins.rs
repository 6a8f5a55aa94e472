//! Plugins of a server: their names are in a list parameter, their classes and parameters in groups of
//! these names.

use periplus_controllers::{GivenParameters, PluginSetup};
use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_params::{Given, ParamValues, Table};

use crate::common_parameters::{is_common, is_for_table};
use crate::navigation_plugins::{CreatePlugin, not_created};

/// Parameters of a server as written, with the plugins that were read.
pub(crate) struct ServerParameters<'a, 'd> {
    given: Vec<Given<'a>>,
    /// Values of the node itself.
    pub(crate) node: ParamValues,
    /// Names of groups that belong to plugins.
    groups: Vec<String>,
    /// Findings so far.
    pub(crate) diagnostics: &'d mut Diagnostics,
    /// Errors because of which the server cannot be configured.
    pub(crate) failures: Vec<String>,
}

/// A plugin of a server.
pub(crate) struct PluginEntry<'a> {
    /// Name of the plugin, which is the group of its parameters.
    pub(crate) id: String,
    /// Class as written.
    pub(crate) class: String,
    /// Source location of the class.
    pub(crate) class_origin: Origin,
    /// Parameters of the group.
    pub(crate) given: GivenParameters<'a>,
}

impl<'a, 'd> ServerParameters<'a, 'd> {
    /// Reads the parameters of the node. As in ROS 2 the last value of a name applies.
    pub(crate) fn new(
        table: &'static Table,
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &'d mut Diagnostics,
    ) -> Self {
        let mut last: Vec<Given<'a>> = Vec::new();
        for one in given {
            last.retain(|entry| entry.name != one.name);
            last.push(one);
        }
        let (own, given): (Vec<_>, Vec<_>) = last
            .into_iter()
            .partition(|entry| table.find(entry.name).is_some() || !entry.name.contains('.'));
        let own = own.into_iter().filter(|entry| is_for_table(entry, table));
        let node = table.check(own, None, diagnostics);
        let given = given.into_iter().filter(|entry| !is_common(entry.name)).collect();
        Self { given, node, groups: Vec::new(), diagnostics, failures: Vec::new() }
    }

    /// Reads the plugins of a list parameter. The default classes apply if the list is the default one, as in
    /// Nav2. A plugin without a class is a failure.
    pub(crate) fn plugins(
        &mut self,
        list: &'static str,
        defaults: &[(&str, &str)],
    ) -> Vec<PluginEntry<'a>> {
        let ids = self.node.texts(list);
        let is_default = ids.iter().map(String::as_str).eq(defaults.iter().map(|(id, _)| *id));
        let mut entries: Vec<PluginEntry<'a>> = Vec::new();
        for id in ids {
            if entries.iter().any(|entry| entry.id == id) {
                continue;
            }
            let class = self.given.iter().find(|entry| {
                entry.name.strip_prefix(id.as_str()).is_some_and(|rest| rest == ".plugin")
            });
            let default = defaults.iter().find(|(known, _)| is_default && *known == id);
            let (class, class_origin) = match (class, default) {
                (Some(class), _) => (class.text.trim().to_owned(), class.origin),
                (None, Some((_, class))) => ((*class).to_owned(), self.node.origin(list)),
                (None, None) => {
                    let text = format!("`{id}.plugin` is not set, and `{list}` names `{id}`");
                    let example = defaults.first().map_or("", |(_, class)| class);
                    self.diagnostics.push(
                        Diagnostic::error("no-plugin", text.clone())
                            .at(self.node.origin(list))
                            .help(format!(
                                "write the class under `{id}`, such as `plugin: \"{example}\"`"
                            )),
                    );
                    self.failures.push(text);
                    self.groups.push(id);
                    continue;
                }
            };
            let given = GivenParameters::of_group(&self.given, &id);
            self.groups.push(id.clone());
            entries.push(PluginEntry { id, class, class_origin, given });
        }
        entries
    }

    /// Adds a failure that is a finding, too.
    pub(crate) fn fail(&mut self, diagnostic: Diagnostic) {
        let help: String = diagnostic.help.iter().map(|help| format!("; {help}")).collect();
        self.failures.push(format!("{}{help}", diagnostic.message));
        self.diagnostics.push(diagnostic);
    }

    /// Runs `read`, which reports findings; its errors are failures of the server.
    pub(crate) fn reading<R>(
        &mut self,
        read: impl FnOnce(&mut Diagnostics) -> Option<R>,
    ) -> Option<R> {
        let mut found = Diagnostics::new();
        let result = read(&mut found);
        for diagnostic in found.iter() {
            if result.is_none() && diagnostic.severity == periplus_diagnostics::Severity::Error {
                self.fail(diagnostic.clone());
            } else {
                self.diagnostics.push(diagnostic.clone());
            }
        }
        result
    }

    /// Creates a plugin of a registered class; its errors are failures of the server.
    pub(crate) fn create<P: ?Sized>(
        &mut self,
        setup: &PluginSetup<'_>,
        class: &str,
        create: &CreatePlugin<P>,
    ) -> Option<Box<P>> {
        let failure_count = self.failures.len();
        let created = self.reading(|found| create(setup, found));
        if created.is_none() && self.failures.len() == failure_count {
            self.fail(not_created(setup, class));
        }
        created
    }

    /// Reports groups of which no plugin has the name, and returns the values of the node and the failures.
    pub(crate) fn finish(self) -> (ParamValues, Vec<String>) {
        let mut reported: Vec<&str> = Vec::new();
        for entry in &self.given {
            let group = entry.name.split('.').next().unwrap_or_default();
            let belongs = |id: &String| {
                entry.name.strip_prefix(id.as_str()).is_some_and(|rest| rest.starts_with('.'))
            };
            if self.groups.iter().any(belongs) || reported.contains(&group) {
                continue;
            }
            reported.push(group);
            let mut hint = Diagnostic::hint(
                "unused-group",
                format!("no plugin is named `{group}`; its parameters are unused"),
            );
            hint.span = entry.name_origin.0;
            self.diagnostics.push(hint.help("name it in the list of plugins, or remove it"));
        }
        (self.node, self.failures)
    }
}

/// Returns the id of a plugin that a goal asks for: the one of that name or, for an empty name, the only one.
///
/// # Errors
/// A sentence with the available names.
pub(crate) fn find_plugin<'a>(
    ids: impl Iterator<Item = &'a str>,
    asked: &str,
    what: &str,
) -> Result<usize, String> {
    let ids: Vec<&str> = ids.collect();
    if let Some(index) = ids.iter().position(|id| *id == asked) {
        return Ok(index);
    }
    if asked.is_empty() && ids.len() == 1 {
        return Ok(0);
    }
    let known = ids.join("`, `");
    Err(if asked.is_empty() {
        format!("the goal names no {what}, and there are several: `{known}`")
    } else {
        let near = periplus_diagnostics::closest(asked, ids.iter().copied());
        let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
        format!("there is no {what} `{asked}`; available: `{known}`{near}")
    })
}

/// Changes of the parameters of plugins in a request, applied one after the other: (plugin, name, value).
pub(crate) type PluginChange = (usize, String, periplus_params::ParamValue);

/// Returns the parameters of plugins that differ from their current values.
pub(crate) fn changed<'a>(
    all: &ParamValues,
    plugins: impl Iterator<Item = (&'a str, &'a ParamValues)>,
) -> Vec<PluginChange> {
    let mut changes = Vec::new();
    for (index, (id, current)) in plugins.enumerate() {
        let Some(wanted) = all.group(id) else { continue };
        // Two tables may share a group, of which the node has declared the first.
        for name in current.names().filter(|name| wanted.find(name).is_some()) {
            if let Some(value) = wanted.get(&name)
                && current.get(&name).as_ref() != Some(&value)
            {
                changes.push((index, name, value));
            }
        }
    }
    changes
}
