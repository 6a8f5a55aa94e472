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
use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct ScalarDevice {
    mount: Mount,
    timer: Timer,
    world_field_t: DVec3,
    outputs: Vec<(String, ScalarSensor)>,
}

/// A measured quantity with its publisher.
enum ScalarSensor {
    Magnetic(Magnetometer, Publisher<MagneticField>),
    Height(Altimeter, Publisher<ros_gz_interfaces::Altimeter>),
    Pressure(Barometer, Publisher<FluidPressure>),
}

#[derive(Clone)]
struct ScalarState {
    timer: Timer,
    /// Sensors of the outputs, in their order.
    models: Vec<ScalarModel>,
}

#[derive(Clone)]
enum ScalarModel {
    Magnetic(Magnetometer),
    Height(Altimeter),
    Pressure(Barometer),
}

pub(super) fn device(context: SensorBuildContext<'_, '_>) -> DeviceResult {
    let streams = context.mount.streams();
    let mut outputs = Vec::new();
    for port in &context.ports {
        let kind = match &context.sensor_context.sensor.kind {
            SensorKind::Magnetometer(noise) => ScalarSensor::Magnetic(
                Magnetometer::new(noise, streams),
                port.publisher(&port.topic(context.sensor_context, "/magnetometer"))?,
            ),
            SensorKind::Altimeter { vertical_position, vertical_velocity } => ScalarSensor::Height(
                Altimeter::new(vertical_position, vertical_velocity, streams),
                port.publisher(&port.topic(context.sensor_context, "/altimeter"))?,
            ),
            SensorKind::AirPressure { reference_altitude_m, pressure } => ScalarSensor::Pressure(
                Barometer::new(*reference_altitude_m, pressure, streams),
                port.publisher(&port.topic(context.sensor_context, "/air_pressure"))?,
            ),
            _ => return Err(super::SensorBuildError::unsupported(context.sensor_context.sensor)),
        };
        outputs.push((port.frame.clone(), kind));
    }
    Ok(Box::new(ScalarDevice {
        timer: Timer::new(context.sensor_context, &context.ports),
        world_field_t: context.sensor_context.setting.scene.magnetic_field_t,
        mount: context.mount,
        outputs,
    }))
}

impl ScalarSensor {
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
                // The first reading is the reference, with or without subscribers.
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

    fn model(&self) -> ScalarModel {
        match self {
            Self::Magnetic(sensor, _) => ScalarModel::Magnetic(sensor.clone()),
            Self::Height(sensor, _) => ScalarModel::Height(sensor.clone()),
            Self::Pressure(sensor, _) => ScalarModel::Pressure(sensor.clone()),
        }
    }

    /// Restores the sensor; a device measures the same quantity on all of its outputs.
    fn set_model(&mut self, model: &ScalarModel) {
        match (self, model) {
            (Self::Magnetic(sensor, _), ScalarModel::Magnetic(model)) => sensor.clone_from(model),
            (Self::Height(sensor, _), ScalarModel::Height(model)) => sensor.clone_from(model),
            (Self::Pressure(sensor, _), ScalarModel::Pressure(model)) => sensor.clone_from(model),
            _ => {}
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

impl Device for ScalarDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.timer.due(time_ns) else { return };
        let Some(motion) = self.mount.motion(moment.world) else { return };
        for (frame, kind) in &mut self.outputs {
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
        self.outputs.iter_mut().for_each(|(_, kind)| kind.reset());
    }

    fn save(&self) -> DeviceState {
        let models = self.outputs.iter().map(|(_, sensor)| sensor.model()).collect();
        DeviceState::new(ScalarState { timer: self.timer, models })
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(ScalarState { timer, models }) = saved.get() else { return false };
        self.timer = *timer;
        for ((_, sensor), model) in self.outputs.iter_mut().zip(models) {
            sensor.set_model(model);
        }
        true
    }
}
