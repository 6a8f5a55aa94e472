//! Files that a client uploads.

use std::collections::{BTreeSet, VecDeque};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use periplus_diagnostics::plain_words;
use periplus_os::fs::{self, File};

use crate::foxglove::protocol::UploadFile;

/// Maximum number of files of an upload: parts of a recording that was split.
const MAX_FILES: usize = 1000;

/// Maximum length of the name of a file \[bytes\], the limit of most file systems.
const MAX_NAME_BYTES: usize = 255;

/// A temporary folder, removed with its files when dropped.
#[derive(Debug)]
pub(super) struct TemporaryFolder(PathBuf);

impl TemporaryFolder {
    /// Creates a folder below `parent`; `purpose` is a part of its name.
    pub(super) fn create(parent: &Path, purpose: &str) -> Result<Self, String> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path =
            parent.join(format!("periplus-{purpose}-{}-{number}", periplus_os::process_id()));
        fs::create_dir_all(&path)
            .map_err(|error| format!("`{}`: {}", path.display(), plain_words(&error)))?;
        Ok(Self(path))
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        // A failure cannot be handled here.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// An upload in progress.
#[derive(Debug)]
pub(super) struct Upload {
    folder: TemporaryFolder,
    names: Vec<String>,
    /// Files that have not begun, with their sizes.
    waiting: VecDeque<(PathBuf, u64)>,
    /// The file being written, with the number of bytes that are missing.
    open: Option<(File, u64)>,
    received_bytes: u64,
}

/// A complete upload.
#[derive(Debug)]
pub(super) struct UploadedRecording {
    pub(super) folder: TemporaryFolder,
    pub(super) name: String,
    /// The file, or the folder of several files.
    pub(super) path: PathBuf,
}

impl Upload {
    /// Starts an upload in a new folder below `parent`.
    pub(super) fn start(
        parent: &Path,
        files: &[UploadFile],
        max_bytes: u64,
    ) -> Result<Self, String> {
        if files.is_empty() || files.len() > MAX_FILES {
            return Err(format!("an upload has 1 to {MAX_FILES} files, not {}", files.len()));
        }
        let total = files.iter().fold(0, |sum: u64, file| sum.saturating_add(file.bytes));
        if total > max_bytes {
            return Err(format!(
                "the files have {total} bytes, more than the {max_bytes} that this server accepts; \
                 start `periplus view` with the recording on its machine"
            ));
        }
        let mut names = Vec::new();
        let mut seen = BTreeSet::new();
        for file in files {
            let name = plain_name(&file.name)?;
            if !seen.insert(name.to_lowercase()) {
                return Err(format!("two files have the name `{name}`"));
            }
            names.push(name.to_owned());
        }
        let folder = TemporaryFolder::create(parent, "upload")?;
        let paths = names.iter().map(|name| folder.0.join(name));
        let waiting = paths.zip(files).map(|(path, file)| (path, file.bytes)).collect();
        let mut upload = Self { folder, names, waiting, open: None, received_bytes: 0 };
        upload.open_next()?;
        Ok(upload)
    }

    /// Number of bytes received.
    pub(super) fn received_bytes(&self) -> u64 {
        self.received_bytes
    }

    /// True if all bytes have arrived.
    pub(super) fn is_complete(&self) -> bool {
        self.open.is_none() && self.waiting.is_empty()
    }

    /// Writes the next bytes.
    pub(super) fn receive(&mut self, mut bytes: &[u8]) -> Result<(), String> {
        while !bytes.is_empty() {
            let Some((file, missing)) = &mut self.open else {
                return Err("more bytes came than were announced".to_owned());
            };
            let fitting = usize::try_from(*missing).unwrap_or(usize::MAX).min(bytes.len());
            let (now, later) = bytes.split_at(fitting);
            file.write_all(now)
                .map_err(|error| format!("the upload cannot be stored: {}", plain_words(&error)))?;
            *missing -= fitting as u64;
            self.received_bytes += fitting as u64;
            bytes = later;
            if *missing == 0 {
                self.open_next()?;
            }
        }
        Ok(())
    }

    /// Opens the next file that is not empty.
    fn open_next(&mut self) -> Result<(), String> {
        self.open = None;
        while let Some((path, bytes)) = self.waiting.pop_front() {
            let file = File::create_new(&path)
                .map_err(|error| format!("`{}`: {}", path.display(), plain_words(&error)))?;
            if bytes > 0 {
                self.open = Some((file, bytes));
                break;
            }
        }
        Ok(())
    }

    /// Ends the upload.
    pub(super) fn finish(self) -> UploadedRecording {
        let Self { folder, names, .. } = self;
        match names.as_slice() {
            [one] => {
                let name = Path::new(one).file_stem().unwrap_or_default();
                let name = name.to_string_lossy().into_owned();
                UploadedRecording { path: folder.0.join(one), folder, name }
            }
            several => {
                // Parts of a folder are named `<folder>_<number>`.
                let first = several.iter().find(|name| !name.ends_with(".yaml"));
                let stem = first.map_or("", |name| name.split('.').next().unwrap_or_default());
                let name = stem.trim_end_matches(|c: char| c.is_ascii_digit());
                let name = name.strip_suffix('_').unwrap_or(stem).to_owned();
                UploadedRecording { path: folder.0.clone(), folder, name }
            }
        }
    }
}

/// Name of a file without folders.
fn plain_name(name: &str) -> Result<&str, String> {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let is_plain = !matches!(last, "" | "." | "..")
        && last.len() <= MAX_NAME_BYTES
        && !last.chars().any(|c| c.is_control() || c == ':');
    is_plain.then_some(last).ok_or_else(|| format!("{name:?} is not the name of a file"))
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "these tests look at the files")]
mod tests {
    use super::*;

    fn start(files: &[(&str, u64)]) -> Result<Upload, String> {
        let one = |(name, bytes): &(&str, u64)| UploadFile { name: (*name).into(), bytes: *bytes };
        let files: Vec<UploadFile> = files.iter().map(one).collect();
        Upload::start(&std::env::temp_dir(), &files, 100)
    }

    #[test]
    fn bytes_are_split_into_the_files() {
        let mut upload = start(&[("run/a.mcap", 3), ("empty", 0), ("metadata.yaml", 2)]).unwrap();
        upload.receive(b"ab").unwrap();
        assert!(!upload.is_complete());
        upload.receive(b"cde").unwrap();
        assert!(upload.is_complete());
        assert_eq!(upload.received_bytes(), 5);
        assert!(upload.receive(b"f").unwrap_err().contains("more bytes"));
        let done = upload.finish();
        let read = |name: &str| String::from_utf8(fs::read(done.path.join(name)).unwrap()).unwrap();
        assert_eq!(
            (read("a.mcap"), read("empty"), read("metadata.yaml")),
            ("abc".into(), "".into(), "de".into())
        );
        let path = done.path.clone();
        drop(done);
        assert!(!path.exists());
    }

    #[test]
    fn one_file_is_the_recording_and_several_are_its_folder() {
        let mut upload = start(&[("C:\\logs\\run.bag", 1)]).unwrap();
        upload.receive(b"a").unwrap();
        let done = upload.finish();
        assert_eq!((&*done.name, done.path.file_name().unwrap()), ("run", "run.bag".as_ref()));
        let done = start(&[("metadata.yaml", 0), ("run_0.db3", 0)]).unwrap().finish();
        assert_eq!(done.name, "run");
        assert!(done.path.is_dir());
    }

    #[test]
    fn names_never_leave_the_folder() {
        for name in ["", "..", "a/..", "a\0b", "C:x", "a/"] {
            assert!(start(&[(name, 1)]).is_err(), "{name:?}");
        }
        let upload = start(&[("../../etc/passwd", 1)]).unwrap();
        assert_eq!(upload.names, ["passwd"]);
        assert!(start(&[("a", 1), ("b/A", 1)]).is_err());
        assert!(start(&[("a", 60), ("b", 60)]).is_err());
        assert!(start(&[("a", u64::MAX), ("b", u64::MAX)]).is_err());
        assert!(start(&[]).is_err());
    }
}
