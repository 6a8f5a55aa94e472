//! Comparison of odometry with scan matching: wheel size, scanner mounting, axes, corridors.
//!
//! Between two keyframes odometry measures a motion `o` and scan matching a motion `s`, both in the frame of
//! the base. As complex numbers, a drive with wrong wheel sizes and a scanner with a wrong yaw give `o = z s`
//! with one `z` for all steps: its modulus is the scale, its argument the yaw. Rotations have
//! another ratio. Swapped or negated axes mirror the plane: then steps in the frame of the map satisfy `o = w conj(s)`.

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_geometry::{Pose2, normalize_angle};

use crate::remark::{Remark, RemarkKind};

/// Motion between two keyframes.
pub(crate) struct Step {
    pub(crate) time_ns: i64,
    /// Odometry pose now.
    pub(crate) odom_from_base: Option<Pose2>,
    /// Matched pose relative to the keyframe before.
    pub(crate) keyframe_from_base: Pose2,
    /// Heading of the keyframe before in the map \[rad\].
    pub(crate) heading_rad: f64,
    pub(crate) is_matched: bool,
    /// 1 if walls constrain the pose along all directions, 0 if they leave one free.
    pub(crate) firmness: f64,
}

/// Weight of each step relative to the next.
const FORGETTING_FACTOR: f64 = 0.98;
/// Evidence needed for a verdict: path, rotation, and consecutive steps with the same verdict.
const MIN_PATH_M: f64 = 4.0;
const MIN_ROTATION_RAD: f64 = 2.0;
const MIN_STEPS_COUNT: usize = 10;
/// Minimum fraction of the motion that an explanation must account for; below the second there is none.
const EXPLAINED_RATIO: f64 = 0.9;
const UNEXPLAINED_RATIO: f64 = 0.6;
/// Relative scale errors of distance and rotation, and yaw errors, of ordinary robots.
const DISTANCE_ERROR_RATIO: f64 = 0.04;
const ROTATION_ERROR_RATIO: f64 = 0.06;
const YAW_ERROR_RAD: f64 = 0.1;
/// Longer steps are odometry jumps \[m\].
const JUMP_M: f64 = 3.0;
/// Minimum length of a corridor, and length of path with firm walls that ends one \[m\].
const MIN_CORRIDOR_M: f64 = 5.0;
const CORRIDOR_END_M: f64 = 1.0;
/// Firmness below which walls leave a direction free.
const MIN_FIRMNESS_RATIO: f64 = 0.5;

/// A complex number.
type Number = [f64; 2];

fn times(a: Number, b: Number) -> Number {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn conjugate(a: Number) -> Number {
    [a[0], -a[1]]
}

fn turned(a: Number, angle_rad: f64) -> Number {
    let (s, c) = libm::sincos(angle_rad);
    times(a, [c, s])
}

/// Sums for `o = z s`.
#[derive(Clone, Copy, Default)]
struct Fit {
    product: Number,
    odometry: f64,
    scans: f64,
}

impl Fit {
    fn add(&mut self, o: Number, s: Number) {
        let product = times(o, conjugate(s));
        for (sum, part) in self.product.iter_mut().zip(product) {
            *sum = FORGETTING_FACTOR * *sum + part;
        }
        self.odometry = FORGETTING_FACTOR * self.odometry + o[0] * o[0] + o[1] * o[1];
        self.scans = FORGETTING_FACTOR * self.scans + s[0] * s[0] + s[1] * s[1];
    }

    fn scale(&self) -> f64 {
        libm::hypot(self.product[0], self.product[1]) / self.scans.max(1e-12)
    }

    fn angle_rad(&self) -> f64 {
        libm::atan2(self.product[1], self.product[0])
    }

    /// Fraction of the motion that `z` explains: the squared correlation.
    fn explained(&self) -> f64 {
        let [x, y] = self.product;
        (x * x + y * y) / (self.odometry * self.scans).max(1e-18)
    }
}

/// Evidence and remarks so far.
#[derive(Default)]
pub(crate) struct OdometryDiagnostics {
    /// Odometry pose at the last keyframe.
    before: Option<Pose2>,
    /// Steps in the frame of the base; steps in the frame of the map, mirrored; rotations.
    direct: Fit,
    mirrored: Fit,
    rotations: Fit,
    path_m: f64,
    rotation_rad: f64,
    /// Verdict on the last steps, and their number.
    verdict: Option<(KindTag, usize)>,
    /// Kinds of remark already made.
    made: Vec<KindTag>,
    /// Path along a corridor, and since its walls constrain the pose again \[m\].
    corridor_m: f64,
    firm_m: f64,
    pub(crate) remarks: Vec<Remark>,
}

/// Kinds of which there is one remark at most.
type KindTag = std::mem::Discriminant<RemarkKind>;

impl OdometryDiagnostics {
    /// Starts a component of the map.
    pub(crate) fn begin(&mut self, odom_from_base: Option<Pose2>) {
        self.before = odom_from_base;
    }

    /// Adds a remark of another part of the program.
    pub(crate) fn remark(&mut self, time_ns: i64, kind: RemarkKind) {
        self.remarks.push(Remark { time_ns, kind });
    }

    /// Updates the evidence with a new keyframe.
    pub(crate) fn update(&mut self, step: &Step) {
        let before = std::mem::replace(&mut self.before, step.odom_from_base);
        let found = step.keyframe_from_base;
        let metres = libm::hypot(found.x_m, found.y_m);
        self.update_corridor(step, metres);
        let (Some(before), Some(now)) = (before, step.odom_from_base) else { return };
        let measured = before.inverse() * now;
        let jumped = libm::hypot(measured.x_m, measured.y_m) > JUMP_M;
        if jumped || !step.is_matched {
            return;
        }
        let (t, u) = (normalize_angle(measured.yaw_rad), normalize_angle(found.yaw_rad));
        self.rotations.add([t, 0.0], [u, 0.0]);
        self.rotation_rad = FORGETTING_FACTOR * self.rotation_rad + u.abs();
        // Along a corridor the matched distance is that of odometry.
        if step.firmness > MIN_FIRMNESS_RATIO {
            let (o, s) = ([measured.x_m, measured.y_m], [found.x_m, found.y_m]);
            self.direct.add(o, s);
            let (o, s) = (turned(o, before.yaw_rad), turned(s, step.heading_rad));
            self.mirrored.add(o, conjugate(s));
            self.path_m = FORGETTING_FACTOR * self.path_m + metres;
        }
        self.judge(step.time_ns);
    }

    /// Adds a remark after enough steps with the same verdict.
    fn judge(&mut self, time_ns: i64) {
        let Some(kind) = self.first_verdict() else {
            self.verdict = None;
            return;
        };
        let tag = std::mem::discriminant(&kind);
        let steps = match self.verdict {
            Some((last, steps)) if last == tag => steps + 1,
            _ => 1,
        };
        self.verdict = Some((tag, steps));
        if steps >= MIN_STEPS_COUNT {
            self.made.push(tag);
            self.verdict = None;
            self.remarks.push(Remark { time_ns, kind });
        }
    }

    /// First verdict that holds now and has no remark yet.
    fn first_verdict(&self) -> Option<RemarkKind> {
        let is_new = |it: &RemarkKind| !self.made.contains(&std::mem::discriminant(it));
        self.verdicts().into_iter().find(is_new)
    }

    /// Remarks that still hold, with the time at which they were made.
    pub(crate) fn holding(&self) -> Vec<Remark> {
        let made = |kind: RemarkKind| {
            let tag = std::mem::discriminant(&kind);
            let is_it = |it: &&Remark| std::mem::discriminant(&it.kind) == tag;
            let remark = self.remarks.iter().rev().find(is_it)?;
            Some(Remark { time_ns: remark.time_ns, kind })
        };
        self.verdicts().into_iter().filter_map(made).collect()
    }

    /// All verdicts that hold now.
    fn verdicts(&self) -> Vec<RemarkKind> {
        let mut verdicts = Vec::new();
        let has_rotated = self.rotation_rad > MIN_ROTATION_RAD;
        let ratio = self.rotations.product[0] / self.rotations.scans.max(1e-12);
        let rotations_fit = has_rotated && self.rotations.explained() > EXPLAINED_RATIO;
        let is_opposite = rotations_fit && ratio < 0.0;
        if self.path_m < MIN_PATH_M {
            if is_opposite {
                verdicts.push(RemarkKind::ScanMirrored);
            }
            return verdicts;
        }
        let (direct, mirrored) = (self.direct.explained(), self.mirrored.explained());
        let angle_rad = self.direct.angle_rad();
        let scale = self.direct.scale();
        // Both explanations fit while the robot has only driven in one direction.
        if !is_opposite && mirrored > EXPLAINED_RATIO && direct < UNEXPLAINED_RATIO {
            // o = w conj(s): w is i when x and y are swapped, 1 when y has the wrong sign.
            let angle_rad = self.mirrored.angle_rad();
            verdicts.push(if angle_rad.abs() < 0.5 {
                RemarkKind::OdometryYNegated
            } else if (angle_rad - FRAC_PI_2).abs() < 0.5 {
                RemarkKind::OdometryAxesSwapped
            } else if angle_rad.abs() > PI - 0.5 {
                RemarkKind::OdometryXNegated
            } else {
                RemarkKind::OdometryInconsistent
            });
        } else if direct > EXPLAINED_RATIO {
            let is_backwards = angle_rad.abs() > PI - 0.3;
            if is_opposite {
                verdicts.push(if is_backwards {
                    RemarkKind::OdometryReversed
                } else {
                    RemarkKind::ScanMirrored
                });
            } else if angle_rad.abs() > YAW_ERROR_RAD && mirrored < UNEXPLAINED_RATIO {
                verdicts.push(RemarkKind::ScannerYaw(angle_rad));
            }
            if (scale - 1.0).abs() > DISTANCE_ERROR_RATIO {
                verdicts.push(RemarkKind::DistanceScale(scale));
            }
            if rotations_fit && !is_opposite && (ratio - 1.0).abs() > ROTATION_ERROR_RATIO {
                verdicts.push(RemarkKind::RotationScale(ratio, scale));
            }
        } else if direct < UNEXPLAINED_RATIO && mirrored < UNEXPLAINED_RATIO {
            verdicts.push(RemarkKind::OdometryInconsistent);
        }
        verdicts
    }

    /// Tracks corridors: path along which walls leave one direction free.
    fn update_corridor(&mut self, step: &Step, distance_m: f64) {
        if step.is_matched && step.firmness < MIN_FIRMNESS_RATIO {
            self.corridor_m += self.firm_m + distance_m;
            self.firm_m = 0.0;
            return;
        }
        self.firm_m += distance_m;
        if self.firm_m > CORRIDOR_END_M {
            self.leave_corridor(step.time_ns);
        }
    }

    /// Ends a corridor, with a remark if it was long enough.
    pub(crate) fn leave_corridor(&mut self, time_ns: i64) {
        let metres = std::mem::take(&mut self.corridor_m);
        self.firm_m = 0.0;
        if metres >= MIN_CORRIDOR_M {
            self.remarks.push(Remark { time_ns, kind: RemarkKind::Corridor(metres) });
        }
    }
}
