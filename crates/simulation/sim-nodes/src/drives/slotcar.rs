//! `slotcar` of Open-RMF: a robot that follows the paths of a fleet adapter.

mod battery;
mod path;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_graph::{Level, Mailbox, Node, Publisher, Qos, Sample};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rmf_fleet_msgs::{
    Location, ModeRequest, PathRequest, PauseRequest, RobotMode, RobotState,
};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_physics::{ModelId, PhysicsWorld, Twist, drives::planar_velocity};

use self::battery::{Battery, BatteryLoad};
use self::path::{PathFollower, Step};
use super::build_context::BuildContext;
use super::rate_timer::{RateTimer, earlier};
use crate::buildings::{BuildingFloor, MotionLimits};
use crate::states::{TF_QOS, transform};
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// Rate of `/robot_state` \[Hz\].
const STATE_RATE_HZ: f64 = 2.0;

/// Rate of the transform from `world` \[Hz\].
const TRANSFORM_RATE_HZ: f64 = 100.0;

/// Interval of commands in a world without physics \[ns\].
const MOVING_STEP_NS: i64 = 1_000_000;

/// Messages that wait.
const DEPTH: usize = 10;

/// BuildingFloor of a building without lifts, by the usual name.
const ONLY_FLOOR: &str = "L1";

/// Difference in height within which a robot stands on a floor \[m\].
const FLOOR_RANGE_M: f64 = 0.1;

/// Speed, and turn rate in rad/s, below which a robot is at rest \[m/s\].
const STANDING_SPEED_M_S: f64 = 0.01;

/// Drives along the paths of `/robot_path_requests`: to each point, first turning towards it. It stops for requests on
/// `/robot_pause_requests` and where another model is near its front, and publishes `/robot_state`.
///
/// Source: `slotcar` of `rmf_robot_sim_gz_plugins` and `rmf_robot_sim_common`, `rmf_simulation` 2.4. Floors come from the
/// lifts of the world in place of the topic `map` of a building map server.
pub(crate) struct Slotcar {
    name: String,
    model: ModelId,
    robot: String,
    node: Node,
    paths: Mailbox<PathRequest>,
    pauses: Mailbox<PauseRequest>,
    modes: Mailbox<ModeRequest>,
    states: Publisher<RobotState>,
    transforms: Publisher<TFMessage>,
    drive: MotionLimits,
    turn: MotionLimits,
    is_reversible: bool,
    stop_distance_m: f64,
    stop_radius_m: f64,
    battery: Battery,
    floors: Vec<BuildingFloor>,
    state: SlotcarState,
}

#[derive(Clone)]
struct SlotcarState {
    follower: PathFollower,
    mode: RobotMode,
    task: String,
    pause: PauseRequest,
    /// True after a path that does not begin at the robot.
    has_error: bool,
    is_stopped: bool,
    /// Commanded speeds \[m/s, rad/s\].
    speeds: [f64; 2],
    charge_ratio: f64,
    floor: String,
    number: u64,
    now_ns: i64,
    state_timer: RateTimer,
    transform_timer: RateTimer,
}

pub(crate) fn build(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Option<Slotcar> {
    if context.text("steering") == "ackermann" {
        let origin = context.plugin.values.origin("steering");
        let message = "a slotcar with Ackermann steering is driven as one that turns in place";
        diagnostics.push(Diagnostic::warning("slotcar-steering", message).at(origin));
    }
    let node = context.node(diagnostics)?;
    let drive = MotionLimits {
        speed: context.number("nominal_drive_speed"),
        acceleration: context.number("nominal_drive_acceleration"),
        max_acceleration: context.number("max_drive_acceleration"),
    };
    let turn = MotionLimits {
        speed: context.number("nominal_turn_speed"),
        acceleration: context.number("nominal_turn_acceleration"),
        max_acceleration: context.number("max_turn_acceleration"),
    };
    let start_ns = context.setting.start_ns;
    Some(Slotcar {
        name: context.name(),
        model: context.setting.model,
        robot: context.setting.model_name.to_owned(),
        paths: context
            .accept(node.mailbox("/robot_path_requests", Qos::reliable(DEPTH)), diagnostics)?,
        pauses: context
            .accept(node.mailbox("/robot_pause_requests", Qos::reliable(DEPTH)), diagnostics)?,
        modes: context
            .accept(node.mailbox("/robot_mode_requests", Qos::reliable(DEPTH)), diagnostics)?,
        states: context
            .accept(node.publisher("/robot_state", Qos::reliable(DEPTH)), diagnostics)?,
        transforms: context.accept(node.publisher("/tf", TF_QOS), diagnostics)?,
        node,
        drive,
        turn,
        is_reversible: context.flag("reversible"),
        stop_distance_m: context.number("stop_distance"),
        stop_radius_m: context.number("stop_radius"),
        battery: Battery::read(context),
        floors: context.setting.floors.to_vec(),
        state: SlotcarState::new(start_ns),
    })
}

impl SlotcarState {
    fn new(start_ns: i64) -> Self {
        Self {
            follower: PathFollower::default(),
            mode: RobotMode::default(),
            task: String::new(),
            pause: resume(),
            has_error: false,
            is_stopped: false,
            speeds: [0.0; 2],
            charge_ratio: 1.0,
            floor: String::new(),
            number: 0,
            now_ns: start_ns,
            state_timer: RateTimer::for_publisher(STATE_RATE_HZ, start_ns),
            transform_timer: RateTimer::for_publisher(TRANSFORM_RATE_HZ, start_ns),
        }
    }

    fn is_paused_now(&self) -> bool {
        self.pause.r#type == PauseRequest::TYPE_PAUSE_IMMEDIATELY
    }

    /// True if the robot waits at the next point of its path.
    fn is_paused_at(&self, point: &Location) -> bool {
        self.pause.r#type == PauseRequest::TYPE_PAUSE_AT_CHECKPOINT
            && u64::from(self.pause.at_checkpoint) <= point.index
    }
}

fn resume() -> PauseRequest {
    PauseRequest { r#type: PauseRequest::TYPE_RESUME, ..PauseRequest::default() }
}

impl Slotcar {
    fn read_requests(&mut self, pose: Pose2) {
        for request in self.paths.drain() {
            if request.robot_name != self.robot || request.task_id == self.state.task {
                continue;
            }
            if request.path.is_empty() {
                self.node.log(Level::Warn, format!("the path `{}` has no points", request.task_id));
                continue;
            }
            self.state.task.clone_from(&request.task_id);
            let taken = self.state.follower.take(&request.path, pose);
            self.state.has_error = taken.is_err();
            if let Err(why) = taken {
                self.node.log(Level::Error, format!("path `{}` refused: {why}", request.task_id));
            }
        }
        for request in self.pauses.drain() {
            if request.robot_name == self.robot {
                self.state.pause = (*request).clone();
            }
        }
        for request in self.modes.drain() {
            if request.robot_name == self.robot {
                self.state.mode = request.mode.clone();
            }
        }
    }

    /// True if another model that can move is near a point ahead.
    fn sees_obstacle(&self, world: &PhysicsWorld, pose: Pose) -> bool {
        let yaw_rad = Pose2::from(pose).yaw_rad;
        let ahead = DVec3::new(libm::cos(yaw_rad), libm::sin(yaw_rad), 0.0) * self.stop_distance_m;
        let zone = pose.translation + ahead;
        let is_near = |model: ModelId| {
            let pose = world.model_pose(model);
            pose.is_some_and(|it| it.translation.distance(zone) < self.stop_radius_m)
        };
        // Parts of the building move, too, as in Open-RMF by their names.
        let is_part = |name: &str| {
            let name = name.to_ascii_lowercase();
            ["door", "lift", "dispensable"].iter().any(|part| name.contains(part))
        };
        world.models().any(|(model, name)| {
            model != self.model && is_near(model) && !is_part(name) && !world.is_static(model)
        })
    }

    fn floor_at(&self, height_m: f64) -> String {
        let near = |floor: &&BuildingFloor| (floor.elevation_m - height_m).abs() < FLOOR_RANGE_M;
        match self.floors.iter().find(near) {
            Some(floor) => floor.name.clone(),
            None if self.floors.is_empty() => ONLY_FLOOR.to_owned(),
            // Between two floors the last one counts.
            None => self.state.floor.clone(),
        }
    }

    fn message(&mut self, pose: Pose) -> RobotState {
        let now_ns = self.state.now_ns;
        self.state.floor = self.floor_at(pose.translation.z);
        self.state.number += 1;
        let flat = Pose2::from(pose);
        let state = &self.state;
        let mut mode = state.mode.clone();
        mode.mode_request_id = mode.mode_request_id.max(state.pause.mode_request_id);
        if state.has_error {
            mode.mode = RobotMode::MODE_ADAPTER_ERROR;
        }
        #[expect(clippy::cast_possible_truncation, reason = "the message has single precision")]
        RobotState {
            name: self.robot.clone(),
            model: String::new(),
            task_id: state.task.clone(),
            seq: state.number,
            mode,
            battery_percent: (100.0 * state.charge_ratio).ceil() as f32,
            location: Location {
                t: Time::of_ns(now_ns),
                x: flat.x_m as f32,
                y: flat.y_m as f32,
                yaw: flat.yaw_rad as f32,
                level_name: state.floor.clone(),
                ..Location::default()
            },
            path: state.follower.rest().to_vec(),
        }
    }

    fn is_standing(&self) -> bool {
        self.state.speeds.iter().all(|speed| speed.abs() < STANDING_SPEED_M_S)
    }

    /// Activity of the last step; modes that were requested stay.
    fn update_mode(&mut self, is_charging: bool) {
        let is_standing = self.is_standing();
        let is_requested = matches!(
            self.state.mode.mode,
            RobotMode::MODE_DOCKING | RobotMode::MODE_ACTION_COMPLETED | RobotMode::MODE_CLEANING
        );
        let is_paused = self.state.is_paused_now()
            || self.state.follower.rest().first().is_some_and(|next| self.state.is_paused_at(next));
        self.state.mode.mode = if is_charging {
            RobotMode::MODE_CHARGING
        } else if is_requested {
            return;
        } else if is_standing && is_paused {
            RobotMode::MODE_PAUSED
        } else if self.state.is_stopped {
            RobotMode::MODE_WAITING
        } else if is_standing {
            RobotMode::MODE_IDLE
        } else {
            RobotMode::MODE_MOVING
        };
    }
}

impl Device for Slotcar {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        let Some(pose) = world.model_pose(self.model) else { return };
        let flat = Pose2::from(pose);
        self.read_requests(flat);
        let step_s = span.seconds();
        let holds = {
            let state = &self.state;
            state.follower.rest().first().is_some_and(|next| state.is_paused_at(next))
        };
        let Step { distance_m, turn_rad, speed_limit_m_s } =
            self.state.follower.step(flat, self.is_reversible, holds);
        let is_blocked = distance_m != 0.0 && self.sees_obstacle(world, pose);
        self.state.is_stopped = is_blocked;
        let is_held = is_blocked || self.state.is_paused_now();
        let mut drive = self.drive;
        drive.speed = speed_limit_m_s.map_or(drive.speed, |limit| limit.min(drive.speed));
        let [speed, rate] = self.state.speeds;
        let distance_m = if is_held { 0.0 } else { distance_m };
        self.state.speeds = [
            drive.next_speed(distance_m, speed, step_s),
            self.turn.next_speed(turn_rad, rate, step_s),
        ];
        let [x_m_s, yaw_rad_s] = self.state.speeds;
        let twist = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
        if !world.follow(self.model, twist) {
            let (mut linear, angular) = planar_velocity(pose, twist);
            // Its weight keeps it on its floor, also in a lift.
            let link = world.links(self.model).next();
            let motion = link.and_then(|link| world.link_state(link));
            linear.z = motion.map_or(0.0, |motion| motion.linear_m_s.z);
            world.set_model_velocity(self.model, linear, angular);
        }
        let is_charging = self.is_standing() && self.battery.is_at_charger(pose.translation);
        let load = BatteryLoad::between([speed, rate], self.state.speeds, step_s);
        self.state.charge_ratio = if is_charging {
            self.battery.charged(self.state.charge_ratio, step_s)
        } else {
            self.battery.drained(self.state.charge_ratio, &load, step_s)
        };
        self.update_mode(is_charging);
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        self.state.now_ns = now_ns;
        let Some(pose) = moment.world.model_pose(self.model) else { return };
        if self.state.transform_timer.due(now_ns) && self.transforms.is_heard() {
            let child = format!("{}/base_link", self.robot);
            let transforms = vec![transform(now_ns, "world", &child, pose)];
            self.transforms.publish(TFMessage { transforms });
        }
        if self.state.state_timer.due(now_ns) {
            let message = self.message(pose);
            self.states.publish(message);
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let is_moving = self.state.speeds != [0.0; 2] || !self.state.follower.is_done();
        let moving = is_moving.then_some(self.state.now_ns + MOVING_STEP_NS);
        earlier(moving, self.state.state_timer.next_ns())
    }

    fn reset(&mut self, time_ns: i64) {
        drop((self.paths.drain(), self.pauses.drain(), self.modes.drain()));
        self.state = SlotcarState::new(time_ns);
    }

    fn save(&self) -> DeviceState {
        let waiting = [self.paths.pending(), self.pauses.pending(), self.modes.pending()];
        DeviceState::new((self.state.clone(), waiting))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, [paths, pauses, modes])) = saved.get::<(SlotcarState, [Vec<Sample>; 3])>()
        else {
            return false;
        };
        self.state = state.clone();
        self.paths.set_pending(paths);
        self.pauses.set_pending(pauses);
        self.modes.set_pending(modes);
        true
    }
}
