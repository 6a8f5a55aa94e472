//! Current velocity, and its change by keys.

use periplus_msgs::geometry_msgs::{Twist, Vector3};

use crate::teleop::TeleopParams;
use crate::teleop::bindings::{Direction, direction, factors};

/// Speeds and current direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyboard {
    /// Linear speed \[m/s\].
    pub speed_m_s: f64,
    /// Angular speed \[rad/s\].
    pub turn_rad_s: f64,
    /// Maximum linear speed \[m/s\].
    pub speed_limit_m_s: f64,
    /// Maximum angular speed \[rad/s\].
    pub turn_limit_rad_s: f64,
    /// Current direction.
    pub direction: Direction,
}

/// Initial state of `teleop_twist_keyboard`.
impl Default for Keyboard {
    fn default() -> Self {
        TeleopParams::default().keyboard()
    }
}

/// Effect of a key. After each but [`Pressed::Quit`] the velocity is published.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// Changed the direction.
    Drive,
    /// Changed the speeds; the direction stays.
    Speed {
        /// True if a speed is at its maximum.
        at_limit: bool,
    },
    /// Stopped, as any unbound key does.
    Stop,
    /// Quit.
    Quit,
}

/// Current velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KeyboardVelocity {
    /// Along x, y, z \[m/s\].
    pub linear_m_s: [f64; 3],
    /// About z \[rad/s\].
    pub angular_z_rad_s: f64,
}

/// Ctrl-C in a raw terminal.
const END_OF_TEXT: char = '\u{3}';

impl Keyboard {
    /// Handles a key.
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

    /// Stops, on a key timeout or at the end; returns true if it was moving.
    pub fn stop(&mut self) -> bool {
        std::mem::take(&mut self.direction) != Direction::default()
    }

    /// Returns the current velocity.
    #[must_use]
    pub fn velocity(&self) -> KeyboardVelocity {
        // Avoids negative zero in messages.
        let times = |part: f64, speed: f64| if part == 0.0 { 0.0 } else { part * speed };
        KeyboardVelocity {
            linear_m_s: self.direction.linear.map(|part| times(part, self.speed_m_s)),
            angular_z_rad_s: times(self.direction.angular_z, self.turn_rad_s),
        }
    }
}

impl From<KeyboardVelocity> for Twist {
    fn from(velocity: KeyboardVelocity) -> Self {
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
                (Pressed::Stop, KeyboardVelocity::default())
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
        assert_eq!(keyboard.velocity(), KeyboardVelocity::default());
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
