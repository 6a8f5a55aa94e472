//! The world for viewers: its visuals, poses, and insertable models.
//!
//! | name | type | what |
//! |---|---|---|
//! | `/world/<world>/scene` | `visualization_msgs/MarkerArray`, latched | every visual, after a marker that deletes all |
//! | `/world/<world>/poses` | `tf2_msgs/TFMessage` | models and links in the frame `world`, 30 times a second |
//! | `/world/<world>/sensors` | `tf2_msgs/TFMessage`, latched | mounting poses of the sensors, by topic and by frame |
//! | `/world/<world>/truth` | `diagnostic_msgs/DiagnosticArray`, latched | agreement of maps with
//! the world, periodically |
//! | `/world/<world>/save` | `std_srvs/Trigger` | the world as it is now, as SDF |
//! | `/world/<world>/changes` | `std_srvs/Trigger` | edits since the start as a diff of the world's file, as JSON |
//! | `/world/<world>/write` | `std_srvs/Trigger` | writes the edited text of `changes` to the file that the user has named |
//! | `/world/<world>/library` | `std_srvs/Trigger` | insertable models, as JSON |
//!
//! They exist only after a request ([`super::Services::show`]): a bag of all topics must not contain
//! unrequested ones.

mod changes;
mod library;
mod map_comparison;
mod markers;
pub(super) mod save;
mod writer;

use std::path::PathBuf;
use std::time::Duration;

use periplus_geometry::Pose;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Transform, TransformStamped};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::visualization_msgs::MarkerArray;
use periplus_os::Stopwatch;

use self::map_comparison::MapComparison;
use self::writer::WorldWriter;
use super::convert::{pose_message, vector_message};
use super::gz_sim::name_of;
use super::reading::Search;
use super::service_aliases::ServiceAliases;
use crate::Simulation;

/// Wall time between two pose messages: smooth motion for a viewer.
const PERIOD: Duration = Duration::from_millis(33);

/// Name of the world frame.
const WORLD: &str = "world";

/// The world for viewers.
pub(super) struct ViewerTopics {
    scene: Publisher<MarkerArray>,
    poses: Publisher<TFMessage>,
    sensors: Publisher<TFMessage>,
    truth: MapComparison,
    save: ServiceAliases<Trigger>,
    changes: ServiceAliases<Trigger>,
    write: Option<WorldWriter>,
    library: ServiceAliases<Trigger>,
    /// Folders of insertable models.
    folders: Vec<PathBuf>,
    /// Version of the world that was published last.
    told: Option<u64>,
    since: Option<Stopwatch>,
}

impl ViewerTopics {
    pub(super) fn new(node: &Node, world: &str, folders: Vec<PathBuf>) -> Result<Self, GraphError> {
        let name = |what| name_of(world, what);
        Ok(Self {
            scene: node.publisher(&name("scene"), Qos::latched(1))?,
            poses: node.publisher(&name("poses"), Qos::best_effort(1))?,
            sensors: node.publisher(&name("sensors"), Qos::latched(1))?,
            truth: MapComparison::new(node, &name("truth"))?,
            save: ServiceAliases::new(node, [name("save").as_str()])?,
            changes: ServiceAliases::new(node, [name("changes").as_str()])?,
            library: ServiceAliases::new(node, [name("library").as_str()])?,
            write: None,
            folders,
            told: None,
            since: None,
        })
    }

    /// Offers to write the world to a file.
    pub(super) fn offer_writing(
        &mut self,
        node: &Node,
        world: &str,
        file: PathBuf,
    ) -> Result<(), GraphError> {
        self.write = Some(WorldWriter::new(node, &name_of(world, "write"), file)?);
        Ok(())
    }

    /// Answers requests, and publishes due messages.
    pub(super) fn serve(
        &mut self,
        simulation: &mut Simulation,
        search: &Search,
    ) -> Result<(), GraphError> {
        self.save.answer(|_| response(save::text(simulation)));
        let written = self.write.as_ref().and_then(WorldWriter::written);
        self.changes.answer(|_| {
            response(changes::of(simulation, search, written).map(|changes| changes.to_json()))
        });
        if let Some(writer) = &mut self.write {
            writer.serve(simulation, search);
        }
        self.library.answer(|_| {
            let message = library::models(&self.folders);
            TriggerResponse { success: true, message }
        });
        let changes = simulation.changes();
        if self.told.replace(changes) != Some(changes) {
            self.scene.publish(markers::of(simulation));
            self.sensors.publish(sensors(simulation));
        }
        let is_due = self.since.as_ref().is_none_or(|since| since.elapsed() >= PERIOD);
        if is_due && self.poses.is_heard() {
            self.since = Some(Stopwatch::start());
            self.poses.publish(poses(simulation));
        }
        self.truth.serve(simulation)
    }
}

fn response(message: Result<String, String>) -> TriggerResponse {
    let success = message.is_ok();
    TriggerResponse { success, message: message.unwrap_or_else(|why| why) }
}

fn transform(header: &Header, child_frame_id: String, pose: Pose) -> TransformStamped {
    let translation = vector_message(pose.translation);
    let rotation = pose_message(pose).orientation;
    let transform = Transform { translation, rotation };
    TransformStamped { header: header.clone(), child_frame_id, transform }
}

/// Returns mounting poses of the sensors' data in `<model>/<link>`. Each is listed by its topic, and
/// by the frame of its messages for bridges that use other names; of two with the same frame the
/// first counts.
fn sensors(simulation: &Simulation) -> TFMessage {
    let mut transforms: Vec<TransformStamped> = Vec::new();
    for (model, mount) in simulation.sensor_mounts() {
        let Some(link) = simulation.motion.link_name(mount.link) else { continue };
        let header = Header::at(simulation.time_ns(), &format!("{model}/{link}"));
        let is_known = transforms.iter().any(|one| one.child_frame_id == mount.frame_id);
        transforms.push(transform(&header, mount.topic, mount.link_from_data));
        if !is_known {
            transforms.push(transform(&header, mount.frame_id, mount.link_from_data));
        }
    }
    TFMessage { transforms }
}

/// Returns the poses of all models and links.
fn poses(simulation: &Simulation) -> TFMessage {
    let header = Header::at(simulation.time_ns(), WORLD);
    let mut transforms = Vec::new();
    let mut put = |child: String, pose: Pose| transforms.push(transform(&header, child, pose));
    let motion = &simulation.motion;
    for running in &simulation.running {
        let name = &running.member.name;
        if let Some(pose) = motion.model_pose(running.model) {
            put(name.clone(), pose);
        }
        for link in motion.links(running.model) {
            if let (Some(own), Some(state)) = (motion.link_name(link), motion.link_state(link)) {
                put(format!("{name}/{own}"), state.world_from_link);
            }
        }
    }
    TFMessage { transforms }
}
