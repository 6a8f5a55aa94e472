//! Inputs for building a plugin's device.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{DVec3, Pose};
use periplus_graph::Node;
use periplus_params::ParamValue;
use periplus_physics::{JointId, LinkId};
use periplus_plugin_specs::{InterpretedPlugin, PluginSite};
use periplus_scene::{Model, carrying_link};

use super::body::{Body, canonical, link_pose};
use crate::{DeviceContext, gz_topic, plugin_node};

/// A plugin, its model and its parameters.
#[derive(Clone, Copy)]
pub(crate) struct BuildContext<'a> {
    pub(crate) setting: &'a DeviceContext<'a>,
    pub(crate) site: &'a PluginSite<'a>,
    pub(crate) plugin: &'a InterpretedPlugin,
}

impl<'a> BuildContext<'a> {
    /// Returns the model of the plugin.
    pub(crate) fn model(&self) -> &'a Model {
        self.site.context.model.unwrap_or(self.setting.root)
    }

    /// Returns the name of that model in this run.
    pub(crate) fn model_name(&self) -> &'a str {
        let model = self.model();
        if std::ptr::eq(model, self.setting.root) { self.setting.model_name } else { &model.name }
    }

    /// Returns the name of the device.
    pub(crate) fn name(&self) -> String {
        format!("{}::{}", self.model_name(), self.site.plugin.name)
    }

    pub(crate) fn origin(&self) -> Origin {
        self.site.plugin.origin
    }

    pub(crate) fn number(&self, parameter: &str) -> f64 {
        self.plugin.values.number(parameter).unwrap_or_default()
    }

    pub(crate) fn flag(&self, parameter: &str) -> bool {
        self.plugin.values.flag(parameter).unwrap_or_default()
    }

    pub(crate) fn text(&self, parameter: &str) -> String {
        self.plugin.values.text(parameter).unwrap_or_default()
    }

    /// Returns a text if the file contains it, not a default.
    pub(crate) fn given_text(&self, parameter: &str) -> Option<String> {
        let given = self.plugin.values.is_given(parameter);
        self.plugin.values.text(parameter).filter(|text| given && !text.is_empty())
    }

    /// Returns three numbers; missing ones are zero.
    pub(crate) fn triple(&self, parameter: &str) -> [f64; 3] {
        let numbers = self.plugin.values.numbers(parameter);
        std::array::from_fn(|index| numbers.get(index).copied().unwrap_or_default())
    }

    /// Returns the topic of a parameter, or the default below `/model/<name>/` as in gz-sim.
    pub(crate) fn gz_topic(&self, parameter: &str, below_model: &str) -> String {
        gz_topic(&self.given_text(parameter).unwrap_or_else(|| self.below_model(below_model)))
    }

    /// Returns a topic below `/model/<name>/`, as in gz-sim.
    pub(crate) fn below_model(&self, rest: &str) -> String {
        format!("/model/{}/{rest}", self.model_name())
    }

    /// Returns the plugin's node; reports an error and returns `None` if it cannot be created.
    pub(crate) fn node(&self, diagnostics: &mut Diagnostics) -> Option<Node> {
        self.accept(plugin_node(self.setting, self.plugin), diagnostics)
    }

    /// Returns a result of the graph; reports an error and returns `None` if it failed.
    pub(crate) fn accept<T, E: std::fmt::Display>(
        &self,
        made: Result<T, E>,
        diagnostics: &mut Diagnostics,
    ) -> Option<T> {
        made.map_err(|error| self.refuse(&error, diagnostics)).ok()
    }

    fn refuse(&self, error: &dyn std::fmt::Display, diagnostics: &mut Diagnostics) {
        let message = format!("plugin `{}` cannot be started: {error}", self.site.plugin.name);
        diagnostics.push(Diagnostic::error("plugin-refused", message).at(self.origin()));
    }

    /// Returns the joints of a parameter. Returns `None`, with an error for each, if a joint is
    /// missing or fixed: the plugin is then disabled.
    pub(crate) fn joints(
        &self,
        parameter: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Vec<JointId>> {
        let named = self.plugin.values.all(parameter);
        let found: Vec<Option<JointId>> = named
            .iter()
            .filter_map(|(value, origin)| match value {
                ParamValue::Text(name) => Some(self.joint_named(name.trim(), *origin, diagnostics)),
                _ => None,
            })
            .collect();
        found.into_iter().collect::<Option<Vec<_>>>().filter(|joints| !joints.is_empty())
    }

    /// Returns the first joint of a parameter.
    pub(crate) fn joint(&self, parameter: &str, diagnostics: &mut Diagnostics) -> Option<JointId> {
        self.joints(parameter, diagnostics)?.first().copied()
    }

    pub(crate) fn joint_named(
        &self,
        name: &str,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<JointId> {
        let DeviceContext { world, model, .. } = self.setting;
        let short = self.without_model(name);
        let found = world.find_joint(*model, &self.setting.scoped(self.site, short));
        if let Some(joint) = found.filter(|&joint| world.axis_state(joint).is_some()) {
            return Some(joint);
        }
        let origin = if origin.0.is_some() { origin } else { self.origin() };
        let plugin = &self.site.plugin.name;
        if found.is_some() {
            let message = format!("plugin `{plugin}` uses the joint `{name}`, which is fixed");
            let help = "use a revolute or prismatic joint";
            diagnostics.push(Diagnostic::error("joint-fixed", message).at(origin).help(help));
            return None;
        }
        let moving = world.joints(*model).filter(|&joint| world.axis_state(joint).is_some());
        let known: Vec<&str> = moving.filter_map(|joint| world.joint_name(joint)).collect();
        let message = format!("plugin `{plugin}` uses the joint `{name}`, which does not exist");
        let mut finding = Diagnostic::error("joint-missing", message)
            .at(origin)
            .note("the joint is neither moved nor published; the rest of the model runs")
            .did_you_mean(origin, name, known.iter().copied());
        if !known.is_empty() {
            finding = finding.help(format!("movable joints: {}", some_of(&known)));
        }
        diagnostics.push(finding);
        None
    }

    /// Returns the midpoint between the wheels of joints, in the model [m].
    pub(crate) fn middle(&self, joints: &[JointId]) -> DVec3 {
        self.setting.world.middle_of(self.setting.model, joints).unwrap_or_default()
    }

    /// Returns the name of a link or joint of the outermost model in the plugin's model.
    pub(crate) fn inner_name(&self, scoped: &str) -> String {
        let within = self.setting.scoped(self.site, "");
        scoped.strip_prefix(&within).unwrap_or(scoped).to_owned()
    }

    /// Returns the scoped name of the model's canonical link.
    pub(crate) fn canonical_link(&self) -> Option<String> {
        canonical(self.model()).map(|(name, _)| name)
    }

    /// Returns a frame by the name of a link: the link itself, or a lumped link that became a frame.
    pub(crate) fn body(
        &self,
        name: &str,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<Body> {
        let link = self.link(name, origin, diagnostics)?;
        let model = self.model();
        let short = self.without_model(name);
        let link_from_body = match model.frames.iter().find(|frame| frame.name == short) {
            Some(frame) => {
                let carrying = carrying_link(model, short)?;
                link_pose(model, &carrying)?.inverse() * frame.parent_from_frame
            }
            None => Pose::IDENTITY,
        };
        Some(Body { link, link_from_body })
    }

    /// Returns a link by its name in the plugin's model; for a lumped link the link that contains
    /// it.
    pub(crate) fn link(
        &self,
        name: &str,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<LinkId> {
        let carrying = carrying_link(self.model(), self.without_model(name));
        let found = carrying.and_then(|link| self.setting.link(self.site, &link));
        if found.is_none() {
            let DeviceContext { world, model, .. } = self.setting;
            let links: Vec<&str> =
                world.links(*model).filter_map(|link| world.link_name(link)).collect();
            let origin = if origin.0.is_some() { origin } else { self.origin() };
            let message = format!(
                "plugin `{}` uses the link `{name}`, which does not exist",
                self.site.plugin.name
            );
            diagnostics.push(
                Diagnostic::error("link-missing", message)
                    .at(origin)
                    .note("the plugin is disabled; the rest of the model runs")
                    .did_you_mean(origin, name, links.iter().copied())
                    .help(format!("links of the model: {}", some_of(&links))),
            );
        }
        found
    }

    /// Removes the model's name from a name.
    fn without_model<'n>(&self, name: &'n str) -> &'n str {
        let own = format!("{}::", self.model_name());
        name.strip_prefix(&own).unwrap_or(name)
    }
}

/// Returns the last part of a scoped name.
pub(crate) fn unscoped(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}

/// Lists names for a message, at most 12.
fn some_of(names: &[&str]) -> String {
    const MAX_NAME_COUNT: usize = 12;
    let shown = names.iter().take(MAX_NAME_COUNT).map(|name| format!("`{name}`"));
    let mut text = shown.collect::<Vec<_>>().join(", ");
    if names.len() > MAX_NAME_COUNT {
        text.push_str(", ...");
    }
    text
}
