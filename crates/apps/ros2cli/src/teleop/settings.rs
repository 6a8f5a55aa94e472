//! Parameters of teleoperation.

use periplus_params::params;

use crate::teleop::Keyboard;
use crate::teleop::bindings::Direction;

params! {
    /// Keyboard teleoperation.
    #[table(TELEOP, "teleop_twist_keyboard")]
    pub struct TeleopParams {
        /// Initial linear speed.
        #[param("speed", unit("m/s"), above(0.0))]
        speed_m_s: f64 = 0.5,
        /// Initial angular speed.
        #[param("turn", unit("rad/s"), above(0.0))]
        turn_rad_s: f64 = 1,
        /// Maximum linear speed.
        #[param("speed_limit", unit("m/s"), above(0.0))]
        speed_limit_m_s: f64 = 1000,
        /// Maximum angular speed.
        #[param("turn_limit", unit("rad/s"), above(0.0))]
        turn_limit_rad_s: f64 = 1000,
        /// Publish TwistStamped.
        #[param("stamped")]
        is_stamped: bool = false,
        /// Frame of TwistStamped.
        #[param("frame_id")]
        frame_id: String = "",
        /// Rate at which the velocity is repeated; 0 for never.
        #[param("repeat_rate", unit("Hz"), within(0.0, 1000.0))]
        repeat_rate_hz: f64 = 0,
        /// Time without a key after which the robot stops; 0 for never.
        #[param("key_timeout", unit("s"), min(0.0))]
        key_timeout_s: f64 = 0,
    }
}

impl TeleopParams {
    /// Initial state of the keyboard. Initial speeds are clamped to their limits.
    #[must_use]
    pub fn keyboard(&self) -> Keyboard {
        Keyboard {
            speed_m_s: self.speed_m_s.min(self.speed_limit_m_s),
            turn_rad_s: self.turn_rad_s.min(self.turn_limit_rad_s),
            speed_limit_m_s: self.speed_limit_m_s,
            turn_limit_rad_s: self.turn_limit_rad_s,
            direction: Direction::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;
    use periplus_params::Given;

    use super::*;

    #[test]
    fn the_table_has_no_slips_and_begins_as_the_keyboard_does() {
        assert_eq!(TELEOP.faults(), [""; 0]);
        let mut diagnostics = Diagnostics::new();
        assert_eq!(TeleopParams::default().keyboard(), Keyboard::default());
        let given = [Given::new("speed", "2"), Given::new("speed_limit", "1.5")];
        let limited = TeleopParams::from_values(&TELEOP.check(given, None, &mut diagnostics));
        assert_eq!(limited.keyboard().speed_m_s, 1.5);
        assert!(diagnostics.is_empty());
    }
}
