//! A lift that moves between floors.

use periplus_geometry::Pose;
use periplus_msgs::rmf_lift_msgs::{LiftRequest, LiftState};
use periplus_physics::{JointCommand, PhysicsMode, PhysicsWorld};

use super::door::{Door, DoorMotion, DoorPosition, NamedJoint, settled};
use super::read::LiftSpec;

/// Lift with its joint.
pub(super) struct Lift {
    pub(super) spec: LiftSpec,
    joint: NamedJoint,
}

/// Command that a lift follows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LiftCommand {
    kind: u8,
    /// Index of the stop.
    destination: usize,
    session: String,
    opens_doors: bool,
}

/// Motion of a lift.
#[derive(Clone, Debug)]
pub(super) struct LiftMotion {
    command: LiftCommand,
    /// True until the command is complete; other requests are ignored meanwhile.
    is_busy: bool,
    /// Height of the cabin in the world \[m\].
    height_m: f64,
    /// Commanded speed \[m/s\].
    speed_m_s: f64,
}

impl Lift {
    pub(super) fn new(spec: LiftSpec) -> Self {
        let joint = NamedJoint::new(spec.cabin_joint.clone());
        Self { spec, joint }
    }

    /// Motion at the start: to the first floor, with closed doors, if no request comes before.
    pub(super) fn first_motion(&self) -> LiftMotion {
        let command = LiftCommand {
            kind: LiftRequest::REQUEST_AGV_MODE,
            destination: self.spec.first,
            session: String::new(),
            opens_doors: false,
        };
        LiftMotion { command, is_busy: false, height_m: self.spec.base_m, speed_m_s: 0.0 }
    }

    /// Takes a request.
    ///
    /// # Errors
    /// Why it is ignored.
    pub(super) fn request(
        &self,
        motion: &mut LiftMotion,
        request: &LiftRequest,
    ) -> Result<(), String> {
        let name = &self.spec.name;
        let floor = &request.destination_floor;
        let stop = self.spec.stops.iter().position(|stop| stop.floor.name == *floor);
        let Some(destination) = stop else {
            let known: Vec<&str> =
                self.spec.stops.iter().map(|it| it.floor.name.as_str()).collect();
            return Err(format!(
                "the lift `{name}` has no floor `{floor}`; it has {}",
                known.join(", ")
            ));
        };
        let is_end = request.request_type == LiftRequest::REQUEST_END_SESSION;
        let command = LiftCommand {
            kind: request.request_type,
            destination,
            session: if is_end { String::new() } else { request.session_id.clone() },
            opens_doors: request.door_state == LiftRequest::DOOR_OPEN,
        };
        if command == motion.command {
            return Ok(());
        }
        if motion.is_busy {
            let now = &self.spec.stops[motion.command.destination].floor.name;
            let who = &motion.command.session;
            return Err(format!(
                "the lift `{name}` is busy with the request of `{who}` to `{now}`"
            ));
        }
        motion.command = command;
        motion.is_busy = true;
        Ok(())
    }

    /// Index of the nearest stop.
    fn nearest(&self, motion: &LiftMotion) -> usize {
        let distance =
            |stop: usize| (self.spec.stops[stop].floor.elevation_m - motion.height_m).abs();
        (0..self.spec.stops.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(0)
    }

    /// Distance to the destination \[m\].
    fn rest_m(&self, motion: &LiftMotion) -> f64 {
        self.spec.stops[motion.command.destination].floor.elevation_m - motion.height_m
    }

    /// Commands cabin and doors for a step: the cabin moves only while the doors of its floor are closed.
    pub(super) fn act(
        &mut self,
        motion: &mut LiftMotion,
        doors: (&[Door], &mut [DoorMotion]),
        world: &mut PhysicsWorld,
        step_s: f64,
    ) {
        let (doors, door_motions) = doors;
        let Some((joint, state)) = self.joint.state(world) else { return };
        motion.height_m = self.spec.base_m + state.position;
        let rest_m = self.rest_m(motion);
        let is_there = rest_m.abs() < self.spec.tolerance;
        let stop = &self.spec.stops[self.nearest(motion)];
        let opens = is_there && motion.command.opens_doors;
        for door in &stop.doors {
            door_motions[*door].opens = opens;
        }
        let are_doors_done = stop.doors.iter().all(|door| door_motions[*door].is_done());
        if is_there && are_doors_done {
            motion.is_busy = false;
        }
        let distance_m = settled(rest_m, self.spec.tolerance);
        let distance_m = if is_there || are_doors_done { distance_m } else { 0.0 };
        motion.speed_m_s = self.spec.limits.next_speed(distance_m, motion.speed_m_s, step_s);
        let target = motion.speed_m_s;
        world.command(joint, JointCommand::Velocity { target, max_effort: f64::INFINITY });
        if world.mode() == PhysicsMode::Kinematic && target != 0.0 {
            self.carry(doors, world, target * step_s);
        }
    }

    /// Moves the models in the cabin, in a world without contacts.
    fn carry(&self, doors: &[Door], world: &mut PhysicsWorld, rise_m: f64) {
        let lift = world.find_model(self.joint.model());
        let Some((lift, cabin)) = lift.zip(self.spec.cabin) else { return };
        let Some(world_from_lift) = world.model_pose(lift) else { return };
        let is_part = |name: &str| {
            name == self.joint.model() || doors.iter().any(|door| door.model() == name)
        };
        let others: Vec<_> =
            world.models().filter(|(_, name)| !is_part(name)).map(|(model, _)| model).collect();
        for model in others {
            let Some(pose) = world.model_pose(model) else { continue };
            if cabin.contains(world_from_lift, pose.translation) {
                let rise = Pose::from_xyz(0.0, 0.0, rise_m);
                world.set_pose(model, rise * pose);
            }
        }
    }

    /// State without its time.
    pub(super) fn state(&self, motion: &LiftMotion, doors: &[DoorMotion]) -> LiftState {
        let stop = &self.spec.stops[self.nearest(motion)];
        let positions = || stop.doors.iter().map(|door| doors[*door].position);
        let all = |position| positions().all(|it| it == position);
        let door_state = if all(DoorPosition::Closed) {
            LiftState::DOOR_CLOSED
        } else if all(DoorPosition::Open) {
            LiftState::DOOR_OPEN
        } else {
            LiftState::DOOR_MOVING
        };
        let rest_m = self.rest_m(motion);
        let motion_state = if rest_m.abs() < self.spec.tolerance {
            LiftState::MOTION_STOPPED
        } else if rest_m > 0.0 {
            LiftState::MOTION_UP
        } else {
            LiftState::MOTION_DOWN
        };
        LiftState {
            lift_name: self.spec.name.clone(),
            available_floors: self.spec.stops.iter().map(|it| it.floor.name.clone()).collect(),
            current_floor: stop.floor.name.clone(),
            destination_floor: self.spec.stops[motion.command.destination].floor.name.clone(),
            door_state,
            motion_state,
            available_modes: vec![LiftState::MODE_AGV],
            current_mode: LiftState::MODE_AGV,
            session_id: motion.command.session.clone(),
            ..LiftState::default()
        }
    }

    /// True while cabin or doors have something to do.
    pub(super) fn is_moving(&self, motion: &LiftMotion) -> bool {
        motion.is_busy || motion.speed_m_s != 0.0
    }
}
