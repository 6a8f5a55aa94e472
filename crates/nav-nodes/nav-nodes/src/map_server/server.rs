//! Map server node.

use std::sync::Arc;

use periplus_diagnostics::Severity;
use periplus_graph::{
    GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, Publisher, Qos, StepOutcome,
};
use periplus_maps::{Distro, Loaded, load, to_message};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::nav_msgs::{GetMap, GetMapResponse, MapMetaData, OccupancyGrid};
use periplus_msgs::nav2_msgs::{LoadMap, LoadMapResponse};
use periplus_params::params;

use crate::Files;

params! {
    /// Serves a map from its files.
    #[table(MAP_SERVER, "map_server")]
    pub struct MapServerParams {
        /// YAML file of the map; if empty, a map is loaded by the service `load_map`.
        #[param("yaml_filename")]
        yaml_filename: String = "",
        /// Topic of the map.
        #[param("topic_name")]
        topic_name: String = "map",
        /// Frame of the map.
        #[param("frame_id")]
        frame_id: String = "map",
    }
}

/// Lifecycle node that serves a map: on its topic and its metadata on `map_metadata`, both latched,
/// and by the services `~/map` and `~/load_map`. It loads the map when it is configured, and
/// publishes it when it is activated.
///
/// Source: `nav2_map_server/src/map_server/map_server.cpp`; `map_metadata` as in ROS 1.
pub struct MapServer {
    params: MapServerParams,
    distro: Distro,
    files: Arc<dyn Files>,
    outputs: Option<Outputs>,
    map: Option<OccupancyGrid>,
}

struct Outputs {
    map: Publisher<OccupancyGrid>,
    metadata: Publisher<MapMetaData>,
}

impl MapServer {
    /// Creates the server on a node; the rules of `distro` apply to the files. Arguments of the graph may
    /// change the parameters, as may requests until it is configured.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn new(
        node: Node,
        params: MapServerParams,
        distro: Distro,
        files: Arc<dyn Files>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let values = params.to_values();
        let mut actor = node.actor(Self { params, distro, files, outputs: None, map: None });
        let parameters = actor.parameters(values, |state, values, _| {
            state.params = MapServerParams::from_values(values);
            Ok(())
        })?;
        actor.with(|state| state.params = MapServerParams::from_values(&parameters.values()));
        actor.serve::<GetMap>("~/map", |state, _, io| state.answer(io))?;
        if distro == Distro::Noetic {
            // The name of ROS 1.
            actor.serve::<GetMap>("static_map", |state, _, io| state.answer(io))?;
        }
        actor.serve::<LoadMap>("~/load_map", |state, request, io| {
            state.reload(&request.map_url, io)
        })?;
        LifecycleNode::new(actor)
    }
}

impl LifecycleCallbacks for MapServer {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let path = self.params.yaml_filename.clone();
        if path.is_empty() {
            io.node().log(
                Level::Info,
                "`yaml_filename` is empty; a map comes through the service `load_map`",
            );
        } else if self.load(&path, io).map.is_none() {
            return StepOutcome::Failure;
        }
        match self.advertise(io.node()) {
            Ok(outputs) => {
                self.outputs = Some(outputs);
                StepOutcome::Success
            }
            Err(error) => {
                io.node().log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.publish();
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.outputs = None;
        self.map = None;
        StepOutcome::Success
    }
}

impl MapServer {
    /// Map of a request; empty while the server is not active.
    fn answer(&self, io: &Io<'_, Self>) -> GetMapResponse {
        if io.node().is_active() {
            return GetMapResponse { map: self.map.clone().unwrap_or_default() };
        }
        io.node().log(Level::Warn, "the map was requested, but the map server is not active");
        GetMapResponse::default()
    }

    fn advertise(&self, node: &Node) -> Result<Outputs, GraphError> {
        Ok(Outputs {
            map: node.publisher(&self.params.topic_name, Qos::latched(1))?,
            metadata: node
                .publisher(&format!("{}_metadata", self.params.topic_name), Qos::latched(1))?,
        })
    }

    /// Loads a map and replaces the current one on success. Errors are logged.
    fn load(&mut self, path: &str, io: &mut Io<'_, Self>) -> Loaded {
        let loaded = load(path, self.distro, &*self.files);
        for finding in loaded.diagnostics.iter() {
            let level = match finding.severity {
                Severity::Error => Level::Error,
                Severity::Warning => Level::Warn,
                Severity::Hint => Level::Info,
            };
            let place = finding.span.map_or(String::new(), |span| {
                let (file, position) = loaded.sources.locate(span);
                format!("{file}:{}:{}: ", position.line, position.column)
            });
            let help = finding.help.iter().map(|help| format!("; {help}"));
            let words = format!("{place}{}{}", finding.message, help.collect::<String>());
            io.node().log(level, words);
        }
        if let Some(map) = &loaded.map {
            let info = map.grid.info;
            io.node().log(
                Level::Info,
                format!(
                    "Read map {}: {} X {} map @ {} m/cell",
                    map.image_path.display(),
                    info.width,
                    info.height,
                    info.resolution_m
                ),
            );
            self.map = Some(to_message(&map.grid, &self.params.frame_id, Time::of_ns(io.now_ns())));
        }
        loaded
    }

    fn reload(&mut self, path: &str, io: &mut Io<'_, Self>) -> LoadMapResponse {
        if !io.node().is_active() {
            io.node().log(Level::Warn, "a map was to be loaded, but the map server is not active");
            let result = LoadMapResponse::RESULT_UNDEFINED_FAILURE;
            return LoadMapResponse { result, ..LoadMapResponse::default() };
        }
        // A file URL is a path with a prefix.
        let path = path.strip_prefix("file://").unwrap_or(path);
        let result = self.load(path, io).status.code();
        if result != LoadMapResponse::RESULT_SUCCESS {
            return LoadMapResponse { result, ..LoadMapResponse::default() };
        }
        self.publish();
        LoadMapResponse { map: self.map.clone().unwrap_or_default(), result }
    }

    fn publish(&self) {
        if let (Some(outputs), Some(map)) = (&self.outputs, &self.map) {
            outputs.metadata.publish(map.info.clone());
            outputs.map.publish(map.clone());
        }
    }
}
