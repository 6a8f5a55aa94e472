//! In which order unknowns are eliminated.

use periplus_base::Pose2;

/// Groups no larger than this are taken as they come.
const SMALL: usize = 12;

/// An order of elimination with little fill: nested dissection by place. The poses are halved across
/// their longer extent; those of one half that touch the other separate the two and come last. Paths
/// through buildings are thin, so separators are small.
///
/// Source: George 1973, "Nested dissection of a regular finite element mesh".
pub(crate) fn order(poses: &[Pose2], neighbours: &[Vec<u32>]) -> Vec<u32> {
    let mut order = Vec::with_capacity(poses.len());
    // What each pose belongs to while it is being split: 0 none, else the side.
    let mut side = vec![0_u8; poses.len()];
    let mut stack: Vec<Task> = vec![Task::Split((0..poses.len() as u32).collect())];
    // Last in, first out: pieces are pushed in reverse.
    while let Some(task) = stack.pop() {
        let group = match task {
            Task::Append(group) => {
                order.extend(group);
                continue;
            }
            Task::Split(group) if group.len() <= SMALL => {
                order.extend(group);
                continue;
            }
            Task::Split(group) => group,
        };
        let (low, high) = halve(poses, group);
        mark(&mut side, &low, 1);
        mark(&mut side, &high, 2);
        let touches = |node: u32, other: u8| {
            neighbours[node as usize].iter().any(|&next| side[next as usize] == other)
        };
        let from_low: Vec<u32> = low.iter().copied().filter(|&node| touches(node, 2)).collect();
        let from_high: Vec<u32> = high.iter().copied().filter(|&node| touches(node, 1)).collect();
        let separator = if from_low.len() <= from_high.len() { from_low } else { from_high };
        mark(&mut side, &separator, 3);
        let rest = |half: Vec<u32>| -> Vec<u32> {
            half.into_iter().filter(|&node| side[node as usize] != 3).collect()
        };
        let (low, high) = (rest(low), rest(high));
        for part in [&low, &high, &separator] {
            mark(&mut side, part, 0);
        }
        stack.push(Task::Append(separator));
        stack.push(Task::Split(high));
        stack.push(Task::Split(low));
    }
    order
}

enum Task {
    Split(Vec<u32>),
    Append(Vec<u32>),
}

fn mark(side: &mut [u8], group: &[u32], value: u8) {
    for &node in group {
        side[node as usize] = value;
    }
}

fn halve(poses: &[Pose2], mut group: Vec<u32>) -> (Vec<u32>, Vec<u32>) {
    let extent = |value: fn(&Pose2) -> f64| {
        let values = group.iter().map(|&node| value(&poses[node as usize]));
        let (low, high) =
            values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let axis: fn(&Pose2) -> f64 =
        if extent(|p| p.x_m) >= extent(|p| p.y_m) { |p| p.x_m } else { |p| p.y_m };
    let middle = group.len() / 2;
    group.select_nth_unstable_by(middle, |&a, &b| {
        axis(&poses[a as usize]).total_cmp(&axis(&poses[b as usize])).then(a.cmp(&b))
    });
    let mut high = group.split_off(middle);
    // The order within a half must not hang on how the selection went.
    group.sort_unstable();
    high.sort_unstable();
    (group, high)
}
