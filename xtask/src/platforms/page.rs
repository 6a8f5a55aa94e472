//! The page of a program that runs elsewhere: a browser gets it over HTTP.

use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::Runner;
use crate::step::Failed;

/// Time in which the server must be up; an emulator starts slowly.
const TIMEOUT: Duration = Duration::from_secs(90);

/// Starts the demo with its page and requests it.
pub(super) fn serve(runner: &Runner, folder: &Path) -> Result<(), Failed> {
    let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    let address = free.map_err(|error| Failed(format!("no free port: {error}")))?.to_string();
    let mut command = runner.command();
    command.args(["demo", "--no-browser"]).arg(format!("--page={address}"));
    command.current_dir(folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let child = command.spawn().map_err(|error| Failed(format!("{}: {error}", runner.name())))?;
    let mut running = Running(child);
    let started = Instant::now();
    loop {
        if let Ok(answer) = get(&address) {
            return verdict(&answer);
        }
        if let Ok(Some(status)) = running.0.try_wait() {
            return Err(Failed(format!("the demo with its page ended early ({status})")));
        }
        if started.elapsed() > TIMEOUT {
            return Err(Failed(format!("no page at {address} after {} s", TIMEOUT.as_secs())));
        }
        sleep(Duration::from_millis(200));
    }
}

/// A program that is ended with this.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn get(address: &str) -> std::io::Result<String> {
    let mut stream = TcpStream::connect(address)?;
    stream.set_read_timeout(Some(Duration::from_secs(20)))?;
    write!(stream, "GET / HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n")?;
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer)?;
    Ok(String::from_utf8_lossy(&answer).into_owned())
}

fn verdict(answer: &str) -> Result<(), Failed> {
    let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((answer, ""));
    let line = head.lines().next().unwrap_or_default();
    if line != "HTTP/1.1 200 OK" {
        return Err(Failed(format!("the page was answered with `{line}`")));
    }
    // The built page loads its modules; the text for programs without it has none.
    if !body.contains("<script type=\"module\"") {
        return Err(Failed("the answer is not the page: it loads no module".to_owned()));
    }
    Ok(())
}

#[test]
fn the_page_loads_a_module() {
    let page = "HTTP/1.1 200 OK\r\na: b\r\n\r\n<script type=\"module\" src=\"/a.js\"></script>";
    assert!(verdict(page).is_ok());
    assert!(verdict("HTTP/1.1 200 OK\r\n\r\nThis Periplus has no page in it").is_err());
    assert!(verdict("HTTP/1.1 403 Forbidden\r\n\r\n<script type=\"module\"").is_err());
}
