//! The normal equations of a step: what all edges together ask of the poses.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use super::cholesky::{Block, Factor};
use super::order::order;

/// The equations for changes of poses. Unknown are the poses that lead a body; the others ride along,
/// as if the body were stiff (see [`super::riders`]).
pub(crate) struct System {
    /// Position of each pose's cluster in the elimination order.
    place: Vec<u32>,
    /// The pose that leads the body of each.
    lead: Vec<u32>,
    /// The matrix, and then its factor.
    factor: Factor,
    /// The right side, and then the changes: a shift along the axes of the map and a turn.
    right: Vec<[f64; 3]>,
}

impl System {
    /// Equations for poses that are part of bodies (in order, as [`super::riders`] gives them), and
    /// for edges between poses.
    pub(crate) fn new<E>(body: &[u32], edges: impl Fn() -> E) -> Self
    where
        E: Iterator<Item = (usize, usize)>,
    {
        let order = order(neighbours(body, edges()));
        let mut place = vec![0; order.len()];
        for (at, &body) in order.iter().enumerate() {
            place[body as usize] = at as u32;
        }
        Self::placed(body.iter().map(|&body| place[body as usize]).collect(), edges())
    }

    /// The same with a given order.
    fn placed(place: Vec<u32>, edges: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut first = 0;
        let lead = (0..place.len()).map(|pose| {
            if place[pose] != place[first] {
                first = pose;
            }
            first as u32
        });
        let lead = lead.collect();
        let factor = Factor::new(&neighbours(&place, edges));
        let right = vec![[0.0; 3]; factor.len()];
        Self { place, lead, factor, right }
    }

    /// Rebuilds the system from positions in the elimination order; `None` if they are not a permutation.
    pub(crate) fn resumed(
        place: Vec<u32>,
        edges: impl Iterator<Item = (usize, usize)>,
    ) -> Option<Self> {
        let mut is_taken = vec![false; bodies(&place).min(place.len())];
        for (pose, &at) in place.iter().enumerate() {
            let is_riding = pose > 0 && place[pose - 1] == at;
            let is_taken = is_taken.get_mut(at as usize)?;
            if std::mem::replace(is_taken, true) != is_riding {
                return None;
            }
        }
        is_taken.iter().all(|&it| it).then(|| Self::placed(place, edges))
    }

    /// Positions of the poses' clusters in the elimination order.
    pub(crate) fn places(&self) -> &[u32] {
        &self.place
    }

    /// Number of clusters.
    pub(crate) fn len(&self) -> usize {
        self.factor.len()
    }

    /// Nothing is asked.
    pub(crate) fn clear(&mut self) {
        self.factor.clear();
        self.right.fill([0.0; 3]);
    }

    /// Adds what is known between two poses: by how much it is off, and how sure it is. The ends must
    /// be those of an edge that the equations were made for.
    pub(crate) fn add(
        &mut self,
        poses: &[Pose2],
        (from, to): (usize, usize),
        error: [f64; 3],
        information: &Symmetric3,
    ) {
        let (i, j) = (self.place[from] as usize, self.place[to] as usize);
        if i == j {
            return;
        }
        let (a, b) = (poses[from], poses[to]);
        let (s, c) = libm::sincos(a.yaw_rad);
        let (dx, dy) = (b.x_m - a.x_m, b.y_m - a.y_m);
        let (x, y) = (c * dx + s * dy, c * dy - s * dx);
        let at_from = [[-c, -s, y], [s, -c, -x], [0.0, 0.0, -1.0]];
        let at_to = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]];
        let at_from = self.led(at_from, poses, from);
        let at_to = self.led(at_to, poses, to);
        sum(self.factor.diagonal(i), &product(&at_from, information, &at_from));
        sum(self.factor.diagonal(j), &product(&at_to, information, &at_to));
        if i < j {
            sum(self.factor.block(j, i), &product(&at_to, information, &at_from));
        } else {
            sum(self.factor.block(i, j), &product(&at_from, information, &at_to));
        }
        let pull = information.times(error);
        for k in 0..3 {
            for l in 0..3 {
                self.right[i][l] -= at_from[k][l] * pull[k];
                self.right[j][l] -= at_to[k][l] * pull[k];
            }
        }
    }

    /// Derivatives by a pose as those by the one it rides with: a turn there moves it.
    fn led(&self, by: [[f64; 3]; 3], poses: &[Pose2], pose: usize) -> [[f64; 3]; 3] {
        let lead = self.lead[pose] as usize;
        if lead == pose {
            return by;
        }
        let (dx, dy) = (poses[pose].x_m - poses[lead].x_m, poses[pose].y_m - poses[lead].y_m);
        by.map(|[x, y, turn]| [x, y, turn - x * dy + y * dx])
    }

    /// Holds the first pose where it is, and all a little, by this part of what is known of them.
    pub(crate) fn hold(&mut self, damping: f64) {
        for at in 0..self.factor.len() {
            let block = self.factor.diagonal(at);
            for k in [0, 4, 8] {
                block[k] += damping * block[k] + 1e-9;
            }
        }
        if let Some(&first) = self.place.first() {
            let block = self.factor.diagonal(first as usize);
            for k in [0, 4, 8] {
                block[k] += 1e9;
            }
        }
    }

    /// See [`Factor::factorize`].
    pub(crate) fn factorize(&mut self, from: usize, until: usize, most: usize) -> Option<usize> {
        self.factor.factorize(from, until, most)
    }

    /// Solves, after all columns are factorized: poses as they are then, and the largest change \[m, a
    /// turn with an arm of a metre\].
    pub(crate) fn solve(&mut self, poses: &[Pose2]) -> (Vec<Pose2>, f64) {
        self.factor.solve(&mut self.right);
        let largest = self.right.iter().flatten().fold(0.0, |most: f64, it| most.max(it.abs()));
        let mut moved: Vec<Pose2> = Vec::with_capacity(self.place.len());
        for (pose, &old) in poses.iter().enumerate().take(self.place.len()) {
            let lead = self.lead[pose] as usize;
            moved.push(if lead == pose {
                let [x, y, turn] = self.right[self.place[pose] as usize];
                Pose2::new(old.x_m + x, old.y_m + y, normalize_angle(old.yaw_rad + turn))
            } else {
                (moved[lead] * (poses[lead].inverse() * old)).normalized()
            });
        }
        (moved, largest)
    }
}

/// The other ends of edges, for bodies by their numbers.
fn neighbours(body: &[u32], edges: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<u32>> {
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); bodies(body)];
    for (from, to) in edges {
        let (from, to) = (body[from], body[to]);
        if from != to {
            neighbours[from as usize].push(to);
            neighbours[to as usize].push(from);
        }
    }
    for own in &mut neighbours {
        own.sort_unstable();
        own.dedup();
    }
    neighbours
}

/// Number of clusters.
fn bodies(body: &[u32]) -> usize {
    body.iter().max().map_or(0, |&last| last as usize + 1)
}

fn sum(target: &mut Block, part: &Block) {
    for (sum, value) in target.iter_mut().zip(part) {
        *sum += value;
    }
}

/// aᵀ · m · b.
fn product(a: &[[f64; 3]; 3], m: &Symmetric3, b: &[[f64; 3]; 3]) -> Block {
    let full = [[m.xx, m.xy, m.xt], [m.xy, m.yy, m.yt], [m.xt, m.yt, m.tt]];
    let mut middle = [[0.0; 3]; 3];
    for k in 0..3 {
        for j in 0..3 {
            middle[k][j] = full[k][0] * b[0][j] + full[k][1] * b[1][j] + full[k][2] * b[2][j];
        }
    }
    let mut block = [0.0; 9];
    for i in 0..3 {
        for j in 0..3 {
            block[3 * i + j] =
                a[0][i] * middle[0][j] + a[1][i] * middle[1][j] + a[2][i] * middle[2][j];
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use periplus_geometry::Stream;

    use super::*;
    use crate::graph::error;

    /// Clusters change from turn to turn, so that all poses converge.
    #[test]
    fn poses_that_ride_come_to_the_exact_places_by_turns() {
        let mut stream = Stream::keyed(5, "rides", 0);
        // Twice around a square of 10 by 10 steps.
        let step = |at: usize| Pose2::new(1.0, 0.0, if at % 10 == 9 { 0.5 } else { 0.0 } * PI);
        let mut truth = vec![Pose2::IDENTITY];
        for at in 0..79 {
            truth.push((truth[at] * step(at)).normalized());
        }
        let ends = || (1..80).map(|to| (to - 1, to)).chain((40..80).map(|to| (to - 40, to)));
        let information = Symmetric3::diagonal(1e4, 1e4, 1e5);
        let mut poses = truth.clone();
        for pose in &mut poses[1..] {
            let shaken = Pose2::new(stream.normal(), stream.normal(), stream.normal());
            pose.x_m += 0.1 * shaken.x_m;
            pose.y_m += 0.1 * shaken.y_m;
            pose.yaw_rad += 0.02 * shaken.yaw_rad;
        }
        for turn in 0..60 {
            let mut dice = Stream::keyed(0, "bodies", turn);
            let mut last = 0;
            let bodies = (0..80).map(|pose| {
                last += u32::from(pose > 0 && dice.unit() < 0.5);
                last
            });
            let bodies: Vec<u32> = bodies.collect();
            let mut system = System::new(&bodies, ends);
            for (from, to) in ends() {
                let known = (truth[from].inverse() * truth[to]).normalized();
                system.add(&poses, (from, to), error(&poses, (from, to), known), &information);
            }
            system.hold(0.0);
            assert_eq!(system.factorize(0, system.len(), usize::MAX), Some(system.len()));
            poses = system.solve(&poses).0;
        }
        let off = poses.iter().zip(&truth).map(|(a, b)| libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m));
        let most_m = off.fold(0.0, f64::max);
        assert!(most_m < 1e-6, "{most_m}");
    }

    #[test]
    fn places_of_another_map_are_none() {
        let ends = || [(0, 1), (1, 2)].into_iter();
        let taken = |places: &[u32]| System::resumed(places.to_vec(), ends()).is_some();
        assert!(taken(&[2, 0, 1]) && taken(&[1, 1, 0]) && taken(&[0, 0, 0]));
        assert!(!taken(&[0, 1, 0]) && !taken(&[0, 2, 3]) && !taken(&[0, 2, 2]));
        assert!(!taken(&[u32::MAX, 0, 1]));
    }
}
