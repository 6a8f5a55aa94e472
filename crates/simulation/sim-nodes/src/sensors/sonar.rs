//! Sonars.

use periplus_graph::Publisher;
use periplus_msgs::sensor_msgs::Range;
use periplus_msgs::std_msgs::Header;
use periplus_rendering::{SensedGeometry, filter};
use periplus_scene::SensorKind;
use periplus_sensors::{RayView, Sonar};

use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct SonarDevice {
    mount: Mount,
    timer: Timer,
    sonar: Sonar,
    outputs: Vec<(String, Publisher<Range>)>,
}

pub(super) fn device(context: SensorBuildContext<'_, '_>) -> DeviceResult {
    let SensorKind::Sonar { geometry, min_m, max_m, radius_m } =
        &context.sensor_context.sensor.kind
    else {
        return Err(super::SensorBuildError::unsupported(context.sensor_context.sensor));
    };
    let sonar = Sonar::new(geometry, *min_m, *max_m, *radius_m)?;
    let mut outputs = Vec::new();
    for port in &context.ports {
        outputs.push((
            port.frame.clone(),
            port.publisher(&port.topic(context.sensor_context, "/sonar"))?,
        ));
    }
    Ok(Box::new(SonarDevice {
        timer: Timer::new(context.sensor_context, &context.ports),
        mount: context.mount,
        sonar,
        outputs,
    }))
}

impl Device for SonarDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    #[expect(clippy::cast_possible_truncation, reason = "messages have single precision")]
    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let due = self.timer.due(time_ns).is_some();
        if !due || !self.outputs.iter().any(|(_, out)| out.is_heard()) {
            return;
        }
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let own = moment.part(SensedGeometry::Collision, self.mount.link);
        let threads = moment.threads;
        let seen = moment.seen(SensedGeometry::Collision);
        let view = RayView {
            filter: filter(u32::MAX, None),
            own_group: own.and_then(|part| seen.model_of(part)).map_or(0, |model| model.group().0),
            threads,
            ..RayView::of(seen.rays())
        };
        let range_m = self.sonar.measure(&view, motion.world_from_sensor);
        let [min_m, max_m] = self.sonar.range_m();
        for (frame, out) in &self.outputs {
            out.publish(Range {
                header: Header::at(time_ns, frame),
                radiation_type: Range::ULTRASOUND,
                field_of_view: self.sonar.field_of_view_rad() as f32,
                min_range: min_m as f32,
                max_range: max_m as f32,
                range: range_m as f32,
                ..Range::default()
            });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let has_subscribers = self.outputs.iter().any(|(_, out)| out.is_heard());
        self.timer.next_ns().filter(|_| has_subscribers)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.timer)
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.timer)
    }
}
