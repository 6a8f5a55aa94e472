//! Costmap configuration from parameters.

mod build;
mod kind;
mod yaml;

pub use kind::LayerKind;

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, Span};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::{Given, ParamType, ParamValues, Table};

use crate::tables::{CostmapParams, RangeLayerParams, SourceParams};
use crate::{CostmapSettings, Footprint, FootprintError, Nav2Release, SourceSettings, tables};

/// Configuration of a costmap.
#[derive(Clone, Debug, PartialEq)]
pub struct CostmapConfig {
    /// Parameters of the node, from [`tables::COSTMAP`].
    pub node: ParamValues,
    /// Release of Nav2 whose behaviour is used.
    pub compat: Nav2Release,
    /// Release whose service types are used: that of `compat` if it is set explicitly, else Jazzy.
    pub forms: Nav2Release,
    /// Layers, lowest first.
    pub layers: Vec<LayerConfig>,
    /// Filters, lowest first.
    pub filters: Vec<LayerConfig>,
    /// Padded footprint of the robot.
    pub footprint: Footprint,
}

/// Configuration of a layer or filter.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerConfig {
    /// Name, prefixed with those of its containers.
    pub name: String,
    /// Plugin.
    pub kind: LayerKind,
    /// Parameters.
    pub values: ParamValues,
    /// Observation sources.
    pub sources: Vec<SourceConfig>,
    /// Layers of a container.
    pub children: Vec<LayerConfig>,
}

/// Configuration of an observation source.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceConfig {
    /// Name.
    pub name: String,
    /// Parameters.
    pub values: ParamValues,
}

impl SourceConfig {
    /// Converts the parameters.
    #[must_use]
    pub fn settings(&self) -> SourceSettings {
        SourceSettings::read(&self.name, &self.values)
    }
}

/// Maximum nesting depth of containers.
const MAX_CONTAINER_DEPTH: usize = 8;

/// Names and plugins of the default layers.
const DEFAULT_LAYERS: [(&str, LayerKind); 3] = [
    ("static_layer", LayerKind::Static),
    ("obstacle_layer", LayerKind::Obstacle),
    ("inflation_layer", LayerKind::InflationSettings),
];

impl CostmapConfig {
    /// Reads parameters given as names with dots, such as `obstacle_layer.scan.topic`, and texts.
    /// Errors are reported with their positions, and the rest is built; `compat` overrides the
    /// parameter of that name.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut reading = Reading { tree: Tree::default(), diagnostics };
        for one in given {
            reading.add(one);
        }
        let node = reading.values(&tables::COSTMAP, "", Origin::default());
        reading.check_size(&node);
        let given = || CostmapParams::from_values(&node).compat;
        let told = compat.or_else(|| node.is_given("compat").then(given));
        let (compat, forms) = (told.unwrap_or_default(), told.unwrap_or(Nav2Release::Jazzy));
        let names = reading.names(&node, "plugins");
        let is_usual = names.iter().map(String::as_str).eq(DEFAULT_LAYERS.map(|(name, _)| name));
        let defaults = if is_usual { &DEFAULT_LAYERS[..] } else { &[] };
        let list = List { within: "", at: node.origin("plugins"), defaults };
        let layers = reading.layers(&names, &list, compat, 0);
        let names = reading.names(&node, "filters");
        let list = List { within: "", at: node.origin("filters"), defaults: &[] };
        let filters = reading.layers(&names, &list, compat, 0);
        let footprint = reading.footprint(&node);
        reading.warn_of_rest();
        Self { node, compat, forms, layers, filters, footprint }
    }

    /// Returns the settings shared by all layers.
    #[must_use]
    pub fn frame(&self) -> CostmapSettings {
        CostmapSettings::new(&self.params(), self.compat)
    }

    /// Converts the parameters of the node.
    #[must_use]
    pub fn params(&self) -> CostmapParams {
        CostmapParams::from_values(&self.node)
    }

    /// Returns resolution, size and origin; a map may override them.
    #[must_use]
    pub fn info(&self) -> GridInfo {
        grid_info_of(&self.params())
    }
}

/// Returns the grid of parameters of [`tables::COSTMAP`]; a grid that is too large becomes empty.
#[must_use]
pub(crate) fn grid_info_of(params: &CostmapParams) -> GridInfo {
    let resolution_m = params.resolution_m;
    let count = |size_m: usize| (size_m as f64 / resolution_m) as usize;
    let origin = Pose2::new(params.origin_x_m, params.origin_y_m, 0.0);
    let empty = GridInfo { resolution_m, width: 0, height: 0, origin };
    GridInfo::new(resolution_m, count(params.width), count(params.height), origin).unwrap_or(empty)
}

/// Names and texts, by parameter group.
#[derive(Default)]
struct Tree<'a> {
    /// By group (`obstacle_layer.scan`, or empty for the node), then in order.
    groups: BTreeMap<String, Vec<Given<'a>>>,
}

/// A list of layer names.
struct List<'a> {
    /// Container of the list; empty for the node.
    within: &'a str,
    /// Position in the file.
    at: Origin,
    /// Default layers, which need no plugin.
    defaults: &'a [(&'a str, LayerKind)],
}

struct Reading<'a, 'd> {
    tree: Tree<'a>,
    diagnostics: &'d mut Diagnostics,
}

impl<'a> Reading<'a, '_> {
    /// As in ROS 2, the last value applies.
    fn add(&mut self, given: Given<'a>) {
        let (group, name) = given.name.rsplit_once('.').unwrap_or(("", given.name));
        let whole = given.name;
        let given = Given { name, ..given };
        let entries = self.tree.groups.entry(group.to_owned()).or_default();
        let Some(earlier) = entries.iter_mut().find(|entry| entry.name == name) else {
            return entries.push(given);
        };
        self.diagnostics.push(
            Diagnostic::warning(
                "repeated-parameter",
                format!("`{whole}` is set twice; the last value applies"),
            )
            .at(given.name_origin)
            .related(earlier.name_origin, "first set here"),
        );
        *earlier = given;
    }

    /// Removes a parameter from a group.
    fn take(&mut self, group: &str, name: &str) -> Option<Given<'a>> {
        let entries = self.tree.groups.get_mut(group)?;
        let index = entries.iter().position(|entry| entry.name == name)?;
        Some(entries.remove(index))
    }

    /// Reads a group by a table; `at` is the position of errors about missing parameters.
    fn values(&mut self, table: &'static Table, group: &str, at: Origin) -> ParamValues {
        let mut entries = self.tree.groups.remove(group).unwrap_or_default();
        let prefix = if group.is_empty() { String::new() } else { format!("{group}.") };
        if group.is_empty() {
            // Unused parameters are sorted once all layers have been read.
            let (known, rest) =
                entries.into_iter().partition(|entry| table.find(entry.name).is_some());
            entries = known;
            self.tree.groups.insert(String::new(), rest);
        }
        for entry in &mut entries {
            self.accept_old_spelling(table, entry, &prefix);
        }
        table.check(entries, at.0, self.diagnostics)
    }

    /// Accepts old names and other number types with a warning.
    fn accept_old_spelling(&mut self, table: &'static Table, entry: &mut Given<'a>, prefix: &str) {
        let Some(parameter) = table.find(entry.name) else { return };
        if parameter.name != entry.name {
            self.diagnostics.push(
                Diagnostic::hint("ros1-name", format!("`{prefix}{}` is a ROS 1 name", entry.name))
                    .at(entry.name_origin)
                    .replace(
                        entry.name_origin,
                        parameter.name,
                        format!("Nav2 calls it `{}`", parameter.name),
                    ),
            );
        }
        let text = entry.text.trim();
        let has_fraction = text.contains(['.', 'e', 'E']);
        if parameter.kind == ParamType::Integer
            && has_fraction
            && let Ok(number) = text.parse::<f64>()
        {
            let whole = libm::round(number);
            let message = if number == whole {
                format!("`{prefix}{}` is written as {text}, and must be a whole number", entry.name)
            } else {
                format!("`{prefix}{}`: {text} is not a whole number; {whole} is used", entry.name)
            };
            self.diagnostics.push(
                Diagnostic::warning("not-whole", message)
                    .at(entry.origin)
                    .note("Nav2 refuses to start with `parameter has invalid type`")
                    .replace(entry.origin, format!("{whole}"), format!("write `{whole}`")),
            );
            entry.text = format!("{whole}").into();
        }
    }

    fn names(&mut self, values: &ParamValues, parameter: &str) -> Vec<String> {
        let mut names = Vec::new();
        for name in values.texts(parameter) {
            if names.contains(&name) {
                self.diagnostics.push(
                    Diagnostic::warning(
                        "layer-twice",
                        format!("`{name}` is listed twice in `{parameter}`"),
                    )
                    .at(values.origin(parameter))
                    .note("it is used once"),
                );
            } else {
                names.push(name);
            }
        }
        names
    }

    fn layers(
        &mut self,
        names: &[String],
        list: &List<'_>,
        compat: Nav2Release,
        depth: usize,
    ) -> Vec<LayerConfig> {
        let List { within, at, defaults } = *list;
        let mut layers = Vec::new();
        for name in names {
            let full = if within.is_empty() { name.clone() } else { format!("{within}.{name}") };
            let plugin = self.take(&full, "plugin");
            let named_at = plugin.as_ref().map_or(at, |plugin| plugin.origin);
            let kind = match plugin {
                Some(plugin) => self.kind(&full, &plugin),
                None => {
                    let defaults = defaults.iter().find(|(defaults, _)| defaults == name);
                    if defaults.is_none() {
                        self.diagnostics.push(
                            Diagnostic::error("no-plugin", format!("`{full}.plugin` is not set"))
                                .at(at)
                                .note(format!("layer `{full}` is left out"))
                                .help(format!(
                                    "write `plugin: \"nav2_costmap_2d::ObstacleLayer\"`, or \
                                     the plugin of that layer, under `{name}`"
                                )),
                        );
                    }
                    defaults.map(|(_, kind)| *kind)
                }
            };
            let Some(kind) = kind else {
                self.forget(&full);
                continue;
            };
            layers.push(self.layer(full, kind, named_at, compat, depth));
        }
        layers
    }

    fn layer(
        &mut self,
        name: String,
        kind: LayerKind,
        named_at: Origin,
        compat: Nav2Release,
        depth: usize,
    ) -> LayerConfig {
        let values = self.values(kind.table(), &name, named_at);
        let place = |parameter: &str| {
            if values.is_given(parameter) { values.origin(parameter) } else { named_at }
        };
        let mut sources = Vec::new();
        if kind.has_sources() {
            for source in values
                .texts("observation_sources")
                .iter()
                .flat_map(|text| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
            {
                sources.push(self.source(&name, source, values.origin("observation_sources")));
            }
            if sources.is_empty() {
                self.diagnostics.push(
                    Diagnostic::warning("no-sources", format!("layer `{name}` has no sources"))
                        .at(place("observation_sources"))
                        .note("it marks no obstacles")
                        .help(format!("set `{name}.observation_sources`, for example to `scan`")),
                );
            }
        }
        if kind == LayerKind::Range && RangeLayerParams::from_values(&values).topics.is_empty() {
            self.diagnostics.push(
                Diagnostic::error("no-topics", format!("layer `{name}` has no topics"))
                    .at(place("topics"))
                    .help(format!("set `{name}.topics`, for example to `[\"/sonar\"]`")),
            );
        }
        let mut children = Vec::new();
        if kind == LayerKind::Container {
            let names = self.names(&values, "plugins");
            if depth < MAX_CONTAINER_DEPTH {
                let list = List { within: &name, at: place("plugins"), defaults: &[] };
                children = self.layers(&names, &list, compat, depth + 1);
            } else {
                self.diagnostics.push(Diagnostic::error(
                    "too-deep",
                    format!("`{name}` is nested in {MAX_CONTAINER_DEPTH} containers, the maximum; it stays empty"),
                ));
            }
        }
        LayerConfig { name, kind, values, sources, children }
    }

    fn source(&mut self, layer: &str, name: String, named_at: Origin) -> SourceConfig {
        let group = format!("{layer}.{name}");
        let is_described = self.tree.groups.contains_key(&group);
        let values = self.values(&tables::SOURCE, &group, named_at);
        let params = SourceParams::from_values(&values);
        let (low, tall) = (params.min_obstacle_height_m, params.max_obstacle_height_m);
        if tall <= low {
            // The most frequent mistake: all points are dropped without a message.
            let origin = if values.is_given("max_obstacle_height") {
                values.origin("max_obstacle_height")
            } else {
                named_at
            };
            self.diagnostics.push(
                Diagnostic::warning(
                    "nothing-fits",
                    format!("`{group}` accepts points from {low} m to {tall} m: none, or hardly any"),
                )
                .at(origin)
                .note("heights are measured in the global frame; points outside are dropped for marking and clearing")
                .help(format!("set `{group}.max_obstacle_height`, for example to 2.0")),
            );
        }
        if !is_described {
            self.diagnostics.push(
                Diagnostic::warning(
                    "no-source",
                    format!("no parameter is set under `{group}`; all defaults apply"),
                )
                .at(named_at)
                .note(format!("it subscribes to the topic `{name}`")),
            );
        }
        if params.raytrace_max_range_m < params.obstacle_max_range_m && params.clearing {
            self.diagnostics.push(
                Diagnostic::hint(
                    "marks-beyond-clearing",
                    format!("`{group}` has an obstacle range above its raytrace range"),
                )
                .at(values.origin("obstacle_max_range"))
                .note("obstacles marked beyond `raytrace_max_range` are not cleared from the same position")
                .help("set `raytrace_max_range` above `obstacle_max_range`"),
            );
        }
        if params.transport_type != "raw" {
            self.diagnostics.push(
                Diagnostic::warning("transport", format!("`{group}.transport_type` must be `raw`"))
                    .at(values.origin("transport_type"))
                    .help("publish the cloud uncompressed as well"),
            );
        }
        SourceConfig { name, values }
    }

    fn kind(&mut self, name: &str, plugin: &Given<'a>) -> Option<LayerKind> {
        match LayerKind::of_plugin(&plugin.text) {
            Ok((kind, None)) => Some(kind),
            Ok((kind, Some(modern))) => {
                self.diagnostics.push(
                    Diagnostic::hint(
                        "ros1-name",
                        format!("`{}` is a ROS 1 name", plugin.text.trim()),
                    )
                    .at(plugin.origin)
                    .replace(
                        plugin.origin,
                        modern,
                        format!("Nav2 calls it `{modern}`"),
                    ),
                );
                Some(kind)
            }
            Err(why) => {
                self.diagnostics.push(
                    Diagnostic::error("unknown-plugin", format!("`{name}.plugin`: {why}"))
                        .at(plugin.origin)
                        .did_you_mean(plugin.origin, plugin.text.trim(), LayerKind::plugins())
                        .note("the layer is left out, the others are built"),
                );
                None
            }
        }
    }

    /// A costmap that would be too large has no cells.
    fn check_size(&mut self, node: &ParamValues) {
        let params = CostmapParams::from_values(node);
        if !grid_info_of(&params).is_empty() {
            return;
        }
        let CostmapParams { width, height, resolution_m, .. } = params;
        let biggest = ["width", "height", "resolution"].into_iter().find(|it| node.is_given(it));
        self.diagnostics.push(
            Diagnostic::error(
                "bad-size",
                format!(
                    "`width`, `height` and `resolution`: {width} x {height} m in cells of \
                     {resolution_m} m are too many cells, or none"
                ),
            )
            .at(node.origin(biggest.unwrap_or("width")))
            .note("the costmap stays empty until a map gives it a size"),
        );
    }

    fn footprint(&mut self, node: &ParamValues) -> Footprint {
        let params = CostmapParams::from_values(node);
        let footprint = match footprint_of(&params) {
            Ok(footprint) if footprint.points().iter().all(|point| *point == [0.0, 0.0]) => {
                self.diagnostics.push(
                    Diagnostic::warning(
                        "empty-footprint",
                        "`footprint` is empty and `robot_radius` is 0: the robot is a point",
                    )
                    .at(node.origin("robot_radius"))
                    .note("the inscribed radius is 0, so plans may lead along every wall")
                    .help("set `footprint`, or `robot_radius` to half the robot's width"),
                );
                footprint
            }
            Ok(footprint) => footprint,
            Err(error) => {
                self.diagnostics.push(
                    Diagnostic::error("bad-footprint", format!("`footprint`: {error}"))
                        .at(node.origin("footprint"))
                        .note("`robot_radius` is used instead")
                        .help("write corners in order, such as \"[[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]\""),
                );
                Footprint::circle(params.robot_radius_m)
            }
        };
        footprint.padded(params.footprint_padding_m)
    }

    /// Drops the messages about a layer that is left out.
    fn forget(&mut self, layer: &str) {
        let within = format!("{layer}.");
        self.tree.groups.retain(|group, _| group != layer && !group.starts_with(&within));
    }

    /// Warns about parameters that no layer reads.
    fn warn_of_rest(&mut self) {
        for (group, entries) in std::mem::take(&mut self.tree.groups) {
            if group.is_empty() {
                for entry in entries.iter().filter(|entry| !is_common(entry.name)) {
                    self.diagnostics.push(tables::COSTMAP.unknown(entry));
                }
            } else if let Some(entry) = entries.first()
                && !is_common(&group)
            {
                let span: Option<Span> = entry.name_origin.0;
                let mut hint = Diagnostic::hint(
                    "unused-group",
                    format!("no layer or source is named `{group}`; its parameters are unused"),
                );
                hint.span = span;
                self.diagnostics.push(hint.help(
                    "name it in `plugins`, `filters` or `observation_sources`, or remove it",
                ));
            }
        }
    }
}

/// Returns true for parameters of every ROS 2 node.
fn is_common(name: &str) -> bool {
    ["qos_overrides", "diagnostic_updater", "start_type_description_service"]
        .iter()
        .any(|common| name.starts_with(common))
}

/// Returns the footprint without padding.
pub(crate) fn footprint_of(params: &CostmapParams) -> Result<Footprint, FootprintError> {
    let text = params.footprint.trim();
    if text.is_empty() || text == "[]" {
        return Ok(Footprint::circle(params.robot_radius_m));
    }
    Footprint::read(text)
}
