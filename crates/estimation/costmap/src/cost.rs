//! Cost values and their conversion to occupancy values.
//!
//! Source: `nav2_costmap_2d/cost_values.hpp`, `costmap_2d_publisher.cpp`, `costmap_2d.cpp`.

/// `NO_INFORMATION`: unknown cell.
pub const UNKNOWN: u8 = 255;
/// `LETHAL_OBSTACLE`: cell with an obstacle.
pub const LETHAL: u8 = 254;
/// `INSCRIBED_INFLATED_OBSTACLE`: a robot centred here collides in any orientation.
pub const INSCRIBED: u8 = 253;
/// `MAX_NON_OBSTACLE`: highest cost without a certain collision.
pub const MAX_NON_OBSTACLE: u8 = 252;
/// `FREE_SPACE`: free cell.
pub const FREE: u8 = 0;

/// Converts a cost to a value of `nav_msgs/OccupancyGrid`: 0 free, 1 to 98 graded, 99 inscribed,
/// 100 lethal, -1 unknown.
#[must_use]
pub fn occupancy_of(cost: u8) -> i8 {
    OCCUPANCY_PERCENT[usize::from(cost)]
}

const OCCUPANCY_PERCENT: [i8; 256] = {
    let mut table = [0; 256];
    let mut cost = 1;
    while cost < 253 {
        table[cost] = (1 + 97 * (cost - 1) / 251) as i8;
        cost += 1;
    }
    table[INSCRIBED as usize] = 99;
    table[LETHAL as usize] = 100;
    table[UNKNOWN as usize] = -1;
    table
};

/// Converts a value of a filter mask, or of a costmap published as a map, to a cost. Values above
/// 100 are lethal, those below -1 unknown.
#[must_use]
pub fn cost_of(occupancy: i8) -> u8 {
    match occupancy {
        0..=100 => ((i32::from(occupancy) * 254 + 50) / 100) as u8,
        101.. => LETHAL,
        _ => UNKNOWN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_become_occupancies_as_nav2_publishes_them() {
        let pairs = [(0, 0), (1, 1), (2, 1), (4, 2), (252, 98), (253, 99), (254, 100), (255, -1)];
        for (cost, occupancy) in pairs {
            assert_eq!(occupancy_of(cost), occupancy, "{cost}");
        }
    }

    #[test]
    fn a_mask_is_read_as_costs() {
        let pairs = [(-1, 255), (0, 0), (1, 3), (25, 64), (50, 127), (99, 251), (100, 254)];
        for (occupancy, cost) in pairs {
            assert_eq!(cost_of(occupancy), cost, "{occupancy}");
        }
        assert_eq!((cost_of(127), cost_of(-128)), (LETHAL, UNKNOWN));
    }
}
