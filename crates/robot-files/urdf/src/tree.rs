//! Tree of links and joints.

use std::collections::BTreeMap;

use crate::robot::{UrdfJoint, UrdfRobot};

/// Links of a robot as a tree over indices into [`Robot::links`] and [`Robot::joints`]. If the file is
/// inconsistent (two parents, a cycle), the tree keeps the first definition and drops the others;
/// [`crate::read`] has reported them.
#[derive(Clone, Debug)]
pub(crate) struct Tree<'a> {
    /// The first link of each name.
    pub(crate) index: BTreeMap<&'a str, usize>,
    /// The joint above each link.
    pub(crate) joint_above: Vec<Option<usize>>,
    /// The parent of each link.
    pub(crate) parent: Vec<Option<usize>>,
    /// Joints below each link, sorted by name: liburdfdom keeps them in a map, and Gazebo lumps and numbers
    /// in this order.
    pub(crate) joints_below: Vec<Vec<usize>>,
    /// The child link of each joint that is in the tree.
    pub(crate) child: Vec<Option<usize>>,
    /// Links without parent, in file order.
    pub(crate) roots: Vec<usize>,
}

impl<'a> Tree<'a> {
    pub(crate) fn new(robot: &'a UrdfRobot) -> Self {
        let mut index: BTreeMap<&'a str, usize> = BTreeMap::new();
        for (place, link) in robot.links.iter().enumerate() {
            index.entry(&link.name).or_insert(place);
        }
        let count = robot.links.len();
        let mut tree = Self {
            joint_above: vec![None; count],
            parent: vec![None; count],
            joints_below: vec![Vec::new(); count],
            child: vec![None; robot.joints.len()],
            roots: Vec::new(),
            index,
        };
        // Union-find keeps cycles out in nearly linear time.
        let mut group: Vec<usize> = (0..count).collect();
        for (place, joint) in robot.joints.iter().enumerate() {
            let ends = (tree.index.get(&*joint.parent), tree.index.get(&*joint.child));
            let (Some(&parent), Some(&child)) = ends else { continue };
            let (top, bottom) = (find(&mut group, parent), find(&mut group, child));
            if tree.parent[child].is_some() || top == bottom {
                continue;
            }
            group[bottom] = top;
            tree.parent[child] = Some(parent);
            tree.joint_above[child] = Some(place);
            tree.child[place] = Some(child);
            tree.joints_below[parent].push(place);
        }
        for below in &mut tree.joints_below {
            below.sort_by(|a, b| name(robot, *a).cmp(name(robot, *b)));
        }
        tree.roots = (0..count)
            .filter(|&link| {
                tree.parent[link].is_none()
                    && tree.index.get(&*robot.links[link].name) == Some(&link)
            })
            .collect();
        tree
    }

    /// The joints below a link, sorted by name, each with its child.
    pub(crate) fn children(&self, link: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.joints_below[link].iter().filter_map(|&joint| Some((joint, self.child[joint]?)))
    }

    /// A link and all links below it, each before its children, children by name of their joint.
    pub(crate) fn below(&self, link: usize) -> Vec<usize> {
        let mut order = Vec::new();
        let mut open = vec![link];
        while let Some(link) = open.pop() {
            order.push(link);
            let children: Vec<usize> = self.children(link).map(|(_, child)| child).collect();
            open.extend(children.into_iter().rev());
        }
        order
    }
}

fn name(robot: &UrdfRobot, joint: usize) -> &str {
    let joint: &UrdfJoint = &robot.joints[joint];
    &joint.name
}

fn find(group: &mut [usize], mut member: usize) -> usize {
    while group[member] != member {
        group[member] = group[group[member]];
        member = group[member];
    }
    member
}
