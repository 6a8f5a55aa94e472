//! Map saver node.

use std::path::Path;
use std::sync::Arc;

use periplus_graph::{
    Call, Calls, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Mailbox, Node, Qos,
};
use periplus_maps::{Distro, Wish, from_message, render};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::nav2_msgs::{SaveMap, SaveMapRequest, SaveMapResponse};
use periplus_params::params;

use crate::Files;

/// Polling period while waiting for a map \[ns\].
const LOOK_NS: i64 = 20_000_000;

params! {
    /// Saves maps from topics to files.
    #[table(MAP_SAVER, "map_saver")]
    pub struct MapSaverParams {
        /// Maximum time to wait for a map.
        #[param("save_map_timeout", unit("s"), within(0.0, 1e6))]
        save_map_timeout_s: f64 = 2.0,
        /// Maximum occupancy of free cells, 0 to 1.
        #[param("free_thresh_default")]
        free_thresh_default: f64 = 0.25,
        /// Minimum occupancy of occupied cells, 0 to 1.
        #[param("occupied_thresh_default")]
        occupied_thresh_default: f64 = 0.65,
        /// Subscribes with transient-local durability, which delivers a map published earlier.
        #[param("map_subscribe_transient_local")]
        map_subscribe_transient_local: bool = true,
    }
}

/// Lifecycle node that saves maps: the service `~/save_map` waits for the next map on the requested
/// topic, and responds when the files are written or after a timeout.
///
/// Source: `nav2_map_server/src/map_saver/map_saver.cpp`.
pub struct MapSaver {
    files: Arc<dyn Files>,
    distro: Distro,
    params: MapSaverParams,
    calls: Option<Calls<SaveMap>>,
    waiting: Vec<Waiting>,
}

/// Request that waits for a map.
struct Waiting {
    request: Arc<SaveMapRequest>,
    call: Call<SaveMap>,
    mailbox: Mailbox<OccupancyGrid>,
    until_ns: i64,
}

impl MapSaver {
    /// Creates the saver on a node; it writes files as the map savers of a distribution do.
    ///
    /// # Errors
    /// When a name exists with another type.
    pub fn new(
        node: Node,
        distro: Distro,
        files: Arc<dyn Files>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let params = MapSaverParams::default();
        let values = params.to_values();
        let calls = Some(node.server::<SaveMap>("~/save_map")?);
        let state = Self { files, distro, params, calls, waiting: Vec::new() };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| {
            state.params = MapSaverParams::from_values(values);
            Ok(())
        })?;
        actor.with(|state| state.params = MapSaverParams::from_values(&parameters.values()));
        actor.timer(LOOK_NS, Self::look)?;
        LifecycleNode::new(actor)
    }

    /// Processes new and waiting requests.
    fn look(&mut self, io: &mut Io<'_, Self>) {
        while let Some(call) = self.calls.as_ref().and_then(Calls::take) {
            self.hear(call, io);
        }
        let waiting = std::mem::take(&mut self.waiting);
        for one in waiting {
            if let Some(map) = one.mailbox.latest() {
                let result = self.save(&map, &one.request, io);
                one.call.answer(SaveMapResponse { result });
            } else if io.now_ns() >= one.until_ns {
                let topic = one.mailbox.topic().to_owned();
                io.node().log(
                    Level::Error,
                    format!(
                        "no map received on `{topic}`; to list its publishers: \
                         `periplus topic info -v {topic}`"
                    ),
                );
                one.call.answer(SaveMapResponse { result: false });
            } else {
                self.waiting.push(one);
            }
        }
    }

    fn hear(&mut self, call: Call<SaveMap>, io: &mut Io<'_, Self>) {
        let refuse = |call: Call<SaveMap>, io: &mut Io<'_, Self>, why: String| {
            io.node().log(Level::Error, why);
            call.answer(SaveMapResponse { result: false });
        };
        if !io.node().is_active() {
            return refuse(call, io, "the map saver is not active".into());
        }
        let request = call.request.clone();
        // Invalid thresholds are rejected without waiting for a map.
        if let Err(error) = self.wish(&request).settle(self.distro, 0) {
            return refuse(call, io, error.to_string());
        }
        let topic = if request.map_topic.is_empty() { "map" } else { &request.map_topic };
        let qos = if self.params.map_subscribe_transient_local {
            Qos::latched(1)
        } else {
            Qos::reliable(1)
        };
        match io.node().mailbox(topic, qos) {
            Ok(mailbox) => {
                let wait_ns = (self.params.save_map_timeout_s * 1e9) as i64;
                let until_ns = io.now_ns().saturating_add(wait_ns);
                self.waiting.push(Waiting { request, call, mailbox, until_ns });
            }
            Err(error) => refuse(call, io, error.to_string()),
        }
    }

    fn wish(&self, request: &SaveMapRequest) -> Wish {
        let or_default = |default: f64, given: f32| match given {
            0.0 => default,
            given => decimal(given),
        };
        Wish {
            name: request.map_url.clone(),
            image_format: request.image_format.clone(),
            mode: request.map_mode.clone(),
            occupied_thresh: or_default(
                self.params.occupied_thresh_default,
                request.occupied_thresh,
            ),
            free_thresh: or_default(self.params.free_thresh_default, request.free_thresh),
        }
    }

    /// Writes both files; returns true on success.
    fn save(&self, map: &OccupancyGrid, request: &SaveMapRequest, io: &mut Io<'_, Self>) -> bool {
        let saved = self.try_save(map, request, io);
        if let Err(words) = &saved {
            io.node().log(Level::Error, format!("the map is not saved: {words}"));
        }
        saved.is_ok()
    }

    fn try_save(
        &self,
        map: &OccupancyGrid,
        request: &SaveMapRequest,
        io: &mut Io<'_, Self>,
    ) -> Result<(), String> {
        let grid = from_message(map).map_err(|error| error.to_string())?;
        let unix_s = io.now_ns().div_euclid(1_000_000_000);
        let settled = self.wish(request).settle(self.distro, unix_s);
        let (saving, said) = settled.map_err(|error| error.to_string())?;
        for words in said {
            io.node().log(Level::Warn, words);
        }
        let files = render(&grid, &saving);
        // The image first: an existing YAML file then always has its image.
        for (path, content) in
            [(&files.image_path, files.image.as_slice()), (&files.yaml_path, files.yaml.as_bytes())]
        {
            self.files
                .replace(Path::new(path), content)
                .map_err(|words| format!("cannot write `{path}`: {words}"))?;
        }
        io.node().log(Level::Info, format!("Map saved to {}", files.yaml_path));
        Ok(())
    }
}

impl LifecycleCallbacks for MapSaver {}

/// Returns the decimal number that was meant by a single-precision number.
fn decimal(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}
