//! Measurement times of a sensor's device.

use periplus_sensors::Schedule;

use super::SensorContext;
use super::port::SensorPort;

/// Measurement times of a sensor's device, with the time since the last measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timer {
    rate_hz: f64,
    quirks: periplus_sensors::Quirks,
    schedule: Schedule,
    last_ns: Option<i64>,
}

/// A measurement that is due.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    /// Number, counted from 0.
    pub(super) number: u64,
    /// Time since the last measurement \[s\]; 0 at the first.
    pub(super) dt_s: f64,
}

impl Timer {
    /// Uses the sensor's rate, or the lower rate of a ROS 1 plugin.
    pub(super) fn new(sensor_context: &SensorContext<'_>, ports: &[SensorPort]) -> Self {
        let sensor_hz = sensor_context.sensor.update_rate_hz;
        let asked = ports
            .iter()
            .filter_map(SensorPort::rate_hz)
            .fold(None, |a: Option<f64>, b| Some(a.map_or(b, |a| a.max(b))));
        let rate_hz = match asked {
            Some(asked) if sensor_hz > 0.0 => asked.min(sensor_hz),
            Some(asked) => asked,
            None => sensor_hz,
        };
        let quirks = sensor_context.setting.quirks;
        let schedule = Schedule::new(rate_hz, sensor_context.setting.start_ns, quirks);
        Self { rate_hz, quirks, schedule, last_ns: None }
    }

    pub(super) fn due(&mut self, now_ns: i64) -> Option<Tick> {
        let number = self.schedule.due(now_ns)?;
        #[expect(clippy::cast_precision_loss, reason = "a short time")]
        let dt_s = self.last_ns.map_or(0.0, |last_ns| (now_ns - last_ns) as f64 * 1e-9);
        self.last_ns = Some(now_ns);
        Some(Tick { number, dt_s })
    }

    pub(super) fn next_ns(&self) -> Option<i64> {
        self.schedule.next_ns()
    }

    pub(super) fn reset(&mut self, time_ns: i64) {
        self.schedule = Schedule::new(self.rate_hz, time_ns, self.quirks);
        self.last_ns = None;
    }
}
