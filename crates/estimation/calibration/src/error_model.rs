//! Random errors of odometry, and their prediction for another drive.

use periplus_geometry::{Pose2, Stream};

use crate::estimated::Estimated;
use crate::segments::{OdometryPath, ReferencedOdometry, TERM_COUNT, Terms, squared_errors};

/// Lengths of segments \[m\].
const LENGTHS_M: [f64; 9] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

/// Number of lengths in a model: the longest with enough segments.
const LENGTH_COUNT: usize = 3;

/// Minimum number of segments in the path, side by side: the root mean square of 30 normal errors has a
/// standard error of 13 %.
const MIN_SEGMENT_COUNT: f64 = 30.0;

/// Part of the largest errors of a length that is limited to the next one in the fit of the terms; the root mean
/// squares of the drive contain them.
const WINSORIZED_RATIO: f64 = 0.01;

/// Part of the errors of a length, from the smallest, that is in the trimmed root mean square.
const TRIMMED_RATIO: f64 = 0.95;

/// Minimum expected square relative to the mean of its length, for the weights of a fit.
const MIN_EXPECTED_RATIO: f64 = 0.05;

/// Number of rounds of weights, and of sweeps over the coordinates in a round.
const ROUND_COUNT: usize = 6;
const SWEEP_COUNT: usize = 2000;

/// Number of repetitions of the bootstrap, and the length of its blocks relative to the longest segment.
const REPETITION_COUNT: u64 = 200;
const BLOCK_RATIO: f64 = 2.0;

/// Error of odometry relative to a reference over segments of a length, which begin anywhere in a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeError {
    /// Length of the segments along the path \[m\].
    pub length_m: f64,
    /// Root mean square of the position error at the end \[m\].
    pub rms_m: Estimated,
    /// Root mean square of the heading error at the end \[rad\].
    pub rms_rad: Estimated,
    /// As `rms_m`, without the largest 5 % of the errors. A few slips, gaps of the recording or faults of the
    /// reference decide the whole root mean square, and no model knows when they come again.
    pub trimmed_rms_m: Estimated,
    /// As `rms_rad`, without the largest 5 %.
    pub trimmed_rms_rad: Estimated,
    /// Number of segments, which overlap.
    pub segment_count: usize,
}

/// Model of the errors of odometry in a drive.
///
/// The expected squares of heading and position errors over a segment are sums of eight terms with
/// coefficients that are not negative:
///
/// - heading: `c0 + c1 D + c2 R + c3 Θ² + c4 D²` with length D, sum of rotations R, and net rotation Θ
/// - position: `c1 Σ d l² + c2 Σ r l² + c3 |Σ θ l|² + c4 |Σ d l|² + c5 + c6 D + c7 R` with the lever arm l from each
///   step (length d, rotation θ, r = |θ|) to the end of the segment
///
/// `c1` and `c2` are the random walk of the heading (Chong and Kleeman 1997, "Accurate odometry and error
/// modelling for a mobile robot"; Martinelli 2002, "The odometry error of a mobile robot with a synchronous drive
/// system"), `c3` and `c4` errors that persist over a segment: what the calibration left, surfaces, load. `c6` and `c7` are
/// slip along the path, `c0` and `c5` the errors of the reference at both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct OdometryErrorModel {
    /// Coefficients `c0` to `c7`.
    pub coefficients: [f64; TERM_COUNT],
    /// Errors of the drive that the model was fitted to.
    pub fitted: Vec<RelativeError>,
    path_m: f64,
    lengths: Vec<LengthSums>,
    /// The same of each repetition of the bootstrap.
    repetitions: Vec<(Vec<LengthSums>, [f64; TERM_COUNT])>,
}

/// Means over the segments of a length.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LengthSums {
    /// Mean squares of position and heading errors, then those of the smallest 95 %.
    squares: [f64; STATISTIC_COUNT],
    terms: Terms,
}

/// Number of statistics of a length: position and heading, of all errors and trimmed.
const STATISTIC_COUNT: usize = 4;

/// Segment with its terms and errors.
struct Sample {
    block: usize,
    length: usize,
    terms: Terms,
    squares: [f64; 2],
    /// With the largest limited.
    limited: [f64; 2],
}

impl OdometryErrorModel {
    /// Fits the model to a drive, at the three longest of the lengths 0.1, 0.2, 0.5, 1, ... 50 m of which the path has
    /// at least 30 side by side. None if the path is shorter than 30 times 0.1 m.
    ///
    /// Squares of errors are weighted by the inverse of their expected value, as the likelihood of
    /// normal errors has it. The standard errors are of a bootstrap over blocks of the path.
    #[must_use]
    pub fn fit(pairs: &[ReferencedOdometry]) -> Option<Self> {
        let poses: Vec<Pose2> = pairs.iter().map(|it| it.odom_from_base).collect();
        let path = OdometryPath::new(&poses);
        let lengths_m = lengths_m(path.length_m())?;
        let samples = samples(pairs, &path, &lengths_m);
        let found = all_of(sums(&samples, &vec![1.0; samples.len()], lengths_m.len()))?;
        let (coefficients, weights) = fit(&samples, &found);
        let block_count = samples.iter().map(|it| it.block + 1).max().unwrap_or(1);
        let blocks = blocks(&samples, &weights, block_count);
        let repeat = |number: u64| {
            let counts = block_counts(0, number, block_count);
            let mut equations = Equations::default();
            for (block, count) in blocks.iter().zip(&counts) {
                equations.add(block, *count);
            }
            let factors: Vec<f64> = samples.iter().map(|it| counts[it.block]).collect();
            let sums = all_of(sums(&samples, &factors, lengths_m.len()))?;
            Some((sums, equations.solve()))
        };
        let repetitions: Vec<_> = (0..REPETITION_COUNT).filter_map(repeat).collect();
        let fitted = lengths_m.iter().enumerate().map(|(index, &length_m)| {
            let rms = |statistic: usize| Estimated {
                value: found[index].squares[statistic].sqrt(),
                standard_error: deviation(
                    repetitions.iter().map(|it| it.0[index].squares[statistic].sqrt()),
                ),
            };
            RelativeError {
                length_m,
                rms_m: rms(0),
                rms_rad: rms(1),
                trimmed_rms_m: rms(2),
                trimmed_rms_rad: rms(3),
                segment_count: samples.iter().filter(|it| it.length == index).count(),
            }
        });
        Some(Self {
            coefficients,
            fitted: fitted.collect(),
            path_m: path.length_m(),
            lengths: found,
            repetitions,
        })
    }

    /// Returns the errors that are expected in another drive with these poses by odometry: those of the fitted
    /// drive, times the root of the ratio of the model's expected squares in both. Lengths that the drive is too
    /// short for are left out.
    ///
    /// The standard error is that of the difference to a measurement: of the fit, and of the sampling of the other
    /// drive in proportion to the lengths of both.
    #[must_use]
    pub fn predict(&self, odometry: &[Pose2]) -> Vec<RelativeError> {
        let path = OdometryPath::new(odometry);
        let shortest_m = self.fitted.first().map_or(1.0, |it| it.length_m);
        let predict = |(index, fitted): (usize, &RelativeError)| {
            let segments = path.segments(fitted.length_m, shortest_m);
            let terms = mean_terms(segments.iter().map(|it| path.terms(it)))?;
            let rms = |statistic: usize, rms: Estimated| {
                let kind = statistic % 2;
                let at = |sums: &LengthSums, coefficients: &[f64; TERM_COUNT]| {
                    let ratio = expected(&terms, kind, coefficients)
                        / expected(&sums.terms, kind, coefficients);
                    let ratio = if ratio.is_finite() { ratio } else { 1.0 };
                    (sums.squares[statistic] * ratio).sqrt()
                };
                let value = at(&self.lengths[index], &self.coefficients);
                let fit = deviation(self.repetitions.iter().map(|it| at(&it.0[index], &it.1)));
                let sampling = if rms.value > 0.0 {
                    value * rms.standard_error / rms.value * (self.path_m / path.length_m()).sqrt()
                } else {
                    0.0
                };
                Estimated { value, standard_error: libm::hypot(fit, sampling) }
            };
            Some(RelativeError {
                length_m: fitted.length_m,
                rms_m: rms(0, fitted.rms_m),
                rms_rad: rms(1, fitted.rms_rad),
                trimmed_rms_m: rms(2, fitted.trimmed_rms_m),
                trimmed_rms_rad: rms(3, fitted.trimmed_rms_rad),
                segment_count: segments.len(),
            })
        };
        self.fitted.iter().enumerate().filter_map(predict).collect()
    }

    /// Returns the errors in another drive at the lengths of the model, with standard errors of a bootstrap over
    /// that drive. Lengths that it is too short for are left out.
    #[must_use]
    pub fn measure(&self, pairs: &[ReferencedOdometry]) -> Vec<RelativeError> {
        let poses: Vec<Pose2> = pairs.iter().map(|it| it.odom_from_base).collect();
        let path = OdometryPath::new(&poses);
        let lengths_m: Vec<f64> = self.fitted.iter().map(|it| it.length_m).collect();
        let samples = samples(pairs, &path, &lengths_m);
        let block_count = samples.iter().map(|it| it.block + 1).max().unwrap_or(1);
        let repeat = |number: u64| {
            let counts = block_counts(1, number, block_count);
            let factors: Vec<f64> = samples.iter().map(|it| counts[it.block]).collect();
            sums(&samples, &factors, lengths_m.len())
        };
        let repetitions: Vec<_> = (0..REPETITION_COUNT).map(repeat).collect();
        let all = sums(&samples, &vec![1.0; samples.len()], lengths_m.len());
        let measure = |(index, &length_m): (usize, &f64)| {
            let found = all[index]?;
            let rms = |statistic: usize| {
                let repeated = repetitions
                    .iter()
                    .filter_map(|it| it[index].map(|it| it.squares[statistic].sqrt()));
                Estimated {
                    value: found.squares[statistic].sqrt(),
                    standard_error: deviation(repeated),
                }
            };
            Some(RelativeError {
                length_m,
                rms_m: rms(0),
                rms_rad: rms(1),
                trimmed_rms_m: rms(2),
                trimmed_rms_rad: rms(3),
                segment_count: samples.iter().filter(|it| it.length == index).count(),
            })
        };
        lengths_m.iter().enumerate().filter_map(measure).collect()
    }
}

/// Lengths of the segments for a path.
fn lengths_m(path_m: f64) -> Option<Vec<f64>> {
    let count = LENGTHS_M.iter().filter(|it| path_m >= MIN_SEGMENT_COUNT * **it).count();
    let first = count.saturating_sub(LENGTH_COUNT);
    (count > 0).then(|| LENGTHS_M[first..count].to_vec())
}

fn samples(
    pairs: &[ReferencedOdometry],
    path: &OdometryPath<'_>,
    lengths_m: &[f64],
) -> Vec<Sample> {
    let (Some(&shortest_m), Some(&longest_m)) = (lengths_m.first(), lengths_m.last()) else {
        return Vec::new();
    };
    let block_m = BLOCK_RATIO * longest_m;
    let mut samples = Vec::new();
    for (length, &length_m) in lengths_m.iter().enumerate() {
        let segments = path.segments(length_m, shortest_m);
        let squares: Vec<[f64; 2]> = segments.iter().map(|it| squared_errors(pairs, it)).collect();
        let limits = [0, 1].map(|kind| limit(squares.iter().map(|it| it[kind])));
        samples.extend(segments.iter().zip(squares).map(|(segment, squares)| Sample {
            block: (segment.start_m / block_m) as usize,
            length,
            terms: path.terms(segment),
            squares,
            limited: [squares[0].min(limits[0]), squares[1].min(limits[1])],
        }));
    }
    samples
}

/// Largest square that is not limited.
fn limit(squares: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = squares.collect();
    sorted.sort_by(f64::total_cmp);
    let index = ((1.0 - WINSORIZED_RATIO) * sorted.len().saturating_sub(1) as f64) as usize;
    sorted.get(index).copied().unwrap_or(f64::INFINITY)
}

/// Weighted means of each length; none of a length without weight.
fn sums(samples: &[Sample], weights: &[f64], count: usize) -> Vec<Option<LengthSums>> {
    let mean = |length: usize| {
        let of_length = || samples.iter().zip(weights).filter(move |(it, _)| it.length == length);
        let total: f64 = of_length().map(|(_, weight)| weight).sum();
        let mut terms = Terms { position: [0.0; TERM_COUNT], heading: [0.0; TERM_COUNT] };
        for (it, weight) in of_length() {
            for term in 0..TERM_COUNT {
                terms.position[term] += weight / total * it.terms.position[term];
                terms.heading[term] += weight / total * it.terms.heading[term];
            }
        }
        let squares = std::array::from_fn(|statistic| {
            let ratio = if statistic < 2 { 1.0 } else { TRIMMED_RATIO };
            let squares = of_length().map(|(it, weight)| (it.squares[statistic % 2], *weight));
            trimmed_mean(squares.collect(), ratio * total)
        });
        (total > 0.0).then_some(LengthSums { squares, terms })
    };
    (0..count).map(mean).collect()
}

fn all_of(sums: Vec<Option<LengthSums>>) -> Option<Vec<LengthSums>> {
    sums.into_iter().collect()
}

/// Mean of the smallest values, up to a sum of their weights.
fn trimmed_mean(mut values: Vec<(f64, f64)>, max_weight: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut sum, mut total) = (0.0, 0.0);
    for (value, weight) in values {
        let weight = weight.min(max_weight - total);
        sum += weight * value;
        total += weight;
        if total >= max_weight {
            break;
        }
    }
    sum / total
}

/// Number of times that each block is drawn in a repetition of the bootstrap.
fn block_counts(seed: u64, number: u64, block_count: usize) -> Vec<f64> {
    let mut stream = Stream::keyed(seed, "odometry_error_model", number);
    let mut counts = vec![0.0; block_count];
    for _ in 0..block_count {
        let block = (stream.unit() * block_count as f64) as usize;
        counts[block.min(block_count - 1)] += 1.0;
    }
    counts
}

fn mean_terms(terms: impl Iterator<Item = Terms>) -> Option<Terms> {
    let mut count = 0.0;
    let mut sum = Terms { position: [0.0; TERM_COUNT], heading: [0.0; TERM_COUNT] };
    for it in terms {
        count += 1.0;
        for term in 0..TERM_COUNT {
            sum.position[term] += it.position[term];
            sum.heading[term] += it.heading[term];
        }
    }
    sum.position.iter_mut().chain(&mut sum.heading).for_each(|it| *it /= count);
    (count > 0.0).then_some(sum)
}

/// Expected square of the position (0) or heading (1).
fn expected(terms: &Terms, kind: usize, coefficients: &[f64; TERM_COUNT]) -> f64 {
    row(terms, kind).iter().zip(coefficients).map(|(term, it)| term * it).sum()
}

fn row(terms: &Terms, kind: usize) -> &[f64; TERM_COUNT] {
    if kind == 0 { &terms.position } else { &terms.heading }
}

/// Coefficients, and the weights of the last round for position and heading of each sample.
fn fit(samples: &[Sample], sums: &[LengthSums]) -> ([f64; TERM_COUNT], Vec<[f64; 2]>) {
    let mut counts = vec![0.0; sums.len()];
    samples.iter().for_each(|it| counts[it.length] += 1.0);
    let mut coefficients = None;
    let mut weights = Vec::new();
    for _ in 0..ROUND_COUNT {
        // The lengths have the same weight, as their segments overlap.
        let weight = |it: &Sample, kind: usize| {
            let mean = sums[it.length].squares[kind].max(f64::MIN_POSITIVE);
            let square = coefficients.map_or(mean, |coefficients| {
                expected(&it.terms, kind, &coefficients).max(MIN_EXPECTED_RATIO * mean)
            });
            1.0 / (square * square * counts[it.length])
        };
        weights = samples.iter().map(|it| [weight(it, 0), weight(it, 1)]).collect();
        let mut equations = Equations::default();
        for (it, weights) in samples.iter().zip(&weights) {
            equations.take(it, weights);
        }
        coefficients = Some(equations.solve());
    }
    (coefficients.unwrap_or_default(), weights)
}

fn blocks(samples: &[Sample], weights: &[[f64; 2]], count: usize) -> Vec<Equations> {
    let mut blocks = vec![Equations::default(); count];
    for (it, weights) in samples.iter().zip(weights) {
        blocks[it.block].take(it, weights);
    }
    blocks
}

/// Normal equations of least squares.
#[derive(Clone, Default)]
struct Equations {
    normal: [[f64; TERM_COUNT]; TERM_COUNT],
    right: [f64; TERM_COUNT],
}

impl Equations {
    fn take(&mut self, sample: &Sample, weights: &[f64; 2]) {
        for (kind, weight) in weights.iter().enumerate() {
            let row = row(&sample.terms, kind);
            for i in 0..TERM_COUNT {
                self.right[i] += weight * row[i] * sample.limited[kind];
                for j in 0..TERM_COUNT {
                    self.normal[i][j] += weight * row[i] * row[j];
                }
            }
        }
    }

    fn add(&mut self, other: &Self, factor: f64) {
        for i in 0..TERM_COUNT {
            self.right[i] += factor * other.right[i];
            for j in 0..TERM_COUNT {
                self.normal[i][j] += factor * other.normal[i][j];
            }
        }
    }

    /// Least squares without negative parts, by descent along the coordinates.
    fn solve(&self) -> [f64; TERM_COUNT] {
        let mut parts = [0.0; TERM_COUNT];
        for _ in 0..SWEEP_COUNT {
            for i in 0..TERM_COUNT {
                let diagonal = self.normal[i][i];
                if diagonal > 0.0 {
                    let all: f64 =
                        self.normal[i].iter().zip(&parts).map(|(it, part)| it * part).sum();
                    let others = all - diagonal * parts[i];
                    parts[i] = ((self.right[i] - others) / diagonal).max(0.0);
                }
            }
        }
        parts
    }
}

/// Standard deviation.
fn deviation(values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    let count = values.len().max(2) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / (count - 1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drives in steps of 0.1 m with rotations of up to `turn_rad`, whose heading has a random walk of 0.01 per root of a
    /// metre and 0.05 per root of a radian, and whose distance has one of 0.01 per root of a metre.
    fn drive(name: &str, path_m: f64, turn_rad: f64) -> Vec<ReferencedOdometry> {
        let mut stream = Stream::keyed(5, name, 0);
        let (mut odom, mut map) = (Pose2::IDENTITY, Pose2::IDENTITY);
        let (step_m, count) = (0.1, (path_m / 0.1) as usize);
        let pair = |index: usize| {
            let turn = turn_rad * libm::sin(0.05 * index as f64);
            let heading = (1e-4 * step_m + 2.5e-3 * turn.abs()).sqrt() * stream.normal();
            let along = 1e-2 * step_m.sqrt() * stream.normal();
            map = map * Pose2::new(step_m, 0.0, turn);
            odom = odom * Pose2::new(step_m + along, 0.0, turn + heading);
            ReferencedOdometry { stamp_s: index as f64, odom_from_base: odom, map_from_base: map }
        };
        (0..count).map(pair).collect()
    }

    #[test]
    fn errors_of_a_drive_with_more_turns_are_predicted() {
        let (calm, wild) = (drive("calm", 400.0, 0.02), drive("wild", 400.0, 0.15));
        let model = OdometryErrorModel::fit(&calm).unwrap();
        let odometry: Vec<Pose2> = wild.iter().map(|it| it.odom_from_base).collect();
        let (expected, measured) = (model.predict(&odometry), model.measure(&wild));
        let lengths: Vec<f64> = expected.iter().map(|it| it.length_m).collect();
        assert_eq!(lengths, [2.0, 5.0, 10.0]);
        for (index, (expected, measured)) in expected.iter().zip(&measured).enumerate() {
            let ratio = |a: Estimated, b: Estimated| a.value / b.value;
            let heading = ratio(measured.rms_rad, expected.rms_rad);
            let position = ratio(measured.rms_m, expected.rms_m);
            assert!((heading - 1.0).abs() < 0.2, "{expected:?} {measured:?}");
            assert!((position - 1.0).abs() < 0.2, "{expected:?} {measured:?}");
            // Without the terms of rotation it is far off.
            assert!(measured.rms_rad.value > 1.5 * model.fitted[index].rms_rad.value);
        }
    }

    #[test]
    fn standard_errors_are_those_of_other_drives() {
        let mut squares = Vec::new();
        for number in 0..12 {
            let first = drive(&format!("first {number}"), 160.0, 0.1);
            let second = drive(&format!("second {number}"), 160.0, 0.1);
            let model = OdometryErrorModel::fit(&first).unwrap();
            let odometry: Vec<Pose2> = second.iter().map(|it| it.odom_from_base).collect();
            for (expected, measured) in model.predict(&odometry).iter().zip(model.measure(&second))
            {
                for (a, b) in
                    [(expected.rms_m, measured.rms_m), (expected.rms_rad, measured.rms_rad)]
                {
                    squares.push(libm::pow((a.value - b.value) / a.standard_error, 2.0));
                }
            }
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        assert!((0.4..2.5).contains(&mean), "{mean}");
    }

    #[test]
    fn a_few_slips_are_not_in_the_trimmed_root_mean_square() {
        assert_eq!(trimmed_mean(vec![(9.0, 1.0), (1.0, 1.0), (3.0, 2.0)], 3.0), 7.0 / 3.0);
        assert_eq!(trimmed_mean(vec![(9.0, 1.0), (1.0, 1.0)], 1.5), 5.5 / 1.5);
        let mut pairs = drive("slip", 400.0, 0.05);
        let before = OdometryErrorModel::fit(&pairs).unwrap().fitted[0];
        // The wheels spin for half a metre.
        for pair in &mut pairs[2000..] {
            pair.odom_from_base = Pose2::new(0.5, 0.0, 0.0) * pair.odom_from_base;
        }
        let after = OdometryErrorModel::fit(&pairs).unwrap().fitted[0];
        let ratio = |a: Estimated, b: Estimated| a.value / b.value;
        assert!(ratio(after.rms_m, before.rms_m) > 1.2);
        assert!(ratio(after.trimmed_rms_m, before.trimmed_rms_m) < 1.05);
    }

    #[test]
    fn short_drives_have_no_model() {
        assert!(OdometryErrorModel::fit(&drive("short", 2.5, 0.1)).is_none());
        assert!(OdometryErrorModel::fit(&[]).is_none());
        let model = OdometryErrorModel::fit(&drive("long", 40.0, 0.1)).unwrap();
        assert_eq!((model.predict(&[]), model.measure(&[])), (Vec::new(), Vec::new()));
    }
}
