//! Actions of launch files in XML and YAML.

use periplus_diagnostics::Diagnostic;

use super::entity::Entity;
use crate::evaluate::Outcome;
use crate::suggest::Suggest as _;
use crate::tree::{
    Action, ActionKind, ComponentOf, Condition, Given, IdentityOf, NodeOf, ParametersOf, Part,
    Place, ProcessOf, RunningOf, Substitution, Target, Text, plain,
};

/// Names of actions.
const KNOWN: [&str; 28] = [
    "append_env",
    "arg",
    "executable",
    "group",
    "gz_server",
    "gz_spawn_model",
    "include",
    "let",
    "lifecycle_node",
    "load_composable_node",
    "log",
    "node",
    "node_container",
    "push_ros_namespace",
    "reset",
    "reset_env",
    "ros_gz_bridge",
    "ros_timer",
    "set_env",
    "set_parameter",
    "set_parameters_from_file",
    "set_remap",
    "set_ros_log_dir",
    "set_use_sim_time",
    "shutdown",
    "timer",
    "unset_env",
    "unset_let",
];

/// Attributes of processes and of all actions.
const RUNNING: [&str; 10] = [
    "if",
    "unless",
    "name",
    "cwd",
    "output",
    "respawn",
    "respawn_delay",
    "launch-prefix",
    "env",
    "shell",
];

/// Actions in an entity, in order.
pub(super) fn all(parent: &Entity<'_>) -> Outcome<Vec<Action>> {
    parent.children()?.iter().map(action).collect()
}

fn action(entity: &Entity<'_>) -> Outcome<Action> {
    let condition = match (entity.text("if")?, entity.text("unless")?) {
        (Some(_), Some(_)) => {
            return Err(wrong(entity, "launch-condition", "use `if` or `unless`, not both"));
        }
        (Some(text), None) => Some(Condition::If { text }),
        (None, Some(text)) => Some(Condition::Unless { text }),
        (None, None) => None,
    };
    let place = Place { span: entity.span(), line: None };
    Ok(Action { id: None, place, condition, action_kind: action_kind(entity)? })
}

fn action_kind(entity: &Entity<'_>) -> Outcome<ActionKind> {
    let name = entity.name();
    Ok(match name.as_str() {
        "arg" => {
            known(entity, &["name", "default", "description", "value", "choice"])?;
            let Some((name, _)) = entity.written("name") else {
                return Err(wrong(entity, "launch-attribute", "`arg` needs `name`"));
            };
            ActionKind::Declare {
                name: name.to_owned(),
                default: entity.text("default")?,
                description: entity.written("description").map(|(text, _)| plain(text)),
                choices: entity
                    .of_kind("choice")
                    .iter()
                    .filter_map(|choice| choice.written("value"))
                    .map(|(value, _)| value.to_owned())
                    .collect(),
            }
        }
        "let" => {
            known(entity, &["name", "value"])?;
            ActionKind::Configure { name: entity.needed("name")?, value: entity.needed("value")? }
        }
        "unset_let" => ActionKind::Forget { name: entity.needed("name")? },
        "reset" => ActionKind::ForgetAll { keep: pairs(entity, "keep", "name", "value")? },
        "set_env" => {
            known(entity, &["name", "value"])?;
            ActionKind::Environment { name: entity.needed("name")?, value: entity.needed("value")? }
        }
        "append_env" => ActionKind::Append {
            name: entity.needed("name")?,
            value: entity.needed("value")?,
            separator: entity.text("separator")?,
            prepend: entity
                .written("prepend")
                .is_some_and(|(text, _)| crate::truth::truth(text).unwrap_or_default()),
        },
        "unset_env" => ActionKind::Unset { name: entity.needed("name")? },
        "reset_env" => ActionKind::ResetEnvironment,
        "set_ros_log_dir" => ActionKind::Environment {
            name: plain("ROS_LOG_DIR"),
            value: entity.needed("new_log_dir")?,
        },
        "group" => {
            let scoped = entity.written("scoped").map(|(text, _)| text);
            let forwarding = entity.written("forwarding").map(|(text, _)| text);
            let truth = |text: Option<&str>| text.and_then(crate::truth::truth);
            let mut actions = Vec::new();
            let mut configurations = Vec::new();
            for child in entity.children()? {
                if child.name() == "keep" {
                    configurations.push((child.needed("name")?, child.needed("value")?));
                } else {
                    actions.push(action(&child)?);
                }
            }
            ActionKind::Group {
                actions,
                is_scoped: truth(scoped) != Some(false),
                is_forwarding: truth(forwarding) != Some(false),
                configurations,
            }
        }
        "include" => {
            known(entity, &["file", "arg", "let"])?;
            let mut arguments = pairs(entity, "arg", "name", "value")?;
            arguments.extend(pairs(entity, "let", "name", "value")?);
            ActionKind::Include { file: entity.needed("file")?, arguments }
        }
        "push_ros_namespace" => {
            ActionKind::PushNamespace { namespace: entity.needed("namespace")? }
        }
        "set_parameter" => {
            ActionKind::SetParameter { name: entity.needed("name")?, value: given(entity)? }
        }
        "set_use_sim_time" => {
            let text = entity.needed("value")?;
            ActionKind::SetParameter {
                name: plain("use_sim_time"),
                value: Given::Text { text, of_type: Some("bool".into()) },
            }
        }
        "set_parameters_from_file" => ActionKind::SetParametersFromFile {
            file: entity.needed("filename")?,
            node: entity.text("node")?,
        },
        "set_remap" => {
            ActionKind::SetRemap { from: entity.needed("from")?, to: entity.needed("to")? }
        }
        "node" | "lifecycle_node" | "node_container" => node(entity, &name)?,
        "load_composable_node" => ActionKind::Load {
            container: Target::Name { name: entity.needed("target")? },
            components: components(entity)?,
        },
        "executable" => {
            let mut allowed = RUNNING.to_vec();
            allowed.push("cmd");
            known(entity, &allowed)?;
            ActionKind::Process(Box::new(ProcessOf {
                command: vec![entity.needed("cmd")?],
                is_line: true,
                shell: entity.text("shell")?,
                name: entity.text("name")?,
                running: running(entity)?,
            }))
        }
        "log" => {
            // `message` is the newer name, `text` the older one.
            let text = match entity.text("message")? {
                Some(text) => text,
                None => entity.needed("text")?,
            };
            ActionKind::Log { text, level: entity.text("level")? }
        }
        "gz_server" => include_of(entity, "ros_gz_sim", "gz_server", &GZ_SERVER)?,
        "gz_spawn_model" => include_of(entity, "ros_gz_sim", "gz_spawn_model", &GZ_SPAWN_MODEL)?,
        "ros_gz_bridge" => include_of(entity, "ros_gz_bridge", "ros_gz_bridge", &ROS_GZ_BRIDGE)?,
        "shutdown" => ActionKind::Shutdown { reason: entity.text("reason")? },
        "timer" | "ros_timer" => {
            ActionKind::Timer { seconds: entity.needed("period")?, actions: all(entity)? }
        }
        _ => {
            let mut unknown =
                Diagnostic::error("launch-action", format!("unknown action `{name}`"))
                    .suggest(&name, KNOWN);
            if matches!(name.as_str(), "param" | "rosparam" | "remap" | "machine" | "test") {
                unknown = unknown.help(format!(
                    "`{name}` outside a node is ROS 1: in ROS 2 put it into a node, or use `set_{}`",
                    if name == "remap" { "remap" } else { "parameter" }
                ));
            }
            if let Some(span) = entity.span() {
                unknown = unknown.at(span);
            }
            return Err(unknown.into());
        }
    })
}

/// Attributes of the actions of `ros_gz_sim` and `ros_gz_bridge`, which are arguments of the launch
/// files that they include.
const GZ_SERVER: [&str; 7] = [
    "world_sdf_file",
    "world_sdf_string",
    "container_name",
    "create_own_container",
    "use_composition",
    "verbosity_level",
    "initial_sim_time",
];
const GZ_SPAWN_MODEL: [&str; 13] = [
    "world",
    "file",
    "model_string",
    "topic",
    "entity_name",
    "name",
    "allow_renaming",
    "x",
    "y",
    "z",
    "roll",
    "pitch",
    "yaw",
];
const ROS_GZ_BRIDGE: [&str; 10] = [
    "bridge_name",
    "config_file",
    "container_name",
    "create_own_container",
    "namespace",
    "use_composition",
    "use_respawn",
    "log_level",
    "bridge_params",
    "extra_bridge_params",
];

/// Includes the launch file of an action, with its attributes as arguments.
fn include_of(
    entity: &Entity<'_>,
    package: &str,
    file: &str,
    names: &[&str],
) -> Outcome<ActionKind> {
    known(entity, names)?;
    let mut arguments = Vec::new();
    for name in names {
        if let Some(value) = entity.text(name)? {
            arguments.push((plain(*name), value));
        }
    }
    let folder = Substitution::Package { name: plain(package), is_prefix: false };
    let mut path = vec![Part::Substitution(Box::new(folder))];
    path.extend(plain(format!("/launch/{file}.launch.py")));
    Ok(ActionKind::Include { file: path, arguments })
}

fn node(entity: &Entity<'_>, kind: &str) -> Outcome<ActionKind> {
    let mut allowed = RUNNING.to_vec();
    allowed.extend([
        "pkg",
        "exec",
        "args",
        "ros_args",
        "namespace",
        "param",
        "remap",
        "composable_node",
        "exec_name",
        "node-name",
        "machine",
        "autostart",
    ]);
    known(entity, &allowed)?;
    Ok(ActionKind::Node(Box::new(NodeOf {
        package: Some(entity.needed("pkg")?),
        executable: entity.needed("exec")?,
        identity: identity(entity)?,
        arguments: entity.text("args")?.into_iter().collect(),
        is_line: true,
        ros_arguments: entity.text("ros_args")?.into_iter().collect(),
        is_lifecycle: kind == "lifecycle_node",
        autostart: entity.text("autostart")?,
        components: components(entity)?,
        running: running(entity)?,
    })))
}

fn identity(entity: &Entity<'_>) -> Outcome<IdentityOf> {
    Ok(IdentityOf {
        name: entity.text("name")?,
        namespace: entity.text("namespace")?,
        parameters: parameters(entity)?,
        remaps: pairs(entity, "remap", "from", "to")?,
    })
}

fn components(entity: &Entity<'_>) -> Outcome<Vec<ComponentOf>> {
    entity
        .of_kind("composable_node")
        .iter()
        .map(|component| {
            let condition = match (component.text("if")?, component.text("unless")?) {
                (Some(text), _) => Some(Condition::If { text }),
                (None, Some(text)) => Some(Condition::Unless { text }),
                (None, None) => None,
            };
            Ok(ComponentOf {
                package: component.needed("pkg")?,
                plugin: component.needed("plugin")?,
                identity: identity(component)?,
                condition,
            })
        })
        .collect()
}

fn running(entity: &Entity<'_>) -> Outcome<RunningOf> {
    Ok(RunningOf {
        prefix: entity.text("launch-prefix")?,
        folder: entity.text("cwd")?,
        only_environment: None,
        environment: pairs(entity, "env", "name", "value")?,
        output: entity.text("output")?,
        respawn: entity.text("respawn")?,
        respawn_delay: entity.text("respawn_delay")?,
        on_exit: Vec::new(),
    })
}

fn parameters(entity: &Entity<'_>) -> Outcome<Vec<ParametersOf>> {
    let mut all = Vec::new();
    for parameter in entity.of_kind("param") {
        if let Some(file) = parameter.text("from")? {
            let resolve = parameter.text("allow_substs")?.unwrap_or_else(|| plain("false"));
            let with_substitutions = Given::Text { text: resolve, of_type: Some("bool".into()) };
            all.push(ParametersOf::File { file, with_substitutions });
            continue;
        }
        let mut values = Vec::new();
        flatten(&parameter, None, &mut values)?;
        all.push(ParametersOf::Values { values });
    }
    Ok(all)
}

/// Parameter, or the members of a parameter group.
fn flatten(
    parameter: &Entity<'_>,
    group: Option<&Text>,
    values: &mut Vec<(Text, Given)>,
) -> Outcome<()> {
    let own = parameter.needed("name")?;
    let name = match group {
        Some(group) => [group.clone(), plain("."), own].concat(),
        None => own,
    };
    let members = parameter.of_kind("param");
    for member in &members {
        flatten(member, Some(&name), values)?;
    }
    if members.is_empty() {
        values.push((name, given(parameter)?));
    }
    Ok(())
}

fn given(entity: &Entity<'_>) -> Outcome<Given> {
    if let Some(texts) = entity.list("value")? {
        return Ok(Given::Texts { texts });
    }
    let of_type = entity.written("type").map(|(text, _)| text.to_owned());
    if let (Some((separator, _)), Some((value, Some(span)))) =
        (entity.written("value-sep"), entity.written("value"))
    {
        let texts = value.split(separator).map(|item| super::text(item.trim(), span));
        return Ok(Given::Texts { texts: texts.collect::<Outcome<_>>()? });
    }
    Ok(Given::Text { text: entity.needed("value")?, of_type })
}

fn pairs<'f>(
    entity: &Entity<'f>,
    kind: &'f str,
    from: &str,
    to: &str,
) -> Outcome<Vec<(Text, Text)>> {
    entity.of_kind(kind).iter().map(|pair| Ok((pair.needed(from)?, pair.needed(to)?))).collect()
}

/// Rejects unknown attributes, which could be typing errors.
fn known(entity: &Entity<'_>, names: &[&str]) -> Outcome<()> {
    let mut names = names.to_vec();
    names.extend(["if", "unless"]);
    match entity.others(&names).into_iter().next() {
        None => Ok(()),
        Some((other, span)) => {
            let of = entity.name().replace('_', "-");
            let mut wrong =
                Diagnostic::error("launch-attribute", format!("`{of}` has no `{other}`"))
                    .suggest(&other, names.iter().copied());
            let ros1 = match other.as_str() {
                "type" => Some("exec"),
                "ns" => Some("namespace"),
                "required" => Some("on_exit (Python only)"),
                _ => None,
            };
            if let Some(instead) = ros1 {
                wrong = wrong.help(format!("`{other}` is ROS 1; in ROS 2 use `{instead}`"));
            }
            if let Some(span) = span {
                wrong = wrong.at(span);
            }
            Err(wrong.into())
        }
    }
}

fn wrong(entity: &Entity<'_>, code: &'static str, message: &str) -> Box<Diagnostic> {
    let wrong = Diagnostic::error(code, message);
    match entity.span() {
        Some(span) => wrong.at(span).into(),
        None => wrong.into(),
    }
}
