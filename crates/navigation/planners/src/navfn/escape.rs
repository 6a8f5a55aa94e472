//! Start of a robot that is nearer to an obstacle than its inscribed radius.
//!
//! All cells around it are obstacles then, and NavFn finds no path from them, also after recoveries: the robot stays
//! until a user moves it. It may be there because a sensor saw the obstacle late, or since the global costmap keeps
//! more distance than the controller.

use std::collections::VecDeque;

use periplus_costmap::cost::{INSCRIBED, MAX_NON_OBSTACLE};
use periplus_grid::Cell;

/// Returns the costs with an escape for a robot whose cell and its four neighbours are inscribed or occupied: the inscribed
/// cells around it are passable, at the highest cost, up to the distance of the nearest free cell. None if the robot needs
/// no escape, or there is none.
pub(super) fn with_escape(costs: &[u8], width: usize, robot: Cell) -> Option<Vec<u8>> {
    let height = costs.len().checked_div(width)?;
    let is_inside = |(column, row): Cell| {
        // The outermost cells count as obstacles.
        (1..width.saturating_sub(1)).contains(&column)
            && (1..height.saturating_sub(1)).contains(&row)
    };
    let index = |(column, row): Cell| row * width + column;
    if !is_inside(robot) || costs[index(robot)] != INSCRIBED {
        return None;
    }
    let mut opened = vec![robot];
    let mut queue = VecDeque::from([(robot, 0_usize)]);
    let mut is_seen = vec![false; costs.len()];
    is_seen[index(robot)] = true;
    // Distance of the nearest free cell, in steps along the axes.
    let mut nearest: Option<usize> = None;
    while let Some((cell, distance)) = queue.pop_front() {
        if nearest.is_some_and(|nearest| distance >= nearest) {
            break;
        }
        for (across, along) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            let next = cell.0.checked_add_signed(across).zip(cell.1.checked_add_signed(along));
            let Some(next) = next.filter(|next| is_inside(*next) && !is_seen[index(*next)]) else {
                continue;
            };
            is_seen[index(next)] = true;
            match costs[index(next)] {
                cost if cost < INSCRIBED => nearest = nearest.or(Some(distance + 1)),
                INSCRIBED => {
                    opened.push(next);
                    queue.push_back((next, distance + 1));
                }
                _ => {}
            }
        }
    }
    // A free neighbour needs no change.
    if nearest? <= 1 {
        return None;
    }
    let mut costs = costs.to_vec();
    for cell in opened {
        costs[index(cell)] = MAX_NON_OBSTACLE;
    }
    Some(costs)
}

#[cfg(test)]
mod tests {
    use periplus_costmap::cost::LETHAL;

    use super::*;

    /// Costs of rows of cells: `.` free, `i` inscribed, `#` an obstacle, `+` opened.
    fn costs(rows: &[&str]) -> (Vec<u8>, usize) {
        let cost = |sign: u8| match sign {
            b'i' => INSCRIBED,
            b'#' => LETHAL,
            b'+' => MAX_NON_OBSTACLE,
            _ => 0,
        };
        (rows.iter().flat_map(|row| row.bytes().map(cost)).collect(), rows[0].len())
    }

    fn check(rows: &[&str], robot: Cell, expected: Option<&[&str]>) {
        let (given, width) = costs(rows);
        let found = with_escape(&given, width, robot);
        assert_eq!(found, expected.map(|rows| costs(rows).0), "{robot:?}");
    }

    #[test]
    fn inscribed_cells_around_the_robot_open_up_to_a_free_one() {
        let wall = [
            "...........",
            ".........i#",
            "......iiii#",
            "......iiii#",
            ".....iiiii#",
            "...........",
        ];
        let opened = [
            "...........",
            ".........i#",
            "......+++i#",
            "......++++#",
            ".....i+++i#",
            "...........",
        ];
        check(&wall, (7, 3), Some(&opened));
        // A neighbour is free.
        check(&wall, (6, 2), None);
        check(&wall, (2, 2), None);
        // The robot's centre is in an obstacle.
        check(&wall, (10, 3), None);
    }

    #[test]
    fn a_robot_without_a_free_cell_stays() {
        check(&["#####", "#iii#", "#iii#", "#iii#", "#####"], (2, 2), None);
        check(&["ii"], (0, 0), None);
        check(&[""], (0, 0), None);
    }
}
