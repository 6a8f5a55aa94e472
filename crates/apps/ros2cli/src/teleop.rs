//! Keyboard teleoperation, as `teleop_twist_keyboard` does it: the same keys, speeds and steps.
//!
//! A [`Keyboard`] holds the speeds and the direction; [`Keyboard::press`] handles a key. Terminal
//! input and publishing are left to the caller.
//!
//! ```
//! use periplus_ros2cli::teleop::{Keyboard, Pressed};
//!
//! let mut keyboard = Keyboard::default();
//! assert_eq!(keyboard.press('i'), Pressed::Drive);
//! assert_eq!(keyboard.velocity().linear_m_s, [0.5, 0.0, 0.0]);
//! assert_eq!(keyboard.press('q'), Pressed::Speed { at_limit: false });
//! assert_eq!(keyboard.velocity().linear_m_s, [0.55, 0.0, 0.0]);
//! ```

mod bindings;
mod keyboard;
mod screen;
mod settings;

pub use bindings::{Direction, Factors, direction, factors};
pub use keyboard::{Keyboard, KeyboardVelocity, Pressed};
pub use screen::{SCREEN, status};
pub use settings::{TELEOP, TeleopParams};
