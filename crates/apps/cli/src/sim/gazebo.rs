//! Simulation on the Gazebo Transport network.

use std::io;
use std::sync::Arc;

use clap::ValueEnum;
use periplus_diagnostics::SourceMap;
use periplus_gz_msgs::Dialect;
use periplus_gz_transport::{
    DiscoveryReach, GzBridge, GzPublisher, GzService, GzTransportError, Settings, Transport,
};
use periplus_os::Machine;
use periplus_sim::{GazeboPublisher, Services, Simulation, gazebo_topic};

use crate::error::CliError;
use crate::terminal;

/// Topics for ROS programs only.
const ROS_ONLY_TOPICS: [&str; 3] = ["/rosout", "/parameter_events", "/robot_description"];

/// Visibility of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GzReach {
    /// Gazebo programs on this machine
    Loopback,
    /// Gazebo programs in the range of multicast
    Network,
}

/// Prefix of message types.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GzTypes {
    /// `gz.msgs.LaserScan`: Garden, Harmonic and later
    Gz,
    /// `ignition.msgs.LaserScan`: Fortress and before, and Debian
    Ignition,
}

/// Connection of a run to Gazebo programs.
pub(crate) struct Gazebo {
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

impl Gazebo {
    /// Connects if requested; `None` if not.
    pub(crate) fn join(
        simulation: &Simulation,
        services: &mut Services,
        asked: Option<GzReach>,
        types: GzTypes,
        quiet: bool,
    ) -> Result<Option<Self>, CliError> {
        let Some(reach) = asked else { return Ok(None) };
        let (mut settings, findings) = Settings::from_environment(&Machine);
        terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
        settings.reach = match reach {
            GzReach::Loopback => DiscoveryReach::Machine,
            GzReach::Network => DiscoveryReach::Network,
        };
        settings.dialect = match types {
            GzTypes::Gz => Dialect::Gz,
            GzTypes::Ignition => Dialect::Ignition,
        };
        let joined = Self::open(simulation, services, &settings).map_err(CliError::failed)?;
        if !quiet {
            let on = match reach {
                GzReach::Loopback => "this machine only",
                GzReach::Network => "on the network",
            };
            terminal::say(&format!("Gazebo: partition {}, {on}", settings.partition));
        }
        Ok(Some(joined))
    }

    fn open(
        simulation: &Simulation,
        services: &mut Services,
        settings: &Settings,
    ) -> Result<Self, GzTransportError> {
        let transport = Arc::new(Transport::open(settings)?);
        let desk = services.open_to_gazebo(simulation);
        let full = |bare: &str| settings.dialect.full_name(bare);
        let mut servers = Vec::new();
        for (place, service) in desk.services().iter().enumerate() {
            let types = [full(service.request), full(service.response)];
            let desk = desk.clone();
            let asking = move |call: periplus_gz_transport::ServiceRequest| {
                let answer = call.answer;
                let answer = Box::new(move |bytes: Option<Vec<u8>>| answer.send(bytes.as_deref()));
                desk.ask(place, call.request, answer);
            };
            servers.push(transport.serve(&service.name, &types[0], &types[1], asking)?);
        }
        let topics = desk.topics().iter();
        let publishers: Result<_, _> =
            topics.map(|topic| transport.advertise(&topic.name, &full(topic.of))).collect();
        desk.set_outlet(Box::new(Outlet(publishers?)));
        let link = GzBridge::new(simulation.graph(), &transport);
        let name = gazebo_topic(simulation);
        link.offer_all(
            move |topic| if ROS_ONLY_TOPICS.contains(&topic) { None } else { name(topic) },
        )?;
        Ok(Self { link, _servers: servers })
    }

    /// Prints network problems.
    pub(crate) fn tell(&self) -> io::Result<()> {
        let findings = self.link.take_findings();
        terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())
    }
}
