//! What a device of a plugin is made from.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{DVec3, Pose};
use periplus_graph::Node;
use periplus_params::Value;
use periplus_physics::{JointId, LinkId};
use periplus_plugin_specs::{Interpreted, Site};
use periplus_scene::{Model, carrying_link};

use super::body::{Body, canonical, place_of};
use crate::{Setting, gz_topic, node_of};

/// A plugin to be turned into a device: where it stands, its parameters, and what it may use.
#[derive(Clone, Copy)]
pub(crate) struct Order<'a> {
    pub(crate) setting: &'a Setting<'a>,
    pub(crate) site: &'a Site<'a>,
    pub(crate) plugin: &'a Interpreted,
}

impl<'a> Order<'a> {
    /// The model that the plugin stands in.
    pub(crate) fn model(&self) -> &'a Model {
        self.site.context.model.unwrap_or(self.setting.root)
    }

    /// What that model is called here.
    pub(crate) fn model_name(&self) -> &'a str {
        let model = self.model();
        if std::ptr::eq(model, self.setting.root) { self.setting.model_name } else { &model.name }
    }

    /// Name of the device.
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

    /// A text that counts only if somebody wrote one.
    pub(crate) fn given_text(&self, parameter: &str) -> Option<String> {
        let given = self.plugin.values.is_given(parameter);
        self.plugin.values.text(parameter).filter(|text| given && !text.is_empty())
    }

    /// Three numbers; zeros stand in for what is not there.
    pub(crate) fn triple(&self, parameter: &str) -> [f64; 3] {
        let numbers = self.plugin.values.numbers(parameter);
        std::array::from_fn(|index| numbers.get(index).copied().unwrap_or_default())
    }

    /// The topic that a parameter names, or one below `/model/<name>/`, as gz-sim has it.
    pub(crate) fn gz_topic(&self, parameter: &str, below_model: &str) -> String {
        gz_topic(&self.given_text(parameter).unwrap_or_else(|| self.below_model(below_model)))
    }

    /// `/model/<name>/` and more, as gz-sim names topics.
    pub(crate) fn below_model(&self, rest: &str) -> String {
        format!("/model/{}/{rest}", self.model_name())
    }

    /// The plugin's node; none, with an error, where it cannot be.
    pub(crate) fn node(&self, diagnostics: &mut Diagnostics) -> Option<Node> {
        self.accept(node_of(self.setting, self.plugin), diagnostics)
    }

    /// What the graph gave; none, with an error, where it refused.
    pub(crate) fn accept<T, E: std::fmt::Display>(
        &self,
        made: Result<T, E>,
        diagnostics: &mut Diagnostics,
    ) -> Option<T> {
        made.map_err(|error| self.refuse(&error, diagnostics)).ok()
    }

    fn refuse(&self, error: &dyn std::fmt::Display, diagnostics: &mut Diagnostics) {
        let message = format!("plugin `{}` cannot take its place: {error}", self.site.plugin.name);
        diagnostics.push(Diagnostic::error("plugin-refused", message).at(self.origin()));
    }

    /// The joints that a parameter names. None, with an error for each, if one is missing or
    /// cannot move: the plugin then does nothing.
    pub(crate) fn joints(
        &self,
        parameter: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Vec<JointId>> {
        let named = self.plugin.values.all(parameter);
        let found: Vec<Option<JointId>> = named
            .iter()
            .filter_map(|(value, origin)| match value {
                Value::Text(name) => Some(self.joint_named(name.trim(), *origin, diagnostics)),
                _ => None,
            })
            .collect();
        found.into_iter().collect::<Option<Vec<_>>>().filter(|joints| !joints.is_empty())
    }

    /// The first joint that a parameter names.
    pub(crate) fn joint(&self, parameter: &str, diagnostics: &mut Diagnostics) -> Option<JointId> {
        self.joints(parameter, diagnostics)?.first().copied()
    }

    pub(crate) fn joint_named(
        &self,
        name: &str,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<JointId> {
        let Setting { world, model, .. } = self.setting;
        let short = self.without_model(name);
        let found = world.find_joint(*model, &self.setting.scoped(self.site, short));
        if let Some(joint) = found.filter(|&joint| world.axis_state(joint).is_some()) {
            return Some(joint);
        }
        let origin = if origin.0.is_some() { origin } else { self.origin() };
        let plugin = &self.site.plugin.name;
        if found.is_some() {
            let message = format!("plugin `{plugin}` names the joint `{name}`, which is fixed");
            let help = "name a joint that turns or slides";
            diagnostics.push(Diagnostic::error("joint-fixed", message).at(origin).help(help));
            return None;
        }
        let moving = world.joints(*model).filter(|&joint| world.axis_state(joint).is_some());
        let known: Vec<&str> = moving.filter_map(|joint| world.joint_name(joint)).collect();
        let message = format!("plugin `{plugin}` names the joint `{name}`, which is not there");
        let mut finding = Diagnostic::error("joint-missing", message)
            .at(origin)
            .note("nothing here moves it or tells of it; the rest of the model runs")
            .did_you_mean(origin, name, known.iter().copied());
        if !known.is_empty() {
            finding = finding.help(format!("joints that move here: {}", some_of(&known)));
        }
        diagnostics.push(finding);
        None
    }

    /// The middle between the wheels of joints, in the model [m].
    pub(crate) fn middle(&self, joints: &[JointId]) -> DVec3 {
        self.setting.world.middle_of(self.setting.model, joints).unwrap_or_default()
    }

    /// The name that a link or joint of the outermost model has in the plugin's model.
    pub(crate) fn inner_name(&self, scoped: &str) -> String {
        let within = self.setting.scoped(self.site, "");
        scoped.strip_prefix(&within).unwrap_or(scoped).to_owned()
    }

    /// The name of the link that carries the model's frame, scoped in the model.
    pub(crate) fn canonical_link(&self) -> Option<String> {
        canonical(self.model()).map(|(name, _)| name)
    }

    /// A place by the name of a link: the link itself, or one that was merged over fixed joints and
    /// is a frame now.
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
                place_of(model, &carrying)?.inverse() * frame.parent_from_frame
            }
            None => Pose::IDENTITY,
        };
        Some(Body { link, link_from_body })
    }

    /// A link by name, as the plugin sees it; of one that was merged, the link that carries it.
    pub(crate) fn link(
        &self,
        name: &str,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<LinkId> {
        let carrying = carrying_link(self.model(), self.without_model(name));
        let found = carrying.and_then(|link| self.setting.link(self.site, &link));
        if found.is_none() {
            let Setting { world, model, .. } = self.setting;
            let links: Vec<&str> =
                world.links(*model).filter_map(|link| world.link_name(link)).collect();
            let origin = if origin.0.is_some() { origin } else { self.origin() };
            let message = format!(
                "plugin `{}` names the link `{name}`, which is not there",
                self.site.plugin.name
            );
            diagnostics.push(
                Diagnostic::error("link-missing", message)
                    .at(origin)
                    .note("the plugin does nothing; the rest of the model runs")
                    .did_you_mean(origin, name, links.iter().copied())
                    .help(format!("links here: {}", some_of(&links))),
            );
        }
        found
    }

    /// A name without the model before it.
    fn without_model<'n>(&self, name: &'n str) -> &'n str {
        let own = format!("{}::", self.model_name());
        name.strip_prefix(&own).unwrap_or(name)
    }
}

/// The last part of a scoped name.
pub(crate) fn unscoped(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}

/// Names for a message, not too many.
fn some_of(names: &[&str]) -> String {
    const MOST: usize = 12;
    let shown = names.iter().take(MOST).map(|name| format!("`{name}`"));
    let mut text = shown.collect::<Vec<_>>().join(", ");
    if names.len() > MOST {
        text.push_str(", ...");
    }
    text
}
