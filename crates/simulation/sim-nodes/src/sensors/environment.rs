//! Magnetometers, altimeters, barometers.

use periplus_geometry::{DVec3, Stream};
use periplus_graph::Publisher;
use periplus_msgs::ros_gz_interfaces;
use periplus_msgs::sensor_msgs::{FluidPressure, MagneticField};
use periplus_msgs::std_msgs::Header;
use periplus_scene::SensorKind;
use periplus_sensors::{Altimeter, Barometer, Magnetometer, Motion};

use super::imu::{diagonal, vector};
use super::timer::Tick;
use super::{Made, Mount, Order, Timer};
use crate::{Device, Moment};

struct FieldDevice {
    mount: Mount,
    timer: Timer,
    world_field_t: DVec3,
    outs: Vec<(String, Kind)>,
}

/// What is measured, each with its publisher.
enum Kind {
    Magnetic(Magnetometer, Publisher<MagneticField>),
    Height(Altimeter, Publisher<ros_gz_interfaces::Altimeter>),
    Pressure(Barometer, Publisher<FluidPressure>),
}

pub(super) fn device(order: Order<'_, '_>) -> Made {
    let streams = order.mount.streams();
    let mut outs = Vec::new();
    for port in &order.ports {
        let kind = match &order.post.sensor.kind {
            SensorKind::Magnetometer(noise) => Kind::Magnetic(
                Magnetometer::new(noise, streams),
                port.publisher(&port.topic(order.post, "/magnetometer"))?,
            ),
            SensorKind::Altimeter { vertical_position, vertical_velocity } => Kind::Height(
                Altimeter::new(vertical_position, vertical_velocity, streams),
                port.publisher(&port.topic(order.post, "/altimeter"))?,
            ),
            SensorKind::AirPressure { reference_altitude_m, pressure } => Kind::Pressure(
                Barometer::new(*reference_altitude_m, pressure, streams),
                port.publisher(&port.topic(order.post, "/air_pressure"))?,
            ),
            _ => return Err(super::Failed::not_measured(order.post.sensor)),
        };
        outs.push((port.frame.clone(), kind));
    }
    Ok(Box::new(FieldDevice {
        timer: Timer::new(order.post, &order.ports),
        world_field_t: order.post.setting.scene.magnetic_field_t,
        mount: order.mount,
        outs,
    }))
}

impl Kind {
    fn publish(
        &mut self,
        header: periplus_msgs::std_msgs::Header,
        world_field_t: DVec3,
        motion: &Motion,
        tick: Tick,
        stream: &mut Stream,
    ) {
        match self {
            Self::Magnetic(sensor, out) if out.is_heard() => {
                let field = sensor.measure(motion, world_field_t, tick.dt_s, stream);
                out.publish(MagneticField {
                    header,
                    magnetic_field: vector(field),
                    magnetic_field_covariance: diagonal(sensor.variances_t2()),
                });
            }
            Self::Height(sensor, out) => {
                // The first reading is the reference, heard or not.
                let reading = sensor.measure(motion, tick.dt_s, stream);
                out.publish(ros_gz_interfaces::Altimeter {
                    header,
                    vertical_position: reading.position_m,
                    vertical_velocity: reading.velocity_m_s,
                    vertical_reference: reading.reference_m,
                });
            }
            Self::Pressure(sensor, out) if out.is_heard() => {
                let fluid_pressure = sensor.measure(motion, tick.dt_s, stream);
                let variance = sensor.variance_pa2();
                out.publish(FluidPressure { header, fluid_pressure, variance });
            }
            Self::Magnetic(..) | Self::Pressure(..) => {}
        }
    }

    fn reset(&mut self) {
        match self {
            Self::Magnetic(sensor, _) => sensor.reset(),
            Self::Height(sensor, _) => sensor.reset(),
            Self::Pressure(sensor, _) => sensor.reset(),
        }
    }
}

impl Device for FieldDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.timer.due(time_ns) else { return };
        let Some(motion) = self.mount.motion(moment.world) else { return };
        for (frame, kind) in &mut self.outs {
            let mut stream = self.mount.streams().tick(tick.number);
            kind.publish(
                Header::at(time_ns, frame),
                self.world_field_t,
                &motion,
                tick,
                &mut stream,
            );
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.timer.next_ns()
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
        self.outs.iter_mut().for_each(|(_, kind)| kind.reset());
    }
}
