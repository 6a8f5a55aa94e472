//! Creation of built-in replacements.

use std::any::Any;
use std::path::Path;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, RenderStyle, Severity, SourceMap, render};
use periplus_graph::{Graph, GraphError, Node, NodeSettings, parameters_to_yaml};
use periplus_maps::Distro;
use periplus_nav_nodes::amcl::AmclNode;
use periplus_nav_nodes::costmap_2d::{VoxelCloud, VoxelMarkers};
use periplus_nav_nodes::ekf_node::EkfNode;
use periplus_nav_nodes::map_server::{MapSaver, MapServer, MapServerParams};
use periplus_nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus_os::Machine;
use periplus_params::Given;
use periplus_resources::Host as _;
use periplus_sim_nodes::gz_topic;
use periplus_sim_nodes::states::{
    JOINT_STATE_PUBLISHER, JointStateOptions, JointStateParams, JointStateSource, RobotStateParams,
    RobotStatePublisher,
};
use serde_json::Value;

use crate::bringup::bridge::{self, Direction};
use crate::bringup::catalogue::Role;
use crate::bringup::move_base::move_base;
use crate::bringup::navigation;
use crate::bringup::parameters::{self, NamedParameters, text_of, texts_of, truth_of};
use crate::bringup::parts::{BuiltInRequest, searched};
use crate::bringup::report::PartOutcomeKind;
use crate::bringup::runner::Settings;
use crate::bringup::tasks::{
    ControllerSpawner, JointStateTask, Manager, ManagerSettings, MuxTopics, Relay, Saver, Spawner,
    SpawnerKind, SpawnerOptions, Task, TwistMux, TwistStamper, Unstamp, robot,
};
use crate::bringup::transform::FixedFrame;

/// Created replacement.
#[derive(Default)]
pub(crate) struct BuiltIn {
    pub(crate) kept: Vec<Box<dyn Any + Send>>,
    pub(crate) tasks: Vec<Box<dyn Task>>,
    pub(crate) kind: PartOutcomeKind,
    pub(crate) node: Option<String>,
    pub(crate) told: String,
    /// Notes for the user.
    pub(crate) notes: Vec<String>,
}

impl BuiltIn {
    fn keep(&mut self, what: impl Any + Send) {
        self.kept.push(Box::new(what));
    }

    fn hand(&mut self, hand: impl Task + 'static) {
        self.tasks.push(Box::new(hand));
    }
}

/// Creates the replacement of a program.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn make(
    ask: &BuiltInRequest,
    graph: &Graph,
    now_ns: i64,
    settings: &Settings,
    lacking: &[String],
) -> Result<BuiltIn, String> {
    let mut made = BuiltIn { told: ask.entry.becomes.to_owned(), ..BuiltIn::default() };
    match ask.entry.role {
        Role::Viewer | Role::Needless | Role::Container | Role::Gazebo => {
            made.kind = PartOutcomeKind::Needless;
            return Ok(made);
        }
        Role::Lacking => {
            made.kind = PartOutcomeKind::Missing;
            return Ok(made);
        }
        _ => {}
    }
    let mut notes = Vec::new();
    let mut named = parameters(ask, &mut notes);
    // This node also reads values for which ROS 2 has no type, such as lists of mappings.
    if ask.entry.role != Role::MoveBase {
        made.notes.extend(notes);
    }
    // Arguments of this command take precedence, as for programs started directly.
    named.extend(graph.parameters_given_to(&ask.full_name()));
    let node = node(ask, graph, &named, &mut made.notes)?;
    made.node = Some(node.full_name().to_owned());
    let failed = |error: GraphError| error.to_string();
    let words = &ask.told.own;
    match ask.entry.role {
        Role::RobotStatePublisher => {
            let text =
                description(ask, &named, &settings.search.working_folder)?.ok_or_else(|| {
                    "the parameter `robot_description` is missing: set it to a URDF".to_owned()
                })?;
            let options = RobotStateParams::default();
            if is_urdf(&text) {
                made.keep(
                    RobotStatePublisher::of_urdf(node, text, options)
                        .map_err(|error| error.to_string())?,
                );
            } else {
                let model = robot(&text, &settings.search)?;
                made.keep(RobotStatePublisher::new(node, text, &model, options).map_err(failed)?);
            }
        }
        Role::JointStatePublisher => {
            let mut values = JOINT_STATE_PUBLISHER.check([], None, &mut Diagnostics::new());
            let declared = node.parameters(values.clone()).map_err(failed)?;
            values.clone_from(&declared.values());
            let params = JointStateParams::from_values(&values);
            let mut options = JointStateOptions { params, ..JointStateOptions::default() };
            for name in named.keys() {
                let zero = name.strip_prefix("zeros.");
                if let Some((joint, zero)) = zero.zip(parameters::number_of(&named, name)) {
                    options.zeros.insert(joint.to_owned(), zero);
                }
            }
            match description(ask, &named, &settings.search.working_folder)? {
                Some(text) => {
                    let model = robot(&text, &settings.search)?;
                    made.keep(JointStateSource::new(node, &model, options).map_err(failed)?);
                }
                None => made.hand(JointStateTask::new(node, options)?),
            }
        }
        Role::StaticTransform => {
            let frame = FixedFrame::read(words, &named)?;
            made.told = format!("`{}` in `{}`", frame.child, frame.parent);
            made.keep(frame.tell(&node)?);
        }
        Role::Spawn => {
            let namespace = node.names().namespace().to_owned();
            let parameter = |name: &str| {
                let value = searched(&ask.server, &namespace, name)?;
                value.as_str().map(str::to_owned)
            };
            let folder = &settings.search.working_folder;
            let path = |file: &str| ask.path(folder, file);
            let given = (words.as_slice(), &named);
            let spawner = Spawner::new(&node, given, &parameter, &path, now_ns)?
                .written_at(ask.written.as_deref());
            made.told = spawner.told();
            // It needs its subscription until then.
            made.hand(spawner);
            drop(node);
        }
        Role::Bridge => bridged(ask, graph, node, &named, &mut made)?,
        Role::Slam(program) => slam(ask, node, program, &named, settings, &mut made)?,
        Role::MapServer { .. } | Role::MapSaver(_) => {
            maps(ask, node, &named, settings, &mut made)?;
        }
        Role::MapSaverServer => {
            let saver = MapSaver::new(node, Distro::Jazzy, Arc::new(Machine)).map_err(failed)?;
            made.keep(saver);
        }
        Role::Amcl { .. } => {
            let full_name = node.full_name().to_owned();
            let name = node.names().name().to_owned();
            let written = ParameterFile::new(&named, &full_name)?;
            let values = written.read(&mut made.notes, |tree, found| {
                periplus_nav_nodes::amcl::read_parameters(tree, &name, &[], found)
            });
            let amcl = AmclNode::at(node, values, Arc::new(Machine)).map_err(failed)?;
            if !ask.is_managed {
                amcl.start();
            }
            made.keep(amcl);
        }
        Role::Navigation(server) => {
            let server = navigation::server(ask, (server, node), graph, &named, &mut made.notes)?;
            if !ask.is_managed {
                server.start();
            }
            made.keep(server);
        }
        Role::MoveBase => {
            let servers = move_base(ask, &node, graph, &mut made.notes)?;
            made.keep(servers);
        }
        Role::Costmap => {
            let costmap = navigation::costmap_alone(ask, node, &mut made.notes)?;
            if !ask.is_managed {
                costmap.start();
            }
            made.keep(costmap);
        }
        Role::Ekf => {
            let texts: Vec<(&str, String)> = named
                .iter()
                .map(|(name, value)| (name.as_str(), parameters::words(value)))
                .collect();
            let given = texts.iter().map(|(name, text)| Given::new(name, text.as_str()));
            let mut found = Diagnostics::new();
            let (settings, values) = periplus_ekf::Settings::read(given, &mut found);
            made.notes.extend(grave(&found, &SourceMap::new()));
            made.keep(EkfNode::at(node, settings, values).map_err(failed)?);
        }
        Role::VoxelMarkers => made.keep(VoxelMarkers::at(node).map_err(failed)?),
        Role::VoxelCloud => made.keep(VoxelCloud::at(node).map_err(failed)?),
        Role::LifecycleManager => {
            let names = texts_of(&named, "node_names");
            let namespace = node.names().namespace().trim_end_matches('/').to_owned();
            let is_lacking = |name: &String| lacking.contains(&format!("{namespace}/{name}"));
            let (out, names): (Vec<_>, Vec<_>) = names.into_iter().partition(is_lacking);
            if !out.is_empty() {
                made.notes.push(format!("skips missing nodes: {}", out.join(", ")));
            }
            let is_autostart = truth_of(&named, "autostart").unwrap_or(false);
            made.told = format!("manages {}", names.join(", "));
            // Defaults of Nav2.
            let number = |name, default| parameters::number_of(&named, name).unwrap_or(default);
            let settings = ManagerSettings {
                node_names: names,
                autostart: is_autostart,
                bond_timeout_s: number("bond_timeout", 4.0),
                attempt_respawn_reconnection: truth_of(&named, "attempt_respawn_reconnection")
                    .unwrap_or(true),
                bond_respawn_max_duration_s: number("bond_respawn_max_duration", 10.0),
            };
            made.hand(Manager::new(node, settings, now_ns)?);
        }
        Role::Controllers { .. } | Role::ControlCommand => {
            let spawner = spawner(ask, node, settings, &mut made.notes, now_ns)?;
            made.told = spawner.told();
            made.hand(spawner);
        }
        Role::TwistMux => {
            let mut topics = MuxTopics::of_server(&ask.server, node.full_name());
            if topics.topics.is_empty() {
                topics = MuxTopics::of_parameters(&named);
            }
            if topics.topics.is_empty() {
                return Err("the parameter `topics` is missing: set the sources of commands".into());
            }
            let is_stamped = truth_of(&named, "use_stamped").unwrap_or(false);
            let names: Vec<&str> = topics.topics.iter().map(|one| one.topic.as_str()).collect();
            made.told = format!("selects one of {}", names.join(", "));
            made.hand(TwistMux::new(&node, topics, is_stamped)?);
            made.keep(node);
        }
        Role::TwistStamper => {
            let frame = text_of(&named, "frame_id").unwrap_or_default();
            made.hand(TwistStamper::new(&node, frame)?);
            made.keep(node);
        }
        Role::Relay => {
            let topic = |index: usize, name: &str| {
                words.get(index).cloned().or_else(|| text_of(&named, name))
            };
            let from = topic(0, "input_topic")
                .ok_or("the parameter `input_topic` or an argument is missing")?;
            let to = topic(1, "output_topic").unwrap_or_else(|| format!("{from}_relay"));
            let resolve = |name: &str| node.names().topic(name).map_err(failed);
            let ways = vec![(resolve(&from)?, resolve(&to)?)];
            made.told = format!("relays {from} to {to}");
            made.hand(Relay::new(graph, node, ways)?);
        }
        Role::Gazebo | Role::Viewer | Role::Container | Role::Needless | Role::Lacking => {}
    }
    Ok(made)
}

/// Creates the spawner of controllers.
fn spawner(
    ask: &BuiltInRequest,
    node: Node,
    settings: &Settings,
    notes: &mut Vec<String>,
    now_ns: i64,
) -> Result<ControllerSpawner, String> {
    let folder = &settings.search.working_folder;
    let path = |file: &str| folder.join(ask.path(folder, file)).display().to_string();
    let words = &ask.told.own;
    let options = match ask.entry.role {
        Role::ControlCommand => SpawnerOptions::of_command(words, &path)?,
        Role::Controllers { unloads: true } => {
            SpawnerOptions::read(SpawnerKind::Unspawner, words, &path)?
        }
        _ => SpawnerOptions::read(SpawnerKind::Spawner, words, &path)?,
    };
    for file in &options.parameter_files {
        if Machine.kind(Path::new(file)).is_none() {
            notes.push(format!("the parameter file {file} does not exist"));
        }
    }
    // ROS 1: the parameters of a controller are in the parameter server.
    let namespace = node.names().namespace().trim_end_matches('/').to_owned();
    let mut texts = Vec::new();
    for name in &options.names {
        let full_name = format!("{namespace}/{name}");
        let prefix = format!("{full_name}/");
        let given: Vec<_> = ask
            .server
            .iter()
            .filter_map(|(key, value)| {
                let key = key.strip_prefix(&prefix)?.replace('/', ".");
                Some((key, parameters::parameter(value)?))
            })
            .collect();
        if !given.is_empty() {
            texts.push((name.clone(), parameters_to_yaml(&full_name, &given)));
        }
    }
    Ok(ControllerSpawner::new(node, options, texts, now_ns))
}

/// Parameters of the node of a program.
pub(crate) fn parameters(ask: &BuiltInRequest, notes: &mut Vec<String>) -> NamedParameters {
    parameters_as(ask, &ask.full_name(), notes)
}

/// Parameters for a node name, from all that a program is given.
pub(crate) fn parameters_as(
    ask: &BuiltInRequest,
    full_name: &str,
    notes: &mut Vec<String>,
) -> NamedParameters {
    let mut named = NamedParameters::new();
    // ROS 1: private parameters of the server first.
    let prefix = format!("{full_name}/");
    for (name, value) in &ask.server {
        let value = parameters::parameter(value);
        if let Some((name, value)) = name.strip_prefix(&prefix).zip(value) {
            named.insert(name.replace('/', "."), value);
        }
    }
    if let Some(value) = ask.server.get("/use_sim_time").and_then(parameters::parameter) {
        named.insert("use_sim_time".to_owned(), value);
    }
    named.extend(parameters::of_node(full_name, &ask.identity.parameters, &ask.told.ros, notes));
    named
}

/// Settings with the remappings of a program.
pub(crate) fn remapped(mut settings: NodeSettings, ask: &BuiltInRequest) -> NodeSettings {
    for (from, to) in &ask.identity.remaps {
        settings = settings.remap(from, to);
    }
    let mut words = ask.told.ros.iter();
    while let Some(word) = words.next() {
        if matches!(word.as_str(), "-r" | "--remap")
            && let Some(rule) = words.next()
            && !rule.starts_with("__")
        {
            settings = settings.rule(rule);
        }
    }
    settings
}

/// Returns true if the root of a description is `<robot>`: other formats are converted first.
fn is_urdf(text: &str) -> bool {
    let mut sources = SourceMap::new();
    let file = sources.add("robot_description", text);
    let document = periplus_xml::parse(file, &sources, &mut Diagnostics::new());
    document.is_some_and(|document| document.root.local_name() == "robot")
}

/// Creates the node of a program; a number is appended to a name in use, as for programs that are
/// started twice.
fn node(
    ask: &BuiltInRequest,
    graph: &Graph,
    named: &NamedParameters,
    notes: &mut Vec<String>,
) -> Result<Node, String> {
    let full_name = ask.full_name();
    let (namespace, name) = full_name.rsplit_once('/').unwrap_or(("", &full_name));
    let has_name = ask.identity.name.is_some() || ask.told.name.is_some();
    let mut number = 1;
    loop {
        let numbered = if number == 1 { name.to_owned() } else { format!("{name}_{number}") };
        let mut settings = NodeSettings::new(numbered).namespace(namespace);
        settings = remapped(settings, ask);
        for (name, value) in named {
            settings = settings.parameter(name, value.clone());
        }
        match graph.node(settings) {
            Err(GraphError::NodeExists { node }) if number < 1000 => {
                if number == 1 && has_name {
                    notes.push(format!("the node name {node} is in use; a number is appended"));
                }
                number += 1;
            }
            made => return made.map_err(|error| error.to_string()),
        }
    }
}

/// Robot description: a parameter, one of the ROS 1 server, or a file in the arguments.
fn description(
    ask: &BuiltInRequest,
    named: &NamedParameters,
    launch_folder: &Path,
) -> Result<Option<String>, String> {
    const NAME: &str = "robot_description";
    if let Some(text) = text_of(named, NAME) {
        return Ok(Some(text));
    }
    let full_name = ask.full_name();
    let namespace = full_name.rsplit_once('/').map_or("", |(namespace, _)| namespace);
    // A remapping applies to parameters too, in ROS 1.
    let bare = |name: &str| name.trim_start_matches('/') == NAME;
    let remap = ask.identity.remaps.iter().find(|(from, _)| bare(from));
    let name = remap.map_or(NAME, |(_, to)| to.as_str());
    if let Some(text) = searched(&ask.server, namespace, name).and_then(Value::as_str) {
        return Ok(Some(text.to_owned()));
    }
    let Some(file) = ask.told.own.iter().find(|word| !word.starts_with('-')) else {
        return Ok(None);
    };
    let file = &ask.path(launch_folder, file);
    let bytes = Machine.read(Path::new(file));
    let bytes = bytes.map_err(|error| format!("{file} cannot be read: {error}"))?;
    String::from_utf8(bytes).map(Some).map_err(|_| format!("{file} is not a text file"))
}

fn slam(
    ask: &BuiltInRequest,
    node: Node,
    program: Program,
    named: &NamedParameters,
    settings: &Settings,
    made: &mut BuiltIn,
) -> Result<(), String> {
    let written = ParameterFile::new(named, node.full_name())?;
    let values = written.read(&mut made.notes, |tree, found| match tree {
        Some(tree) => periplus_nav_nodes::slam_toolbox::read(tree, Some(program), found).values,
        None => program.table().check([], None, found),
    });
    let pace = if settings.is_paced { Pace::Sliced } else { Pace::Whole };
    let slam = SlamNode::at(node, program, values, Arc::new(Machine), pace);
    let slam = slam.map_err(|error| error.to_string())?;
    // A lifecycle manager of the launch finds it by the parameter of this name.
    let is_managed = ask.is_managed || truth_of(named, "use_lifecycle_manager") == Some(true);
    if !is_managed {
        slam.start();
    }
    made.keep(slam);
    Ok(())
}

fn maps(
    ask: &BuiltInRequest,
    node: Node,
    named: &NamedParameters,
    settings: &Settings,
    made: &mut BuiltIn,
) -> Result<(), String> {
    let folder = &settings.search.working_folder;
    let words = &with_paths(ask, folder);
    let is_managed = ask.entry.role == Role::MapServer { is_managed: true };
    if let Role::MapSaver(distro) = ask.entry.role {
        made.hand(Saver::new(&node, words, distro)?);
        return Ok(());
    }
    if !is_managed && words.iter().any(|word| word == "-f") {
        made.notes.push("`-f` saves a map: running `map_saver`".into());
        made.told = "saves one map and ends".into();
        made.hand(Saver::new(&node, words, Distro::Noetic)?);
        return Ok(());
    }
    let distro = if is_managed { Distro::Jazzy } else { Distro::Noetic };
    let file = words.iter().find(|word| !word.starts_with('-'));
    let parameter = || {
        text_of(named, "yaml_filename").map(|file| match file.as_str() {
            "" => file,
            _ => ask.path(folder, &file),
        })
    };
    let file_of_map = file.cloned().or_else(parameter).unwrap_or_default();
    let params =
        MapServerParams { yaml_filename: file_of_map.clone(), ..MapServerParams::default() };
    let server = MapServer::new(node, params, distro, Arc::new(Machine));
    let server = server.map_err(|error| error.to_string())?;
    if !ask.is_managed {
        // The server logs errors of its map; a launch needs a separate message.
        if let Some(why) = unusable_map(&file_of_map, distro) {
            return Err(why);
        }
        server.start();
    }
    made.keep(server);
    Ok(())
}

/// Reason why a map cannot be served.
fn unusable_map(file: &str, distro: Distro) -> Option<String> {
    if file.is_empty() {
        return Some("no map given: pass its YAML, `args=\"MAP.yaml\"`".into());
    }
    if let Err(why) = Machine.read(Path::new(file)) {
        return Some(format!("the map {file} cannot be read: {why}"));
    }
    let is_map = periplus_maps::load(file, distro, &Machine).map.is_some();
    let words =
        || format!("{file} is not a usable map; `periplus map info {file}` prints the reason");
    (!is_map).then(words)
}

/// Arguments of a program that reads or writes a map, with resolved paths.
fn with_paths(ask: &BuiltInRequest, launch_folder: &Path) -> Vec<String> {
    let words = &ask.told.own;
    let is_saved = |index: usize| index > 0 && words[index - 1] == "-f";
    let is_served =
        |index: usize| ask.entry.role == Role::MapServer { is_managed: false } && index == 0;
    let path = |(index, word): (usize, &String)| {
        let is_path = !word.starts_with('-') && (is_saved(index) || is_served(index));
        if is_path { ask.path(launch_folder, word) } else { word.clone() }
    };
    words.iter().enumerate().map(path).collect()
}

/// Pairs of topics of a bridge, of its arguments and its file.
///
/// # Errors
/// A message when an argument or the file is invalid.
pub(crate) fn pairs_of_bridge(
    ask: &BuiltInRequest,
    named: &NamedParameters,
) -> Result<Vec<bridge::Pair>, String> {
    let is_image = ask.entry.executables == ["image_bridge"];
    let mut pairs = if is_image {
        let topics = ask.told.own.iter().filter(|word| !word.starts_with('-'));
        let pair = |topic: &String| bridge::Pair {
            gz: topic.clone(),
            ros: topic.clone(),
            direction: Direction::GzToRos,
            is_stamped_velocity: false,
        };
        topics.map(pair).collect()
    } else {
        bridge::of_words(&ask.told.own)?
    };
    if let Some(file) = text_of(named, "config_file").filter(|file| !file.is_empty()) {
        pairs.extend(bridge::of_file(Path::new(&file))?);
    }
    Ok(pairs)
}

/// Gazebo topics have their names in the simulation already; remapped ones are relayed.
fn bridged(
    ask: &BuiltInRequest,
    graph: &Graph,
    node: Node,
    named: &NamedParameters,
    made: &mut BuiltIn,
) -> Result<(), String> {
    let pairs = pairs_of_bridge(ask, named)?;
    let mut passed_on = Vec::new();
    for pair in &pairs {
        let gz = gz_topic(&pair.gz);
        let ros = node.names().topic(&pair.ros).map_err(|error| error.to_string())?;
        // The simulation publishes the time itself.
        if gz == ros || ros == "/clock" {
            continue;
        }
        if pair.is_stamped_velocity && pair.direction != Direction::GzToRos {
            passed_on.push(format!("{ros} to {gz} without stamp and frame"));
            made.hand(Unstamp::new(&node, &pair.ros, graph, &gz)?);
            continue;
        }
        let (there, back) = ((gz.clone(), ros.clone()), (ros.clone(), gz.clone()));
        let ways = match pair.direction {
            Direction::GzToRos => vec![there],
            Direction::RosToGz => vec![back],
            Direction::Both => vec![there, back],
        };
        passed_on.push(format!("{gz} to {ros}"));
        made.hand(Relay::new(graph, node.clone(), ways)?);
    }
    if !passed_on.is_empty() {
        made.told = passed_on.join(", ");
    }
    made.keep(node);
    Ok(())
}

/// Parameters as a YAML file, for code that reads files.
pub(crate) struct ParameterFile {
    pub(crate) sources: SourceMap,
    tree: Option<periplus_yaml::YamlNode>,
}

impl ParameterFile {
    /// Writes the parameters of a node by its full name.
    ///
    /// # Errors
    /// A message; unexpected, because the text is generated here.
    pub(crate) fn new(named: &NamedParameters, full_name: &str) -> Result<Self, String> {
        Self::of_nodes(&[("/**".to_owned(), named.clone())], full_name)
    }

    /// Writes the parameters of several nodes, by their names in the file; `full_name` is the node in findings.
    ///
    /// # Errors
    /// A message; unexpected, because the text is generated here.
    pub(crate) fn of_nodes(
        sections: &[(String, NamedParameters)],
        full_name: &str,
    ) -> Result<Self, String> {
        let mut text = String::new();
        for (node, named) in sections.iter().filter(|(_, named)| !named.is_empty()) {
            let all: Vec<_> =
                named.iter().map(|(name, value)| (name.clone(), value.clone())).collect();
            text.push_str(&parameters_to_yaml(node, &all));
        }
        Self::of_text(text, full_name)
    }

    /// Parses parameters; `full_name` is the node in findings.
    ///
    /// # Errors
    /// A message; unexpected, because the text is generated here.
    pub(crate) fn of_text(text: String, full_name: &str) -> Result<Self, String> {
        let mut sources = SourceMap::new();
        let file = sources.add(format!("parameters of {full_name}"), text);
        let tree = periplus_yaml::parse(file, &sources).map_err(|error| error.message)?;
        Ok(Self { sources, tree })
    }

    /// Parses the file; returns warnings and errors as notes.
    pub(crate) fn read<T>(
        &self,
        notes: &mut Vec<String>,
        read: impl FnOnce(Option<&periplus_yaml::YamlNode>, &mut Diagnostics) -> T,
    ) -> T {
        let mut found = Diagnostics::new();
        let value = read(self.tree.as_ref(), &mut found);
        notes.extend(grave(&found, &self.sources));
        value
    }
}

/// Warnings and errors as texts.
fn grave(found: &Diagnostics, sources: &SourceMap) -> Vec<String> {
    let grave = found.iter().filter(|one| one.severity != Severity::Hint);
    grave.map(|one| render(one, sources, RenderStyle::Plain).trim_end().to_owned()).collect()
}
