//! Satellite receivers.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Publisher;
use periplus_msgs::geometry_msgs::Vector3Stamped;
use periplus_msgs::sensor_msgs::{NavSatFix, NavSatStatus};
use periplus_msgs::std_msgs::Header;
use periplus_scene::{SensorKind, SphericalCoordinates};
use periplus_sensors::{Globe, NavSat, NavSatNoise};

use super::imu::{diagonal, vector};
use super::port::Style;
use super::{Made, Mount, Order, Timer};
use crate::{Device, Moment};

struct NavSatDevice {
    mount: Mount,
    timer: Timer,
    sensor: NavSat,
    outs: Vec<Out>,
}

struct Out {
    frame: String,
    fix: Publisher<NavSatFix>,
    velocity: Option<Publisher<Vector3Stamped>>,
}

pub(super) fn device(order: Order<'_, '_>, diagnostics: &mut Diagnostics) -> Made {
    let SensorKind::NavSat {
        position_horizontal,
        position_vertical,
        velocity_horizontal,
        velocity_vertical,
    } = order.post.sensor.kind
    else {
        return Err(super::Failed::not_measured(order.post.sensor));
    };
    let noise = NavSatNoise {
        position_horizontal,
        position_vertical,
        velocity_horizontal,
        velocity_vertical,
    };
    let spherical = order.post.setting.scene.spherical_coordinates.clone().unwrap_or_else(|| {
        diagnostics.push(nowhere(&order));
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
    let globe = Globe::new(&spherical)?;
    let mut outs = Vec::new();
    for port in &order.ports {
        let velocity = match (port.style, port.out(1)) {
            (Style::Ros2, Some(topic)) => Some(port.publisher(topic)?),
            _ => None,
        };
        let fix = port.publisher(&port.topic(order.post, "/navsat"))?;
        outs.push(Out { frame: port.frame.clone(), fix, velocity });
    }
    Ok(Box::new(NavSatDevice {
        timer: Timer::new(order.post, &order.ports),
        sensor: NavSat::new(globe, &noise, order.mount.streams()),
        mount: order.mount,
        outs,
    }))
}

fn nowhere(order: &Order<'_, '_>) -> Diagnostic {
    let message = format!(
        "sensor `{}` measures where on Earth it is, but the world does not say where it lies",
        order.post.sensor.name
    );
    Diagnostic::warning("no-spherical-coordinates", message)
        .at(order.post.sensor.origin)
        .note("latitude 0, longitude 0, elevation 0 is taken")
        .help("add `<spherical_coordinates>` to the world")
}

impl Out {
    fn is_heard(&self) -> bool {
        self.fix.is_heard() || self.velocity.as_ref().is_some_and(Publisher::is_heard)
    }
}

impl Device for NavSatDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.timer.due(time_ns) else { return };
        if !self.outs.iter().any(Out::is_heard) {
            return;
        }
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let mut stream = self.mount.streams().tick(tick.number);
        let reading = self.sensor.measure(&motion, tick.dt_s, &mut stream);
        for out in &self.outs {
            out.fix.publish(NavSatFix {
                header: Header::at(time_ns, &out.frame),
                status: NavSatStatus {
                    status: NavSatStatus::STATUS_FIX,
                    service: NavSatStatus::SERVICE_GPS,
                },
                latitude: reading.place.latitude_rad.to_degrees(),
                longitude: reading.place.longitude_rad.to_degrees(),
                altitude: reading.place.altitude_m,
                position_covariance: diagonal(self.sensor.position_variances_m2()),
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
        let is_heard = self.outs.iter().any(Out::is_heard);
        self.timer.next_ns().filter(|_| is_heard)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
        self.sensor.reset();
    }
}
