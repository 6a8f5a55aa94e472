//! Simulation on the Gazebo Transport network.

use std::io;
use std::sync::Arc;

use periplus_gz_msgs::Dialect;
use periplus_gz_transport::{
    DiscoveryReach, GzBridge, GzPublisher, GzService, GzTransportError, Settings, Transport,
};
use periplus_os::Machine;
use periplus_sim::{GazeboPublisher, Services, Simulation, gazebo_topic};

use crate::error::RunError;
use crate::terminal;

/// Topics for ROS programs only.
const ROS_ONLY_TOPICS: [&str; 3] = ["/rosout", "/parameter_events", "/robot_description"];

/// Visibility of a session on Gazebo Transport.
#[derive(Clone, Copy, Debug)]
pub struct GazeboSettings {
    /// Programs that can connect.
    pub reach: DiscoveryReach,
    /// Names of the message types.
    pub dialect: Dialect,
}

/// Connection of a run to Gazebo programs.
pub(crate) struct GazeboConnection {
    // Declared first, so that the graph is left before the network is dropped.
    link: GzBridge,
    _servers: Vec<GzService>,
}

/// Publishers of world state and statistics.
struct Outlet(Vec<GzPublisher>);

impl GazeboPublisher for Outlet {
    fn is_heard(&self, topic: usize) -> bool {
        self.0.get(topic).is_some_and(GzPublisher::is_heard)
    }

    fn put(&self, topic: usize, message: Vec<u8>) {
        if let Some(publisher) = self.0.get(topic) {
            publisher.publish(message);
        }
    }
}

impl GazeboConnection {
    /// Connects.
    pub(crate) fn join(
        simulation: &Simulation,
        services: &mut Services,
        asked: GazeboSettings,
        is_quiet: bool,
    ) -> Result<Self, RunError> {
        let (mut settings, findings) = Settings::from_environment(&Machine);
        terminal::print_findings(&findings)?;
        (settings.reach, settings.dialect) = (asked.reach, asked.dialect);
        let joined = Self::open(simulation, services, &settings)?;
        if !is_quiet {
            let on = match settings.reach {
                DiscoveryReach::Machine => "this machine only",
                DiscoveryReach::Network => "on the network",
            };
            terminal::say(&format!("Gazebo: partition {}, {on}", settings.partition));
        }
        Ok(joined)
    }

    fn open(
        simulation: &Simulation,
        services: &mut Services,
        settings: &Settings,
    ) -> Result<Self, GzTransportError> {
        let transport = Arc::new(Transport::open(settings)?);
        let requests = services.open_to_gazebo(simulation);
        let full = |bare: &str| settings.dialect.full_name(bare);
        let mut servers = Vec::new();
        for (place, service) in requests.services().iter().enumerate() {
            let types = [full(service.request), full(service.response)];
            let requests = requests.clone();
            let asking = move |call: periplus_gz_transport::ServiceRequest| {
                let answer = call.answer;
                let answer = Box::new(move |bytes: Option<Vec<u8>>| answer.send(bytes.as_deref()));
                requests.ask(place, call.request, answer);
            };
            servers.push(transport.serve(&service.name, &types[0], &types[1], asking)?);
        }
        let topics = requests.topics().iter();
        let publishers: Result<_, _> =
            topics.map(|topic| transport.advertise(&topic.name, &full(topic.of))).collect();
        requests.set_outlet(Box::new(Outlet(publishers?)));
        let link = GzBridge::new(simulation.graph(), &transport);
        let name = gazebo_topic(simulation);
        link.offer_all(
            move |topic| if ROS_ONLY_TOPICS.contains(&topic) { None } else { name(topic) },
        )?;
        Ok(Self { link, _servers: servers })
    }

    /// Prints network problems.
    pub(crate) fn print_findings(&self) -> io::Result<()> {
        terminal::print_findings(&self.link.take_findings())
    }
}
