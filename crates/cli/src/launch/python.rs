//! Launch files in Python, evaluated by a python3 of the machine's.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use periplus_launch::{Answer, BOOT, Interpreter, MODULES};
use serde_json::{Map, Value, json};

/// A python3 that waits for requests.
pub(super) struct Python {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Python {
    /// Starts one.
    pub(super) fn start() -> Result<Self, String> {
        let mut child = Command::new("python3")
            // Whatever the machine has under the names of ROS: ours come first.
            .args(["-c", BOOT])
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| {
                format!(
                    "this launch file is written in Python, and no python3 can be started: {error}; \
                     install one, or give a launch file in XML or YAML"
                )
            })?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("python3 has no standard input or output".into());
        };
        let mut python = Self { child, requests, answers: BufReader::new(answers) };
        let modules: Map<String, Value> =
            MODULES.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
        python.send(&Value::Object(modules))?;
        Ok(python)
    }

    fn send(&mut self, message: &Value) -> Result<(), String> {
        let mut line = message.to_string();
        line.push('\n');
        self.requests
            .write_all(line.as_bytes())
            .map_err(|error| format!("python3 has ended: {error}"))
    }
}

impl Interpreter for Python {
    fn ask(&mut self, request: Value, answer: &mut Answer<'_>) -> Result<Value, String> {
        self.send(&request)?;
        loop {
            let mut line = String::new();
            let read = self.answers.read_line(&mut line).map_err(|error| error.to_string())?;
            if read == 0 {
                return Err("python3 has ended before it has answered".into());
            }
            let message: Value = serde_json::from_str(&line)
                .map_err(|error| format!("python3 has answered what is no JSON: {error}"))?;
            if message.get("question").is_some() {
                let reply = match answer(message) {
                    Ok(answer) => json!({ "answer": answer }),
                    Err(why) => json!({ "error": why }),
                };
                self.send(&reply)?;
            } else if let Some(error) = message.get("error") {
                return Err(error.as_str().unwrap_or_default().to_owned());
            } else {
                return Ok(message);
            }
        }
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        // It ends by itself with its input; a file that hangs must not keep us.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
