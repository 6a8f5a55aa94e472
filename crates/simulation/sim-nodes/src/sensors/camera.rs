//! Cameras: images, depth images, point clouds, labels, and camera info.

mod boxes;
mod info;
mod outputs;
mod pixels;
mod points;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs::{Bool, Empty};
use periplus_rendering::{
    ImageOutputs, Lens, LensError, RenderRequest, RenderScene, RenderedImages, SensedGeometry,
};
use periplus_scene::{Camera, CameraKind};
use periplus_sensors::{ImageNoise, Pinhole, Streams};

use self::boxes::{BoxKind, Detections};
use self::outputs::{CameraOutput, outputs};
use super::port::Convention;
use super::{DeviceResult, Mount, SensorBuildContext, SensorBuildError, Timer};
use crate::{Device, DeviceState, SenseContext, SensorMount};

/// A camera sensor: one camera, or several.
struct CameraDevice {
    mount: Mount,
    units: Vec<CameraUnit>,
    trigger: Option<Trigger>,
    state: CameraState,
}

#[derive(Clone)]
struct CameraState {
    timer: Timer,
    /// Number of the last measurement that was due.
    last_tick: u64,
    /// True if that measurement had subscribers.
    had_subscribers: bool,
}

/// A camera with its outputs.
struct CameraUnit {
    lens: Lens,
    pinhole: Pinhole,
    sensor_from_camera: Pose,
    near_m: f64,
    far_m: f64,
    visibility_mask: u32,
    /// Separate streams per camera, so that noise does not depend on the subscribers of the others.
    streams: Streams,
    noise: Option<ImageNoise>,
    /// True if the noise applies to depths \[m\] (gz's depth cameras) instead of colours.
    noisy_depths: bool,
    /// Minimum and maximum depth that is published \[m\].
    depth_range_m: [f64; 2],
    picture: RenderedImages,
    outputs: Vec<CameraOutput>,
}

/// Trigger subscription of a camera.
enum Trigger {
    Classic(Mailbox<Empty>),
    Gz(Mailbox<Bool>),
}

impl Trigger {
    fn is_requested(&self) -> bool {
        match self {
            Self::Classic(mailbox) => mailbox.latest().is_some(),
            Self::Gz(mailbox) => mailbox.latest().is_some_and(|message| message.data),
        }
    }

    fn pending(&self) -> Vec<Sample> {
        match self {
            Self::Classic(mailbox) => mailbox.pending(),
            Self::Gz(mailbox) => mailbox.pending(),
        }
    }

    fn set_pending(&self, samples: &[Sample]) {
        match self {
            Self::Classic(mailbox) => mailbox.set_pending(samples),
            Self::Gz(mailbox) => mailbox.set_pending(samples),
        }
    }
}

pub(super) fn device(
    context: SensorBuildContext<'_, '_>,
    spec: &Camera,
    diagnostics: &mut Diagnostics,
) -> DeviceResult {
    if spec.kind == CameraKind::Thermal {
        return Err(SensorBuildError::unsupported(context.sensor_context.sensor));
    }
    let several = spec.kind == CameraKind::Multi;
    let mut units = Vec::new();
    for camera in std::iter::once(spec).chain(spec.others.iter().filter(|_| several)) {
        units.push(unit(
            &context,
            camera,
            several.then_some(camera.name.as_deref()).flatten(),
            diagnostics,
        )?);
    }
    let trigger = trigger(&context, spec)?;
    Ok(Box::new(CameraDevice {
        state: CameraState {
            timer: Timer::new(context.sensor_context, &context.ports),
            last_tick: 0,
            had_subscribers: false,
        },
        mount: context.mount,
        units,
        trigger,
    }))
}

fn unit(
    context: &SensorBuildContext<'_, '_>,
    camera: &Camera,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<CameraUnit, SensorBuildError> {
    let impossible =
        |error: LensError| Box::new(Diagnostic::error("camera-impossible", error.to_string()));
    // A wide-angle lens has no focal length; its camera info is the closest pinhole.
    let narrow =
        Camera { horizontal_fov_rad: camera.horizontal_fov_rad.min(3.1), ..camera.clone() };
    let pinhole =
        Pinhole::new(if camera.kind == CameraKind::WideAngle { &narrow } else { camera })?;
    let mut depth_range_m = camera.depth_clip_m.unwrap_or([camera.near_m, camera.far_m]);
    let mut all = Vec::new();
    for port in &context.ports {
        if let Some(range_m) = outputs::depth_range_m(port) {
            depth_range_m = range_m;
        }
        all.extend(outputs(context.sensor_context, port, camera, &pinhole, name, diagnostics)?);
    }
    let near_m = camera.depth_clip_m.map_or(camera.near_m, |[near_m, _]| near_m.min(camera.near_m));
    let far_m = camera.depth_clip_m.map_or(camera.far_m, |[_, far_m]| far_m.max(camera.far_m));
    Ok(CameraUnit {
        lens: Lens::of(camera).map_err(impossible)?,
        pinhole,
        sensor_from_camera: camera.sensor_from_camera,
        near_m,
        far_m,
        visibility_mask: camera.visibility_mask,
        streams: match name {
            Some(name) => Streams::new(
                context.sensor_context.setting.seed,
                format!("{}::{name}", context.mount.name),
            ),
            None => context.mount.streams().clone(),
        },
        noise: ImageNoise::new(&camera.noise),
        noisy_depths: camera.kind == CameraKind::Depth
            && context.ports.iter().all(|port| port.convention == Convention::Gz),
        depth_range_m,
        picture: RenderedImages::default(),
        outputs: all,
    })
}

fn trigger(
    context: &SensorBuildContext<'_, '_>,
    spec: &Camera,
) -> Result<Option<Trigger>, SensorBuildError> {
    for port in &context.ports {
        if port.convention == Convention::Ros2 && port.flag("triggered") {
            let topic = port.out_named("image_trigger").unwrap_or("image_trigger");
            return Ok(Some(Trigger::Classic(port.node.mailbox(topic, Qos::reliable(1))?)));
        }
        if port.convention == Convention::Gz && spec.triggered {
            let topic = format!("{}/trigger", context.sensor_context.gz_topic("/image"));
            return Ok(Some(Trigger::Gz(port.node.mailbox(&topic, Qos::reliable(1))?)));
        }
    }
    Ok(None)
}

impl Device for CameraDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.state.timer.due(time_ns) else { return };
        if self.trigger.as_ref().is_some_and(|trigger| !trigger.is_requested()) {
            return;
        }
        self.state.last_tick = tick.number;
        self.state.had_subscribers = self.has_subscribers();
        self.measure(moment, tick.number);
    }

    fn sense_paused(&mut self, moment: &mut SenseContext<'_>) {
        let has_subscribers = self.has_subscribers();
        let had_subscribers = std::mem::replace(&mut self.state.had_subscribers, has_subscribers);
        if has_subscribers && !had_subscribers && self.trigger.is_none() {
            self.measure(moment, self.state.last_tick);
        }
    }

    fn mounts(&self) -> Vec<SensorMount> {
        let link = self.mount.link;
        let of = |unit: &CameraUnit, out: &CameraOutput| {
            let (topic, frame_id, camera_from_points) = out.points()?;
            let link_from_camera = self.mount.link_from_sensor() * unit.sensor_from_camera;
            let link_from_data = link_from_camera * camera_from_points;
            Some(SensorMount { topic, frame_id, link, link_from_data })
        };
        let of_eye = |unit: &CameraUnit| {
            unit.outputs.iter().filter_map(|out| of(unit, out)).collect::<Vec<_>>()
        };
        self.units.iter().flat_map(of_eye).collect()
    }

    fn next_ns(&self) -> Option<i64> {
        self.state.timer.next_ns().filter(|_| self.has_subscribers())
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        let requests = self.trigger.as_ref().map_or_else(Vec::new, Trigger::pending);
        DeviceState::new((self.state.clone(), requests))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, requests)) = saved.get::<(CameraState, Vec<Sample>)>() else {
            return false;
        };
        self.state = state.clone();
        if let Some(trigger) = &self.trigger {
            trigger.set_pending(requests);
        }
        true
    }
}

impl CameraDevice {
    fn has_subscribers(&self) -> bool {
        self.units.iter().any(|unit| unit.outputs.iter().any(CameraOutput::has_subscribers))
    }

    fn measure(&mut self, moment: &mut SenseContext<'_>, tick: u64) {
        let time_ns = moment.time_ns();
        let Some(motion) = self.mount.motion(moment.world) else { return };
        let threads = moment.threads;
        for unit in &mut self.units {
            let outputs = unit.outputs();
            let mut detections = None;
            if outputs != ImageOutputs::default() {
                let shot = RenderRequest {
                    lens: &unit.lens,
                    world_from_camera: motion.world_from_sensor * unit.sensor_from_camera,
                    near_m: unit.near_m,
                    far_m: unit.far_m,
                    visibility_mask: unit.visibility_mask,
                    own: None,
                    outputs,
                    threads,
                };
                let scene = moment.seen(SensedGeometry::Visual);
                scene.render(&shot, &mut unit.picture);
                detections = unit.detections(&scene, &shot);
                unit.spoil(&mut unit.streams.tick(tick));
            }
            for out in &unit.outputs {
                out.publish(&unit.picture, detections.as_ref(), &unit.pinhole, time_ns);
            }
        }
    }
}

impl CameraUnit {
    /// Returns the images with subscribers.
    fn outputs(&self) -> ImageOutputs {
        self.outputs.iter().filter(|out| out.has_subscribers()).fold(
            ImageOutputs::default(),
            |all, out| {
                let ImageOutputs { colour, depth, labels } = out.needs();
                ImageOutputs {
                    colour: all.colour || colour,
                    depth: all.depth || depth,
                    labels: all.labels || labels,
                }
            },
        )
    }

    /// Returns the objects in the rendered image, if there is a subscriber for their boxes.
    fn detections(&self, scene: &RenderScene, shot: &RenderRequest<'_>) -> Option<Detections> {
        let mut kinds = self.outputs.iter().filter_map(CameraOutput::boxes).peekable();
        kinds.peek()?;
        let full = kinds.any(|kind| kind == BoxKind::Full);
        Some(Detections {
            objects: scene.detected_objects(shot, &self.picture, full),
            camera_from_world: shot.world_from_camera.inverse(),
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
