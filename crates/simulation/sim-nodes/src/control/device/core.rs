//! Controllers, hardware and names of a controller manager.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Arguments, Level, Node, ParameterFileError, Parameters};
use periplus_params::ParamValues;
use periplus_physics::PhysicsWorld;
use periplus_ros2_control::{
    BaseMotion, CONTROLLER_MANAGER, ControlCycle, ControllerLifecycle, ControllerManager,
    ManagerParams, SwitchRequest, SwitchStrictness,
};

use super::super::factory::{self, KnownJoints};
use super::super::hardware::JointHardware;
use super::super::joints::joints_of;
use super::super::parameter_files::{ParameterFiles, arguments};
use super::super::plugin::{ControlPlugin, GivenParameters, text_of, texts_of};
use super::super::ros_controller::RosController;
use crate::drives::BuildContext;

/// Name of the text of parameters that is read like a file.
const TEXT_FILE: &str = "parameters of the spawner";

/// Controllers, hardware and names of a controller manager.
pub(in crate::control) struct ControlCore {
    pub(in crate::control) plugin: ControlPlugin,
    pub(in crate::control) node: Node,
    parameters: Parameters,
    pub(in crate::control) manager: ControllerManager<Box<dyn RosController>>,
    pub(in crate::control) hardware: JointHardware,
    pub(in crate::control) joints: KnownJoints,
    /// Controllers that started without a spawner.
    pub(in crate::control) started_here: BTreeSet<String>,
}

/// Files, and the text that a spawner gave.
struct WithText<'a> {
    files: &'a dyn ParameterFiles,
    text: String,
}

impl ParameterFiles for WithText<'_> {
    fn parameter_text(&self, path: &Path) -> Result<String, ParameterFileError> {
        if path == Path::new(TEXT_FILE) {
            return Ok(self.text.clone());
        }
        self.files.parameter_text(path)
    }
}

impl ControlCore {
    pub(super) fn new(
        context: &BuildContext<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, periplus_graph::GraphError> {
        let plugin = ControlPlugin::read(context, diagnostics);
        let joints: KnownJoints = Arc::new(joints_of(context));
        let (hardware, interfaces) = JointHardware::new(context, &plugin, &joints, diagnostics);
        let given = plugin.parameters_of(&plugin.manager_name);
        let node = plugin.node(&plugin.manager_name, &Arguments::default(), &given, true)?;
        let parameters = node.parameters(ParamValues::defaults(&CONTROLLER_MANAGER))?;
        Ok(Self {
            manager: ControllerManager::new(interfaces),
            plugin,
            node,
            parameters,
            hardware,
            joints,
            started_here: BTreeSet::new(),
        })
    }

    /// Returns the rate of updates in simulated time [Hz].
    pub(in crate::control) fn update_rate_hz(&self) -> f64 {
        ManagerParams::from_values(&self.parameters.values()).update_rate_hz
    }

    /// Logs the reason of a refusal; returns true for success.
    pub(in crate::control) fn answer(
        &mut self,
        act: impl FnOnce(&mut Self) -> Result<(), String>,
    ) -> bool {
        let outcome = act(self);
        if let Err(reason) = &outcome {
            self.node.log(Level::Error, reason);
        }
        outcome.is_ok()
    }

    /// Loads a controller with the parameters of the plugin's files and of its spawner: the
    /// parameters `<controller>.type`, `.params_file`, `.node_options_args` and `.params_text` of the
    /// manager.
    pub(in crate::control) fn load(&mut self, name: &str) -> Result<(), String> {
        if self.manager.find(name).is_some() {
            return Err(format!("a controller `{name}` is already loaded"));
        }
        let (given, extra) = self.given_to(name);
        let class = self.parameter_text(&format!("{name}.type"));
        let class = class.or_else(|| text_of(&given, "type")).ok_or_else(|| {
            format!(
                "the class of `{name}` is not known: set the parameter `{name}.type` of {}",
                self.node.full_name()
            )
        })?;
        self.load_with(name, &class, given, &extra)
    }

    /// Loads a controller of a class with these parameters.
    pub(super) fn load_with(
        &mut self,
        name: &str,
        class: &str,
        mut given: GivenParameters,
        extra: &Arguments,
    ) -> Result<(), String> {
        given.entry("type".to_owned()).or_insert_with(|| class_value(class));
        let made = factory::make(&self.plugin, name, class, given, extra, &self.joints)?;
        self.manager.load(name, class, made).map_err(|refused| refused.to_string())
    }

    fn given_to(&self, name: &str) -> (GivenParameters, Arguments) {
        let mut words = Vec::new();
        let own: GivenParameters = ["params_file", "node_options_args", "params_text"]
            .into_iter()
            .filter_map(|part| {
                Some((part.to_owned(), self.node.parameter(&format!("{name}.{part}"))?))
            })
            .collect();
        for path in texts_of(&own, "params_file") {
            words.extend(["--params-file".to_owned(), path]);
        }
        let text = text_of(&own, "params_text").unwrap_or_default();
        if !text.is_empty() {
            words.extend(["--params-file".to_owned(), TEXT_FILE.to_owned()]);
        }
        let options = texts_of(&own, "node_options_args");
        words.extend(options.into_iter().filter(|word| word != "--ros-args"));
        let files = WithText { files: &*self.plugin.files, text };
        let (extra, problems) = arguments(&words, &files);
        for problem in problems {
            self.node.log(Level::Error, format!("parameters of `{name}`: {problem}"));
        }
        let mut given = self.plugin.parameters_of(name);
        given.extend(extra.parameters_of(&format!("{}/{name}", self.plugin.namespace)));
        given.extend(extra.parameters_of(&self.plugin.full_name(name)));
        (given, extra)
    }

    fn parameter_text(&self, name: &str) -> Option<String> {
        let value = self.node.parameter(name)?;
        text_of(&[(name.to_owned(), value)].into(), name)
    }

    /// Configures a controller. One that started without a spawner stays active.
    pub(in crate::control) fn configure(&mut self, name: &str) -> Result<(), String> {
        if self.is_active(name) && self.started_here.contains(name) {
            return Ok(());
        }
        self.manager.configure(name).map_err(|refused| refused.to_string())
    }

    fn is_active(&self, name: &str) -> bool {
        self.manager.find(name).is_some_and(|one| one.lifecycle == ControllerLifecycle::Active)
    }

    /// Switches controllers. Those that started without a spawner may be activated again.
    pub(in crate::control) fn switch(
        &mut self,
        request: &SwitchRequest,
        cycle: ControlCycle,
    ) -> Result<(), String> {
        let is_done = |name: &String| {
            self.started_here.contains(name)
                && self.is_active(name)
                && !request.deactivate.contains(name)
        };
        let activate = request.activate.iter().filter(|name| !is_done(name)).cloned().collect();
        let request = SwitchRequest { activate, ..request.clone() };
        let problems =
            self.manager.switch(&request, cycle).map_err(|refused| refused.to_string())?;
        for problem in problems {
            self.node.log(Level::Warn, problem);
        }
        Ok(())
    }

    pub(super) fn update(&mut self, world: &PhysicsWorld, cycle: ControlCycle) {
        self.hardware.read(world, &mut self.manager.hardware, cycle.period_s);
        for failure in self.manager.update(cycle) {
            let text = format!("`{}` is deactivated: {}", failure.controller, failure.reason);
            self.node.log(Level::Error, text);
        }
    }

    pub(super) fn write(&self, world: &mut PhysicsWorld) {
        self.hardware.write(world, &self.manager.hardware, self.update_rate_hz());
    }

    /// Returns the motion of the base by the first active controller that drives it.
    pub(super) fn base_motion(&self) -> Option<BaseMotion> {
        let active = self.manager.controllers().iter();
        active
            .filter(|one| one.lifecycle == ControllerLifecycle::Active)
            .find_map(|one| one.controller.base_motion())
    }

    /// Restarts all controllers after a reset of the world: active ones are configured and
    /// activated again.
    pub(super) fn restart(&mut self, world: &PhysicsWorld, cycle: ControlCycle) {
        self.hardware.reset();
        self.hardware.read(world, &mut self.manager.hardware, 0.0);
        let active: Vec<String> = self
            .manager
            .controllers()
            .iter()
            .filter(|one| one.lifecycle == ControllerLifecycle::Active)
            .map(|one| one.name.clone())
            .collect();
        let strictness = SwitchStrictness::BestEffort;
        let end = SwitchRequest { deactivate: active.clone(), strictness, ..Default::default() };
        let begin = SwitchRequest { activate: active.clone(), strictness, ..Default::default() };
        let ended = self.manager.switch(&end, cycle);
        let configured: Vec<_> = active.iter().map(|name| self.manager.configure(name)).collect();
        let begun = self.manager.switch(&begin, cycle);
        let refused = configured.into_iter().filter_map(Result::err);
        for problem in refused.chain(ended.err()).chain(begun.err()) {
            self.node.log(Level::Error, problem);
        }
    }
}

fn class_value(class: &str) -> periplus_msgs::rcl_interfaces::ParameterValue {
    periplus_msgs::rcl_interfaces::ParameterValue {
        r#type: periplus_msgs::rcl_interfaces::ParameterType::PARAMETER_STRING,
        string_value: class.to_owned(),
        ..Default::default()
    }
}
