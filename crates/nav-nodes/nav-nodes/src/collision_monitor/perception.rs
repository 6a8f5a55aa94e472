//! Zones, sources and frames that monitor and detector share.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose;
use periplus_graph::{Actor, GraphError, Node};
use periplus_motion::collision_monitor::{MonitorZone, SourcePoints};
use periplus_motion::tables::MonitorCommonParams;
use periplus_msgs::nav2_msgs::{
    AddExclusionZone, AddExclusionZoneResponse, RemoveExclusionZone, RemoveExclusionZoneRequest,
    RemoveExclusionZoneResponse,
};
use periplus_tf_ros::LogThrottle;

use crate::costmap_2d::frames::Listener;

use super::config::MonitorConfig;
use super::exclusions::ExclusionZone;
use super::sources::{InvalidSource, SourcePort};
use super::zones::{self, ZonePort};

/// Frames of a cycle.
pub(super) struct Frames<'a> {
    pub(super) tf: &'a Listener,
    pub(super) base: &'a str,
    pub(super) odom: &'a str,
    pub(super) now_ns: i64,
    pub(super) tolerance_ns: i64,
    /// Moves data by the motion of the robot since its time.
    corrects_motion: bool,
}

impl Frames<'_> {
    /// Newest transform, if it is at most `tolerance_ns` older than a time.
    fn newest(&self, target: &str, source: &str, time_ns: i64) -> Result<Pose, InvalidSource> {
        let (pose, newest_ns) = self.tf.at(target, source, 0).map_err(|why| why.to_string())?;
        // Time zero is that of static transforms.
        let age_ns = time_ns - newest_ns;
        if newest_ns != 0 && age_ns > self.tolerance_ns {
            let age_s = age_ns as f64 * 1e-9;
            return Err(format!(
                "the transform from `{source}` to `{target}` is {age_s:.2} s old \
                 (`transform_tolerance`)"
            ));
        }
        Ok(pose)
    }

    /// Present `base_from_odom`.
    pub(super) fn base_from_odom(&self) -> Result<Pose, InvalidSource> {
        self.newest(self.base, self.odom, self.now_ns)
    }

    /// Transform of data of a time to the base frame now.
    pub(super) fn base_from(&self, frame: &str, stamp_ns: i64) -> Result<Pose, InvalidSource> {
        if !self.corrects_motion {
            let newest = self.tf.at(self.base, frame, 0);
            return newest.map(|(pose, _)| pose).map_err(|why| why.to_string());
        }
        let odom_from_data = match self.tf.at(self.odom, frame, stamp_ns) {
            Ok((pose, _)) => pose,
            // The data may be newer than the transforms.
            Err(_) => self.newest(self.odom, frame, stamp_ns)?,
        };
        Ok(self.base_from_odom()? * odom_from_data)
    }
}

/// Zones and sources of a configured node.
pub(super) struct Perception {
    pub(super) zones: Vec<MonitorZone>,
    ports: Vec<ZonePort>,
    pub(super) sources: Vec<SourcePort>,
    pub(super) params: MonitorCommonParams,
    pub(super) tf: Listener,
    log: LogThrottle,
}

/// Points of all sources.
pub(super) struct SeenPoints {
    pub(super) points: Vec<SourcePoints>,
    /// True if an enabled source is invalid.
    pub(super) has_invalid_source: bool,
}

impl Perception {
    /// Creates the zones and sources.
    ///
    /// # Errors
    /// The first mistake in the parameters.
    pub(super) fn open(node: &Node, config: &MonitorConfig) -> Result<Self, String> {
        let params = config.common();
        let release = params.node.compat;
        let names: Vec<String> = config.sources.iter().map(|source| source.name.clone()).collect();
        if names.is_empty() {
            return Err("`observation_sources` is empty; name at least one source".to_owned());
        }
        if config.zones.is_empty() && release != Nav2Release::Humble {
            return Err("`polygons` is empty; name at least one polygon".to_owned());
        }
        let (mut zones, mut ports) = (Vec::new(), Vec::new());
        for zone in &config.zones {
            let (zone, port) = zones::open(node, zone, &names, release)?;
            zones.push(zone);
            ports.push(port);
        }
        let source = |source| SourcePort::open(node, source, params.source_timeout_s, release);
        let sources = config.sources.iter().map(source).collect::<Result<_, _>>()?;
        let tf = Listener::new(node).map_err(|error| error.to_string())?;
        Ok(Self { zones, ports, sources, params, tf, log: LogThrottle::default() })
    }

    /// Applies changed parameters.
    pub(super) fn adopt(&mut self, config: &MonitorConfig) {
        let release = self.params.node.compat;
        for (zone, config) in self.zones.iter_mut().zip(&config.zones) {
            zones::adopt(zone, &config.params(), release);
        }
        for (source, config) in self.sources.iter_mut().zip(&config.sources) {
            source.adopt(config.params());
        }
    }

    /// Releases all zones, as on activation.
    pub(super) fn reset(&mut self) {
        self.zones.iter_mut().for_each(|zone| zone.filter.reset());
    }

    /// Processes received transforms and shapes.
    pub(super) fn receive(&mut self) {
        self.tf.listen();
        let base = &self.params.base_frame_id;
        for (zone, port) in self.zones.iter_mut().zip(&mut self.ports) {
            port.receive(zone, &self.tf, base);
        }
    }

    /// Points of all enabled sources. An invalid source is logged.
    pub(super) fn see(&mut self, node: &Node) -> SeenPoints {
        let frames = frames(&self.params, &self.tf, node.now_ns());
        let mut seen = SeenPoints { points: Vec::new(), has_invalid_source: false };
        for source in &mut self.sources {
            let mut points = Vec::new();
            if source.is_enabled() {
                match source.points(&frames) {
                    Ok(all) => points = all,
                    Err(why) => {
                        let text = format!("source `{}` is invalid: {why}", source.name);
                        self.log.report(&Diagnostic::warning("invalid-source", text), node);
                        seen.has_invalid_source |= !source.is_optional();
                    }
                }
            }
            seen.points.push(SourcePoints { source: source.name.clone(), points });
        }
        seen
    }

    /// Publishes the shapes of zones and exclusion zones for display. Zones that are disabled one by
    /// one are not published; `are_all_enabled` is false while the monitor is switched off.
    pub(super) fn publish_shapes(&self, now_ns: i64, are_all_enabled: bool) {
        let base = &self.params.base_frame_id;
        for (zone, port) in self.zones.iter().zip(&self.ports) {
            if zone.is_enabled || !are_all_enabled {
                port.publish(zone, base, now_ns);
            }
        }
        let frames = frames(&self.params, &self.tf, now_ns);
        let exclusions = self.sources.iter().flat_map(|source| &source.exclusions);
        exclusions.for_each(|zone| zone.publish(&frames));
    }

    /// Forgets transforms after a jump of time.
    pub(super) fn forget(&mut self) {
        self.tf.forget();
        self.reset();
    }
}

fn frames<'a>(params: &'a MonitorCommonParams, tf: &'a Listener, now_ns: i64) -> Frames<'a> {
    Frames {
        tf,
        base: &params.base_frame_id,
        odom: &params.odom_frame_id,
        now_ns,
        tolerance_ns: (params.transform_tolerance_s * 1e9) as i64,
        corrects_motion: params.base_shift_correction,
    }
}

/// Serves the exclusion zones of each source, which main has.
pub(super) fn serve_exclusions<S: Send + 'static>(
    actor: &mut Actor<S>,
    config: &MonitorConfig,
    perception: impl Fn(&mut S) -> Option<&mut Perception> + Copy + Send + 'static,
) -> Result<(), GraphError> {
    if config.common().node.compat != Nav2Release::Main {
        return Ok(());
    }
    for (index, source) in config.sources.iter().enumerate() {
        let name = &source.name;
        let topic = format!("~/{name}/add_exclusion_zone");
        actor.serve::<AddExclusionZone>(&topic, move |state, request, io| {
            let result = add(source_of(perception(state), index), &request.zone, io.node());
            let success = result.is_ok();
            AddExclusionZoneResponse { success, message: result.unwrap_or_else(|why| why) }
        })?;
        let topic = format!("~/{name}/remove_exclusion_zone");
        actor.serve::<RemoveExclusionZone>(&topic, move |state, request, _| {
            let result = remove(source_of(perception(state), index), &request);
            let success = result.is_ok();
            RemoveExclusionZoneResponse { success, message: result.unwrap_or_else(|why| why) }
        })?;
    }
    Ok(())
}

fn source_of(perception: Option<&mut Perception>, index: usize) -> Option<&mut SourcePort> {
    perception.and_then(|perception| perception.sources.get_mut(index))
}

/// Response of a node without sources.
const NOT_CONFIGURED: &str = "the node is not configured";

fn add(
    source: Option<&mut SourcePort>,
    zone: &periplus_msgs::nav2_msgs::ExclusionZoneDescription,
    node: &Node,
) -> Result<String, String> {
    let source = source.ok_or(NOT_CONFIGURED)?;
    let name = &zone.zone_name;
    if name.is_empty() || source.exclusions.iter().any(|other| other.name == *name) {
        return Err(format!("`zone_name`: `{name}` is empty or exists already"));
    }
    source.exclusions.push(ExclusionZone::from_description(node, zone)?);
    Ok(format!("added zone `{name}` to source `{}`", source.name))
}

fn remove(
    source: Option<&mut SourcePort>,
    request: &RemoveExclusionZoneRequest,
) -> Result<String, String> {
    let source = source.ok_or(NOT_CONFIGURED)?;
    let (name, count) = (&request.zone_name, source.exclusions.len());
    source.exclusions.retain(|zone| !request.remove_all && zone.name != *name);
    if request.remove_all {
        return Ok(format!("removed all zones from source `{}`", source.name));
    }
    if source.exclusions.len() == count {
        return Err(format!("source `{}` has no zone `{name}`", source.name));
    }
    Ok(format!("removed zone `{name}` from source `{}`", source.name))
}
