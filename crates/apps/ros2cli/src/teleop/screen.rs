//! Text of the screen.

use crate::teleop::Keyboard;

/// Table of the keys.
pub const SCREEN: &str = "\
Keys drive the robot; each press sends one velocity.
---------------------------
Curves and turns:
   u    i    o
   j    k    l
   m    ,    .

Sideways, with shift (for robots that can):
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

any other key : stop

q/z : both speeds 10 % up/down
w/x : only the straight speed 10 % up/down
e/c : only the turning speed 10 % up/down

Ctrl-C ends
";

/// Speeds, in one line.
#[must_use]
pub fn status(keyboard: &Keyboard) -> String {
    format!("speed {:.3} m/s\tturn {:.3} rad/s", keyboard.speed_m_s, keyboard.turn_rad_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::teleop::{direction, factors};

    #[test]
    fn every_key_with_a_meaning_is_on_the_screen() {
        let words: Vec<&str> = SCREEN.split([' ', '\n', '/']).collect();
        for key in (' '..='~').filter(|key| direction(*key).is_some() || factors(*key).is_some()) {
            assert!(words.contains(&key.to_string().as_str()), "{key}");
        }
    }
}
