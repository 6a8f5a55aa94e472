//! What the numbers in the cells mean, and how they become the numbers of maps.
//!
//! Source: `nav2_costmap_2d/cost_values.hpp`, `costmap_2d_publisher.cpp`, `costmap_2d.cpp`.

/// Nobody knows what is there.
pub const UNKNOWN: u8 = 255;
/// An obstacle.
pub const LETHAL: u8 = 254;
/// A robot whose centre is here touches an obstacle, whichever way it is turned.
pub const INSCRIBED: u8 = 253;
/// The highest cost that is no certain collision.
pub const MOST_PASSABLE: u8 = 252;
/// Nothing is there.
pub const FREE: u8 = 0;

/// What `nav_msgs/OccupancyGrid` says of a cost: 0 free, 1 to 98 graded, 99 inscribed, 100 lethal, -1
/// unknown.
#[must_use]
pub fn occupancy_of(cost: u8) -> i8 {
    OCCUPANCY[usize::from(cost)]
}

const OCCUPANCY: [i8; 256] = {
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

/// The cost that a cell of a filter mask, or of a costmap published as a map, stands for. Numbers
/// above 100 are lethal, those below -1 unknown.
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
