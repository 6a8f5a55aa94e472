//! What odometry and scans say of each other: wheels of another size, a scanner that points elsewhere,
//! corridors along which only odometry tells.
//!
//! From one kept scan to the next odometry tells a motion `o` and scans tell a motion `s`, both as
//! seen from the robot. Written as complex numbers, a drive whose wheels are wrongly sized and a
//! scanner that is mounted turned give `o = z s` with one `z` for all steps: its length is the scale,
//! its angle the turn of the scanner. Turns have a ratio of their own. Axes that are swapped or have
//! the wrong sign mirror the plane: then steps as seen from the map follow `o = w conj(s)`.

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_geometry::{Pose2, normalize_angle};

/// Something that a person should know of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// When it was noticed: the stamp of a scan \[ns\].
    pub time_ns: i64,
    /// What.
    pub doubt: Doubt,
}

/// What is doubtful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// Odometry tells so many times the way that scans tell.
    WayScale(f64),
    /// Odometry tells so many times the turn that scans tell; and so many times the way.
    TurnScale(f64, f64),
    /// The scanner points this much further to the left than its transform says \[rad\].
    ScannerTurned(f64),
    /// Turns of odometry have the sign opposite to those of the scans: the scan is mirrored.
    Mirrored,
    /// Odometry goes backwards and turns the other way round.
    Backwards,
    /// `x` and `y` of odometry are swapped.
    AxesSwapped,
    /// `x` of odometry has the wrong sign.
    XNegated,
    /// `y` of odometry has the wrong sign.
    YNegated,
    /// They disagree, and nothing of the above explains it.
    Disagreeing,
    /// For so much way only odometry told how far the robot went \[m\]: walls look the same all along.
    Corridor(f64),
    /// There is no odometry: scans alone tell how the robot moved.
    NoOdometry,
    /// Odometry stood still while scans show so much way \[m\].
    OdometryStill(f64),
    /// Odometry jumped by so much from one scan to the next \[m\].
    OdometryJumped(f64),
    /// So large a share of the scans fits nothing that was seen before.
    Unfitting(f64),
    /// The robot was carried, or a part of the log is missing: scans suddenly fit nothing that was seen
    /// before, and a separate piece of map begins.
    Carried,
    /// No closure has joined so many pieces of map to the rest.
    Unjoined(usize),
    /// Two passes contradict each other around this place of the map \[m\]: so large a share of what both
    /// see agrees.
    Contradiction(f64, f64, f64),
    /// Two passes show the same walls side by side around this place of the map \[m\]: so far apart \[m\].
    Offset(f64, f64, f64),
    /// Two places of an earlier pass fit the way around this place of the map \[m\] equally well: so far apart
    /// \[m\].
    Undecided(f64, f64, f64),
    /// Nothing confirms so much of the way through places that were passed before, of so much \[m\].
    Unconfirmed(f64, f64),
    /// The maps of all particles would take too much memory: only so many of them go on.
    FewerMaps(usize),
    /// The best particle's map violates so many closures and ties of the graph, which nothing contradicts:
    /// all particles follow the graph's trajectory.
    GraphFollowed(usize),
}

impl Remark {
    /// Whether the map may be wrong for it; others only tell what to set right, or what limits a map.
    #[must_use]
    pub const fn is_warning(&self) -> bool {
        match self.doubt {
            Doubt::WayScale(_)
            | Doubt::TurnScale(..)
            | Doubt::Corridor(_)
            | Doubt::OdometryJumped(_)
            | Doubt::Carried
            | Doubt::FewerMaps(_)
            | Doubt::GraphFollowed(_) => false,
            Doubt::ScannerTurned(_)
            | Doubt::Mirrored
            | Doubt::Backwards
            | Doubt::AxesSwapped
            | Doubt::XNegated
            | Doubt::YNegated
            | Doubt::Disagreeing
            | Doubt::NoOdometry
            | Doubt::OdometryStill(_)
            | Doubt::Unfitting(_)
            | Doubt::Unjoined(_)
            | Doubt::Contradiction(..)
            | Doubt::Offset(..)
            | Doubt::Undecided(..)
            | Doubt::Unconfirmed(..) => true,
        }
    }
}

impl std::fmt::Display for Remark {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let more = |times: f64| {
            let percent = 100.0 * (times - 1.0).abs();
            format!("{percent:.1} % {}", if times > 1.0 { "more" } else { "less" })
        };
        match self.doubt {
            Doubt::WayScale(times) => write!(
                f,
                "odometry tells {} way than the scans: the wheels' radius is about {:.3} times what \
                 the drive believes",
                more(times),
                1.0 / times
            ),
            Doubt::TurnScale(times, way) => write!(
                f,
                "odometry tells {} turn than the scans: the distance between the wheels is about \
                 {:.3} times what the drive believes",
                more(times),
                times / way
            ),
            Doubt::ScannerTurned(turn) => write!(
                f,
                "the robot moves {:.0} degrees aside from where the scanner thinks is ahead: the \
                 scanner's transform needs a yaw of {:+.0} degrees more, or odometry's x is not ahead",
                turn.abs().to_degrees(),
                turn.to_degrees()
            ),
            Doubt::Mirrored => f.write_str(
                "scans turn to the left when odometry turns to the right: the scan is mirrored (the \
                 scanner hangs upside down and its transform does not say so), or odometry turns \
                 with the wrong sign (left and right wheels swapped)",
            ),
            Doubt::Backwards => f.write_str(
                "odometry goes backwards when the scans go ahead, and turns the other way round: \
                 both wheels are counted with the wrong sign",
            ),
            Doubt::AxesSwapped => f.write_str("x and y of odometry are swapped"),
            Doubt::XNegated => f.write_str("x of odometry has the wrong sign"),
            Doubt::YNegated => f.write_str("y of odometry has the wrong sign"),
            Doubt::Disagreeing => f.write_str(
                "odometry and scans disagree for long, and neither the size of the wheels nor the \
                 mounting of the scanner explains it: look for slipping wheels, wrong time stamps, \
                 or odometry that stands still",
            ),
            Doubt::NoOdometry => f.write_str(
                "there is no odometry: scans alone tell how the robot moved, so that fast turns, bare \
                 corridors and gaps in the log may be drawn wrongly",
            ),
            Doubt::OdometryStill(metres) => write!(
                f,
                "odometry stands still while scans show a way of {metres:.1} m: it is not used until it \
                 moves; look for a drive that does not publish, or a wrong topic"
            ),
            Doubt::OdometryJumped(metres) => write!(
                f,
                "odometry jumped by {metres:.1} m from one scan to the next: that step is not believed"
            ),
            Doubt::Unfitting(share) => write!(
                f,
                "{:.0} % of the scans fit nothing that was seen before: the map is not to be relied on; \
                 look at the scanner's transform, at the stamps, and at readings that come and go",
                100.0 * share
            ),
            Doubt::Carried => f.write_str(
                "scans suddenly fit nothing that was seen before: the robot was carried, or a part of the \
                 log is missing; a separate piece of map begins here, until a closure joins it to the rest",
            ),
            Doubt::Unjoined(1) => f.write_str(
                "no closure joins a piece of the map to the rest: where it lies is not known",
            ),
            Doubt::Unjoined(pieces) => write!(
                f,
                "no closure joins {pieces} pieces of the map to the rest: where they lie is not known"
            ),
            Doubt::Contradiction(x_m, y_m, share) => write!(
                f,
                "two passes contradict each other around ({x_m:.1}, {y_m:.1}) in the map: of what both \
                 see only {:.0} % agree; something has moved there, or the map is wrong",
                100.0 * share
            ),
            Doubt::Offset(x_m, y_m, shift_m) => write!(
                f,
                "two passes show the same walls {shift_m:.2} m apart around ({x_m:.1}, {y_m:.1}) in the \
                 map, and nothing that is sure enough joins them: walls are doubled there, and the map is \
                 off by as much"
            ),
            Doubt::Undecided(x_m, y_m, apart_m) => write!(
                f,
                "the way around ({x_m:.1}, {y_m:.1}) in the map fits two places that were passed before, \
                 {apart_m:.1} m apart, equally well, and no closure is made there: the map may be off by as \
                 much; drive past something that is there only once"
            ),
            Doubt::Unconfirmed(open_m, whole_m) => write!(
                f,
                "of {whole_m:.0} m of way through places that were passed before, scans confirm nothing \
                 for {open_m:.0} m: there the map may be off; more beams, a longer range, a slower drive or \
                 driving there in the same direction tell more"
            ),
            Doubt::Corridor(metres) => write!(
                f,
                "for {metres:.0} m walls looked the same all along: there only odometry told how far \
                 the robot went"
            ),
            Doubt::FewerMaps(count) => write!(
                f,
                "the maps of all particles would take too much memory: the best {count} of them go on, \
                 several times each; fewer particles, a coarser `delta` or a shorter `maxUrange` need \
                 less"
            ),
            Doubt::GraphFollowed(closures) => write!(
                f,
                "the best particle's map violates {closures} loop constraints of the graph, and no two passes \
                 contradict each other in the graph's map: all particles follow the graph's trajectory; \
                 more `particles` may close these loops by themselves"
            ),
        }
    }
}

/// One step from a kept scan to the next.
pub(crate) struct Step {
    pub(crate) time_ns: i64,
    /// Where odometry has the robot now.
    pub(crate) odom_from_base: Option<Pose2>,
    /// Where the scan was found, as seen from the one before.
    pub(crate) key_from_base: Pose2,
    /// Heading of the one before in the map \[rad\].
    pub(crate) heading_rad: f64,
    /// Whether the scan was found.
    pub(crate) is_matched: bool,
    /// From 0 where walls do not hold along some direction to 1.
    pub(crate) firmness: f64,
}

/// Of each older step this counts.
const REMEMBERED: f64 = 0.98;
/// Evidence that is needed: way \[m\], turn \[rad\], steps in a row with the same verdict.
const LEAST_WAY_M: f64 = 4.0;
const LEAST_TURN_RAD: f64 = 2.0;
const STEPS: usize = 10;
/// Part of the motion that an explanation must explain, and below which there is none.
const EXPLAINED: f64 = 0.9;
const UNEXPLAINED: f64 = 0.6;
/// Scales up to this are what good robots have; angles \[rad\].
const WAY: f64 = 0.04;
const TURN: f64 = 0.06;
const ASIDE_RAD: f64 = 0.1;
/// Longer steps are jumps of odometry \[m\].
const JUMP_M: f64 = 3.0;
/// Corridors from this length on are told \[m\], and so much way with walls that hold ends one.
const CORRIDOR_M: f64 = 5.0;
const HELD_M: f64 = 1.0;

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
    told: f64,
    found: f64,
}

impl Fit {
    fn add(&mut self, o: Number, s: Number) {
        let product = times(o, conjugate(s));
        for (sum, part) in self.product.iter_mut().zip(product) {
            *sum = REMEMBERED * *sum + part;
        }
        self.told = REMEMBERED * self.told + o[0] * o[0] + o[1] * o[1];
        self.found = REMEMBERED * self.found + s[0] * s[0] + s[1] * s[1];
    }

    fn scale(&self) -> f64 {
        libm::hypot(self.product[0], self.product[1]) / self.found.max(1e-12)
    }

    fn angle_rad(&self) -> f64 {
        libm::atan2(self.product[1], self.product[0])
    }

    /// The part of the motion that `z` explains (the square of the correlation).
    fn explained(&self) -> f64 {
        let [x, y] = self.product;
        (x * x + y * y) / (self.told * self.found).max(1e-18)
    }
}

/// What was noticed so far.
#[derive(Default)]
pub(crate) struct Doubts {
    /// Where odometry had the robot at the last kept scan.
    before: Option<Pose2>,
    /// Steps as seen from the robot; as seen from the map and mirrored; and turns.
    own: Fit,
    mirrored: Fit,
    turns: Fit,
    way_m: f64,
    turn_rad: f64,
    /// The verdict on the last steps, and for how many.
    verdict: Option<(Kind, usize)>,
    /// Kinds that have been told.
    told: Vec<Kind>,
    /// Way along a corridor, and since its walls hold again \[m\].
    corridor_m: f64,
    held_m: f64,
    pub(crate) remarks: Vec<Remark>,
}

/// Verdicts that are told once each.
type Kind = std::mem::Discriminant<Doubt>;

impl Doubts {
    /// Takes note of the first scan.
    pub(crate) fn begin(&mut self, odom_from_base: Option<Pose2>) {
        self.before = odom_from_base;
    }

    /// Takes note of something that was seen elsewhere.
    pub(crate) fn remark(&mut self, time_ns: i64, doubt: Doubt) {
        self.remarks.push(Remark { time_ns, doubt });
    }

    /// Takes note of a kept scan.
    pub(crate) fn take(&mut self, step: &Step) {
        let before = std::mem::replace(&mut self.before, step.odom_from_base);
        let found = step.key_from_base;
        let metres = libm::hypot(found.x_m, found.y_m);
        self.walk(step, metres);
        let (Some(before), Some(now)) = (before, step.odom_from_base) else { return };
        let told = before.inverse() * now;
        let jumped = libm::hypot(told.x_m, told.y_m) > JUMP_M;
        if jumped || !step.is_matched {
            return;
        }
        let (t, u) = (normalize_angle(told.yaw_rad), normalize_angle(found.yaw_rad));
        self.turns.add([t, 0.0], [u, 0.0]);
        self.turn_rad = REMEMBERED * self.turn_rad + u.abs();
        // Along a corridor odometry would be its own witness.
        if step.firmness > 0.5 {
            let (o, s) = ([told.x_m, told.y_m], [found.x_m, found.y_m]);
            self.own.add(o, s);
            let (o, s) = (turned(o, before.yaw_rad), turned(s, step.heading_rad));
            self.mirrored.add(o, conjugate(s));
            self.way_m = REMEMBERED * self.way_m + metres;
        }
        self.judge(step.time_ns);
    }

    /// Tells what has been so for long.
    fn judge(&mut self, time_ns: i64) {
        let found = self.first_doubt().map(|doubt| (doubt, std::mem::discriminant(&doubt)));
        let Some((doubt, kind)) = found else {
            self.verdict = None;
            return;
        };
        let steps = match self.verdict {
            Some((last, steps)) if last == kind => steps + 1,
            _ => 1,
        };
        self.verdict = Some((kind, steps));
        if steps >= STEPS {
            self.told.push(kind);
            self.verdict = None;
            self.remarks.push(Remark { time_ns, doubt });
        }
    }

    /// The first of all doubts that hold now and have not been told.
    fn first_doubt(&self) -> Option<Doubt> {
        self.doubts().into_iter().find(|it| !self.told.contains(&std::mem::discriminant(it)))
    }

    /// What has been told and still holds, with the time at which it was told.
    pub(crate) fn holding(&self) -> Vec<Remark> {
        let told = |doubt: Doubt| {
            let kind = std::mem::discriminant(&doubt);
            let is_it = |it: &&Remark| std::mem::discriminant(&it.doubt) == kind;
            let remark = self.remarks.iter().rev().find(is_it)?;
            Some(Remark { time_ns: remark.time_ns, doubt })
        };
        self.doubts().into_iter().filter_map(told).collect()
    }

    fn doubts(&self) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        let has_turned = self.turn_rad > LEAST_TURN_RAD;
        let ratio = self.turns.product[0] / self.turns.found.max(1e-12);
        let turns_fit = has_turned && self.turns.explained() > EXPLAINED;
        let is_opposite = turns_fit && ratio < 0.0;
        if self.way_m < LEAST_WAY_M {
            if is_opposite {
                doubts.push(Doubt::Mirrored);
            }
            return doubts;
        }
        let (own, mirrored) = (self.own.explained(), self.mirrored.explained());
        let angle_rad = self.own.angle_rad();
        let scale = self.own.scale();
        // As long as the robot has only gone one way, both explain the same.
        if !is_opposite && mirrored > EXPLAINED && own < UNEXPLAINED {
            // o = w conj(s): w is i when x and y are swapped, 1 when y has the wrong sign.
            let angle_rad = self.mirrored.angle_rad();
            doubts.push(if angle_rad.abs() < 0.5 {
                Doubt::YNegated
            } else if (angle_rad - FRAC_PI_2).abs() < 0.5 {
                Doubt::AxesSwapped
            } else if angle_rad.abs() > PI - 0.5 {
                Doubt::XNegated
            } else {
                Doubt::Disagreeing
            });
        } else if own > EXPLAINED {
            let is_backwards = angle_rad.abs() > PI - 0.3;
            if is_opposite {
                doubts.push(if is_backwards { Doubt::Backwards } else { Doubt::Mirrored });
            } else if angle_rad.abs() > ASIDE_RAD && mirrored < UNEXPLAINED {
                doubts.push(Doubt::ScannerTurned(angle_rad));
            }
            if (scale - 1.0).abs() > WAY {
                doubts.push(Doubt::WayScale(scale));
            }
            if turns_fit && !is_opposite && (ratio - 1.0).abs() > TURN {
                doubts.push(Doubt::TurnScale(ratio, scale));
            }
        } else if own < UNEXPLAINED && mirrored < UNEXPLAINED {
            doubts.push(Doubt::Disagreeing);
        }
        doubts
    }

    /// Takes note of how well walls hold.
    fn walk(&mut self, step: &Step, metres: f64) {
        if step.is_matched && step.firmness < 0.5 {
            self.corridor_m += self.held_m + metres;
            self.held_m = 0.0;
            return;
        }
        self.held_m += metres;
        if self.held_m > HELD_M {
            self.leave_corridor(step.time_ns);
        }
    }

    /// A corridor has come to its end.
    pub(crate) fn leave_corridor(&mut self, time_ns: i64) {
        let metres = std::mem::take(&mut self.corridor_m);
        self.held_m = 0.0;
        if metres >= CORRIDOR_M {
            self.remarks.push(Remark { time_ns, doubt: Doubt::Corridor(metres) });
        }
    }
}
