//! What is driven now, and what a key makes of it.

use periplus_msgs::geometry_msgs::{Twist, Vector3};

use crate::teleop::bindings::{Direction, direction, factors};

/// Speeds, and the way that is driven.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyboard {
    /// Speed of straight motion \[m/s\].
    pub speed_m_s: f64,
    /// Speed of turns \[rad/s\].
    pub turn_rad_s: f64,
    /// The speed goes no higher \[m/s\].
    pub speed_limit_m_s: f64,
    /// The turn goes no higher \[rad/s\].
    pub turn_limit_rad_s: f64,
    /// The way that is driven.
    pub direction: Direction,
}

/// As `teleop_twist_keyboard` begins.
impl Default for Keyboard {
    fn default() -> Self {
        Self {
            speed_m_s: 0.5,
            turn_rad_s: 1.0,
            speed_limit_m_s: 1000.0,
            turn_limit_rad_s: 1000.0,
            direction: Direction::default(),
        }
    }
}

/// What a key did. After each but [`Pressed::Quit`] the velocity is published.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// It drives some way.
    Drive,
    /// It changed the speeds, and what is driven goes on with them.
    Speed {
        /// Whether a speed is as high as it may be.
        at_limit: bool,
    },
    /// It stops, as every other key.
    Stop,
    /// It ends.
    Quit,
}

/// What is driven.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Along x, y, z \[m/s\].
    pub linear_m_s: [f64; 3],
    /// About z \[rad/s\].
    pub angular_z_rad_s: f64,
}

/// What Ctrl-C is to a terminal that passes it on.
const END_OF_TEXT: char = '\u{3}';

impl Keyboard {
    /// Somebody pressed a key.
    pub fn press(&mut self, key: char) -> Pressed {
        if key == END_OF_TEXT {
            self.stop();
            return Pressed::Quit;
        }
        if let Some(direction) = direction(key) {
            self.direction = direction;
            return Pressed::Drive;
        }
        if let Some(factors) = factors(key) {
            let (speed, turn) = (self.speed_m_s * factors.speed, self.turn_rad_s * factors.turn);
            self.speed_m_s = speed.min(self.speed_limit_m_s);
            self.turn_rad_s = turn.min(self.turn_limit_rad_s);
            let at_limit =
                self.speed_m_s == self.speed_limit_m_s || self.turn_rad_s == self.turn_limit_rad_s;
            return Pressed::Speed { at_limit };
        }
        self.stop();
        Pressed::Stop
    }

    /// Stands still: nobody has pressed a key for long, or it ends. Whether it moved before.
    pub fn stop(&mut self) -> bool {
        std::mem::take(&mut self.direction) != Direction::default()
    }

    /// What is driven.
    #[must_use]
    pub fn velocity(&self) -> Velocity {
        // 0 times -1 is another zero, which readers of messages need not see.
        let times = |part: f64, speed: f64| if part == 0.0 { 0.0 } else { part * speed };
        Velocity {
            linear_m_s: self.direction.linear.map(|part| times(part, self.speed_m_s)),
            angular_z_rad_s: times(self.direction.angular_z, self.turn_rad_s),
        }
    }
}

impl From<Velocity> for Twist {
    fn from(velocity: Velocity) -> Self {
        let [x, y, z] = velocity.linear_m_s;
        Self {
            linear: Vector3 { x, y, z },
            angular: Vector3 { x: 0.0, y: 0.0, z: velocity.angular_z_rad_s },
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn every_other_key_stops() {
        for key in ['k', ' ', 'K', 'Q', '5', '\u{1b}', 'é'] {
            let mut keyboard = Keyboard::default();
            keyboard.press('u');
            assert_eq!(
                (keyboard.press(key), keyboard.velocity()),
                (Pressed::Stop, Velocity::default())
            );
        }
    }

    #[test]
    fn speeds_end_at_their_limits() {
        let mut keyboard = Keyboard { speed_limit_m_s: 0.6, ..Keyboard::default() };
        assert_eq!(keyboard.press('w'), Pressed::Speed { at_limit: false });
        assert_eq!(keyboard.press('w'), Pressed::Speed { at_limit: true });
        assert_eq!((keyboard.speed_m_s, keyboard.turn_rad_s), (0.6, 1.0));
        keyboard.press('i');
        assert!(keyboard.stop());
        assert!(!keyboard.stop(), "it stands already");
        keyboard.press('i');
        assert_eq!(keyboard.press('\u{3}'), Pressed::Quit);
        assert_eq!(keyboard.velocity(), Velocity::default());
    }

    proptest! {
        #[test]
        fn nothing_is_faster_than_the_speeds(keys in prop::collection::vec(any::<char>(), 0..40)) {
            let mut keyboard = Keyboard::default();
            for key in keys {
                keyboard.press(key);
                let velocity = keyboard.velocity();
                let linear = velocity.linear_m_s.iter().all(|part| part.abs() <= keyboard.speed_m_s);
                prop_assert!(linear && velocity.angular_z_rad_s.abs() <= keyboard.turn_rad_s);
                prop_assert!(keyboard.speed_m_s > 0.0 && keyboard.turn_rad_s > 0.0);
            }
        }
    }
}
