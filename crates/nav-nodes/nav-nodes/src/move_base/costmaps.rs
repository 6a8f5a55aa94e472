//! Costmaps from parameters of ROS 1.
//!
//! Source: `costmap_2d` (Noetic): `costmap_2d_ros.cpp`, `obstacle_layer.cpp`, `static_layer.cpp`, `footprint.cpp`, and
//! the defaults of their dynamic reconfigure.

use periplus_costmap::{CostmapConfig, LayerKind, Nav2Release};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::NodeNames;

use super::values::{PrivateParameters, reading};

/// Release of Nav2 whose costmap behaves most as that of ROS 1.
const RELEASE: Nav2Release = Nav2Release::Humble;

/// Defaults that differ from those of Nav2.
const DEFAULTS: [(&str, &str); 8] = [
    ("global_frame", "map"),
    ("update_frequency", "5.0"),
    ("publish_frequency", "0.0"),
    ("width", "10"),
    ("height", "10"),
    ("resolution", "0.05"),
    ("robot_radius", "0.46"),
    ("transform_tolerance", "0.3"),
];

/// Parameters that observation sources inherit from the groups around them.
const INHERITED: [(&str, &str); 2] =
    [("obstacle_range", "obstacle_max_range"), ("raytrace_range", "raytrace_max_range")];

/// Maximum height of the points of an observation source \[m\].
const MAX_OBSTACLE_HEIGHT_M: &str = "2.0";

/// Parameters of a costmap itself that an obstacle layer has in files without `plugins`.
const OBSTACLE_PARAMETERS: [&str; 8] = [
    "max_obstacle_height",
    "origin_z",
    "z_resolution",
    "z_voxels",
    "mark_threshold",
    "unknown_threshold",
    "publish_voxel_map",
    "footprint_clearing_enabled",
];

/// Parameters of ROS 1 without an effect beside `plugins`, as in ROS; stock files have them in any case.
const WITHOUT_EFFECT: [&str; 12] = [
    "static_map",
    "map_type",
    "obstacle_range",
    "raytrace_range",
    "inscribed_radius",
    "circumscribed_radius",
    "meter_scoring",
    "origin_z",
    "z_resolution",
    "z_voxels",
    "publish_voxel_map",
    "unknown_threshold",
];

/// Reads a costmap from the private parameters of a node with such names: `names` resolves the topics.
pub(super) fn costmap_config(
    name: &str,
    node: &PrivateParameters,
    names: &NodeNames,
    diagnostics: &mut Diagnostics,
) -> CostmapConfig {
    let mut own = node.group(name);
    inherit_footprint(&mut own, node);
    // Sources look for these in all groups around them.
    for (parameter, _) in INHERITED {
        if own.entry(parameter).is_none()
            && let Some(entry) = node.entry(parameter)
        {
            own.push(entry.clone());
        }
    }
    if own.entry("plugins").is_none() {
        add_plugins(&mut own);
    }
    for layer in own.words("plugins") {
        let class = own.text(&format!("{layer}.plugin")).unwrap_or_default().to_owned();
        match LayerKind::of_plugin(&class) {
            Ok((LayerKind::Static, _)) => static_layer(&mut own, &layer, names),
            Ok((LayerKind::Obstacle | LayerKind::Voxel, _)) => {
                obstacle_layer(&mut own, &layer, names);
            }
            _ => {}
        }
    }
    for name in WITHOUT_EFFECT {
        own.remove(name);
    }
    for (name, text) in DEFAULTS {
        own.set_default(name, text);
    }
    for frame in ["global_frame", "robot_base_frame"] {
        without_slash(&mut own, frame);
    }
    for side in ["width", "height"] {
        whole_metres(&mut own, side, diagnostics);
    }
    reading(diagnostics, |found| CostmapConfig::read(own.given(), Some(RELEASE), found))
}

/// The shape of the robot may be given for all costmaps of a node; a footprint takes precedence over a radius.
fn inherit_footprint(own: &mut PrivateParameters, node: &PrivateParameters) {
    for shape in ["footprint", "robot_radius"] {
        if own.entry(shape).is_some() {
            return;
        }
        if let Some(entry) = node.entry(shape) {
            own.push(entry.clone());
            return;
        }
    }
}

/// Adds the layers of files without `plugins`, as ROS had them before Hydro.
fn add_plugins(own: &mut PrivateParameters) {
    let mut layers = Vec::new();
    if own.flag("static_map") == Some(true) {
        layers.push("static_layer");
        own.set("static_layer.plugin", "costmap_2d::StaticLayer");
        own.rename("map_topic", "static_layer.map_topic");
        own.copy("track_unknown_space", "static_layer.track_unknown_space");
    }
    let is_voxel = own.text("map_type") == Some("voxel");
    let class = if is_voxel { "costmap_2d::VoxelLayer" } else { "costmap_2d::ObstacleLayer" };
    layers.push("obstacle_layer");
    own.set("obstacle_layer.plugin", class);
    for source in own.words("observation_sources") {
        own.rename(&source, &format!("obstacle_layer.{source}"));
    }
    own.rename("observation_sources", "obstacle_layer.observation_sources");
    for name in OBSTACLE_PARAMETERS {
        let is_of_voxels = !matches!(name, "max_obstacle_height" | "footprint_clearing_enabled");
        if is_of_voxels && !is_voxel {
            own.remove(name);
        } else {
            own.rename(name, &format!("obstacle_layer.{name}"));
        }
    }
    layers.push("inflation_layer");
    own.set("inflation_layer.plugin", "costmap_2d::InflationLayer");
    for name in ["inflation_radius", "cost_scaling_factor"] {
        own.rename(name, &format!("inflation_layer.{name}"));
    }
    own.set("plugins", format!("[{}]", layers.join(", ")));
}

/// The map in ROS 1: its parameters are those of the layer, and unknown cells stay unknown by default.
fn static_layer(own: &mut PrivateParameters, layer: &str, names: &NodeNames) {
    let parameter = |name: &str| format!("{layer}.{name}");
    let is_rolling = own.flag("rolling_window") == Some(true);
    if !is_rolling && own.flag(&parameter("track_unknown_space")) != Some(false) {
        own.set_default("track_unknown_space", "true");
    }
    for name in ["use_maximum", "lethal_cost_threshold", "unknown_cost_value", "trinary_costmap"] {
        own.copy(&parameter(name), name);
        own.remove(&parameter(name));
    }
    if own.text("unknown_cost_value") == Some("-1") {
        own.set("unknown_cost_value", "255");
    }
    own.remove(&parameter("track_unknown_space"));
    own.remove(&parameter("first_map_only"));
    let topic = own.text(&parameter("map_topic")).filter(|topic| !topic.is_empty());
    let topic = resolved(topic.unwrap_or("map"), names);
    own.set(&parameter("map_topic"), topic);
}

fn obstacle_layer(own: &mut PrivateParameters, layer: &str, names: &NodeNames) {
    own.remove(&format!("{layer}.track_unknown_space"));
    for source in own.words(&format!("{layer}.observation_sources")) {
        let parameter = |name: &str| format!("{layer}.{source}.{name}");
        for (name, modern) in INHERITED {
            if own.entry(&parameter(modern)).is_none() {
                own.copy(&format!("{layer}.{name}"), &parameter(name));
                own.copy(name, &parameter(name));
            }
        }
        own.set_default(&parameter("max_obstacle_height"), MAX_OBSTACLE_HEIGHT_M);
        let topic = own.text(&parameter("topic")).filter(|topic| !topic.is_empty());
        let topic = resolved(topic.unwrap_or(&source), names);
        own.set(&parameter("topic"), topic);
        without_slash(own, &parameter("sensor_frame"));
    }
    for (name, _) in INHERITED {
        own.remove(&format!("{layer}.{name}"));
    }
}

/// Topics of layers are those of the node, with its remappings.
fn resolved(topic: &str, names: &NodeNames) -> String {
    names.topic(topic).unwrap_or_else(|_| topic.to_owned())
}

/// Older files have frames with a slash.
fn without_slash(own: &mut PrivateParameters, frame: &str) {
    let plain = own.text(frame).and_then(|text| text.strip_prefix('/')).map(str::to_owned);
    if let Some(plain) = plain {
        own.set(frame, plain);
    }
}

/// A costmap has whole metres, while ROS 1 accepts fractions.
fn whole_metres(own: &mut PrivateParameters, side: &str, diagnostics: &mut Diagnostics) {
    let Some(entry) = own.entry(side) else { return };
    let Ok(length_m) = entry.text.trim().parse::<f64>() else { return };
    let whole_m = libm::ceil(length_m);
    if whole_m != length_m {
        let text = format!("`{side}` is {length_m} m; the costmap has {whole_m} m");
        let rounded = Diagnostic::warning("not-whole-metres", text).at(entry.origin);
        diagnostics.push(rounded.help("write whole metres"));
    }
    own.set(side, format!("{whole_m}"));
}

#[cfg(test)]
mod tests {
    use periplus_costmap::tables::{SourceParams, StaticLayerParams};
    use periplus_diagnostics::SourceMap;
    use periplus_graph::NodeSettings;

    use super::*;

    fn read(name: &str, text: &str) -> (CostmapConfig, Vec<String>) {
        let mut sources = SourceMap::new();
        let file = sources.add("move_base.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        let node = PrivateParameters::of_tree(tree.as_ref());
        let names = NodeSettings::new("move_base").remap("scan", "front/scan").names();
        let names = names.unwrap_or_else(|error| panic!("{error}"));
        let mut found = Diagnostics::new();
        let config = costmap_config(name, &node, &names, &mut found);
        (config, found.iter().map(|one| one.message.clone()).collect())
    }

    const TURTLEBOT: &str = "
global_costmap:
  obstacle_range: 3.0
  raytrace_range: 3.5
  footprint: [[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1]]
  inflation_radius: 1.0
  cost_scaling_factor: 3.0
  map_type: costmap
  observation_sources: scan
  scan: {sensor_frame: /base_scan, data_type: LaserScan, topic: scan, marking: true, clearing: true}
  global_frame: /map
  robot_base_frame: base_footprint
  static_map: true
local_costmap:
  robot_radius: 0.2
  static_map: false
  rolling_window: true
  width: 3.5
  height: 3.0
  map_type: voxel
  z_voxels: 12
";

    #[test]
    fn files_without_plugins_have_the_layers_of_old() {
        let (config, found) = read("global_costmap", TURTLEBOT);
        assert_eq!(found, [""; 0]);
        let kinds: Vec<LayerKind> = config.layers.iter().map(|layer| layer.kind).collect();
        let expected = [LayerKind::Static, LayerKind::Obstacle, LayerKind::InflationSettings];
        assert_eq!(kinds, expected);
        let params = config.params();
        assert_eq!((params.global_frame.as_str(), params.update_frequency_hz), ("map", 5.0));
        assert!(params.track_unknown_space, "the map has unknown cells");
        assert_eq!(config.layers[0].values.text("map_topic").as_deref(), Some("/map"));
        let source = SourceParams::from_values(&config.layers[1].sources[0].values);
        assert_eq!(
            (source.topic.as_str(), source.sensor_frame.as_str()),
            ("/front/scan", "base_scan")
        );
        assert_eq!((source.obstacle_max_range_m, source.raytrace_max_range_m), (3.0, 3.5));
        assert_eq!(source.max_obstacle_height_m, 2.0);
        assert_eq!(config.layers[2].values.number("inflation_radius"), Some(1.0));
        assert_eq!(config.footprint.points().len(), 4);
    }

    #[test]
    fn a_rolling_costmap_of_voxels() {
        let (config, found) = read("local_costmap", TURTLEBOT);
        let kinds: Vec<LayerKind> = config.layers.iter().map(|layer| layer.kind).collect();
        assert_eq!(kinds, [LayerKind::Voxel, LayerKind::InflationSettings]);
        assert_eq!(config.layers[0].values.integer("z_voxels"), Some(12));
        assert_eq!((config.params().width, config.params().height), (4, 3));
        assert!(!config.params().track_unknown_space);
        assert!(found.iter().any(|text| text.contains("`width` is 3.5 m")), "{found:?}");
        assert!(found.iter().any(|text| text.contains("has no sources")), "{found:?}");
    }

    #[test]
    fn layers_by_name_and_type_inherit_from_the_groups_around_them() {
        let text = "
obstacle_range: 4.0
robot_radius: 0.3
local_costmap:
  origin_z: 0.0
  z_voxels: 2
  plugins:
  - {name: walls, type: 'costmap_2d::ObstacleLayer'}
  walls: {observation_sources: a b, raytrace_range: 6.0, a: {obstacle_range: 2.0}}
";
        let (config, found) = read("local_costmap", text);
        assert!(found.iter().all(|text| text.contains("defaults apply")), "{found:?}");
        let [a, b] = config.layers[0].sources.as_slice() else { panic!("{config:?}") };
        let ranges = |source: &periplus_costmap::SourceConfig| {
            let params = SourceParams::from_values(&source.values);
            (params.obstacle_max_range_m, params.raytrace_max_range_m)
        };
        assert_eq!((ranges(a), ranges(b)), ((2.0, 6.0), (4.0, 6.0)));
        assert!((config.footprint.inscribed_radius_m - 0.31).abs() < 0.01, "padded");
    }

    #[test]
    fn parameters_of_the_map_are_those_of_the_layer() {
        let text = "
global_costmap:
  plugins: [{name: m, type: 'costmap_2d::StaticLayer'}]
  m: {track_unknown_space: false, lethal_cost_threshold: 65, unknown_cost_value: -1, first_map_only: true}
";
        let (config, found) = read("global_costmap", text);
        assert_eq!(found.len(), 0, "{found:?}");
        let params = config.params();
        assert_eq!((params.lethal_cost_threshold, params.unknown_cost_value), (65, 255));
        assert!(!params.track_unknown_space);
        assert_eq!(StaticLayerParams::from_values(&config.layers[0].values).map_topic, "/map");
    }
}
