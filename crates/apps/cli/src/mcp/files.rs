//! Files that a command writes, and the pictures among them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use periplus_geometry::encode_base64;
use rmcp::model::ContentBlock;

/// Deepest folder that is searched.
const MAX_DEPTH: usize = 4;

/// Maximum number of files that are compared.
const MAX_FILES: usize = 5000;

/// Maximum number of pictures in a result.
const MAX_PICTURES: usize = 4;

/// Maximum size of a picture in a result \[bytes\].
const MAX_PICTURE_BYTES: u64 = 2_000_000;

/// Folders of other programs, which may be large.
const SKIPPED: [&str; 2] = ["node_modules", "target"];

/// Modification time and size of files.
#[derive(Debug, Default, PartialEq)]
pub(super) struct FileState(BTreeMap<PathBuf, (Option<SystemTime>, u64)>);

impl FileState {
    /// Looks at the files below a folder, and at `paths`, which may be elsewhere.
    pub(super) fn of(folder: &Path, paths: &[PathBuf]) -> Self {
        let mut state = Self::default();
        state.add(folder, 0);
        for path in paths {
            state.add(&folder.join(path), 0);
        }
        state
    }

    fn add(&mut self, path: &Path, depth: usize) {
        let Ok(metadata) = fs::metadata(path) else { return };
        if metadata.is_file() {
            if self.0.len() < MAX_FILES {
                self.0.insert(path.to_owned(), (metadata.modified().ok(), metadata.len()));
            }
            return;
        }
        if depth > MAX_DEPTH {
            return;
        }
        #[expect(clippy::disallowed_methods, reason = "this is an edge")]
        let Ok(entries) = fs::read_dir(path) else { return };
        let mut below: Vec<PathBuf> =
            entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        below.sort();
        for path in below {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if !name.starts_with('.') && !SKIPPED.contains(&name.as_ref()) {
                self.add(&path, depth + 1);
            }
        }
    }

    /// Returns the files that are new or other than before.
    pub(super) fn changed_since(&self, before: &Self) -> Vec<PathBuf> {
        let is_changed = |(path, state): &(&PathBuf, &(Option<SystemTime>, u64))| {
            before.0.get(*path) != Some(*state)
        };
        self.0.iter().filter(is_changed).map(|(path, _)| path.clone()).collect()
    }
}

/// Returns the pictures among files, and the names of those that are left out with the reason.
pub(super) fn pictures(files: &[PathBuf]) -> (Vec<ContentBlock>, Vec<String>) {
    let (mut pictures, mut left_out) = (Vec::new(), Vec::new());
    let is_png =
        |path: &&PathBuf| path.extension().is_some_and(|it| it.eq_ignore_ascii_case("png"));
    for path in files.iter().filter(is_png) {
        let size = fs::metadata(path).map_or(0, |metadata| metadata.len());
        if size > MAX_PICTURE_BYTES {
            left_out.push(format!("{}: larger than {MAX_PICTURE_BYTES} bytes", path.display()));
        } else if pictures.len() == MAX_PICTURES {
            left_out.push(format!("{}: more than {MAX_PICTURES} pictures", path.display()));
        } else {
            #[expect(clippy::disallowed_methods, reason = "this is an edge")]
            match fs::read(path) {
                Ok(bytes) => {
                    pictures.push(ContentBlock::image(encode_base64(&bytes), "image/png"));
                }
                Err(error) => left_out.push(format!("{}: {error}", path.display())),
            }
        }
    }
    (pictures, left_out)
}
