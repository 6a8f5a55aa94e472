//! A call of a tool: the command in another process, and its result.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_os::Stopwatch;
use rmcp::model::{CallToolResult, ContentBlock, ProgressNotificationParam};
use rmcp::service::{RequestContext, RoleServer};
use serde_json::{Value, json};

use super::files::{FileState, pictures};
use super::tools::Call;
use crate::own_command::own_command;

/// Maximum size of an output in a result \[bytes\].
const MAX_OUTPUT_BYTES: usize = 200_000;

/// Time between looks at the process.
const POLL: Duration = Duration::from_millis(20);

/// Time between progress notifications.
const PROGRESS: Duration = Duration::from_secs(1);

/// Time for a command to write its report after it was interrupted.
const GRACE: Duration = Duration::from_secs(10);

/// Reason for which a command was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stopped {
    Timeout,
    Cancelled,
}

/// Runs a command in `folder` and returns its output, exit code, written files and pictures.
pub(super) async fn run(
    call: &Call,
    folder: &Path,
    context: &RequestContext<RoleServer>,
) -> CallToolResult {
    let paths: Vec<PathBuf> = call.words.iter().map(|word| path_of(word)).collect();
    let before = FileState::of(folder, &paths);
    let mut child = match spawn(call, folder) {
        Ok(child) => child,
        Err(error) => {
            return CallToolResult::error(vec![ContentBlock::text(format!(
                "cannot start periplus: {error}"
            ))]);
        }
    };
    let stdout = Output::read(child.stdout.take());
    let stderr = Output::read(child.stderr.take());
    let (status, stopped) = wait(&mut child, call, context, &stderr).await;
    let (stdout, stderr) = (stdout.finish(), stderr.finish());
    let files = FileState::of(folder, &paths).changed_since(&before);
    result(call, status, stopped, &stdout, &stderr, &files, folder)
}

/// Path in a word such as `--out=DIR`.
fn path_of(word: &str) -> PathBuf {
    let value = word.strip_prefix("--").and_then(|option| option.split_once('=')).map(|(_, it)| it);
    PathBuf::from(value.unwrap_or(word))
}

fn spawn(call: &Call, folder: &Path) -> std::io::Result<Child> {
    let (program, first) = own_command().split_first().ok_or(std::io::ErrorKind::NotFound)?;
    Command::new(program)
        .args(first)
        .args(["--color", "never"])
        .args(&call.words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
}

/// Waits for the end; interrupts the command at its timeout or when the client cancels the call.
async fn wait(
    child: &mut Child,
    call: &Call,
    context: &RequestContext<RoleServer>,
    stderr: &Output,
) -> (Option<ExitStatus>, Option<Stopped>) {
    let watch = Stopwatch::start();
    let token = context.meta.get_progress_token();
    let mut stopped: Option<(Stopped, Duration)> = None;
    let mut next_progress = PROGRESS;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return (Some(status), stopped.map(|(why, _)| why)),
            Ok(None) => {}
            Err(_) => return (None, stopped.map(|(why, _)| why)),
        }
        let elapsed = watch.elapsed();
        match stopped {
            None => {
                let why = if context.ct.is_cancelled() {
                    Some(Stopped::Cancelled)
                } else if elapsed.as_secs_f64() > call.timeout_s {
                    Some(Stopped::Timeout)
                } else {
                    None
                };
                if let Some(why) = why {
                    interrupt(child);
                    stopped = Some((why, elapsed));
                }
            }
            Some((_, at)) if elapsed > at + GRACE => {
                // What is left of it must not outlive the call.
                let _ = child.kill();
            }
            Some(_) => {}
        }
        if let (Some(token), true) = (&token, elapsed >= next_progress) {
            next_progress = elapsed + PROGRESS;
            let message = stderr.last_line();
            let progress = ProgressNotificationParam::new(token.clone(), elapsed.as_secs_f64());
            let progress =
                if message.is_empty() { progress } else { progress.with_message(message) };
            // A client that is gone ends the service, and with it this call.
            let _ = context.peer.notify_progress(progress).await;
        }
        tokio::time::sleep(POLL).await;
    }
}

/// Asks the command to end, as Ctrl-C does.
fn interrupt(child: &mut Child) {
    #[cfg(unix)]
    {
        let id = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw);
        if let Some(id) = id {
            let _ = rustix::process::kill_process(id, rustix::process::Signal::INT);
            return;
        }
    }
    let _ = child.kill();
}

/// Output of a process, read in a thread so that it never waits for us.
struct Output {
    bytes: Arc<Mutex<Vec<u8>>>,
    reader: Option<JoinHandle<()>>,
}

impl Output {
    fn read(pipe: Option<impl Read + Send + 'static>) -> Self {
        let bytes = Arc::new(Mutex::new(Vec::new()));
        let filled = Arc::clone(&bytes);
        let reader = pipe.map(|mut pipe| {
            std::thread::spawn(move || {
                let mut buffer = [0; 8192];
                while let Ok(count @ 1..) = pipe.read(&mut buffer) {
                    let mut bytes = filled.lock().unwrap_or_else(PoisonError::into_inner);
                    bytes.extend_from_slice(&buffer[..count]);
                    // The end reports how a run went: the oldest is dropped.
                    if bytes.len() > 4 * MAX_OUTPUT_BYTES {
                        let old = bytes.len() - 2 * MAX_OUTPUT_BYTES;
                        bytes.drain(..old);
                    }
                }
            })
        });
        Self { bytes, reader }
    }

    fn last_line(&self) -> String {
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&bytes);
        text.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default().to_owned()
    }

    fn finish(mut self) -> String {
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

/// Result for the client.
fn result(
    call: &Call,
    status: Option<ExitStatus>,
    stopped: Option<Stopped>,
    stdout: &str,
    stderr: &str,
    files: &[PathBuf],
    folder: &Path,
) -> CallToolResult {
    let output = call.prints_json.then(|| json_of(stdout)).flatten();
    let code = status.and_then(|status| status.code());
    let mut content = Vec::new();
    if !stdout.trim().is_empty() {
        content.push(ContentBlock::text(ending(stdout)));
    }
    if !stderr.trim().is_empty() {
        content.push(ContentBlock::text(ending(stderr)));
    }
    let end = match (stopped, code) {
        (Some(Stopped::Timeout), _) => format!("stopped after {} s (`timeout_s`)", call.timeout_s),
        (Some(Stopped::Cancelled), _) => "stopped: the call was cancelled".to_owned(),
        (None, Some(code)) => format!("exit code {code}"),
        (None, None) => "ended by a signal".to_owned(),
    };
    content.push(ContentBlock::text(end));
    let shown: Vec<String> = files
        .iter()
        .map(|path| path.strip_prefix(folder).unwrap_or(path).display().to_string())
        .collect();
    if !shown.is_empty() {
        content.push(ContentBlock::text(format!("files written: {}", shown.join(", "))));
    }
    let (pictures, left_out) = pictures(files);
    content.extend(pictures);
    if !left_out.is_empty() {
        content.push(ContentBlock::text(format!("pictures not shown: {}", left_out.join("; "))));
    }
    // A command without an end, such as a simulation in real time, ends by its timeout.
    let is_well = stopped == Some(Stopped::Timeout) || (stopped.is_none() && code == Some(0));
    let mut result =
        if is_well { CallToolResult::success(content) } else { CallToolResult::error(content) };
    result.structured_content =
        Some(json!({ "exit_code": code, "output": output, "files": shown }));
    result
}

/// JSON of an output: one value, or one per line as a list.
fn json_of(text: &str) -> Option<Value> {
    if let Ok(value) = serde_json::from_str(text) {
        return Some(value);
    }
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    let values: Result<Vec<Value>, _> = lines.map(serde_json::from_str).collect();
    values.ok().filter(|values| !values.is_empty()).map(Value::Array)
}

/// End of a text, at most `MAX_OUTPUT_BYTES`.
fn ending(text: &str) -> String {
    if text.len() <= MAX_OUTPUT_BYTES {
        return text.trim_end().to_owned();
    }
    let from = text.ceil_char_boundary(text.len() - MAX_OUTPUT_BYTES);
    format!("[{from} bytes left out]\n{}", text[from..].trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_is_one_value_or_one_per_line() {
        assert_eq!(json_of("{\"a\": 1}\n"), Some(json!({ "a": 1 })));
        assert_eq!(json_of("1\n2\n"), Some(json!([1, 2])));
        assert_eq!(json_of("done\n"), None);
        assert_eq!(json_of(""), None);
    }

    #[test]
    fn the_end_of_a_long_output_is_kept() {
        let long = format!("{}é", "x".repeat(MAX_OUTPUT_BYTES));
        let end = ending(&long);
        assert!(end.starts_with("[2 bytes left out]\n") && end.ends_with('é'), "{}", &end[..30]);
    }

    #[test]
    fn paths_are_found_in_options() {
        assert_eq!(path_of("--out=maps/room"), Path::new("maps/room"));
        assert_eq!(path_of("room.sdf"), Path::new("room.sdf"));
    }
}
