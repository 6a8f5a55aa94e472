//! Building of all sensors except lidars.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::GraphError;
use periplus_scene::{Sensor, SensorKind};

use super::port::{SensorPort, ports};
use super::{
    Mount, SensorContext, camera, contact, environment, imu, logical, navsat, radar, sonar,
};
use crate::Device;

/// Inputs for building a sensor's device.
pub(super) struct SensorBuildContext<'a, 'b> {
    pub(super) sensor_context: &'a SensorContext<'b>,
    pub(super) mount: Mount,
    /// Publishers of the sensor; never empty.
    pub(super) ports: Vec<SensorPort>,
}

/// Reason that a sensor cannot be built.
pub(super) struct SensorBuildError(Box<Diagnostic>);

/// A sensor's device, or the reason that it cannot be built.
pub(super) type DeviceResult = Result<Box<dyn Device>, SensorBuildError>;

impl From<Box<Diagnostic>> for SensorBuildError {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Self(diagnostic)
    }
}

impl From<GraphError> for SensorBuildError {
    fn from(error: GraphError) -> Self {
        Self(Box::new(Diagnostic::error("sensor-topic", error.to_string())))
    }
}

impl SensorBuildError {
    /// Unsupported type of sensor.
    pub(super) fn unsupported(sensor: &Sensor) -> Self {
        let Sensor { name, type_name, .. } = sensor;
        let message = format!("sensor `{name}` of type `{type_name}` is not supported");
        Self(Box::new(Diagnostic::warning("sensor-not-measured", message)))
    }
}

/// Builds the device of a sensor; reports a problem and returns `None` for one that cannot measure.
pub(super) fn build(
    sensor_context: &SensorContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    match build_by_kind(sensor_context, diagnostics) {
        Ok(device) => Some(device),
        Err(SensorBuildError(diagnostic)) => {
            let is_placed = diagnostic.span.is_some();
            diagnostics.push(if is_placed {
                *diagnostic
            } else {
                diagnostic.at(sensor_context.sensor.origin)
            });
            None
        }
    }
}

fn build_by_kind(
    sensor_context: &SensorContext<'_>,
    diagnostics: &mut Diagnostics,
) -> DeviceResult {
    let sensor = sensor_context.sensor;
    if matches!(sensor.kind, SensorKind::ForceTorque { .. } | SensorKind::Other) {
        return Err(SensorBuildError::unsupported(sensor));
    }
    let context = SensorBuildContext {
        sensor_context,
        mount: Mount::new(sensor_context),
        ports: ports(sensor_context, diagnostics)?,
    };
    match &sensor.kind {
        SensorKind::Imu(spec) => imu::device(context, spec),
        SensorKind::NavSat { .. } => navsat::device(context, diagnostics),
        SensorKind::Magnetometer(_)
        | SensorKind::Altimeter { .. }
        | SensorKind::AirPressure { .. } => environment::device(context),
        SensorKind::Contact { .. } => contact::device(context, diagnostics),
        SensorKind::Sonar { .. } => sonar::device(context),
        SensorKind::LogicalCamera { .. } => logical::device(context),
        SensorKind::Radar(spec) => radar::device(context, spec),
        SensorKind::Camera(spec) => camera::device(context, spec, diagnostics),
        SensorKind::Lidar(_) | SensorKind::ForceTorque { .. } | SensorKind::Other => {
            Err(SensorBuildError::unsupported(sensor))
        }
    }
}
