//! Sonars.

use periplus_graph::Publisher;
use periplus_msgs::sensor_msgs::Range;
use periplus_msgs::std_msgs::Header;
use periplus_rendering::{SensedGeometry, filter};
use periplus_scene::SensorKind;
use periplus_sensors::{Sonar, View};

use super::{Made, Mount, Order, Timer};
use crate::{Device, Moment};

struct SonarDevice {
    mount: Mount,
    timer: Timer,
    sonar: Sonar,
    outs: Vec<(String, Publisher<Range>)>,
}

pub(super) fn device(order: Order<'_, '_>) -> Made {
    let SensorKind::Sonar { geometry, min_m, max_m, radius_m } = &order.post.sensor.kind else {
        return Err(super::Failed::not_measured(order.post.sensor));
    };
    let sonar = Sonar::new(geometry, *min_m, *max_m, *radius_m)?;
    let mut outs = Vec::new();
    for port in &order.ports {
        outs.push((port.frame.clone(), port.publisher(&port.topic(order.post, "/sonar"))?));
    }
    Ok(Box::new(SonarDevice {
        timer: Timer::new(order.post, &order.ports),
        mount: order.mount,
        sonar,
        outs,
    }))
}

impl Device for SonarDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    #[expect(clippy::cast_possible_truncation, reason = "messages have single precision")]
    fn sense(&mut self, moment: &mut Moment<'_>) {
        let time_ns = moment.time_ns();
        let due = self.timer.due(time_ns).is_some();
        if !due || !self.outs.iter().any(|(_, out)| out.is_heard()) {
            return;
        }
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let own = moment.part(SensedGeometry::Collision, self.mount.link);
        let threads = moment.threads;
        let seen = moment.seen(SensedGeometry::Collision);
        let view = View {
            filter: filter(u32::MAX, None),
            own_group: own.and_then(|part| seen.model_of(part)).map_or(0, |model| model.group().0),
            threads,
            ..View::of(seen.rays())
        };
        let range_m = self.sonar.measure(&view, motion.world_from_sensor);
        let [min_m, max_m] = self.sonar.range_m();
        for (frame, out) in &self.outs {
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
        let is_heard = self.outs.iter().any(|(_, out)| out.is_heard());
        self.timer.next_ns().filter(|_| is_heard)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
    }
}
