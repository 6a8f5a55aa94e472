//! Motions from a node of the search: those of a car, or of a state lattice.

use std::f64::consts::PI;

use periplus_geometry::Pose2;

use super::collision::CollisionChecker;
use super::graph::SmacNode;
use super::headings::Headings;
use super::lattice::Lattice;
use super::primitives::{PrimitiveSet, StepPenalties};

/// Length below which a motion is a rotation in place, and an arc is none \[m\].
const NO_LENGTH_M: f64 = 1e-4;
const NO_ARC_M: f64 = 1e-3;

/// End of a motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) bin: usize,
    pub(crate) motion: u16,
}

/// Motions by heading.
#[derive(Debug)]
pub(crate) enum Motions {
    /// Arcs and straight motions of one length.
    Car(CarMotions),
    /// Motions of a lattice.
    Lattice(LatticeMotions),
}

/// Primitives of Hybrid-A*, rotated to all headings.
#[derive(Debug)]
pub(crate) struct CarMotions {
    set: PrimitiveSet,
    /// Displacement by heading and primitive \[cells\].
    offsets: Vec<Vec<[f64; 2]>>,
    penalties: StepPenalties,
    /// Factor of the length of a step by the cost of its cell.
    cell_factors: Vec<f32>,
    /// Cost of a change between forwards and backwards.
    cusp_cost: f32,
}

/// Primitives of a lattice, forwards and perhaps backwards.
#[derive(Debug)]
pub(crate) struct LatticeMotions {
    motions: Vec<LatticeMotion>,
    /// Motions by heading at their start.
    by_bin: Vec<Vec<u16>>,
    penalties: StepPenalties,
    rotation_penalty: f64,
}

#[derive(Debug)]
struct LatticeMotion {
    end_bin: usize,
    is_left: bool,
    is_arc: bool,
    is_rotation: bool,
    is_reverse: bool,
    /// Length \[cells\].
    length: f64,
    /// Poses from the start to the end \[cells, rad\].
    poses: Vec<Pose2>,
}

impl LatticeMotion {
    /// Returns the poses between the ends.
    fn inner_poses(&self) -> &[Pose2] {
        self.poses.get(1..self.poses.len().saturating_sub(1)).unwrap_or_default()
    }
}

impl CarMotions {
    pub(crate) fn new(
        set: PrimitiveSet,
        penalties: StepPenalties,
        cusp_cost: f64,
        headings: &Headings,
    ) -> Self {
        let rotated = |bin: usize| {
            let (sine, cosine) = libm::sincos(headings.angle_rad(bin));
            let rotate = |x: f64, y: f64| [x * cosine - y * sine, x * sine + y * cosine];
            set.primitives.iter().map(|primitive| rotate(primitive.x, primitive.y)).collect()
        };
        let offsets = (0..headings.count()).map(rotated).collect();
        let factor = |cost: u8| penalties.cell_factor(f64::from(cost)) as f32;
        let cell_factors = (0..=u8::MAX).map(factor).collect();
        Self { set, offsets, penalties, cell_factors, cusp_cost: cusp_cost as f32 }
    }
}

impl LatticeMotions {
    pub(crate) fn new(
        lattice: &Lattice,
        penalties: StepPenalties,
        rotation_penalty: f64,
        reverses: bool,
    ) -> Self {
        let count = lattice.headings_rad.len();
        let opposite = |bin: usize| (bin + count / 2) % count;
        let (mut motions, mut by_bin) = (Vec::new(), vec![Vec::new(); count]);
        for primitive in &lattice.primitives {
            for is_reverse in [false, true] {
                if is_reverse && !reverses || motions.len() >= usize::from(u16::MAX) {
                    continue;
                }
                let turned = |bin: usize| if is_reverse { opposite(bin) } else { bin };
                let turn_rad = if is_reverse { PI } else { 0.0 };
                let pose = |pose: &Pose2| {
                    let cells = |at_m: f64| at_m / lattice.resolution_m;
                    Pose2::new(cells(pose.x_m), cells(pose.y_m), pose.yaw_rad + turn_rad)
                };
                by_bin[turned(primitive.start_bin)].push(motions.len() as u16);
                motions.push(LatticeMotion {
                    end_bin: turned(primitive.end_bin),
                    is_left: primitive.is_left,
                    is_arc: primitive.arc_length_m >= NO_ARC_M,
                    is_rotation: primitive.length_m < NO_LENGTH_M,
                    is_reverse,
                    length: primitive.length_m / lattice.resolution_m,
                    poses: primitive.poses.iter().map(pose).collect(),
                });
            }
        }
        Self { motions, by_bin, penalties, rotation_penalty }
    }

    /// Returns the highest cost along a motion from a node; none if it collides. Each pose that the path will
    /// have is checked; Nav2 leaves out those within a cell of the last one.
    fn free_cost(
        &self,
        from: &SmacNode,
        to: &Candidate,
        checker: &CollisionChecker<'_>,
    ) -> Option<u8> {
        let mut highest = checker.free_cost(to.x, to.y, to.bin)?;
        for pose in self.motions[usize::from(to.motion)].inner_poses() {
            let (x_m, y_m) = (from.x + pose.x_m, from.y + pose.y_m);
            highest = highest.max(checker.free_cost_at(Pose2 { x_m, y_m, ..*pose })?);
        }
        Some(highest)
    }

    fn step_cost(&self, before: Option<u16>, motion: u16, cell_cost: u8) -> f64 {
        let to = &self.motions[usize::from(motion)];
        let Some(before) = before.map(|before| &self.motions[usize::from(before)]) else {
            return to.length;
        };
        if to.is_rotation {
            return self.rotation_penalty
                * (1.0 + self.penalties.cost * f64::from(cell_cost) / 252.0);
        }
        let turning = if to.is_arc {
            let changes = before.is_left != to.is_left;
            self.penalties.non_straight + if changes { self.penalties.change } else { 0.0 }
        } else {
            1.0
        };
        let reverse = if to.is_reverse { self.penalties.reverse } else { 1.0 };
        to.length * self.penalties.cell_factor(f64::from(cell_cost)) * turning * reverse
    }
}

impl Motions {
    /// Returns the number of motions from a heading.
    pub(crate) fn count(&self, bin: usize) -> usize {
        match self {
            Self::Car(car) => car.set.primitives.len(),
            Self::Lattice(lattice) => lattice.by_bin[bin].len(),
        }
    }

    /// Returns the end of a motion from a node.
    pub(crate) fn candidate(&self, from: &SmacNode, index: usize) -> Candidate {
        let bin = usize::from(from.bin);
        match self {
            Self::Car(car) => {
                let primitive = &car.set.primitives[index];
                let [dx, dy] = car.offsets[bin][index];
                let bins = car.offsets.len() as i32;
                let end = (i32::from(from.bin) + primitive.bins).rem_euclid(bins) as usize;
                Candidate { x: from.x + dx, y: from.y + dy, bin: end, motion: index as u16 }
            }
            Self::Lattice(lattice) => {
                let motion = lattice.by_bin[bin][index];
                let LatticeMotion { end_bin, poses, .. } = &lattice.motions[usize::from(motion)];
                let end = poses.last().copied().unwrap_or_default();
                Candidate { x: from.x + end.x_m, y: from.y + end.y_m, bin: *end_bin, motion }
            }
        }
    }

    /// Returns the cost of a motion; none if it collides.
    pub(crate) fn cost(
        &self,
        from: &SmacNode,
        to: &Candidate,
        checker: &CollisionChecker<'_>,
    ) -> Option<f32> {
        match self {
            Self::Car(car) => {
                let cell_cost = checker.free_cost(to.x, to.y, to.bin)?;
                let primitive = |motion: u16| &car.set.primitives[usize::from(motion)];
                let before = from.motion.map(|motion| primitive(motion).turn);
                let to = primitive(to.motion);
                let turn_factor = car.penalties.turn_factor(before, to.turn) as f32;
                let is_cusp = before.is_some_and(|it| it.is_reverse() != to.turn.is_reverse());
                let cusp_cost = if is_cusp { car.cusp_cost } else { 0.0 };
                let factor = car.cell_factors[usize::from(cell_cost)] * turn_factor;
                Some(to.travel as f32 * factor + cusp_cost)
            }
            Self::Lattice(lattice) => {
                let cell_cost = lattice.free_cost(from, to, checker)?;
                Some(lattice.step_cost(from.motion, to.motion, cell_cost) as f32)
            }
        }
    }

    /// Adds the poses between the ends of a motion from a pose \[cells, rad\].
    pub(crate) fn add_inner_poses(&self, from: Pose2, motion: u16, path: &mut Vec<Pose2>) {
        let Self::Lattice(lattice) = self else { return };
        let inner = lattice.motions[usize::from(motion)].inner_poses();
        path.extend(inner.iter().map(|pose| Pose2 {
            x_m: from.x_m + pose.x_m,
            y_m: from.y_m + pose.y_m,
            ..*pose
        }));
    }
}
