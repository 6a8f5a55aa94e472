//! Loop closure: search, verification, decision.
//!
//! A closure is accepted by counted evidence instead of a score:
//! 1. the stretch of path just driven matches an old stretch within the whole region that the uncertainty
//!    allows (three standard deviations; branch and bound, so the best match is found);
//! 2. compared in both directions, the scans do not see through each other's walls;
//! 3. no other pose in the region passes the same tests (else it waits for more path);
//! 4. if the region is large, other stretches confirm it independently: closures agree pairwise over the
//!    paths between them, and more do so than with any competing hypothesis;
//! 5. after optimization all newly overlapping scans still agree; else everything is undone.

mod evidence;
mod scale;
mod state;
mod verification;

use std::collections::VecDeque;
use std::ops::Range;

use periplus_geometry::Pose2;
use periplus_scan_matching::{FieldSettings, ScoreField, Symmetric3, Window};

use crate::drift::{RelativeUncertainty, reversed, uncertainties_from};
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::keyframe::{Keyframe, between};
use crate::local::{Group, apart, floored, grouped, heading_step, points_of, spread};
use crate::settings::Settings;

use scale::scale;
use verification::{MIN_MATCHED_RATIO, verify};

/// Length of a stretch that is searched for, and from one search to the next \[m\].
const STRETCH_M: f64 = 9.0;
const LEAST_STRETCH_M: f64 = 5.0;
const EVERY_M: f64 = 2.5;
/// Length of a stretch in which is searched, and how much of its surroundings belongs to it \[m\].
const PLACE_M: f64 = 5.0;
const AROUND_M: f64 = 3.0;
/// Minimum path between two stretches for one to be old relative to the other \[m\].
const OLD_M: f64 = 15.0;
/// Middles of two stretches that show the same are not farther apart \[m\].
const MEET_M: f64 = 9.0;
/// Half side of the searched window, beyond `MEET_M` to detect better matches just outside \[m\].
const SEEN_M: f64 = 10.5;
/// Maximum standard deviation of a position that is searched for \[m\].
const MOST_M: f64 = 60.0;
/// Below this ties to near scans find all there is, 3 standard deviations \[m, rad\].
const KNOWN_M: f64 = 0.5;
const KNOWN_RAD: f64 = 0.2;
/// Searched points have a mean likelihood of at least this.
const MIN_SCORE_RATIO: f64 = 0.42;
/// The second best pose is verified if its score is at least this fraction of the best one's.
const SECOND_POSE_SCORE_RATIO: f64 = 0.8;
/// Minimum distance of two different poses \[m, rad\].
const OTHER_M: f64 = 0.8;
const OTHER_RAD: f64 = 0.5;
/// Peaks this near to the rim of what was searched are none \[m\].
const RIM_M: f64 = 0.15;
/// Searches for one stretch, and searches that wait, at most.
const MAX_SEARCHES_PER_STRETCH_COUNT: usize = 30;
const MAX_WAITING_SEARCH_COUNT: usize = 300;
/// Covariance of poses in other map components: unknown.
const UNKNOWN_COVARIANCE: Symmetric3 =
    Symmetric3 { xx: 1e4, xy: 0.0, xt: 0.0, yy: 1e4, yt: 0.0, tt: 10.0 };
/// Stricter limits for closures between components, where nothing is known of the relative pose: region,
/// score, agreement, searches per stretch, and their priority.
const GLOBAL_REGION_M: f64 = 250.0;
const GLOBAL_MIN_SCORE_RATIO: f64 = 0.5;
const GLOBAL_MIN_AGREEMENT_RATIO: f64 = 0.95;
const MAX_GLOBAL_CANDIDATES: usize = 32;
const GLOBAL_DISTANCE_FACTOR: f64 = 2.0;
/// Fields that are kept; the larger, the fewer.
const CACHED_FIELD_COUNT: usize = 12;
/// Points of a stretch are searched with when they are not farther away \[m\], one for each spacing.
const FAR_M: f32 = 14.0;
const SPACING_M: f32 = 0.15;
/// The same between components, where every heading is searched: fewer points, and larger heading steps.
const GLOBAL_SPACING_M: f32 = 0.4;
const GLOBAL_FAR_M: f32 = 9.0;
/// Maximum factor of the cell size for long-range scanners.
const MAX_CELL_SIZE_FACTOR: f64 = 2.0;

/// A loop closure candidate with the decision on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Kept scans that it ties, the old one first.
    pub keyframes: (usize, usize),
    /// Pose of the later keyframe in the frame of the earlier one.
    pub old_from_new: Pose2,
    /// True if it is part of the map.
    pub is_accepted: bool,
    /// Three standard deviations of the relative position before the closure, along the worst direction
    /// \[m\].
    pub region_m: f64,
    /// Part of judged points that agreed.
    pub agreeing: f64,
    /// Reason for accepting or rejecting it.
    pub reason: String,
}

/// One search: a stretch of path in an old one.
struct Task {
    stretch: Range<usize>,
    anchor: usize,
    place: usize,
    covariance: Symmetric3,
}

/// A stretch of path in which later ones are searched.
struct Place {
    keyframes: Range<usize>,
    middle: usize,
}

/// A closure that is waiting for others.
#[derive(Clone)]
struct Candidate {
    anchor: usize,
    middle: usize,
    middle_from_anchor: Pose2,
    information: Symmetric3,
    region_m: f64,
    share: f64,
    is_unique: bool,
    /// True if most points of each stretch are occluded from the other.
    is_partial: bool,
}

impl Candidate {
    fn closure(&self) -> Closure {
        Closure {
            keyframes: (self.middle, self.anchor),
            old_from_new: self.middle_from_anchor,
            is_accepted: false,
            region_m: self.region_m,
            agreeing: self.share,
            reason: String::new(),
        }
    }

    fn edge(&self) -> Edge {
        let keyframes = (self.middle, self.anchor);
        Edge::new(keyframes, self.middle_from_anchor, self.information, ConstraintKind::LoopClosure)
    }
}

/// A cached likelihood field of an old stretch.
struct Kept {
    place: usize,
    /// Keyframes and poses that it was built from, relative to the middle of the stretch.
    of: Vec<(usize, Pose2)>,
    /// Made when it is asked for.
    field: Option<ScoreField>,
}

/// All that is known and asked about loops.
#[derive(Default)]
pub(crate) struct Loops {
    places: Vec<Place>,
    place_from: usize,
    searched_m: f64,
    tasks: VecDeque<Task>,
    pending: Vec<Candidate>,
    fields: VecDeque<Kept>,
    pub(crate) closures: Vec<Closure>,
}

impl Loops {
    /// Adds a keyframe; queues searches when they are due.
    pub(crate) fn add_keyframe(
        &mut self,
        keyframes: &[Keyframe],
        graph: &Graph,
        proximity_m: f64,
        is_torn: bool,
    ) {
        let last = keyframes.len() - 1;
        let travel_m = keyframes[last].travel_m;
        if travel_m - keyframes[self.place_from].travel_m >= PLACE_M {
            let range = self.place_from..last + 1;
            let half = keyframes[range.start].travel_m + 0.5 * PLACE_M;
            let middle = range
                .clone()
                .find(|&keyframe| keyframes[keyframe].travel_m >= half)
                .unwrap_or(last);
            self.places.push(Place { keyframes: range, middle });
            self.place_from = last;
        }
        if travel_m - self.searched_m < EVERY_M {
            return;
        }
        // Where proximity constraints hold the path, no search is needed.
        self.searched_m = travel_m;
        if travel_m - proximity_m < STRETCH_M {
            return;
        }
        self.ask(keyframes, graph, last, is_torn);
    }

    /// Queues searches in all old stretches that the stretch up to a keyframe may have met. If the map has
    /// several components, a part of the stretches of the others is searched, too.
    pub(crate) fn ask(
        &mut self,
        keyframes: &[Keyframe],
        graph: &Graph,
        last: usize,
        is_torn: bool,
    ) {
        let scale = scale(keyframes, last);
        let start = (0..last)
            .rev()
            .find(|&keyframe| {
                keyframes[last].travel_m - keyframes[keyframe].travel_m > scale * STRETCH_M
            })
            .unwrap_or(0);
        let stretch = start..last + 1;
        let way = keyframes[last].travel_m - keyframes[start].travel_m;
        if way < LEAST_STRETCH_M {
            return;
        }
        let half = keyframes[start].travel_m + 0.5 * way;
        let anchor =
            stretch.clone().find(|&keyframe| keyframes[keyframe].travel_m >= half).unwrap_or(last);
        let uncertainties = uncertainties_from(graph, anchor, MOST_M);
        let mut covariances: Vec<Option<RelativeUncertainty>> = vec![None; keyframes.len()];
        for uncertainty in uncertainties {
            covariances[uncertainty.keyframe] = Some(uncertainty);
        }
        let mut asked: Vec<(f64, Task)> = Vec::new();
        let mut elsewhere: Vec<(f64, Task)> = Vec::new();
        // Stretches overlap their neighbours.
        for (place, old) in self.places.iter().enumerate().step_by(scale as usize) {
            let gone_m = keyframes[start].travel_m - keyframes[old.keyframes.end - 1].travel_m;
            if gone_m < scale * (OLD_M - STRETCH_M) {
                break;
            }
            let Some(uncertainty) = &covariances[old.middle] else {
                // Another map component, or too far away for a bound on the uncertainty.
                let task = Task {
                    stretch: stretch.clone(),
                    anchor,
                    place,
                    covariance: UNKNOWN_COVARIANCE,
                };
                elsewhere.push((GLOBAL_DISTANCE_FACTOR, task));
                continue;
            };
            let (region_m, region_rad) =
                (3.0 * uncertainty.shift_m(), 3.0 * uncertainty.turn_rad());
            if region_m < KNOWN_M && region_rad < KNOWN_RAD {
                continue;
            }
            let (metres, _) = apart(graph.poses[anchor], graph.poses[old.middle]);
            if metres > region_m + scale * MEET_M {
                continue;
            }
            let covariance = reversed(&uncertainty.covariance, graph.between(anchor, old.middle));
            let task = Task { stretch: stretch.clone(), anchor, place, covariance };
            // The likeliest first: how far out in its region a meeting would be.
            asked.push(((metres - scale * MEET_M).max(0.0) / region_m.max(0.1), task));
        }
        asked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.place.cmp(&b.1.place)));
        asked.truncate(MAX_SEARCHES_PER_STRETCH_COUNT);
        if is_torn {
            let every = elsewhere.len().div_ceil(MAX_GLOBAL_CANDIDATES).max(1);
            asked.extend(elsewhere.into_iter().skip(anchor % every).step_by(every));
        }
        // Under load the oldest questions go unanswered; they are asked again at the end.
        let over = (self.tasks.len() + asked.len()).saturating_sub(MAX_WAITING_SEARCH_COUNT);
        self.tasks.drain(..over.min(self.tasks.len()));
        self.tasks.extend(asked.into_iter().map(|it| it.1));
    }

    /// Ends of all stretches that no tie or closure holds.
    pub(crate) fn unconstrained(keyframes: &[Keyframe], graph: &Graph) -> Vec<usize> {
        let mut ends = Vec::new();
        let mut asked_m = 0.0;
        let mut held_m = f64::NEG_INFINITY;
        for (keyframe, it) in keyframes.iter().enumerate() {
            if graph.is_held(keyframe) {
                held_m = it.travel_m;
            }
            if it.travel_m - asked_m >= EVERY_M && it.travel_m - held_m > STRETCH_M {
                asked_m = it.travel_m;
                ends.push(keyframe);
            }
        }
        ends
    }

    /// True if searches are queued.
    pub(crate) fn is_busy(&self) -> bool {
        !self.tasks.is_empty()
    }

    /// Does one search; gives edges when closures are believed after it.
    pub(crate) fn work(
        &mut self,
        keyframes: &[Keyframe],
        graph: &Graph,
        settings: &Settings,
    ) -> Vec<Edge> {
        let Some(task) = self.tasks.pop_front() else { return Vec::new() };
        match self.search(&task, keyframes, graph, settings) {
            Some(candidate) => self.weigh(candidate, keyframes, graph),
            None => Vec::new(),
        }
    }

    fn search(
        &mut self,
        task: &Task,
        keyframes: &[Keyframe],
        graph: &Graph,
        settings: &Settings,
    ) -> Option<Candidate> {
        let middle = self.places[task.place].middle;
        let scale = scale(keyframes, task.stretch.end - 1);
        let around = self.around(task.place, keyframes, scale);
        let around: Vec<usize> = around.filter(|&keyframe| keyframe < task.stretch.start).collect();
        let old = grouped(keyframes, graph, &around, middle);
        let old = old.placed();
        let stretch: Vec<usize> = task.stretch.clone().collect();
        let new = grouped(keyframes, graph, &stretch, task.anchor);
        let new = new.placed();
        let expected = graph.between(middle, task.anchor);
        let region = [3.0 * task.covariance.xx.sqrt() + 0.4, 3.0 * task.covariance.yy.sqrt() + 0.4];
        let half_rad = (3.0 * task.covariance.tt.sqrt() + 0.03).min(std::f64::consts::PI);
        let (meet_m, seen_m) = (scale * MEET_M, scale * SEEN_M);
        // Only the part of the region where the two can meet.
        let part = |middle: f64, half: f64| {
            let (low, high) = ((middle - half).max(-seen_m), (middle + half).min(seen_m));
            (low < high).then_some((0.5 * (low + high), 0.5 * (high - low)))
        };
        let (x_m, half_x_m) = part(expected.x_m, region[0])?;
        let (y_m, half_y_m) = part(expected.y_m, region[1])?;
        let region_m = 3.0 * task.covariance.largest_shift().sqrt();
        let is_anywhere = region_m > GLOBAL_REGION_M;
        let (spacing_m, far_m) =
            if is_anywhere { (GLOBAL_SPACING_M, GLOBAL_FAR_M) } else { (SPACING_M, FAR_M) };
        let points = spread(&points_of(&new), scale as f32 * spacing_m, scale as f32 * far_m);
        if points.len() < 40 {
            return None;
        }
        let window = Window {
            middle: Pose2::new(x_m, y_m, expected.yaw_rad),
            half_m: [half_x_m, half_y_m],
            half_rad,
            step_rad: heading_step(&points, settings.loop_field.resolution_m)
                / scale.min(MAX_CELL_SIZE_FACTOR),
        };
        let of = around.iter().map(|&keyframe| (keyframe, graph.between(middle, keyframe)));
        let field = self.field(task.place, of, keyframes, settings, scale);
        let least_score = if is_anywhere { GLOBAL_MIN_SCORE_RATIO } else { MIN_SCORE_RATIO };
        let (best, _) = field.search(&points, &window, least_score, None);
        let best = best?;
        // A peak at the rim is the slope of something beyond.
        let rim = [best.pose.x_m - x_m, best.pose.y_m - y_m];
        let is_at_rim = rim[0].abs() > half_x_m - RIM_M || rim[1].abs() > half_y_m - RIM_M;
        let is_far = best.pose.x_m.abs() > meet_m || best.pose.y_m.abs() > meet_m;
        if is_at_rim || is_far {
            return None;
        }
        let least = (SECOND_POSE_SCORE_RATIO * best.score).max(least_score);
        let (second, _) =
            field.search(&points, &window, least, Some((best.pose, OTHER_M, OTHER_RAD)));
        let verdict = verify(best.pose, &new, &old, settings);
        let mut told = Closure {
            keyframes: (middle, task.anchor),
            old_from_new: best.pose,
            is_accepted: false,
            region_m,
            agreeing: verdict.share,
            reason: String::new(),
        };
        if let Some(reason) = verdict.fault {
            told.reason = format!("{reason} (likelihood {:.2})", best.score);
            self.closures.push(told);
            return None;
        }
        if is_anywhere && verdict.share < GLOBAL_MIN_AGREEMENT_RATIO {
            told.reason = format!(
                "{:.0} % of the points are seen through, too many for an unbounded search",
                100.0 * (1.0 - verdict.share)
            );
            self.closures.push(told);
            return None;
        }
        let place = verdict.fit.target_from_moving;
        let rival = second.map(|peak| verify(peak.pose, &new, &old, settings)).filter(|other| {
            let (metres, radians) = apart(other.fit.target_from_moving, place);
            other.fault.is_none()
                && (metres > 0.5 * OTHER_M || radians > 0.5 * OTHER_RAD)
                && other.fit.matched > 0.9 * verdict.fit.matched
        });
        Some(Candidate {
            anchor: task.anchor,
            middle,
            middle_from_anchor: place,
            information: floored(&verdict.fit.information),
            region_m,
            share: verdict.share,
            is_unique: rival.is_none() && verdict.fit.firmness > 0.0,
            is_partial: verdict.fit.matched < MIN_MATCHED_RATIO,
        })
    }

    /// Keyframes of an old stretch and around it.
    fn around(&self, place: usize, keyframes: &[Keyframe], scale: f64) -> Range<usize> {
        let own = &self.places[place].keyframes;
        let around_m = scale * AROUND_M + 0.5 * (scale - 1.0) * PLACE_M;
        let (from_m, to_m) =
            (keyframes[own.start].travel_m - around_m, keyframes[own.end - 1].travel_m + around_m);
        between(keyframes, from_m, to_m)
    }

    /// Returns the likelihood field of an old stretch, from the cache or built from these keyframes.
    fn field(
        &mut self,
        place: usize,
        of: impl Iterator<Item = (usize, Pose2)>,
        keyframes: &[Keyframe],
        settings: &Settings,
        scale: f64,
    ) -> &ScoreField {
        let at = self.fields.iter().position(|kept| kept.place == place);
        let kept = at.and_then(|at| self.fields.remove(at));
        let kept = kept.unwrap_or_else(|| Kept { place, of: of.collect(), field: None });
        self.fields.truncate((CACHED_FIELD_COUNT as f64 / scale) as usize - 1);
        self.fields.push_front(kept);
        let Kept { of, field, .. } = &mut self.fields[0];
        field.get_or_insert_with(|| {
            let group =
                Group::new(of.iter().map(|&(keyframe, pose)| (keyframes[keyframe].cloud(), pose)));
            ScoreField::new(
                &points_of(&group.placed()),
                [0.0, 0.0],
                &field_settings(settings, scale),
            )
        })
    }

    /// Newest report on a closure between two keyframes.
    fn closure(&mut self, keyframes: (usize, usize), old_from_new: Pose2) -> Option<&mut Closure> {
        let mut newest_first = self.closures.iter_mut().rev();
        newest_first.find(|it| it.keyframes == keyframes && it.old_from_new == old_from_new)
    }

    /// A closure that waited is part of the map.
    pub(crate) fn accept(&mut self, edge: &Edge, reason: String) {
        self.pending.retain(|it| (it.middle, it.anchor) != (edge.from, edge.to));
        if let Some(told) = self.closure((edge.from, edge.to), edge.from_from_to) {
            (told.is_accepted, told.reason) = (true, reason);
        }
    }

    /// Another closure passes the same tests: neither is part of the map.
    pub(crate) fn leave_undecided(&mut self, edge: &Edge, apart_m: f64) {
        if let Some(told) = self.closure((edge.from, edge.to), edge.from_from_to) {
            told.reason = format!(
                "{}; on trial when the log had ended, a closure {apart_m:.1} m from it passed as well",
                told.reason
            );
        }
    }

    /// Two passes that the map had side by side are joined.
    pub(crate) fn join(&mut self, edge: &Edge, shift_m: f64) {
        self.closures.push(Closure {
            keyframes: (edge.from, edge.to),
            old_from_new: edge.from_from_to,
            is_accepted: true,
            region_m: shift_m,
            agreeing: 1.0,
            reason: format!(
                "joined when all scans were in: both passes showed the same walls {shift_m:.2} m apart"
            ),
        });
    }

    /// Closures are part of the map no more.
    pub(crate) fn reject(&mut self, edges: &[Edge], reason: &str) {
        for told in self.closures_of(edges) {
            told.is_accepted = false;
            told.reason = reason.to_owned();
        }
    }

    /// The map has moved: what was asked before is asked of another map.
    pub(crate) fn forget(&mut self) {
        self.tasks.clear();
        self.fields.clear();
    }

    /// Returns the reports of these edges.
    pub(crate) fn closures_of<'a>(
        &'a mut self,
        edges: &'a [Edge],
    ) -> impl Iterator<Item = &'a mut Closure> {
        self.closures.iter_mut().filter(move |told| {
            let is_of = |edge: &Edge| {
                (edge.from, edge.to) == told.keyframes && edge.from_from_to == told.old_from_new
            };
            told.is_accepted && edges.iter().any(is_of)
        })
    }

    /// Bytes held.
    pub(crate) fn size(&self) -> usize {
        self.fields.iter().filter_map(|kept| kept.field.as_ref()).map(ScoreField::size).sum()
    }
}

/// Settings of the likelihood field for scanners with `scale` times the range of indoor ones.
fn field_settings(settings: &Settings, scale: f64) -> FieldSettings {
    let indoors = settings.loop_field;
    let (scale, coarse) = (scale as f32, scale.min(MAX_CELL_SIZE_FACTOR) as f32);
    FieldSettings {
        resolution_m: coarse * indoors.resolution_m,
        sigma_m: coarse * indoors.sigma_m,
        most_half_m: scale * indoors.most_half_m,
        ..indoors
    }
}
