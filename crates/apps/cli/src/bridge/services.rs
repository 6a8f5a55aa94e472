//! Gazebo services offered in ROS 2, as `ros_gz_bridge` does.

use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Call, Calls, Node};
use periplus_gz_msgs::{AsRos, Boolean, Entity, EntityFactory, Message, Pose, WorldControl};
use periplus_gz_transport::Transport;
use periplus_msgs::Service;
use periplus_msgs::ros_gz_interfaces::{
    ControlWorld, ControlWorldResponse, DeleteEntity, DeleteEntityResponse, SetEntityPose,
    SetEntityPoseResponse, SpawnEntity, SpawnEntityResponse,
};

use super::spec::ServiceSpec;
use crate::terminal;

/// Timeout of a Gazebo service, the value of `ros_gz_bridge`.
const SERVICE_TIMEOUT: Duration = Duration::from_secs(5);

/// Bridged services.
pub(super) struct Services {
    node: Node,
    transport: Arc<Transport>,
    offers: Vec<Box<dyn Forward>>,
}

trait Forward {
    /// Forwards pending requests to Gazebo.
    fn serve(&self, transport: &Arc<Transport>);
}

/// Service type that exists in ROS 2 and in Gazebo; its Gazebo response is a Boolean.
trait BridgedService: Service {
    type Gazebo: Message;

    fn gazebo_request(request: &Self::Request) -> Option<Self::Gazebo>;
    fn ros_response(success: bool) -> Self::Response;
}

macro_rules! both {
    ($($service:ident, $gazebo:ident, $response:ident, |$asked:ident| $gazebo_request:expr;)*) => {$(
        impl BridgedService for $service {
            type Gazebo = $gazebo;

            fn gazebo_request($asked: &Self::Request) -> Option<$gazebo> {
                $gazebo_request
            }

            fn ros_response(success: bool) -> $response {
                $response { success }
            }
        }
    )*};
}

both! {
    ControlWorld, WorldControl, ControlWorldResponse, |asked| AsRos::from_ros(&asked.world_control);
    SpawnEntity, EntityFactory, SpawnEntityResponse, |asked| AsRos::from_ros(&asked.entity_factory);
    DeleteEntity, Entity, DeleteEntityResponse, |asked| AsRos::from_ros(&asked.entity);
    SetEntityPose, Pose, SetEntityPoseResponse, |asked| {
        let pose = <Pose as AsRos<periplus_msgs::geometry_msgs::Pose>>::from_ros(&asked.pose)?;
        let id = u32::try_from(asked.entity.id).unwrap_or_default();
        Some(Pose { name: asked.entity.name.clone(), id, ..pose })
    };
}

struct ForwardedService<S> {
    calls: Calls<S>,
    types: [String; 2],
    /// Service name in Gazebo.
    name: String,
}

impl<S: BridgedService> Forward for ForwardedService<S> {
    fn serve(&self, transport: &Arc<Transport>) {
        while let Some(call) = self.calls.take() {
            let (name, types) = (self.name.clone(), self.types.clone());
            let transport = transport.clone();
            // A thread per request, so that a slow response does not block other clients.
            std::thread::spawn(move || pass_on(call, &transport, &name, &types));
        }
    }
}

fn pass_on<S: BridgedService>(
    call: Call<S>,
    transport: &Transport,
    name: &str,
    types: &[String; 2],
) {
    let gazebo_request = S::gazebo_request(&call.request).unwrap_or_default().encode();
    let ros_response = transport.call(name, &types[0], &types[1], &gazebo_request, SERVICE_TIMEOUT);
    let success = match ros_response {
        Ok(bytes) => Boolean::decode(&bytes).is_ok_and(|ros_response| ros_response.data),
        Err(error) => {
            terminal::complain(&format!("the service `{name}` of Gazebo: {error}"));
            false
        }
    };
    call.answer(S::ros_response(success));
}

impl Services {
    pub(super) fn new(node: &Node, transport: &Arc<Transport>) -> Self {
        Self { node: node.clone(), transport: transport.clone(), offers: Vec::new() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.offers.is_empty()
    }

    /// # Errors
    /// A message when the type is not supported.
    pub(super) fn offer(&mut self, asked: &ServiceSpec) -> Result<(), String> {
        let known = self.one::<ControlWorld>(asked)?
            || self.one::<SpawnEntity>(asked)?
            || self.one::<DeleteEntity>(asked)?
            || self.one::<SetEntityPose>(asked)?;
        if known {
            return Ok(());
        }
        let all = [
            ControlWorld::TYPE_NAME,
            SpawnEntity::TYPE_NAME,
            DeleteEntity::TYPE_NAME,
            SetEntityPose::TYPE_NAME,
        ];
        Err(format!(
            "`{}`: {} is not a service type of both ROS 2 and Gazebo; supported: {}",
            asked.name,
            asked.ros_type,
            all.join(", ")
        ))
    }

    /// Offers the service if its type is `S`; returns true if it is.
    fn one<S: BridgedService>(&mut self, asked: &ServiceSpec) -> Result<bool, String> {
        if asked.ros_type != S::TYPE_NAME {
            return Ok(false);
        }
        let usual = [format!("gz.msgs.{}", S::Gazebo::NAME), "gz.msgs.Boolean".to_owned()];
        let calls = self.node.server::<S>(&asked.name).map_err(|error| error.to_string())?;
        let types = asked.gz_types.clone().unwrap_or(usual);
        self.offers.push(Box::new(ForwardedService { calls, types, name: asked.name.clone() }));
        Ok(true)
    }

    /// Forwards pending requests to Gazebo.
    pub(super) fn serve(&self) {
        for offer in &self.offers {
            offer.serve(&self.transport);
        }
    }
}
