//! Cameras: colours, depths, points, labels, and the camera info beside them.

mod info;
mod outs;
mod pixels;
mod points;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_graph::{Mailbox, Qos};
use periplus_msgs::std_msgs::{Bool, Empty};
use periplus_rendering::{ImageOutputs, Lens, RenderRequest, RenderedImages, SensedGeometry};
use periplus_scene::{Camera, CameraKind};
use periplus_sensors::{ImageNoise, Pinhole, Streams};

use self::outs::{Out, outs};
use super::port::Style;
use super::{Failed, Made, Mount, Order, Timer};
use crate::{Device, Moment, SensorMount};

/// One camera, or several in one sensor.
struct CameraDevice {
    mount: Mount,
    timer: Timer,
    eyes: Vec<Eye>,
    trigger: Option<Trigger>,
    /// Number of the last measurement that was due.
    last_tick: u64,
    /// Whether it had subscribers then.
    was_heard: bool,
}

/// What one camera sees and to whom it tells.
struct Eye {
    lens: Lens,
    pinhole: Pinhole,
    sensor_from_camera: Pose,
    near_m: f64,
    far_m: f64,
    visibility_mask: u32,
    /// Of its own, so that nothing depends on who hears the others of one sensor.
    streams: Streams,
    noise: Option<ImageNoise>,
    /// Whether the noise is of depths \[m\] (gz's depth cameras) instead of colours.
    noisy_depths: bool,
    /// Least and greatest depth that is told \[m\].
    depth_range_m: [f64; 2],
    picture: RenderedImages,
    outs: Vec<Out>,
}

/// What a camera waits for.
enum Trigger {
    Classic(Mailbox<Empty>),
    Gz(Mailbox<Bool>),
}

impl Trigger {
    fn is_pulled(&self) -> bool {
        match self {
            Self::Classic(mailbox) => mailbox.latest().is_some(),
            Self::Gz(mailbox) => mailbox.latest().is_some_and(|message| message.data),
        }
    }
}

pub(super) fn device(order: Order<'_, '_>, spec: &Camera, diagnostics: &mut Diagnostics) -> Made {
    if matches!(spec.kind, CameraKind::Thermal | CameraKind::BoundingBox) {
        return Err(Failed::not_measured(order.post.sensor));
    }
    let several = spec.kind == CameraKind::Multi;
    let mut eyes = Vec::new();
    for camera in std::iter::once(spec).chain(spec.others.iter().filter(|_| several)) {
        eyes.push(eye(
            &order,
            camera,
            several.then_some(camera.name.as_deref()).flatten(),
            diagnostics,
        )?);
    }
    let trigger = trigger(&order, spec)?;
    Ok(Box::new(CameraDevice {
        timer: Timer::new(order.post, &order.ports),
        mount: order.mount,
        eyes,
        trigger,
        last_tick: 0,
        was_heard: false,
    }))
}

fn eye(
    order: &Order<'_, '_>,
    camera: &Camera,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<Eye, Failed> {
    let impossible = |why: String| Box::new(Diagnostic::error("camera-impossible", why));
    // A wide angle has no focal length; its camera info says the nearest thing to it.
    let narrow =
        Camera { horizontal_fov_rad: camera.horizontal_fov_rad.min(3.1), ..camera.clone() };
    let pinhole =
        Pinhole::new(if camera.kind == CameraKind::WideAngle { &narrow } else { camera })?;
    let mut depth_range_m = camera.depth_clip_m.unwrap_or([camera.near_m, camera.far_m]);
    let mut all = Vec::new();
    for port in &order.ports {
        if let Some(range_m) = outs::depth_range_m(port) {
            depth_range_m = range_m;
        }
        all.extend(outs(order.post, port, camera, &pinhole, name, diagnostics)?);
    }
    let near_m = camera.depth_clip_m.map_or(camera.near_m, |[near_m, _]| near_m.min(camera.near_m));
    let far_m = camera.depth_clip_m.map_or(camera.far_m, |[_, far_m]| far_m.max(camera.far_m));
    Ok(Eye {
        lens: Lens::of(camera).map_err(impossible)?,
        pinhole,
        sensor_from_camera: camera.sensor_from_camera,
        near_m,
        far_m,
        visibility_mask: camera.visibility_mask,
        streams: match name {
            Some(name) => {
                Streams::new(order.post.setting.seed, format!("{}::{name}", order.mount.name))
            }
            None => order.mount.streams().clone(),
        },
        noise: ImageNoise::new(&camera.noise),
        noisy_depths: camera.kind == CameraKind::Depth
            && order.ports.iter().all(|port| port.style == Style::Gz),
        depth_range_m,
        picture: RenderedImages::default(),
        outs: all,
    })
}

fn trigger(order: &Order<'_, '_>, spec: &Camera) -> Result<Option<Trigger>, Failed> {
    for port in &order.ports {
        if port.style == Style::Ros2 && port.flag("triggered") {
            let topic = port.out_named("image_trigger").unwrap_or("image_trigger");
            return Ok(Some(Trigger::Classic(port.node.mailbox(topic, Qos::reliable(1))?)));
        }
        if port.style == Style::Gz && spec.triggered {
            let topic = format!("{}/trigger", order.post.gz_topic("/image"));
            return Ok(Some(Trigger::Gz(port.node.mailbox(&topic, Qos::reliable(1))?)));
        }
    }
    Ok(None)
}

impl Device for CameraDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.timer.due(time_ns) else { return };
        if self.trigger.as_ref().is_some_and(|trigger| !trigger.is_pulled()) {
            return;
        }
        self.last_tick = tick.number;
        self.was_heard = self.is_heard();
        self.measure(moment, tick.number);
    }

    fn sense_paused(&mut self, moment: &mut Moment<'_>) {
        let is_heard = self.is_heard();
        let had_subscribers = std::mem::replace(&mut self.was_heard, is_heard);
        if is_heard && !had_subscribers && self.trigger.is_none() {
            self.measure(moment, self.last_tick);
        }
    }

    fn mounts(&self) -> Vec<SensorMount> {
        let link = self.mount.link;
        let of = |eye: &Eye, out: &Out| {
            let (topic, frame_id, camera_from_points) = out.points()?;
            let link_from_camera = self.mount.link_from_sensor() * eye.sensor_from_camera;
            let link_from_data = link_from_camera * camera_from_points;
            Some(SensorMount { topic, frame_id, link, link_from_data })
        };
        let of_eye = |eye: &Eye| eye.outs.iter().filter_map(|out| of(eye, out)).collect::<Vec<_>>();
        self.eyes.iter().flat_map(of_eye).collect()
    }

    fn next_ns(&self) -> Option<i64> {
        self.timer.next_ns().filter(|_| self.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
    }
}

impl CameraDevice {
    fn is_heard(&self) -> bool {
        self.eyes.iter().any(|eye| eye.outs.iter().any(Out::is_heard))
    }

    fn measure(&mut self, moment: &mut Moment<'_>, tick: u64) {
        let time_ns = moment.time_ns();
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let threads = moment.threads;
        for eye in &mut self.eyes {
            let outputs = eye.outputs();
            if outputs != ImageOutputs::default() {
                let shot = RenderRequest {
                    lens: &eye.lens,
                    world_from_camera: motion.world_from_sensor * eye.sensor_from_camera,
                    near_m: eye.near_m,
                    far_m: eye.far_m,
                    visibility_mask: eye.visibility_mask,
                    own: None,
                    outputs,
                    threads,
                };
                moment.seen(SensedGeometry::Visual).render(&shot, &mut eye.picture);
                eye.spoil(&mut eye.streams.tick(tick));
            }
            for out in &eye.outs {
                out.publish(&eye.picture, &eye.pinhole, time_ns);
            }
        }
    }
}

impl Eye {
    /// The images that somebody hears.
    fn outputs(&self) -> ImageOutputs {
        self.outs.iter().filter(|out| out.is_heard()).fold(ImageOutputs::default(), |all, out| {
            let ImageOutputs { colour, depth, labels } = out.needs();
            ImageOutputs {
                colour: all.colour || colour,
                depth: all.depth || depth,
                labels: all.labels || labels,
            }
        })
    }

    fn spoil(&mut self, stream: &mut periplus_geometry::Stream) {
        let [min_m, max_m] = self.depth_range_m;
        periplus_sensors::clip_depths(&mut self.picture.depth_m, min_m, max_m);
        match &self.noise {
            Some(noise) if self.noisy_depths => {
                noise.depths(&mut self.picture.depth_m, self.depth_range_m, stream);
            }
            Some(noise) => noise.colours(&mut self.picture.rgb, stream),
            None => {}
        }
    }
}
