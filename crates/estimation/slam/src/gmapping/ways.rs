//! Trajectories of the particles as a tree: particles with the same ancestor share the path to it.

use periplus_geometry::Pose2;

/// A pose of a trajectory.
struct Node {
    map_from_base: Pose2,
    /// The one before; [`NO_NODE_INDEX`] for the first.
    before: u32,
    /// Nodes and particles that go on from here.
    users: u32,
}

const NO_NODE_INDEX: u32 = u32::MAX;

/// Trajectories of all particles. Branches without a particle are dropped.
#[derive(Default)]
pub(super) struct Ways {
    nodes: Vec<Node>,
    unused: Vec<u32>,
}

/// End of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tip(u32);

impl Ways {
    /// Starts a trajectory.
    pub(super) fn begin(&mut self, map_from_base: Pose2) -> Tip {
        self.add(map_from_base, NO_NODE_INDEX)
    }

    /// Creates a trajectory along poses, of which there is at least one.
    pub(super) fn along(&mut self, poses: &[Pose2]) -> Tip {
        let tip = self.begin(poses[0]);
        poses[1..].iter().fold(tip, |tip, &pose| self.go_on(tip, pose))
    }

    /// Goes on from a tip, which thereby is none any more.
    pub(super) fn go_on(&mut self, tip: Tip, map_from_base: Pose2) -> Tip {
        // What held the tip now holds the new node, which holds the old one.
        self.add(map_from_base, tip.0)
    }

    fn add(&mut self, map_from_base: Pose2, before: u32) -> Tip {
        let node = Node { map_from_base, before, users: 1 };
        match self.unused.pop() {
            Some(at) => {
                self.nodes[at as usize] = node;
                Tip(at)
            }
            None => {
                self.nodes.push(node);
                Tip(self.nodes.len() as u32 - 1)
            }
        }
    }

    /// One more particle goes on from a tip.
    pub(super) fn share(&mut self, tip: Tip) {
        self.nodes[tip.0 as usize].users += 1;
    }

    /// A particle ends here.
    pub(super) fn end(&mut self, tip: Tip) {
        let mut at = tip.0;
        while at != NO_NODE_INDEX {
            let node = &mut self.nodes[at as usize];
            node.users -= 1;
            if node.users > 0 {
                break;
            }
            self.unused.push(at);
            at = node.before;
        }
    }

    /// The way to a tip, from the first pose on.
    pub(super) fn to(&self, tip: Tip) -> Vec<Pose2> {
        let mut way = Vec::new();
        let mut at = tip.0;
        while at != NO_NODE_INDEX {
            let node = &self.nodes[at as usize];
            way.push(node.map_from_base);
            at = node.before;
        }
        way.reverse();
        way
    }

    /// Poses that are remembered.
    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.nodes.len() - self.unused.len()
    }

    /// Bytes held, about.
    pub(super) fn size(&self) -> usize {
        self.nodes.len() * size_of::<Node>() + self.unused.len() * 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_share_what_they_have_in_common_and_forget_the_rest() {
        let at = |x| Pose2::new(x, 0.0, 0.0);
        let mut ways = Ways::default();
        let start = ways.begin(at(0.0));
        ways.share(start);
        let a = ways.go_on(start, at(1.0));
        let b = ways.go_on(start, at(2.0));
        assert_eq!(ways.to(a), [at(0.0), at(1.0)]);
        assert_eq!(ways.to(b), [at(0.0), at(2.0)]);
        let b = ways.go_on(b, at(3.0));
        assert_eq!(ways.len(), 4);
        ways.end(b);
        assert_eq!(ways.len(), 2);
        assert_eq!(ways.to(a), [at(0.0), at(1.0)]);
        ways.end(a);
        assert_eq!(ways.len(), 0);
    }

    #[test]
    fn a_way_of_a_million_poses_ends() {
        let mut ways = Ways::default();
        let mut tip = ways.begin(Pose2::IDENTITY);
        for _ in 0..1_000_000 {
            tip = ways.go_on(tip, Pose2::IDENTITY);
        }
        ways.end(tip);
        assert_eq!(ways.len(), 0);
    }
}
