//! Files of an archive, as a person drops a ROS package on the page.
//!
//! ZIP, tar, and tar compressed by gzip. Sizes and counts are limited, names stay below the target folder, and links and
//! devices are left out with the reason.

mod zip;

use std::fmt;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use flate2::read::MultiGzDecoder;
use periplus_diagnostics::plain_words;

/// Largest sum of the files of an archive: some worlds have 100 MB of textures, and a module of 32 bits has 4 GiB of
/// memory for archive, files and session.
const MAX_UNPACKED_BYTES: u64 = 512 << 20;

/// Largest number of entries; a large workspace of ROS has some thousand files.
const MAX_ENTRIES: usize = 20_000;

/// Number of entries that are named when they are left out.
const MAX_LEFT_OUT: usize = 20;

/// Names of entries that operating systems and version control add.
const CLUTTER: [&str; 4] = ["__MACOSX", ".DS_Store", ".git", "Thumbs.db"];

/// Position and text of the mark of tar in its first header.
const TAR_MARK: (usize, &[u8]) = (257, b"ustar");

/// Formats that are recognised and refused, by their first bytes.
const OTHER_FORMATS: [(&[u8], &str); 5] = [
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"Rar!", "a RAR archive"),
    (b"BZh", "compressed by bzip2"),
    (b"\xfd7zXZ\0", "compressed by xz"),
    (b"\x28\xb5\x2f\xfd", "compressed by Zstandard"),
];

/// Reason for which an archive is not unpacked.
#[derive(Debug)]
pub enum UnpackError {
    /// The format is none of the known ones.
    UnknownFormat,
    /// A format that is not supported, by name.
    OtherFormat(&'static str),
    /// The archive is damaged, or uses a feature that is not supported.
    Damaged(String),
    /// A file in the archive is encrypted.
    Encrypted(String),
    /// A name leads out of the target folder.
    Outside(String),
    /// Too many entries.
    TooMany,
    /// The files are too large together.
    TooLarge,
    /// No file remains.
    Empty,
}

impl fmt::Display for UnpackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat => f.write_str(
                "this is no archive of a known format; pack the folder as .zip or .tar.gz",
            ),
            Self::OtherFormat(name) => {
                write!(
                    f,
                    "this is {name}, which is not read here; pack the folder as .zip or .tar.gz"
                )
            }
            Self::Damaged(why) => {
                write!(f, "the archive cannot be read ({why}); pack or download it again")
            }
            Self::Encrypted(name) => {
                write!(f, "`{name}` is encrypted; pack the folder without a password")
            }
            Self::Outside(name) => write!(
                f,
                "`{name}` leads out of the archive, so that nothing is unpacked; pack the folder from its parent, \
                 with relative names"
            ),
            Self::TooMany => write!(
                f,
                "the archive has more than {MAX_ENTRIES} entries; pack only the packages that are needed"
            ),
            Self::TooLarge => write!(
                f,
                "the files of the archive have more than {} MB; leave out recordings and build folders",
                MAX_UNPACKED_BYTES >> 20
            ),
            Self::Empty => f.write_str("the archive contains no files"),
        }
    }
}

impl std::error::Error for UnpackError {}

impl From<io::Error> for UnpackError {
    fn from(error: io::Error) -> Self {
        Self::Damaged(plain_words(&error))
    }
}

/// Contents of an archive.
#[derive(Debug, Default)]
pub struct ArchiveContents {
    /// Files with their relative paths, in the order of the archive.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// Entries that were left out, with the reasons.
    pub left_out: Vec<String>,
    /// Bytes of the files.
    bytes: u64,
    /// Entries so far.
    entries: usize,
}

/// Reads all files of an archive.
///
/// # Errors
/// When the format is not known, the archive is damaged or too large, or a name leads out of it.
pub fn read(archive: &[u8]) -> Result<ArchiveContents, UnpackError> {
    let contents = if archive.starts_with(b"PK\x03\x04") || archive.starts_with(b"PK\x05\x06") {
        read_zip(archive)?
    } else if archive.starts_with(b"\x1f\x8b") {
        read_tar(MultiGzDecoder::new(archive))?
    } else if is_tar(archive) {
        read_tar(archive)?
    } else {
        let other = OTHER_FORMATS.iter().find(|(mark, _)| archive.starts_with(mark));
        return Err(
            other.map_or(UnpackError::UnknownFormat, |(_, name)| UnpackError::OtherFormat(name))
        );
    };
    if contents.files.is_empty() && contents.left_out.is_empty() {
        return Err(UnpackError::Empty);
    }
    Ok(contents)
}

fn is_tar(bytes: &[u8]) -> bool {
    let (position, mark) = TAR_MARK;
    bytes.get(position..).is_some_and(|rest| rest.starts_with(mark))
}

fn read_zip(bytes: &[u8]) -> Result<ArchiveContents, UnpackError> {
    let mut contents = ArchiveContents::default();
    for entry in zip::directory(bytes, MAX_ENTRIES)? {
        let name = &entry.name;
        let Some(path) = ArchiveContents::path(Path::new(&name.replace('\\', "/")), name)? else {
            continue;
        };
        if entry.is_folder() {
            continue;
        }
        if entry.is_link {
            contents.leave_out(name, "a link");
            continue;
        }
        if entry.is_encrypted {
            return Err(UnpackError::Encrypted(entry.name));
        }
        let content = zip::content(bytes, &entry, contents.rest())?;
        contents.push(path, content);
    }
    Ok(contents)
}

fn read_tar(stream: impl Read) -> Result<ArchiveContents, UnpackError> {
    // Long names are read as a whole, so that the limit is that of the stream. Headers and padding add to the files.
    let limit = 2 * MAX_UNPACKED_BYTES;
    let mut archive = tar::Archive::new(stream.take(limit));
    let mut contents = ArchiveContents::default();
    for entry in archive.entries()? {
        let mut entry = entry?;
        contents.count_entry()?;
        let path = entry.path()?.into_owned();
        let name = path.to_string_lossy().into_owned();
        let kind = entry.header().entry_type();
        let Some(path) = ArchiveContents::path(&path, &name)? else { continue };
        if kind.is_dir() || kind.is_pax_global_extensions() {
            continue;
        }
        if !(kind.is_file() || kind.is_contiguous() || kind.is_gnu_sparse()) {
            let is_link = kind.is_symlink() || kind.is_hard_link();
            contents.leave_out(&name, if is_link { "a link" } else { "no regular file" });
            continue;
        }
        contents.add(path, &mut entry)?;
    }
    Ok(contents)
}

impl ArchiveContents {
    fn count_entry(&mut self) -> Result<(), UnpackError> {
        self.entries += 1;
        if self.entries > MAX_ENTRIES { Err(UnpackError::TooMany) } else { Ok(()) }
    }

    /// Relative path of an entry; none for clutter and for the root.
    fn path(path: &Path, name: &str) -> Result<Option<PathBuf>, UnpackError> {
        let mut relative = PathBuf::new();
        for component in path.components() {
            match component {
                Component::Normal(part) => {
                    if CLUTTER.iter().any(|clutter| part == *clutter) {
                        return Ok(None);
                    }
                    relative.push(part);
                }
                Component::CurDir => {}
                Component::ParentDir | Component::RootDir | Component::Prefix(_) => {
                    return Err(UnpackError::Outside(name.to_owned()));
                }
            }
        }
        Ok((!relative.as_os_str().is_empty()).then_some(relative))
    }

    /// Bytes that further files may have.
    fn rest(&self) -> u64 {
        MAX_UNPACKED_BYTES - self.bytes
    }

    fn push(&mut self, path: PathBuf, content: Vec<u8>) {
        self.bytes += content.len() as u64;
        self.files.push((path, content));
    }

    /// Reads the content of an entry, up to the limit for all.
    fn add(&mut self, path: PathBuf, entry: &mut dyn Read) -> Result<(), UnpackError> {
        let mut content = Vec::new();
        // One byte more shows that there is more.
        entry.take(self.rest() + 1).read_to_end(&mut content)?;
        if content.len() as u64 > self.rest() {
            return Err(UnpackError::TooLarge);
        }
        self.push(path, content);
        Ok(())
    }

    fn leave_out(&mut self, name: &str, what: &str) {
        if self.left_out.len() < MAX_LEFT_OUT {
            self.left_out.push(format!("`{name}` is {what}"));
        } else if self.left_out.len() == MAX_LEFT_OUT {
            self.left_out.push("and more".to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use flate2::Compression;
    use flate2::write::{DeflateEncoder, GzEncoder};
    use proptest::prelude::*;

    use super::*;

    /// Headers of a ZIP archive by hand: each file deflated, then the directory and its end.
    fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
        let (mut bytes, mut directory) = (Vec::new(), Vec::new());
        for (name, content) in files {
            let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
            encoder.write_all(content).unwrap();
            let packed = encoder.finish().unwrap();
            // From the flags to the length of the extra field; both headers have them.
            let mut common = vec![0, 0, 8, 0, 0, 0, 0, 0];
            common.extend(crc32fast::hash(content).to_le_bytes());
            common.extend((packed.len() as u32).to_le_bytes());
            common.extend((content.len() as u32).to_le_bytes());
            common.extend((name.len() as u16).to_le_bytes());
            common.extend([0, 0]);
            directory.extend(b"PK\x01\x02\x14\x00\x14\x00");
            directory.extend(&common);
            directory.extend([0; 10]);
            directory.extend((bytes.len() as u32).to_le_bytes());
            directory.extend(name.as_bytes());
            bytes.extend(b"PK\x03\x04\x14\x00");
            bytes.extend(&common);
            bytes.extend(name.as_bytes());
            bytes.extend(&packed);
        }
        let (position, count) = (bytes.len() as u32, files.len() as u16);
        bytes.extend(&directory);
        bytes.extend(b"PK\x05\x06\0\0\0\0");
        bytes.extend([count.to_le_bytes(), count.to_le_bytes()].concat());
        bytes.extend((directory.len() as u32).to_le_bytes());
        bytes.extend(position.to_le_bytes());
        bytes.extend([0, 0]);
        bytes
    }

    fn tar(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut builder = tar::Builder::new(Vec::new());
        for (name, content) in files {
            let mut header = tar::Header::new_ustar();
            header.set_size(content.len() as u64);
            header.set_mode(0o644);
            // Names that the library refuses to write, too.
            header.as_mut_bytes()[..name.len()].copy_from_slice(name.as_bytes());
            header.set_cksum();
            builder.append(&header, *content).unwrap();
        }
        builder.into_inner().unwrap()
    }

    fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    fn check(archive: &[u8], expected: &[(&str, &[u8])]) {
        let contents = read(archive).unwrap();
        let files: Vec<(&str, &[u8])> = contents
            .files
            .iter()
            .map(|(path, content)| (path.to_str().unwrap(), content.as_slice()))
            .collect();
        assert_eq!(files, expected);
    }

    #[test]
    fn files_of_each_format_are_read() {
        let files: &[(&str, &[u8])] =
            &[("bot/package.xml", b"<package/>"), ("bot/urdf/bot.urdf", b"<robot/>")];
        check(&zip(files), files);
        check(&tar(files), files);
        check(&gzip(&tar(files)), files);
    }

    /// Archives that Python's `tarfile` and `zipfile` made, with a long name and a link.
    #[test]
    fn archives_of_another_program_are_read() {
        let robot = |bytes: &[u8], name: &str| {
            let contents = read(bytes).unwrap();
            let found = contents.files.iter().find(|(path, _)| path.ends_with(name));
            (found.unwrap().1.len(), contents.left_out)
        };
        let zip = include_bytes!("../../../../fuzz/seeds/archive/package.zip");
        assert_eq!(robot(zip, "bot/a.urdf"), (85, Vec::new()));
        let link = vec!["`bot/link` is a link".to_owned()];
        let tar = include_bytes!("../../../../fuzz/seeds/archive/package.tar");
        assert_eq!(robot(tar, "a.urdf"), (17, link.clone()));
        let packed = include_bytes!("../../../../fuzz/seeds/archive/package.tar.gz");
        assert_eq!(robot(packed, "a.urdf"), (17, link));
    }

    #[test]
    fn a_wrong_checksum_is_reported() {
        let mut bytes = zip(&[("a", b"hello")]);
        // The checksum is at 16 in the entry of the directory.
        let at = bytes.windows(4).position(|it| it == b"PK\x01\x02").unwrap();
        bytes[at + 16] ^= 1;
        let error = read(&bytes).unwrap_err().to_string();
        assert!(error.contains("`a` has a wrong checksum"), "{error}");
    }

    #[test]
    fn clutter_is_left_out() {
        let files: &[(&str, &[u8])] =
            &[("__MACOSX/bot/._a", b"x"), ("./bot/a", b"a"), ("bot/.git/HEAD", b"x")];
        check(&zip(files), &[("bot/a", b"a")]);
        check(&tar(files), &[("bot/a", b"a")]);
    }

    #[test]
    fn names_that_lead_out_are_refused() {
        for name in ["../a", "bot/../../a", "/etc/passwd"] {
            let error = read(&tar(&[(name, b"x")])).unwrap_err();
            assert!(matches!(&error, UnpackError::Outside(which) if which == name), "{error}");
        }
        let error = read(&zip(&[("../a", b"x")])).unwrap_err();
        assert!(matches!(error, UnpackError::Outside(_)), "{error}");
    }

    #[test]
    fn links_are_left_out_with_the_reason() {
        let mut builder = tar::Builder::new(Vec::new());
        let mut header = tar::Header::new_ustar();
        header.set_entry_type(tar::EntryType::Symlink);
        header.set_size(0);
        builder.append_link(&mut header, "bot/latest", "/etc").unwrap();
        let contents = read(&builder.into_inner().unwrap()).unwrap();
        assert_eq!(contents.left_out, ["`bot/latest` is a link"]);
        assert!(contents.files.is_empty());
    }

    /// 600 MB of zeros are some 600 kB when compressed.
    #[test]
    fn too_large_contents_are_refused() {
        let mut header = tar::Header::new_ustar();
        let size = MAX_UNPACKED_BYTES + (64 << 20);
        header.set_size(size);
        header.set_path("zeros").unwrap();
        header.set_cksum();
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(header.as_bytes()).unwrap();
        let block = vec![0_u8; 1 << 20];
        for _ in 0..(size >> 20) {
            encoder.write_all(&block).unwrap();
        }
        let error = read(&encoder.finish().unwrap()).unwrap_err();
        assert!(matches!(error, UnpackError::TooLarge), "{error}");
    }

    #[test]
    fn too_many_entries_are_refused() {
        let names: Vec<String> = (0..=MAX_ENTRIES).map(|number| number.to_string()).collect();
        let files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), &[][..])).collect();
        let error = read(&tar(&files)).unwrap_err();
        assert!(matches!(error, UnpackError::TooMany), "{error}");
    }

    #[test]
    fn other_formats_are_named() {
        let words = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(words(b"Rar!\x1a\x07\x01\x00").contains("a RAR archive"));
        assert!(words(b"7z\xbc\xaf\x27\x1c").contains("a 7z archive"));
        assert!(words(b"<robot/>").contains("no archive of a known format"));
        assert!(words(b"").contains("no archive of a known format"));
    }

    proptest! {
        /// Damage is reported or has no effect; nothing panics, and names stay inside.
        #[test]
        fn damaged_archives_are_read_or_refused(
            is_zip in any::<bool>(),
            changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
            end in any::<prop::sample::Index>(),
        ) {
            let files: &[(&str, &[u8])] = &[("bot/a.urdf", b"<robot/>"), ("bot/b", &[7; 900])];
            let mut bytes = if is_zip { zip(files) } else { gzip(&tar(files)) };
            for (at, value) in changes {
                let at = at.index(bytes.len());
                bytes[at] = value;
            }
            bytes.truncate(end.index(bytes.len()) + 1);
            if let Ok(contents) = read(&bytes) {
                for (path, _) in &contents.files {
                    prop_assert!(path.components().all(|it| matches!(it, Component::Normal(_))));
                }
            }
        }
    }
}
