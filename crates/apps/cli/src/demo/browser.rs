//! Opening a page in the person's browser.

use std::process::{Command, Stdio};

/// Lets the system open an address; whether it could be asked to.
pub(crate) fn open(url: &str) -> bool {
    let mut command = if cfg!(target_os = "windows") {
        let mut command = Command::new("rundll32");
        command.arg("url.dll,FileProtocolHandler");
        command
    } else if cfg!(target_os = "macos") {
        Command::new("open")
    } else {
        Command::new("xdg-open")
    };
    // What browsers say to terminals is nobody's business.
    command.arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = command.spawn() else { return false };
    // Nobody waits for it, but somebody has to take its end.
    std::thread::spawn(move || child.wait());
    true
}
