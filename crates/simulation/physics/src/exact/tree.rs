//! Kinematic tree.

use periplus_geometry::{DQuat, DVec3, Pose};

use crate::engine::BodyMotion;
use crate::joints::AxisRecord;
use crate::records::{BodyKind, Records};

/// A body with a parent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChildBody {
    pub(super) body: usize,
    above: usize,
    above_from_axis: Pose,
    axis_from_body: Pose,
    /// Movable axis between them, and 1, or -1 if this body is the joint's parent. `None` for a
    /// fixed joint.
    axis: Option<(usize, f64)>,
}

/// Child bodies in topological order, parents first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(super) children: Vec<ChildBody>,
    /// Mimic axes, leaders first.
    pub(super) followers: Vec<usize>,
    hangs: Vec<bool>,
}

/// Two bodies connected by a joint, and its axis if any.
#[derive(Clone, Copy)]
struct Edge {
    one: usize,
    two: usize,
    axis: Option<usize>,
}

impl Tree {
    /// Builds the spanning tree of all bodies from the fixed ones, then from the canonical link of
    /// each model, then from the rest. A joint that closes a loop is not part of it.
    pub(super) fn of(records: &Records) -> Self {
        let count = records.bodies.len();
        let mut edges_of: Vec<Vec<Edge>> = vec![Vec::new(); count];
        let axes = records.axes.iter().enumerate().map(|(number, axis)| Edge {
            one: axis.body1,
            two: axis.body2,
            axis: Some(number),
        });
        let constraints = records.constraints.iter().map(|hold| Edge {
            one: hold.body1,
            two: hold.body2,
            axis: None,
        });
        for edge in axes.chain(constraints) {
            let gone = |body: usize| records.bodies[body].removed;
            if !gone(edge.one) && !gone(edge.two) {
                edges_of[edge.one].push(edge);
                edges_of[edge.two].push(edge);
            }
        }
        let fixed = (0..count).filter(|&body| records.bodies[body].kind == BodyKind::Fixed);
        let canonical = (0..records.models.len() as u32)
            .filter_map(|model| records.canonical(model).map(|(body, _)| body));
        let mut tree = Self { hangs: vec![false; count], ..Self::default() };
        let mut reached = vec![false; count];
        let mut open = std::collections::VecDeque::new();
        let mut roots: Vec<usize> = fixed.collect();
        for &root in &roots {
            reached[root] = true;
        }
        roots.extend(canonical);
        roots.extend(0..count);
        for root in roots {
            let first = !std::mem::replace(&mut reached[root], true);
            if !first && records.bodies[root].kind != BodyKind::Fixed {
                continue;
            }
            open.push_back(root);
            while let Some(above) = open.pop_front() {
                for &edge in &edges_of[above] {
                    let body = if edge.one == above { edge.two } else { edge.one };
                    if !std::mem::replace(&mut reached[body], true) {
                        tree.children.push(ChildBody::of(records, edge, body));
                        tree.hangs[body] = true;
                        open.push_back(body);
                    }
                }
            }
        }
        tree.followers = followers(&records.axes);
        tree
    }

    /// Returns true if a body has no parent and is not fixed.
    pub(super) fn is_free_root(&self, records: &Records, body: usize) -> bool {
        records.bodies[body].kind != BodyKind::Fixed && !self.hangs[body]
    }
}

/// Returns mimic axes after their leaders. Cycles of mimic axes come last, in the order of the file.
fn followers(axes: &[AxisRecord]) -> Vec<usize> {
    let mut waiting: Vec<usize> =
        (0..axes.len()).filter(|&axis| axes[axis].mimics.is_some()).collect();
    let mut order = Vec::with_capacity(waiting.len());
    loop {
        let leads = |axis: usize| axes[axis].mimics.is_some_and(|it| waiting.contains(&it.leader));
        let (later, now): (Vec<usize>, Vec<usize>) =
            waiting.iter().copied().partition(|&axis| leads(axis));
        if now.is_empty() {
            order.extend(later);
            return order;
        }
        order.extend(now);
        waiting = later;
    }
}

impl ChildBody {
    fn of(records: &Records, edge: Edge, body: usize) -> Self {
        let down = body == edge.two;
        let above = if down { edge.one } else { edge.two };
        let (above_from_axis, body_from_axis) = match edge.axis.map(|axis| &records.axes[axis]) {
            Some(axis) if down => (axis.body1_from_axis, axis.body2_from_axis),
            Some(axis) => (axis.body2_from_axis, axis.body1_from_axis),
            None => {
                let start = |body: usize| records.bodies[body].world_from_body;
                (start(above).inverse() * start(body), Pose::IDENTITY)
            }
        };
        Self {
            body,
            above,
            above_from_axis,
            axis_from_body: body_from_axis.inverse(),
            axis: edge.axis.map(|axis| (axis, if down { 1.0 } else { -1.0 })),
        }
    }

    /// Sets the body's pose from its parent and its axis, if one of them changed.
    pub(super) fn follow_parent(
        &self,
        axes: &[AxisRecord],
        motions: &mut [BodyMotion],
        changed: &mut [bool],
    ) {
        let axis = self.axis.map(|(axis, sign)| (&axes[axis], sign));
        let advanced = axis.is_some_and(|(axis, _)| axis.changed);
        // A body whose pose was set returns to its parent.
        if !(advanced || changed[self.above] || changed[self.body]) {
            return;
        }
        changed[self.body] = true;
        let above = motions[self.above];
        let world_from_axis = above.world_from_body * self.above_from_axis;
        let Some((axis, sign)) = axis else {
            let world_from_body = world_from_axis * self.axis_from_body;
            motions[self.body] = BodyMotion {
                world_from_body,
                linear_m_s: above.velocity_at(world_from_body.translation),
                angular_rad_s: above.angular_rad_s,
            };
            return;
        };
        let (way, speed) = (sign * axis.state.position, sign * axis.state.velocity);
        let direction = world_from_axis.rotation * DVec3::X;
        let axis_from_turned = if axis.slides {
            Pose::from_xyz(way, 0.0, 0.0)
        } else {
            let (sine, cosine) = libm::sincos(way / 2.0);
            let rotation = DQuat::from_xyzw(sine, 0.0, 0.0, cosine);
            Pose { translation: DVec3::ZERO, rotation }
        };
        let world_from_body = world_from_axis * axis_from_turned * self.axis_from_body;
        let at_m = world_from_body.translation;
        let mut linear_m_s = above.velocity_at(at_m);
        let mut angular_rad_s = above.angular_rad_s;
        if axis.slides {
            linear_m_s += direction * speed;
        } else {
            angular_rad_s += direction * speed;
            linear_m_s += (direction * speed).cross(at_m - world_from_axis.translation);
        }
        motions[self.body] = BodyMotion { world_from_body, linear_m_s, angular_rad_s };
    }
}
