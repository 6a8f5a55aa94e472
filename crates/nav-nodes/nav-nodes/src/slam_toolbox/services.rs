//! Services of `slam_toolbox`, and that of `slam_gmapping`.

use std::path::{Path, PathBuf};

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_graph::{Actor, GraphError, Level, Node};
use periplus_maps::{Distro, Saving, render, to_message};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::nav_msgs::{GetMap, GetMapResponse};
use periplus_msgs::slam_toolbox::{
    Clear, ClearQueue, ClearQueueResponse, ClearResponse, DeserializePoseGraph,
    DeserializePoseGraphRequest, DeserializePoseGraphResponse, LoopClosure, LoopClosureResponse,
    Pause, PauseResponse, Reset, ResetResponse, SaveMap, SaveMapResponse, SerializePoseGraph,
    SerializePoseGraphResponse, ToggleInteractive, ToggleInteractiveResponse,
};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};
use periplus_msgs::visualization_msgs::{GetInteractiveMarkers, GetInteractiveMarkersResponse};

use crate::slam_toolbox::Program;
use crate::slam_toolbox::engine::{Engine, Start, settings};
use crate::slam_toolbox::messages::published;
use crate::slam_toolbox::node::SlamNode;
use crate::slam_toolbox::parameters::NodeParams;

/// Extension of session files.
const ENDING: &str = "session";

pub(crate) fn serve(
    actor: &mut Actor<SlamNode>,
    program: Program,
    params: &NodeParams,
) -> Result<(), GraphError> {
    if !program.is_toolbox() {
        return actor.serve::<GetMap>("dynamic_map", |state, _, io| state.map_now(io.node()));
    }
    actor.serve::<GetMap>("slam_toolbox/dynamic_map", |state, _, io| state.map_now(io.node()))?;
    if params.offers_map_saver {
        actor.serve::<SaveMap>("slam_toolbox/save_map", |state, request, io| SaveMapResponse {
            result: state.save_map(&request.name.data, io.node()),
        })?;
    }
    actor.serve::<SerializePoseGraph>("slam_toolbox/serialize_map", |state, request, io| {
        let is_written = state.serialize(&request.filename, io.node());
        let result = if is_written {
            SerializePoseGraphResponse::RESULT_SUCCESS
        } else {
            SerializePoseGraphResponse::RESULT_FAILED_TO_WRITE_FILE
        };
        SerializePoseGraphResponse { result }
    })?;
    actor.serve::<DeserializePoseGraph>("slam_toolbox/deserialize_map", |state, request, io| {
        state.deserialize(&request, io.node());
        DeserializePoseGraphResponse::default()
    })?;
    actor.serve::<Pause>("slam_toolbox/pause_new_measurements", |state, _, io| {
        state.is_paused = !state.is_paused;
        state.show_state("paused_new_measurements", state.is_paused);
        let words = if state.is_paused { "new scans are left out" } else { "new scans count" };
        io.node().log(Level::Info, words);
        PauseResponse { status: true }
    })?;
    actor.serve::<Reset>("slam_toolbox/reset", |state, request, io| {
        state.reset(request.pause_new_measurements, io.node());
        ResetResponse { result: ResetResponse::RESULT_SUCCESS }
    })?;
    actor.serve::<ClearQueue>("slam_toolbox/clear_queue", |state, _, io| {
        let now_ns = io.now_ns();
        if let Some(scans) = &mut state.scans {
            scans.clear(now_ns);
        }
        ClearQueueResponse { status: true }
    })?;
    if program == Program::Localization {
        actor.serve::<Empty>("slam_toolbox/clear_localization_buffer", |state, _, _| {
            if let Some(Engine::Localizer(localizer)) = &mut state.engine {
                localizer.forget();
            }
            EmptyResponse::default()
        })?;
    }
    actor.serve::<ToggleInteractive>("slam_toolbox/toggle_interactive_mode", |state, _, io| {
        state.toggle_interactive(io.node());
        ToggleInteractiveResponse::default()
    })?;
    actor.serve::<GetInteractiveMarkers>(
        "slam_toolbox/get_interactive_markers",
        |state, _, io| GetInteractiveMarkersResponse {
            sequence_number: state.handled,
            markers: state.handles(io.now_ns()),
        },
    )?;
    actor.serve::<Clear>("slam_toolbox/clear_changes", |state, _, _| {
        state.moved.clear();
        ClearResponse::default()
    })?;
    actor.serve::<LoopClosure>("slam_toolbox/manual_loop_closure", |state, _, io| {
        state.add_manual_constraints(io.node());
        LoopClosureResponse::default()
    })
}

impl SlamNode {
    fn map_now(&self, node: &Node) -> GetMapResponse {
        let frame = &self.params.map_frame;
        let now = Time::of_ns(node.now_ns());
        let map = self.map.as_ref().map(|map| to_message(&published(map), frame, now));
        if map.is_none() {
            node.log(Level::Warn, "a client requests the map, and there is none yet");
        }
        GetMapResponse { map: map.unwrap_or_default() }
    }

    /// Saves the map as an image; returns the result code.
    fn save_map(&self, name: &str, node: &Node) -> u8 {
        let name = if name.is_empty() { "map" } else { name };
        let Some(map) = &self.map else {
            node.log(Level::Error, "there is no map to save yet; have the robot see something");
            return SaveMapResponse::RESULT_NO_MAP_RECEIEVD;
        };
        let files = render(map, &Saving::new(name, Distro::Jazzy));
        let written = [
            (&files.image_path, files.image.as_slice()),
            (&files.yaml_path, files.yaml.as_bytes()),
        ]
        .into_iter()
        .try_for_each(|(path, bytes)| {
            let path = Path::new(path);
            self.files
                .replace(path, bytes)
                .map_err(|why| format!("cannot write {}: {why}", path.display()))
        });
        match written {
            Ok(()) => {
                node.log(Level::Info, format!("the map is saved: {}", files.yaml_path));
                SaveMapResponse::RESULT_SUCCESS
            }
            Err(why) => {
                node.log(Level::Error, why);
                SaveMapResponse::RESULT_UNDEFINED_FAILURE
            }
        }
    }

    fn serialize(&self, name: &str, node: &Node) -> bool {
        let Some(slam) = self.engine.as_ref().and_then(Engine::graph) else {
            node.log(Level::Error, "there is no graph to save");
            return false;
        };
        let path = session_path(name);
        match self.files.replace(&path, &slam.save()) {
            Ok(()) => {
                node.log(Level::Info, format!("the session is saved: {}", path.display()));
                true
            }
            Err(why) => {
                node.log(Level::Error, format!("cannot write {}: {why}", path.display()));
                false
            }
        }
    }

    fn deserialize(&mut self, request: &DeserializePoseGraphRequest, node: &Node) {
        type Request = DeserializePoseGraphRequest;
        let pose = &request.initial_pose;
        let pose = Pose2::new(pose.x, pose.y, pose.theta);
        if !pose.is_finite() {
            node.log(Level::Error, "the graph is not loaded: its initial pose is not finite");
            return;
        }
        let start = match request.match_type {
            Request::START_AT_FIRST_NODE => Start::First,
            Request::START_AT_GIVEN_POSE | Request::LOCALIZE_AT_POSE => Start::At(pose),
            other => {
                node.log(
                    Level::Error,
                    format!(
                        "the graph is not loaded: match_type is {other}; choose 1 to go on where it \
                         began, 2 to go on at the given pose, 3 to be found on it at that pose"
                    ),
                );
                return;
            }
        };
        let localizes = request.match_type == Request::LOCALIZE_AT_POSE
            || self.program == Program::Localization;
        self.load(&request.filename, localizes, start, node);
    }

    /// Replaces the map by a stored graph; returns true on success. Errors are logged.
    pub(crate) fn load(&mut self, name: &str, localizes: bool, start: Start, node: &Node) -> bool {
        let path = session_path(name);
        let settings = settings(self.program, &self.values, self.slices);
        let own_scans = localizes.then_some(self.params.own_scans);
        let read = self
            .files
            .read(&path)
            .map_err(|why| format!("cannot read {}: {why}", path.display()))
            .and_then(|bytes| {
                Engine::stored(&bytes, settings, own_scans, start)
                    .map_err(|why| format!("{}: {why}", path.display()))
            });
        match read {
            Ok(engine) => {
                let kept = engine.graph().map_or(0, |slam| slam.poses().len());
                node.log(Level::Info, format!("{} is loaded: {kept} scans", path.display()));
                self.begin(Some(engine));
                self.is_continued = true;
                true
            }
            Err(why) => {
                let words = format!("{why}. The map stays as it is");
                self.log.report(&Diagnostic::error("no-session", words), node);
                false
            }
        }
    }

    fn reset(&mut self, pauses: bool, node: &Node) {
        if let Some(Engine::Localizer(localizer)) = &mut self.engine {
            // The stored graph is what it is there for.
            let first = localizer.stored().poses().first().copied().unwrap_or(Pose2::IDENTITY);
            localizer.place(first, crate::slam_toolbox::engine::SURE);
        } else {
            self.begin(Engine::empty(self.program, &self.values, self.slices));
        }
        let now_ns = node.now_ns();
        if let Some(scans) = &mut self.scans {
            scans.clear(now_ns);
        }
        self.is_paused = pauses;
        self.show_state("paused_new_measurements", pauses);
        node.log(Level::Info, "the map is reset");
    }

    fn toggle_interactive(&mut self, node: &Node) {
        if !self.params.allows_interactive_mode {
            let words = "interactive mode is not allowed: set `enable_interactive_mode`";
            node.log(Level::Warn, words);
            return;
        }
        self.is_interactive = !self.is_interactive;
        self.show_state("interactive_mode", self.is_interactive);
        // As `slam_toolbox`, whose synchronous node alone looks at it.
        self.show_state("paused_processing", self.is_interactive);
        // What was not confirmed is not meant.
        self.moved.clear();
        let words = if self.is_interactive { "on" } else { "off" };
        node.log(Level::Info, format!("interactive mode is {words}"));
    }

    fn add_manual_constraints(&mut self, node: &Node) {
        let moved = std::mem::take(&mut self.moved);
        if moved.is_empty() {
            let words = "no scan was moved: switch interactive mode on and drag one first";
            node.log(Level::Warn, words);
            return;
        }
        let slices = self.slices;
        let Some(slam) = self.engine.as_mut().and_then(Engine::graph_mut) else {
            node.log(Level::Warn, "the graph is stored and stays as it is; nothing is moved");
            return;
        };
        let tied = slam.add_manual_constraints(&moved);
        slam.work_slices(slices);
        node.log(Level::Info, format!("{tied} of {} moved scans are tied", moved.len()));
    }
}

/// Path of a session file: the given name with its extension.
fn session_path(name: &str) -> PathBuf {
    let path = PathBuf::from(if name.is_empty() { "map" } else { name });
    if path.extension().is_some_and(|ending| ending == ENDING) {
        return path;
    }
    let mut whole = path.into_os_string();
    whole.push(".");
    whole.push(ENDING);
    PathBuf::from(whole)
}
