//! All kinds of generated worlds, and what becomes of a drive through one.

use periplus_geometry::Pose2;
use periplus_slam::{CorrectedInput, MountingCorrection, Settings, Slam};

use super::judge::{Judgement, judge};
use super::{Moment, ROBOT, Robot, World, campus, crowd, doors, glass, hall, ramp};

/// A kind of world.
#[derive(Clone, Copy)]
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    /// A map is wrong when relations between passes are off by more in the mean \[m\].
    pub(crate) wrong_m: f64,
    /// A drive with a seed; a short one for tests.
    pub(crate) drive: fn(u64, bool) -> Vec<Moment>,
}

const INDOORS_M: f64 = 0.12;
const OUTDOORS_M: f64 = 0.3;

pub(crate) const KINDS: [Kind; 12] = [
    Kind { name: "campus", wrong_m: OUTDOORS_M, drive: campus::campus },
    Kind { name: "ramp", wrong_m: INDOORS_M, drive: ramp::corridors },
    Kind { name: "car-park", wrong_m: INDOORS_M, drive: ramp::car_park },
    Kind { name: "hall", wrong_m: INDOORS_M, drive: hall::hall },
    Kind { name: "rooms-4m", wrong_m: INDOORS_M, drive: doors::near_sighted },
    Kind { name: "glass", wrong_m: INDOORS_M, drive: glass::glass },
    Kind { name: "crowd", wrong_m: INDOORS_M, drive: crowd::crowd },
    Kind { name: "doors", wrong_m: INDOORS_M, drive: doors::doors },
    Kind { name: "low-cost", wrong_m: INDOORS_M, drive: doors::low_cost },
    Kind { name: "ring", wrong_m: INDOORS_M, drive: ring },
    Kind { name: "bare-ring", wrong_m: INDOORS_M, drive: bare_ring },
    Kind { name: "blocks", wrong_m: INDOORS_M, drive: blocks },
];

/// Verdict: is the map right, and is there a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Right,
    RightYetReported,
    WrongReported,
    SilentlyWrong,
}

impl Verdict {
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::RightYetReported => "right, yet reported",
            Self::WrongReported => "wrong, reported",
            Self::SilentlyWrong => "SILENTLY WRONG",
        }
    }
}

/// Result of a drive.
pub(crate) struct Outcome {
    pub(crate) slam: Slam,
    pub(crate) judgement: Judgement,
    pub(crate) verdict: Verdict,
    pub(crate) remedy: Option<MountingCorrection>,
}

/// Maps a drive, again where a fault of mounting is certain, and holds it against the truth.
pub(crate) fn outcome(kind: &Kind, moments: &[Moment]) -> Outcome {
    let mut slam = mapped(moments, None);
    let remedy = MountingCorrection::of(slam.remarks());
    if let Some(remedy) = remedy {
        slam = mapped(moments, Some(remedy));
    }
    let truth: Vec<Pose2> = moments.iter().map(|it| it.truth).collect();
    let found: Vec<Pose2> = slam.trajectory().into_iter().map(|it| it.1).collect();
    let judgement = judge(&truth, &found);
    let is_told = slam.remarks().iter().any(|it| it.is_warning());
    let verdict = match (judgement.loops_m > kind.wrong_m, is_told) {
        (false, false) => Verdict::Right,
        (false, true) => Verdict::RightYetReported,
        (true, true) => Verdict::WrongReported,
        (true, false) => Verdict::SilentlyWrong,
    };
    Outcome { slam, judgement, verdict, remedy }
}

fn mapped(moments: &[Moment], remedy: Option<MountingCorrection>) -> Slam {
    let mut slam = Slam::new(Settings::default());
    let mut cure = remedy.map(CorrectedInput::new);
    for moment in moments {
        let _ = match &mut cure {
            Some(cure) => {
                let (scan, odometry) = cure.apply(&moment.scan, Some(moment.odometry));
                slam.add_scan(&scan, odometry)
            }
            None => slam.add_scan(&moment.scan, Some(moment.odometry)),
        };
    }
    slam.finish();
    slam
}

/// Wheels of every other seed are bad.
fn flat(seed: u64) -> Robot {
    let bad = Robot { way_error: 0.15, turn_error: 0.2, bias_rad_per_m: 0.04, ..ROBOT };
    if seed % 2 == 1 { bad } else { ROBOT }
}

fn ring(seed: u64, is_short: bool) -> Vec<Moment> {
    let (long, deep) =
        if (seed / 2).is_multiple_of(2) || is_short { (40.0, 25.0) } else { (120.0, 80.0) };
    let corners = [
        (6.0, 0.0),
        (long, 0.0),
        (long, deep),
        (0.0, deep),
        (0.0, 0.0),
        (6.0, 0.0),
        (long - 4.0, 0.0),
    ];
    World::ring(long, deep, 2.4, seed).drive(&corners, 0.6, &flat(seed), seed)
}

fn bare_ring(seed: u64, _is_short: bool) -> Vec<Moment> {
    let corners = [(5.0, 0.0), (32.4, 0.0), (32.4, 32.4), (0.0, 32.4), (0.0, 0.0), (25.0, 0.0)];
    World::blocks(1, 1, 30.0, 2.4).drive(&corners, 0.6, &flat(seed), seed)
}

fn blocks(seed: u64, is_short: bool) -> Vec<Moment> {
    let corner = |c: u32, r: u32| (12.4 * f64::from(c), 12.4 * f64::from(r));
    let outer = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (2, 0), (2, 4), (0, 4), (0, 2), (4, 2)];
    let weave = [
        (0, 0),
        (4, 0),
        (4, 1),
        (0, 1),
        (0, 2),
        (4, 2),
        (4, 3),
        (0, 3),
        (0, 4),
        (4, 4),
        (4, 0),
        (3, 0),
        (3, 4),
        (2, 4),
        (2, 0),
        (1, 0),
        (1, 4),
        (0, 4),
        (0, 0),
    ];
    let nodes: &[(u32, u32)] =
        if (seed / 2).is_multiple_of(2) || is_short { &outer } else { &weave };
    let corners: Vec<(f64, f64)> = nodes.iter().map(|&(c, r)| corner(c, r)).collect();
    World::blocks(4, 4, 10.0, 2.4).drive(&corners, 0.6, &flat(seed), seed)
}
