//! Opening a page in the default browser.

use std::process::{Command, Stdio};

/// Asks the system to open a URL; returns false when no opener could be started.
#[must_use]
pub fn open(url: &str) -> bool {
    let mut command = if cfg!(target_os = "windows") {
        let mut command = Command::new("rundll32");
        command.arg("url.dll,FileProtocolHandler");
        command
    } else if cfg!(target_os = "macos") {
        Command::new("open")
    } else {
        Command::new("xdg-open")
    };
    // Discards the output of the browser.
    command.arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = command.spawn() else { return false };
    // A thread reaps the child process.
    std::thread::spawn(move || child.wait());
    true
}
