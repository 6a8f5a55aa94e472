//! Decision on closures by the evidence of others.

use periplus_geometry::normalize_angle;
use periplus_scan_matching::Symmetric3;

use super::{Candidate, GLOBAL_REGION_M, Loops, MOST_M};
use crate::drift::uncertainties_from;
use crate::graph::{Edge, Graph};
use crate::keyframe::Keyframe;

/// Squared Mahalanobis distance within which closures agree: 99 % for 3 degrees of freedom.
const CONSISTENT_SQUARED_SIGMAS: f64 = 11.3;
/// Regions (3 standard deviations) up to this need one witness, up to that two, else three \[m\].
const ONE_WITNESS_M: f64 = 2.0;
const PARTLY_ONE_WITNESS_M: f64 = 1.0;
const TWO_WITNESSES_M: f64 = 12.0;
/// A closure that others speak against is tried at the end when its scans agree on more than this.
const TRIAL_MIN_AGREEMENT_RATIO: f64 = 0.93;
/// Witnesses for each against, where those against would be enough for another closure.
const MAJORITY_FACTOR: usize = 3;
/// Minimum path between two witnesses, and maximum path over which they count \[m\].
const APART_M: f64 = 4.0;
const HEARD_M: f64 = 60.0;
/// Two closures are uninformative about each other if three standard deviations of the paths between them
/// exceed this fraction of the smaller region, and this distance: they would agree by chance.
const UNINFORMATIVE_REGION_RATIO: f64 = 0.5;
const UNINFORMATIVE_REGION_M: f64 = 2.0;
/// Number of witnesses for closures between components, where nothing is known of the relative pose.
const GLOBAL_MIN_WITNESS_COUNT: usize = 5;

/// Evidence of the other closures about one.
struct Evidence {
    /// Closures that agree with it.
    agreeing: Vec<usize>,
    /// Independent stretches that confirm it, itself included.
    witnesses: usize,
    wanted: usize,
    /// Independent stretches that contradict it.
    rivals: usize,
}

impl Evidence {
    fn is_enough(&self) -> bool {
        // As many against it as would suffice for another closure: two areas look alike.
        let is_clear = self.rivals < self.wanted || self.witnesses >= MAJORITY_FACTOR * self.rivals;
        self.witnesses >= self.wanted + self.rivals && is_clear
    }
}

/// Relation between two closures.
enum Consistency {
    Agrees,
    Contradicts,
    /// The paths between them are so uncertain that they would agree by chance.
    Uninformative,
}

impl Loops {
    /// Decides on a new candidate and those that agree with it; returns the edges of the accepted ones.
    ///
    /// Each is accepted by its own evidence: as many agreeing witnesses as its region requires. Ambiguous
    /// candidates are never accepted, since proximity constraints are better once the pose is known; they
    /// are dropped.
    pub(super) fn weigh(
        &mut self,
        new: Candidate,
        keyframes: &[Keyframe],
        graph: &Graph,
    ) -> Vec<Edge> {
        self.closures.push(new.closure());
        self.pending.push(new);
        let newest = self.pending.len() - 1;
        let evidence = self.evidence(newest, keyframes, graph);
        self.tell(newest, &evidence, evidence.is_enough());
        if !evidence.is_enough() || !self.pending[newest].is_unique {
            return Vec::new();
        }
        let mut believed = Vec::new();
        for &index in evidence.agreeing.iter().chain([&newest]) {
            if !self.pending[index].is_unique {
                continue;
            }
            let own = self.evidence(index, keyframes, graph);
            if own.is_enough() {
                self.tell(index, &own, true);
                believed.push(index);
            }
        }
        let edges = believed.iter().map(|&index| self.pending[index].edge()).collect();
        // Others that agree may still find more witnesses.
        let is_done = |index: usize, it: &Candidate| {
            believed.contains(&index) || (evidence.agreeing.contains(&index) && !it.is_unique)
        };
        let mut index = 0;
        self.pending.retain(|it| {
            index += 1;
            !is_done(index - 1, it)
        });
        edges
    }

    /// Evidence of the other closures about one.
    fn evidence(&self, of: usize, keyframes: &[Keyframe], graph: &Graph) -> Evidence {
        let it = &self.pending[of];
        let from_anchor = uncertainties(graph, it.anchor);
        let from_middle = uncertainties(graph, it.middle);
        let here_m = keyframes[it.anchor].travel_m;
        let mut agreeing: Vec<usize> = Vec::new();
        let mut rivals: Vec<f64> = Vec::new();
        // Witnesses: unique ones, far enough from each other.
        let mut witnesses: Vec<f64> = Vec::new();
        let is_apart = |ways: &[f64], way: f64| ways.iter().all(|it| (it - way).abs() >= APART_M);
        if it.is_unique {
            witnesses.push(here_m);
        }
        for (index, other) in self.pending.iter().enumerate().rev() {
            let there_m = keyframes[other.anchor].travel_m;
            // Distant closures are no evidence.
            if index == of || (here_m - there_m).abs() > HEARD_M {
                continue;
            }
            match consistency(it, other, graph, &from_anchor, &from_middle) {
                Consistency::Agrees => {
                    agreeing.push(index);
                    if other.is_unique && is_apart(&witnesses, there_m) {
                        witnesses.push(there_m);
                    }
                }
                Consistency::Contradicts if other.is_unique && is_apart(&rivals, there_m) => {
                    rivals.push(there_m);
                }
                _ => {}
            }
        }
        let wanted = match it.region_m {
            ..PARTLY_ONE_WITNESS_M => 1,
            ..ONE_WITNESS_M if !it.is_partial => 1,
            ..TWO_WITNESSES_M => 2,
            ..GLOBAL_REGION_M => 3,
            _ => GLOBAL_MIN_WITNESS_COUNT,
        };
        Evidence { agreeing, witnesses: witnesses.len(), wanted, rivals: rivals.len() }
    }

    /// Writes down what became of a closure.
    fn tell(&mut self, index: usize, evidence: &Evidence, is_believed: bool) {
        let it = &self.pending[index];
        let (keyframes, pose) = ((it.middle, it.anchor), it.middle_from_anchor);
        let words = match (it.is_unique, is_believed) {
            (true, _) => "unique in the region",
            (false, false) => "matches elsewhere too",
            (false, true) => "matches elsewhere too, though others agree with it",
        };
        let is_accepted = is_believed && it.is_unique;
        let Some(told) = self.closure(keyframes, pose) else { return };
        told.is_accepted = is_accepted;
        told.reason = format!(
            "{} of {} independent witnesses, {} against; {words}",
            evidence.witnesses, evidence.wanted, evidence.rivals,
        );
    }

    /// Closures that lack a witness, that nothing speaks against, and that fit nowhere else: those with the
    /// most witnesses first.
    pub(crate) fn waiting(&self, keyframes: &[Keyframe], graph: &Graph) -> Vec<Edge> {
        let mut waiting: Vec<(usize, f64, usize)> = (0..self.pending.len())
            .filter(|&index| self.pending[index].is_unique && !self.pending[index].is_partial)
            .filter_map(|index| {
                let evidence = self.evidence(index, keyframes, graph);
                let lacks = evidence.wanted.saturating_sub(evidence.witnesses);
                let is_clear =
                    evidence.rivals == 0 || self.pending[index].share > TRIAL_MIN_AGREEMENT_RATIO;
                let is_near = lacks <= 1 && evidence.witnesses > evidence.rivals && is_clear;
                is_near.then(|| (lacks, 1.0 - self.pending[index].share, index))
            })
            .collect();
        waiting.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        waiting.into_iter().map(|it| self.pending[it.2].edge()).collect()
    }

    /// Returns the best supported closure that contradicts the given one.
    pub(crate) fn rival_of(
        &self,
        edge: &Edge,
        keyframes: &[Keyframe],
        graph: &Graph,
    ) -> Option<Edge> {
        let keys_of = |it: &Candidate| (it.middle, it.anchor);
        let it = self.pending.iter().find(|it| keys_of(it) == (edge.from, edge.to))?;
        let from_anchor = uncertainties(graph, it.anchor);
        let from_middle = uncertainties(graph, it.middle);
        let here_m = keyframes[it.anchor].travel_m;
        let opposes = |index: &usize| {
            let other = &self.pending[*index];
            let is_near = (here_m - keyframes[other.anchor].travel_m).abs() <= HEARD_M;
            let word = || consistency(it, other, graph, &from_anchor, &from_middle);
            other.is_unique && is_near && matches!(word(), Consistency::Contradicts)
        };
        let witnesses = |index: &usize| self.evidence(*index, keyframes, graph).witnesses;
        let rivals = (0..self.pending.len()).filter(opposes);
        rivals
            .max_by_key(|index| (witnesses(index), *index))
            .map(|index| self.pending[index].edge())
    }
}

/// Uncertainty of each keyframe relative to one.
fn uncertainties(graph: &Graph, keyframe: usize) -> Vec<Option<Symmetric3>> {
    let mut found = vec![None; graph.poses.len()];
    for uncertainty in uncertainties_from(graph, keyframe, MOST_M) {
        found[uncertainty.keyframe] = Some(uncertainty.covariance);
    }
    found
}

/// Compares two closures over the paths between them by squared Mahalanobis distance: from the old keyframe
/// of one along the old path to that of the other, through its closure to the new path, back along it, and
/// through the first closure to the start. (Pairwise consistency: Mangelson et al. 2018.)
fn consistency(
    a: &Candidate,
    b: &Candidate,
    graph: &Graph,
    from_anchor_a: &[Option<Symmetric3>],
    from_middle_a: &[Option<Symmetric3>],
) -> Consistency {
    let (Some(new_way), Some(old_way)) = (from_anchor_a[b.anchor], from_middle_a[b.middle]) else {
        return Consistency::Uninformative;
    };
    // Both paths from the old keyframe of `a` to the anchor of `b`.
    let by_old = graph.between(a.middle, b.middle);
    let by_new = graph.between(a.anchor, b.anchor);
    let loose = Symmetric3::diagonal(0.01, 0.01, 0.0005);
    let over_old = by_old * b.middle_from_anchor;
    let old_covariance = old_way.compounded(by_old, b.middle_from_anchor, &loose);
    let over_new = a.middle_from_anchor * by_new;
    let new_covariance = loose.compounded(a.middle_from_anchor, by_new, &new_way);
    let error = [
        over_old.x_m - over_new.x_m,
        over_old.y_m - over_new.y_m,
        normalize_angle(over_old.yaw_rad - over_new.yaw_rad),
    ];
    let sum = old_covariance + new_covariance;
    let Some(information) = sum.inverse() else { return Consistency::Uninformative };
    if information.quadratic(error) >= CONSISTENT_SQUARED_SIGMAS {
        return Consistency::Contradicts;
    }
    let by_chance_m = 3.0 * sum.largest_shift().sqrt();
    if by_chance_m
        < (UNINFORMATIVE_REGION_RATIO * a.region_m.min(b.region_m)).max(UNINFORMATIVE_REGION_M)
    {
        Consistency::Agrees
    } else {
        Consistency::Uninformative
    }
}
