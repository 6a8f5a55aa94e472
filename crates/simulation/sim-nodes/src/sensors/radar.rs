//! Radars: scans of returns, and tracks from them.

mod messages;

use std::collections::BTreeMap;

use periplus_geometry::DVec3;
use periplus_graph::Publisher;
use periplus_msgs::radar_msgs::{RadarReturn, RadarScan, RadarTracks};
use periplus_msgs::std_msgs::Header;
use periplus_physics::LinkState;
use periplus_rendering::{PartId, SensedGeometry, filter};
use periplus_scene::RadarSpec;
use periplus_sensors::{RadarEcho, RadarSensor, RayView};
use periplus_tracking::{RadarCells, RadarTracker, ReturnNoise, TrackerSettings};

use self::messages::{point_of, return_of, track_of};
use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext, SensorMount};

struct RadarDevice {
    mount: Mount,
    radar: RadarSensor,
    state: RadarState,
    outputs: Vec<RadarOutput>,
}

#[derive(Clone)]
struct RadarState {
    timer: Timer,
    tracker: RadarTracker,
    /// True if the last scan updated the tracks.
    is_tracking: bool,
}

/// Publishers of a radar.
struct RadarOutput {
    frame: String,
    scan: Publisher<RadarScan>,
    tracks: Publisher<RadarTracks>,
}

pub(super) fn device(context: SensorBuildContext<'_, '_>, spec: &RadarSpec) -> DeviceResult {
    let radar = RadarSensor::new(spec)?;
    let [azimuth_rad, elevation_rad] = radar.angle_cells_rad();
    let cells = RadarCells {
        range_m: spec.range_resolution_m,
        azimuth_rad,
        elevation_rad,
        doppler_m_per_s: spec.doppler_resolution_m_per_s,
    };
    // The accuracy of a radar is known from its data sheet.
    let noise = ReturnNoise {
        range_m: spec.noise.range_stddev_m,
        azimuth_rad: spec.noise.azimuth_stddev_rad,
        elevation_rad: spec.noise.elevation_stddev_rad,
        doppler_m_per_s: spec.noise.doppler_stddev_m_per_s,
    };
    let mut outputs = Vec::new();
    for port in &context.ports {
        let topic = port.topic(context.sensor_context, "/radar");
        let topic = topic.trim_end_matches('/');
        outputs.push(RadarOutput {
            frame: port.frame.clone(),
            scan: port.publisher(&format!("{topic}/scan"))?,
            tracks: port.publisher(&format!("{topic}/tracks"))?,
        });
    }
    Ok(Box::new(RadarDevice {
        state: RadarState {
            timer: Timer::new(context.sensor_context, &context.ports),
            tracker: RadarTracker::new(cells, TrackerSettings::default()).with_noise(noise),
            is_tracking: false,
        },
        mount: context.mount,
        radar,
        outputs,
    }))
}

impl Device for RadarDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.state.timer.due(time_ns) else { return };
        if !self.has_subscribers() {
            self.state.is_tracking = false;
            return;
        }
        let Some(returns) = self.measure(moment, tick.number) else { return };
        let wants_tracks = self.outputs.iter().any(|out| out.tracks.is_heard());
        if wants_tracks && !self.state.is_tracking {
            // Tracks from before a pause would not be found again.
            self.state.tracker.clear();
        }
        self.state.is_tracking = wants_tracks;
        if wants_tracks {
            // The tracker reads what is published, never the truth.
            let points: Vec<_> = returns.iter().map(point_of).collect();
            self.state.tracker.update(time_ns, &points);
        }
        for out in &self.outputs {
            if out.tracks.is_heard() {
                let tracks = self.state.tracker.confirmed();
                let tracks = tracks.map(|track| track_of(track, self.mount.streams())).collect();
                out.tracks.publish(RadarTracks { header: Header::at(time_ns, &out.frame), tracks });
            }
            if out.scan.is_heard() {
                let (header, returns) = (Header::at(time_ns, &out.frame), returns.clone());
                out.scan.publish(RadarScan { header, returns });
            }
        }
    }

    fn mounts(&self) -> Vec<SensorMount> {
        let mount = |out: &RadarOutput, topic: &str| SensorMount {
            topic: topic.to_owned(),
            frame_id: out.frame.clone(),
            link: self.mount.link,
            link_from_data: self.mount.link_from_sensor(),
        };
        let both =
            |out: &RadarOutput| [mount(out, out.scan.topic()), mount(out, out.tracks.topic())];
        self.outputs.iter().flat_map(both).collect()
    }

    fn next_ns(&self) -> Option<i64> {
        self.state.timer.next_ns().filter(|_| self.has_subscribers())
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.reset(time_ns);
        self.state.tracker.reset();
        self.state.is_tracking = false;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.state.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.state)
    }
}

impl RadarDevice {
    fn has_subscribers(&self) -> bool {
        self.outputs.iter().any(|out| out.scan.is_heard() || out.tracks.is_heard())
    }

    /// Measures the returns; `None` after the model was removed.
    fn measure(&mut self, moment: &mut SenseContext<'_>, tick: u64) -> Option<Vec<RadarReturn>> {
        let motion = self.mount.motion(moment.world)?;
        let own = moment.part(SensedGeometry::Collision, self.mount.link);
        let (threads, world) = (moment.threads, moment.world);
        // Motions of all parts, because the scene is borrowed while rays are cast.
        drop(moment.seen(SensedGeometry::Collision));
        let motions: BTreeMap<PartId, LinkState> =
            moment.views.part_motions(SensedGeometry::Collision, world).collect();
        let seen = moment.seen(SensedGeometry::Collision);
        let view = RayView {
            filter: filter(u32::MAX, None),
            own_group: own.and_then(|part| seen.model_of(part)).map_or(0, |model| model.group().0),
            threads,
            ..RayView::of(seen.rays())
        };
        let mut velocity = |echo: &RadarEcho| {
            let part = seen.surface(&echo.hit).part;
            motions.get(&part).map_or(DVec3::ZERO, |it| it.velocity_at(echo.point_m))
        };
        let mut stream = self.mount.streams().tick(tick);
        let detections = self.radar.scan(&view, &motion, &mut velocity, &mut stream);
        Some(detections.iter().map(return_of).collect())
    }
}
