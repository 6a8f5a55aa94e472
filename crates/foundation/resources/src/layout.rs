//! Files of packages that are not installed: a build installs some of them at other paths in the package's
//! share folder than in its sources, and launch files refer to the installed paths.

use std::path::{Component, Path, PathBuf};

use crate::data_files;
use crate::host::Host;
use crate::manifest::package_name;

/// Maximum depth of a file below its package.
const MAX_DEPTH: usize = 8;

/// Maximum number of folders with build files in one package: large packages of examples have some tens.
const MAX_FOLDERS: usize = 256;

/// Maximum size of a build file that is read [bytes].
const MAX_BUILD_FILE_BYTES: usize = 1 << 20;

/// Package that contains a path, and the path in it.
#[must_use]
pub fn package_of(host: &dyn Host, path: &Path) -> Option<(String, String)> {
    let folder = folder_of(host, path)?;
    let name = package_name(host, folder)?;
    Some((name, path.strip_prefix(folder).ok()?.display().to_string()))
}

fn folder_of<'p>(host: &dyn Host, path: &'p Path) -> Option<&'p Path> {
    let mut above = path.ancestors().skip(1).take(MAX_DEPTH);
    above.find(|up| {
        let holds = |manifest| host.kind(&up.join(manifest)).is_some();
        up.parent().is_some() && (holds("package.xml") || holds("manifest.xml"))
    })
}

/// Source file that the build of a package would install at a missing path.
#[must_use]
pub fn in_sources(host: &dyn Host, path: &Path) -> Option<PathBuf> {
    if !path.is_absolute() || host.kind(path).is_some() {
        return None;
    }
    let folder = folder_of(host, path)?;
    let inner = path.strip_prefix(folder).ok()?;
    let installed = rules_of(host, folder).into_iter();
    let installed = installed.filter_map(|rule| rule.source(inner));
    let data = data_files::sources(&text_of(host, &folder.join("setup.py")), inner);
    let mut found = installed.chain(data).map(|source| folder.join(source));
    found.find(|source| host.kind(source).is_some())
}

fn text_of(host: &dyn Host, path: &Path) -> String {
    let bytes = host.read(path).unwrap_or_default();
    String::from_utf8_lossy(&bytes[..bytes.len().min(MAX_BUILD_FILE_BYTES)]).into_owned()
}

/// Install rules of a package's `CMakeLists.txt` and of those added by `add_subdirectory`.
fn rules_of(host: &dyn Host, package: &Path) -> Vec<Rule> {
    let mut all = Vec::new();
    let mut folders = vec![PathBuf::new()];
    let mut next = 0;
    while let Some(folder) = folders.get(next).cloned() {
        next += 1;
        let text = without_comments(&text_of(host, &package.join(&folder).join("CMakeLists.txt")));
        for mut rule in rules(&text) {
            rule.source = folder.join(&rule.source);
            all.push(rule);
        }
        for inner in subfolders(&text) {
            let inner = folder.join(inner);
            let is_inside = inner.components().all(|part| matches!(part, Component::Normal(_)));
            if is_inside && folders.len() < MAX_FOLDERS && !folders.contains(&inner) {
                folders.push(inner);
            }
        }
    }
    all
}

/// Folders in `add_subdirectory`.
fn subfolders(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices(ADD).filter_map(|(at, _)| {
        let inner = text[at + ADD.len()..].split(')').next()?;
        Some(inner.split_whitespace().next()?.trim_matches('"'))
    })
}

const ADD: &str = "add_subdirectory(";

/// Build file with joined lines, without comments.
fn without_comments(text: &str) -> String {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or_default());
    lines.collect::<Vec<_>>().join(" ")
}

/// Effect of one `install(...)` on one source.
struct Rule {
    source: PathBuf,
    /// Folder in the package's share folder.
    to: PathBuf,
    is_folder: bool,
    /// True for a folder whose content is installed, without its name.
    is_content: bool,
}

impl Rule {
    /// Source of an installed path.
    fn source(&self, installed: &Path) -> Option<PathBuf> {
        let rest = installed.strip_prefix(&self.to).ok()?;
        if self.is_content {
            return Some(self.source.join(rest));
        }
        let rest = rest.strip_prefix(self.source.file_name()?).ok()?;
        match self.is_folder {
            true => Some(self.source.join(rest)),
            false => rest.as_os_str().is_empty().then(|| self.source.clone()),
        }
    }
}

/// Install rules into the package's share folder, from a build file without comments.
fn rules(text: &str) -> Vec<Rule> {
    let mut rules = Vec::new();
    for (at, _) in text.match_indices("install(") {
        let Some(inner) = text[at + "install(".len()..].split(')').next() else { continue };
        let words: Vec<&str> =
            inner.split_whitespace().map(|word| word.trim_matches('"')).collect();
        let Some((kind, rest)) = words.split_first() else { continue };
        let is_folder = match *kind {
            "DIRECTORY" => true,
            "FILES" | "PROGRAMS" => false,
            _ => continue,
        };
        let Some(end) = rest.iter().position(|word| *word == "DESTINATION") else { continue };
        let Some(to) = rest.get(end + 1).and_then(|to| share(to)) else { continue };
        for source in &rest[..end] {
            rules.push(Rule {
                source: PathBuf::from(source.trim_end_matches('/')),
                to: to.clone(),
                is_folder,
                is_content: is_folder && source.ends_with('/'),
            });
        }
    }
    rules
}

/// Destination as a folder in the package's share folder; `None` for others.
fn share(destination: &str) -> Option<PathBuf> {
    let of_package = ["${CATKIN_PACKAGE_SHARE_DESTINATION}"];
    if let Some(rest) = of_package.iter().find_map(|prefix| destination.strip_prefix(prefix)) {
        return Some(rest.trim_matches('/').into());
    }
    let mut parts = destination.trim_end_matches('/').splitn(3, '/');
    let is_share = matches!(parts.next(), Some("share" | "${CMAKE_INSTALL_DATADIR}"));
    parts.next().filter(|_| is_share)?;
    Some(parts.next().unwrap_or_default().into())
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use crate::MemoryHost;

    use super::in_sources;

    #[test]
    fn files_are_found_where_the_build_takes_them_from() {
        let host = MemoryHost::new()
            .with_file("/w/bot/package.xml", "<package><name>bot</name></package>")
            .with_file(
                "/w/bot/CMakeLists.txt",
                "project(bot) # install(FILES no DESTINATION share/bot)\n\
                 install(DIRECTORY description/urdf bringup/launch\n DESTINATION share/bot)\n\
                 install(\n DIRECTORY bringup/config/ DESTINATION share/${PROJECT_NAME}/params)\n\
                 install(FILES top/a.yaml DESTINATION share/${PROJECT_NAME}/config)\n\
                 install(TARGETS x DESTINATION lib/bot)
                 add_subdirectory(doc/examples) add_subdirectory(../out)",
            )
            .with_file("/w/bot/doc/examples/CMakeLists.txt", "add_subdirectory(one)")
            .with_file(
                "/w/bot/doc/examples/one/CMakeLists.txt",
                "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})",
            )
            .with_file("/w/bot/doc/examples/one/launch/one.launch.py", "")
            .with_file("/w/out/CMakeLists.txt", "install(FILES o DESTINATION share/bot)")
            .with_file("/w/out/o", "")
            .with_file("/w/bot/description/urdf/bot.urdf", "")
            .with_file("/w/bot/bringup/config/p.yaml", "")
            .with_file("/w/bot/top/a.yaml", "");
        let check = |installed: &str, source: Option<&str>| {
            let found = in_sources(&host, Path::new(installed));
            assert_eq!(found, source.map(PathBuf::from), "{installed}");
        };
        check("/w/bot/urdf/bot.urdf", Some("/w/bot/description/urdf/bot.urdf"));
        check("/w/bot/params/p.yaml", Some("/w/bot/bringup/config/p.yaml"));
        check("/w/bot/config/a.yaml", Some("/w/bot/top/a.yaml"));
        check("/w/bot/launch/one.launch.py", Some("/w/bot/doc/examples/one/launch/one.launch.py"));
        check("/w/bot/o", None);
        check("/w/bot/urdf/other.urdf", None);
        check("/w/bot/top/a.yaml", None);
        check("/elsewhere/a.yaml", None);
        let host = host
            .with_file("/w/py/package.xml", "<package><name>py</name></package>")
            .with_file(
                "/w/py/setup.py",
                "setup(data_files=[('share/py/config', glob('params/*.yaml'))])",
            )
            .with_file("/w/py/params/p.yaml", "");
        let found = in_sources(&host, Path::new("/w/py/config/p.yaml"));
        assert_eq!(found, Some("/w/py/params/p.yaml".into()));
    }
}
