//! Comparison of the messages of one topic.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use periplus_geometry::normalize_angle;
use periplus_graph::Sample;
use periplus_migration::TopicAspect;
use periplus_msgs::geometry_msgs::{Quaternion, Vector3};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::{
    CameraInfo, Image, Imu, JointState, LaserScan, NavSatFix, PointCloud2,
};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, sensor_msgs};

use super::difference::{Deviation, Difference};
use super::record::TopicLog;

/// Tolerance of ranges \[m\].
const SCAN_TOLERANCE_M: f64 = 1e-3;

/// Tolerance of odometry, of the distance driven \[%\].
const ODOMETRY_TOLERANCE_PERCENT: f64 = 1.0;

/// Distance below which a robot counts as stationary, for percentages \[m\].
const MIN_DISTANCE_M: f64 = 0.1;

/// Rotation below which a robot counts as stationary, for percentages \[rad\].
const MIN_ROTATION_RAD: f64 = 0.1;

/// Tolerance of angular velocities of an IMU \[rad/s\].
const TURN_RATE_TOLERANCE_RAD_S: f64 = 0.05;

/// Tolerance of orientations of an IMU \[rad\].
const ORIENTATION_TOLERANCE_RAD: f64 = 0.01;

/// Tolerance of the mean acceleration of an IMU \[m/s²\]. Contacts of wheels give short peaks, so that only means compare.
const ACCELERATION_TOLERANCE_M_S2: f64 = 0.1;

/// Tolerance of the mean difference of pixels, of 255.
const PIXEL_TOLERANCE: f64 = 2.0;

/// Fraction of beams that may hit in one scan only: beams that graze an edge.
const MISSED_BEAMS_TOLERANCE_FRACTION: f64 = 0.0;

/// Comparison of the messages of a topic.
#[derive(Debug, Default)]
pub(super) struct Measured {
    pub(super) frames: [String; 2],
    pub(super) differences: Vec<Difference>,
    pub(super) deviations: Vec<Deviation>,
    /// Number of compared pairs of messages.
    pub(super) pairs: usize,
}

impl Measured {
    fn differs(&mut self, aspect: TopicAspect, text: String) {
        self.differences.push(Difference::new(aspect, text));
    }

    fn deviates(&mut self, quantity: &'static str, value: f64, tolerance: f64, unit: &'static str) {
        self.deviations.push(Deviation { quantity, value, tolerance, unit });
    }

    fn set_frames(&mut self, old: &str, new: &str) {
        self.frames = [old.to_owned(), new.to_owned()];
        if old != new {
            self.differs(TopicAspect::Frame, format!("frame `{old}` and `{new}`"));
        }
    }
}

/// Compares two topics of one type.
pub(super) fn measure(old: &TopicLog, new: &TopicLog) -> Measured {
    let mut measured = Measured::default();
    match old.type_name.as_str() {
        LaserScan::TYPE_NAME => scans(&pairs(old, new), &mut measured),
        Odometry::TYPE_NAME => odometry(&pairs(old, new), &mut measured),
        Imu::TYPE_NAME => inertial(&pairs(old, new), &mut measured),
        JointState::TYPE_NAME => joint_states(&pairs(old, new), &mut measured),
        TFMessage::TYPE_NAME => transforms(old, new, &mut measured),
        CameraInfo::TYPE_NAME => camera_infos(&pairs(old, new), &mut measured),
        Image::TYPE_NAME => images(&pairs(old, new), &mut measured),
        PointCloud2::TYPE_NAME => clouds(&pairs(old, new), &mut measured),
        NavSatFix::TYPE_NAME => fixes(&pairs(old, new), &mut measured),
        _ => bytes(old, new, &mut measured),
    }
    for deviation in &measured.deviations {
        if !deviation.is_within() {
            let difference = Difference::new(TopicAspect::Values, deviation.words());
            measured.differences.push(difference);
        }
    }
    measured
}

/// Pair of messages of one time.
type Pairs<T> = Vec<(Arc<T>, Arc<T>)>;

/// Messages of both topics at the same times. Where the times never agree, those of the nearest times.
fn pairs<T: Message>(old: &TopicLog, new: &TopicLog) -> Pairs<T> {
    let at: BTreeMap<i64, &Sample> =
        new.samples.iter().map(|sample| (sample.time_ns, sample)).collect();
    let decoded = |old: &Sample, new: &Sample| Some((old.message().ok()?, new.message().ok()?));
    let exact: Pairs<T> =
        old.samples.iter().filter_map(|sample| decoded(sample, at.get(&sample.time_ns)?)).collect();
    if !exact.is_empty() {
        return exact;
    }
    old.samples
        .iter()
        .filter_map(|sample| {
            let before = at.range(..sample.time_ns).next_back();
            let after = at.range(sample.time_ns..).next();
            let nearest = before
                .into_iter()
                .chain(after)
                .min_by_key(|(time_ns, _)| (**time_ns - sample.time_ns).abs())?;
            decoded(sample, nearest.1)
        })
        .collect()
}

fn scans(pairs: &Pairs<LaserScan>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    let numbers = |scan: &LaserScan| {
        [
            ("angle_min", scan.angle_min),
            ("angle_max", scan.angle_max),
            ("angle_increment", scan.angle_increment),
            ("range_min", scan.range_min),
            ("range_max", scan.range_max),
        ]
    };
    for ((name, old), (_, new)) in numbers(old).into_iter().zip(numbers(new)) {
        if (old - new).abs() > 1e-5 {
            measured.differs(TopicAspect::Fields, format!("{name} {old} and {new}"));
        }
    }
    if old.ranges.len() != new.ranges.len() {
        let text = format!("{} and {} beams", old.ranges.len(), new.ranges.len());
        return measured.differs(TopicAspect::Fields, text);
    }
    let (mut largest_m, mut missed, mut count) = (0.0_f64, 0_usize, 0_usize);
    for (old, new) in pairs {
        for (old, new) in old.ranges.iter().zip(&new.ranges) {
            count += 1;
            match (old.is_finite(), new.is_finite()) {
                (true, true) => largest_m = largest_m.max(f64::from((old - new).abs())),
                (false, false) => {}
                _ => missed += 1,
            }
        }
    }
    measured.deviates("ranges", largest_m, SCAN_TOLERANCE_M, "m");
    #[expect(clippy::cast_precision_loss, reason = "a run has less than 2^53 beams")]
    let fraction = missed as f64 / count.max(1) as f64;
    if fraction > MISSED_BEAMS_TOLERANCE_FRACTION {
        let text = format!("{missed} of {count} beams hit in one of both only");
        measured.differs(TopicAspect::Values, text);
    }
}

fn odometry(pairs: &Pairs<Odometry>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(
        &format!("{} -> {}", old.header.frame_id, old.child_frame_id),
        &format!("{} -> {}", new.header.frame_id, new.child_frame_id),
    );
    if old.pose.covariance != new.pose.covariance || old.twist.covariance != new.twist.covariance {
        measured.differs(TopicAspect::Fields, "covariances".to_owned());
    }
    let position = |odometry: &Odometry| {
        let point = &odometry.pose.pose.position;
        [point.x, point.y, point.z]
    };
    let yaw = |odometry: &Odometry| yaw(&odometry.pose.pose.orientation);
    let (mut way_m, mut turn_rad) = (0.0, 0.0);
    let (mut largest_m, mut largest_rad) = (0.0_f64, 0.0_f64);
    for pair in pairs.windows(2) {
        way_m += distance(position(&pair[0].0), position(&pair[1].0));
        turn_rad += normalize_angle(yaw(&pair[1].0) - yaw(&pair[0].0)).abs();
    }
    for (old, new) in pairs {
        largest_m = largest_m.max(distance(position(old), position(new)));
        largest_rad = largest_rad.max(normalize_angle(yaw(old) - yaw(new)).abs());
    }
    let percent = |largest: f64, whole: f64, least: f64| 100.0 * largest / whole.max(least);
    let tolerance = ODOMETRY_TOLERANCE_PERCENT;
    measured.deviates("position", percent(largest_m, way_m, MIN_DISTANCE_M), tolerance, "%");
    measured.deviates("heading", percent(largest_rad, turn_rad, MIN_ROTATION_RAD), tolerance, "%");
}

fn inertial(pairs: &Pairs<Imu>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    let covariances = |imu: &Imu| {
        (
            imu.orientation_covariance,
            imu.angular_velocity_covariance,
            imu.linear_acceleration_covariance,
        )
    };
    if covariances(old) != covariances(new) {
        measured.differs(TopicAspect::Fields, "covariances".to_owned());
    }
    let (mut turn, mut angle) = (0.0_f64, 0.0_f64);
    let mut sums = [[0.0; 3]; 2];
    for (old, new) in pairs {
        turn = turn.max(distance(array(&old.angular_velocity), array(&new.angular_velocity)));
        angle = angle.max(angle_between(&old.orientation, &new.orientation));
        for (sum, imu) in sums.iter_mut().zip([old, new]) {
            for (sum, value) in sum.iter_mut().zip(array(&imu.linear_acceleration)) {
                *sum += value;
            }
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "a run has less than 2^53 messages")]
    let mean = distance(sums[0], sums[1]) / pairs.len() as f64;
    measured.deviates("orientation", angle, ORIENTATION_TOLERANCE_RAD, "rad");
    measured.deviates("angular velocity", turn, TURN_RATE_TOLERANCE_RAD_S, "rad/s");
    measured.deviates("mean acceleration", mean, ACCELERATION_TOLERANCE_M_S2, "m/s^2");
}

fn joint_states(pairs: &Pairs<JointState>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    let names = |state: &JointState| state.name.iter().cloned().collect::<BTreeSet<_>>();
    if names(old) != names(new) {
        let text = format!("joints {} and {}", old.name.join(" "), new.name.join(" "));
        measured.differs(TopicAspect::Fields, text);
    }
    if old.effort.is_empty() != new.effort.is_empty()
        || old.velocity.is_empty() != new.velocity.is_empty()
    {
        let words = |state: &JointState| {
            format!("{} velocities, {} efforts", state.velocity.len(), state.effort.len())
        };
        measured.differs(TopicAspect::Fields, format!("{} and {}", words(old), words(new)));
    }
    let position = |state: &JointState, name: &str| {
        let index = state.name.iter().position(|known| known == name)?;
        state.position.get(index).copied()
    };
    let mut worst = 0.0_f64;
    for name in &old.name {
        let (mut way, mut largest, mut before) = (0.0, 0.0_f64, None::<f64>);
        for (old, new) in pairs {
            let (Some(old), Some(new)) = (position(old, name), position(new, name)) else {
                continue;
            };
            way += before.map_or(0.0, |before| (old - before).abs());
            before = Some(old);
            largest = largest.max((old - new).abs());
        }
        worst = worst.max(100.0 * largest / f64::max(way, 1.0));
    }
    measured.deviates("positions", worst, ODOMETRY_TOLERANCE_PERCENT, "%");
}

/// Transforms differ in how many are in a message; the pairs of frames count.
fn transforms(old: &TopicLog, new: &TopicLog, measured: &mut Measured) {
    let frames = |log: &TopicLog| {
        let mut frames = BTreeSet::new();
        for message in log.samples.iter().filter_map(|sample| sample.message::<TFMessage>().ok()) {
            for transform in &message.transforms {
                frames.insert(format!(
                    "{} -> {}",
                    transform.header.frame_id, transform.child_frame_id
                ));
            }
        }
        frames
    };
    let [old, new] = [frames(old), frames(new)];
    measured.pairs = old.intersection(&new).count();
    measured.frames = [format!("{} transforms", old.len()), format!("{} transforms", new.len())];
    let list =
        |frames: BTreeSet<&String>| frames.into_iter().cloned().collect::<Vec<_>>().join(", ");
    let (missing, added) =
        (list(old.difference(&new).collect()), list(new.difference(&old).collect()));
    if !missing.is_empty() {
        measured.differs(TopicAspect::Frame, format!("missing transforms: {missing}"));
    }
    if !added.is_empty() {
        measured.differs(TopicAspect::Frame, format!("further transforms: {added}"));
    }
}

fn camera_infos(pairs: &Pairs<CameraInfo>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    if (old.width, old.height) != (new.width, new.height) {
        let text = format!("{}x{} and {}x{} pixels", old.width, old.height, new.width, new.height);
        measured.differs(TopicAspect::Values, text);
    }
    let close = |old: &[f64], new: &[f64]| {
        old.len() == new.len() && old.iter().zip(new).all(|(old, new)| (old - new).abs() < 1e-6)
    };
    for (name, is_close) in [
        ("d", close(&old.d, &new.d)),
        ("k", close(&old.k, &new.k)),
        ("r", close(&old.r, &new.r)),
        ("p", close(&old.p, &new.p)),
    ] {
        if !is_close {
            measured.differs(TopicAspect::Fields, format!("`{name}`"));
        }
    }
    // The focal length decides where pixels look; the principal point follows other rules.
    let focal = (old.k[0] - new.k[0]).abs();
    measured.deviates("focal length", focal, 1e-3, "px");
}

fn images(pairs: &Pairs<Image>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    if old.encoding != new.encoding {
        let text = format!("encoding {} and {}", old.encoding, new.encoding);
        return measured.differs(TopicAspect::Fields, text);
    }
    if old.data.len() != new.data.len() {
        let text = format!("{}x{} and {}x{} pixels", old.width, old.height, new.width, new.height);
        return measured.differs(TopicAspect::Values, text);
    }
    if old.encoding == "32FC1" {
        let depths = |image: &Image| -> Vec<f32> {
            let numbers = image.data.chunks_exact(4);
            numbers
                .map(|bytes| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
                .collect()
        };
        let (mut largest, mut missed) = (0.0_f64, 0_usize);
        for (old, new) in pairs {
            for (old, new) in depths(old).into_iter().zip(depths(new)) {
                match (old.is_finite(), new.is_finite()) {
                    (true, true) => largest = largest.max(f64::from((old - new).abs())),
                    (false, false) => {}
                    _ => missed += 1,
                }
            }
        }
        measured.deviates("depths", largest, SCAN_TOLERANCE_M, "m");
        if missed > 0 {
            measured.differs(
                TopicAspect::Values,
                format!("{missed} pixels have a depth in one of both only"),
            );
        }
        return;
    }
    let mut largest = 0.0_f64;
    for (old, new) in pairs {
        let sum: u64 =
            old.data.iter().zip(new.data.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        #[expect(clippy::cast_precision_loss, reason = "an image has less than 2^44 bytes")]
        let mean = sum as f64 / old.data.len().max(1) as f64;
        largest = largest.max(mean);
    }
    measured.deviates("mean of pixels", largest, PIXEL_TOLERANCE, "of 255");
}

/// Clouds differ in order, axes and density by the conventions of the simulators; the mean distance of their points does
/// not.
fn clouds(pairs: &Pairs<PointCloud2>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    let fields = |cloud: &PointCloud2| {
        let names = cloud.fields.iter().map(|field| field.name.as_str());
        format!(
            "{}x{} points of {}",
            cloud.width,
            cloud.height,
            names.collect::<Vec<_>>().join(" ")
        )
    };
    let [old_fields, new_fields] = [fields(old), fields(new)];
    if old_fields != new_fields {
        measured.differs(TopicAspect::Fields, format!("{old_fields}; {new_fields}"));
    }
    let mut largest = 0.0_f64;
    let mut counts = None;
    for (old, new) in pairs {
        let [(old_count, old_mean), (new_count, new_mean)] =
            [mean_distance(old), mean_distance(new)];
        largest = largest.max((old_mean - new_mean).abs());
        if old_count != new_count {
            counts = Some(format!("{old_count} and {new_count} points with a distance"));
        }
    }
    measured.deviates("mean distance", largest, SCAN_TOLERANCE_M, "m");
    if let Some(text) = counts {
        measured.differs(TopicAspect::Values, text);
    }
}

/// Number of finite points, and their mean distance \[m\].
fn mean_distance(cloud: &sensor_msgs::PointCloud2) -> (usize, f64) {
    let offset = |name: &str| {
        cloud.fields.iter().find(|field| field.name == name).map(|field| field.offset as usize)
    };
    let (Some(x), Some(y), Some(z)) = (offset("x"), offset("y"), offset("z")) else {
        return (0, 0.0);
    };
    let number = |point: &[u8], at: usize| {
        let bytes = point.get(at..at + 4).and_then(|bytes| bytes.first_chunk::<4>());
        bytes.map_or(f64::NAN, |bytes| f64::from(f32::from_le_bytes(*bytes)))
    };
    let (mut count, mut sum) = (0_usize, 0.0);
    for point in cloud.data.chunks_exact((cloud.point_step as usize).max(1)) {
        let [x, y, z] = [number(point, x), number(point, y), number(point, z)];
        let distance = (x * x + y * y + z * z).sqrt();
        if distance.is_finite() {
            count += 1;
            sum += distance;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "a cloud has less than 2^53 points")]
    let mean = sum / count.max(1) as f64;
    (count, mean)
}

fn fixes(pairs: &Pairs<NavSatFix>, measured: &mut Measured) {
    measured.pairs = pairs.len();
    let Some((old, new)) = pairs.first() else { return };
    measured.set_frames(&old.header.frame_id, &new.header.frame_id);
    if old.position_covariance != new.position_covariance {
        measured.differs(TopicAspect::Fields, "covariance".to_owned());
    }
    let degrees = |old: f64, new: f64| (old - new).abs();
    let largest = pairs.iter().fold(0.0_f64, |largest, (old, new)| {
        largest.max(degrees(old.latitude, new.latitude)).max(degrees(old.longitude, new.longitude))
    });
    measured.deviates("latitude and longitude", largest, 1e-6, "deg");
}

/// Messages of other types must be the same bytes.
fn bytes(old: &TopicLog, new: &TopicLog, measured: &mut Measured) {
    let mut differing = 0;
    for (old, new) in old.samples.iter().zip(&new.samples) {
        measured.pairs += 1;
        differing += usize::from(old.cdr().ok() != new.cdr().ok());
    }
    if differing > 0 {
        let text = format!("{differing} of {} messages differ", measured.pairs);
        measured.differs(TopicAspect::Values, text);
    }
}

fn array(vector: &Vector3) -> [f64; 3] {
    [vector.x, vector.y, vector.z]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Heading of a rotation \[rad\].
fn yaw(q: &Quaternion) -> f64 {
    libm::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
}

/// Angle between two rotations \[rad\].
fn angle_between(a: &Quaternion, b: &Quaternion) -> f64 {
    let dot = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    2.0 * libm::acos(dot.abs().min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_wrapped_and_measured() {
        let turned = Quaternion { x: 0.0, y: 0.0, z: 1.0, w: 0.0 };
        assert!((yaw(&turned).abs() - std::f64::consts::PI).abs() < 1e-12);
        assert!(normalize_angle(std::f64::consts::TAU).abs() < 1e-12);
        let identity = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
        assert!((angle_between(&identity, &turned) - std::f64::consts::PI).abs() < 1e-12);
        assert!(angle_between(&turned, &turned) < 1e-7);
    }

    #[test]
    fn scans_that_differ_are_measured_beam_by_beam() {
        let scan = |ranges: &[f32]| {
            Arc::new(LaserScan { ranges: ranges.to_vec(), ..LaserScan::default() })
        };
        let mut measured = Measured::default();
        let far = f32::INFINITY;
        scans(&vec![(scan(&[1.0, far, far]), scan(&[1.5, far, 2.0]))], &mut measured);
        assert!((measured.deviations[0].value - 0.5).abs() < 1e-6);
        assert!(!measured.deviations[0].is_within());
        assert_eq!(measured.differences[0].text, "1 of 3 beams hit in one of both only");
    }
}
