//! Device of all doors and lifts of a world.

use periplus_graph::{
    Graph, GraphError, Level, Mailbox, Node, NodeSettings, Publisher, Qos, Sample,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rmf_door_msgs::{DoorMode, DoorRequest, DoorState};
use periplus_msgs::rmf_lift_msgs::{LiftRequest, LiftState};
use periplus_physics::PhysicsWorld;

use super::door::{Door, DoorMotion};
use super::lift::{Lift, LiftMotion};
use super::read::BuildingPlan;
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// Time between two messages of a state that does not change \[ns\].
const STATE_PERIOD_NS: i64 = 1_000_000_000;

/// Interval of commands in a world without physics while something moves \[ns\].
const MOVING_STEP_NS: i64 = 1_000_000;

/// Messages that wait; as many as in Open-RMF.
const DEPTH: usize = 100;

/// Doors on `/door_requests` and `/door_states`, lifts on `/lift_requests` and `/lift_states`.
///
/// States are published once per second and at each change.
pub(super) struct Building {
    doors: Vec<Door>,
    lifts: Vec<Lift>,
    for_doors: Option<Topics<DoorRequest, DoorState>>,
    for_lifts: Option<Topics<LiftRequest, LiftState>>,
    motions: Motions,
}

/// Topics of doors or lifts.
struct Topics<R, S> {
    node: Node,
    requests: Mailbox<R>,
    states: Publisher<S>,
}

#[derive(Clone)]
struct Motions {
    doors: Vec<DoorMotion>,
    lifts: Vec<LiftMotion>,
    /// States that were published last.
    door_states: Vec<Option<DoorState>>,
    lift_states: Vec<Option<LiftState>>,
    /// Time at which all states are published next \[ns\].
    next_ns: i64,
    now_ns: i64,
    /// True if something moved in the last step.
    was_moving: bool,
}

impl Building {
    /// Creates the nodes.
    ///
    /// # Errors
    /// When the graph refuses a node.
    pub(super) fn new(graph: &Graph, plan: BuildingPlan) -> Result<Self, GraphError> {
        let doors: Vec<Door> = plan.doors.into_iter().map(Door::new).collect();
        let lifts: Vec<Lift> = plan.lifts.into_iter().map(Lift::new).collect();
        let for_doors = doors.iter().any(|door| door.spec.is_on_topics).then(|| {
            let node = graph.node(NodeSettings::new("rmf_simulation_door_manager"))?;
            Ok::<_, GraphError>(Topics {
                requests: node.mailbox("/door_requests", Qos::reliable(DEPTH))?,
                states: node.publisher("/door_states", Qos::reliable(DEPTH))?,
                node,
            })
        });
        let for_lifts = (!lifts.is_empty()).then(|| {
            let node = graph.node(NodeSettings::new("rmf_simulation_lift_manager"))?;
            Ok::<_, GraphError>(Topics {
                requests: node.mailbox("/lift_requests", Qos::reliable(DEPTH))?,
                states: node.publisher("/lift_states", Qos::reliable(DEPTH))?,
                node,
            })
        });
        let motions = Motions::new(&doors, &lifts, 0);
        Ok(Self {
            for_doors: for_doors.transpose()?,
            for_lifts: for_lifts.transpose()?,
            doors,
            lifts,
            motions,
        })
    }

    fn read_requests(&mut self) {
        if let Some(Topics { node, requests, .. }) = &self.for_doors {
            for request in requests.drain() {
                let name = &request.door_name;
                let door = self.doors.iter().position(|door| door.spec.name == *name);
                match door.map(|door| (door, &self.doors[door].spec)) {
                    Some((door, spec)) if spec.is_on_topics => {
                        self.motions.doors[door].opens =
                            request.requested_mode.value == DoorMode::MODE_OPEN;
                    }
                    Some(_) => {
                        node.log(Level::Warn, format!("the door `{name}` belongs to a lift"));
                    }
                    None => node.log(Level::Warn, format!("there is no door `{name}`")),
                }
            }
        }
        if let Some(Topics { node, requests, .. }) = &self.for_lifts {
            for request in requests.drain() {
                let name = &request.lift_name;
                let taken = match self.lifts.iter().position(|lift| lift.spec.name == *name) {
                    Some(lift) => self.lifts[lift].request(&mut self.motions.lifts[lift], &request),
                    None => Err(format!("there is no lift `{name}`")),
                };
                if let Err(why) = taken {
                    node.log(
                        Level::Warn,
                        format!("request of `{}` ignored: {why}", request.session_id),
                    );
                }
            }
        }
    }

    fn publish(&mut self, is_due: bool) {
        let Motions { doors, lifts, door_states, lift_states, now_ns, .. } = &mut self.motions;
        let time = Time::of_ns(*now_ns);
        if let Some(topics) = &self.for_doors {
            for ((door, motion), last) in self.doors.iter().zip(&*doors).zip(door_states) {
                if !door.spec.is_on_topics {
                    continue;
                }
                let state = DoorState {
                    door_name: door.spec.name.clone(),
                    current_mode: motion.position.mode(),
                    ..DoorState::default()
                };
                if is_due || last.as_ref() != Some(&state) {
                    topics.states.publish(DoorState { door_time: time.clone(), ..state.clone() });
                    *last = Some(state);
                }
            }
        }
        if let Some(topics) = &self.for_lifts {
            for ((lift, motion), last) in self.lifts.iter().zip(lifts).zip(lift_states) {
                let state = lift.state(motion, doors);
                if is_due || last.as_ref() != Some(&state) {
                    topics.states.publish(LiftState { lift_time: time.clone(), ..state.clone() });
                    *last = Some(state);
                }
            }
        }
    }

    fn is_moving(&self) -> bool {
        let lifts = self.lifts.iter().zip(&self.motions.lifts);
        self.motions.doors.iter().any(|door| !door.is_done())
            || lifts.into_iter().any(|(lift, motion)| lift.is_moving(motion))
    }
}

impl Motions {
    fn new(doors: &[Door], lifts: &[Lift], now_ns: i64) -> Self {
        Self {
            door_states: vec![None; doors.len()],
            lift_states: vec![None; lifts.len()],
            doors: doors.iter().map(Door::first_motion).collect(),
            lifts: lifts.iter().map(Lift::first_motion).collect(),
            next_ns: now_ns + STATE_PERIOD_NS,
            now_ns,
            was_moving: true,
        }
    }
}

impl Device for Building {
    fn name(&self) -> &str {
        "doors and lifts"
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        self.read_requests();
        let Motions { doors, lifts, .. } = &mut self.motions;
        let step_s = span.seconds();
        for (lift, motion) in self.lifts.iter_mut().zip(lifts) {
            lift.act(motion, (&self.doors, &mut *doors), world, step_s);
        }
        for (door, motion) in self.doors.iter_mut().zip(doors) {
            door.act(motion, world, step_s);
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        for (door, motion) in self.doors.iter_mut().zip(&mut self.motions.doors) {
            door.look(motion, moment.world);
        }
        let now_ns = moment.time_ns();
        self.motions.now_ns = now_ns;
        let is_due = now_ns >= self.motions.next_ns;
        if is_due {
            self.motions.next_ns = now_ns + STATE_PERIOD_NS;
        }
        let is_moving = self.is_moving();
        if is_due || is_moving || self.motions.was_moving {
            self.publish(is_due);
        }
        self.motions.was_moving = is_moving;
    }

    fn next_ns(&self) -> Option<i64> {
        let Motions { next_ns, now_ns, .. } = self.motions;
        Some(if self.is_moving() { next_ns.min(now_ns + MOVING_STEP_NS) } else { next_ns })
    }

    fn reset(&mut self, time_ns: i64) {
        if let Some(topics) = &self.for_doors {
            drop(topics.requests.drain());
        }
        if let Some(topics) = &self.for_lifts {
            drop(topics.requests.drain());
        }
        self.motions = Motions::new(&self.doors, &self.lifts, time_ns);
    }

    fn save(&self) -> DeviceState {
        let doors = self.for_doors.as_ref().map(|topics| topics.requests.pending());
        let lifts = self.for_lifts.as_ref().map(|topics| topics.requests.pending());
        let waiting: SavedRequests = (doors, lifts);
        DeviceState::new((self.motions.clone(), waiting))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((motions, (doors, lifts))) = saved.get::<(Motions, SavedRequests)>() else {
            return false;
        };
        self.motions = motions.clone();
        if let (Some(topics), Some(waiting)) = (&self.for_doors, doors) {
            topics.requests.set_pending(waiting);
        }
        if let (Some(topics), Some(waiting)) = (&self.for_lifts, lifts) {
            topics.requests.set_pending(waiting);
        }
        true
    }
}

/// Requests that wait, of doors and lifts.
type SavedRequests = (Option<Vec<Sample>>, Option<Vec<Sample>>);
