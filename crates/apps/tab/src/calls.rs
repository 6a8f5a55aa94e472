//! Functions of the module that take JSON: checks, archives, mapping of logs, results of a session.
#![expect(clippy::disallowed_methods, reason = "a tab is an edge: its files are in memory")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use periplus_loader::LoadContext;
use periplus_os::fs;
use periplus_session::check::{CheckedFile, report};
use periplus_session::terminal;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::call_error::TabCallError;
use crate::log_mapping::{LogMappingOptions, LogMappingTask};
use crate::options::pairs;
use crate::tab::Tab;
use crate::unpack;

/// Longest slice of mapping \[ms\].
const MAX_SLICE_MS: f64 = 10_000.0;

/// A function with its arguments, such as `{"check": {"files": ["/files/robot.urdf"]}}`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum TabCall {
    /// Checks files. Answer: `report`, as `periplus check --json` prints it, and `text`, as it prints without.
    Check(Box<CheckOptions>),
    /// Unpacks an archive. Answer: `files`, `bytes`, and `left_out` with the reasons.
    Unpack(UnpackOptions),
    /// Starts to map a log. Answer: `messages`.
    MapOpen(Box<LogMappingOptions>),
    /// Maps for some time. Answer: the progress.
    MapStep(StepOptions),
    /// Draws the present map. Answer: bytes of a PNG.
    MapPreview(NoOptions),
    /// Writes the results of a complete map. Answer: the report.
    MapWrite(NoOptions),
    /// Ends mapping, also an incomplete one.
    MapClose(NoOptions),
    /// Writes map and session of the running session. Answer: `folder`, which is null where nothing maps.
    WriteResults(NoOptions),
    /// Takes the messages of the simulator since the last time. Answer: `text`.
    Messages(NoOptions),
}

/// No arguments: `{}`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoOptions {}

/// Arguments of a check.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CheckOptions {
    /// Files to check.
    pub files: Vec<PathBuf>,
    /// Xacro arguments.
    #[serde(default)]
    pub arguments: BTreeMap<String, String>,
    /// Folders searched for packages and models, besides those around the files.
    #[serde(default)]
    pub resource_path: Vec<PathBuf>,
    /// True to fail on warnings, too.
    #[serde(default)]
    pub strict: bool,
}

/// Arguments of unpacking.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnpackOptions {
    /// Archive: `.zip`, `.tar.gz` or `.tar`.
    pub archive: PathBuf,
    /// Folder to which its files are written.
    pub folder: PathBuf,
}

/// Arguments of a slice of mapping.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepOptions {
    /// Wall time after which the call returns \[ms\].
    pub budget_ms: f64,
}

/// State between calls.
#[derive(Default)]
pub struct TabCalls {
    mapping: Option<LogMappingTask>,
}

impl TabCalls {
    /// Executes a call, and returns its answer: JSON, or the bytes of a picture.
    ///
    /// # Errors
    /// The reason.
    pub fn answer(&mut self, call: &[u8], tab: Option<&mut Tab>) -> Result<Vec<u8>, TabCallError> {
        self.execute(serde_json::from_slice(call).map_err(TabCallError::Invalid)?, tab)
    }

    fn execute(&mut self, call: TabCall, tab: Option<&mut Tab>) -> Result<Vec<u8>, TabCallError> {
        let answer = match call {
            TabCall::Check(options) => check(&options)?,
            TabCall::Unpack(options) => unpacked(&options)?,
            TabCall::MapOpen(options) => {
                // The memory of an old map is freed first.
                self.mapping = None;
                self.mapping = Some(LogMappingTask::open(*options)?);
                json!({ "messages": take_messages() })
            }
            TabCall::MapStep(options) => {
                let budget_ms = options.budget_ms.clamp(0.0, MAX_SLICE_MS);
                self.mapping()?.step(Duration::from_secs_f64(budget_ms * 1e-3))?
            }
            TabCall::MapPreview(NoOptions {}) => return self.mapping()?.preview(),
            TabCall::MapWrite(NoOptions {}) => self.mapping()?.write()?,
            TabCall::MapClose(NoOptions {}) => {
                self.mapping = None;
                json!({})
            }
            TabCall::WriteResults(NoOptions {}) => {
                let tab =
                    tab.ok_or(TabCallError::NotReady("there is no session; open one first"))?;
                json!({ "folder": tab.write_results().map_err(TabCallError::Results)? })
            }
            TabCall::Messages(NoOptions {}) => json!({ "text": take_messages() }),
        };
        serde_json::to_vec(&answer).map_err(TabCallError::Invalid)
    }

    fn mapping(&mut self) -> Result<&mut LogMappingTask, TabCallError> {
        self.mapping
            .as_mut()
            .ok_or(TabCallError::NotReady("no log is mapped; `map_open` starts it"))
    }
}

/// Messages since the last time. On other targets than WebAssembly they went to stderr.
pub(crate) fn take_messages() -> String {
    #[cfg(target_family = "wasm")]
    return terminal::take_messages();
    #[cfg(not(target_family = "wasm"))]
    String::new()
}

/// A reason after the messages that lead to it.
#[cfg(target_family = "wasm")]
pub(crate) fn with_messages(why: &str) -> String {
    let messages = take_messages();
    if messages.is_empty() { why.to_owned() } else { format!("{messages}{why}") }
}

fn check(options: &CheckOptions) -> Result<Value, TabCallError> {
    if options.files.is_empty() {
        return Err(TabCallError::Argument("no file to check: give `files`".to_owned()));
    }
    let arguments = pairs(&options.arguments);
    let checked: Vec<CheckedFile> =
        terminal::search(&options.resource_path).with_context(true, |context| {
            let context = LoadContext { arguments, ..context.clone() };
            options.files.iter().map(|file| CheckedFile::read_alone(file, &context)).collect()
        });
    let mut text = Vec::new();
    for file in &checked {
        file.write_text(&mut text, false).map_err(TabCallError::Output)?;
    }
    let is_ok = !checked.iter().any(|file| file.is_bad(options.strict));
    let files: Vec<Value> = checked.iter().map(CheckedFile::to_json).collect();
    let text = terminal::without_colours(&String::from_utf8_lossy(&text));
    Ok(json!({ "report": report(&files, is_ok), "text": text }))
}

fn unpacked(options: &UnpackOptions) -> Result<Value, TabCallError> {
    let path = &options.archive;
    let archive = fs::read(path).map_err(|error| TabCallError::File(path.clone(), error))?;
    let contents =
        unpack::read(&archive).map_err(|error| TabCallError::Archive(path.clone(), error))?;
    let mut files = Vec::new();
    let bytes: usize = contents.files.iter().map(|(_, content)| content.len()).sum();
    for (name, content) in contents.files {
        let target = options.folder.join(name);
        let folder = target.parent().unwrap_or(Path::new("/"));
        fs::create_dir_all(folder)
            .and_then(|()| fs::write(&target, content))
            .map_err(|error| TabCallError::File(target.clone(), error))?;
        files.push(target);
    }
    Ok(json!({ "files": files, "bytes": bytes, "left_out": contents.left_out }))
}
