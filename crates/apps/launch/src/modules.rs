//! Python modules of packages that are not installed.

use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, Host};

use crate::evaluate::Evaluation;

/// Folders of a package that may contain modules, beside the package's own.
const MODULE_FOLDERS: [&str; 4] = ["src", "python", "scripts", "lib"];

/// Folder of a package around the launch file that contains a Python module of this name.
pub(crate) fn folder(evaluation: &Evaluation<'_>, module: &str) -> Option<String> {
    // A module has a name that is valid as a file name.
    if module.is_empty() || !module.chars().all(|letter| letter == '_' || letter.is_alphanumeric())
    {
        return None;
    }
    let host = evaluation.host;
    let mut packages = evaluation.resolver.packages(&evaluation.context.file);
    let own = packages.remove(module);
    let all = own.into_iter().chain(packages.into_values());
    all.into_iter()
        .flat_map(|package| candidates(host, &package))
        .find(|folder| holds(host, folder, module))
        .map(|folder| folder.display().to_string())
}

/// Folders of a package that may contain modules: its own, the common ones, and those in its build
/// files.
fn candidates(host: &dyn Host, package: &Path) -> Vec<PathBuf> {
    let mut folders = vec![package.to_path_buf()];
    folders.extend(MODULE_FOLDERS.iter().map(|name| package.join(name)));
    for (file, word) in [("setup.py", "package_dir"), ("CMakeLists.txt", "PACKAGE_DIR")] {
        let Ok(bytes) = host.read(&package.join(file)) else { continue };
        let text = String::from_utf8_lossy(&bytes);
        for (at, _) in text.match_indices(word).take(8) {
            let rest: String = text[at + word.len()..].chars().take(200).collect();
            let named = rest.split(|letter: char| {
                !(letter.is_alphanumeric() || matches!(letter, '_' | '/' | '.' | '-'))
            });
            for name in named.filter(|name| !name.is_empty() && !name.contains("..")).take(4) {
                let folder = package.join(name.trim_start_matches('/'));
                // `PACKAGE_DIR` is the module itself, `package_dir` the folder that contains it.
                folders.extend(folder.parent().map(Path::to_path_buf));
                folders.push(folder);
            }
        }
    }
    folders.retain(|folder| folder.starts_with(package));
    folders
}

fn holds(host: &dyn Host, folder: &Path, module: &str) -> bool {
    let own = folder.join(module);
    let is_file = |path: PathBuf| host.kind(&path) == Some(EntryKind::File);
    if is_file(own.join("__init__.py")) || is_file(folder.join(format!("{module}.py"))) {
        return true;
    }
    // A namespace package: a folder of modules without `__init__.py`.
    host.kind(&own) == Some(EntryKind::Folder)
        && host.list(&own).iter().any(|name| name.ends_with(".py") && name != "setup.py")
}
