//! Pictures of what sensors publish.

use periplus_graph::{Mailbox, NodeSettings, Qos};
use periplus_msgs::Message;
use periplus_msgs::sensor_msgs::{Image, LaserScan};
use periplus_session::pictures;
use periplus_sim::Simulation;

use super::run_until;
use crate::error::CliError;

/// Simulated time to wait for a message \[s\].
const PATIENCE_S: f64 = 10.0;

/// Picture of a message.
pub(super) struct MessagePicture {
    pub(super) png: Vec<u8>,
    /// ROS type of the message.
    pub(super) type_name: &'static str,
    /// Simulated time when it was received \[s\].
    pub(super) time_s: f64,
}

/// Returns the picture of the first message on a topic at a time \[s\] or later.
pub(super) fn next(
    simulation: &mut Simulation,
    topic: &str,
    time_s: f64,
) -> Result<MessagePicture, CliError> {
    let topics = simulation.graph().topics();
    let drawable = [Image::TYPE_NAME, LaserScan::TYPE_NAME];
    let type_name = topics.iter().find(|known| known.name == topic).map(|known| &known.type_name);
    let type_name = type_name.and_then(|name| drawable.iter().find(|known| *known == name));
    let Some(type_name) = type_name else {
        let names = topics.iter().filter(|known| drawable.contains(&known.type_name.as_str()));
        let names: Vec<&str> = names.map(|known| known.name.as_str()).collect();
        return Err(CliError::usage(if names.is_empty() {
            format!("no image or scan on `{topic}`: no robot here has a camera or a lidar")
        } else {
            format!("no image or scan on `{topic}`; there are {}", names.join(", "))
        }));
    };
    run_until(simulation, time_s)?;
    if *type_name == Image::TYPE_NAME {
        let (image, time_s) = received::<Image>(simulation, topic)?;
        let png = pictures::of_image(&image).map_err(|reason| {
            CliError::failed(format!("cannot draw the image on `{topic}`: {reason}"))
        })?;
        Ok(MessagePicture { png, type_name, time_s })
    } else {
        let (scan, time_s) = received::<LaserScan>(simulation, topic)?;
        Ok(MessagePicture { png: pictures::of_scan(&scan), type_name, time_s })
    }
}

/// Runs until a message arrives.
fn received<M: Message>(
    simulation: &mut Simulation,
    topic: &str,
) -> Result<(std::sync::Arc<M>, f64), CliError> {
    let node = simulation.graph().node(NodeSettings::new("look")).map_err(CliError::failed)?;
    let messages: Mailbox<M> = node.mailbox(topic, Qos::sensor_data()).map_err(CliError::failed)?;
    let end_ns = simulation.time_ns() + (PATIENCE_S * 1e9) as i64;
    while simulation.time_ns() < end_ns {
        simulation.step().map_err(CliError::failed)?;
        if let Some(message) = messages.latest() {
            return Ok((message, simulation.time_ns() as f64 * 1e-9));
        }
    }
    Err(CliError::failed(format!("nothing was published on `{topic}` in {PATIENCE_S} s")))
}
