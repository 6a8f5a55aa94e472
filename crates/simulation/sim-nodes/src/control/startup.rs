//! Controllers that start without a spawner.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_ros2_control::{ControlCycle, ControllerKind, SwitchRequest, SwitchStrictness};

use super::device::ControlCore;
use crate::drives::BuildContext;

/// Starts the controllers of the plugin's parameter files, and of the run's, as a spawner would: first the
/// broadcasters, then the drives, then the others whose interfaces are still free.
pub(super) fn start(
    core: &mut ControlCore,
    context: &BuildContext<'_>,
    cycle: ControlCycle,
    diagnostics: &mut Diagnostics,
) {
    let release = core.plugin.release;
    let mut declared: Vec<(usize, String)> = core
        .plugin
        .declared_controllers()
        .into_iter()
        .map(|(name, class)| {
            let rank = match ControllerKind::of_class(release, &class) {
                Some(kind) if kind.is_broadcaster() => 0,
                Some(kind) if kind.is_drive() => 1,
                _ => 2,
            };
            (rank, name)
        })
        .collect();
    declared.sort();
    let plugin = &context.site.plugin.name;
    if declared.is_empty() {
        diagnostics.push(no_controllers(context, core));
        return;
    }
    let mut started = Vec::new();
    for (_, name) in declared {
        match start_one(core, &name, cycle) {
            Ok(()) => {
                core.started_here.insert(name.clone());
                started.push(name);
            }
            Err(reason) => {
                let message = format!("the controller `{name}` is not started: {reason}");
                diagnostics.push(
                    Diagnostic::warning("controller-not-started", message).at(context.origin()),
                );
            }
        }
    }
    if started.is_empty() {
        return;
    }
    let names: Vec<String> = started.iter().map(|name| format!("`{name}`")).collect();
    let message = format!(
        "plugin `{plugin}`: no spawner is run, so these controllers of the parameter files are \
         started: {}",
        names.join(", ")
    );
    let mut finding = Diagnostic::hint("controllers-started", message).at(context.origin());
    for name in &started {
        for topic in command_topics(core, name) {
            finding = finding.note(format!("`{name}` receives {topic}"));
        }
    }
    diagnostics.push(finding);
}

fn start_one(core: &mut ControlCore, name: &str, cycle: ControlCycle) -> Result<(), String> {
    core.load(name)?;
    let activated = core.manager.configure(name).and_then(|()| {
        let activate = vec![name.to_owned()];
        let strictness = SwitchStrictness::Strict;
        let request = SwitchRequest { activate, strictness, ..SwitchRequest::default() };
        core.manager.switch(&request, cycle)
    });
    activated.map(|_| ()).map_err(|refused| {
        // A controller that cannot be activated stays loaded, as with a spawner.
        refused.to_string()
    })
}

/// Returns the command topics of a controller with their types.
fn command_topics(core: &ControlCore, name: &str) -> Vec<String> {
    let Some(loaded) = core.manager.find(name) else { return Vec::new() };
    let node = loaded.controller.part().node.full_name().to_owned();
    let topics = core.node.graph().topics();
    let own = topics.into_iter().filter(|topic| {
        topic.subscriptions.iter().any(|end| end.node == node) && !topic.name.starts_with("/_")
    });
    let named = own.filter(|topic| topic.name != "/parameter_events" && topic.name != "/clock");
    named.map(|topic| format!("`{}` ({})", topic.name, topic.type_name)).collect()
}

fn no_controllers(context: &BuildContext<'_>, core: &ControlCore) -> Diagnostic {
    let plugin = &context.site.plugin.name;
    let message = format!("plugin `{plugin}` has no controllers to start");
    let finding = Diagnostic::warning("no-controllers", message).at(context.origin());
    if core.plugin.release.is_ros1() {
        return finding
            .note("controllers of ROS 1 are in the parameter server, which launch files fill")
            .help(
                "run the robot's launch file: `periplus launch PACKAGE FILE`, or give their parameters in the form \
                 of ROS 2: `--ros-args --params-file FILE.yaml`",
            );
    }
    finding.help(
        "name a parameter file with controllers in `<parameters>` or by `--ros-args --params-file FILE.yaml`, or \
         run the robot's launch file",
    )
}
