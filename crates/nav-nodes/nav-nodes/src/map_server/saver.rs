//! Map saver node.

use std::path::Path;
use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    Call, Calls, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Mailbox, Node, Qos,
};
use periplus_maps::{Distro, Wish, from_message, render};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::nav2_msgs::{SaveMap, SaveMapRequest, SaveMapResponse};
use periplus_params::{ParamValues, Table, flag, number};

use crate::Files;

/// Default time to wait for a map \[ns\].
pub const WAIT_NS: i64 = 2_000_000_000;

/// Polling period while waiting for a map \[ns\].
const LOOK_NS: i64 = 20_000_000;

/// Parameters of [`MapSaver`].
pub static MAP_SAVER: Table = Table {
    name: "map_saver",
    doc: "Saves maps from topics to files.",
    parameters: &[
        number("save_map_timeout", "s", "Maximum time to wait for a map.")
            .or("2.0")
            .within(0.0, 1e6),
        number("free_thresh_default", "", "Maximum occupancy of free cells, 0 to 1.").or("0.25"),
        number("occupied_thresh_default", "", "Minimum occupancy of occupied cells, 0 to 1.")
            .or("0.65"),
        flag(
            "map_subscribe_transient_local",
            "Subscribes with transient-local durability, which delivers a map published earlier.",
        )
        .or("true"),
    ],
};

/// Lifecycle node that saves maps: the service `~/save_map` waits for the next map on the requested
/// topic, and responds when the files are written or after a timeout.
///
/// Source: `nav2_map_server/src/map_saver/map_saver.cpp`.
pub struct MapSaver {
    files: Arc<dyn Files>,
    distro: Distro,
    values: ParamValues,
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
        let values = MAP_SAVER.check([], None, &mut Diagnostics::new());
        let calls = Some(node.server::<SaveMap>("~/save_map")?);
        let state = Self { files, distro, values: values.clone(), calls, waiting: Vec::new() };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| {
            state.values = values.clone();
            Ok(())
        })?;
        actor.with(|state| state.values = parameters.values());
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
        let latched = self.values.flag("map_subscribe_transient_local").unwrap_or(true);
        let qos = if latched { Qos::latched(1) } else { Qos::reliable(1) };
        match io.node().mailbox(topic, qos) {
            Ok(mailbox) => {
                let wait_s = self.values.number("save_map_timeout").unwrap_or(2.0);
                let until_ns = io.now_ns().saturating_add((wait_s * 1e9) as i64);
                self.waiting.push(Waiting { request, call, mailbox, until_ns });
            }
            Err(error) => refuse(call, io, error.to_string()),
        }
    }

    fn wish(&self, request: &SaveMapRequest) -> Wish {
        let usual = |name: &str, given: f32| match given {
            0.0 => self.values.number(name).unwrap_or(0.0),
            given => decimal(given),
        };
        Wish {
            name: request.map_url.clone(),
            image_format: request.image_format.clone(),
            mode: request.map_mode.clone(),
            occupied_thresh: usual("occupied_thresh_default", request.occupied_thresh),
            free_thresh: usual("free_thresh_default", request.free_thresh),
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
