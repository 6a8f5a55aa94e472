//! In which order unknowns are eliminated.

use std::collections::{BTreeMap, BTreeSet};

/// An order of elimination with little fill: always the node with about the fewest neighbours among
/// those that are left. Elimination joins all neighbours of a node; such a clique is kept as one
/// element, the list of its nodes, and nodes that have become alike are one from then on.
///
/// Source: Amestoy, Davis, Duff 1996, "An approximate minimum degree ordering algorithm".
pub(crate) fn order(neighbours: Vec<Vec<u32>>) -> Vec<u32> {
    let mut rest = Rest::new(neighbours);
    let mut order = Vec::with_capacity(rest.nodes.len());
    while let Some((_, node)) = rest.queue.pop_first() {
        rest.eliminate(node as usize, &mut order);
    }
    order
}

/// A node that is left, or one that was eliminated: an element.
#[derive(Default)]
struct Node {
    /// Neighbours that no element joins it to.
    plain: Vec<u32>,
    /// Elements it is part of.
    elements: Vec<u32>,
    /// Nodes of an active element.
    clique: Vec<u32>,
    /// Nodes that are like it, and go with it.
    alike: Vec<u32>,
    /// Number of unknowns it represents; 0 once eliminated.
    weight: usize,
    /// Upper bound of the number of neighbours.
    degree: usize,
}

/// Remaining graph during elimination.
struct Rest {
    nodes: Vec<Node>,
    /// Nodes by degree.
    queue: BTreeSet<(usize, u32)>,
    /// In which round a node was last met.
    met: Vec<u32>,
    /// Weight of an element outside of the newest one, and the round in which it was computed.
    outside: Vec<(u32, usize)>,
    round: u32,
}

impl Rest {
    fn new(neighbours: Vec<Vec<u32>>) -> Self {
        let count = neighbours.len();
        let node = |(own, mut plain): (usize, Vec<u32>)| {
            plain.sort_unstable();
            plain.dedup();
            plain.retain(|&it| it as usize != own);
            Node { degree: plain.len(), plain, weight: 1, ..Node::default() }
        };
        let nodes: Vec<Node> = neighbours.into_iter().enumerate().map(node).collect();
        let queue = nodes.iter().zip(0..).map(|(it, own)| (it.degree, own)).collect();
        Self { nodes, queue, met: vec![0; count], outside: vec![(0, 0); count], round: 0 }
    }

    fn eliminate(&mut self, node: usize, order: &mut Vec<u32>) {
        self.round += 1;
        let Node { plain, elements, mut alike, .. } = std::mem::take(&mut self.nodes[node]);
        order.push(node as u32);
        order.append(&mut alike);
        // Elements that it is part of lie in the new one.
        let mut clique = Vec::new();
        self.meet(&plain, &mut clique);
        for element in elements {
            let old = std::mem::take(&mut self.nodes[element as usize].clique);
            self.meet(&old, &mut clique);
        }
        clique.sort_unstable();
        self.count_outside(&clique);
        let size = clique.iter().map(|&it| self.nodes[it as usize].weight).sum();
        for &other in &clique {
            self.join(other, node as u32, size);
        }
        self.merge(&clique);
        clique.retain(|&it| self.nodes[it as usize].weight > 0);
        self.queue.extend(clique.iter().map(|&it| (self.nodes[it as usize].degree, it)));
        self.nodes[node].clique = clique;
    }

    /// Takes nodes that are left and not met in this round.
    fn meet(&mut self, nodes: &[u32], into: &mut Vec<u32>) {
        for &it in nodes {
            let at = it as usize;
            if self.nodes[at].weight > 0 && self.met[at] != self.round {
                self.met[at] = self.round;
                into.push(it);
            }
        }
    }

    /// Computes the weight of the elements around a new one outside of it.
    fn count_outside(&mut self, clique: &[u32]) {
        for &it in clique {
            let weight = self.nodes[it as usize].weight;
            for &element in &self.nodes[it as usize].elements {
                let nodes = &self.nodes[element as usize].clique;
                let (round, outside) = &mut self.outside[element as usize];
                if *round != self.round {
                    *round = self.round;
                    *outside = nodes.iter().map(|&it| self.nodes[it as usize].weight).sum();
                }
                *outside = outside.saturating_sub(weight);
            }
        }
    }

    /// Makes a node part of a new element of some size.
    fn join(&mut self, node: u32, element: u32, size: usize) {
        let at = node as usize;
        self.queue.remove(&(self.nodes[at].degree, node));
        let mut elements = std::mem::take(&mut self.nodes[at].elements);
        // Elements that lie in the new one are needed no more.
        elements.retain(|&it| self.outside[it as usize].1 > 0);
        let mut plain = std::mem::take(&mut self.nodes[at].plain);
        plain.retain(|&it| {
            self.nodes[it as usize].weight > 0 && self.met[it as usize] != self.round
        });
        let outside: usize = elements.iter().map(|&it| self.outside[it as usize].1).sum();
        let apart: usize = plain.iter().map(|&it| self.nodes[it as usize].weight).sum();
        elements.push(element);
        let it = &mut self.nodes[at];
        let inside = size - it.weight;
        it.degree = (inside + outside + apart).min(it.degree + inside);
        it.plain = plain;
        it.elements = elements;
    }

    /// Makes one of those nodes of a new element that have the same neighbours.
    fn merge(&mut self, clique: &[u32]) {
        let mut alike: BTreeMap<(&[u32], &[u32]), Vec<u32>> = BTreeMap::new();
        for &it in clique {
            let Node { elements, plain, .. } = &self.nodes[it as usize];
            alike.entry((elements, plain)).or_default().push(it);
        }
        let groups: Vec<Vec<u32>> = alike.into_values().filter(|it| it.len() > 1).collect();
        for group in groups {
            for &other in &group[1..] {
                let Node { alike, weight, .. } = std::mem::take(&mut self.nodes[other as usize]);
                let first = &mut self.nodes[group[0] as usize];
                first.weight += weight;
                first.degree -= weight;
                first.alike.push(other);
                first.alike.extend(alike);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours on a lattice.
    fn lattice(side: usize) -> Vec<Vec<u32>> {
        let at = |x: usize, y: usize| (y * side + x) as u32;
        let mut neighbours = vec![Vec::new(); side * side];
        for y in 0..side {
            for x in 0..side {
                for (u, v) in [(x + 1, y), (x, y + 1)] {
                    if u < side && v < side {
                        neighbours[at(x, y) as usize].push(at(u, v));
                        neighbours[at(u, v) as usize].push(at(x, y));
                    }
                }
            }
        }
        neighbours
    }

    /// Blocks below the diagonal after an elimination in some order.
    fn fill(neighbours: &[Vec<u32>], order: &[u32]) -> usize {
        let mut left: Vec<BTreeSet<u32>> =
            neighbours.iter().map(|it| it.iter().copied().collect()).collect();
        let mut count = 0;
        for node in order {
            let around = std::mem::take(&mut left[*node as usize]);
            count += around.len();
            for it in &around {
                let own = &mut left[*it as usize];
                own.extend(around.iter().filter(|other| *other != it));
                own.remove(node);
            }
        }
        count
    }

    #[test]
    fn every_node_is_eliminated_once() {
        for side in [0, 1, 2, 3, 9] {
            let mut all = order(lattice(side));
            all.sort_unstable();
            assert!(all.iter().copied().eq(0..(side * side) as u32));
        }
    }

    #[test]
    fn a_chain_and_a_star_fill_nothing() {
        let chain: Vec<Vec<u32>> = vec![vec![1], vec![0, 2], vec![1, 3], vec![2]];
        assert_eq!(fill(&chain, &order(chain.clone())), 3);
        let star: Vec<Vec<u32>> = vec![vec![1, 2, 3, 4], vec![0], vec![0], vec![0], vec![0]];
        assert_eq!(fill(&star, &order(star.clone())), 4);
    }

    /// Row by row a lattice of 24 by 24 fills 13,000 blocks.
    #[test]
    fn a_lattice_fills_little() {
        let lattice = lattice(24);
        let rows: Vec<u32> = (0..24 * 24).collect();
        let (by_rows, by_degree) = (fill(&lattice, &rows), fill(&lattice, &order(lattice.clone())));
        assert!(by_rows > 12_000 && by_degree < by_rows / 2, "{by_rows} {by_degree}");
    }
}
