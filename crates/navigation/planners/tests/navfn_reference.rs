//! Potentials of NavFn against an independent solution of the same equation, in double precision and in the
//! order of the potentials.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod common;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use periplus_costmap::Costmap;
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_planners::{NavFnMethod, PotentialField, Propagation};
use proptest::prelude::*;

/// Half of the cost of the costliest cell.
const HALF_CELL_COST: f64 = 127.0;

/// Cost of a cell; none for obstacles and the edge.
fn cell_cost(map: &Costmap, column: usize, row: usize) -> Option<f64> {
    let (width, height) = (map.info().width, map.info().height);
    let is_inner = column > 0 && row > 0 && column + 1 < width && row + 1 < height;
    let cost = map.cost((column, row)).filter(|_| is_inner)?;
    match cost {
        253 | 254 => None,
        255 => Some(253.0),
        cost => Some((50.0 + 0.8 * f64::from(cost)).trunc()),
    }
}

/// Fast marching with NavFn's update of a cell.
fn reference(map: &Costmap, robot: (usize, usize)) -> Vec<f64> {
    let (width, height) = (map.info().width, map.info().height);
    let mut potentials = vec![f64::INFINITY; width * height];
    potentials[robot.1 * width + robot.0] = 0.0;
    let mut open = BinaryHeap::from([(Reverse(0_u64), robot)]);
    while let Some((Reverse(bits), (column, row))) = open.pop() {
        if f64::from_bits(bits) > potentials[row * width + column] {
            continue;
        }
        let neighbours = [
            (column.wrapping_sub(1), row),
            (column + 1, row),
            (column, row.wrapping_sub(1)),
            (column, row + 1),
        ];
        for (x, y) in neighbours {
            let Some(cost) = cell_cost(map, x, y) else { continue };
            let at = |dx: isize, dy: isize| {
                potentials[y.wrapping_add_signed(dy) * width + x.wrapping_add_signed(dx)]
            };
            let (across, along) = (at(-1, 0).min(at(1, 0)), at(0, -1).min(at(0, 1)));
            let (low, difference) = (across.min(along), (across - along).abs());
            let ratio = difference / cost;
            let factor =
                if ratio >= 1.0 { 1.0 } else { -0.2301 * ratio * ratio + 0.5307 * ratio + 0.7040 };
            let potential = low + cost * factor;
            if potential < potentials[y * width + x] - 1e-9 {
                potentials[y * width + x] = potential;
                open.push((Reverse(potential.to_bits()), (x, y)));
            }
        }
    }
    potentials
}

fn field(map: &Costmap, how: &Propagation) -> PotentialField {
    let mut field = PotentialField::default();
    field.compute(map.costs(), map.info().width, how, &mut || false).unwrap();
    field
}

fn cost() -> impl Strategy<Value = u8> {
    prop_oneof![40 => Just(0_u8), 6 => Just(254), 2 => Just(253), 2 => Just(255), 20 => 1..253_u8]
}

/// Map of random blocks of 4 x 4 cells.
fn blocks(costs: &[u8]) -> Costmap {
    let info = GridInfo::new(0.1, 120, 88, Pose2::IDENTITY).unwrap();
    let mut map = Costmap::new(info, 0);
    for index in 0..info.len() {
        let (column, row) = info.cell(index);
        map.costs_mut()[index] = costs[row / 4 * 30 + column / 4];
    }
    map
}

/// Map of random obstacles and free cells.
fn obstacles(costs: &[u8]) -> Costmap {
    let mut map = blocks(costs);
    let lethal = |cost: &u8| if *cost == 254 { 254 } else { 0 };
    map.replace_costs(|costs| costs.iter().map(lethal).collect());
    map
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn potentials_are_those_of_the_equation(
        costs in proptest::collection::vec(cost(), 30 * 22), column in 1..119_usize, row in 1..87_usize,
    ) {
        let mut map = blocks(&costs);
        let info = *map.info();
        map.set((column, row), 0);
        let method = NavFnMethod::Dijkstra;
        let how = Propagation { method, allow_unknown: true, robot: (column, row), goal: None };
        let (field, reference) = (field(&map, &how), reference(&map, (column, row)));
        for (index, wanted) in reference.into_iter().enumerate() {
            let got = field.potential(info.cell(index)).map_or(f64::INFINITY, f64::from);
            prop_assert_eq!(got.is_finite(), wanted.is_finite());
            // NavFn leaves out updates that gain less than a sixth of the cost of a cell.
            let is_near = got == wanted
                || got >= 0.995 * wanted - 1.0 && got <= 1.02 * wanted + HALF_CELL_COST;
            prop_assert!(is_near, "cell {:?}: {got}, reference {wanted}", info.cell(index));
        }
    }

    #[test]
    fn the_goal_has_its_potential_when_the_propagation_ends(
        costs in proptest::collection::vec(cost(), 30 * 22), goal in (1..119_usize, 1..87_usize),
    ) {
        let mut map = obstacles(&costs);
        let info = *map.info();
        map.set((60, 44), 0);
        let exact = reference(&map, (60, 44))[info.index(goal)];
        for method in [NavFnMethod::Dijkstra, NavFnMethod::AStar] {
            let how =
                Propagation { method, allow_unknown: true, robot: (60, 44), goal: Some(goal) };
            let got = field(&map, &how).potential(goal).map_or(f64::INFINITY, f64::from);
            prop_assert_eq!(got.is_finite(), exact.is_finite());
            // Where free cells have one cost, the goal is first reached on the best path, within one cell.
            // Where they differ, NavFn may reach it over costly cells first, and ends then.
            if method == NavFnMethod::Dijkstra && goal != (60, 44) {
                let is_near = got == exact || got <= exact * 1.02 + 2.0 * HALF_CELL_COST;
                prop_assert!(is_near, "{got}, reference {exact}");
            }
        }
    }

    #[test]
    fn the_part_of_the_map_around_the_path_is_computed_as_the_whole(
        costs in proptest::collection::vec(cost(), 30 * 22),
        robot in (1..119_usize, 1..87_usize), goal in (1..119_usize, 1..87_usize),
    ) {
        let map = blocks(&costs);
        let width = map.info().width;
        let method = NavFnMethod::Dijkstra;
        let how = Propagation { method, allow_unknown: true, robot, goal: Some(goal) };
        let whole = field(&map, &how);
        let mut part = PotentialField::default();
        // Twice, since the second propagation restores the field after the first.
        for _ in 0..2 {
            part.compute_towards_goal(map.costs(), width, &how, &mut || false).unwrap();
            // The order of the updates matters a little, and it depends on cells that are left out.
            let is_near = |a: Option<f32>, b: Option<f32>| match (a, b) {
                (Some(a), Some(b)) => f64::from((a - b).abs()) <= HALF_CELL_COST,
                (a, b) => a == b,
            };
            prop_assert!(is_near(part.potential(goal), whole.potential(goal)));
            for index in 0..map.info().len() {
                let cell = map.info().cell(index);
                let Some(potential) = part.potential(cell) else { continue };
                let (dx, dy) = (cell.0.abs_diff(goal.0) as f32, cell.1.abs_diff(goal.1) as f32);
                let rest = 49.5 * libm::hypotf(dx, dy);
                if part.potential(goal).is_some_and(|goal| potential + rest < goal) {
                    prop_assert!(is_near(Some(potential), whole.potential(cell)), "{cell:?}");
                }
            }
        }
    }
}
