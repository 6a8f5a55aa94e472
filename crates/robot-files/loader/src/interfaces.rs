//! Message types from user packages.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_msgs::TypeRegistry;
use periplus_resources::{EntryKind as Standing, Host, package_name};
use periplus_rosidl::{InterfaceDialect, InterfaceKind, Registry, TypeName, parse};

/// Maximum depth of packages below a given folder: a workspace has them in `src/repository/group/package`.
const MAX_DEPTH: usize = 5;

/// Maximum number of folders that are searched. A full ROS installation has about a thousand.
const MAX_FOLDERS: usize = 20_000;

/// Folders that contain no user packages.
const SKIPPED: [&str; 5] = ["build", "log", "node_modules", "target", "__pycache__"];

/// Message types known to a program: built-in ones and those of user packages.
#[derive(Debug)]
pub struct Interfaces {
    /// Resolved types.
    pub types: TypeRegistry,
    /// Interface texts.
    pub sources: SourceMap,
    /// Findings about them.
    pub diagnostics: Diagnostics,
    /// Packages that were read, with their folders.
    pub packages: BTreeMap<String, PathBuf>,
}

/// Reads the interface texts (`msg/*.msg`, `srv/*.srv`, `action/*.action`) of the packages in the folders
/// and of those installed below `AMENT_PREFIX_PATH`. A folder is a package, contains packages, or is an
/// install prefix.
///
/// A package in an earlier folder overrides one of the same name and the built-in one; types that it does
/// not define remain. Unusable texts are left out, and a finding gives the reason.
#[must_use]
pub fn load_interfaces(host: &dyn Host, folders: &[PathBuf]) -> Interfaces {
    let mut reading = Reading {
        host,
        registry: TypeRegistry::builtin_texts(),
        sources: SourceMap::new(),
        diagnostics: Diagnostics::new(),
        packages: BTreeMap::new(),
        left: MAX_FOLDERS,
    };
    for folder in folders {
        reading.named(folder);
    }
    let prefixes = host.variable("AMENT_PREFIX_PATH").unwrap_or_default();
    for prefix in prefixes.split(':').filter(|prefix| !prefix.is_empty()) {
        reading.prefix(Path::new(prefix));
    }
    let Reading { registry, sources, mut diagnostics, packages, .. } = reading;
    let types = TypeRegistry::new(registry, &mut diagnostics);
    Interfaces { types, sources, diagnostics, packages }
}

struct Reading<'h> {
    host: &'h dyn Host,
    registry: Registry,
    sources: SourceMap,
    diagnostics: Diagnostics,
    packages: BTreeMap<String, PathBuf>,
    left: usize,
}

impl Reading<'_> {
    /// Folder given by the user, which should contain packages.
    fn named(&mut self, folder: &Path) {
        let shown = folder.display();
        if self.host.kind(folder) != Some(Standing::Folder) {
            let message = format!("`{shown}` is not a folder");
            let wrong = Diagnostic::error("no-interfaces", message);
            return self.diagnostics.push(wrong.help("name a package, or a folder with packages"));
        }
        let before = self.packages.len();
        self.prefix(folder);
        self.below(folder, 0);
        if self.packages.len() == before {
            let message = format!("there are no interfaces in `{shown}`");
            let wrong = Diagnostic::warning("no-interfaces", message);
            self.diagnostics.push(wrong.help(
                "a package has its texts in folders `msg`, `srv` and `action`, such as \
                 `my_interfaces/msg/Thing.msg`",
            ));
        }
    }

    /// Packages installed below a prefix.
    fn prefix(&mut self, prefix: &Path) {
        let share = prefix.join("share");
        for name in self.host.list(&share) {
            let folder = share.join(&name);
            if is_package(self.host, &folder) {
                self.package(&name, &folder);
            }
        }
    }

    fn below(&mut self, folder: &Path, depth: usize) {
        if self.left == 0 {
            return;
        }
        self.left -= 1;
        if is_package(self.host, folder) {
            let name = package_name(self.host, folder).or_else(|| {
                // `.` is resolved to its path.
                let place = self.host.canonical(folder).unwrap_or_else(|| folder.to_owned());
                Some(place.file_name()?.to_string_lossy().into_owned())
            });
            return self.package(&name.unwrap_or_default(), folder);
        }
        if depth == MAX_DEPTH {
            return;
        }
        for name in self.host.list(folder) {
            let below = folder.join(&name);
            let is_skipped = name.starts_with('.') || SKIPPED.contains(&name.as_str());
            if !is_skipped && self.host.kind(&below) == Some(Standing::Folder) {
                self.below(&below, depth + 1);
            }
        }
    }

    fn package(&mut self, package: &str, folder: &Path) {
        if self.packages.contains_key(package) {
            return;
        }
        self.packages.insert(package.to_owned(), folder.to_owned());
        for kind in [InterfaceKind::Message, InterfaceKind::Service, InterfaceKind::Action] {
            let texts = folder.join(kind.word());
            for name in self.host.list(&texts) {
                if let Some(stem) = name.strip_suffix(&format!(".{}", kind.word())) {
                    self.text(package, kind, stem, &texts.join(&name));
                }
            }
        }
    }

    fn text(&mut self, package: &str, kind: InterfaceKind, stem: &str, path: &Path) {
        let shown = path.display().to_string();
        let Some(name) = TypeName::read(&format!("{package}/{}/{stem}", kind.word())) else {
            let message =
                format!("`{shown}` is not a valid type name: `{package}/{}/{stem}`", kind.word());
            let wrong = Diagnostic::error("bad-type-name", message);
            return self.diagnostics.push(wrong.help(
                "packages have small letters, digits and `_`; types begin with a large letter and \
                 have no `_`",
            ));
        };
        let text = match self.host.read(path) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) => {
                let message = format!("`{shown}` cannot be read: {error}");
                return self.diagnostics.push(Diagnostic::error("unreadable", message));
            }
        };
        let file = self.sources.add(shown, text);
        let read = parse(&name, file, &self.sources, InterfaceDialect::Ros2, &mut self.diagnostics);
        if let Some(interface) = read {
            self.registry.add(interface);
        }
    }
}

/// Returns true if a folder has interface texts. A folder named `msg` alone is not enough.
fn is_package(host: &dyn Host, folder: &Path) -> bool {
    [InterfaceKind::Message, InterfaceKind::Service, InterfaceKind::Action].into_iter().any(
        |kind| {
            let ending = format!(".{}", kind.word());
            host.list(&folder.join(kind.word())).iter().any(|name| name.ends_with(&ending))
        },
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use periplus_diagnostics::{RenderStyle, render};
    use periplus_msgs::{DynamicMessage, Format};
    use periplus_resources::MemoryHost;

    use super::*;

    fn load(host: &MemoryHost, folders: &[&str]) -> (Interfaces, String) {
        let folders: Vec<PathBuf> = folders.iter().map(PathBuf::from).collect();
        let loaded = load_interfaces(host, &folders);
        let each = loaded.diagnostics.iter();
        let said = each.map(|one| render(one, &loaded.sources, RenderStyle::Plain)).collect();
        (loaded, said)
    }

    #[test]
    fn a_workspace_brings_its_types() {
        let host = MemoryHost::new()
            .with_file("/ws/src/arm/package.xml", "<package><name>arm_msgs</name></package>")
            .with_file(
                "/ws/src/arm/msg/Grip.msg",
                "std_msgs/Header header\nfloat64 force\nTip[] tips\n",
            )
            .with_file("/ws/src/arm/msg/Tip.msg", "string<=8 name \"left\"\n")
            .with_file("/ws/src/arm/srv/Open.srv", "float64 width\n---\nbool done\n")
            .with_file("/ws/src/arm/action/Hold.action", "float64 s\n---\n---\nGrip grip\n")
            .with_file("/ws/build/arm/msg/Grip.msg", "nonsense\n")
            .with_file("/ws/src/readme/msg/notes.txt", "");
        let (loaded, said) = load(&host, &["/ws"]);
        assert_eq!(said, "");
        assert_eq!(loaded.packages.keys().collect::<Vec<_>>(), ["arm_msgs"]);
        let grip = loaded.types.layout("arm_msgs/msg/Grip").unwrap();
        let json = serde_json::json!({ "force": 2.5, "tips": [{}, { "name": "right" }] });
        let message = DynamicMessage::from_json(grip, &json).unwrap();
        let mut cdr = Vec::new();
        message.encode(Format::CDR, &mut cdr).unwrap();
        let back = DynamicMessage::decode(grip, Format::CDR, &cdr).unwrap().to_json();
        assert_eq!(back["tips"][0]["name"], "left");
        assert!(loaded.types.hash("arm_msgs/msg/Grip").unwrap().starts_with("RIHS01_"));
        assert!(
            loaded.types.schema_text("arm_msgs/msg/Grip").unwrap().contains("MSG: arm_msgs/Tip")
        );
        for implied in ["srv/Open_Request", "action/Hold_SendGoal_Request"] {
            assert!(loaded.types.layout(&format!("arm_msgs/{implied}")).is_some(), "{implied}");
        }
        assert!(loaded.types.layout("sensor_msgs/msg/LaserScan").is_some());
    }

    #[test]
    fn installed_packages_come_after_named_ones() {
        let host = MemoryHost::new()
            .with_variable("AMENT_PREFIX_PATH", "/opt/one:/opt/two")
            .with_file("/opt/one/share/a_msgs/msg/A.msg", "int8 one\n")
            .with_file("/opt/two/share/a_msgs/msg/A.msg", "int8 two\n")
            .with_file("/opt/two/share/b_msgs/msg/B.msg", "a_msgs/A a\n")
            .with_file("/opt/two/share/std_msgs/msg/Bool.msg", "bool data\nbool more\n");
        let field = |loaded: &Interfaces, name: &str| {
            let layout = loaded.types.layout(name).unwrap();
            layout.fields().map(str::to_owned).collect::<Vec<_>>()
        };
        let (loaded, said) = load(&host, &[]);
        assert_eq!((said.as_str(), field(&loaded, "a_msgs/msg/A")), ("", vec!["one".to_owned()]));
        assert_eq!(field(&loaded, "std_msgs/msg/Bool"), ["data", "more"]);
        assert_eq!(field(&loaded, "std_msgs/msg/String"), ["data"]);
        let (loaded, _) = load(&host, &["/opt/two"]);
        assert_eq!(field(&loaded, "a_msgs/msg/A"), ["two"]);
    }

    #[test]
    fn slips_are_told() {
        let host = MemoryHost::new()
            .with_file("/a_msgs/msg/thing.msg", "int8 a\n")
            .with_file("/a_msgs/msg/Broken.msg", "int8 a\nflaot64 b\nint8\n")
            .with_file("/a_msgs/msg/Needs.msg", "b_msgs/B b\n")
            .with_file("/empty/x.txt", "");
        let (loaded, said) = load(&host, &["/a_msgs", "/empty", "/gone"]);
        assert!(loaded.types.layout("a_msgs/msg/Needs").is_none());
        expect![[r#"
            error[unknown-type]: `flaot64` is not a type
             --> /a_msgs/msg/Broken.msg:2:1
              |
            2 | flaot64 b
              | ^^^^^^^
              |
              = help: messages are named `package/Name`
            help: did you mean `float64`?
              |
            2 - flaot64 b
            2 + float64 b
              |
            error[missing-name]: `int8` is followed by no name
             --> /a_msgs/msg/Broken.msg:3:1
              |
            3 | int8
              | ^^^^
              |
              = help: a line is `type name`, `type name default` or `type NAME=value`
            error[bad-type-name]: `/a_msgs/msg/thing.msg` is not a valid type name: `a_msgs/msg/thing`
             |
             = help: packages have small letters, digits and `_`; types begin with a large letter and have no `_`
            warning[no-interfaces]: there are no interfaces in `/empty`
             |
             = help: a package has its texts in folders `msg`, `srv` and `action`, such as `my_interfaces/msg/Thing.msg`
            error[no-interfaces]: `/gone` is not a folder
             |
             = help: name a package, or a folder with packages
            error[unknown-type]: `a_msgs/msg/Needs` needs the unknown type `b_msgs/msg/B`
             --> /a_msgs/msg/Needs.msg:1:1
              |
            1 | b_msgs/B b
              | ^^^^^^^^
              |
              = help: add the package `b_msgs`
        "#]].assert_eq(&said);
    }
}
