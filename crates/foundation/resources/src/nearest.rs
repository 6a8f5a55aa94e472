//! Suggestions for paths that do not exist.

use std::path::{Path, PathBuf};

use periplus_diagnostics::closest;

use crate::{EntryKind, Host};

/// Maximum number of folders in which a file of the same name is searched.
const MAX_FOLDERS: usize = 256;

/// Maximum number of parts of a path that are corrected.
const MAX_PATH_PARTS: usize = 32;

/// Returns the most likely target of a path that does not exist: a similar name in the same folder, the
/// same name one folder deeper, or the same path below a folder with a similar name.
pub fn nearest(host: &dyn Host, path: &Path) -> Option<PathBuf> {
    nearest_within(host, path, MAX_PATH_PARTS)
}

fn nearest_within(host: &dyn Host, path: &Path, parts: usize) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let parent = path.parent()?;
    let folder = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    if host.kind(folder) == Some(EntryKind::Folder) {
        return in_folder(host, folder, name);
    }
    let parent = nearest_within(host, parent, parts.checked_sub(1)?)?;
    let same = parent.join(name);
    if host.kind(&same).is_some() { Some(same) } else { in_folder(host, &parent, name) }
}

fn in_folder(host: &dyn Host, folder: &Path, name: &str) -> Option<PathBuf> {
    let names = host.list(folder);
    if let Some(near) = closest(name, names.iter().map(String::as_str)) {
        return Some(folder.join(near));
    }
    let visible = names.iter().filter(|name| !name.starts_with('.')).take(MAX_FOLDERS);
    let deeper = visible.map(|inner| folder.join(inner).join(name));
    let mut found = deeper.filter(|path| host.kind(path) == Some(EntryKind::File));
    let first = found.next()?;
    found.next().is_none().then_some(first)
}

#[cfg(test)]
mod tests {
    use super::nearest;
    use crate::MemoryHost;
    use std::path::Path;

    #[test]
    fn slips_in_names_and_folders_are_corrected() {
        let host = MemoryHost::new()
            .with_file("/w/worlds/house.sdf", "")
            .with_file("/w/worlds/pong.sdf", "")
            .with_file("/w/robots/kbot.urdf", "");
        let near = |path: &str| nearest(&host, Path::new(path)).map(|it| it.display().to_string());
        assert_eq!(near("/w/worlds/hous.sdf").as_deref(), Some("/w/worlds/house.sdf"));
        assert_eq!(near("/w/house.sdf").as_deref(), Some("/w/worlds/house.sdf"));
        assert_eq!(near("/w/world/house.sdf").as_deref(), Some("/w/worlds/house.sdf"));
        assert_eq!(near("/w/wrlds/hose.sdf").as_deref(), Some("/w/worlds/house.sdf"));
        assert_eq!(near("/w/worlds/completely_different.sdf"), None);
        assert_eq!(near("/nowhere/at/all"), None);
        assert_eq!(near("/"), None);
    }
}
