//! Driving by keys.

use periplus_teleop::Keyboard;

use super::Setting;
use crate::{Case, Differences, Unreadable};

/// A velocity after each key.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let mut keyboard = Keyboard {
        speed_m_s: given.get("speed")?.number()?,
        turn_rad_s: given.get("turn")?.number()?,
        ..Keyboard::default()
    };
    let (keys, twists) = (given.get("keys")?.list()?, case.expect().get("twists")?.list()?);
    differences.same("number of twists", &keys.len(), &twists.len());
    for (at, (key, twist)) in keys.iter().zip(&twists).enumerate() {
        let key = key.text()?.chars().next().ok_or_else(|| key.unreadable("a key"))?;
        keyboard.press(key);
        let velocity = keyboard.velocity();
        let expected = twist.get("linear")?.array::<3>()?;
        let what = format!("key {at} `{key}`");
        differences.all_near(format_args!("{what}, linear"), &velocity.linear_m_s, &expected);
        let expected = twist.get("angular_z")?.number()?;
        differences.near(format_args!("{what}, angular"), velocity.angular_z_rad_s, expected);
    }
    Ok(())
}
