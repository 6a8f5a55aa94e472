//! Which crate may use which.
//!
//! Every crate stands on a floor (`package.metadata.periplus.floor`) and uses only crates of lower
//! floors. What estimates the world from measurements never sees the world itself, or its results
//! would prove nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use serde_json::Value;

use crate::step::{Failed, cargo};

/// These know the world only through messages ...
const ESTIMATORS: [&str; 5] = [
    "periplus-slam",
    "periplus-localization",
    "periplus-costmap",
    "periplus-explore",
    "periplus-fusion",
];
/// ... and never through these, not even by way of others.
const TRUTH: [&str; 4] =
    ["periplus-scene", "periplus-raycast", "periplus-dynamics", "periplus-sensors"];

pub(crate) fn run() -> Result<(), Failed> {
    let mut command = cargo();
    command.args(["metadata", "--no-deps", "--format-version", "1"]);
    let output = command.output().map_err(|error| Failed(format!("cargo metadata: {error}")))?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stderr);
        return Err(Failed(format!("cargo metadata failed: {words}")));
    }
    let metadata = serde_json::from_slice(&output.stdout)
        .map_err(|error| Failed(format!("cargo metadata is not JSON: {error}")))?;
    let crates = crates(&metadata);
    print!("{}", table(&crates));
    let faults = faults(&crates);
    if faults.is_empty() { Ok(()) } else { Err(Failed(faults.join("\n       "))) }
}

/// A crate of the workspace.
#[derive(Debug)]
struct Crate {
    /// None for the tools beside the crates (`xtask`, `benches`), which may use everything.
    floor: Option<u64>,
    is_tool: bool,
    /// Crates of the workspace that it is built with.
    uses: BTreeSet<String>,
}

fn crates(metadata: &Value) -> BTreeMap<String, Crate> {
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let name = |value: &Value| value["name"].as_str().unwrap_or_default().to_owned();
    let names: BTreeSet<String> = packages.iter().map(name).collect();
    let read = |package: &Value| {
        let dependencies = package["dependencies"].as_array();
        // What only the tests use does not make a crate depend on it.
        let uses = dependencies
            .into_iter()
            .flatten()
            .filter(|dependency| dependency["kind"] != "dev")
            .map(name)
            .filter(|dependency| names.contains(dependency))
            .collect();
        let manifest = package["manifest_path"].as_str().unwrap_or_default();
        Crate {
            floor: package["metadata"]["periplus"]["floor"].as_u64(),
            is_tool: !manifest.contains("/crates/") && !manifest.contains("\\crates\\"),
            uses,
        }
    };
    packages.iter().map(|package| (name(package), read(package))).collect()
}

fn faults(crates: &BTreeMap<String, Crate>) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, this) in crates {
        if this.floor.is_none() && !this.is_tool {
            faults.push(format!(
                "{name} has no floor: write `floor = N` under [package.metadata.periplus]"
            ));
        }
        for used in &this.uses {
            let other = &crates[used];
            if other.is_tool {
                faults.push(format!("{name} uses {used}, a tool that no one may use"));
            }
            if let (Some(own), Some(floor)) = (this.floor, other.floor)
                && floor >= own
            {
                faults.push(format!(
                    "{name} (floor {own}) uses {used} (floor {floor}): only lower floors may be used"
                ));
            }
        }
        if ESTIMATORS.contains(&name.as_str()) {
            for truth in TRUTH {
                if let Some(way) = way(crates, name, truth) {
                    faults.push(format!(
                        "{name} sees the true world: {}; estimators get messages only",
                        way.join(" uses ")
                    ));
                }
            }
        }
    }
    faults
}

/// A chain of uses from one crate to another.
fn way(crates: &BTreeMap<String, Crate>, from: &str, to: &str) -> Option<Vec<String>> {
    let mut reached = BTreeSet::from([from.to_owned()]);
    let mut ways = vec![vec![from.to_owned()]];
    while let Some(way) = ways.pop() {
        let last = way.last()?;
        if last == to {
            return Some(way);
        }
        for next in &crates[last].uses {
            if reached.insert(next.clone()) {
                ways.push(way.iter().chain([next]).cloned().collect());
            }
        }
    }
    None
}

/// The crates by floor, the lowest last as in a house.
fn table(crates: &BTreeMap<String, Crate>) -> String {
    let mut rows: Vec<_> = crates.iter().collect();
    rows.sort_by_key(|(name, this)| (std::cmp::Reverse(this.floor.unwrap_or(u64::MAX)), *name));
    let mut table = String::new();
    for (name, this) in rows {
        let floor = this.floor.map_or("-".into(), |floor| floor.to_string());
        let uses: Vec<&str> = this.uses.iter().map(|used| short(used)).collect();
        let line = format!("{floor:>2}  {:<12} {}", short(name), uses.join(" "));
        let _ = writeln!(table, "{}", line.trim_end());
    }
    table
}

fn short(name: &str) -> &str {
    name.strip_prefix("periplus-").unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A crate's name, its floor, and what it uses with the kind of use.
    type MadeUp<'a> = (&'a str, Option<u64>, &'a [(&'a str, Option<&'a str>)]);

    /// What cargo would say of such crates.
    fn workspace(made_up: &[MadeUp]) -> Value {
        let packages: Vec<Value> = made_up
            .iter()
            .map(|(name, floor, uses)| {
                let folder = if name.starts_with("periplus") { "crates/" } else { "" };
                let uses: Vec<Value> =
                    uses.iter().map(|(name, kind)| json!({"name": name, "kind": kind})).collect();
                let metadata = floor.map(|floor| json!({"periplus": {"floor": floor}}));
                json!({
                    "name": name,
                    "manifest_path": format!("/x/{folder}{name}/Cargo.toml"),
                    "metadata": metadata,
                    "dependencies": uses,
                })
            })
            .collect();
        json!({ "packages": packages })
    }

    #[track_caller]
    fn check(made_up: &[MadeUp], expected: &[&str]) {
        assert_eq!(faults(&crates(&workspace(made_up))), expected);
    }

    #[test]
    fn a_house_in_order() {
        let house: &[MadeUp] = &[
            ("periplus-base", Some(0), &[("serde", None), ("periplus-cli", Some("dev"))]),
            ("periplus-cli", Some(9), &[("periplus-base", None)]),
            ("xtask", None, &[("periplus-cli", None)]),
        ];
        check(house, &[]);
        assert_eq!(
            table(&crates(&workspace(house))),
            " -  xtask        cli\n 9  cli          base\n 0  base\n"
        );
    }

    #[test]
    fn only_lower_floors_are_used() {
        let fault = |floor| {
            format!(
                "periplus-a (floor 1) uses periplus-b (floor {floor}): only lower floors may be used"
            )
        };
        for (floor, kind) in [(1, None), (2, None), (1, Some("build"))] {
            let uses = [("periplus-b", kind)];
            check(
                &[("periplus-a", Some(1), &uses), ("periplus-b", Some(floor), &[])],
                &[&fault(floor)],
            );
        }
        check(
            &[("periplus-a", Some(1), &[("periplus-b", None)]), ("periplus-b", Some(0), &[])],
            &[],
        );
    }

    #[test]
    fn every_crate_has_a_floor_and_no_one_uses_a_tool() {
        check(
            &[("periplus-a", None, &[("xtask", None)]), ("xtask", None, &[])],
            &[
                "periplus-a has no floor: write `floor = N` under [package.metadata.periplus]",
                "periplus-a uses xtask, a tool that no one may use",
            ],
        );
    }

    #[test]
    fn estimators_never_see_the_world() {
        check(
            &[
                ("periplus-slam", Some(5), &[("periplus-maps", None)]),
                ("periplus-maps", Some(4), &[("periplus-scene", None)]),
                ("periplus-scene", Some(2), &[]),
                ("periplus-sensors", Some(5), &[("periplus-scene", None)]),
            ],
            &["periplus-slam sees the true world: periplus-slam uses periplus-maps uses \
               periplus-scene; estimators get messages only"],
        );
    }
}
