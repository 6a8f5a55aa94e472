//! When a sensor's device measures.

use periplus_sensors::Schedule;

use super::Post;
use super::port::Port;

/// When a sensor's device measures, and how long that is after the last time.
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
    /// Which, counted from 0.
    pub(super) number: u64,
    /// Since the last \[s\]; 0 at the first.
    pub(super) dt_s: f64,
}

impl Timer {
    /// At the sensor's rate, or that of a plugin of ROS 1 that asks for less.
    pub(super) fn new(post: &Post<'_>, ports: &[Port]) -> Self {
        let sensor_hz = post.sensor.update_rate_hz;
        let asked = ports
            .iter()
            .filter_map(Port::rate_hz)
            .fold(None, |a: Option<f64>, b| Some(a.map_or(b, |a| a.max(b))));
        let rate_hz = match asked {
            Some(asked) if sensor_hz > 0.0 => asked.min(sensor_hz),
            Some(asked) => asked,
            None => sensor_hz,
        };
        let quirks = post.setting.quirks;
        let schedule = Schedule::new(rate_hz, post.setting.start_ns, quirks);
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
