//! Publishers of joint states and inertial sensors.

use periplus_graph::{Publisher, Qos};
use periplus_msgs::control_msgs::{DynamicJointState, InterfaceValue};
use periplus_msgs::geometry_msgs::{Quaternion, Vector3};
use periplus_msgs::sensor_msgs::{Imu, JointState};
use periplus_msgs::std_msgs::Header;
use periplus_ros2_control::{
    ControlCycle, ControllerError, ControllerInterface, ImuBroadcaster, ImuBroadcasterParams,
    ImuInterfaceValues, InterfaceSelection, JointStateBroadcaster, JointStateBroadcasterParams,
    LoanedInterfaces,
};

use crate::DeviceState;
use crate::control::factory::KnownJoints;
use crate::control::ros_controller::{ControllerNode, RosController};
use crate::drives::RateTimer;

/// `joint_state_broadcaster`, and `joint_state_controller` of ROS 1.
pub(super) struct JointStateNode {
    part: ControllerNode,
    known: Vec<String>,
    running: Option<RunningStates>,
}

struct RunningStates {
    broadcaster: JointStateBroadcaster,
    timer: RateTimer,
    frame: String,
    states: Publisher<JointState>,
    dynamic: Option<Publisher<DynamicJointState>>,
}

impl JointStateNode {
    pub(super) fn new(part: ControllerNode, joints: &KnownJoints) -> Self {
        Self { part, known: joints.keys().cloned().collect(), running: None }
    }

    /// Rate of the messages [Hz]; zero for each update.
    fn rate_hz(&self, params: &JointStateBroadcasterParams) -> f64 {
        if self.part.release.is_ros1() { params.publish_rate_hz } else { 0.0 }
    }

    fn open(&self) -> Result<RunningStates, String> {
        let params = JointStateBroadcasterParams::from_values(&self.part.values());
        let is_ros1 = self.part.release.is_ros1();
        let node = &self.part.node;
        let local = params.use_local_topics;
        let topic = if local { "~/joint_states" } else { "joint_states" };
        let states = node.publisher(topic, Qos::reliable(10));
        let topic = if local { "~/dynamic_joint_states" } else { "dynamic_joint_states" };
        let dynamic = (params.publish_dynamic_joint_states && !is_ros1)
            .then(|| node.publisher(topic, Qos::reliable(10)));
        let timer = RateTimer::for_controller(self.rate_hz(&params), node.now_ns());
        let frame = if is_ros1 { String::new() } else { params.frame_id };
        let broadcaster = JointStateBroadcaster {
            joints: params.joints,
            interfaces: params.interfaces,
            extra_joints: params.extra_joints,
            known_joints: params.use_urdf_to_filter.then(|| self.known.clone()),
            mapped_names: [params.map_position, params.map_velocity, params.map_effort],
            ..JointStateBroadcaster::default()
        };
        Ok(RunningStates {
            broadcaster,
            timer,
            frame,
            states: states.map_err(|error| error.to_string())?,
            dynamic: dynamic.transpose().map_err(|error| error.to_string())?,
        })
    }
}

impl RunningStates {
    fn publish(&self, time_ns: i64) {
        let reading = &self.broadcaster.reading;
        if self.states.is_heard() {
            let mut message =
                JointState { header: Header::at(time_ns, &self.frame), ..JointState::default() };
            for (name, [position, velocity, effort]) in &reading.joints {
                message.name.push(name.clone());
                message.position.push(*position);
                message.velocity.push(*velocity);
                message.effort.push(*effort);
            }
            self.states.publish(message);
        }
        if let Some(dynamic) = self.dynamic.as_ref().filter(|dynamic| dynamic.is_heard()) {
            let mut message = DynamicJointState {
                header: Header::at(time_ns, &self.frame),
                ..DynamicJointState::default()
            };
            for (name, interfaces) in &reading.interfaces {
                let (interface_names, values) = interfaces.iter().cloned().unzip();
                message.joint_names.push(name.clone());
                message.interface_values.push(InterfaceValue { interface_names, values });
            }
            dynamic.publish(message);
        }
    }
}

impl ControllerInterface for JointStateNode {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.broadcaster.state_interfaces()).unwrap_or_default()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.running = None;
        self.running = Some(self.open()?);
        Ok(())
    }

    fn activate(
        &mut self,
        _: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        if let Some(running) = &mut self.running {
            running.timer.restart(cycle.time_ns);
        }
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(running) = &mut self.running else { return Ok(()) };
        let is_heard =
            running.states.is_heard() || running.dynamic.as_ref().is_some_and(Publisher::is_heard);
        if running.timer.due(cycle.time_ns) && is_heard {
            running.broadcaster.update(interfaces, cycle)?;
            running.publish(cycle.time_ns);
        }
        Ok(())
    }
}

impl RosController for JointStateNode {
    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.running.as_ref().map(|running| running.timer.clone()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<Option<RateTimer>>() else { return false };
        if let (Some(running), Some(timer)) = (&mut self.running, saved) {
            running.timer.clone_from(timer);
        }
        true
    }
}

/// `imu_sensor_broadcaster`.
pub(super) struct ImuNode {
    part: ControllerNode,
    running: Option<RunningImu>,
}

struct RunningImu {
    broadcaster: ImuBroadcaster,
    publisher: Publisher<Imu>,
    params: ImuBroadcasterParams,
}

impl ImuNode {
    pub(super) fn new(part: ControllerNode) -> Self {
        Self { part, running: None }
    }
}

impl ControllerInterface for ImuNode {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.broadcaster.state_interfaces()).unwrap_or_default()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.running = None;
        let params = ImuBroadcasterParams::from_values(&self.part.values());
        if params.frame_id.is_empty() {
            return Err("`frame_id` is empty".into());
        }
        let mut broadcaster =
            ImuBroadcaster { sensor_name: params.sensor_name.clone(), ..ImuBroadcaster::default() };
        broadcaster.configure()?;
        let publisher = self.part.node.publisher("~/imu", Qos::reliable(10));
        let publisher = publisher.map_err(|error| error.to_string())?;
        self.running = Some(RunningImu { broadcaster, publisher, params });
        Ok(())
    }

    fn activate(
        &mut self,
        _: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(running) = &mut self.running else { return Ok(()) };
        if !running.publisher.is_heard() {
            return Ok(());
        }
        running.broadcaster.update(interfaces, cycle)?;
        let ImuInterfaceValues { orientation: [x, y, z, w], angular_rad_s, linear_m_s2 } =
            running.broadcaster.reading;
        let vector = |[x, y, z]: [f64; 3]| Vector3 { x, y, z };
        let covariance = |values: &[f64]| {
            std::array::from_fn(|index| values.get(index).copied().unwrap_or_default())
        };
        let params = &running.params;
        running.publisher.publish(Imu {
            header: Header::at(cycle.time_ns, &params.frame_id),
            orientation: Quaternion { x, y, z, w },
            orientation_covariance: covariance(&params.static_covariance_orientation),
            angular_velocity: vector(angular_rad_s),
            angular_velocity_covariance: covariance(&params.static_covariance_angular_velocity),
            linear_acceleration: vector(linear_m_s2),
            linear_acceleration_covariance: covariance(
                &params.static_covariance_linear_acceleration,
            ),
        });
        Ok(())
    }
}

impl RosController for ImuNode {
    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.get::<()>().is_some()
    }
}
