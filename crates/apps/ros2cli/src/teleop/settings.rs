//! What a user may set.

use periplus_params::{Table, Values, flag, number, text};

use crate::teleop::Keyboard;

/// The parameters of the node, by the names that `teleop_twist_keyboard` has for them.
pub static TELEOP: Table = Table {
    name: "teleop_twist_keyboard",
    doc: "Drives by keys.",
    parameters: &[
        number("speed", "m/s", "Speed of straight motion at the start.").or("0.5").above(0.0),
        number("turn", "rad/s", "Speed of turns at the start.").or("1").above(0.0),
        number("speed_limit", "m/s", "The speed goes no higher.").or("1000").above(0.0),
        number("turn_limit", "rad/s", "The turn goes no higher.").or("1000").above(0.0),
        flag("stamped", "Whether velocities have a time and a frame (TwistStamped).").or("false"),
        text("frame_id", "The frame of velocities with a time.").or(""),
        number("repeat_rate", "Hz", "How often a velocity is sent again; 0 for never.")
            .or("0")
            .within(0.0, 1000.0),
        number(
            "key_timeout",
            "s",
            "Without a key for so long the robot stands still; 0 for never.",
        )
        .or("0")
        .min(0.0),
    ],
};

/// How to drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Speeds at the start, and their limits.
    pub keyboard: Keyboard,
    /// Whether velocities have a time and a frame.
    pub is_stamped: bool,
    /// The frame of velocities with a time.
    pub frame_id: String,
    /// How often a velocity is sent again \[Hz\]; 0 for never.
    pub repeat_rate_hz: f64,
    /// Without a key for so long the robot stands still \[s\]; 0 for never.
    pub key_timeout_s: f64,
}

impl Settings {
    /// From parameters of [`TELEOP`]. Speeds above their limits begin at these.
    #[must_use]
    pub fn read(values: &Values) -> Self {
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
        assert_eq!(TELEOP.slips(), [""; 0]);
        let mut diagnostics = Diagnostics::new();
        let usual = Settings::read(&TELEOP.check([], None, &mut diagnostics));
        assert_eq!(usual.keyboard, Keyboard::default());
        let given = [Given::new("speed", "2"), Given::new("speed_limit", "1.5")];
        let limited = Settings::read(&TELEOP.check(given, None, &mut diagnostics));
        assert_eq!(limited.keyboard.speed_m_s, 1.5);
        assert!(diagnostics.is_empty());
    }
}
