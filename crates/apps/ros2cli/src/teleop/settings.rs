//! Parameters of teleoperation.

use periplus_params::{ParamValues, Table, flag, number, text};

use crate::teleop::Keyboard;

/// Parameters of the node, with the names of `teleop_twist_keyboard`.
pub static TELEOP: Table = Table {
    name: "teleop_twist_keyboard",
    doc: "Keyboard teleoperation.",
    parameters: &[
        number("speed", "m/s", "Initial linear speed.").or("0.5").above(0.0),
        number("turn", "rad/s", "Initial angular speed.").or("1").above(0.0),
        number("speed_limit", "m/s", "Maximum linear speed.").or("1000").above(0.0),
        number("turn_limit", "rad/s", "Maximum angular speed.").or("1000").above(0.0),
        flag("stamped", "Publish TwistStamped.").or("false"),
        text("frame_id", "Frame of TwistStamped.").or(""),
        number("repeat_rate", "Hz", "Rate at which the velocity is repeated; 0 for never.")
            .or("0")
            .within(0.0, 1000.0),
        number("key_timeout", "s", "Time without a key after which the robot stops; 0 for never.")
            .or("0")
            .min(0.0),
    ],
};

/// Settings of teleoperation.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Initial speeds and their limits.
    pub keyboard: Keyboard,
    /// True to publish TwistStamped.
    pub is_stamped: bool,
    /// Frame of TwistStamped.
    pub frame_id: String,
    /// Rate at which the velocity is repeated \[Hz\]; 0 for never.
    pub repeat_rate_hz: f64,
    /// Time without a key after which the robot stops \[s\]; 0 for never.
    pub key_timeout_s: f64,
}

impl Settings {
    /// Reads parameters of [`TELEOP`]. Initial speeds are clamped to their limits.
    #[must_use]
    pub fn read(values: &ParamValues) -> Self {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let (speed_limit_m_s, turn_limit_rad_s) = (number("speed_limit"), number("turn_limit"));
        Self {
            keyboard: Keyboard {
                speed_m_s: number("speed").min(speed_limit_m_s),
                turn_rad_s: number("turn").min(turn_limit_rad_s),
                speed_limit_m_s,
                turn_limit_rad_s,
                ..Keyboard::default()
            },
            is_stamped: values.flag("stamped").unwrap_or_default(),
            frame_id: values.text("frame_id").unwrap_or_default(),
            repeat_rate_hz: number("repeat_rate"),
            key_timeout_s: number("key_timeout"),
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
        let usual = Settings::read(&TELEOP.check([], None, &mut diagnostics));
        assert_eq!(usual.keyboard, Keyboard::default());
        let given = [Given::new("speed", "2"), Given::new("speed_limit", "1.5")];
        let limited = Settings::read(&TELEOP.check(given, None, &mut diagnostics));
        assert_eq!(limited.keyboard.speed_m_s, 1.5);
        assert!(diagnostics.is_empty());
    }
}
