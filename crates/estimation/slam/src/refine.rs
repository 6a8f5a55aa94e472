//! All scans against their neighbours at once.

use std::collections::BTreeMap;
use std::rc::Rc;

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, agreement, compare};

use crate::graph::{ConstraintKind, Graph, System, error, pose_clusters};
use crate::keyframe::Keyframe;
use crate::local::apart;
use crate::settings::Settings;

/// Scans farther apart than this are not compared \[m\].
const REACH_M: f64 = 5.0;
/// Distance equivalent of a rotation by one radian between two scans \[m\].
const TURN_M: f64 = 0.3;
/// Scans within this way of each other need no proof that they see the same \[m\].
const SAME_VISIT_M: f64 = 6.0;
/// Widths of partners and of weights from the first sweep to the last \[m\].
const PARTNERS_M: [f32; 2] = [0.3, 0.15];
const WEIGHTS_M: [f32; 2] = [0.12, 0.06];
/// Weight of the sequential constraints: along corridors only odometry measures the distance.
const SEQUENTIAL_FACTOR: f64 = 0.1;
/// A sweep moves poses by centimetres: one that would move some by more is not believed \[m\].
const FARTHEST_M: f64 = 2.0;

/// Refines all poses: each keyframe is compared with its spatial neighbours, points of each against lines
/// of the other, and all poses are solved for together, several times, since better poses give better
/// correspondences. Each pose is then constrained by everything seen around it, independent of the order of
/// the drive.
///
/// Each pair is added to the normal equations directly: a map of kilometres has some hundred thousand
/// pairs.
pub(crate) fn refine(keyframes: &[Keyframe], graph: &mut Graph, settings: &Settings) {
    let pairs = choose(keyframes, graph, settings);
    for sweep in 0..settings.refine_sweeps {
        let Some((poses, farthest_m)) = refined(keyframes, graph, &pairs, sweep, settings) else {
            return;
        };
        if farthest_m > FARTHEST_M {
            return;
        }
        graph.poses = poses;
    }
}

/// Poses after a sweep, and by how much the farthest has moved; none when they cannot be solved for.
fn refined(
    keyframes: &[Keyframe],
    graph: &Graph,
    pairs: &[(usize, usize)],
    sweep: usize,
    settings: &Settings,
) -> Option<(Vec<Pose2>, f64)> {
    let sweeps = settings.refine_sweeps;
    let part = if sweeps > 1 { sweep as f32 / (sweeps - 1) as f32 } else { 1.0 };
    let width = |[from, to]: [f32; 2]| from + (to - from) * part;
    let poses = &graph.poses;
    let chain = || graph.edges.iter().filter(|edge| edge.kind == ConstraintKind::Sequential);
    let bodies = pose_clusters(graph, (poses.len(), graph.edges.len()), sweep);
    let ends = || chain().map(|edge| (edge.from, edge.to)).chain(pairs.iter().copied());
    let mut system = System::new(&bodies, ends);
    for edge in chain() {
        let information = edge.information * SEQUENTIAL_FACTOR;
        system.add(poses, (edge.from, edge.to), edge.error(poses), &information);
    }
    let mut clouds = Clouds::new(keyframes);
    for &(from, to) in pairs {
        let held = compare(
            &clouds.get(to),
            &clouds.get(from),
            graph.between(from, to),
            width(PARTNERS_M),
            width(WEIGHTS_M),
            if sweep + 2 < sweeps { 2 } else { 1 },
            &settings.register,
        );
        if held.matched >= 0.3 {
            let off = error(poses, (from, to), held.target_from_moving);
            system.add(poses, (from, to), off, &held.information);
        }
    }
    system.hold(0.0);
    system.factorize(0, system.len(), usize::MAX)?;
    Some(system.solve(poses))
}

/// Clouds that were looked at last, unpacked.
struct Clouds<'a> {
    keyframes: &'a [Keyframe],
    kept: Vec<Option<(usize, Rc<Cloud>)>>,
}

/// Size of the cache.
const CACHED_CLOUD_COUNT: usize = 128;

impl<'a> Clouds<'a> {
    fn new(keyframes: &'a [Keyframe]) -> Self {
        Self { keyframes, kept: vec![None; CACHED_CLOUD_COUNT] }
    }

    fn get(&mut self, keyframe: usize) -> Rc<Cloud> {
        let kept = &mut self.kept[keyframe % CACHED_CLOUD_COUNT];
        match kept {
            Some((of, cloud)) if *of == keyframe => Rc::clone(cloud),
            _ => {
                let cloud = Rc::new(self.keyframes[keyframe].cloud());
                *kept = Some((keyframe, Rc::clone(&cloud)));
                cloud
            }
        }
    }
}

/// Pairs of scans that see the same, the earlier first.
fn choose(keyframes: &[Keyframe], graph: &Graph, settings: &Settings) -> Vec<(usize, usize)> {
    let mut clouds = Clouds::new(keyframes);
    let cell = |keyframe: usize| {
        let pose = graph.poses[keyframe];
        ((pose.x_m / REACH_M).floor() as i32, (pose.y_m / REACH_M).floor() as i32)
    };
    let mut cells: BTreeMap<(i32, i32), Vec<usize>> = BTreeMap::new();
    let mut pairs = Vec::new();
    for keyframe in 0..keyframes.len() {
        let (column, row) = cell(keyframe);
        let mut near: Vec<(f64, usize)> = Vec::new();
        for dx in -1..=1 {
            for dy in -1..=1 {
                let there = cells.get(&(column + dx, row + dy)).into_iter().flatten();
                near.extend(there.filter_map(|&other| {
                    let (metres, radians) = apart(graph.poses[keyframe], graph.poses[other]);
                    (metres < REACH_M).then_some((metres + TURN_M * radians, other))
                }));
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut count = 0;
        let is_gap = |&edge: &u32| {
            let edge = &graph.edges[edge as usize];
            edge.is_gap() && edge.to == keyframe
        };
        // A component that begins here is connected to nothing before.
        let begins = keyframe == 0 || graph.at[keyframe].iter().any(is_gap);
        let mut is_chained = begins;
        for (_, other) in near {
            if count >= settings.refine_neighbours {
                break;
            }
            if (other + 1 == keyframe && !begins) || is_alike(&mut clouds, graph, other, keyframe) {
                pairs.push((other, keyframe));
                is_chained |= other + 1 == keyframe;
                count += 1;
            }
        }
        if !is_chained {
            pairs.push((keyframe - 1, keyframe));
        }
        cells.entry((column, row)).or_default().push(keyframe);
    }
    pairs
}

/// True if two scans overlap and agree.
fn is_alike(clouds: &mut Clouds<'_>, graph: &Graph, a: usize, b: usize) -> bool {
    let a_from_b = graph.between(a, b);
    let keyframes = clouds.keyframes;
    let (at_a, at_b) = (clouds.get(a), clouds.get(b));
    let mut sum = agreement(&at_b, &at_a, a_from_b, 0.25);
    let least = if (keyframes[b].travel_m - keyframes[a].travel_m).abs() < SAME_VISIT_M {
        0.5
    } else {
        0.75
    };
    if sum.agreeing < 20 || sum.share() < least {
        return false;
    }
    sum += agreement(&at_a, &at_b, a_from_b.inverse(), 0.25);
    sum.share() >= least
}
