//! Satellite receivers.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Publisher;
use periplus_msgs::geometry_msgs::Vector3Stamped;
use periplus_msgs::sensor_msgs::{NavSatFix, NavSatStatus};
use periplus_msgs::std_msgs::Header;
use periplus_scene::{SensorKind, SphericalCoordinates};
use periplus_sensors::{LocalTangentFrame, NavSat, NavSatNoise};

use super::imu::{diagonal, vector};
use super::port::Convention;
use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct NavSatDevice {
    mount: Mount,
    state: NavSatState,
    outputs: Vec<NavSatOutput>,
}

#[derive(Clone)]
struct NavSatState {
    timer: Timer,
    sensor: NavSat,
}

struct NavSatOutput {
    frame: String,
    fix: Publisher<NavSatFix>,
    velocity: Option<Publisher<Vector3Stamped>>,
}

pub(super) fn device(
    context: SensorBuildContext<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> DeviceResult {
    let SensorKind::NavSat {
        position_horizontal,
        position_vertical,
        velocity_horizontal,
        velocity_vertical,
    } = context.sensor_context.sensor.kind
    else {
        return Err(super::SensorBuildError::unsupported(context.sensor_context.sensor));
    };
    let noise = NavSatNoise {
        position_horizontal,
        position_vertical,
        velocity_horizontal,
        velocity_vertical,
    };
    let spherical =
        context.sensor_context.setting.scene.spherical_coordinates.clone().unwrap_or_else(|| {
            diagnostics.push(missing_coordinates(&context));
            SphericalCoordinates {
                surface_model: "EARTH_WGS84".into(),
                frame_orientation: "ENU".into(),
                latitude_rad: 0.0,
                longitude_rad: 0.0,
                elevation_m: 0.0,
                heading_rad: 0.0,
                extra: Vec::new(),
            }
        });
    let frame = LocalTangentFrame::new(&spherical)?;
    let mut outputs = Vec::new();
    for port in &context.ports {
        let velocity = match (port.convention, port.out(1)) {
            (Convention::Ros2, Some(topic)) => Some(port.publisher(topic)?),
            _ => None,
        };
        let fix = port.publisher(&port.topic(context.sensor_context, "/navsat"))?;
        outputs.push(NavSatOutput { frame: port.frame.clone(), fix, velocity });
    }
    Ok(Box::new(NavSatDevice {
        state: NavSatState {
            timer: Timer::new(context.sensor_context, &context.ports),
            sensor: NavSat::new(frame, &noise, context.mount.streams()),
        },
        mount: context.mount,
        outputs,
    }))
}

fn missing_coordinates(context: &SensorBuildContext<'_, '_>) -> Diagnostic {
    let message = format!(
        "sensor `{}` measures geodetic coordinates, but the world does not define where its origin is",
        context.sensor_context.sensor.name
    );
    Diagnostic::warning("no-spherical-coordinates", message)
        .at(context.sensor_context.sensor.origin)
        .note("latitude 0, longitude 0, elevation 0 are used")
        .help("add `<spherical_coordinates>` to the world")
}

impl NavSatOutput {
    fn has_subscribers(&self) -> bool {
        self.fix.is_heard() || self.velocity.as_ref().is_some_and(Publisher::is_heard)
    }
}

impl Device for NavSatDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.state.timer.due(time_ns) else { return };
        if !self.outputs.iter().any(NavSatOutput::has_subscribers) {
            return;
        }
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let mut stream = self.mount.streams().tick(tick.number);
        let reading = self.state.sensor.measure(&motion, tick.dt_s, &mut stream);
        for out in &self.outputs {
            out.fix.publish(NavSatFix {
                header: Header::at(time_ns, &out.frame),
                status: NavSatStatus {
                    status: NavSatStatus::STATUS_FIX,
                    service: NavSatStatus::SERVICE_GPS,
                },
                latitude: reading.position.latitude_rad.to_degrees(),
                longitude: reading.position.longitude_rad.to_degrees(),
                altitude: reading.position.altitude_m,
                position_covariance: diagonal(self.state.sensor.position_variances_m2()),
                position_covariance_type: NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN,
            });
            if let Some(velocity) = &out.velocity {
                velocity.publish(Vector3Stamped {
                    header: Header::at(time_ns, &out.frame),
                    vector: vector(reading.velocity_m_s),
                });
            }
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let has_subscribers = self.outputs.iter().any(NavSatOutput::has_subscribers);
        self.state.timer.next_ns().filter(|_| has_subscribers)
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.reset(time_ns);
        self.state.sensor.reset();
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.state.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.state)
    }
}
