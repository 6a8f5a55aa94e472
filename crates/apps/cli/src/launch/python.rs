//! Launch files in Python, evaluated by the python3 of the machine.

use std::io::{self, BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use periplus_launch::{
    Answer, BOOT, Interpreter, LaunchError, MAX_MEMORY_BYTES, MODULES, OutsideError,
};
use serde_json::{Map, Value, json};

use super::tools::Tools;

/// Maximum size of an answer \[bytes\]: robot descriptions have some hundred thousand.
const MAX_ANSWER_BYTES: u64 = 256 << 20;

/// Python process that serves requests.
pub(super) struct Python {
    child: Child,
    requests: ChildStdin,
    answers: Receiver<io::Result<String>>,
    /// Time limit of an answer.
    limit: Duration,
}

impl Python {
    /// Starts the process.
    pub(super) fn start(limit: Duration, tools: Option<&Tools>) -> Result<Self, OutsideError> {
        let mut child = Command::new("python3")
            // Our modules come first, before installed ones with the names of ROS packages.
            .args(["-c", BOOT])
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .envs(tools.map(|tools| ("PATH", tools.path())))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| {
                OutsideError::Unavailable(format!(
                    "this launch file is written in Python, and no python3 can be started: {error}; \
                     install one, or give a launch file in XML or YAML"
                ))
            })?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            let why = "python3 has no standard input or output".to_owned();
            return Err(OutsideError::Unavailable(why));
        };
        let mut python = Self { child, requests, answers: lines(answers), limit };
        let modules: Map<String, Value> =
            MODULES.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
        python.send(&json!({ "modules": modules, "most_memory": MAX_MEMORY_BYTES }))?;
        Ok(python)
    }

    fn send(&mut self, message: &Value) -> Result<(), OutsideError> {
        let mut line = message.to_string();
        line.push('\n');
        self.requests
            .write_all(line.as_bytes())
            .map_err(|error| OutsideError::Unavailable(format!("python3 ended: {error}")))
    }

    fn message(&mut self) -> Result<Value, LaunchError> {
        let line = match self.answers.recv_timeout(self.limit) {
            Ok(line) => line.map_err(|error| error.to_string())?,
            Err(RecvTimeoutError::Timeout) => {
                return Err(LaunchError {
                    message: format!(
                        "evaluation of this launch file exceeded {} s",
                        self.limit.as_secs_f64()
                    ),
                    line: None,
                    help: Some("if it needs longer, raise `--evaluation-limit SECONDS`".into()),
                });
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err("python3 ended before it answered".to_owned().into());
            }
        };
        serde_json::from_str(&line)
            .map_err(|error| format!("the answer of python3 is not JSON: {error}").into())
    }
}

/// Lines of a pipe, read on a separate thread so that waiting can time out.
fn lines(pipe: ChildStdout) -> Receiver<io::Result<String>> {
    let (send, lines) = channel();
    std::thread::spawn(move || {
        let mut pipe = BufReader::new(pipe);
        loop {
            let mut line = String::new();
            let read = pipe.by_ref().take(MAX_ANSWER_BYTES).read_line(&mut line);
            let sent = match read {
                Ok(0) => return,
                Ok(_) => send.send(Ok(line)),
                Err(error) => send.send(Err(error)),
            };
            if sent.is_err() {
                return;
            }
        }
    });
    lines
}

impl Interpreter for Python {
    fn ask(&mut self, request: Value, answer: &mut Answer<'_>) -> Result<Value, LaunchError> {
        self.send(&request)?;
        loop {
            let message = self.message()?;
            if message.get("question").is_some() {
                let reply = match answer(message) {
                    Ok(answer) => json!({ "answer": answer }),
                    Err(why) => json!({ "error": why.message }),
                };
                self.send(&reply)?;
            } else if let Some(error) = message.get("error") {
                let text = |name: &str| message[name].as_str().map(str::to_owned);
                return Err(LaunchError {
                    message: error.as_str().unwrap_or_default().to_owned(),
                    line: text("line"),
                    help: text("help"),
                });
            } else {
                return Ok(message);
            }
        }
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        // The process ends with its input; the kill covers a launch file that blocks.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
