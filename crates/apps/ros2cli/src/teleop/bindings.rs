//! Key bindings. Source: the tables of `teleop_twist_keyboard`, the same in ROS 1 and ROS 2.

/// Direction of motion: fractions of the linear speed along x, y, z, and of the angular speed about
/// z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Direction {
    /// Along x, y, z.
    pub linear: [f64; 3],
    /// About z.
    pub angular_z: f64,
}

/// Factors by which a key changes the speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Factor of the linear speed.
    pub speed: f64,
    /// Factor of the angular speed.
    pub turn: f64,
}

/// Direction of a key; `None` for keys without one.
#[must_use]
pub fn direction(key: char) -> Option<Direction> {
    let (x, y, z, angular_z) = match key {
        // Curves and rotations.
        'i' => (1, 0, 0, 0),
        'o' => (1, 0, 0, -1),
        'j' => (0, 0, 0, 1),
        'l' => (0, 0, 0, -1),
        'u' => (1, 0, 0, 1),
        ',' => (-1, 0, 0, 0),
        '.' => (-1, 0, 0, 1),
        'm' => (-1, 0, 0, -1),
        // With shift: sideways.
        'I' => (1, 0, 0, 0),
        'O' => (1, -1, 0, 0),
        'J' => (0, 1, 0, 0),
        'L' => (0, -1, 0, 0),
        'U' => (1, 1, 0, 0),
        '<' => (-1, 0, 0, 0),
        '>' => (-1, -1, 0, 0),
        'M' => (-1, 1, 0, 0),
        // Up and down.
        't' => (0, 0, 1, 0),
        'b' => (0, 0, -1, 0),
        _ => return None,
    };
    Some(Direction {
        linear: [f64::from(x), f64::from(y), f64::from(z)],
        angular_z: f64::from(angular_z),
    })
}

/// Factors of a key; `None` for keys without them.
#[must_use]
pub fn factors(key: char) -> Option<Factors> {
    let (speed, turn) = match key {
        'q' => (1.1, 1.1),
        'z' => (0.9, 0.9),
        'w' => (1.1, 1.0),
        'x' => (0.9, 1.0),
        'e' => (1.0, 1.1),
        'c' => (1.0, 0.9),
        _ => return None,
    };
    Some(Factors { speed, turn })
}
