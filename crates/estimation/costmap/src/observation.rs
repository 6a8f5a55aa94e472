//! Observations of a source and their persistence.
//!
//! Source of the rules: `nav2_costmap_2d/src/observation_buffer.cpp`.

use std::collections::VecDeque;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_params::{ParamValues, param_choice};

use crate::Nav2Release;
use crate::tables::SourceParams;

/// A point cloud with the ranges for marking and clearing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Time of the measurement \[ns\].
    pub time_ns: i64,
    /// Origin of the rays in the global frame \[m\].
    pub origin: [f64; 3],
    /// End points of the rays in the global frame \[m\]. Single precision as in messages, since it
    /// decides in which cell a point on an edge is.
    pub points: Vec<[f32; 3]>,
    /// Range of points that mark \[m\].
    pub marks: RangeLimits,
    /// Range along rays that is cleared \[m\].
    pub rays: RangeLimits,
}

/// Range of distances from a sensor \[m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RangeLimits {
    /// Minimum.
    pub min_m: f64,
    /// Maximum.
    pub max_m: f64,
}

param_choice! {
    /// Message type of a source.
    pub enum DataType {
        /// `sensor_msgs/LaserScan`.
        #[default]
        LaserScan = "LaserScan",
        /// `sensor_msgs/PointCloud2`.
        PointCloud2 = "PointCloud2",
    }
}

/// Settings of a source.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceSettings {
    /// Topic.
    pub topic: String,
    /// Frame of the sensor origin; empty for the frame of the message.
    pub sensor_frame: String,
    /// Duration for which observations are kept \[ns\]; 0 for the newest only.
    pub persistence_ns: i64,
    /// Longest expected interval between messages \[ns\]; 0 for no limit.
    pub expected_every_ns: i64,
    /// Message type.
    pub data_type: DataType,
    /// Range of heights of accepted points in the global frame \[m\].
    pub heights: RangeLimits,
    /// True if infinite ranges clear up to the maximum range.
    pub inf_is_valid: bool,
    /// True if the source marks obstacles.
    pub is_marking: bool,
    /// True if the source clears cells along rays.
    pub is_clearing: bool,
    /// Range of distances at which points mark \[m\].
    pub marks: RangeLimits,
    /// Range along rays that is cleared \[m\].
    pub rays: RangeLimits,
}

fn nanoseconds(seconds: f64) -> i64 {
    libm::round(seconds * 1e9) as i64
}

impl SourceSettings {
    /// Converts parameters of [`crate::tables::SOURCE`].
    #[must_use]
    pub fn read(name: &str, values: &ParamValues) -> Self {
        let params = SourceParams::from_values(values);
        Self {
            topic: if params.topic.is_empty() { name.to_owned() } else { params.topic },
            sensor_frame: params.sensor_frame,
            persistence_ns: nanoseconds(params.observation_persistence_s),
            expected_every_ns: nanoseconds(params.expected_update_rate_s),
            data_type: params.data_type,
            heights: RangeLimits {
                min_m: params.min_obstacle_height_m,
                max_m: params.max_obstacle_height_m,
            },
            inf_is_valid: params.inf_is_valid,
            is_marking: params.marking,
            is_clearing: params.clearing,
            marks: RangeLimits {
                min_m: params.obstacle_min_range_m,
                max_m: params.obstacle_max_range_m,
            },
            rays: RangeLimits {
                min_m: params.raytrace_min_range_m,
                max_m: params.raytrace_max_range_m,
            },
        }
    }
}

/// Counts of points by result. Each point counts once, at its first use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Accepted messages.
    pub clouds: u64,
    /// Messages dropped without a transform of the sensor.
    pub without_frame: u64,
    /// Messages dropped without a transform at their stamp.
    pub out_of_time: u64,
    /// Messages dropped as malformed.
    pub malformed: u64,
    /// Messages that were unusable because the sensor was outside the grid.
    pub sensor_outside: u64,
    /// Accepted points.
    pub points: u64,
    /// Readings without a point: no return, or beyond the limits of the sensor.
    pub without_return: u64,
    /// Points with NaN or infinite coordinates.
    pub not_finite: u64,
    /// Points below `min_obstacle_height` of the source.
    pub too_low: u64,
    /// Points above `max_obstacle_height` of the source.
    pub too_high: u64,
    /// Points below `min_obstacle_height` of the layer.
    pub layer_too_low: u64,
    /// Points above `max_obstacle_height` of the layer.
    pub layer_too_high: u64,
    /// Points nearer than `obstacle_min_range`.
    pub too_near: u64,
    /// Points further than `obstacle_max_range`.
    pub too_far: u64,
    /// Points outside the grid.
    pub outside: u64,
    /// Points that marked a cell.
    pub marked: u64,
}

impl Counters {
    /// Returns the number of received messages, used or not.
    #[must_use]
    pub fn messages(&self) -> u64 {
        self.clouds + self.without_frame + self.out_of_time + self.malformed
    }

    /// Counts a point outside the heights of its layer; returns true if it is inside.
    #[inline]
    pub(crate) fn is_in_layer(&mut self, z_m: f64, heights: &RangeLimits) -> bool {
        let (is_too_low, is_too_high) = (z_m < heights.min_m, z_m > heights.max_m);
        self.layer_too_low += u64::from(is_too_low);
        self.layer_too_high += u64::from(is_too_high);
        !(is_too_low || is_too_high)
    }

    /// Returns the difference to earlier counts.
    #[must_use]
    pub fn since(&self, before: &Self) -> Self {
        Self {
            clouds: self.clouds.saturating_sub(before.clouds),
            without_frame: self.without_frame.saturating_sub(before.without_frame),
            out_of_time: self.out_of_time.saturating_sub(before.out_of_time),
            malformed: self.malformed.saturating_sub(before.malformed),
            sensor_outside: self.sensor_outside.saturating_sub(before.sensor_outside),
            points: self.points.saturating_sub(before.points),
            without_return: self.without_return.saturating_sub(before.without_return),
            not_finite: self.not_finite.saturating_sub(before.not_finite),
            too_low: self.too_low.saturating_sub(before.too_low),
            too_high: self.too_high.saturating_sub(before.too_high),
            layer_too_low: self.layer_too_low.saturating_sub(before.layer_too_low),
            layer_too_high: self.layer_too_high.saturating_sub(before.layer_too_high),
            too_near: self.too_near.saturating_sub(before.too_near),
            too_far: self.too_far.saturating_sub(before.too_far),
            outside: self.outside.saturating_sub(before.outside),
            marked: self.marked.saturating_sub(before.marked),
        }
    }
}

/// A source of observations.
#[derive(Clone, Debug)]
pub struct ObservationSource {
    /// Name.
    pub name: String,
    /// Settings.
    pub settings: SourceSettings,
    /// Parameters with their positions in the file.
    pub values: ParamValues,
    /// Counts of points by result.
    pub counters: Counters,
    /// Newest first.
    pub(crate) observations: VecDeque<Observation>,
    /// Number of the newest observations that have not been used yet.
    pub(crate) fresh: usize,
    /// Reusable point lists.
    spare: Vec<Vec<[f32; 3]>>,
    last_ns: Option<i64>,
    compat: Nav2Release,
    /// True if the sensor was outside the grid at its last use.
    pub(crate) was_outside: bool,
}

/// Maximum number of observations, whatever their persistence.
const MAX_OBSERVATION_COUNT: usize = 1000;

impl ObservationSource {
    /// Creates a source from parameters of [`crate::tables::SOURCE`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        let name = name.into();
        Self {
            settings: SourceSettings::read(&name, &values),
            name,
            values,
            counters: Counters::default(),
            observations: VecDeque::new(),
            fresh: 0,
            spare: Vec::new(),
            last_ns: None,
            compat: Nav2Release::default(),
            was_outside: false,
        }
    }

    /// Selects the release of Nav2 by which observations expire.
    #[must_use]
    pub fn with_compat(mut self, compat: Nav2Release) -> Self {
        self.compat = compat;
        self
    }

    /// Sets parameters. The topic and received observations stay.
    pub fn configure(&mut self, values: ParamValues) {
        let settings = SourceSettings::read(&self.name, &values);
        self.settings = SourceSettings {
            topic: self.settings.topic.clone(),
            data_type: self.settings.data_type,
            ..settings
        };
        self.values = values;
    }

    /// Inserts points given in the frame of the message \[m\]. `global_from_sensor` is the origin
    /// of the rays. Points with NaN or outside the heights of the source are dropped, for marking
    /// and clearing.
    pub fn insert(
        &mut self,
        now_ns: i64,
        time_ns: i64,
        global_from_cloud: Pose,
        global_from_sensor: DVec3,
        points: impl IntoIterator<Item = [f32; 3]>,
    ) {
        let mut kept = self.spare.pop().unwrap_or_default();
        kept.clear();
        let RangeLimits { min_m, max_m } = self.settings.heights;
        let counters = &mut self.counters;
        let [x_axis, y_axis, z_axis] =
            [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| global_from_cloud.rotation * axis);
        let shift = global_from_cloud.translation;
        for [x, y, z] in points {
            counters.points += 1;
            let at = x_axis * f64::from(x) + y_axis * f64::from(y) + z_axis * f64::from(z) + shift;
            let point = [at.x as f32, at.y as f32, at.z as f32];
            let height_m = f64::from(point[2]);
            if !(point[0].is_finite() && point[1].is_finite() && point[2].is_finite()) {
                counters.not_finite += 1;
            } else if height_m < min_m {
                counters.too_low += 1;
            } else if height_m > max_m {
                counters.too_high += 1;
            } else {
                kept.push(point);
            }
        }
        counters.clouds += 1;
        self.keep(
            now_ns,
            Observation {
                time_ns,
                origin: global_from_sensor.to_array(),
                points: kept,
                marks: self.settings.marks,
                rays: self.settings.rays,
            },
        );
    }

    /// Creates a source with one permanent observation.
    #[must_use]
    pub fn fixed(name: impl Into<String>, seen: Observation, marks: bool, clears: bool) -> Self {
        let values = crate::tables::SOURCE.check([], None, &mut Diagnostics::new());
        let mut source = Self::new(name, values);
        source.settings.is_marking = marks;
        source.settings.is_clearing = clears;
        source.settings.persistence_ns = i64::MAX;
        source.keep(0, seen);
        source
    }

    fn keep(&mut self, now_ns: i64, observation: Observation) {
        self.observations.push_front(observation);
        self.fresh += 1;
        self.last_ns = Some(now_ns);
        self.purge(now_ns);
    }

    /// Drops expired observations.
    pub fn purge(&mut self, now_ns: i64) {
        let persistence_ns = self.settings.persistence_ns;
        let is_stale = |seen: &Observation| now_ns.saturating_sub(seen.time_ns) > persistence_ns;
        let kept = if persistence_ns == 0 {
            1
        } else if self.compat.drops_observations_one_by_one() {
            MAX_OBSERVATION_COUNT
        } else {
            self.observations.iter().position(is_stale).unwrap_or(MAX_OBSERVATION_COUNT)
        };
        while self.observations.len() > kept.min(MAX_OBSERVATION_COUNT) {
            self.drop_at(self.observations.len() - 1);
        }
        if persistence_ns != 0 && self.compat.drops_observations_one_by_one() {
            for index in (0..self.observations.len()).rev() {
                if is_stale(&self.observations[index]) {
                    self.drop_at(index);
                }
            }
        }
        self.fresh = self.fresh.min(self.observations.len());
    }

    /// Drops one observation and keeps its point list for reuse.
    fn drop_at(&mut self, index: usize) {
        if index < self.fresh {
            self.fresh -= 1;
        }
        if let Some(old) = self.observations.remove(index)
            && self.spare.len() < 2
        {
            self.spare.push(old.points);
        }
    }

    /// Iterates over the current observations, newest first.
    pub fn observations(&self) -> impl Iterator<Item = &Observation> {
        self.observations.iter()
    }

    /// Returns true if the last message is recent enough.
    #[must_use]
    pub fn is_current(&self, now_ns: i64) -> bool {
        let every_ns = self.settings.expected_every_ns;
        every_ns == 0 || self.last_ns.is_some_and(|last_ns| now_ns - last_ns <= every_ns)
    }

    /// Returns the time of the last message \[ns\].
    #[must_use]
    pub fn last_ns(&self) -> Option<i64> {
        self.last_ns
    }

    /// Drops all observations after a jump of the clock.
    pub fn forget(&mut self, now_ns: i64) {
        self.observations.clear();
        self.fresh = 0;
        self.restart(now_ns);
    }

    /// Restarts the timeout for messages.
    pub fn restart(&mut self, now_ns: i64) {
        self.last_ns = Some(now_ns);
    }
}

#[cfg(test)]
mod tests {
    use periplus_params::Given;

    use super::*;

    fn source(given: &[(&'static str, &'static str)]) -> ObservationSource {
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let values = crate::tables::SOURCE.check(given, None, &mut Diagnostics::new());
        ObservationSource::new("scan", values)
    }

    #[test]
    fn heights_are_those_of_the_global_frame() {
        let mut source = source(&[("max_obstacle_height", "1.0")]);
        let global_from_cloud = Pose::from_xyz(0.0, 0.0, 0.5);
        let points = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.6], [1.0, 0.0, -0.6], [f32::NAN, 0.0, 0.0]];
        source.insert(0, 0, global_from_cloud, DVec3::Z, points);
        assert_eq!(source.observations().next().unwrap().points, [[1.0, 0.0, 0.5]]);
        let counters = source.counters;
        assert_eq!((counters.too_high, counters.too_low, counters.not_finite), (1, 1, 1));
    }

    #[test]
    fn only_the_newest_counts_unless_told_otherwise() {
        let times = |source: &ObservationSource| {
            source.observations().map(|o| o.time_ns).collect::<Vec<_>>()
        };
        let mut source_now = source(&[]);
        let mut source_long = source(&[("observation_persistence", "1.0")]);
        for time_ns in [0, 600_000_000, 1_200_000_000] {
            for source in [&mut source_now, &mut source_long] {
                source.insert(time_ns, time_ns, Pose::IDENTITY, DVec3::ZERO, []);
            }
        }
        assert_eq!(times(&source_now), [1_200_000_000]);
        assert_eq!(times(&source_long), [1_200_000_000, 600_000_000]);
        source_long.purge(9_000_000_000);
        assert_eq!(times(&source_long), [0; 0]);
        source_now.purge(9_000_000_000);
        assert_eq!(times(&source_now).len(), 1, "the newest stays however old it is");
    }

    #[test]
    fn silence_is_noticed() {
        let mut source = source(&[("expected_update_rate", "0.1")]);
        source.insert(100_000, 0, Pose::IDENTITY, DVec3::ZERO, []);
        assert!(source.is_current(100_000));
        assert!(!source.is_current(1_000_000_000));
    }
}
