//! Topics of people, computed for subscribers only, and services of their doors.
//!
//! `/people` has detections with the class `person`, `/people/tracks` positions and velocities, `/people/markers` both for
//! displays. They are the truth: no estimator or navigator reads them.

use periplus_crowds::{DoorControl, DoorId};
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_graph::{GraphError, Node, NodeSettings};
use periplus_msgs::geometry_msgs::{Point, PoseWithCovariance};
use periplus_msgs::radar_msgs::{RadarTrack, RadarTracks};
use periplus_msgs::std_msgs::{ColorRGBA, Header};
use periplus_msgs::std_srvs::{SetBool, SetBoolResponse};
use periplus_msgs::unique_identifier_msgs::UUID;
use periplus_msgs::vision_msgs::{
    BoundingBox3D, Detection3D, Detection3DArray, ObjectHypothesis, ObjectHypothesisWithPose,
};
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};

use super::convert::{pose_message, vector_message};
use super::service_aliases::ServiceAliases;
use super::topics::{OnDemand, PeriodTimer};
use crate::people::{HEIGHT_M, PERIOD_NS, PersonMotion};
use crate::record::PEOPLE_TOPIC;
use crate::simulation::Simulation;

/// Period of checks for subscribers \[ns\].
const CHECK_PERIOD_NS: i64 = 100_000_000;

/// Frame of all messages.
const FRAME: &str = "world";

/// Colour of the markers.
const COLOUR: ColorRGBA = ColorRGBA { r: 0.2, g: 0.5, b: 0.9, a: 0.8 };

/// Time for which the arrow of a marker shows the velocity ahead \[s\].
const ARROW_S: f64 = 1.0;

/// Width of the shaft of an arrow \[m\].
const SHAFT_M: f64 = 0.05;

/// Topics and services of people.
pub(super) struct PeopleTopics {
    node: Node,
    look: PeriodTimer,
    publish: PeriodTimer,
    detections: OnDemand<Detection3DArray>,
    tracks: OnDemand<RadarTracks>,
    markers: OnDemand<MarkerArray>,
    doors: Vec<(DoorId, ServiceAliases<SetBool>)>,
}

impl PeopleTopics {
    /// None for a world without people.
    pub(super) fn new(simulation: &Simulation) -> Result<Option<Self>, GraphError> {
        let Some(people) = simulation.people() else { return Ok(None) };
        let now_ns = simulation.time_ns();
        let node = simulation.graph().node(NodeSettings::new("people").keep_names())?;
        let mut doors = Vec::new();
        for (number, name) in people.door_names().iter().enumerate() {
            let door = DoorId(number);
            if people.crowd().door(door).control == DoorControl::Manual {
                let service = format!("/people/doors/{name}/set_open");
                doors.push((door, ServiceAliases::new(&node, [service.as_str()])?));
            }
        }
        Ok(Some(Self {
            look: PeriodTimer::new(CHECK_PERIOD_NS, now_ns.saturating_sub(CHECK_PERIOD_NS)),
            publish: PeriodTimer::new(PERIOD_NS, now_ns),
            detections: OnDemand::new(PEOPLE_TOPIC),
            tracks: OnDemand::new("/people/tracks"),
            markers: OnDemand::new("/people/markers"),
            node,
            doors,
        }))
    }

    /// Advertises the markers also without subscribers, so that viewers find the topic.
    pub(super) fn offer(&mut self) -> Result<(), GraphError> {
        self.markers.keep(&self.node)
    }

    /// Its timers, for a snapshot.
    pub(super) fn save(&self) -> [PeriodTimer; 2] {
        [self.look, self.publish]
    }

    /// Restores its timers.
    pub(super) fn restore(&mut self, saved: [PeriodTimer; 2]) {
        [self.look, self.publish] = saved;
    }

    /// Operates doors, and publishes due messages.
    pub(super) fn serve(&mut self, simulation: &mut Simulation) -> Result<(), GraphError> {
        for (door, service) in &self.doors {
            service.answer(|request| {
                let people = simulation.people_mut();
                let success = people.is_some();
                if let Some(people) = people {
                    people.crowd_mut().set_door_open(*door, request.data);
                }
                SetBoolResponse { success, message: String::new() }
            });
        }
        let now_ns = simulation.time_ns();
        if self.look.is_due(now_ns) {
            let graph = simulation.graph();
            self.detections.look(&self.node, graph)?;
            self.tracks.look(&self.node, graph)?;
            self.markers.look(&self.node, graph)?;
        }
        if !self.publish.is_due(now_ns) {
            return Ok(());
        }
        let floor_m = simulation.people().map_or(0.0, |people| people.floor_m());
        let header = Header::at(now_ns, FRAME);
        let people = || simulation.people_motions();
        if let Some(publisher) = self.detections.heard() {
            let detections = people().map(|(name, it)| detection(name, &it, floor_m, &header));
            let detections = detections.collect();
            publisher.publish(Detection3DArray { header: header.clone(), detections });
        }
        if let Some(publisher) = self.tracks.heard() {
            let tracks = people().enumerate().map(|(id, (_, it))| track(id, &it, floor_m));
            publisher.publish(RadarTracks { header: header.clone(), tracks: tracks.collect() });
        }
        if let Some(publisher) = self.markers.heard() {
            let markers = people().enumerate();
            let markers = markers.flat_map(|(id, (_, it))| markers_of(id, &it, floor_m, &header));
            publisher.publish(MarkerArray { markers: markers.collect() });
        }
        Ok(())
    }
}

/// Pose of the middle of a body.
fn middle(person: &PersonMotion, floor_m: f64) -> Pose {
    let [x_m, y_m] = person.position_m;
    let rpy = Rpy { roll: 0.0, pitch: 0.0, yaw: person.yaw_rad };
    Pose::from_xyz_rpy([x_m, y_m, floor_m + 0.5 * HEIGHT_M], rpy)
}

fn size(person: &PersonMotion) -> DVec3 {
    DVec3::new(2.0 * person.radius_m, 2.0 * person.radius_m, HEIGHT_M)
}

fn detection(name: &str, person: &PersonMotion, floor_m: f64, header: &Header) -> Detection3D {
    let center = pose_message(middle(person, floor_m));
    Detection3D {
        header: header.clone(),
        results: vec![ObjectHypothesisWithPose {
            hypothesis: ObjectHypothesis { class_id: "person".into(), score: 1.0 },
            pose: PoseWithCovariance { pose: center.clone(), ..PoseWithCovariance::default() },
        }],
        bbox: BoundingBox3D { center, size: vector_message(size(person)) },
        id: name.to_owned(),
    }
}

fn track(id: usize, person: &PersonMotion, floor_m: f64) -> RadarTrack {
    let [x, y] = person.position_m;
    let [vx, vy] = person.velocity_m_per_s;
    let mut uuid = UUID::default();
    // The same person has the same number in all runs.
    uuid.uuid[8..].copy_from_slice(&(id as u64).to_be_bytes());
    RadarTrack {
        uuid,
        position: Point { x, y, z: floor_m + 0.5 * HEIGHT_M },
        velocity: vector_message(DVec3::new(vx, vy, 0.0)),
        size: vector_message(size(person)),
        classification: RadarTrack::DYNAMIC,
        ..RadarTrack::default()
    }
}

/// Body and velocity of a person.
fn markers_of(id: usize, person: &PersonMotion, floor_m: f64, header: &Header) -> [Marker; 2] {
    let [x, y] = person.position_m;
    let [vx, vy] = person.velocity_m_per_s;
    let marker = |namespace: &str, kind| Marker {
        header: header.clone(),
        ns: namespace.to_owned(),
        id: i32::try_from(id).unwrap_or(i32::MAX),
        r#type: kind,
        action: Marker::ADD,
        color: COLOUR,
        ..Marker::default()
    };
    let z = floor_m + 0.5 * HEIGHT_M;
    let body = Marker {
        pose: pose_message(middle(person, floor_m)),
        scale: vector_message(size(person)),
        ..marker("people", Marker::CYLINDER)
    };
    let arrow = Marker {
        pose: pose_message(Pose::IDENTITY),
        points: vec![Point { x, y, z }, Point { x: x + vx * ARROW_S, y: y + vy * ARROW_S, z }],
        scale: vector_message(DVec3::new(SHAFT_M, 2.0 * SHAFT_M, 0.0)),
        ..marker("velocities", Marker::ARROW)
    };
    [body, arrow]
}
