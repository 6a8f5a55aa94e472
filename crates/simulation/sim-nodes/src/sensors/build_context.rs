//! Devices of all sensors but lidars.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::GraphError;
use periplus_scene::{Sensor, SensorKind};

use super::port::{Port, ports};
use super::{Mount, Post, camera, contact, imu, logical, navsat, scalar, sonar};
use crate::Device;

/// What a sensor's device is made from.
pub(super) struct Order<'a, 'b> {
    pub(super) post: &'a Post<'b>,
    pub(super) mount: Mount,
    /// Through what it publishes; never empty.
    pub(super) ports: Vec<Port>,
}

/// Why a sensor is not there.
pub(super) struct Failed(Box<Diagnostic>);

/// A sensor as a device, or why not.
pub(super) type Made = Result<Box<dyn Device>, Failed>;

impl From<Box<Diagnostic>> for Failed {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Self(diagnostic)
    }
}

impl From<GraphError> for Failed {
    fn from(error: GraphError) -> Self {
        Self(Box::new(Diagnostic::error("sensor-topic", error.to_string())))
    }
}

impl Failed {
    /// A kind that nobody here measures.
    pub(super) fn not_measured(sensor: &Sensor) -> Self {
        let Sensor { name, type_name, .. } = sensor;
        let told = format!("sensor `{name}` of type `{type_name}` is not measured");
        Self(Box::new(Diagnostic::warning("sensor-not-measured", told)))
    }
}

/// The device of a sensor; none, with a finding, for one that cannot measure.
pub(super) fn build(post: &Post<'_>, diagnostics: &mut Diagnostics) -> Option<Box<dyn Device>> {
    match made(post, diagnostics) {
        Ok(device) => Some(device),
        Err(Failed(diagnostic)) => {
            let is_placed = diagnostic.span.is_some();
            diagnostics.push(if is_placed {
                *diagnostic
            } else {
                diagnostic.at(post.sensor.origin)
            });
            None
        }
    }
}

fn made(post: &Post<'_>, diagnostics: &mut Diagnostics) -> Made {
    let sensor = post.sensor;
    if matches!(sensor.kind, SensorKind::ForceTorque { .. } | SensorKind::Other) {
        return Err(Failed::not_measured(sensor));
    }
    let order = Order { post, mount: Mount::new(post), ports: ports(post, diagnostics)? };
    match &sensor.kind {
        SensorKind::Imu(spec) => imu::device(order, spec),
        SensorKind::NavSat { .. } => navsat::device(order, diagnostics),
        SensorKind::Magnetometer(_)
        | SensorKind::Altimeter { .. }
        | SensorKind::AirPressure { .. } => scalar::device(order),
        SensorKind::Contact { .. } => contact::device(order, diagnostics),
        SensorKind::Sonar { .. } => sonar::device(order),
        SensorKind::LogicalCamera { .. } => logical::device(order),
        SensorKind::Camera(spec) => camera::device(order, spec, diagnostics),
        SensorKind::Lidar(_) | SensorKind::ForceTorque { .. } | SensorKind::Other => {
            Err(Failed::not_measured(sensor))
        }
    }
}
