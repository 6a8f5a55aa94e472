//! Files and environment of the machine.
#![allow(
    clippy::disallowed_methods,
    reason = "the edge through which all other code reads the clock"
)]

use std::io::{BufRead, BufReader, BufWriter, ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};

use periplus_diagnostics::plain_words;
use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, MAX_FILE_BYTES, Store};

use crate::{file_log, fs};

/// Machine on which this program runs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Machine;

impl Host for Machine {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        // Checked before opening: opening a named pipe would block until another process writes to it.
        let metadata = fs::metadata(path).map_err(|error| refusal(&error))?;
        if !metadata.is_file() {
            return Err(FileReadError::NotAFile);
        }
        if metadata.len() > MAX_FILE_BYTES {
            return Err(FileReadError::TooLarge(metadata.len()));
        }
        let file = fs::File::open(path).map_err(|error| refusal(&error))?;
        let mut bytes = Vec::with_capacity(usize::try_from(metadata.len()).unwrap_or(0));
        // A file may grow while it is read, and files in /proc do not report their size.
        let read = file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes);
        read.map_err(|error| refusal(&error))?;
        let size = bytes.len() as u64;
        if size > MAX_FILE_BYTES {
            return Err(FileReadError::TooLarge(size));
        }
        file_log::note_read(path);
        Ok(bytes)
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        let metadata = fs::metadata(path).ok()?;
        let kind = if metadata.is_file() {
            Some(EntryKind::File)
        } else {
            metadata.is_dir().then_some(EntryKind::Folder)
        };
        file_log::note_kind(path, kind);
        kind
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        file_log::note_kind(folder, Some(EntryKind::Folder));
        // A name that is not UTF-8 cannot occur in a robot file either.
        let mut names: Vec<String> =
            entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
        names.sort_unstable();
        names
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        fs::canonicalize(path).ok()
    }

    fn variable(&self, name: &str) -> Option<String> {
        let value = std::env::var(name).ok();
        file_log::note_variable(name, value.as_ref());
        value
    }
}

impl Machine {
    /// Opens a file for buffered reading, so that large files need not be in memory.
    ///
    /// # Errors
    /// As [`Host::read`], except for errors during reading.
    pub fn reader(&self, path: &Path) -> Result<impl BufRead + use<>, FileReadError> {
        let metadata = fs::metadata(path).map_err(|error| refusal(&error))?;
        if !metadata.is_file() {
            return Err(FileReadError::NotAFile);
        }
        if metadata.len() > MAX_FILE_BYTES {
            return Err(FileReadError::TooLarge(metadata.len()));
        }
        let file = fs::File::open(path).map_err(|error| refusal(&error))?;
        file_log::note_read(path);
        Ok(BufReader::with_capacity(READ_BUFFER_BYTES, file.take(MAX_FILE_BYTES)))
    }

    /// Writes a file piecewise and atomically replaces an existing one: the old file remains until all
    /// content is written.
    ///
    /// # Errors
    /// If the file cannot be written, or `write` fails.
    pub fn replace_by(
        &self,
        path: &Path,
        write: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
    ) -> Result<(), FileWriteError> {
        let words = |error: std::io::Error| FileWriteError::Other(plain_words(&error));
        let mut name = path.file_name().ok_or(FileWriteError::NoFileName)?.to_owned();
        name.push(format!(".{}.part", crate::process_id()));
        let beside = path.with_file_name(name);
        remove_stale(path);
        let written = write_new(&beside, write).and_then(|()| fs::rename(&beside, path));
        if written.is_err() {
            // A failure here has no remedy.
            let _ = fs::remove_file(&beside);
        }
        written.map_err(words)
    }
}

impl Store for Machine {
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), FileWriteError> {
        self.replace_by(path, |file| file.write_all(content))
    }
}

/// Size of the read buffer \[bytes\].
const READ_BUFFER_BYTES: usize = 64 << 10;

/// Minimum age of a partial file of a terminated process before it is removed \[s\].
const STALE_S: u64 = 60;

/// Removes the partial files `NAME.PID.part` of terminated writers of this file. A recent one is kept: its
/// process may not be visible here, as in a container.
fn remove_stale(path: &Path) {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    // Without /proc the running processes are not known.
    if !fs::exists(Path::new("/proc/self")) {
        return;
    }
    for entry in Machine.list(folder) {
        let rest = entry.strip_prefix(name).and_then(|rest| rest.strip_prefix('.'));
        let Some(process) = rest.and_then(|rest| rest.strip_suffix(".part")) else { continue };
        let is_number = !process.is_empty() && process.bytes().all(|byte| byte.is_ascii_digit());
        if !is_number || fs::exists(&Path::new("/proc").join(process)) {
            continue;
        }
        let part = folder.join(&entry);
        let age = fs::metadata(&part).and_then(|data| data.modified()).ok();
        let age = age.and_then(|changed| changed.elapsed().ok());
        if age.is_some_and(|age| age.as_secs() >= STALE_S) {
            // A failure here has no remedy.
            let _ = fs::remove_file(part);
        }
    }
}

/// Written to disk before it is renamed, so that a power failure leaves no empty file under the name.
fn write_new(
    path: &Path,
    write: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
) -> std::io::Result<()> {
    let mut file = BufWriter::new(fs::File::create(path)?);
    write(&mut file)?;
    file.flush()?;
    file.get_ref().sync_all()
}

fn refusal(error: &std::io::Error) -> FileReadError {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => FileReadError::Missing,
        _ => FileReadError::Other(plain_words(error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Folder that is removed at the end of the test.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let name = format!("periplus-host-{name}-{}", std::process::id());
            let folder = std::env::temp_dir().join(name);
            fs::create_dir_all(&folder).unwrap();
            Self(folder.canonicalize().unwrap())
        }

        fn with_file(self, name: &str, content: &str) -> Self {
            let path = self.0.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
            self
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn regular_files_are_read_and_folders_are_not() {
        let folder = Folder::new("read").with_file("a/b.txt", "hello");
        let read = |name: &str| Machine.read(&folder.0.join(name));
        assert_eq!(read("a/b.txt"), Ok(b"hello".to_vec()));
        assert_eq!(read("a/c.txt"), Err(FileReadError::Missing));
        assert_eq!(read("a/b.txt/c"), Err(FileReadError::Missing));
        assert_eq!(read("a"), Err(FileReadError::NotAFile));
        assert!(Machine.read(Path::new("a\0b")).is_err());
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = Folder::new("replace").with_file("map.yaml", "old");
        let path = folder.0.join("map.yaml");
        assert_eq!(Machine.replace(&path, b"new"), Ok(()));
        assert_eq!(Machine.read(&path), Ok(b"new".to_vec()));
        assert!(Machine.replace(&folder.0.join("no/map.yaml"), b"new").is_err());
        assert!(Machine.replace(&folder.0, b"new").is_err(), "a folder stays a folder");
        assert_eq!(Machine.list(&folder.0), ["map.yaml"], "nothing is left behind");
    }

    #[test]
    fn parts_of_killed_writers_are_removed() {
        if !fs::exists(Path::new("/proc/self")) {
            println!("SKIPPED: there is no /proc here");
            return;
        }
        // No process has an id this large (PID_MAX_LIMIT is 2^22).
        let own = format!("map.yaml.{}.part", std::process::id());
        let folder = Folder::new("stale")
            .with_file("map.yaml.99999999.part", "half")
            .with_file("map.yaml.88888888.part", "half, and young")
            .with_file("map.pgm.99999999.part", "of another file")
            .with_file("map.yaml.mine.part", "of a person")
            .with_file(&own, "of a process that lives");
        let old = std::time::SystemTime::now() - std::time::Duration::from_secs(2 * STALE_S);
        for name in ["map.yaml.99999999.part", "map.pgm.99999999.part", &own] {
            let file = fs::File::options().write(true).open(folder.0.join(name)).unwrap();
            file.set_modified(old).unwrap();
        }
        remove_stale(&folder.0.join("map.yaml"));
        assert_eq!(
            Machine.list(&folder.0),
            ["map.pgm.99999999.part", "map.yaml.88888888.part", &own, "map.yaml.mine.part"]
                .iter()
                .map(|name| (*name).to_owned())
                .collect::<std::collections::BTreeSet<_>>()
                .into_iter()
                .collect::<Vec<_>>()
        );
    }

    #[test]
    fn what_stands_there() {
        let folder = Folder::new("kind").with_file("b", "").with_file("a/x", "").with_file("c", "");
        let kind = |name: &str| Machine.kind(&folder.0.join(name));
        assert_eq!([kind("a"), kind("b")], [Some(EntryKind::Folder), Some(EntryKind::File)]);
        assert_eq!(kind("d"), None);
        assert_eq!(Machine.list(&folder.0), ["a", "b", "c"]);
        assert!(Machine.list(&folder.0.join("b")).is_empty());
        assert_eq!(Machine.canonical(&folder.0.join("a/../b")), Some(folder.0.join("b")));
        assert_eq!(Machine.canonical(&folder.0.join("d")), None);
    }

    #[test]
    fn a_file_too_large_is_refused_unread() {
        let folder = Folder::new("large").with_file("large", "");
        let path = folder.0.join("large");
        // Sparse: it takes no space on the disk.
        fs::File::create(&path).unwrap().set_len(MAX_FILE_BYTES + 1).unwrap();
        assert_eq!(Machine.read(&path), Err(FileReadError::TooLarge(MAX_FILE_BYTES + 1)));
    }

    #[cfg(unix)]
    #[test]
    fn devices_and_pipes_are_refused_without_waiting() {
        for device in ["/dev/zero", "/dev/random", "/dev/null"] {
            assert_eq!(Machine.read(Path::new(device)), Err(FileReadError::NotAFile), "{device}");
            assert_eq!(Machine.kind(Path::new(device)), None, "{device}");
        }
        let folder = Folder::new("pipe");
        let pipe = folder.0.join("pipe");
        match std::process::Command::new("mkfifo").arg(&pipe).status() {
            Ok(status) if status.success() => {
                assert_eq!(Machine.read(&pipe), Err(FileReadError::NotAFile));
            }
            _ => println!("SKIPPED: there is no mkfifo to make a pipe with"),
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_circles_are_nothing() {
        let folder = Folder::new("links").with_file("a", "hello");
        std::os::unix::fs::symlink("a", folder.0.join("b")).unwrap();
        std::os::unix::fs::symlink("c", folder.0.join("c")).unwrap();
        assert_eq!(Machine.canonical(&folder.0.join("b")), Some(folder.0.join("a")));
        assert_eq!(Machine.read(&folder.0.join("b")), Ok(b"hello".to_vec()));
        assert_eq!(Machine.kind(&folder.0.join("c")), None);
        assert!(Machine.read(&folder.0.join("c")).is_err());
    }

    #[test]
    fn a_resolver_finds_real_files() {
        let folder = Folder::new("resolver")
            .with_file("bot/package.xml", "<package><name>bot</name></package>")
            .with_file("bot/urdf/bot.urdf", "")
            .with_file("bot/meshes/a.stl", "");
        let resolver = periplus_resources::Resolver::new(&Machine, &[]);
        let from = folder.0.join("bot/urdf/bot.urdf");
        let mesh = folder.0.join("bot/meshes/a.stl");
        assert_eq!(resolver.resolve("package://bot/meshes/a.stl", &from), Ok(mesh));
        assert!(resolver.resolve("/etc/hostname", &from).is_err());
    }
}
