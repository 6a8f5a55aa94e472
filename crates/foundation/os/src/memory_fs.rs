//! Files in memory, with the interface of [`crate::fs`], for WebAssembly.
//!
//! A file that is open stays readable when it is removed or replaced, as on Unix.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};

use periplus_resources::without_dots;

/// Bytes of a file, shared by all that have it open.
type Content = Arc<RwLock<Vec<u8>>>;

/// Entries by their absolute path; folders have no content. `/` always exists.
static ENTRIES: Mutex<BTreeMap<PathBuf, Option<Content>>> = Mutex::new(BTreeMap::new());

fn entries() -> MutexGuard<'static, BTreeMap<PathBuf, Option<Content>>> {
    ENTRIES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Absolute path without `.` and `..`; relative paths start at `/`.
pub(crate) fn plain(path: &Path) -> PathBuf {
    without_dots(&Path::new("/").join(path))
}

fn is_root(path: &Path) -> bool {
    path.parent().is_none()
}

fn missing() -> io::Error {
    ErrorKind::NotFound.into()
}

/// Content of a file.
fn content(path: &Path) -> io::Result<Content> {
    let path = plain(path);
    match entries().get(&path) {
        Some(Some(content)) => Ok(content.clone()),
        Some(None) => Err(ErrorKind::IsADirectory.into()),
        None if is_root(&path) => Err(ErrorKind::IsADirectory.into()),
        None => Err(missing()),
    }
}

/// Enters a file, in an existing folder.
fn enter(path: &Path, is_new: bool, content: Content) -> io::Result<()> {
    let path = plain(path);
    let mut entries = entries();
    let folder = path.parent().ok_or(ErrorKind::IsADirectory)?;
    match entries.get(folder) {
        Some(Some(_)) => return Err(ErrorKind::NotADirectory.into()),
        None if !is_root(folder) => return Err(missing()),
        _ => {}
    }
    match entries.get(&path) {
        Some(None) => return Err(ErrorKind::IsADirectory.into()),
        Some(Some(_)) if is_new => return Err(ErrorKind::AlreadyExists.into()),
        _ => {}
    }
    entries.insert(path, Some(content));
    Ok(())
}

/// An open file.
#[derive(Debug)]
pub struct File {
    content: Content,
    position: usize,
}

impl File {
    /// Opens a file for reading.
    ///
    /// # Errors
    /// When there is no such file.
    pub fn open(path: impl AsRef<Path>) -> io::Result<Self> {
        Ok(Self { content: content(path.as_ref())?, position: 0 })
    }

    /// Creates a file for writing, and replaces an old one.
    ///
    /// # Errors
    /// When its folder does not exist, or the path is a folder.
    pub fn create(path: impl AsRef<Path>) -> io::Result<Self> {
        let content = Content::default();
        enter(path.as_ref(), false, content.clone())?;
        Ok(Self { content, position: 0 })
    }

    /// Creates a new file for writing.
    ///
    /// # Errors
    /// When it exists, or its folder does not.
    pub fn create_new(path: impl AsRef<Path>) -> io::Result<Self> {
        let content = Content::default();
        enter(path.as_ref(), true, content.clone())?;
        Ok(Self { content, position: 0 })
    }

    /// Size of the file.
    ///
    /// # Errors
    /// None.
    pub fn metadata(&self) -> io::Result<MemoryFileInfo> {
        Ok(MemoryFileInfo { bytes: Some(self.read_lock().len()) })
    }

    /// Does nothing: memory is not a disk.
    ///
    /// # Errors
    /// None.
    pub fn sync_all(&self) -> io::Result<()> {
        Ok(())
    }

    fn read_lock(&self) -> std::sync::RwLockReadGuard<'_, Vec<u8>> {
        self.content.read().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Read for File {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let content = self.read_lock();
        let rest = content.get(self.position..).unwrap_or_default();
        let count = rest.len().min(bytes.len());
        bytes[..count].copy_from_slice(&rest[..count]);
        drop(content);
        self.position += count;
        Ok(count)
    }
}

impl Write for File {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut content = self.content.write().unwrap_or_else(PoisonError::into_inner);
        let end = self.position.checked_add(bytes.len()).ok_or(ErrorKind::FileTooLarge)?;
        if end > content.len() {
            let more = end - content.len();
            content.try_reserve(more)?;
            content.resize(end, 0);
        }
        content[self.position..end].copy_from_slice(bytes);
        drop(content);
        self.position = end;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for File {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let (base, offset) = match to {
            SeekFrom::Start(position) => (0, i64::try_from(position).ok()),
            SeekFrom::End(offset) => (self.read_lock().len(), Some(offset)),
            SeekFrom::Current(offset) => (self.position, Some(offset)),
        };
        let position = i64::try_from(base).ok().zip(offset);
        let position = position.and_then(|(base, offset)| base.checked_add(offset));
        let position = position.and_then(|it| usize::try_from(it).ok());
        self.position = position.ok_or(ErrorKind::InvalidInput)?;
        Ok(self.position as u64)
    }
}

/// Kind and size of an entry.
#[derive(Clone, Copy, Debug)]
pub struct MemoryFileInfo {
    /// Size of a file; none for a folder.
    bytes: Option<usize>,
}

impl MemoryFileInfo {
    /// True for a folder.
    #[must_use]
    pub fn is_dir(&self) -> bool {
        self.bytes.is_none()
    }

    /// True for a file.
    #[must_use]
    pub fn is_file(&self) -> bool {
        self.bytes.is_some()
    }

    /// Times are not kept.
    ///
    /// # Errors
    /// Always.
    pub fn modified(&self) -> io::Result<std::time::SystemTime> {
        Err(ErrorKind::Unsupported.into())
    }

    /// Size of a file \[bytes\].
    #[must_use]
    pub fn len(&self) -> u64 {
        self.bytes.unwrap_or(0) as u64
    }
}

/// An entry of a folder.
#[derive(Clone, Debug)]
pub struct DirEntry(PathBuf);

impl DirEntry {
    /// Name of the entry.
    #[must_use]
    pub fn file_name(&self) -> std::ffi::OsString {
        self.0.file_name().unwrap_or_default().to_owned()
    }

    /// Path of the entry.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.0.clone()
    }
}

/// Kind and size of an entry.
///
/// # Errors
/// When there is none.
pub fn metadata(path: impl AsRef<Path>) -> io::Result<MemoryFileInfo> {
    let path = plain(path.as_ref());
    match entries().get(&path) {
        Some(Some(content)) => {
            let content = content.read().unwrap_or_else(PoisonError::into_inner);
            Ok(MemoryFileInfo { bytes: Some(content.len()) })
        }
        Some(None) => Ok(MemoryFileInfo { bytes: None }),
        None if is_root(&path) => Ok(MemoryFileInfo { bytes: None }),
        None => Err(missing()),
    }
}

/// Absolute path without `.` and `..`.
///
/// # Errors
/// When there is no such entry.
pub fn canonicalize(path: impl AsRef<Path>) -> io::Result<PathBuf> {
    metadata(path.as_ref()).map(|_| plain(path.as_ref()))
}

/// Returns true if an entry exists at the path.
#[must_use]
pub fn exists(path: &Path) -> bool {
    metadata(path).is_ok()
}

/// Returns true for a file.
#[must_use]
pub fn is_file(path: &Path) -> bool {
    metadata(path).is_ok_and(|it| it.is_file())
}

/// Returns true for a folder.
#[must_use]
pub fn is_dir(path: &Path) -> bool {
    metadata(path).is_ok_and(|it| it.is_dir())
}

/// Reads a file.
///
/// # Errors
/// When there is no such file.
pub fn read(path: impl AsRef<Path>) -> io::Result<Vec<u8>> {
    let content = content(path.as_ref())?;
    Ok(content.read().unwrap_or_else(PoisonError::into_inner).clone())
}

/// Reads bytes at a position.
///
/// # Errors
/// When the file ends before.
pub fn read_exact_at(file: &File, bytes: &mut [u8], offset: u64) -> io::Result<()> {
    let content = file.read_lock();
    let start = usize::try_from(offset).map_err(|_| ErrorKind::UnexpectedEof)?;
    let end = start.checked_add(bytes.len()).ok_or(ErrorKind::UnexpectedEof)?;
    bytes.copy_from_slice(content.get(start..end).ok_or(ErrorKind::UnexpectedEof)?);
    Ok(())
}

/// Entries of a folder, by name.
///
/// # Errors
/// When there is no such folder.
pub fn read_dir(path: impl AsRef<Path>) -> io::Result<std::vec::IntoIter<io::Result<DirEntry>>> {
    let folder = plain(path.as_ref());
    if !metadata(&folder)?.is_dir() {
        return Err(ErrorKind::NotADirectory.into());
    }
    let entries = entries();
    let inside = entries.keys().filter(|path| path.parent() == Some(&*folder));
    Ok(inside.map(|path| Ok(DirEntry(path.clone()))).collect::<Vec<_>>().into_iter())
}

/// Creates a folder and its parents.
///
/// # Errors
/// When one of them is a file.
pub fn create_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    let path = plain(path.as_ref());
    let mut entries = entries();
    for folder in path.ancestors().filter(|folder| !is_root(folder)) {
        match entries.get(folder) {
            Some(Some(_)) => return Err(ErrorKind::NotADirectory.into()),
            Some(None) => break,
            None => {
                entries.insert(folder.to_owned(), None);
            }
        }
    }
    Ok(())
}

/// Writes a file, and replaces an old one.
///
/// # Errors
/// When its folder does not exist, or the path is a folder.
pub fn write(path: impl AsRef<Path>, content: impl AsRef<[u8]>) -> io::Result<()> {
    enter(path.as_ref(), false, Arc::new(RwLock::new(content.as_ref().to_vec())))
}

/// Moves a file, and replaces an old one.
///
/// # Errors
/// When there is no such file, or the target is a folder or in none.
pub fn rename(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<()> {
    let content = content(from.as_ref())?;
    enter(to.as_ref(), false, content)?;
    let (from, to) = (plain(from.as_ref()), plain(to.as_ref()));
    if from != to {
        entries().remove(&from);
    }
    Ok(())
}

/// Removes a file.
///
/// # Errors
/// When there is no such file.
pub fn remove_file(path: impl AsRef<Path>) -> io::Result<()> {
    content(path.as_ref())?;
    entries().remove(&plain(path.as_ref()));
    Ok(())
}

/// Removes a folder with all its entries.
///
/// # Errors
/// When there is no such folder.
pub fn remove_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    let folder = plain(path.as_ref());
    if !metadata(&folder)?.is_dir() {
        return Err(ErrorKind::NotADirectory.into());
    }
    entries().retain(|path, _| !path.starts_with(&folder));
    Ok(())
}

/// Folder for temporary files; it exists from here on.
#[must_use]
pub fn temp_dir() -> PathBuf {
    let folder = PathBuf::from("/tmp");
    // A file of this name is reported when a file is created in the folder.
    let _ = create_dir_all(&folder);
    folder
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &str) -> Vec<PathBuf> {
        read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    }

    #[test]
    fn files_are_in_folders() {
        assert_eq!(write("/a/x/one", "1").unwrap_err().kind(), ErrorKind::NotFound);
        create_dir_all("/a/x").unwrap();
        write("a/./x/../x/one", "1").unwrap();
        write("/a/two", "22").unwrap();
        assert_eq!(names("/a"), ["/a/two", "/a/x"].map(PathBuf::from));
        assert!(is_dir(Path::new("/a/x")) && is_file(Path::new("/a/x/one")));
        assert_eq!(metadata("/a/two").unwrap().len(), 2);
        assert_eq!(File::open("/a").unwrap_err().kind(), ErrorKind::IsADirectory);
        assert_eq!(create_dir_all("/a/two/y").unwrap_err().kind(), ErrorKind::NotADirectory);
        assert_eq!(File::create_new("/a/two").unwrap_err().kind(), ErrorKind::AlreadyExists);
        rename("/a/two", "/a/three").unwrap();
        assert!(!exists(Path::new("/a/two")));
        remove_dir_all("/a").unwrap();
        assert!(!exists(Path::new("/a/three")) && !exists(Path::new("/a")));
    }

    #[test]
    fn a_replaced_file_stays_readable_where_it_is_open() {
        create_dir_all("/b").unwrap();
        write("/b/bag", "old").unwrap();
        let mut old = File::open("/b/bag").unwrap();
        let mut new = File::create("/b/bag").unwrap();
        new.write_all(b"newer").unwrap();
        let mut text = String::new();
        old.read_to_string(&mut text).unwrap();
        assert_eq!(text, "old");
        assert_eq!(read("/b/bag").unwrap(), b"newer");
        remove_file("/b/bag").unwrap();
        assert_eq!(remove_file("/b/bag").unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    fn a_file_is_written_and_read_at_any_position() {
        create_dir_all("/c").unwrap();
        let mut file = File::create("/c/x").unwrap();
        file.write_all(b"0123").unwrap();
        file.seek(SeekFrom::Start(2)).unwrap();
        file.write_all(b"ab cd").unwrap();
        assert_eq!(read("/c/x").unwrap(), b"01ab cd");
        assert_eq!(file.seek(SeekFrom::End(-2)).unwrap(), 5);
        let mut two = [0; 2];
        file.read_exact(&mut two).unwrap();
        assert_eq!(&two, b"cd");
        read_exact_at(&file, &mut two, 1).unwrap();
        assert_eq!(&two, b"1a");
        assert!(read_exact_at(&file, &mut two, 6).is_err());
        assert!(file.seek(SeekFrom::Current(-8)).is_err());
        file.seek(SeekFrom::Start(8)).unwrap();
        file.write_all(b"!").unwrap();
        assert_eq!(read("/c/x").unwrap(), b"01ab cd\0!");
    }
}
