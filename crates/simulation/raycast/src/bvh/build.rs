//! Tree construction by the surface area heuristic.
//!
//! A range of primitives is split where `area x count` of both sides, over 16 bins along each axis,
//! is minimal (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"). A node
//! splits its largest range until it has eight. The tree does not depend on the number of threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::{LEAF_MASK, MAX_DEPTH, MAX_LEAF_TRIANGLES, MAX_PRIMITIVE_COUNT, Node, leaf};
use crate::simd::{Row, Task, V8, dispatch};

const BINS: usize = 16;
/// From this depth on ranges are halved, three times per node: 2²⁸ boxes are exhausted after ten
/// more levels.
const HALVE_DEPTH: usize = MAX_DEPTH - 12;
/// Minimum number of primitives for which a thread pays off.
const MIN_BOXES_PER_THREAD_COUNT: usize = 20_000;

/// A box and a number: lower corner, number as bits, negated upper corner, unused. Negated so that
/// one minimum of eight lanes unites two boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds(pub(crate) Row);

impl Bounds {
    pub(crate) const EMPTY: Self = Self(Row([f32::INFINITY; 8]));

    pub(crate) fn new(low: [f32; 3], high: [f32; 3], number: u32) -> Self {
        let n = f32::from_bits(number);
        Self(Row([low[0], low[1], low[2], n, -high[0], -high[1], -high[2], 0.0]))
    }

    #[inline(always)]
    pub(crate) fn low(&self, axis: usize) -> f32 {
        self.0.0[axis]
    }

    #[inline(always)]
    pub(crate) fn high(&self, axis: usize) -> f32 {
        -self.0.0[axis + 4]
    }

    #[inline(always)]
    pub(crate) fn number(&self) -> u32 {
        self.0.0[3].to_bits()
    }

    #[inline(always)]
    pub(crate) fn half_area(&self) -> f32 {
        let (x, y) = (self.high(0) - self.low(0), self.high(1) - self.low(1));
        let z = self.high(2) - self.low(2);
        x * y + y * z + z * x
    }

    /// Grows to contain another box.
    pub(crate) fn include(&mut self, other: &Self) {
        for (own, &other) in self.0.0.iter_mut().zip(&other.0.0) {
            *own = if other < *own { other } else { *own };
        }
    }

    #[inline(always)]
    fn union<V: V8>(&self, other: &Self) -> Self {
        Self(V::load(&self.0).min(V::load(&other.0)).store())
    }
}

/// Primitives of one child.
#[derive(Clone, Copy)]
struct Range {
    start: usize,
    end: usize,
    bounds: Bounds,
    /// Bounds of twice the centres.
    centres: Bounds,
}

impl Range {
    fn len(&self) -> usize {
        self.end - self.start
    }

    /// Returns the number of bins; fewer for small ranges.
    fn bins(&self) -> usize {
        if self.len() > 64 { BINS } else { BINS / 2 }
    }
}

/// Builds a tree over boxes, root first, and sorts `boxes` in the order of the leaves. Empty without
/// boxes. Leaves hold up to `leaf_size` (at most 8) boxes.
pub(crate) fn build(boxes: &mut [Bounds], leaf_size: usize, threads: usize) -> Vec<Node> {
    assert!(boxes.len() <= MAX_PRIMITIVE_COUNT && (1..=MAX_LEAF_TRIANGLES).contains(&leaf_size));
    dispatch(Build { boxes, leaf_size, threads })
}

struct Build<'a> {
    boxes: &'a mut [Bounds],
    leaf_size: usize,
    threads: usize,
}

impl Task for Build<'_> {
    type Output = Vec<Node>;

    #[inline(always)]
    fn run<V: V8>(self) -> Vec<Node> {
        let mut nodes = Vec::new();
        if self.boxes.is_empty() {
            return nodes;
        }
        let range = measure::<V>(self.boxes, 0);
        if self.threads < 2 || self.boxes.len() < MIN_BOXES_PER_THREAD_COUNT {
            nodes.reserve(self.boxes.len() / 4);
            grow::<V>(&mut nodes, self.boxes, range, self.leaf_size, 0);
            return nodes;
        }
        // The root's children are the tasks; their order of completion does not matter.
        let split = children_of::<V>(self.boxes, range, self.leaf_size, 0);
        let (children, count) = (split.as_slice(), split.count);
        let mut tasks = Vec::with_capacity(count);
        let mut rest = self.boxes;
        for child in children {
            let (boxes, after) = rest.split_at_mut(child.len());
            rest = after;
            tasks.push(Mutex::new((boxes, Vec::new())));
        }
        let next = AtomicUsize::new(0);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&slot| std::cmp::Reverse(children[slot].len()));
        std::thread::scope(|scope| {
            for _ in 0..self.threads.min(count) {
                scope.spawn(|| {
                    while let Some(&slot) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
                        if let Ok(mut task) = tasks[slot].lock() {
                            let (boxes, nodes) = &mut *task;
                            dispatch(GrowSubtree {
                                boxes,
                                nodes,
                                whole: children[slot],
                                leaf_size: self.leaf_size,
                            });
                        }
                    }
                });
            }
        });
        nodes.push(Node::EMPTY);
        nodes[0].set_orders(&split.orders);
        for (slot, task) in tasks.into_iter().enumerate() {
            let child = &children[slot];
            let word = if child.len() <= self.leaf_size {
                leaf(child.start, child.len())
            } else {
                let offset = index(nodes.len());
                let grown = task.into_inner().map_or_else(|_| Vec::new(), |(_, nodes)| nodes);
                nodes.extend(grown.into_iter().map(|mut node| {
                    for slot in 0..8 {
                        if node.is_used(slot) && node.child(slot) & LEAF_MASK == 0 {
                            node.set_child(slot, node.child(slot) + offset);
                        } else if node.is_used(slot) {
                            node.set_child(slot, node.child(slot) + index(child.start));
                        }
                    }
                    node
                }));
                offset
            };
            nodes[0].set(slot, &child.bounds, word);
        }
        nodes
    }
}

/// Subtree below one child of the root.
struct GrowSubtree<'a, 'b> {
    boxes: &'a mut &'b mut [Bounds],
    nodes: &'a mut Vec<Node>,
    whole: Range,
    leaf_size: usize,
}

impl Task for GrowSubtree<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let range = Range { start: 0, end: self.boxes.len(), ..self.whole };
        if range.len() > self.leaf_size {
            self.nodes.reserve(range.len() / 4);
            grow::<V>(self.nodes, self.boxes, range, self.leaf_size, 1);
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "`build` asserts the limits")]
fn index(value: usize) -> u32 {
    value as u32
}

/// Adds the node of a range and all nodes below it.
#[inline(never)]
fn grow_apart<V: V8>(
    n: &mut Vec<Node>,
    boxes: &mut [Bounds],
    range: Range,
    size: usize,
    depth: usize,
) {
    struct SeparateFrame<'a>(&'a mut Vec<Node>, &'a mut [Bounds], Range, usize, usize);
    impl Task for SeparateFrame<'_> {
        type Output = ();
        #[inline(always)]
        fn run<V: V8>(self) {
            grow::<V>(self.0, self.1, self.2, self.3, self.4);
        }
    }
    V::run(SeparateFrame(n, boxes, range, size, depth));
}

#[inline(always)]
fn grow<V: V8>(
    nodes: &mut Vec<Node>,
    boxes: &mut [Bounds],
    range: Range,
    leaf_size: usize,
    depth: usize,
) {
    let own = nodes.len();
    nodes.push(Node::EMPTY);
    let children = children_of::<V>(boxes, range, leaf_size, depth);
    nodes[own].set_orders(&children.orders);
    for (slot, child) in children.as_slice().iter().enumerate() {
        let word = if child.len() <= leaf_size {
            leaf(child.start, child.len())
        } else {
            let word = index(nodes.len());
            grow_apart::<V>(nodes, boxes, *child, leaf_size, depth + 1);
            word
        };
        nodes[own].set(slot, &child.bounds, word);
    }
}

/// Ranges of the children of a node.
struct Children {
    ranges: [Range; 8],
    count: usize,
    /// For each octant of ray directions the children, the farthest first, by the splits. The
    /// positions from `count` on hold the unused slots.
    orders: [[u8; 8]; 8],
}

impl Children {
    fn as_slice(&self) -> &[Range] {
        &self.ranges[..self.count]
    }
}

/// Replaces a child by its two halves along an axis: `slot` and the next.
fn split_orders(orders: &mut [[u8; 8]; 8], count: usize, slot: usize, axis: usize) {
    for (octant, order) in orders.iter_mut().enumerate() {
        let mut split = [0_u8; 8];
        let mut end = 0;
        for &child in &order[..count] {
            let child = usize::from(child);
            let moved = child + usize::from(child > slot);
            let (first, second) = if octant >> axis & 1 == 0 { (1, 0) } else { (0, 1) };
            if child == slot {
                (split[end], split[end + 1]) = (index_u8(slot + first), index_u8(slot + second));
                end += 2;
            } else {
                split[end] = index_u8(moved);
                end += 1;
            }
        }
        for (position, unused) in split.iter_mut().enumerate().skip(end) {
            *unused = index_u8(position);
        }
        *order = split;
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a slot of eight")]
fn index_u8(slot: usize) -> u8 {
    slot as u8
}

/// Splits a range into at most eight, in the order of the boxes.
#[inline(always)]
fn children_of<V: V8>(
    boxes: &mut [Bounds],
    range: Range,
    leaf_size: usize,
    depth: usize,
) -> Children {
    let mut children = [range; 8];
    let mut count = 1;
    let mut orders = [[0, 1, 2, 3, 4, 5, 6, 7]; 8];
    let mut settled = [false; 8];
    while count < 8 {
        let mut widest = None;
        let mut most = f32::NEG_INFINITY;
        for slot in 0..count {
            let child = &children[slot];
            if settled[slot] || child.len() < 2 {
                continue;
            }
            // Ranges that must be split come first.
            let large = child.len() > leaf_size;
            let weight = if depth >= HALVE_DEPTH {
                child.len() as f32
            } else {
                child.bounds.half_area() * if large { 1.0 } else { 1e-6 }
            };
            if weight > most {
                most = weight;
                widest = Some(slot);
            }
        }
        let Some(slot) = widest else { break };
        let child = children[slot];
        let large = child.len() > leaf_size;
        let Some((left, right, axis)) = split::<V>(boxes, &child, large, depth >= HALVE_DEPTH)
        else {
            settled[slot] = true;
            continue;
        };
        split_orders(&mut orders, count, slot, axis);
        children.copy_within(slot + 1..count, slot + 2);
        settled.copy_within(slot + 1..count, slot + 2);
        children[slot] = left;
        children[slot + 1] = right;
        (settled[slot], settled[slot + 1]) = (false, false);
        count += 1;
    }
    Children { ranges: children, count, orders }
}

/// Returns the bounds of all boxes and of their centres.
#[inline(always)]
fn measure<V: V8>(boxes: &[Bounds], start: usize) -> Range {
    let mut bounds = V::splat(f32::INFINITY);
    let mut centres = bounds;
    for each in boxes {
        let row = V::load(&each.0);
        bounds = bounds.min(row);
        centres = centres.min(centre(row));
    }
    let (bounds, centres) = (Bounds(bounds.store()), Bounds(centres.store()));
    Range { start, end: start + boxes.len(), bounds, centres }
}

/// Returns twice the centre, and its negative in the other half.
#[inline(always)]
fn centre<V: V8>(row: V) -> V {
    row.sub(row.swap_halves())
}

/// Split of a range: boxes whose centre is in a bin below `bin` go left.
struct Split {
    cost: f32,
    axis: usize,
    bin: usize,
    left: Bounds,
    right: Bounds,
}

/// Splits a range in two along the axis returned, or returns `None` if a leaf is cheaper, unless
/// `forced`.
#[inline(always)]
fn split<V: V8>(
    boxes: &mut [Bounds],
    range: &Range,
    forced: bool,
    halve: bool,
) -> Option<(Range, Range, usize)> {
    let own = &mut boxes[range.start..range.end];
    let best = if halve { None } else { best_cut::<V>(own, range) };
    if !forced {
        // A leaf costs the same with eight triangles as with one: only a smaller area pays off.
        let worth = |cut: &Split| {
            cut.left.half_area() + cut.right.half_area() < 0.7 * range.bounds.half_area()
        };
        if !best.as_ref().is_some_and(worth) {
            return None;
        }
    }
    let Some(cut) = best else {
        // All centres are equal, or the depth limit requires halving.
        let middle = own.len() / 2;
        let (left, right) = own.split_at(middle);
        let (left, right) =
            (measure::<V>(left, range.start), measure::<V>(right, range.start + middle));
        return Some((left, right, 0));
    };
    let (offset, scale) = grid(range);
    let (offset, scale) = (V::load(&offset), V::load(&scale));
    let none = V::splat(f32::INFINITY);
    let mut sides = [none, none];
    let (mut left, mut right) = (0, own.len());
    let axis = cut.axis;
    while left < right {
        let middle = centre(V::load(&own[left].0));
        let bin = bins(middle, offset, scale)[axis];
        if bin < cut.bin {
            sides[0] = sides[0].min(middle);
            left += 1;
        } else {
            sides[1] = sides[1].min(middle);
            right -= 1;
            own.swap(left, right);
        }
    }
    let middle = range.start + left;
    let [first, second] = [Bounds(sides[0].store()), Bounds(sides[1].store())];
    Some((
        Range { start: range.start, end: middle, bounds: cut.left, centres: first },
        Range { start: middle, end: range.end, bounds: cut.right, centres: second },
        axis,
    ))
}

/// Returns the value to subtract from twice a centre, and the bins per length.
#[inline(always)]
fn grid(range: &Range) -> (Row, Row) {
    let mut offset = Row([0.0; 8]);
    let mut scale = Row([0.0; 8]);
    for axis in 0..3 {
        let extent = range.centres.high(axis) - range.centres.low(axis);
        if extent > 1e-30 {
            offset.0[axis] = range.centres.low(axis);
            scale.0[axis] = (range.bins() as f32 * 0.99999) / extent;
        }
    }
    (offset, scale)
}

/// Returns the bins of a centre along the three axes.
#[inline(always)]
#[expect(clippy::cast_sign_loss, reason = "no centre is below the minimum")]
fn bins<V: V8>(centre: V, offset: V, scale: V) -> [usize; 3] {
    let index = centre.sub(offset).mul(scale).truncate();
    let [x, y, z, ..] = index;
    [x as usize & (BINS - 1), y as usize & (BINS - 1), z as usize & (BINS - 1)]
}

#[inline(always)]
fn best_cut<V: V8>(own: &[Bounds], range: &Range) -> Option<Split> {
    let (offset, scale) = grid(range);
    let (offset_v, scale_v) = (V::load(&offset), V::load(&scale));
    let mut counts = [[0_u32; BINS]; 3];
    let mut boxes = [[Bounds::EMPTY; BINS]; 3];
    for each in own {
        let row = V::load(&each.0);
        let index = bins(centre(row), offset_v, scale_v);
        for axis in 0..3 {
            let bin = index[axis];
            counts[axis][bin] += 1;
            let own = &mut boxes[axis][bin].0;
            *own = V::load(own).min(row).store();
        }
    }
    let mut best: Option<Split> = None;
    for axis in 0..3 {
        if scale.0[axis] == 0.0 {
            continue;
        }
        let mut right = [(0.0_f32, Bounds::EMPTY); BINS];
        let (mut count, mut bounds) = (0, Bounds::EMPTY);
        for bin in (1..range.bins()).rev() {
            count += counts[axis][bin];
            bounds = bounds.union::<V>(&boxes[axis][bin]);
            right[bin] = (if count == 0 { 0.0 } else { bounds.half_area() * cost(count) }, bounds);
        }
        let (mut count, mut bounds) = (0, Bounds::EMPTY);
        for bin in 1..range.bins() {
            count += counts[axis][bin - 1];
            bounds = bounds.union::<V>(&boxes[axis][bin - 1]);
            if count == 0 || count as usize == own.len() {
                continue;
            }
            let total = bounds.half_area() * cost(count) + right[bin].0;
            if best.as_ref().is_none_or(|best| total < best.cost) {
                best = Some(Split { cost: total, axis, bin, left: bounds, right: right[bin].1 });
            }
        }
    }
    best
}

/// Returns the cost of the primitives in a box for a ray through it.
#[inline(always)]
fn cost(count: u32) -> f32 {
    count as f32
}
