//! Driving by keys.

use std::cell::RefCell;

use periplus_ros2cli::teleop::Keyboard;
use serde_json::{Value, json};

use super::Setting;
use crate::{Case, Differences, Unreadable, number, numbers};

/// A velocity after each key.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let keyboard = RefCell::new(Keyboard {
        speed_m_s: given.get("speed")?.number()?,
        turn_rad_s: given.get("turn")?.number()?,
        ..Keyboard::default()
    });
    let twists = given.get("keys")?.each(|key| {
        let key = key.text()?.chars().next().ok_or_else(|| key.unreadable("a key"))?;
        keyboard_press(&keyboard, key)
    })?;
    differences.compare_members(&[(&["twists"], Value::Array(twists))], &case.expect());
    Ok(())
}

/// The velocity after a key.
fn keyboard_press(keyboard: &RefCell<Keyboard>, key: char) -> Result<Value, Unreadable> {
    let mut keyboard = keyboard.borrow_mut();
    keyboard.press(key);
    let velocity = keyboard.velocity();
    let linear = numbers(velocity.linear_m_s);
    Ok(json!({ "linear": linear, "angular_z": number(velocity.angular_z_rad_s) }))
}
