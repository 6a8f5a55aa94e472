//! The audit while the robot drives: a few kept scans in each slice of work, and none twice as long as
//! the map does not move them against each other.

use periplus_geometry::Pose2;

use super::Slam;
use crate::audit::{
    ConstraintResidual, Contradiction, NEAR_M, audit, contradictions, hold, other_passes,
};
use crate::graph::Graph;
use crate::keyframe::Keyframe;
use crate::local::apart;
use crate::remark::{Remark, RemarkKind};

/// Pairs of scans that are compared in one slice, some 2 ms together, and kept scans that are visited.
const COMPARISONS_PER_SLICE_COUNT: usize = 4;
const VISITS_PER_SLICE_COUNT: usize = 40;
/// Scans that moved less against each other are not compared again \[m, rad\]: a small part of the
/// tolerance of a comparison, at 10 m for the turn.
const SAME_M: f64 = 0.03;
const SAME_RAD: f64 = 0.003;
/// Path after a stretch before it is reported \[m\]: until then a closure that needs more witnesses may
/// put it right.
const SETTLED_M: f64 = 15.0;

/// Two passes through the same area that contradict each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapContradiction {
    /// Kept scans at the ends of the stretch, and of the earlier pass that it contradicts.
    pub keyframes: (usize, usize),
    /// See `keyframes`.
    pub earlier_keyframes: (usize, usize),
    /// Stamps of these scans \[ns\].
    pub times_ns: (i64, i64),
    /// See `times_ns`.
    pub earlier_times_ns: (i64, i64),
    /// Middle of the stretch, where the map has it now.
    pub map_from_base: Pose2,
    /// Fraction of the points judged by both passes that agree.
    pub agreeing_ratio: f64,
}

/// The audit of a map that grows.
#[derive(Default)]
pub(super) struct LiveAudit {
    /// Comparisons so far, by kept scan.
    held: Vec<ConstraintResidual>,
    /// Those of before the map moved, from the next kept scan on.
    before: Vec<ConstraintResidual>,
    /// The next kept scan.
    next: usize,
    /// Map revision for which the comparisons are valid.
    map_revision: usize,
    /// True if `found` covers all comparisons.
    is_current: bool,
    found: Vec<Contradiction>,
}

impl LiveAudit {
    /// After all poses moved, with what was found then.
    pub(super) fn concluded(found: Vec<Contradiction>) -> Self {
        Self { found, map_revision: usize::MAX, ..Self::default() }
    }

    /// Compares some more scans; false when there is nothing to do.
    pub(super) fn work(
        &mut self,
        keyframes: &[Keyframe],
        graph: &Graph,
        map_revision: usize,
    ) -> bool {
        if self.map_revision != map_revision {
            self.map_revision = map_revision;
            self.restart();
        }
        if self.next >= keyframes.len() {
            if self.is_current {
                return false;
            }
            self.found = contradictions(&self.held, keyframes);
            self.is_current = true;
            return true;
        }
        self.is_current = false;
        let mut compared = 0;
        for _ in 0..VISITS_PER_SLICE_COUNT {
            if self.next >= keyframes.len() || compared >= COMPARISONS_PER_SLICE_COUNT {
                break;
            }
            compared += self.visit(keyframes, graph);
        }
        true
    }

    /// Visits the next kept scan; gives how many comparisons that took.
    fn visit(&mut self, keyframes: &[Keyframe], graph: &Graph) -> usize {
        let keyframe = self.next;
        self.next += 1;
        let gone = self.before.iter().take_while(|it| it.keyframe <= keyframe).count();
        let known: Vec<ConstraintResidual> =
            self.before.drain(..gone).filter(|it| it.keyframe == keyframe).collect();
        let mut compared = 0;
        let here = graph.poses[keyframe];
        let near = |other: &usize| {
            let there = graph.poses[*other];
            (there.x_m - here.x_m).abs() < NEAR_M && (there.y_m - here.y_m).abs() < NEAR_M
        };
        for other in other_passes(keyframes, graph, keyframe, (0..keyframe).filter(near)) {
            let is_same = |it: &&ConstraintResidual| {
                let (metres, radians) =
                    apart(it.other_from_keyframe, graph.between(other, keyframe));
                it.other == other && metres < SAME_M && radians < SAME_RAD
            };
            self.held.push(known.iter().find(is_same).copied().unwrap_or_else(|| {
                compared += 1;
                hold(keyframes, graph, keyframe, other)
            }));
        }
        compared
    }

    /// Looks at all kept scans again.
    fn restart(&mut self) {
        let mut known = std::mem::take(&mut self.held);
        known.append(&mut self.before);
        self.before = known;
        self.next = 0;
        self.is_current = false;
    }

    /// Kept scans have other numbers, and some are gone.
    pub(super) fn renumber(&mut self, number: &[Option<usize>]) {
        let new = |keyframe: usize| number.get(keyframe).copied().flatten();
        self.restart();
        self.before = std::mem::take(&mut self.before)
            .into_iter()
            .filter_map(|it| {
                Some(ConstraintResidual {
                    keyframe: new(it.keyframe)?,
                    other: new(it.other)?,
                    ..it
                })
            })
            .collect();
        self.found = std::mem::take(&mut self.found)
            .into_iter()
            .filter_map(|it| {
                let keyframes = (new(it.keyframes.0)?, new(it.keyframes.1)?);
                let others = (new(it.others.0)?, new(it.others.1)?);
                Some(Contradiction { keyframes, others, middle: new(it.middle)?, ..it })
            })
            .collect();
    }
}

impl Slam {
    /// Contradictions of the map: those of [`Slam::finish`], and with
    /// [`Settings::audits_live`](crate::Settings::audits_live) those that were found while the robot
    /// drives and that no closure has put right since. They go when the map is right there.
    #[must_use]
    pub fn contradictions(&self) -> Vec<MapContradiction> {
        let newest_m = self.keyframes.last().map_or(0.0, |keyframe| keyframe.travel_m);
        let is_settled = |it: &&Contradiction| {
            self.is_finished || newest_m - self.keyframes[it.keyframes.1].travel_m > SETTLED_M
        };
        self.live_audit.found.iter().filter(is_settled).map(|it| self.reported(it)).collect()
    }

    /// Holds all passes against each other as the map is now, at once: some milliseconds for each 10 m
    /// of path. [`Slam::contradictions`] is what has been found in slices.
    #[must_use]
    pub fn audit(&self) -> Vec<MapContradiction> {
        audit(&self.keyframes, &self.graph).iter().map(|it| self.reported(it)).collect()
    }

    fn reported(&self, it: &Contradiction) -> MapContradiction {
        let time_ns = |keyframe: usize| self.time_of(keyframe).unwrap_or_default();
        let times_ns = |keyframes: (usize, usize)| (time_ns(keyframes.0), time_ns(keyframes.1));
        MapContradiction {
            keyframes: it.keyframes,
            earlier_keyframes: it.others,
            times_ns: times_ns(it.keyframes),
            earlier_times_ns: times_ns(it.others),
            map_from_base: self.graph.poses[it.middle],
            agreeing_ratio: it.agreeing,
        }
    }

    /// Remarks that hold now, with the time at which each was noticed. [`Slam::remarks`] has all that
    /// were ever made.
    #[must_use]
    pub fn current_remarks(&self) -> Vec<Remark> {
        let now_ns = self.last.as_ref().map_or(0, |last| last.time_ns);
        let noticed_ns = |is_it: &dyn Fn(&RemarkKind) -> bool| {
            let mut remarks = self.diagnostics.remarks.iter().rev();
            remarks.find(|it| is_it(&it.kind)).map_or(now_ns, |it| it.time_ns)
        };
        let mut current = self.diagnostics.holding();
        if let Some(kind) = self.odometry_monitor.stuck() {
            let time_ns = noticed_ns(&|it| matches!(it, RemarkKind::OdometryStuck(_)));
            current.push(Remark { time_ns, kind });
        }
        if self.counts.kept > 1 && self.last.as_ref().is_some_and(|it| it.odom_from_base.is_none())
        {
            current.push(Remark { time_ns: now_ns, kind: RemarkKind::NoOdometry });
        }
        match self.disconnected().len() {
            0 => {}
            components => {
                let time_ns = noticed_ns(&|it| matches!(it, RemarkKind::Kidnapped));
                current.push(Remark { time_ns, kind: RemarkKind::Disconnected(components) });
            }
        }
        current.extend(self.contradictions().iter().map(MapContradiction::remark));
        current
    }
}

impl MapContradiction {
    /// The same as a remark.
    #[must_use]
    pub fn remark(&self) -> Remark {
        let Pose2 { x_m, y_m, .. } = self.map_from_base;
        let kind = RemarkKind::Contradiction(x_m, y_m, self.agreeing_ratio);
        Remark { time_ns: self.times_ns.0, kind }
    }
}
