//! Models of the Fuel server in the cache of Gazebo's tools.
//!
//! The cache keeps `HOST/OWNER/models/NAME/VERSION/` with host, owner and name in lower case
//! (gz-fuel-tools, `LocalCache`); older tools kept the letters as written.

use std::path::{Path, PathBuf};

use crate::host::{EntryKind, Host};
use crate::uri::percent_decoded;

/// Hosts that serve the same models, the current name first.
const HOSTS: [&str; 2] = ["fuel.gazebosim.org", "fuel.ignitionrobotics.org"];

/// Model or world on Fuel, or a file in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FuelUri {
    host: &'static str,
    owner: String,
    /// `models` or `worlds`.
    sort: &'static str,
    name: String,
    /// `None` for the newest.
    version: Option<u64>,
    /// File in the model, or empty.
    pub(crate) rest: String,
}

impl FuelUri {
    /// Parses `1.0/owner/models/name[/version][/files/...]`, or the web page's `owner/fuel/models/name`.
    /// `None` for other URIs.
    pub(crate) fn parse(host: &str, path: &str) -> Option<Self> {
        let host = match host.to_ascii_lowercase().as_str() {
            "fuel.gazebosim.org" | "app.gazebosim.org" => HOSTS[0],
            "fuel.ignitionrobotics.org" | "app.ignitionrobotics.org" => HOSTS[1],
            _ => return None,
        };
        let path = path.split(['?', '#']).next().unwrap_or_default();
        let mut parts = path.split('/').filter(|part| !part.is_empty()).peekable();
        let is_api_version =
            |part: &&str| part.split_once('.').is_some_and(|(a, b)| number(a) && number(b));
        parts.next_if(is_api_version);
        let owner = name_of(parts.next()?)?;
        parts.next_if_eq(&"fuel");
        let sort = match parts.next()? {
            "models" => "models",
            "worlds" => "worlds",
            _ => return None,
        };
        let name = name_of(parts.next()?)?;
        let version = match parts.next_if(|part| *part == "tip" || number(part)) {
            None | Some("tip") => None,
            Some(version) => Some(version.parse().ok()?),
        };
        parts.next_if_eq(&"files");
        let rest: Vec<&str> = parts.collect();
        let rest = rest.join("/");
        let rest = percent_decoded(&rest).unwrap_or(rest);
        Some(Self { host, owner, sort, name, version, rest })
    }

    /// Folders of this model's versions in a cache, with the spellings of the different tools.
    fn shelves(&self, cache: &Path) -> Vec<PathBuf> {
        let other = HOSTS.into_iter().filter(|host| *host != self.host);
        let mut shelves = Vec::new();
        for host in std::iter::once(self.host).chain(other) {
            let under =
                |owner: &str, name: &str| cache.join(host).join(owner).join(self.sort).join(name);
            shelves.push(under(&self.owner.to_lowercase(), &self.name.to_lowercase()));
            shelves.push(under(&self.owner, &self.name));
        }
        shelves.dedup();
        shelves
    }

    /// Cached folder of the requested or the newest version; otherwise the paths that were searched.
    pub(crate) fn find(
        &self,
        host: &dyn Host,
        caches: &[PathBuf],
    ) -> Result<PathBuf, Vec<PathBuf>> {
        let mut tried = Vec::new();
        for shelf in caches.iter().flat_map(|cache| self.shelves(cache)) {
            let version = self.version.or_else(|| {
                let versions = host.list(&shelf);
                versions.iter().filter(|name| number(name)).filter_map(|n| n.parse().ok()).max()
            });
            if let Some(version) = version {
                let folder = shelf.join(version.to_string());
                if host.kind(&folder) == Some(EntryKind::Folder) {
                    return Ok(folder);
                }
                tried.push(folder);
            } else {
                tried.push(shelf.join("*"));
            }
        }
        Err(tried)
    }

    /// Address from which Gazebo's tools download it.
    pub(crate) fn address(&self) -> String {
        let name = self.name.replace(' ', "%20");
        format!("https://{}/1.0/{}/{}/{name}", HOSTS[0], self.owner, self.sort)
    }

    /// True for a world, false for a model.
    pub(crate) fn is_world(&self) -> bool {
        self.sort == "worlds"
    }
}

/// Caches of Gazebo's tools, the current one first.
pub(crate) fn caches(host: &dyn Host) -> Vec<PathBuf> {
    let set = |name: &str| host.variable(name).filter(|value| !value.is_empty());
    let mut caches: Vec<PathBuf> = ["GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"]
        .into_iter()
        .filter_map(set)
        .map(PathBuf::from)
        .collect();
    if let Some(home) = set("HOME") {
        caches.push(Path::new(&home).join(".gz/fuel"));
        caches.push(Path::new(&home).join(".ignition/fuel"));
    }
    caches
}

fn number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Decoded name, if it is a valid folder name.
fn name_of(part: &str) -> Option<String> {
    let name = percent_decoded(part).unwrap_or_else(|| part.to_owned());
    (!matches!(name.as_str(), "." | "..") && !name.contains('/')).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MemoryHost;

    fn find(address: &str, files: &[&str]) -> Result<PathBuf, Vec<PathBuf>> {
        let host = files.iter().fold(MemoryHost::new(), |host, file| host.with_file(file, ""));
        let (server, path) = address.split_once('/').expect("a path");
        FuelUri::parse(server, path).expect("on Fuel").find(&host, &["/c".into()])
    }

    #[test]
    fn the_newest_version_by_number() {
        let files = [
            "/c/fuel.gazebosim.org/openrobotics/models/cube 20k/9/model.sdf",
            "/c/fuel.gazebosim.org/openrobotics/models/cube 20k/10/model.sdf",
        ];
        let shelf = Path::new("/c/fuel.gazebosim.org/openrobotics/models/cube 20k");
        let any = "fuel.gazebosim.org/1.0/OpenRobotics/models/Cube%2020k";
        assert_eq!(find(any, &files), Ok(shelf.join("10")));
        assert_eq!(find(&format!("{any}/tip/files/a.dae"), &files), Ok(shelf.join("10")));
        assert_eq!(find(&format!("{any}/9"), &files), Ok(shelf.join("9")));
        assert!(find(&format!("{any}/8"), &files).is_err());
        assert_eq!(
            find("app.gazebosim.org/OpenRobotics/fuel/models/Cube%2020k", &files),
            Ok(shelf.join("10"))
        );
    }

    #[test]
    fn the_old_host_names_the_same_models() {
        let files = ["/c/fuel.gazebosim.org/a/models/b/1/model.sdf"];
        let found = find("fuel.ignitionrobotics.org/1.0/a/models/b", &files);
        assert_eq!(found, Ok("/c/fuel.gazebosim.org/a/models/b/1".into()));
    }

    #[test]
    fn a_name_cannot_climb() {
        for path in ["1.0/../models/x", "1.0/a/models/%2e%2e", "1.0/a/models/..%2fb", "1.0/a"] {
            assert_eq!(FuelUri::parse("fuel.gazebosim.org", path), None, "{path}");
        }
        assert_eq!(FuelUri::parse("example.com", "1.0/a/models/b"), None);
    }
}
