//! Python modules of packages that are not installed.

use std::path::{Path, PathBuf};

use periplus_resources::{Host, Kind};

use crate::evaluate::Evaluation;

/// Folders of a package in which its modules are kept, beside the package's own.
const USUAL: [&str; 4] = ["src", "python", "scripts", "lib"];

/// The folder in which a package around the launch file has a Python module of a name; none when no
/// package has one.
pub(crate) fn folder(evaluation: &Evaluation<'_>, module: &str) -> Option<String> {
    // Whatever else stands in a file, a module has the name of one.
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

/// The folders of a package that may hold modules: its own, the usual ones, and what its build files
/// name.
fn candidates(host: &dyn Host, package: &Path) -> Vec<PathBuf> {
    let mut folders = vec![package.to_path_buf()];
    folders.extend(USUAL.iter().map(|name| package.join(name)));
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
                // `PACKAGE_DIR` is the module itself, `package_dir` the folder that holds it.
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
    let is_file = |path: PathBuf| host.kind(&path) == Some(Kind::File);
    if is_file(own.join("__init__.py")) || is_file(folder.join(format!("{module}.py"))) {
        return true;
    }
    // A namespace package: a folder of modules without `__init__.py`.
    host.kind(&own) == Some(Kind::Folder)
        && host.list(&own).iter().any(|name| name.ends_with(".py") && name != "setup.py")
}
