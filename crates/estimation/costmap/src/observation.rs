//! What a source has seen, and for how long it counts.
//!
//! Source of the rules: `nav2_costmap_2d/src/observation_buffer.cpp`.

use std::collections::VecDeque;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_params::ParamValues;

use crate::Compat;

/// Points and how to use them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// When it was seen \[ns\].
    pub time_ns: i64,
    /// Where rays begin, in the global frame \[m\].
    pub origin: [f64; 3],
    /// Where they end, in the global frame \[m\]. In single precision, as messages have it: which
    /// cell a point on an edge is in depends on it.
    pub points: Vec<[f32; 3]>,
    /// Which of them mark \[m\].
    pub marks: Span,
    /// Which part of the rays clears \[m\].
    pub rays: Span,
}

/// Distances from a sensor \[m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    /// From here.
    pub min_m: f64,
    /// To here.
    pub max_m: f64,
}

/// What comes from a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataType {
    /// `sensor_msgs/LaserScan`.
    LaserScan,
    /// `sensor_msgs/PointCloud2`.
    PointCloud2,
}

/// How a source is to be used.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceSettings {
    /// Its topic.
    pub topic: String,
    /// Where rays begin; empty for the frame of the message.
    pub sensor_frame: String,
    /// How long readings count \[ns\]; 0 for the newest only.
    pub persistence_ns: i64,
    /// A longer silence is an error \[ns\]; 0 for any.
    pub expected_every_ns: i64,
    /// What comes.
    pub data_type: DataType,
    /// Which points are kept, by their height in the global frame \[m\].
    pub heights: Span,
    /// Whether infinite ranges clear up to the largest range.
    pub inf_is_valid: bool,
    /// Whether it marks.
    pub is_marking: bool,
    /// Whether it clears.
    pub is_clearing: bool,
    /// Which points mark, by distance \[m\].
    pub marks: Span,
    /// Which part of rays clears \[m\].
    pub rays: Span,
}

fn nanoseconds(seconds: f64) -> i64 {
    libm::round(seconds * 1e9) as i64
}

impl SourceSettings {
    /// From parameters of [`crate::tables::SOURCE`].
    #[must_use]
    pub fn read(name: &str, values: &ParamValues) -> Self {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let flag = |name: &str| values.flag(name).unwrap_or_default();
        let text = |name: &str| values.text(name).unwrap_or_default();
        let topic = text("topic");
        Self {
            topic: if topic.is_empty() { name.to_owned() } else { topic },
            sensor_frame: text("sensor_frame"),
            persistence_ns: nanoseconds(number("observation_persistence")),
            expected_every_ns: nanoseconds(number("expected_update_rate")),
            data_type: match text("data_type").as_str() {
                "PointCloud2" => DataType::PointCloud2,
                _ => DataType::LaserScan,
            },
            heights: Span {
                min_m: number("min_obstacle_height"),
                max_m: number("max_obstacle_height"),
            },
            inf_is_valid: flag("inf_is_valid"),
            is_marking: flag("marking"),
            is_clearing: flag("clearing"),
            marks: Span {
                min_m: number("obstacle_min_range"),
                max_m: number("obstacle_max_range"),
            },
            rays: Span { min_m: number("raytrace_min_range"), max_m: number("raytrace_max_range") },
        }
    }
}

/// How many points came, and where they went. Each counts once, when it is first used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Messages taken in.
    pub clouds: u64,
    /// Messages dropped because nobody knew where the sensor was.
    pub without_frame: u64,
    /// Messages dropped because nobody knew where the sensor was at their time.
    pub out_of_time: u64,
    /// Messages dropped because they could not be read.
    pub malformed: u64,
    /// Messages that could not be used because the sensor was outside of the grid.
    pub sensor_outside: u64,
    /// Points taken in.
    pub points: u64,
    /// Readings without a point: no return, or beyond the limits of the sensor.
    pub without_return: u64,
    /// Points that were no numbers.
    pub not_finite: u64,
    /// Below the source's `min_obstacle_height`.
    pub too_low: u64,
    /// Above the source's `max_obstacle_height`.
    pub too_high: u64,
    /// Below the layer's `min_obstacle_height`.
    pub layer_too_low: u64,
    /// Above the layer's `max_obstacle_height`.
    pub layer_too_high: u64,
    /// Nearer than `obstacle_min_range`.
    pub too_near: u64,
    /// Further than `obstacle_max_range`.
    pub too_far: u64,
    /// Beside the grid.
    pub outside: u64,
    /// Points that marked a cell.
    pub marked: u64,
}

impl Counters {
    /// Messages that came, used or not.
    #[must_use]
    pub fn messages(&self) -> u64 {
        self.clouds + self.without_frame + self.out_of_time + self.malformed
    }

    /// What has come since they stood so.
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
pub struct Source {
    /// Its name.
    pub name: String,
    /// How it is to be used.
    pub settings: SourceSettings,
    /// The same as parameters, with the places where they were written.
    pub values: ParamValues,
    /// Where its points went.
    pub counters: Counters,
    /// Newest first.
    pub(crate) observations: VecDeque<Observation>,
    /// How many of them, newest first, have not been used yet.
    pub(crate) fresh: usize,
    /// Lists of points to be used again.
    spare: Vec<Vec<[f32; 3]>>,
    last_ns: Option<i64>,
    compat: Compat,
    /// Whether the sensor was outside of the grid when it was last used.
    pub(crate) was_outside: bool,
}

/// More messages than this never count at once, however long they are to be kept.
const MOST_KEPT: usize = 1000;

impl Source {
    /// From parameters of [`crate::tables::SOURCE`].
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
            compat: Compat::default(),
            was_outside: false,
        }
    }

    /// Drops old observations as a release of Nav2 does.
    #[must_use]
    pub fn with_compat(mut self, compat: Compat) -> Self {
        self.compat = compat;
        self
    }

    /// Takes other values for its parameters. The topic and what comes from it stay.
    pub fn configure(&mut self, values: ParamValues) {
        let settings = SourceSettings::read(&self.name, &values);
        self.settings = SourceSettings {
            topic: self.settings.topic.clone(),
            data_type: self.settings.data_type,
            ..settings
        };
        self.values = values;
    }

    /// Takes in points, given in the frame of the message \[m\]. `global_from_sensor` is where rays
    /// begin. Points that are no numbers, or outside of the source's heights, are dropped here, for
    /// rays as well.
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
        let Span { min_m, max_m } = self.settings.heights;
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

    /// A source that has seen one thing and goes on seeing it.
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

    /// Drops what is too old.
    pub fn purge(&mut self, now_ns: i64) {
        let persistence_ns = self.settings.persistence_ns;
        let is_stale = |seen: &Observation| now_ns.saturating_sub(seen.time_ns) > persistence_ns;
        let kept = if persistence_ns == 0 {
            1
        } else if self.compat.drops_observations_one_by_one() {
            MOST_KEPT
        } else {
            self.observations.iter().position(is_stale).unwrap_or(MOST_KEPT)
        };
        while self.observations.len() > kept.min(MOST_KEPT) {
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

    /// Drops one observation and keeps its list of points to be used again.
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

    /// What counts, newest first.
    pub fn observations(&self) -> impl Iterator<Item = &Observation> {
        self.observations.iter()
    }

    /// Whether something came as lately as it should.
    #[must_use]
    pub fn is_current(&self, now_ns: i64) -> bool {
        let every_ns = self.settings.expected_every_ns;
        every_ns == 0 || self.last_ns.is_some_and(|last_ns| now_ns - last_ns <= every_ns)
    }

    /// When something came last \[ns\].
    #[must_use]
    pub fn last_ns(&self) -> Option<i64> {
        self.last_ns
    }

    /// Drops all observations: the clock jumped, and they are of another time.
    pub fn forget(&mut self, now_ns: i64) {
        self.observations.clear();
        self.fresh = 0;
        self.restart(now_ns);
    }

    /// From now on silence counts again.
    pub fn restart(&mut self, now_ns: i64) {
        self.last_ns = Some(now_ns);
    }
}

#[cfg(test)]
mod tests {
    use periplus_params::Given;

    use super::*;

    fn source(given: &[(&'static str, &'static str)]) -> Source {
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let values = crate::tables::SOURCE.check(given, None, &mut Diagnostics::new());
        Source::new("scan", values)
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
        let times = |source: &Source| source.observations().map(|o| o.time_ns).collect::<Vec<_>>();
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
